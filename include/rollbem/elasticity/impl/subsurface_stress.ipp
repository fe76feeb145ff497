// Bodies of elasticity/subsurface_stress.hpp. Internal.
#pragma once

#include "../subsurface_stress.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL Yield Yield::of(const Eigen::Matrix3d& stress) {
    const Eigen::Matrix3d deviator = stress - stress.trace() / 3 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues();
    return {std::sqrt(1.5) * deviator.norm(), (principal[2] - principal[0]) / 2};
}

}  // namespace rollbem

namespace rollbem::detail {

/// Derivatives of the integrals over a rectangle of Omega = z ln(r + z) - r (f_1), of ln(r + z) (f) and of 1/r (V), by
/// Boussinesq and Cerruti (Johnson, Contact Mechanics, 1985, section 3.2). f_1z = f, f_z = V; all are harmonic.
struct HalfSpacePotentials {
    double f1_xxy = 0, f1_xyy = 0, f_xx = 0, f_yy = 0, f_xy = 0, f_xxy = 0, f_xyy = 0;
    double V_x = 0, V_y = 0, V_z = 0, V_xx = 0, V_yy = 0, V_xy = 0, V_xz = 0, V_yz = 0;

    /// Adds the share of a corner, from which the point lies at (x, y, z), z > 0.
    void add(double sign, double x, double y, double z) {
        const double xz = x * x + z * z, yz = y * y + z * z, r = std::sqrt(xz + y * y);
        f1_xxy -= sign * x / (r + z);
        f1_xyy -= sign * y / (r + z);
        const double flat = r > 0 ? (x * x + y * y) / (r + z) : 0;  // r - z
        f_xx += sign * std::atan2(x * y * flat, x * x * r + z * y * y);
        f_yy += sign * std::atan2(x * y * flat, y * y * r + z * x * x);
        f_xy += sign * std::log(r + z);
        f_xxy += sign * x / (r * (r + z));
        f_xyy += sign * y / (r * (r + z));
        // functions of x alone, or of y alone, cancel between corners
        V_x += sign * std::asinh(y / std::sqrt(xz));
        V_y += sign * std::asinh(x / std::sqrt(yz));
        V_z -= sign * std::atan(x * y / (z * r));
        V_xx -= sign * x * y / (r * xz);
        V_yy -= sign * x * y / (r * yz);
        V_xy += sign / r;
        V_xz -= sign * y * z / (r * xz);
        V_yz -= sign * x * z / (r * yz);
    }
};

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL Eigen::Matrix3d subsurface_stress(const std::vector<Yield::LoadedRectangle>& loads, double poisson_ratio,
                                               const Eigen::Vector3d& at) {
    detail::require_poisson_ratio("subsurface_stress", poisson_ratio);
    detail::require_positive("subsurface_stress", "z", at[2]);
    const double z = at[2], nu = poisson_ratio;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Yield::LoadedRectangle& load : loads) {
        detail::HalfSpacePotentials d;
        d.add(1, at[0] - load.x_1, at[1] - load.y_1, z);
        d.add(-1, at[0] - load.x_2, at[1] - load.y_1, z);
        d.add(-1, at[0] - load.x_1, at[1] - load.y_2, z);
        d.add(1, at[0] - load.x_2, at[1] - load.y_2, z);
        const double q = load.traction_x, s = load.traction_y, p = load.pressure;
        const double V_zz = -d.V_xx - d.V_yy, f_xxx = -d.f_xyy - d.V_xz, f_yyy = -d.f_xxy - d.V_yz;
        const double f1_xxx = -d.f1_xyy - d.V_x, f1_yyy = -d.f1_xxy - d.V_y;
        const double psi_z = q * d.V_x + s * d.V_y + p * d.V_z;
        const double xx = 2 * q * d.V_x - p * d.f_xx + 2 * nu * (q * f1_xxx + s * d.f1_xxy + p * d.f_xx + psi_z) -
                          z * (q * f_xxx + s * d.f_xxy + p * d.V_xx);
        const double yy = 2 * s * d.V_y - p * d.f_yy + 2 * nu * (q * d.f1_xyy + s * f1_yyy + p * d.f_yy + psi_z) -
                          z * (q * d.f_xyy + s * f_yyy + p * d.V_yy);
        const double xy = q * d.V_y + s * d.V_x - p * d.f_xy + 2 * nu * (q * d.f1_xxy + s * d.f1_xyy + p * d.f_xy) -
                          z * (q * d.f_xxy + s * d.f_xyy + p * d.V_xy);
        const double zz = p * d.V_z - z * (q * d.V_xz + s * d.V_yz + p * V_zz);
        const double xz = q * d.V_z - z * (q * d.V_xx + s * d.V_xy + p * d.V_xz);
        const double yz = s * d.V_z - z * (q * d.V_xy + s * d.V_yy + p * d.V_yz);
        sum += (Eigen::Matrix3d() << xx, xy, xz, xy, yy, yz, xz, yz, zz).finished();
    }
    return sum / (2 * std::numbers::pi);
}

ROLLBEM_DECL Yield::Peak subsurface_peak(const std::vector<Yield::LoadedRectangle>& loads, double poisson_ratio,
                                         const Eigen::Vector2d& below, double deepest) {
    constexpr int count = 48;
    const auto depth = [&](double i) { return deepest * (i / count) * (i / count); };
    const auto yield = [&](double i) {
        return Yield::of(subsurface_stress(loads, poisson_ratio, {below[0], below[1], depth(i)}));
    };
    std::array<Yield, count> at;  // stresses at i = 1 to count
    for (int i = 0; i < count; ++i) at[std::size_t(i)] = yield(i + 1);
    const auto largest = [&](double Yield::*of) {
        const auto best = std::max_element(at.begin(), at.end(),
                                           [&](const Yield& one, const Yield& two) { return one.*of < two.*of; });
        const auto place = double(best - at.begin() + 1);
        double low = (std::max)(place - 1, 0.01), high = (std::min)(place + 1, double(count));
        constexpr double golden = 0.381966011250105;
        double one = low + golden * (high - low), two = high - golden * (high - low);
        double at_one = yield(one).*of, at_two = yield(two).*of;
        for (int k = 0; k < 30; ++k) {
            if (at_one < at_two) {
                low = std::exchange(one, two);
                at_one = at_two;
                two = high - golden * (high - low);
                at_two = yield(two).*of;
            } else {
                high = std::exchange(two, one);
                at_two = at_one;
                one = low + golden * (high - low);
                at_one = yield(one).*of;
            }
        }
        return std::array{(std::max)(at_one, at_two), depth((low + high) / 2)};
    };
    const auto [von_mises, von_mises_depth] = largest(&Yield::von_mises);
    const auto [tresca, tresca_depth] = largest(&Yield::tresca);
    return {von_mises, tresca, von_mises_depth, tresca_depth, below[0], below[1]};
}

}  // namespace rollbem
