// Friction of any law in one direction or two behind one type, so that what holds for all of them is written and
// compiled once. There are always two directions; a model of one sees only its own and returns zeros in the other.
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/elasticity/any_kernel.hpp>

#include "friction/any_law.hpp"
#include "friction/falling_scene.hpp"
#include "friction/same_bits.hpp"
#include "support/unturned.hpp"

namespace any_model {

using namespace rollbem;
using falling_tests::a, falling_tests::AnyLaw, falling_tests::full_force, falling_tests::law;
using falling_tests::least_velocity, falling_tests::peak_pressure, falling_tests::shear_modulus, falling_tests::speed;
using Law = falling_tests::Law;
using State = FrictionState<2>;
using Step = FrictionStep<2>;
using Motion = RigidMotion<Creepage<double>>;
using Load = NormalLoad<double>;
using same_bits::same;

/// The wheel of falling_scene.hpp, whose law is one of its members, and how it is solved.
struct Setup {
    int directions = 1;
    bool falls = false;   // or mu is constant
    double distance = 0;  // of the memory [m]
    bool across = false;  // with one direction: the lateral one
    Integrator integrator = Integrator::sdirk2;
    Mesh<double> mesh = cosine_mesh<double>(20);
    Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    double nu = falling_tests::poisson_ratio, half_width = falling_tests::half_width;
    bool strip = false;   // else the plane kernel
    bool turned = false;  // slip
    bool with_tangents = true;
    Law falling = law;
    double constant = law.mu_0;
    double least = least_velocity;
    std::optional<AnyLaw> any{};  // instead of these laws
    std::optional<Contact<double>> own_contact{};
    std::optional<ArrayX<double>> own_pressure{};

    Contact<double> contact() const {
        return own_contact.value_or(Contact<double>(
            {.half_length = a, .half_width = half_width, .shear_modulus = shear_modulus, .poisson_ratio = nu}));
    }
    ArrayX<double> pressure() const { return own_pressure.value_or(peak_pressure * mean_hertz_pressure(mesh)); }
    AnyKernel<double> kernel(bool lateral) const {
        const auto of = lateral ? AnyKernel<double>::lateral : AnyKernel<double>::longitudinal;
        return of(strip ? LineModel::strip : LineModel::plane, contact());
    }
    ElementSystem<double> as_turned(const ElementSystem<double>& of) const {
        return turned ? of : support::unturned(of);
    }
    ElementSystem<double> system(bool lateral) const {
        return as_turned(rolling_system(mesh, scheme, kernel(lateral)));
    }
    template <class AnyOf>
    Friction<AnyOf> friction(const AnyOf& of) const {
        return {of, pressure(), {distance, least}, with_tangents};
    }
};

/// The matrix factors and scratch memory of one model, or of several.
struct Workspace {
    std::variant<FrictionWorkspace<1>, FrictionWorkspace<2>> of;
    bool across;

    ElementVectors<double> slip() const {
        if (const auto* both = std::get_if<1>(&of)) return both->slip();
        const VectorX<double>& own = std::get<0>(of).slip();
        ElementVectors<double> slip = ElementVectors<double>::Zero(own.size(), 2);
        slip.col(across ? 1 : 0) = own;
        return slip;
    }
    const VectorX<double>& slip_work() const {
        return std::visit([](const auto& each) -> const VectorX<double>& { return each.slip_work(); }, of);
    }
};

/// FrictionModel of G and G', and one of G' alone of the same scene; a null load is that of the state.
class Model {
public:
    virtual ~Model() = default;
    virtual std::uint64_t fingerprint() const = 0;
    virtual State at_rest() const = 0;
    virtual Workspace workspace() const = 0;
    virtual TangentialForce<double> force(const State& state) const = 0;
    virtual double elastic_energy(const State& state) const = 0;
    virtual Step steady(const State& from, const Creepage<double>& creepage, double V, const Load* load, State& to,
                        Workspace& workspace) const = 0;
    virtual Step advance(const State& from, const Travel<double>& travel, const Motion& motion, const Load* load,
                         State& to, Workspace& workspace) const = 0;
    /// By the model of G' alone.
    virtual Step solve_steady(const State& from, const Creepage<double>& creepage, double V, State& to,
                              Workspace& workspace) const = 0;
};

template <class Law, int directions>
class ModelOf final : public Model {
public:
    using Inner = FrictionModel<Law, directions>;
    using InnerState = typename Inner::State;
    using InnerStep = typename Inner::Step;

    ModelOf(const Setup& setup, const Law& own_law)
        : setup_(setup), law_(own_law), own_(setup.across ? 1 : 0), model_(make(setup, own_law)) {}

    std::uint64_t fingerprint() const override { return model_.fingerprint(); }
    State at_rest() const override {
        State rest;
        raise(model_.at_rest(), rest);
        return rest;
    }
    Workspace workspace() const override { return {model_.workspace(), setup_.across}; }
    TangentialForce<double> force(const State& state) const override { return raise(model_.force(lower(state))); }
    double elastic_energy(const State& state) const override { return model_.elastic_energy(lower(state)); }
    Step steady(const State& from, const Creepage<double>& creepage, double V, const Load* load, State& to,
                Workspace& workspace) const override {
        return call(from, to, workspace, [&](const auto& start, auto& end, auto& scratch) {
            return load == nullptr ? model_.steady(start, own(creepage), V, end, scratch)
                                   : model_.steady(start, own(creepage), V, *load, end, scratch);
        });
    }
    Step advance(const State& from, const Travel<double>& travel, const Motion& motion, const Load* load, State& to,
                 Workspace& workspace) const override {
        using Own = typename Inner::Motion;
        const auto start = own(motion.start()), end = own(motion.end());
        const Own moved = motion.is_shift() ? Own::shift(end) : motion.is_linear() ? Own::linear(start, end) : Own(end);
        return call(from, to, workspace, [&](const auto& before, auto& after, auto& scratch) {
            return load == nullptr ? model_.advance(before, travel, moved, after, scratch)
                                   : model_.advance(before, travel, moved, *load, after, scratch);
        });
    }
    Step solve_steady(const State& from, const Creepage<double>& creepage, double V, State& to,
                      Workspace& workspace) const override {
        if (!steady_) steady_.emplace(make_steady(setup_, law_));
        return call(from, to, workspace, [&](const auto& start, auto& end, auto& scratch) {
            return steady_->steady(start, own(creepage), V, end, scratch);
        });
    }

    static Inner make_steady(const Setup& setup, const Law& own_law) {
        const auto system = [&](bool lateral) {
            return setup.as_turned(steady_system(setup.mesh, setup.scheme, setup.kernel(lateral)));
        };
        if constexpr (directions == 1) {
            return {setup.contact(), system(setup.across), unchecked, setup.friction(own_law)};
        } else {
            return {setup.contact(), {system(false), system(true)}, unchecked, setup.friction(own_law)};
        }
    }

private:
    static Inner make(const Setup& setup, const Law& own_law) {
        if constexpr (directions == 1) {
            return {setup.contact(), setup.system(setup.across), unchecked, setup.friction(own_law), setup.integrator};
        } else {
            return {setup.contact(),
                    {setup.system(false), setup.system(true)},
                    unchecked,
                    setup.friction(own_law),
                    setup.integrator};
        }
    }
    auto own(const Creepage<double>& value) const {
        if constexpr (directions == 1) {
            return setup_.across ? value.lateral : value.longitudinal;
        } else {
            return value;
        }
    }
    InnerState lower(const State& state) const {
        if constexpr (directions == 2) {
            return state;
        } else {
            return {state.traction.col(own_),   state.zones,      state.normal_pressure,
                    state.half_length,          state.half_width, state.system,
                    state.friction_coefficient, state.solver,     {}};
        }
    }
    void raise(const InnerState& inner, State& state) const {
        if constexpr (directions == 2) {
            state = inner;
        } else {
            state = {ElementVectors<double>::Zero(inner.traction.size(), 2),
                     inner.zones,
                     inner.normal_pressure,
                     inner.half_length,
                     inner.half_width,
                     inner.system,
                     inner.friction_coefficient,
                     inner.solver,
                     {}};
            state.traction.col(own_) = inner.traction;
        }
    }
    TangentialForce<double> raise(const typename InnerStep::Force& force) const {
        if constexpr (directions == 2) {
            return force;
        } else {
            if (std::isnan(force)) return {};
            return own_ == 0 ? TangentialForce<double>{force, 0} : TangentialForce<double>{0, force};
        }
    }
    CreepageTangent<double> raise_tangent(const typename InnerStep::Tangent& tangent) const {
        if constexpr (directions == 2) {
            return tangent;
        } else {
            const TangentialForce<double> none = std::isnan(tangent) ? raise(tangent) : TangentialForce<double>{0, 0};
            return own_ == 0 ? CreepageTangent<double>{raise(tangent), none, {}}
                             : CreepageTangent<double>{none, raise(tangent), {}};
        }
    }
    Step raise(const InnerStep& inner) const requires(directions == 1) {
        Step step;
        step.force = raise(inner.force);
        step.tangent = raise_tangent(inner.tangent);
        step.tangent_by_load = raise(inner.tangent_by_load);
        step.tangent_by_half_length = raise(inner.tangent_by_half_length);
        step.slip_work = inner.slip_work;
        step.jump_work = inner.jump_work;
        step.complementarity_residual = inner.complementarity_residual;
        step.stick_count = inner.stick_count;
        step.rounds = inner.rounds;
        step.pivots = inner.pivots;
        step.status = inner.status;
        return step;
    }
    template <class Solve>
    Step call(const State& from, State& to, Workspace& workspace, const Solve& solve) const {
        auto& scratch = std::get<directions - 1>(workspace.of);
        if constexpr (directions == 2) {
            return solve(from, to, scratch);
        } else {
            InnerState start = lower(from), end = lower(to);
            const InnerStep step = solve(start, &from == &to ? start : end, scratch);
            if (&from != &to) raise(end, to);
            return raise(step);
        }
    }

    Setup setup_;
    Law law_;
    Eigen::Index own_;
    Inner model_;
    mutable std::optional<Inner> steady_;
};

/// What `of`, called with the type ModelOf of a setup and its law, returns.
template <class Of>
auto with_model(const Setup& setup, const Of& of) {
    const auto choose = [&]<class Own>(const Own& each) {
        return setup.directions == 1 ? of(std::type_identity<ModelOf<Own, 1>>(), each)
                                     : of(std::type_identity<ModelOf<Own, 2>>(), each);
    };
    if (setup.any) return choose(*setup.any);
    return setup.falls ? choose(setup.falling) : choose(ConstantFriction<double>{setup.constant});
}
inline std::unique_ptr<Model> make(const Setup& setup) {
    return with_model(setup, [&]<class Of>(std::type_identity<Of>, const auto& each) -> std::unique_ptr<Model> {
        return std::make_unique<Of>(setup, each);
    });
}
/// Makes the model of G' alone, which may throw.
inline void make_steady(const Setup& setup) {
    with_model(setup, [&]<class Of>(std::type_identity<Of>, const auto& each) { Of::make_steady(setup, each); });
}

/// A model with its state and workspace. Distances are in a, and the speed of rolling is `speed`; what takes no way
/// lasts as long as a tenth of a.
struct Ride {
    explicit Ride(const Setup& setup) : model(make(setup)), now(model->at_rest()), next(now), own(model->workspace()) {}

    static Travel<double> travel(double dq) { return {dq * a, (dq == 0 ? 0.1 : dq) * a / speed}; }
    /// Trials, which do not change `now`.
    Step try_steady(const Creepage<double>& creepage, const Load* load = nullptr) {
        return model->steady(now, creepage, speed, load, next, own);
    }
    Step try_step(double dq, const Motion& motion, const Load* load = nullptr) {
        return model->advance(now, travel(dq), motion, load, next, own);
    }
    void accept() { std::swap(now, next); }
    Step steady(const Creepage<double>& creepage, const Load* load = nullptr) {
        const Step step = try_steady(creepage, load);
        accept();
        return step;
    }
    Step step(double dq, const Motion& motion, const Load* load = nullptr) {
        const Step step = try_step(dq, motion, load);
        accept();
        return step;
    }

    std::unique_ptr<Model> model;
    State now, next;
    Workspace own;
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
constexpr double sliding = 2 * (1 - falling_tests::poisson_ratio) * law.mu_0 * peak_pressure / shear_modulus;

/// Creepage by its size over `sliding` and its angle to the rolling direction.
inline Creepage<double> creepage(double ratio, double degrees = 0) {
    const double angle = degrees * std::numbers::pi / 180;
    return {sliding * ratio * std::cos(angle), sliding * ratio * std::sin(angle)};
}
inline Motion shift(double ratio, double degrees = 0) {  // by `ratio` times what slides in a tenth of a
    const Creepage<double> by = creepage(0.1 * a * ratio, degrees);
    return Motion::shift(by);
}

inline Eigen::Vector2d vector(const TangentialForce<double>& force) { return {force.longitudinal, force.lateral}; }
inline Eigen::Vector2d vector(const Creepage<double>& value) { return {value.longitudinal, value.lateral}; }
inline Eigen::Matrix2d matrix(const CreepageTangent<double>& tangent) {
    Eigen::Matrix2d columns;
    columns << vector(tangent.by_longitudinal), vector(tangent.by_lateral);
    return columns;
}
/// Forces over mu_0 N.
inline Eigen::Vector2d ratios(const Step& step) { return -vector(step.force) / full_force; }

}  // namespace any_model
