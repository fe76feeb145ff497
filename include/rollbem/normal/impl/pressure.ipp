// Bodies of normal/pressure.hpp. Internal.
#pragma once

#include "../pressure.hpp"

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

ROLLBEM_DECL PressureGrid::PressureGrid(ArrayX<double> x, ArrayX<double> y, MatrixX<double> pressure)
    : x_(std::move(x)), y_(std::move(y)), pressure_(std::move(pressure)) {
    require_ascending("number of x", "x", x_);
    require_ascending("number of y", "y", y_);
    detail::require(pressure_.rows() == x_.size() && pressure_.cols() == y_.size(), "PressureGrid",
                    "number of pressures", pressure_.size(), "equal the number of points");
    for (const double value : pressure_.reshaped()) {
        detail::require_not_negative("PressureGrid", "pressure", value);
    }
    const double load = integral();
    detail::require_positive("PressureGrid", "load", load);
}

ROLLBEM_DECL auto PressureGrid::operator()(const std::vector<PatchMesh<double>::Rectangle>& elements) const
    -> ArrayX<double> {
    ArrayX<double> mean(static_cast<Eigen::Index>(elements.size()));
    Eigen::Index i = 0;
    for (const PatchMesh<double>::Rectangle& element : elements) {
        const double area = (element.x_2 - element.x_1) * (element.y_2 - element.y_1);
        detail::require(detail::is_finite(area) && element.x_1 < element.x_2 && area > 0, "PressureGrid",
                        "area of an element", area, "be positive and finite");
        mean[i++] = over(element) / area;
    }
    return mean;
}

ROLLBEM_DECL void PressureGrid::require_ascending(const char* number, const char* name, const ArrayX<double>& knots) {
    detail::require(knots.size() >= 2, "PressureGrid", number, knots.size(), "be at least 2");
    for (Eigen::Index i = 0; i < knots.size(); ++i) {
        detail::require(detail::is_finite(knots[i]) && (i == 0 || knots[i] > knots[i - 1]), "PressureGrid", name,
                        knots[i], "be finite and larger than the value before");
    }
}

ROLLBEM_DECL auto PressureGrid::weights(const ArrayX<double>& knots, double low, double high) -> Weights {
    const double* const begin = knots.data();
    const Eigen::Index size = knots.size();
    Eigen::Index k = std::max<Eigen::Index>(std::upper_bound(begin, begin + size, low) - begin - 1, 0);
    Weights found{k, {0}};
    for (; k + 1 < size && knots[k] < high; ++k) {
        const double from = (std::max)(low, knots[k]), to = (std::max)((std::min)(high, knots[k + 1]), from);
        const double part = ((from + to) / 2 - knots[k]) / (knots[k + 1] - knots[k]);
        found.values.back() += (to - from) * (1 - part);
        found.values.push_back((to - from) * part);
    }
    return found;
}

ROLLBEM_DECL double PressureGrid::over(const PatchMesh<double>::Rectangle& element) const {
    const Weights x = weights(x_, element.x_1, element.x_2), y = weights(y_, element.y_1, element.y_2);
    double sum = 0;
    for (std::size_t j = 0; j < y.values.size(); ++j) {
        for (std::size_t i = 0; i < x.values.size(); ++i) {
            sum += x.values[i] * y.values[j] * pressure_(x.first + Eigen::Index(i), y.first + Eigen::Index(j));
        }
    }
    return sum;
}

}  // namespace rollbem
