// A patch under Hertz's pressure on a level rail.
#pragma once

#include <numbers>

#include <Eigen/Core>

#include <rollbem/normal/wheel_on_rail.hpp>

namespace rollbem::testing {

/// Of a wheel of radius 0.46 m.
inline RailPatch hertz_patch(double a, double b, double load) {
    RailPatch patch;
    patch.status = Status::ok;
    patch.rolling_radius = 0.46;
    patch.load = load;
    patch.half_length = a;
    patch.half_width = b;
    patch.peak_pressure = 1.5 * load / (std::numbers::pi * a * b);
    const Eigen::ArrayXd angle = Eigen::ArrayXd::LinSpaced(121, 0, std::numbers::pi);
    patch.outline.emplace(Eigen::ArrayXd(-b * angle.cos()), Eigen::ArrayXd(-a * angle.sin()),
                          Eigen::ArrayXd(a * angle.sin()));
    const Eigen::Index n = 81;
    patch.grid = {n, n, -a, -b, 2 * a / double(n - 1), 2 * b / double(n - 1)};
    const Eigen::ArrayXd square = Eigen::ArrayXd::LinSpaced(n, -1, 1).square();  // over a and over b
    const auto rest = 1 - square.replicate(1, n) - square.transpose().replicate(n, 1);
    patch.pressure = patch.peak_pressure * rest.max(0).sqrt();
    patch.rail_slope = patch.rail_n = patch.wheel_n = Eigen::ArrayXd::Zero(n);
    return patch;
}

}  // namespace rollbem::testing
