// Steady friction on elements at extreme parameter values: both directions of creepage, an elastic layer, node
// differences.
#include <string>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/discretisation/any_scheme.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/normal/hertz.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using rollbem::Mesh;
using rollbem::Nodes;
using rollbem::PlaneKernel;

/// Hertz's pressure on a plane contact.
struct Line {
    Mesh<double> mesh;
    double nu = steel;
    rollbem::AnyScheme scheme = equal;
    double layer = 0;

    rollbem::Contact<double> contact() const { return rollbem::Contact<double>::dimensionless(infinity, nu); }

    /// G' of a direction, with the layer if there is one.
    Eigen::MatrixXd slopes(bool lateral) const {
        const auto kernel =
            lateral ? PlaneKernel<double>::lateral(contact()) : PlaneKernel<double>::longitudinal(contact());
        if (layer == 0) return rollbem::assemble_G_prime(mesh, scheme, kernel);
        return rollbem::assemble_G_prime(mesh, scheme, rollbem::LayeredKernel(kernel, layer));
    }
    double adhesion(bool lateral) const { return rollbem::solve_steady<double>(slopes(lateral), mesh.widths()).c11(); }

    /// Forces are over mu N, at the creepage ratio delta; cosine and sine give the direction of the creepage.
    auto both(double delta, double cosine, double sine) const {
        const rollbem::FrictionModel<rollbem::ConstantFriction<>, 2> model(
            contact(), {{{}, slopes(false), mesh.widths()}, {{}, slopes(true), mesh.widths()}}, law());
        const double size = creepage(delta, nu);
        auto step = rollbem::Run(model).steady({.motion = {size * cosine, size * sine}});
        step.force = {-step.force.longitudinal / full_force, -step.force.lateral / full_force};
        return step;
    }
    /// The same by the solver of one direction.
    auto alone(bool lateral, double delta) const {
        const rollbem::FrictionModel<> model(contact(), {{}, slopes(lateral), mesh.widths()}, law());
        auto step = rollbem::Run(model).steady({.motion = creepage(delta, nu)});
        step.force /= -full_force;
        return step;
    }
    /// The same where friction falls with slip to a share of mu, by half at a velocity over that of rolling.
    auto falling(double delta, double share, double half_velocity) const {
        const rollbem::ExponentialFall<> fall{1, share, half_velocity};
        const rollbem::FrictionModel model(contact(), rollbem::ElementSystem<double>({}, slopes(false), mesh.widths()),
                                           rollbem::unchecked, rollbem::Friction{fall, law().normal_pressure});
        auto step = rollbem::Run(model).steady({rollbem::Travel<>::at_speed(1.0), creepage(delta, nu)});
        step.force /= -full_force;
        return step;
    }

private:
    rollbem::Friction<> law() const { return {1, peak * rollbem::mean_hertz_pressure(mesh)}; }
};

double size(const rollbem::TangentialForce<double>& force) { return std::hypot(force.longitudinal, force.lateral); }

void add_directions(Cases& cases) {
    for (const double nu : {0.0, steel, 0.5}) {
        const Line line{rollbem::cosine_mesh(40), nu};
        const std::string end = ", nu = " + shown(nu);
        for (const bool lateral : {false, true}) {
            const auto along = [=](const auto& step) { return lateral ? step.force.lateral : step.force.longitudinal; };
            // Nearly in one direction: the force differs from that of its own solver by the square of the angle.
            for (const double angle : {0.0, 1e-12, 1e-6, 1e-3}) {
                cases.push_back(
                    {"creepage at " + shown(angle) + " rad to the " + (lateral ? "lateral" : "rolling") + " direction" +
                         end,
                     "force against one direction", [=] {
                         const double own = std::cos(angle), beside = std::sin(angle);
                         const auto step = lateral ? line.both(0.5, beside, own) : line.both(0.5, own, beside);
                         return compare(step, along(step), line.alone(lateral, 0.5).force, 1e-12 + angle * angle);
                     }});
            }
            // The slip zone is smaller than any element of the mesh: full adhesion.
            cases.push_back({"creepage 1e-6 at 45 degrees" + end,
                             lateral ? "lateral force against adhesion" : "force against adhesion", [=] {
                                 const auto step = line.both(1e-6, std::sqrt(0.5), std::sqrt(0.5));
                                 const double xi = creepage(1e-6, nu) * std::sqrt(0.5);
                                 return compare(step, along(step) * full_force, line.adhesion(lateral) * xi, 1e-12);
                             }});
        }
        // Full sliding: the force opposes the creepage but for a part of order 1/delta due to Poisson's ratio.
        for (const double delta : {1e3, 1e9}) {
            const std::string name = "creepage " + shown(delta) + " at 30 degrees" + end;
            const double turned = nu > 0 ? 0.1 / delta : 0;
            cases.push_back({name, "size of the force against mu N", [=] {
                                 const auto step = line.both(delta, std::sqrt(0.75), 0.5);
                                 return compare(step, size(step.force), 1, 1e-12 + turned / delta);
                             }});
            cases.push_back({name, "lateral over longitudinal force", [=] {
                                 const auto step = line.both(delta, std::sqrt(0.75), 0.5);
                                 return compare(step, step.force.lateral / step.force.longitudinal, std::sqrt(1 / 3.0),
                                                1e-12 + turned);
                             }});
        }
    }
    // With a Poisson's ratio of 0 all directions are equivalent, until the last element slips.
    for (const double delta : {1e-6, 0.5, 0.999, 1.0}) {
        for (const double degrees : {1e-6, 30.0, 89.999}) {
            cases.push_back({"creepage " + shown(delta) + " at " + shown(degrees) + " degrees, nu = 0",
                             "size of the force against one direction", [=] {
                                 const Line line{rollbem::cosine_mesh(40), 0};
                                 const double angle = degrees * pi / 180;
                                 const auto step = line.both(delta, std::cos(angle), std::sin(angle));
                                 return compare(step, size(step.force), line.alone(false, delta).force, 1e-10);
                             }});
        }
    }
    // Across, Carter's creepage of full sliding is 1/(1 - nu) times as large.
    cases.push_back({"creepage 0.999 across, nu = 0.5", "lateral force against Carter", [] {
                         const auto step = Line{rollbem::cosine_mesh(160), 0.5}.both(0.999, 0, 1);
                         return compare(step, step.force.lateral, rollbem::carter_force_ratio(0.4995), 1e-4);
                     }});
}

void add_layers(Cases& cases) {
    for (const int n : {3, 40}) {
        const std::string elements = ", n = " + std::to_string(n);
        const auto with = [n](double layer) { return Line{rollbem::uniform_mesh(n), steel, equal, layer}; };
        cases.push_back({"layer 1e-12" + elements, "force against none", [=] {
                             const auto step = with(1e-12).alone(false, 0.5);
                             return compare(step, step.force, with(0).alone(false, 0.5).force, 1e-11);
                         }});
        // Independent bristles, p_i = -(xi/L) h (n - i) by upwind differences: c11 = (2/L)(1 + 1/n).
        for (const double layer : {1e6, 1e12}) {
            cases.push_back({"layer " + shown(layer) + elements, "c11 against a brush", [=] {
                                 const double brush = 2 / layer * (1 + 1.0 / n);
                                 return compare(with(layer).adhesion(false), brush, 3 / layer + 1e-13);
                             }});
        }
        // the same in both directions, also with friction: at this ratio the brush has begun to slip
        cases.push_back({"layer 1e6, creepage at 60 degrees" + elements, "lateral over longitudinal force", [=] {
                             const auto step = with(1e6).both(0.2 * 1e6, 0.5, std::sqrt(0.75));
                             return compare(step, step.force.lateral / step.force.longitudinal, std::sqrt(3.0), 1e-6);
                         }});
    }
}

void add_nodes(Cases& cases) {
    for (const auto& [nodes, which] : {std::pair{Nodes::centres, "centres"}, {Nodes::chebyshev, "Chebyshev points"}}) {
        const auto on = [nodes = nodes](Eigen::Index n) {
            return Line{rollbem::cosine_mesh(n), steel, rollbem::NodeDifference{nodes}};
        };
        for (const Eigen::Index n : {1, 2, 40, 400}) {
            const std::string where = std::string(" by ") + which + ", n = " + std::to_string(n);
            cases.push_back({"creepage 1e9" + where, "force against full sliding", [=] {
                                 const auto step = on(n).alone(false, 1e9);
                                 return compare(step, step.force, 1, 1e-12);
                             }});
            cases.push_back({"creepage 1e-9" + where, "force against adhesion", [=] {
                                 const auto step = on(n).alone(false, 1e-9);
                                 const double reference = on(n).adhesion(false) * creepage(1e-9) / full_force;
                                 return compare(step, step.force, reference, 1e-11);
                             }});
        }
        cases.push_back({std::string("creepage 0.999 by ") + which + ", n = 40", "force against Carter", [=] {
                             const auto step = on(40).alone(false, 0.999);
                             return compare(step, step.force, rollbem::carter_force_ratio(0.999), 5e-4);
                         }});
    }
}

void add_falling(Cases& cases) {
    const Line line{rollbem::cosine_mesh(40)};
    for (const double delta : {1e-6, 0.5, 1e3}) {
        const std::string name = "creepage " + shown(delta) + ", friction ";
        const auto add = [&](const std::string& falls, double share, double velocity, double reference) {
            cases.push_back({name + falls, "force against constant friction", [=] {
                                 const auto step = line.falling(delta, share, velocity);
                                 return compare(step, step.force, reference, 1e-10);
                             }});
        };
        const double constant = line.alone(false, delta).force;
        add("that falls to itself", 1, 1e-3, constant);
        add("that falls at 1e12 of the speed", 0.5, 1e12, constant);
    }
    for (const double velocity : {1e-12, 1e-3}) {
        cases.push_back({"creepage 1e6, friction that falls at " + shown(velocity) + " of the speed",
                         "force against what is left of mu N", [=] {
                             const auto step = line.falling(1e6, 0.3, velocity);
                             return compare(step, step.force, 0.3, 1e-12);
                         }});
    }
}

}  // namespace

void friction_cases(Cases& cases) {
    add_directions(cases);
    add_layers(cases);
    add_nodes(cases);
    add_falling(cases);
}

}  // namespace extremes
