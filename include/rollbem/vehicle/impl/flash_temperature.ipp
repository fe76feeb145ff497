// Bodies of vehicle/flash_temperature.hpp. Internal.
#pragma once

#include "../flash_temperature.hpp"

#include <numbers>

namespace rollbem {

ROLLBEM_DECL Eigen::ArrayXd flash_temperature(const Eigen::ArrayXd& edges, const Eigen::ArrayXd& heat,
                                              const Eigen::ArrayXd& at, double speed, const Heating& heating) {
    const double factor = std::sqrt(heating.diffusivity() / (std::numbers::pi * speed)) / heating.conductivity;
    const auto root = [](double x) { return std::sqrt((std::max)(x, 0.0)); };
    Eigen::ArrayXd found = Eigen::ArrayXd::Zero(at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
        for (Eigen::Index i = 0; i < heat.size(); ++i) {
            found[k] += heat[i] * (root(edges[i + 1] - at[k]) - root(edges[i] - at[k]));  // 2 of the root, q/2
        }
    }
    return factor * found;
}

}  // namespace rollbem
