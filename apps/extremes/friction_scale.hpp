// What cases with friction share: the size of pressure, force and creepage.
#pragma once

#include <numbers>

#include "cases.hpp"

namespace extremes {

inline constexpr double pi = std::numbers::pi;
inline constexpr double peak = 1e-3;                 // mu p0 / G
inline constexpr double full_force = peak * pi / 2;  // mu N under Hertz's pressure, or mu N_0 if the load varies

/// The creepage of a creepage ratio.
inline double creepage(double ratio, double nu = steel) { return 2 * (1 - nu) * peak * ratio; }

/// The step of a steady model from rest.
template <class Model, class Creepage>
auto steady_from_rest(const Model& model, const Creepage& creepage) {
    const auto rest = model.at_rest();
    auto state = rest;
    auto workspace = model.workspace();
    return model.steady(rest, creepage, state, workspace);
}

}  // namespace extremes
