// Bodies of normal/pressure_table.hpp. Internal.
#pragma once

#include "../pressure_table.hpp"

#include <algorithm>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL PressureTable::PressureTable(ArrayX<double> x_over_a, ArrayX<double> pressure)
    : x_(std::move(x_over_a)), pressure_(std::move(pressure)) {
    detail::require(x_.size() == pressure_.size(), "PressureTable", "number of pressures", pressure_.size(),
                    "equal the number of points");
    for (Eigen::Index i = 0; i < x_.size(); ++i) {
        detail::require(detail::is_finite(x_[i]) && x_[i] >= -1 && x_[i] <= 1, "PressureTable", "x/a", x_[i],
                        "lie in [-1, 1]");
        detail::require(i == 0 || x_[i] >= x_[i - 1], "PressureTable", "x/a", x_[i],
                        "not be less than at the previous point");
        detail::require_not_negative("PressureTable", "pressure", pressure_[i]);
    }
    const double load = integral();
    detail::require_positive("PressureTable", "load", load);
}

ROLLBEM_DECL double PressureTable::integral() const {
    double sum = 0;
    for (Eigen::Index k = 1; k < x_.size(); ++k) sum += (x_[k] - x_[k - 1]) * (pressure_[k - 1] + pressure_[k]) / 2;
    return sum;
}

ROLLBEM_DECL double PressureTable::operator()(double x_over_a) const {
    if (detail::is_nan(x_over_a)) return x_over_a;
    const double* const end = x_.data() + x_.size();
    const Eigen::Index j = std::upper_bound(x_.data(), end, x_over_a) - x_.data();
    if (j == 0) return 0;
    if (j == x_.size()) return x_over_a == x_[j - 1] ? pressure_[j - 1] : 0.0;
    return at(x_over_a, j);
}

ROLLBEM_DECL auto PressureTable::operator()(const Mesh<double>& mesh) const -> ArrayX<double> {
    ArrayX<double> mean = ArrayX<double>::Zero(mesh.size());
    Eigen::Index k = 1;
    for (Eigen::Index i = 0; i < mesh.size(); ++i) {
        const double low = mesh.edges_from_trailing()[i] - 1, high = mesh.edges_from_trailing()[i + 1] - 1;
        while (k < x_.size() && x_[k] <= low) ++k;
        for (Eigen::Index j = k; j < x_.size() && x_[j - 1] < high; ++j) {
            const double from = (std::max)(low, x_[j - 1]), to = (std::min)(high, x_[j]);
            // an element within a segment has its own width, which is more accurate than a difference of edges
            const double share = from == low && to == high ? 1.0 : (to - from) / mesh.widths()[i];
            if (to > from) mean[i] += share * at((from + to) / 2, j);
        }
    }
    return mean;
}

ROLLBEM_DECL double PressureTable::at(double x, Eigen::Index j) const {
    const double part = (x - x_[j - 1]) / (x_[j] - x_[j - 1]);
    return (1 - part) * pressure_[j - 1] + part * pressure_[j];
}

}  // namespace rollbem
