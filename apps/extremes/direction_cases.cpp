// Friction on elements at the edges of its domain: both directions of creepage, an elastic layer, node differences.
#include <cmath>
#include <string>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>

#include "cases.hpp"
#include "friction_scale.hpp"

namespace extremes {

namespace {

using rollbem::Contact;
using rollbem::Mesh;
using rollbem::PlaneKernel;
using rollbem::StepStatus;
using Step = rollbem::FrictionStep<>;
using Vector = rollbem::Creepage<double>;

// --- both directions

struct Combined {
    Combined(const Mesh<double>& of, double ratio_nu, double layer_ = 0)
        : nu(ratio_nu), layer(layer_), contact(Contact<double>::dimensionless(infinity, nu)), mesh(of) {}

    /// G' of a direction, with the layer if there is one.
    Eigen::MatrixXd slopes(bool lateral) const {
        const auto kernel =
            lateral ? PlaneKernel<double>::lateral(contact) : PlaneKernel<double>::longitudinal(contact);
        if (layer == 0) return rollbem::assemble_G_prime(mesh, equal, kernel);
        return rollbem::assemble_G_prime(mesh, equal, rollbem::LayeredKernel(kernel, layer));
    }

    /// -F/(mu N) in both directions at the creepage ratio delta; cosine and sine give the direction of the creepage.
    Vector force(double delta, double cosine, double sine) {
        const rollbem::FrictionModel<rollbem::ConstantFriction<>, 2> model(
            contact, {{{}, slopes(false), mesh.widths()}, {{}, slopes(true), mesh.widths()}},
            {1, peak * rollbem::mean_hertz_pressure(mesh)});
        const double size = creepage(delta, nu);
        const auto point = steady_from_rest(model, Vector{size * cosine, size * sine});
        told = told_by(point.status);
        residual = point.complementarity_residual;
        return {-point.force.longitudinal / full_force, -point.force.lateral / full_force};
    }

    /// The same by the solver of one direction.
    double force_alone(bool lateral, double delta) const {
        const rollbem::FrictionModel<> model(contact, {{}, slopes(lateral), mesh.widths()},
                                             {1, peak * rollbem::mean_hertz_pressure(mesh)});
        const Step point = steady_from_rest(model, creepage(delta, nu));
        return point.status == StepStatus::ok ? -point.force / full_force : nothing;
    }

    Outcome against(double value, double reference, double bound) const {
        Outcome outcome = compare(value, reference, bound, told);
        outcome.residual = residual;
        return outcome;
    }

    double nu, layer;
    Contact<double> contact;
    Mesh<double> mesh;
    std::string told{};
    double residual = nothing;
};

void add_directions(Cases& cases) {
    const Mesh<double> mesh = rollbem::cosine_mesh(40);
    for (const double nu : {0.0, steel, 0.5}) {
        const std::string end = ", nu = " + shown(nu);
        // Nearly in one direction: the force differs from that of its own solver by the square of the angle.
        for (const double angle : {0.0, 1e-12, 1e-6, 1e-3}) {
            for (const bool lateral : {false, true}) {
                cases.right("creepage at " + shown(angle) + " rad to the " + (lateral ? "lateral" : "rolling") +
                                " direction" + end,
                            "force against one direction", [=] {
                                Combined contact(mesh, nu);
                                const double along = std::cos(angle), beside = std::sin(angle);
                                const Vector force =
                                    lateral ? contact.force(0.5, beside, along) : contact.force(0.5, along, beside);
                                return contact.against(lateral ? force.lateral : force.longitudinal,
                                                       contact.force_alone(lateral, 0.5), 1e-12 + angle * angle);
                            });
            }
        }
        // The slip zone is smaller than any element of the mesh: full adhesion.
        for (const bool lateral : {false, true}) {
            cases.right("creepage 1e-6 at 45 degrees" + end,
                        lateral ? "lateral force against adhesion" : "force against adhesion", [=] {
                            Combined contact(mesh, nu);
                            const Vector force = contact.force(1e-6, std::sqrt(0.5), std::sqrt(0.5));
                            const auto adhesion =
                                rollbem::solve_steady<double>(contact.slopes(lateral), contact.mesh.widths());
                            const double reference = adhesion.c11() * creepage(1e-6, nu) * std::sqrt(0.5);
                            return contact.against((lateral ? force.lateral : force.longitudinal) * full_force,
                                                   reference, 1e-12);
                        });
        }
        // Full sliding: the force opposes the creepage but for a part of order 1/delta due to Poisson's ratio.
        for (const double delta : {1e3, 1e9}) {
            cases.right("creepage " + shown(delta) + " at 30 degrees" + end, "size of the force against mu N", [=] {
                Combined contact(mesh, nu);
                const Vector force = contact.force(delta, std::sqrt(0.75), 0.5);
                return contact.against(std::hypot(force.longitudinal, force.lateral), 1,
                                       1e-12 + (nu > 0 ? 0.1 / (delta * delta) : 0));
            });
            cases.right("creepage " + shown(delta) + " at 30 degrees" + end, "lateral over longitudinal force", [=] {
                Combined contact(mesh, nu);
                const Vector force = contact.force(delta, std::sqrt(0.75), 0.5);
                return contact.against(force.lateral / force.longitudinal, std::sqrt(1 / 3.0),
                                       1e-12 + (nu > 0 ? 0.1 / delta : 0));
            });
        }
    }
    // With a Poisson's ratio of 0 all directions are equivalent, until the last element slips.
    for (const double delta : {1e-6, 0.5, 0.999, 1.0}) {
        for (const double degrees : {1e-6, 30.0, 89.999}) {
            cases.right("creepage " + shown(delta) + " at " + shown(degrees) + " degrees, nu = 0",
                        "size of the force against one direction", [=] {
                            Combined contact(mesh, 0);
                            const double angle = degrees * pi / 180;
                            const Vector force = contact.force(delta, std::cos(angle), std::sin(angle));
                            return contact.against(std::hypot(force.longitudinal, force.lateral),
                                                   contact.force_alone(false, delta), 1e-10);
                        });
        }
    }
    // Across, Carter's creepage of full sliding is 1/(1 - nu) times as large.
    cases.right("creepage 0.999 across, nu = 0.5", "lateral force against Carter", [] {
        Combined contact(rollbem::cosine_mesh(160), 0.5);
        return contact.against(contact.force(0.999, 0, 1).lateral, rollbem::carter_force_ratio(0.4995), 1e-4);
    });
    cases.told("creepage nan", "force", "not_finite", [] {
        Combined contact(rollbem::cosine_mesh(10), steel);
        return contact.against(contact.force(nothing, 1, 0).longitudinal, 1, 0);
    });
}

// --- a layer

void add_layers(Cases& cases) {
    for (const int n : {3, 40}) {
        const Mesh<double> mesh = rollbem::uniform_mesh(n);
        const std::string elements = ", n = " + std::to_string(n);
        for (const double layer : {0.0, 1e-12}) {
            cases.right("layer " + shown(layer) + elements, "force against none", [=] {
                Combined with(mesh, steel, layer), without(mesh, steel);
                return with.against(with.force_alone(false, 0.5), without.force_alone(false, 0.5), 1e-11);
            });
        }
        // Independent bristles, p_i = -(xi/L) h (n - i) by upwind differences: c11 = (2/L)(1 + 1/n).
        for (const double layer : {1e6, 1e12}) {
            cases.right("layer " + shown(layer) + elements, "c11 against a brush", [=] {
                const Combined contact(mesh, steel, layer);
                const auto solution = rollbem::solve_steady<double>(contact.slopes(false), mesh.widths());
                return compare(solution, solution.c11(), 2 / layer * (1 + 1.0 / n), 3 / layer + 1e-13);
            });
        }
        // the same in both directions, also with friction: at this ratio the brush has begun to slip
        cases.right("layer 1e6, creepage at 60 degrees" + elements, "lateral over longitudinal force", [=] {
            Combined contact(mesh, steel, 1e6);
            const Vector force = contact.force(0.2 * 1e6, 0.5, std::sqrt(0.75));
            return contact.against(force.lateral / force.longitudinal, std::sqrt(3.0), 1e-6);
        });
    }
    const auto refused = [&](double layer, const std::string& says) {
        cases.told("layer " + shown(layer), "force", says, [=] {
            const Combined contact(rollbem::uniform_mesh(10), steel, layer);
            return compare(contact.force_alone(false, 0.5), 1, 0);
        });
    };
    for (const double layer : {-1e-12, nothing, infinity}) refused(layer, "compliance");
}

// --- differences between nodes

void add_nodes(Cases& cases) {
    using rollbem::NodeDifference, rollbem::Nodes;
    const Contact<double> contact = Contact<double>::dimensionless(infinity, steel);
    const auto plane = PlaneKernel<double>::longitudinal(contact);
    const auto friction = [=](const Mesh<double>& mesh, const NodeDifference& scheme, double delta, double reference,
                              double bound) {
        const rollbem::FrictionModel<> model(contact, steady_system(mesh, scheme, plane),
                                             {1, peak * rollbem::mean_hertz_pressure(mesh)});
        const Step point = steady_from_rest(model, creepage(delta));
        return compare(point, -point.force / full_force, reference, bound);
    };
    for (const Nodes nodes : {Nodes::centres, Nodes::chebyshev}) {
        const NodeDifference scheme{nodes};
        const std::string which = nodes == Nodes::centres ? "centres" : "Chebyshev points";
        for (const Eigen::Index n : {1, 2, 40, 400}) {
            const std::string where = " by " + which + ", n = " + std::to_string(n);
            const Mesh<double> mesh = rollbem::cosine_mesh(n);
            cases.right("creepage 1e9" + where, "force against full sliding",
                        [=] { return friction(mesh, scheme, 1e9, 1, 1e-12); });
            cases.right("creepage 1e-9" + where, "force against adhesion", [=] {
                const auto adhesion = rollbem::solve_steady<double>(mesh, scheme, plane);
                Outcome outcome = friction(mesh, scheme, 1e-9, adhesion.c11() * creepage(1e-9) / full_force, 1e-11);
                if (outcome.told.empty()) outcome.told = told_by(adhesion.status);
                return outcome;
            });
        }
        const Mesh<double> mesh = rollbem::cosine_mesh(40);
        for (const double delta : {0.01, 0.5, 0.8, 0.999}) {
            cases.right("creepage " + shown(delta) + " by " + which + ", n = 40", "force against Carter",
                        [=] { return friction(mesh, scheme, delta, rollbem::carter_force_ratio(delta), 5e-4); });
        }
        // independent bristles: exact on any uniform mesh
        for (const Eigen::Index n : {1, 3, 40}) {
            if (nodes == Nodes::chebyshev) continue;
            cases.right("layer 1e9 by " + which + ", uniform, n = " + std::to_string(n), "c11 against a brush", [=] {
                const auto solution =
                    rollbem::solve_steady<double>(rollbem::uniform_mesh(n), scheme, rollbem::LayeredKernel(plane, 1e9));
                return compare(solution, solution.c11(), 2e-9, 1e-8);
            });
        }
        // spin alone, all sliding: the traction is -mu p_n sign(x) across, but in the element that ends at x = 0
        cases.right("spin 1e9 by " + which + ", n = 40", "moment against full sliding", [=] {
            const rollbem::FrictionModel<rollbem::ConstantFriction<>, 2> model(
                contact,
                {steady_system(mesh, scheme, plane),
                 steady_system(mesh, scheme, PlaneKernel<double>::lateral(contact))},
                {1, peak * rollbem::mean_hertz_pressure(mesh)});
            const auto point = steady_from_rest(model, Vector{0, 0, creepage(1e9)});
            return compare(-point.force.moment / full_force, 4 / (3 * pi), 1e-2, told_by(point.status));
        });
    }
}

}  // namespace

void direction_cases(Cases& cases) {
    add_directions(cases);
    add_layers(cases);
    add_nodes(cases);
}

}  // namespace extremes
