// Extreme cases: what is computed, the reference, and what is promised. One list for each kind of problem.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/status.hpp>

namespace extremes {

inline constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
inline constexpr double rounding = std::numeric_limits<double>::epsilon();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Defaults of the cases: Poisson's ratio and the scheme.
inline constexpr double steel = 0.28;
inline constexpr rollbem::Collocation equal{.alpha_L = 0.5, .alpha_T = 0.5};

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

/// The text of a Status or StepStatus, empty for ok.
template <class AnyStatus>
std::string told_by(AnyStatus status) {
    return status == AnyStatus::ok ? std::string() : std::string("status ") + name(status);
}

/// 1e-06, 1000, inf: for the names of cases.
std::string shown(double number);

std::vector<Case> steady_cases(bool large);
std::vector<Case> harmonic_cases();
std::vector<Case> time_cases();
std::vector<Case> chebyshev_cases(bool large);
std::vector<Case> friction_cases();
std::vector<Case> load_cases();
std::vector<Case> direction_cases();
std::vector<Case> patch_cases();

/// A random patch with friction, steady and in time.
Case patch_scene(std::uint64_t seed);

}  // namespace extremes
