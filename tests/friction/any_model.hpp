// Friction of any law in one direction or two as a FrictionModel, so that what holds for all of them is written and
// compiled once.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/line.hpp>

#include "friction/same_bits.hpp"
#include "support/unturned.hpp"

namespace any_model {

using namespace rollbem;
using AnyLaw = std::function<double(double)>;
using Law = ExponentialFall;
using State = FrictionState;
using Step = FrictionStep;
using Motion = RigidMotion<Creepage>;
using Load = NormalLoad;
using RollingStep = FrictionModel::RollingStep;
using Workspace = FrictionModel::Workspace;
using same_bits::same;

constexpr double a = 4e-3, shear_modulus = 82e9, poisson_ratio = 0.28, peak_pressure = 495.169e6;  // [m], [Pa]
constexpr double speed = 45;                                                                       // V [m/s]
constexpr Law law{.mu_0 = 0.3, .mu_k = 0.18, .half_velocity = 0.1};
constexpr double least_velocity = 1e-3, wide = 1000 * a;
constexpr double full_force = std::numbers::pi / 2 * law.mu_0 * peak_pressure * a * 2 * wide;  // mu_0 N

/// A wheel on a rail in SI units, whose law is one of its members, and how it is solved.
struct Setup {
    int directions = 1;
    bool falls = false;   // or mu is constant
    double distance = 0;  // of the memory [m]
    bool across = false;  // with one direction: the lateral one
    Integrator integrator = Integrator::sdirk2;
    Mesh<double> mesh = cosine_mesh<double>(20);
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    double nu = poisson_ratio, half_width = wide;
    bool strip = false;   // else the plane kernel
    bool turned = false;  // slip
    bool with_tangents = true;
    StabilityVerdict checks = unchecked;
    Law falling = law;
    double constant = law.mu_0;
    double least = least_velocity;
    std::optional<AnyLaw> any{};  // instead of these laws
    std::optional<Contact> own_contact{};
    std::optional<ArrayX<double>> own_pressure{};

    Contact contact() const {
        return own_contact.value_or(
            Contact({.half_length = a, .half_width = half_width, .shear_modulus = shear_modulus, .poisson_ratio = nu}));
    }
    ArrayX<double> pressure() const { return own_pressure.value_or(peak_pressure * mean_hertz_pressure(mesh)); }
    AnyKernel<double> kernel(bool lateral) const {
        const auto of = lateral ? AnyKernel<double>::lateral : AnyKernel<double>::longitudinal;
        return of(strip ? LineModel::strip : LineModel::plane, contact());
    }
    /// Of G' alone if `steady`.
    ElementSystem<double> system(bool lateral, bool steady = false) const {
        const auto own =
            steady ? steady_system(mesh, scheme, kernel(lateral)) : rolling_system(mesh, scheme, kernel(lateral));
        return turned ? own : support::unturned(own);
    }
};

/// The contact of a setup, with G' alone or in the time domain; in any_model.cpp, for all programs.
FrictionModel make(const Setup& setup, bool steady = false);

/// A step under a load, or, if it is null, under the load of the state.
inline RollingStep rolling_step(const Travel& travel, const Motion& motion, const Load* load) {
    return load == nullptr ? RollingStep{travel, motion} : RollingStep{travel, motion, *load};
}

/// A model with its state and workspace. Distances are in a, and the speed of rolling is `speed`; what takes no way
/// lasts as long as a tenth of a.
struct Ride {
    explicit Ride(const Setup& of)
        : setup(of), model(make(of)), now(model.at_rest()), next(now), own(model.workspace()) {}

    /// The model of G' alone.
    const FrictionModel& alone() {
        if (!alone_) alone_ = make(setup, true);
        return *alone_;
    }

    static Travel travel(double dq) { return {dq * a, (dq == 0 ? 0.1 : dq) * a / speed}; }
    /// Trials, which do not change `now`.
    Step try_steady(const Creepage& creepage, const Load* load = nullptr) {
        return model.steady(now, rolling_step(Travel::at_speed(speed), creepage, load), next, own);
    }
    Step try_step(double dq, const Motion& motion, const Load* load = nullptr) {
        return model.advance(now, rolling_step(travel(dq), motion, load), next, own);
    }
    void accept() { std::swap(now, next); }
    Step steady(const Creepage& creepage, const Load* load = nullptr) {
        const Step step = try_steady(creepage, load);
        accept();
        return step;
    }
    Step step(double dq, const Motion& motion, const Load* load = nullptr) {
        const Step step = try_step(dq, motion, load);
        accept();
        return step;
    }

    Setup setup;
    FrictionModel model;
    State now, next;
    Workspace own;

private:
    std::optional<FrictionModel> alone_;
};

/// Constant friction, friction that falls with slip, and with a memory, in one direction and two.
inline std::vector<Setup> every_setup(double distance = 8e-6) {
    std::vector<Setup> all;
    for (const int directions : {1, 2}) {
        all.push_back({.directions = directions});
        all.push_back({.directions = directions, .falls = true});
        all.push_back({.directions = directions, .falls = true, .distance = distance});
    }
    return all;
}
/// The same with both integrators.
inline std::vector<Setup> every_setup_in_time(double distance = 8e-6) {
    std::vector<Setup> all = every_setup(distance);
    for (Setup setup : every_setup(distance)) {
        setup.integrator = Integrator::implicit_euler;
        all.push_back(setup);
    }
    return all;
}
inline std::string words(const Setup& setup) {
    return std::to_string(setup.directions) + (setup.across ? " directions, across, " : " directions, ") +
           (setup.falls ? "falling" : "constant") + ", memory " + std::to_string(1e6 * setup.distance) + " um, " +
           name(setup.integrator);
}

/// Creepage [-] of full sliding in Carter's problem.
constexpr double sliding = 2 * (1 - poisson_ratio) * law.mu_0 * peak_pressure / shear_modulus;

/// Creepage by its size over `sliding` and its angle to the rolling direction.
inline Creepage creepage(double ratio, double degrees = 0) {
    const double angle = degrees * std::numbers::pi / 180;
    return {sliding * ratio * std::cos(angle), sliding * ratio * std::sin(angle)};
}
inline Motion shift(double ratio, double degrees = 0) {  // by `ratio` times what slides in a tenth of a
    const Creepage by = creepage(0.1 * a * ratio, degrees);
    return Motion::shift(by);
}

inline Eigen::Vector2d vector(const TangentialForce& force) { return {force.longitudinal, force.lateral}; }
inline Eigen::Vector2d vector(const Creepage& value) { return {value.longitudinal, value.lateral}; }
inline Eigen::Matrix2d matrix(const TangentialForce::ByCreepage& tangent) {
    Eigen::Matrix2d columns;
    columns << vector(tangent.by_longitudinal), vector(tangent.by_lateral);
    return columns;
}
/// Forces over mu_0 N.
inline Eigen::Vector2d ratios(const Step& step) { return -vector(step.force) / full_force; }

}  // namespace any_model
