// The root of a function that rises, and may jump.
#pragma once

#include <algorithm>
#include <limits>

#include "finite.hpp"

namespace rollbem::detail {

/// Finds the root by secants between bounds; the interval is halved where a secant leaves it, and at least in every
/// third step.
class RisingRoot {
public:
    /// `rate` is the first guess of the derivative.
    explicit RisingRoot(double rate, double largest_step = std::numeric_limits<double>::infinity())
        : rate_(rate), largest_step_(largest_step) {}

    /// The next place to try, from the value at the last one.
    double next(double x, double value) {
        (value < 0 ? low_ : high_) = x;
        const double rate = (value - value_) / (x - x_);
        if (is_finite(rate) && rate > 0) rate_ = rate;
        x_ = x;
        value_ = value;
        const double to = x - std::clamp(value / rate_, -largest_step_, largest_step_);
        const bool bounded = is_finite(width());
        steps_ = bounded ? steps_ + 1 : 0;
        return (to > low_ && to < high_ && steps_ % 3 != 2) || !bounded ? to : (low_ + high_) / 2;
    }

    double width() const { return high_ - low_; }  ///< distance between the bounds

private:
    double rate_, largest_step_;
    double low_ = -std::numeric_limits<double>::infinity(), high_ = -low_;
    double x_ = std::numeric_limits<double>::quiet_NaN(), value_ = 0;
    int steps_ = 0;
};

}  // namespace rollbem::detail
