// Interpolation by cubic B-splines on uniform nodes.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace rollbem::detail {

/// Weights of the four B-splines that overlap an interval, at t = 0 ... 1 in it.
struct SplineWeights {
    std::array<double, 4> value, slope;  ///< slope by t

    explicit SplineWeights(double t)
        : value{sixth * (1 - t) * (1 - t) * (1 - t), sixth * (4 + t * t * (3 * t - 6)),
                sixth * (1 + 3 * t * (1 + t * (1 - t))), sixth * t * t * t},
          slope{-0.5 * (1 - t) * (1 - t), t * (1.5 * t - 2), 0.5 + t * (1 - 1.5 * t), 0.5 * t * t} {}

private:
    static constexpr double sixth = 1.0 / 6;
};

/// Turns values at `count` >= 4 nodes, `stride` apart, into the coefficients of the interpolating spline. At both ends
/// its second derivative is taken from the cubic through four nodes. Value: double, or an array of them.
template <class Value>
void to_spline_coefficients(Value* values, std::ptrdiff_t count, std::ptrdiff_t stride, std::vector<double>& factors) {
    const auto at = [&](std::ptrdiff_t i) -> Value& { return values[i * stride]; };
    const auto end = [&](std::ptrdiff_t i, std::ptrdiff_t step) {
        return Value((4 * at(i) + 5 * at(i + step) - 4 * at(i + 2 * step) + at(i + 3 * step)) / 6);
    };
    const Value first = end(0, 1), last = end(count - 1, -1);
    at(0) = first;
    at(count - 1) = last;
    // (c[i-1] + 4 c[i] + c[i+1])/6 = value in between
    factors.assign(static_cast<std::size_t>(count), 0.0);
    for (std::ptrdiff_t i = 1; i < count - 1; ++i) {
        const auto k = static_cast<std::size_t>(i);
        factors[k] = 1 / (4 - factors[k - 1]);
        at(i) = (6 * at(i) - at(i - 1)) * factors[k];
    }
    for (std::ptrdiff_t i = count - 2; i > 0; --i) at(i) -= factors[static_cast<std::size_t>(i)] * at(i + 1);
}

}  // namespace rollbem::detail
