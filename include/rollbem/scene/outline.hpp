// Outline: a contact area that each line along the rolling direction cuts in one interval, given by its trailing and
// leading edges at some y, and straight between these.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// The edges of a contact area over y, linear between the given lines y = const. Creepages, spin and moment refer to
/// the origin of its coordinates.
///
/// Invariant: at least two lines, all numbers finite, y strictly increasing, trailing < leading; on the first and the
/// last line both may be equal (a tip). The area is positive and finite.
class Outline {
public:
    /// y, x of the trailing and x of the leading edge of each line [m, or any unit of length]. Throws
    /// std::invalid_argument, with the number of the line from 1, if they break the invariant.
    Outline(ArrayX<double> y, ArrayX<double> trailing, ArrayX<double> leading)
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

    const ArrayX<double>& y() const { return y_; }
    double low() const { return y_[0]; }               ///< smallest y
    double high() const { return y_[y_.size() - 1]; }  ///< largest y
    double area() const { return area_; }

    /// x of an edge at low() <= y <= high().
    double trailing(double y) const { return at(trailing_, y); }
    double leading(double y) const { return at(leading_, y); }

private:
    static void check(Eigen::Index line, const char* quantity, double value, bool holds, const char* rule) {
        if (holds) return;
        const std::string name = std::string(quantity) + " of line " + detail::to_text(line + 1);
        detail::require(false, "Outline", name.c_str(), value, rule);
    }

    double at(const ArrayX<double>& edge, double y) const {
        const double* const inner = y_.data() + 1;
        const Eigen::Index j = std::upper_bound(inner, inner + y_.size() - 2, y) - y_.data();
        const double part = (y - y_[j - 1]) / (y_[j] - y_[j - 1]);
        return (1 - part) * edge[j - 1] + part * edge[j];
    }

    ArrayX<double> y_, trailing_, leading_;
    double area_ = 0;
};

}  // namespace rollbem
