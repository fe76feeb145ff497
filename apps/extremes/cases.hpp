// Extreme cases as data: a computation, its reference and the promised bound.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <rollbem/closed_form/detail/estimated_c11.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/status.hpp>

namespace extremes {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr double rounding = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double pi = std::numbers::pi;

/// Defaults of the cases: Poisson's ratio and the schemes.
inline constexpr double steel = 0.28;
inline constexpr rollbem::Collocation equal{.alpha_L = 0.5, .alpha_T = 0.5};
inline constexpr rollbem::NodeDifference chebyshev{rollbem::Nodes::chebyshev};

inline constexpr double peak = 1e-3;                 ///< mu p0 / G, of cases with friction
inline constexpr double full_force = peak * pi / 2;  ///< mu N under Hertz's pressure, or mu N_0 if the load varies

/// The creepage of a creepage ratio.
inline double creepage(double ratio, double nu = steel) { return 2 * (1 - nu) * peak * ratio; }

/// The result of a case. Cells without a meaning are not numbers.
struct Outcome {
    double value = nothing, reference = nothing;
    double error = nothing;      ///< relative; its absolute value if the quantity is complex
    double residual = nothing;   ///< of the equations solved
    double condition = nothing;  ///< estimate of their condition
    double bound = 0;            ///< promised for |error|; 0: the case must be told
    std::string told{};          ///< a status other than ok, or the reason why there is no result
    bool refused = false;        ///< by an exception
    bool may_be_told = false;    ///< a status is right, too, with numbers within the bound
};

/// One row. An exception counts as told. `says` must be part of the text that is told; if empty, the case must be
/// right.
struct Case {
    std::string name, quantity;
    std::function<Outcome()> run;
    std::string says{};
};
struct Cases {
    std::vector<Case> all{};

    void add(std::string name, std::string quantity, std::function<Outcome()> run, std::string says = "") {
        all.push_back({std::move(name), std::move(quantity), std::move(run), std::move(says)});
    }
};

/// The text of a status, empty for ok.
inline std::string told_by(rollbem::Status status) {
    return status == rollbem::Status::ok ? std::string() : std::string("status ") + name(status);
}

/// 1e-06, 1000, inf: for the names of cases.
std::string shown(double number);

template <class Value>
Outcome compare(Value value, std::type_identity_t<Value> reference, double bound, std::string told = {}) {
    Outcome outcome{.bound = bound, .told = std::move(told)};
    if constexpr (std::is_same_v<Value, double>) {
        outcome.value = value, outcome.reference = reference, outcome.error = value / reference - 1;
    } else {
        outcome.value = std::abs(value), outcome.reference = std::abs(reference);
        outcome.error = std::abs(value / reference - 1.0);
    }
    return outcome;
}

/// The outcome with the residual and condition of the solution that the value is from. A bound of 0 stands for
/// `per_condition` times the condition and the rounding error.
template <class Solution, class Value>
Outcome compare(const Solution& solution, Value value, std::type_identity_t<Value> reference, double bound,
                double per_condition = 0) {
    Outcome outcome = compare(value, reference, bound, told_by(solution.status));
    if constexpr (requires { solution.residual; }) outcome.residual = solution.residual;
    if constexpr (requires { solution.rcond; }) outcome.condition = static_cast<double>(1 / solution.rcond);
    if constexpr (requires { solution.complementarity_residual; }) outcome.residual = solution.complementarity_residual;
    if (per_condition > 0) outcome.bound = per_condition * rounding * outcome.condition;
    return outcome;
}

/// Force per width of a model in full adhesion after `count` steps of dq [m] at unit creepage, from rest.
template <class Model>
Outcome rolled(const Model& model, double dq, int count, double reference, double bound) {
    rollbem::Run run(model);
    auto step = run.advance({dq, 1.0});
    while (--count > 0 && step.status == rollbem::Status::ok) step = run.advance({dq, 1.0});
    return compare(step, step.force_per_width, reference, bound);
}

/// An outcome that is told if its reference has not converged.
inline Outcome against_estimate(Outcome outcome, const rollbem::EstimatedC11<double>& reference) {
    if (!(reference.error_estimate < 1e-11)) outcome.told = "the reference has not converged";
    return outcome;
}

void adhesion_cases(Cases& cases, bool large);
void friction_cases(Cases& cases);
void patch_cases(Cases& cases);

/// A random patch with friction, steady and in the time domain.
Case patch_scene(std::uint64_t seed);
/// A random position and load of a wheel on a rail, or on the rail as a surface that changes along the way. The error
/// is the largest ratio of a violation to its bound.
Case contact_scene(std::uint64_t seed, bool in_slices);
/// A random position and load of a wheel on a rail drawn with it.
Case position_scene(std::uint64_t seed);

}  // namespace extremes
