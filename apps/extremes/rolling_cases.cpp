// Friction on elements at the edges of its domain: loads that vary, both directions of creepage, a third layer.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/elasticity/layered_kernel.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using rollbem::Contact;
using rollbem::HertzLoad;
using rollbem::Mesh;
using rollbem::PlaneKernel;
using rollbem::StepStatus;
using Load = rollbem::NormalLoad<double>;
using Model = rollbem::FrictionModel<double>;
using Motion = rollbem::RigidMotion<double>;
using Step = rollbem::FrictionStep<double>;
using Vector = rollbem::Creepage<double>;

constexpr double pi = std::numbers::pi;
constexpr double peak = 1e-3;                 // mu p0 / G
constexpr double full_force = peak * pi / 2;  // mu N under N_0
constexpr double half_width = 1000;           // b/a_0

Outcome compare(double value, double reference, double bound, const std::string& told = {}) {
    return {.value = value, .reference = reference, .error = value / reference - 1, .bound = bound, .told = told};
}

double creepage(double ratio, double nu = steel) { return 2 * (1 - nu) * peak * ratio; }

// --- a load that varies

/// Hertz's contact, a_0 = G = 1, on a mesh that breathes with it or covers `covered`. mu multiplies the bound alone.
struct Rolling {
    static Rolling breathing(const Mesh<double>& mesh, double mu = 1) { return {mesh, 0, mu, 1}; }
    static Rolling fixed(const Mesh<double>& mesh, double covered, double load_ratio = 1) {
        return {mesh, covered, 1, load_ratio};
    }

    /// load_ratio: of the line's own load, which sets p_0 and a_0, to the usual one.
    Rolling(const Mesh<double>& mesh, double covered, double mu, double load_ratio)
        : full(full_force * load_ratio),
          hertz(make_hertz(mesh, covered, full)),
          model(make_model(mesh, covered, mu, hertz.at(full).normal_pressure)),
          workspace(model.workspace()),
          now(model.at_rest()),
          next(now),
          load(hertz.at(full)) {}

    static HertzLoad<double> make_hertz(const Mesh<double>& mesh, double covered, double full) {
        const double modulus = 4 * full / (pi / 2);  // p_0 over that of unit load: a_0 = 1 whatever the load
        const rollbem::ElasticBody<double> body{.young_modulus = modulus, .poisson_ratio = 0};
        const rollbem::HertzLine<double> line(
            {.load_per_width = full, .combined_radius = 1, .body_1 = body, .body_2 = body});
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
    double force_ratio() const { return -step.force_per_width / full; }

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

void add_lift_off(std::vector<Case>& cases) {
    for (const int n : {1, 3, 40}) {
        const std::string elements = ", n = " + std::to_string(n);
        cases.push_back({"load from nothing" + elements, "force in full sliding against mu N", [=] {
                             Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(n), 1);
                             rolling.now.normal_pressure.setZero();
                             for (int k = 1; k <= 20; ++k) rolling.roll(0.1, 1e3, k / 20.0);
                             return rolling.against(1, 64 * rounding);
                         }});
        cases.push_back({"load to nothing" + elements, "traction left", [=] {
                             Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(n), 1);
                             rolling.settle(0.5);
                             for (int k = 9; k >= 0; --k) rolling.roll(0.1, 0.5, k / 10.0);
                             Outcome outcome{.value = rolling.now.traction.cwiseAbs().maxCoeff(),
                                             .reference = 0,
                                             .told = rolling.told};
                             outcome.error = outcome.value / peak;
                             return outcome;
                         }});
        cases.push_back({"load to nothing and back" + elements, "force against steady rolling on the mesh", [=] {
                             const Mesh<double> mesh = rollbem::uniform_mesh(n);
                             Rolling rolling = Rolling::fixed(mesh, 1);
                             rolling.settle(-0.8);
                             rolling.roll(0.01, 0.5, 0);  // at once, and for a while
                             for (int k = 0; k < 3; ++k) rolling.roll(0.5, 0.5, 0);
                             rolling.roll(0.01, 0.5, 1);
                             for (int k = 0; k < 60; ++k) rolling.roll(2, 0.5, 1);
                             return rolling.against(steady_ratio(mesh, 1, 0.5, 1), 1e-10);
                         }});
    }
    cases.push_back(
        {"load from nothing, oblique, without rolling", "force against k N", [] {
             // p = k p_n sticks everywhere; the shift is that of the middle, of Hertz's pressure times k
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
         }});
}

void add_growth(std::vector<Case>& cases) {
    // Against the same steps of Chebyshev states where all sticks, and of full sliding, where the force is mu N.
    for (const double way : {1.0, -1.0}) {
        for (const double part : {0.9, 1 - 1e-9}) {
            const std::string name = std::string("contact ") + (way > 0 ? "grows" : "shrinks") +
                                     ", |da|/dq = " + (part < 0.99 ? "0.9" : "1 - 1e-9");
            const auto half_length = [=](int k) { return 1 + way * part * 0.1 * k; };
            cases.push_back({name, "force in full sliding against mu N", [=] {
                                 Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(40));
                                 rolling.settle(1e3);
                                 for (int k = 1; k <= 5; ++k) {
                                     rolling.roll(0.1, 1e3, half_length(k) * half_length(k));
                                 }
                                 return rolling.against(half_length(5) * half_length(5), 1e-12);
                             }});
            cases.push_back(
                {name, "force in adhesion against Chebyshev states", [=] {
                     Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(160), 1e9);
                     const auto contact = Contact<double>::dimensionless(half_width, steel);
                     const rollbem::TransientModel<double> states(
                         contact,
                         rollbem::rolling_system(rollbem::Chebyshev{48}, PlaneKernel<double>::longitudinal(contact)),
                         rollbem::unchecked);
                     auto now = states.at_rest(), next = now;
                     double reference = nothing;
                     for (int k = 1; k <= 5; ++k) {
                         rolling.roll(0.1, 1, half_length(k) * half_length(k));
                         const auto step = states.advance(now, 0.1, creepage(1), half_length(k), next);
                         rolling.note(step.status);
                         reference = -step.force_per_width / full_force;
                         std::swap(now, next);
                     }
                     return rolling.against(reference, 2e-5);
                 }});
        }
        cases.push_back({std::string("contact ") + (way > 0 ? "grows" : "shrinks") + ", |da| = dq", "force",
                         [=] {
                             Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(40));
                             rolling.roll(0.125, 0.5, (1 + way * 0.125) * (1 + way * 0.125));
                             return rolling.against(1, 0);
                         },
                         "needs_fixed_mesh"});
    }
}

void add_loads(std::vector<Case>& cases) {
    // N_0 itself: pressures and moduli of the normal problem scale with it, and so do forces
    for (const double size : {1e-250, 1e-30, 1e30, 1e150}) {
        for (const bool breathes : {false, true}) {
            cases.push_back({"load " + shown(size) + (breathes ? ", breathing" : ", fixed mesh"),
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
                             }});
        }
    }
    // N/N_0: the contact becomes a point and a plain within one long step, and rolls on
    for (const double ratio : {1e-12, 1e-4, 100.0}) {
        cases.push_back({"load falls or grows to " + shown(ratio), "force by mu N against Carter", [=] {
                             Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(160));
                             const double a = std::sqrt(ratio), delta = 0.5 * a;  // full sliding goes with p_0
                             rolling.settle(delta);
                             rolling.roll(1.1 * std::abs(1 - a), delta, ratio);
                             for (int k = 0; k < 60; ++k) rolling.roll(2 * a, delta, ratio);
                             return rolling.against(ratio * 0.75, 1.2e-4);
                         }});
    }
    cases.push_back({"load 1e200", "force: its slip work overflows",
                     [] {
                         Rolling rolling(rollbem::uniform_mesh(20), 1.25, 1, 1e200);
                         rolling.roll(0.2, 0.5, 1);
                         return rolling.against(1, 0);
                     },
                     "not_finite"});
    for (const double load : {-1.0, nothing, infinity}) {
        for (const double covered : {0.0, 1.25}) {
            cases.push_back({"load " + shown(load) + (covered > 0 ? ", fixed mesh" : ", breathing"), "force",
                             [=] {
                                 Rolling rolling(rollbem::cosine_mesh(20), covered, 1, 1);
                                 rolling.roll(0.1, 0.5, load);
                                 return rolling.against(1, 0);
                             },
                             "invalid_load"});
        }
    }
    cases.push_back({"load 0, breathing", "force",
                     [] {
                         Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(20));
                         rolling.roll(0.1, 0.5, 0);
                         return rolling.against(1, 0);
                     },
                     "invalid_load"});
    cases.push_back({"load beyond what the mesh covers", "force",
                     [] {
                         Rolling rolling = Rolling::fixed(rollbem::uniform_mesh(20), 1.25);
                         rolling.roll(0.1, 0.5, 1.6);
                         return rolling.against(1, 0);
                     },
                     "invalid_load"});
}

void add_steps(std::vector<Case>& cases) {
    // Two discretisations agree on the force after a period, to 1e-4; elements add 2.3e-4 at n = 80.
    for (const double dq : {1e-3, 1e-2, 0.1}) {
        cases.push_back({"load by half, dq = " + shown(dq), "force after a period against two discretisations", [=] {
                             Rolling rolling = Rolling::breathing(rollbem::cosine_mesh(dq < 0.01 ? 40 : 80));
                             rolling.settle(0.5);
                             const int count = static_cast<int>(std::lround(8 / dq));
                             for (int k = 1; k <= count; ++k) {
                                 rolling.roll(8.0 / count, 0.5, 1 + 0.5 * std::sin(2 * pi * k / count));
                             }
                             return rolling.against(0.5494, 1e-3);
                         }});
    }
    // Steps longer than the contact: what is left of the start is gone after a few.
    for (const double dq : {10.0, 1e6}) {
        for (const int n : {3, 40}) {
            cases.push_back({"load by half, dq = " + shown(dq) + ", n = " + std::to_string(n),
                             "force against steady rolling on the mesh", [=] {
                                 const Mesh<double> mesh = rollbem::cosine_mesh(n);
                                 Rolling rolling = Rolling::breathing(mesh);
                                 rolling.settle(0.5);
                                 rolling.roll(dq, 0.5, 0.5);
                                 for (int k = 0; k < 12; ++k) rolling.roll(dq, 0.5, 1.5);
                                 return rolling.against(steady_ratio(mesh, 0, 0.5, 1.5), 1e-7);
                             }});
        }
    }
}

// --- both directions

struct Combined {
    Combined(const Mesh<double>& of, double ratio_nu, double layer_ = 0)
        : nu(ratio_nu), layer(layer_), contact(Contact<double>::dimensionless(infinity, nu)), mesh(of) {}

    /// G' of a direction, with the layer where there is one.
    Eigen::MatrixXd slopes(bool lateral) const {
        const auto kernel =
            lateral ? PlaneKernel<double>::lateral(contact) : PlaneKernel<double>::longitudinal(contact);
        if (layer == 0) return rollbem::assemble_G_prime(mesh, equal, kernel);
        return rollbem::assemble_G_prime(mesh, equal, rollbem::LayeredKernel(kernel, layer));
    }

    /// -F/(mu N) in both directions at the creepage ratio delta; the creepage's angle is given by its cosine and sine.
    Vector force(double delta, double cosine, double sine) {
        const rollbem::SteadyCombinedModel<double> model(contact, slopes(false), slopes(true), mesh.widths(),
                                                         {1, peak * rollbem::mean_hertz_pressure(mesh)});
        const auto rest = model.at_rest();
        auto state = rest;
        auto workspace = model.workspace();
        const double size = creepage(delta, nu);
        const auto point = model.solve(rest, {size * cosine, size * sine}, state, workspace);
        told = told_by(point.status);
        residual = point.complementarity_residual;
        return {-point.force_per_width.longitudinal / full_force, -point.force_per_width.lateral / full_force};
    }

    /// The same by the solver of one direction.
    double force_alone(bool lateral, double delta) const {
        const rollbem::SteadyFrictionModel<double> model(contact, slopes(lateral), mesh.widths(),
                                                         {1, peak * rollbem::mean_hertz_pressure(mesh)});
        const auto rest = model.at_rest();
        auto state = rest;
        auto workspace = model.workspace();
        const Step point = model.solve(rest, creepage(delta, nu), state, workspace);
        return point.status == StepStatus::ok ? -point.force_per_width / full_force : nothing;
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

void add_directions(std::vector<Case>& cases) {
    const Mesh<double> mesh = rollbem::cosine_mesh(40);
    for (const double nu : {0.0, steel, 0.5}) {
        const std::string end = ", nu = " + shown(nu);
        // Nearly in one direction: the force there is that of its own solver but for the square of the angle.
        for (const double angle : {0.0, 1e-12, 1e-6, 1e-3}) {
            for (const bool lateral : {false, true}) {
                cases.push_back({"creepage at " + shown(angle) + " rad to the " + (lateral ? "lateral" : "rolling") +
                                     " direction" + end,
                                 "force against one direction", [=] {
                                     Combined contact(mesh, nu);
                                     const double along = std::cos(angle), beside = std::sin(angle);
                                     const Vector force = lateral ? contact.force(0.5, beside, along)
                                                                  : contact.force(0.5, along, beside);
                                     return contact.against(lateral ? force.lateral : force.longitudinal,
                                                            contact.force_alone(lateral, 0.5), 1e-12 + angle * angle);
                                 }});
            }
        }
        // So little slip that no element of the mesh has its share: full adhesion.
        for (const bool lateral : {false, true}) {
            cases.push_back({"creepage 1e-6 at 45 degrees" + end,
                             lateral ? "lateral force against adhesion" : "force against adhesion", [=] {
                                 Combined contact(mesh, nu);
                                 const Vector force = contact.force(1e-6, std::sqrt(0.5), std::sqrt(0.5));
                                 const auto adhesion =
                                     rollbem::solve_steady<double>(contact.slopes(lateral), contact.mesh.widths());
                                 const double reference = adhesion.c11 * creepage(1e-6, nu) * std::sqrt(0.5);
                                 return contact.against((lateral ? force.lateral : force.longitudinal) * full_force,
                                                        reference, 1e-12);
                             }});
        }
        // All slips: against the creepage but for a part of the order of 1/delta, which only Poisson's ratio makes.
        for (const double delta : {1e3, 1e9}) {
            cases.push_back(
                {"creepage " + shown(delta) + " at 30 degrees" + end, "size of the force against mu N", [=] {
                     Combined contact(mesh, nu);
                     const Vector force = contact.force(delta, std::sqrt(0.75), 0.5);
                     return contact.against(std::hypot(force.longitudinal, force.lateral), 1,
                                            1e-12 + (nu > 0 ? 0.1 / (delta * delta) : 0));
                 }});
            cases.push_back(
                {"creepage " + shown(delta) + " at 30 degrees" + end, "lateral over longitudinal force", [=] {
                     Combined contact(mesh, nu);
                     const Vector force = contact.force(delta, std::sqrt(0.75), 0.5);
                     return contact.against(force.lateral / force.longitudinal, std::sqrt(1 / 3.0),
                                            1e-12 + (nu > 0 ? 0.1 / delta : 0));
                 }});
        }
    }
    // Without Poisson's ratio all angles are one, up to where the last element sticks.
    for (const double delta : {1e-6, 0.5, 0.999, 1.0}) {
        for (const double degrees : {1e-6, 30.0, 89.999}) {
            cases.push_back({"creepage " + shown(delta) + " at " + shown(degrees) + " degrees, nu = 0",
                             "size of the force against one direction", [=] {
                                 Combined contact(mesh, 0);
                                 const double angle = degrees * pi / 180;
                                 const Vector force = contact.force(delta, std::cos(angle), std::sin(angle));
                                 return contact.against(std::hypot(force.longitudinal, force.lateral),
                                                        contact.force_alone(false, delta), 1e-10);
                             }});
        }
    }
    // Across, Carter's creepage of full sliding is 1/(1 - nu) times as large.
    cases.push_back({"creepage 0.999 across, nu = 0.5", "lateral force against Carter", [] {
                         Combined contact(rollbem::cosine_mesh(160), 0.5);
                         return contact.against(contact.force(0.999, 0, 1).lateral, rollbem::carter_force_ratio(0.4995),
                                                1e-4);
                     }});
    cases.push_back({"creepage nan", "force",
                     [] {
                         Combined contact(rollbem::cosine_mesh(10), steel);
                         return contact.against(contact.force(nothing, 1, 0).longitudinal, 1, 0);
                     },
                     "not_finite"});
}

// --- a layer

void add_layers(std::vector<Case>& cases) {
    for (const int n : {3, 40}) {
        const Mesh<double> mesh = rollbem::uniform_mesh(n);
        const std::string elements = ", n = " + std::to_string(n);
        for (const double layer : {0.0, 1e-12}) {
            cases.push_back({"layer " + shown(layer) + elements, "force against none", [=] {
                                 Combined with(mesh, steel, layer), without(mesh, steel);
                                 return with.against(with.force_alone(false, 0.5), without.force_alone(false, 0.5),
                                                     1e-11);
                             }});
        }
        // Bristles of their own, p_i = -(xi/L) h (n - i) by upwind differences: c11 = (2/L)(1 + 1/n).
        for (const double layer : {1e6, 1e12}) {
            cases.push_back({"layer " + shown(layer) + elements, "c11 against a brush", [=] {
                                 const Combined contact(mesh, steel, layer);
                                 const auto solution =
                                     rollbem::solve_steady<double>(contact.slopes(false), mesh.widths());
                                 Outcome outcome = compare(solution.c11, 2 / layer * (1 + 1.0 / n), 3 / layer + 1e-13,
                                                           told_by(solution.status));
                                 outcome.residual = solution.residual;
                                 return outcome;
                             }});
        }
        // and alike in both directions, with friction too: of the ratio at which a brush has begun to slip
        cases.push_back({"layer 1e6, creepage at 60 degrees" + elements, "lateral over longitudinal force", [=] {
                             Combined contact(mesh, steel, 1e6);
                             const Vector force = contact.force(0.2 * 1e6, 0.5, std::sqrt(0.75));
                             return contact.against(force.lateral / force.longitudinal, std::sqrt(3.0), 1e-6);
                         }});
    }
    const auto refused = [&](double layer, const std::string& says) {
        cases.push_back({"layer " + shown(layer), "force",
                         [=] {
                             const Combined contact(rollbem::uniform_mesh(10), steel, layer);
                             return compare(contact.force_alone(false, 0.5), 1, 0);
                         },
                         says});
    };
    for (const double layer : {-1e-12, nothing, infinity}) refused(layer, "compliance");
}

}  // namespace

std::vector<Case> rolling_cases() {
    std::vector<Case> cases;
    add_lift_off(cases);
    add_growth(cases);
    add_loads(cases);
    add_steps(cases);
    add_directions(cases);
    add_layers(cases);
    return cases;
}

}  // namespace extremes
