// Friction on elements at the edges of its domain: loads that vary.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "cases.hpp"
#include "friction_scale.hpp"

namespace extremes {

namespace {

using rollbem::Contact;
using rollbem::HertzLoad;
using rollbem::Mesh;
using rollbem::PlaneKernel;
using rollbem::StepStatus;
using Load = rollbem::NormalLoad<double>;
using Model = rollbem::FrictionModel<>;
using Motion = rollbem::RigidMotion<double>;
using Step = rollbem::FrictionStep<>;

constexpr double half_width = 1000;  // b/a_0

/// Hertz's contact, a_0 = G = 1, on a mesh that breathes with it or covers `covered`. mu multiplies only the bound.
struct Rolling {
    static Rolling breathing(const Mesh<double>& mesh, double mu = 1) { return {mesh, 0, mu, 1}; }
    static Rolling fixed(const Mesh<double>& mesh, double covered, double load_ratio = 1) {
        return {mesh, covered, 1, load_ratio};
    }

    /// load_ratio: the reference load, which sets p_0 and a_0, over the usual one.
    Rolling(const Mesh<double>& mesh, double covered, double mu, double load_ratio)
        : full(full_force * load_ratio),
          hertz(make_hertz(mesh, covered, full)),
          model(make_model(mesh, covered, mu, hertz.at(full).normal_pressure)),
          workspace(model.workspace()),
          now(model.at_rest()),
          next(now),
          load(hertz.at(full)) {}

    static HertzLoad<double> make_hertz(const Mesh<double>& mesh, double covered, double full) {
        const auto line = rollbem::HertzLine<double>::dimensionless(full / (pi / 2));
        return covered > 0 ? HertzLoad<double>::fixed(line, mesh, covered) : HertzLoad<double>::breathing(line, mesh);
    }
    static Model make_model(const Mesh<double>& mesh, double covered, double mu, const Eigen::ArrayXd& pressure) {
        const Contact<double> contact({.half_length = covered > 0 ? covered : 1,
                                       .half_width = half_width,
                                       .shear_modulus = 1,
                                       .poisson_ratio = steel});
        return {contact,
                rollbem::rolling_system(mesh, equal, PlaneKernel<double>::longitudinal(contact)),
                rollbem::unchecked,
                {mu, pressure}};
    }

    void settle(double ratio, double load_ratio = 1) {
        note(hertz.set(load_ratio * full, load));
        keep(model.steady(now, creepage(ratio) * full / full_force, load, next, workspace));
    }
    void roll(double dq, double ratio, double load_ratio) {
        note(hertz.set(load_ratio * full, load));
        keep(model.advance(now, dq, Motion(creepage(ratio) * full / full_force), load, next, workspace));
    }
    void keep(const Step& result) {
        note(result.status);
        step = result;
        std::swap(now, next);
    }
    void note(StepStatus status) {
        if (told.empty()) told = told_by(status);
    }

    /// -F/(mu N_0)
    double force_ratio() const { return -step.force / (full * 2 * half_width); }

    Outcome against(double reference, double bound) const {
        Outcome outcome = compare(force_ratio(), reference, bound, told);
        outcome.residual = step.complementarity_residual;
        return outcome;
    }

    double full;
    HertzLoad<double> hertz;
    Model model;
    Model::Workspace workspace;
    Model::State now, next;
    Load load;
    Step step;
    std::string told;
};

double steady_ratio(const Mesh<double>& mesh, double covered, double ratio, double load_ratio) {
    Rolling rolling(mesh, covered, 1, 1);
    rolling.settle(ratio, load_ratio);
    return rolling.told.empty() ? rolling.force_ratio() : nothing;
}

void add_lift_off(Cases& cases) {
    for (const int n : {1, 3, 40}) {
        const std::string elements = ", n = " + std::to_string(n);
        cases.right("load from nothing" + elements, "force in full sliding against mu N", [=] {
            Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(n), 1);
            rolling.now.normal_pressure.setZero();
            for (int k = 1; k <= 20; ++k) rolling.roll(0.1, 1e3, k / 20.0);
            return rolling.against(1, 64 * rounding);
        });
        cases.right("load to nothing" + elements, "traction left", [=] {
            Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(n), 1);
            rolling.settle(0.5);
            for (int k = 9; k >= 0; --k) rolling.roll(0.1, 0.5, k / 10.0);
            Outcome outcome{.value = rolling.now.traction.cwiseAbs().maxCoeff(), .reference = 0, .told = rolling.told};
            outcome.error = outcome.value / peak;
            return outcome;
        });
        cases.right("load to nothing and back" + elements, "force against steady rolling on the mesh", [=] {
            const Mesh<double> mesh = rollbem::uniform_mesh(n);
            Rolling rolling = Rolling::fixed(mesh, 1);
            rolling.settle(-0.8);
            rolling.roll(0.01, 0.5, 0);  // suddenly, then for a while
            for (int k = 0; k < 3; ++k) rolling.roll(0.5, 0.5, 0);
            rolling.roll(0.01, 0.5, 1);
            for (int k = 0; k < 60; ++k) rolling.roll(2, 0.5, 1);
            return rolling.against(steady_ratio(mesh, 1, 0.5, 1), 1e-10);
        });
    }
    cases.right("load from nothing, oblique, without rolling", "force against k N", [] {
        // p = k p_n sticks everywhere; the shift is the displacement of the middle under k times Hertz's pressure
        constexpr double k = 0.6;
        const auto shift = [](double a) {
            const double logarithm = a > 0 ? std::log(4 * half_width / a) : 0.0;
            return k * peak * a * a * ((1 - steel) * (logarithm + 0.5) + steel);
        };
        const Mesh<double> mesh = rollbem::uniform_mesh(40);
        Rolling rolling = Rolling::fixed(mesh, 1);
        const Contact<double> contact = Contact<double>::dimensionless(half_width, steel);
        const Model centred(contact,
                            rollbem::rolling_system(mesh, rollbem::Collocation{.alpha_L = 0, .alpha_T = 0},
                                                    PlaneKernel<double>::longitudinal(contact)),
                            rollbem::unchecked, {1, rolling.load.normal_pressure});
        Model::State now = centred.at_rest(), next = now;
        now.normal_pressure.setZero();
        double before = 0;
        for (int i = 1; i <= 80; ++i) {
            rolling.note(rolling.hertz.set(full_force * i / 80, rolling.load));
            const double after = shift(std::sqrt(i / 80.0));
            rolling.step =
                centred.advance(now, 0, Motion::shift(after - before), rolling.load, next, rolling.workspace);
            rolling.note(rolling.step.status);
            before = after;
            std::swap(now, next);
        }
        return rolling.against(k, 5e-3);
    });
}

void add_growth(Cases& cases) {
    // In full adhesion, against the same steps of Chebyshev states; in full sliding the force is mu N.
    for (const double way : {1.0, -1.0}) {
        for (const double part : {0.9, 1 - 1e-9}) {
            const std::string name = std::string("contact ") + (way > 0 ? "grows" : "shrinks") +
                                     ", |da|/dq = " + (part < 0.99 ? "0.9" : "1 - 1e-9");
            const auto half_length = [=](int k) { return 1 + way * part * 0.1 * k; };
            cases.right(name, "force in full sliding against mu N", [=] {
                Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(40));
                rolling.settle(1e3);
                for (int k = 1; k <= 5; ++k) {
                    rolling.roll(0.1, 1e3, half_length(k) * half_length(k));
                }
                return rolling.against(half_length(5) * half_length(5), 1e-12);
            });
            cases.right(name, "force in adhesion against Chebyshev states", [=] {
                Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(160), 1e9);
                const auto contact = Contact<double>::dimensionless(half_width, steel);
                const rollbem::AdhesionModel<> states(
                    contact,
                    rollbem::rolling_system(rollbem::Chebyshev{48}, PlaneKernel<double>::longitudinal(contact)),
                    rollbem::unchecked);
                auto now = states.at_rest(), next = now;
                auto workspace = states.workspace();
                double reference = nothing;
                for (int k = 1; k <= 5; ++k) {
                    rolling.roll(0.1, 1, half_length(k) * half_length(k));
                    const auto step = states.advance(now, 0.1, creepage(1), half_length(k), next, workspace);
                    rolling.note(step.status);
                    reference = -step.force_per_width / full_force;
                    std::swap(now, next);
                }
                return rolling.against(reference, 2e-5);
            });
        }
        cases.told(std::string("contact ") + (way > 0 ? "grows" : "shrinks") + ", |da| = dq", "force",
                   "needs_fixed_mesh", [=] {
                       Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(40));
                       rolling.roll(0.125, 0.5, (1 + way * 0.125) * (1 + way * 0.125));
                       return rolling.against(1, 0);
                   });
    }
}

void add_loads(Cases& cases) {
    // N_0 itself: pressures and moduli of the normal problem scale with it, and so do the forces
    for (const double size : {1e-250, 1e-30, 1e30, 1e150}) {
        for (const bool breathes : {false, true}) {
            cases.right("load " + shown(size) + (breathes ? ", breathing" : ", fixed mesh"),
                        "force after a period against that of the load 1", [=] {
                            const auto end = [&](double load) {
                                const Mesh<double> mesh =
                                    breathes ? rollbem::cosine_mesh(20) : rollbem::uniform_mesh(20);
                                Rolling rolling(mesh, breathes ? 0 : 1.25, 1, load);
                                rolling.settle(0.5);
                                for (int k = 1; k <= 40; ++k) {
                                    rolling.roll(0.2, 0.5, 1 + 0.5 * std::sin(pi * k / 20));
                                }
                                return rolling;
                            };
                            return end(size).against(end(1).force_ratio(), 1e-10);
                        });
        }
    }
    // N/N_0: within one long step the contact becomes tiny or huge, and then rolls on
    for (const double ratio : {1e-12, 1e-4, 100.0}) {
        cases.right("load falls or grows to " + shown(ratio), "force by mu N against Carter", [=] {
            Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(160));
            const double a = std::sqrt(ratio), delta = 0.5 * a;  // full sliding scales with p_0
            rolling.settle(delta);
            rolling.roll(1.1 * std::abs(1 - a), delta, ratio);
            for (int k = 0; k < 60; ++k) rolling.roll(2 * a, delta, ratio);
            return rolling.against(ratio * 0.75, 1.2e-4);
        });
    }
    cases.told("load 1e200", "force: its slip work overflows", "not_finite", [] {
        Rolling rolling(rollbem::uniform_mesh(20), 1.25, 1, 1e200);
        rolling.roll(0.2, 0.5, 1);
        return rolling.against(1, 0);
    });
    for (const double load : {-1.0, nothing, infinity}) {
        for (const double covered : {0.0, 1.25}) {
            cases.told("load " + shown(load) + (covered > 0 ? ", fixed mesh" : ", breathing"), "force", "invalid_load",
                       [=] {
                           Rolling rolling(rollbem::cosine_mesh(20), covered, 1, 1);
                           rolling.roll(0.1, 0.5, load);
                           return rolling.against(1, 0);
                       });
        }
    }
    cases.told("load 0, breathing", "force", "invalid_load", [] {
        Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(20));
        rolling.roll(0.1, 0.5, 0);
        return rolling.against(1, 0);
    });
    cases.told("load beyond what the mesh covers", "force", "invalid_load", [] {
        Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(20), 1.25);
        rolling.roll(0.1, 0.5, 1.6);
        return rolling.against(1, 0);
    });
}

void add_load_steps(Cases& cases) {
    // Two discretisations agree on the force after a period to 1e-4; elements add 2.3e-4 at n = 80.
    for (const double dq : {1e-3, 1e-2, 0.1}) {
        cases.right("load by half, dq = " + shown(dq), "force after a period against two discretisations", [=] {
            Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(dq < 0.01 ? 40 : 80));
            rolling.settle(0.5);
            const int count = static_cast<int>(std::lround(8 / dq));
            for (int k = 1; k <= count; ++k) {
                rolling.roll(8.0 / count, 0.5, 1 + 0.5 * std::sin(2 * pi * k / count));
            }
            return rolling.against(0.5494, 1e-3);
        });
    }
    // Steps longer than the contact: the initial state is forgotten after a few of them.
    for (const double dq : {10.0, 1e6}) {
        for (const int n : {3, 40}) {
            cases.right("load by half, dq = " + shown(dq) + ", n = " + std::to_string(n),
                        "force against steady rolling on the mesh", [=] {
                            const Mesh<double> mesh = rollbem::cosine_mesh(n);
                            Rolling rolling = Rolling::breathing(mesh);
                            rolling.settle(0.5);
                            rolling.roll(dq, 0.5, 0.5);
                            for (int k = 0; k < 12; ++k) rolling.roll(dq, 0.5, 1.5);
                            return rolling.against(steady_ratio(mesh, 0, 0.5, 1.5), 1e-7);
                        });
        }
    }
}

}  // namespace

void load_cases(Cases& cases) {
    add_lift_off(cases);
    add_growth(cases);
    add_loads(cases);
    add_load_steps(cases);
}

}  // namespace extremes
