// Bodies of scene/patch_contact.hpp. Internal.
#pragma once

#include "../patch_contact.hpp"

#include <cmath>
#include <string>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL PatchContact::Outline::Outline(ArrayX<double> y, ArrayX<double> trailing, ArrayX<double> leading)
    : y_(std::move(y)), trailing_(std::move(trailing)), leading_(std::move(leading)) {
    const Eigen::Index lines = y_.size();
    detail::require(lines >= 2, "Outline", "number of lines", lines, "be at least 2");
    detail::require(trailing_.size() == lines, "Outline", "number of trailing edges", trailing_.size(),
                    "equal the number of y");
    detail::require(leading_.size() == lines, "Outline", "number of leading edges", leading_.size(),
                    "equal the number of y");
    for (Eigen::Index i = 0; i < lines; ++i) {
        check(i, "y", y_[i], detail::is_finite(y_[i]), "be finite");
        check(i, "x_trailing", trailing_[i], detail::is_finite(trailing_[i]), "be finite");
        check(i, "x_leading", leading_[i], detail::is_finite(leading_[i]), "be finite");
        check(i, "y", y_[i], i == 0 || y_[i] > y_[i - 1], "be larger than on the line before it");
        check(i, "x_leading - x_trailing", leading_[i] - trailing_[i], leading_[i] >= trailing_[i],
              "not be negative: the edges cross");
        check(i, "x_leading - x_trailing", leading_[i] - trailing_[i],
              leading_[i] > trailing_[i] || i == 0 || i + 1 == lines,
              "be positive except on the first and the last line");
    }
    for (Eigen::Index i = 1; i < lines; ++i) {
        area_ += (y_[i] - y_[i - 1]) * ((leading_[i] - trailing_[i]) + (leading_[i - 1] - trailing_[i - 1])) / 2;
    }
    detail::require_positive("Outline", "area", area_);
}

ROLLBEM_DECL void PatchContact::Outline::check(Eigen::Index line, const char* quantity, double value, bool holds,
                                               const char* rule) {
    if (holds) return;
    const std::string name = std::string(quantity) + " of line " + detail::to_text(line + 1);
    detail::require(false, "Outline", name.c_str(), value, rule);
}

ROLLBEM_DECL double PatchContact::Outline::at(const ArrayX<double>& edge, double y) const {
    const double* const inner = y_.data() + 1;
    const Eigen::Index j = std::upper_bound(inner, inner + y_.size() - 2, y) - y_.data();
    const double part = (y - y_[j - 1]) / (y_[j] - y_[j - 1]);
    return (1 - part) * edge[j - 1] + part * edge[j];
}

ROLLBEM_DECL SemiAxes::AlongRolling rolling_ellipse(const SemiAxes& turned, double turn) noexcept {
    const double a = turned.half_length, b = turned.half_width, cosine = std::cos(turn), sine = std::sin(turn);
    // extents over a and b
    const double along = std::hypot(cosine, b / a * sine), across = std::hypot(cosine, a / b * sine);
    const double scale = std::sqrt(along / across);
    SemiAxes::AlongRolling result{.axes = {a * scale, b / scale}, .by_half_length{}, .by_half_width{}, .by_turn{}};
    const auto [length, width] = result.axes;
    // a'^2 = a b e, e the ratio of the extents; derivatives of ln e by ln a (minus the derivative by ln b) and by the
    // turn
    const double x = cosine / along, y = sine / across;
    const double by_log_a = x * x - a / b * y * (a / b * y);
    const double slope = -(a / b - b / a) * sine * cosine * (b / a / (along * along) + a / b / (across * across));
    result.by_half_length = {length * (1 + by_log_a) / (2 * a), width * (1 - by_log_a) / (2 * a)};
    result.by_half_width = {length * (1 - by_log_a) / (2 * b), width * (1 + by_log_a) / (2 * b)};
    result.by_turn = {length * slope / 2, -width * slope / 2};
    return result;
}

}  // namespace rollbem
