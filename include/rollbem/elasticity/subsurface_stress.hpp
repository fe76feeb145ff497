// Stresses inside an elastic half-space under constant tractions on rectangles of its surface, in closed form, and
// where they are largest below a point.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

#include <Eigen/Core>

namespace rollbem {

/// Measures of a state of stress against yield.
struct Yield {
    /// Tractions on a rectangle of the surface z = 0 of the half-space z > 0, the rail: opposite to the tractions on
    /// the wheel.
    struct LoadedRectangle {
        double x_1, x_2, y_1, y_2;      ///< its edges, ascending [m]
        double traction_x, traction_y;  ///< tractions on the half-space [Pa]
        double pressure;                ///< pressure towards z [Pa]
    };

    /// The largest von Mises and Tresca stresses below one point of the surface, and their depths.
    struct Peak {
        double von_mises = 0, tresca = 0;              ///< as below [Pa]
        double von_mises_depth = 0, tresca_depth = 0;  ///< [m]
        double x = 0, y = 0;                           ///< the point of the surface [m]
    };

    /// A patch in the map of shakedown (Johnson 1989): its load factor and coefficient of traction.
    struct Shakedown {
        double load_factor;  ///< the peak pressure over k, the yield stress in shear [-]
        double traction;     ///< force of friction over the load [-]
    };

    double von_mises = 0;  ///< equivalent stress [Pa]
    double tresca = 0;     ///< largest shear stress, half the largest difference of principal stresses [Pa]

    /// The measures of a symmetric stress tensor, tension positive.
    static Yield of(const Eigen::Matrix3d& stress);
};

/// The stress [Pa] at a point below the surface, z > 0, tension positive; independent of the shear modulus. Throws
/// std::invalid_argument unless z is positive and finite and 0 <= poisson_ratio <= 0.5.
Eigen::Matrix3d subsurface_stress(const std::vector<Yield::LoadedRectangle>& loads, double poisson_ratio,
                                  const Eigen::Vector3d& at);

/// Finds the largest stresses below a point, down to the depth `deepest` > 0 [m]: the best of 48 depths, closer
/// together towards the surface, is refined.
Yield::Peak subsurface_peak(const std::vector<Yield::LoadedRectangle>& loads, double poisson_ratio,
                            const Eigen::Vector2d& below, double deepest);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/subsurface_stress.ipp"
#endif
