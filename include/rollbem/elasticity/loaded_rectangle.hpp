// Tractions and pressure on a rectangle of a surface. Plain data.
#pragma once

#include "../detail/language.hpp"

namespace rollbem {

/// Tractions on a rectangle of the surface z = 0 of the half-space z > 0, the rail: opposite to the tractions on the
/// wheel.
struct LoadedRectangle {
    double x_1, x_2, y_1, y_2;      ///< its edges, ascending [m]
    double traction_x, traction_y;  ///< tractions on the half-space [Pa]
    double pressure;                ///< pressure towards z [Pa]
};

}  // namespace rollbem
