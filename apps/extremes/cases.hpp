// Extreme cases: what is computed, the reference, and what is promised. One list for each kind of problem.
#pragma once

#include <cmath>
#include <complex>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <rollbem/closed_form/estimated_c11.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/scene/contact.hpp>
#include <rollbem/status.hpp>

namespace extremes {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr double rounding = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Defaults of the cases: Poisson's ratio and the schemes.
inline constexpr double steel = 0.28;
inline constexpr rollbem::Collocation equal{.alpha_L = 0.5, .alpha_T = 0.5};
inline constexpr rollbem::NodeDifference chebyshev{rollbem::Nodes::chebyshev};

inline rollbem::Contact<double> contact(double aspect) {
    return rollbem::Contact<double>::dimensionless(aspect, steel);
}

/// Kernels of unit modulus and half-length.
inline rollbem::PlaneKernel<double> plane(double aspect, double nu = steel) { return {aspect, 1 - nu, nu}; }
inline rollbem::StripKernel<double> strip(double aspect, double nu = steel) { return {aspect, 1 - nu, nu}; }

/// The result of a case. Cells without a meaning are not numbers.
struct Outcome {
    double value = nothing, reference = nothing;
    double error = nothing;      ///< relative; its absolute value if the quantity is complex
    double residual = nothing;   ///< of the equations solved
    double condition = nothing;  ///< estimate of their condition
    double bound = 0;            ///< promised for |error|; 0: the case must be told
    std::string told{};          ///< a status other than ok, or the reason why there is no result
    bool refused = false;        ///< by an exception
};

/// One row. An exception counts as told. `says` must be part of the text that is told.
struct Case {
    std::string name, quantity;
    std::function<Outcome()> run;
    std::string says{};
};

struct Cases : std::vector<Case> {  // a told one that says nothing must be right
    void right(std::string name, std::string quantity, std::function<Outcome()> run) {
        told(std::move(name), std::move(quantity), "", std::move(run));
    }
    void told(std::string name, std::string quantity, std::string says, std::function<Outcome()> run) {
        push_back({std::move(name), std::move(quantity), std::move(run), std::move(says)});
    }
};

/// The text of a Status or StepStatus, empty for ok.
template <class AnyStatus>
std::string told_by(AnyStatus status) {
    return status == AnyStatus::ok ? std::string() : std::string("status ") + name(status);
}

/// 1e-06, 1000, inf: for the names of cases.
std::string shown(double number);

inline Outcome compare(Outcome computed, double reference, double bound) {
    computed.reference = reference;
    computed.error = computed.value / reference - 1;
    computed.bound = bound;
    return computed;
}
inline Outcome compare(double value, double reference, double bound, const std::string& told = {}) {
    return compare(Outcome{.value = value, .told = told}, reference, bound);
}
inline Outcome compare(std::complex<double> value, std::complex<double> reference, double bound) {
    return {.value = std::abs(value),
            .reference = std::abs(reference),
            .error = std::abs(value / reference - 1.0),
            .bound = bound};
}

/// The same with what else is known of the solution that the value is from.
template <class Solution, class Value>
Outcome compare(const Solution& solution, Value value, std::type_identity_t<Value> reference, double bound) {
    Outcome outcome = compare(value, reference, bound);
    if constexpr (requires { solution.residual; }) outcome.residual = solution.residual;
    if constexpr (requires { solution.rcond; }) outcome.condition = static_cast<double>(1 / solution.rcond);
    if constexpr (requires { solution.complementarity_residual; }) outcome.residual = solution.complementarity_residual;
    outcome.told = told_by(solution.status);
    return outcome;
}

/// An outcome that is told if its reference has not converged.
inline Outcome against_estimate(Outcome outcome, const rollbem::EstimatedC11<double>& reference) {
    if (!(reference.error_estimate < 1e-11)) outcome.told = "the reference has not converged";
    return outcome;
}

void steady_cases(Cases& cases, bool large);
void harmonic_cases(Cases& cases);
void time_cases(Cases& cases);
void chebyshev_cases(Cases& cases, bool large);
void friction_cases(Cases& cases);
void load_cases(Cases& cases);
void direction_cases(Cases& cases);
void patch_cases(Cases& cases);

/// A random patch with friction, steady and in the time domain.
Case patch_scene(std::uint64_t seed);

}  // namespace extremes
