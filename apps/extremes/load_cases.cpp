// Friction on elements under loads that vary at extreme parameter values.
#include <string>

#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "cases.hpp"

namespace extremes {

namespace {

using rollbem::HertzLoad;
using rollbem::Mesh;
using rollbem::PlaneKernel;
using rollbem::StepStatus;

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
    void note(StepStatus status) {
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
    using Model = rollbem::FrictionModel<>;

    HertzLoad<double> make_hertz(const Mesh<double>& mesh, double covered) const {
        const auto line = rollbem::HertzLine<double>::dimensionless(full_ / (pi / 2));
        return covered > 0 ? HertzLoad<double>::fixed(line, mesh, covered) : HertzLoad<double>::breathing(line, mesh);
    }
    Model make_model(const Mesh<double>& mesh, double covered, double mu) const {
        const rollbem::Contact<double> contact({.half_length = covered > 0 ? covered : 1,
                                                .half_width = half_width,
                                                .shear_modulus = 1,
                                                .poisson_ratio = steel});
        return {contact,
                rollbem::rolling_system(mesh, equal, PlaneKernel<double>::longitudinal(contact)),
                rollbem::unchecked,
                {mu, load_.normal_pressure}};
    }
    double scaled(double ratio) const { return creepage(ratio) * full_ / full_force; }
    void keep(const Model::Step& step) {
        note(step.status);
        force_ = step.force;
        residual_ = step.complementarity_residual;
    }

    double full_;
    HertzLoad<double> hertz_;
    rollbem::NormalLoad<double> load_;
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
        cases.push_back({"load from nothing" + elements, "force in full sliding against mu N", [=] {
                             Rolling rolling(mesh, 1);
                             rolling.state().normal_pressure.setZero();
                             for (int k = 1; k <= 20; ++k) rolling.roll(0.1, 1e3, k / 20.0);
                             return rolling.against(1, 64 * rounding);
                         }});
        cases.push_back({"load to nothing" + elements, "traction left", [=] {
                             Rolling rolling(mesh, 1);
                             rolling.settle(0.5);
                             for (int k = 9; k >= 0; --k) rolling.roll(0.1, 0.5, k / 10.0);
                             return rolling.traction_left();
                         }});
        cases.push_back({"load to nothing and back" + elements, "force against steady rolling on the mesh", [=] {
                             Rolling rolling(mesh, 1);
                             rolling.settle(-0.8);
                             rolling.roll(0.01, 0.5, 0);  // suddenly, then for a while
                             for (int k = 0; k < 3; ++k) rolling.roll(0.5, 0.5, 0);
                             rolling.roll(0.01, 0.5, 1);
                             for (int k = 0; k < 60; ++k) rolling.roll(2, 0.5, 1);
                             return rolling.against(steady_ratio(mesh, 1, 0.5, 1), 1e-10);
                         }});
    }
}

/// In full adhesion, against the same steps of Chebyshev states.
Outcome grown_in_adhesion(const std::function<double(int)>& half_length) {
    Rolling rolling(rollbem::cosine_mesh(160), 0, 1e9);
    const auto contact = rollbem::Contact<double>::dimensionless(half_width, steel);
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
            cases.push_back({name, "force in full sliding against mu N", [=] {
                                 Rolling rolling(rollbem::cosine_mesh(40));
                                 rolling.settle(1e3);
                                 for (int k = 1; k <= 5; ++k) rolling.roll(0.1, 1e3, half_length(k) * half_length(k));
                                 return rolling.against(half_length(5) * half_length(5), 1e-12);
                             }});
            cases.push_back(
                {name, "force in adhesion against Chebyshev states", [=] { return grown_in_adhesion(half_length); }});
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
            cases.push_back({"load " + shown(size) + (breathes ? ", breathing" : ", fixed mesh"),
                             "force after a period against that of the load 1", [=] {
                                 const auto mesh = breathes ? rollbem::cosine_mesh(20) : rollbem::uniform_mesh(20);
                                 Rolling own(mesh, breathes ? 0 : 1.25, 1, size), one(mesh, breathes ? 0 : 1.25);
                                 roll_a_period(own, 40);
                                 roll_a_period(one, 40);
                                 return own.against(one.force_ratio(), 1e-10);
                             }});
        }
    }
    // N/N_0: within one long step the contact becomes tiny or huge, and then rolls on
    for (const double ratio : {1e-12, 1e-4, 100.0}) {
        cases.push_back({"load falls or grows to " + shown(ratio), "force by mu N against Carter", [=] {
                             Rolling rolling(rollbem::cosine_mesh(160));
                             const double a = std::sqrt(ratio), delta = 0.5 * a;  // full sliding scales with p_0
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
    // Two discretisations agree on the force after a period to 1e-4; elements add 2.3e-4 at n = 80.
    for (const double dq : {1e-3, 1e-2, 0.1}) {
        cases.push_back({"load by half, dq = " + shown(dq), "force after a period against two discretisations", [=] {
                             Rolling rolling(rollbem::cosine_mesh(dq < 0.01 ? 40 : 80));
                             roll_a_period(rolling, static_cast<int>(std::lround(8 / dq)));
                             return rolling.against(0.5494, 1e-3);
                         }});
    }
    // Steps longer than the contact: the initial state is forgotten after a few of them.
    for (const double dq : {10.0, 1e6}) {
        for (const int n : {3, 40}) {
            cases.push_back({"load by half, dq = " + shown(dq) + ", n = " + std::to_string(n),
                             "force against steady rolling on the mesh", [=] {
                                 const auto mesh = rollbem::cosine_mesh(n);
                                 Rolling rolling(mesh);
                                 rolling.settle(0.5);
                                 rolling.roll(dq, 0.5, 0.5);
                                 for (int k = 0; k < 12; ++k) rolling.roll(dq, 0.5, 1.5);
                                 return rolling.against(steady_ratio(mesh, 0, 0.5, 1.5), 1e-7);
                             }});
        }
    }
}

}  // namespace

void load_cases(Cases& cases) {
    add_lift_off(cases);
    add_growth(cases);
    add_loads(cases);
}

}  // namespace extremes
