// What cases with friction share: the size of pressure, force and creepage.
#pragma once

#include <numbers>
#include <string>

#include "cases.hpp"

namespace extremes {

inline constexpr double pi = std::numbers::pi;
inline constexpr double peak = 1e-3;                 // mu p0 / G
inline constexpr double full_force = peak * pi / 2;  // mu N under Hertz's pressure, or mu N_0 if the load varies

/// The creepage of a creepage ratio.
inline double creepage(double ratio, double nu = steel) { return 2 * (1 - nu) * peak * ratio; }

inline Outcome compare(double value, double reference, double bound, const std::string& told = {}) {
    return {.value = value, .reference = reference, .error = value / reference - 1, .bound = bound, .told = told};
}

}  // namespace extremes
