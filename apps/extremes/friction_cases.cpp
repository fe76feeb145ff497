// Friction on elements at extreme parameter values: both directions of creepage, an elastic layer, node differences,
// falling friction, loads that vary.
#include <string>

#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using rollbem::HertzLine;
using rollbem::Mesh;
using rollbem::Nodes;
using rollbem::PlaneKernel;
using rollbem::Status;

/// Hertz's pressure on a plane contact.
struct Line {
    Mesh<double> mesh;
    double nu = steel;
    rollbem::AnyScheme scheme = equal;
    double layer = 0;

    rollbem::Contact contact() const { return rollbem::Contact::dimensionless(infinity, nu); }

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
        const rollbem::FrictionModel model(
            contact(), {{{}, slopes(false), mesh.widths()}, {{}, slopes(true), mesh.widths()}}, law());
        const double size = creepage(delta, nu);
        auto step = rollbem::Run(model).steady({.motion = {size * cosine, size * sine}});
        step.force = {-step.force.longitudinal / full_force, -step.force.lateral / full_force};
        return step;
    }
    /// A steady step by the solver of one direction, with its force as the longitudinal one.
    auto alone(bool lateral, double delta) const {
        const rollbem::FrictionModel model(contact(), {{}, slopes(lateral), mesh.widths()}, law(), lateral ? 1 : 0);
        const double xi = creepage(delta, nu);
        auto step = rollbem::Run(model).steady({.motion = {lateral ? 0 : xi, lateral ? xi : 0}});
        step.force.longitudinal = (lateral ? step.force.lateral : step.force.longitudinal) / -full_force;
        return step;
    }
    /// A steady step with friction that falls with slip to a share of mu, by half at a slip velocity over the rolling
    /// velocity.
    auto falling(double delta, double share, double half_velocity) const {
        const rollbem::ExponentialFall fall{1, share, half_velocity};
        const rollbem::FrictionModel model(contact(), rollbem::ElementSystem<double>({}, slopes(false), mesh.widths()),
                                           rollbem::unchecked, rollbem::Friction{fall, law().normal_pressure});
        auto step =
            rollbem::Run(model).steady({rollbem::Travel::at_speed(1.0), rollbem::Creepage{creepage(delta, nu)}});
        step.force.longitudinal /= -full_force;
        return step;
    }

private:
    rollbem::Friction law() const { return {1, peak * rollbem::mean_hertz_pressure(mesh)}; }
};

// The force of a step in one direction; in both its size, and lateral over longitudinal.
Outcome against(const auto& step, double reference, double bound) {
    return compare(step, step.force.longitudinal, reference, bound);
}
Outcome size_against(const auto& step, double reference, double bound) {
    return compare(step, std::hypot(step.force.longitudinal, step.force.lateral), reference, bound);
}
Outcome direction_against(const auto& step, double reference, double bound) {
    return compare(step, step.force.lateral / step.force.longitudinal, reference, bound);
}

void add_directions(Cases& cases) {
    for (const double nu : {0.0, steel, 0.5}) {
        const Line line{rollbem::cosine_mesh(40), nu};
        const std::string end = ", nu = " + shown(nu);
        for (const bool lateral : {false, true}) {
            const auto along = [=](const auto& step) { return lateral ? step.force.lateral : step.force.longitudinal; };
            // The force nearly in one direction differs from the force by the solver of that direction by the square of
            // the angle.
            for (const double angle : {0.0, 1e-12, 1e-6, 1e-3}) {
                cases.add("creepage at " + shown(angle) + " rad to the " + (lateral ? "lateral" : "rolling") +
                              " direction" + end,
                          "force against one direction", [=] {
                              const double own = std::cos(angle), beside = std::sin(angle);
                              const auto step = lateral ? line.both(0.5, beside, own) : line.both(0.5, own, beside);
                              return compare(step, along(step), line.alone(lateral, 0.5).force.longitudinal,
                                             1e-12 + angle * angle);
                          });
            }
            // The slip zone is smaller than any element of the mesh: full adhesion.
            cases.add("creepage 1e-6 at 45 degrees" + end,
                      lateral ? "lateral force against adhesion" : "force against adhesion", [=] {
                          const auto step = line.both(1e-6, std::sqrt(0.5), std::sqrt(0.5));
                          const double xi = creepage(1e-6, nu) * std::sqrt(0.5);
                          return compare(step, along(step) * full_force, line.adhesion(lateral) * xi, 1e-12);
                      });
        }
        // Full sliding: the force opposes the creepage but for a part of order 1/delta due to Poisson's ratio.
        for (const double delta : {1e3, 1e9}) {
            const std::string name = "creepage " + shown(delta) + " at 30 degrees" + end;
            const double turned = nu > 0 ? 0.1 / delta : 0;
            cases.add(name, "size of the force against mu N",
                      [=] { return size_against(line.both(delta, std::sqrt(0.75), 0.5), 1, 1e-12 + turned / delta); });
            cases.add(name, "lateral over longitudinal force", [=] {
                return direction_against(line.both(delta, std::sqrt(0.75), 0.5), std::sqrt(1 / 3.0), 1e-12 + turned);
            });
        }
    }
    // With a Poisson's ratio of 0 all directions are equivalent, until the last element slips.
    for (const double delta : {1e-6, 0.5, 0.999, 1.0}) {
        for (const double degrees : {1e-6, 30.0, 89.999}) {
            cases.add("creepage " + shown(delta) + " at " + shown(degrees) + " degrees, nu = 0",
                      "size of the force against one direction", [=] {
                          const Line line{rollbem::cosine_mesh(40), 0};
                          const double angle = degrees * pi / 180;
                          return size_against(line.both(delta, std::cos(angle), std::sin(angle)),
                                              line.alone(false, delta).force.longitudinal, 1e-10);
                      });
        }
    }
    // Across, Carter's creepage of full sliding is 1/(1 - nu) times as large.
    cases.add("creepage 0.999 across, nu = 0.5", "lateral force against Carter", [] {
        const auto step = Line{rollbem::cosine_mesh(160), 0.5}.both(0.999, 0, 1);
        return compare(step, step.force.lateral, rollbem::carter_force_ratio(0.4995), 1e-4);
    });
}

void add_layers(Cases& cases) {
    for (const int n : {3, 40}) {
        const std::string elements = ", n = " + std::to_string(n);
        const auto with = [n](double layer) { return Line{rollbem::uniform_mesh(n), steel, equal, layer}; };
        cases.add("layer 1e-12" + elements, "force against none", [=] {
            return against(with(1e-12).alone(false, 0.5), with(0).alone(false, 0.5).force.longitudinal, 1e-11);
        });
        // Independent bristles, p_i = -(xi/L) h (n - i) by upwind differences: c11 = (2/L)(1 + 1/n).
        for (const double layer : {1e6, 1e12}) {
            cases.add("layer " + shown(layer) + elements, "c11 against a brush", [=] {
                const double brush = 2 / layer * (1 + 1.0 / n);
                return compare(with(layer).adhesion(false), brush, 3 / layer + 1e-13);
            });
        }
        // the layer is the same in both directions, also with friction: at this ratio the brush has begun to slip
        cases.add("layer 1e6, creepage at 60 degrees" + elements, "lateral over longitudinal force", [=] {
            return direction_against(with(1e6).both(0.2 * 1e6, 0.5, std::sqrt(0.75)), std::sqrt(3.0), 1e-6);
        });
    }
}

void add_nodes(Cases& cases) {
    for (const auto& [nodes, which] : {std::pair{Nodes::centres, "centres"}, {Nodes::chebyshev, "Chebyshev points"}}) {
        const auto on = [nodes = nodes](Eigen::Index n) {
            return Line{rollbem::cosine_mesh(n), steel, rollbem::NodeDifference{nodes}};
        };
        for (const Eigen::Index n : {1, 2, 40, 400}) {
            const std::string where = std::string(" by ") + which + ", n = " + std::to_string(n);
            cases.add("creepage 1e9" + where, "force against full sliding",
                      [=] { return against(on(n).alone(false, 1e9), 1, 1e-12); });
            cases.add("creepage 1e-9" + where, "force against adhesion", [=] {
                return against(on(n).alone(false, 1e-9), on(n).adhesion(false) * creepage(1e-9) / full_force, 1e-11);
            });
        }
        cases.add(std::string("creepage 0.999 by ") + which + ", n = 40", "force against Carter",
                  [=] { return against(on(40).alone(false, 0.999), rollbem::carter_force_ratio(0.999), 5e-4); });
    }
}

void add_falling(Cases& cases) {
    const Line line{rollbem::cosine_mesh(40)};
    for (const double delta : {1e-6, 0.5, 1e3}) {
        const std::string name = "creepage " + shown(delta) + ", friction ";
        const auto add = [&](const std::string& falls, double share, double velocity, double reference) {
            cases.add(name + falls, "force against constant friction",
                      [=] { return against(line.falling(delta, share, velocity), reference, 1e-10); });
        };
        const double constant = line.alone(false, delta).force.longitudinal;
        add("that falls to itself", 1, 1e-3, constant);
        add("that falls at 1e12 of the speed", 0.5, 1e12, constant);
    }
    for (const double velocity : {1e-12, 1e-3}) {
        cases.add("creepage 1e6, friction that falls at " + shown(velocity) + " of the speed",
                  "force against what is left of mu N",
                  [=] { return against(line.falling(1e6, 0.3, velocity), 0.3, 1e-12); });
    }
}

// --- loads that vary

constexpr double half_width = 1000;  // b/a_0

/// Hertz's contact, a_0 = G = 1, on a mesh that covers `covered` or, if that is 0, breathes with it. mu multiplies only
/// the bound. load_ratio: the reference load, which sets p_0 and a_0, over the usual one.
class Rolling {
public:
    explicit Rolling(const Mesh<double>& mesh, double covered = 0, double mu = 1, double load_ratio = 1)
        : full_(full_force * load_ratio),
          hertz_(make_hertz(mesh, covered)),
          load_(hertz_.at(full_)),
          model_(make_model(mesh, covered, mu)),
          run_(model_) {}
    Rolling(const Rolling&) = delete;

    void settle(double ratio, double load_ratio = 1) {
        note(hertz_.set(load_ratio * full_, load_));
        keep(run_.steady({.motion = scaled(ratio), .load = load_}));
    }
    void roll(double dq, double ratio, double load_ratio) {
        note(hertz_.set(load_ratio * full_, load_));
        keep(run_.advance({dq, scaled(ratio), load_}));
    }
    void note(Status status) {
        if (told_.empty()) told_ = told_by(status);
    }
    auto& state() { return run_.now(); }

    /// -F/(mu N_0)
    double force_ratio() const { return -force_ / (full_ * 2 * half_width); }

    Outcome against(double reference, double bound) const {
        Outcome outcome = compare(force_ratio(), reference, bound, told_);
        outcome.residual = residual_;
        return outcome;
    }
    Outcome traction_left() {
        const double largest = state().traction.cwiseAbs().maxCoeff();
        return {.value = largest, .reference = 0, .error = largest / peak, .told = told_};
    }

private:
    using Model = rollbem::FrictionModel;

    HertzLine::Load make_hertz(const Mesh<double>& mesh, double covered) const {
        const auto line = rollbem::HertzLine::dimensionless(full_ / (pi / 2));
        return covered > 0 ? HertzLine::Load::fixed(line, mesh, covered) : HertzLine::Load::breathing(line, mesh);
    }
    Model make_model(const Mesh<double>& mesh, double covered, double mu) const {
        const rollbem::Contact contact({.half_length = covered > 0 ? covered : 1,
                                        .half_width = half_width,
                                        .shear_modulus = 1,
                                        .poisson_ratio = steel});
        return {contact,
                rollbem::rolling_system(mesh, equal, PlaneKernel<double>::longitudinal(contact)),
                rollbem::unchecked,
                {mu, load_.normal_pressure}};
    }
    rollbem::Creepage scaled(double ratio) const { return {creepage(ratio) * full_ / full_force}; }
    void keep(const Model::Step& step) {
        note(step.status);
        force_ = step.force.longitudinal;
        residual_ = step.complementarity_residual;
    }

    double full_;
    HertzLine::Load hertz_;
    rollbem::NormalLoad load_;
    Model model_;
    rollbem::Run<Model> run_;
    double force_ = nothing, residual_ = nothing;
    std::string told_;
};

double steady_ratio(const Mesh<double>& mesh, double covered, double ratio, double load_ratio) {
    Rolling rolling(mesh, covered);
    rolling.settle(ratio, load_ratio);
    return rolling.force_ratio();
}

void add_lift_off(Cases& cases) {
    for (const int n : {1, 3, 40}) {
        const std::string elements = ", n = " + std::to_string(n);
        const auto mesh = rollbem::uniform_mesh(n);
        cases.add("load from nothing" + elements, "force in full sliding against mu N", [=] {
            Rolling rolling(mesh, 1);
            rolling.state().normal_pressure.setZero();
            for (int k = 1; k <= 20; ++k) rolling.roll(0.1, 1e3, k / 20.0);
            return rolling.against(1, 64 * rounding);
        });
        cases.add("load to nothing" + elements, "traction left", [=] {
            Rolling rolling(mesh, 1);
            rolling.settle(0.5);
            for (int k = 9; k >= 0; --k) rolling.roll(0.1, 0.5, k / 10.0);
            return rolling.traction_left();
        });
        cases.add("load to nothing and back" + elements, "force against steady rolling on the mesh", [=] {
            Rolling rolling(mesh, 1);
            rolling.settle(-0.8);
            rolling.roll(0.01, 0.5, 0);  // suddenly, then for a while
            for (int k = 0; k < 3; ++k) rolling.roll(0.5, 0.5, 0);
            rolling.roll(0.01, 0.5, 1);
            for (int k = 0; k < 60; ++k) rolling.roll(2, 0.5, 1);
            return rolling.against(steady_ratio(mesh, 1, 0.5, 1), 1e-10);
        });
    }
}

/// The outcome in full adhesion, against the same steps of Chebyshev states.
Outcome grown_in_adhesion(const std::function<double(int)>& half_length) {
    Rolling rolling(rollbem::cosine_mesh(160), 0, 1e9);
    const auto contact = rollbem::Contact::dimensionless(half_width, steel);
    const rollbem::AdhesionModel<> model(
        contact, rolling_system(rollbem::Chebyshev{48}, PlaneKernel<double>::longitudinal(contact)),
        rollbem::unchecked);
    rollbem::Run states(model);
    double reference = nothing;
    for (int k = 1; k <= 5; ++k) {
        rolling.roll(0.1, 1, half_length(k) * half_length(k));
        const auto step = states.advance({0.1, creepage(1), half_length(k)});
        rolling.note(step.status);
        reference = -step.force_per_width / full_force;
    }
    return rolling.against(reference, 2e-5);
}

void add_growth(Cases& cases) {
    for (const double way : {1.0, -1.0}) {
        const std::string grows = std::string("contact ") + (way > 0 ? "grows" : "shrinks");
        for (const double part : {0.9, 1 - 1e-9}) {
            const std::string name = grows + ", |da|/dq = " + (part < 0.99 ? "0.9" : "1 - 1e-9");
            const auto half_length = [=](int k) { return 1 + way * part * 0.1 * k; };
            cases.add(name, "force in full sliding against mu N", [=] {
                Rolling rolling(rollbem::cosine_mesh(40));
                rolling.settle(1e3);
                for (int k = 1; k <= 5; ++k) rolling.roll(0.1, 1e3, half_length(k) * half_length(k));
                return rolling.against(half_length(5) * half_length(5), 1e-12);
            });
            cases.add(name, "force in adhesion against Chebyshev states",
                      [=] { return grown_in_adhesion(half_length); });
        }
    }
}

/// The force after a period of a load that varies by half.
void roll_a_period(Rolling& rolling, int count) {
    rolling.settle(0.5);
    for (int k = 1; k <= count; ++k) rolling.roll(8.0 / count, 0.5, 1 + 0.5 * std::sin(2 * pi * k / count));
}

void add_loads(Cases& cases) {
    // N_0 itself: pressures and moduli of the normal problem scale with it, and so do the forces
    for (const double size : {1e-250, 1e-30, 1e30, 1e150}) {
        for (const bool breathes : {false, true}) {
            cases.add("load " + shown(size) + (breathes ? ", breathing" : ", fixed mesh"),
                      "force after a period against that of the load 1", [=] {
                          const auto mesh = breathes ? rollbem::cosine_mesh(20) : rollbem::uniform_mesh(20);
                          Rolling own(mesh, breathes ? 0 : 1.25, 1, size), one(mesh, breathes ? 0 : 1.25);
                          roll_a_period(own, 40);
                          roll_a_period(one, 40);
                          return own.against(one.force_ratio(), 1e-10);
                      });
        }
    }
    // N/N_0: within one long step the contact becomes tiny or huge, and then rolls on
    for (const double ratio : {1e-12, 1e-4, 100.0}) {
        cases.add("load falls or grows to " + shown(ratio), "force by mu N against Carter", [=] {
            Rolling rolling(rollbem::cosine_mesh(160));
            const double a = std::sqrt(ratio), delta = 0.5 * a;  // full sliding scales with p_0
            rolling.settle(delta);
            rolling.roll(1.1 * std::abs(1 - a), delta, ratio);
            for (int k = 0; k < 60; ++k) rolling.roll(2 * a, delta, ratio);
            return rolling.against(ratio * 0.75, 1.2e-4);
        });
    }
    cases.add(
        "load 1e200", "force: its slip work overflows",
        [] {
            Rolling rolling(rollbem::uniform_mesh(20), 1.25, 1, 1e200);
            rolling.roll(0.2, 0.5, 1);
            return rolling.against(1, 0);
        },
        "not_finite");
    // Two discretisations agree on the force after a period to 1e-4; elements add 2.3e-4 at n = 80.
    for (const double dq : {1e-3, 1e-2, 0.1}) {
        cases.add("load by half, dq = " + shown(dq), "force after a period against two discretisations", [=] {
            Rolling rolling(rollbem::cosine_mesh(dq < 0.01 ? 40 : 80));
            roll_a_period(rolling, static_cast<int>(std::lround(8 / dq)));
            return rolling.against(0.5494, 1e-3);
        });
    }
    // Steps longer than the contact: the initial state is forgotten after a few of them.
    for (const double dq : {10.0, 1e6}) {
        for (const int n : {3, 40}) {
            cases.add("load by half, dq = " + shown(dq) + ", n = " + std::to_string(n),
                      "force against steady rolling on the mesh", [=] {
                          const auto mesh = rollbem::cosine_mesh(n);
                          Rolling rolling(mesh);
                          rolling.settle(0.5);
                          rolling.roll(dq, 0.5, 0.5);
                          for (int k = 0; k < 12; ++k) rolling.roll(dq, 0.5, 1.5);
                          return rolling.against(steady_ratio(mesh, 0, 0.5, 1.5), 1e-7);
                      });
        }
    }
}

}  // namespace

void friction_cases(Cases& cases) {
    add_directions(cases);
    add_layers(cases);
    add_nodes(cases);
    add_falling(cases);
    add_lift_off(cases);
    add_growth(cases);
    add_loads(cases);
}

}  // namespace extremes
