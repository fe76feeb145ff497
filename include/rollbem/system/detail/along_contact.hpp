// AlongContact: values at the points of elements as a function of the place along each strip. Internal.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../rolling_system.hpp"

namespace rollbem::detail {

/// Piecewise linear function of x in each strip with given values at the points of its elements, and the value `ahead`
/// from the strip's leading edge on, or from its last point on if this point lies in front of the edge; constant behind
/// the first point.
template <class Scalar>
class AlongContact {
public:
    struct Point {
        Scalar value;
        Scalar slope;  ///< slope; at one of the points, the slope behind it
    };

    AlongContact(const Elements<Scalar>& elements, const Scalar* values, Scalar ahead)
        : elements_(elements), values_(values), ahead_(ahead) {}

    /// At x in the strip of element i. Elements come in their order, and x must not decrease within a strip.
    Point operator()(Eigen::Index i, Scalar x) {
        if (elements_.behind[static_cast<std::size_t>(i)] < 0) {
            first_ = next_ = last_ = i;
            while (!elements_.leads(last_)) ++last_;
        }
        const ArrayX<Scalar>& points = elements_.x;
        while (next_ <= last_ && points[next_] < x) ++next_;
        const bool between = next_ <= last_;
        const Scalar edge = elements_.leading_edge.size() > 0 ? elements_.leading_edge[i] : Scalar(1);
        const Scalar right = between ? points[next_] : edge, value = between ? values_[next_] : ahead_;
        if (next_ == first_ || (!between && x >= right)) return {value, 0};
        const Scalar slope = (value - values_[next_ - 1]) / (right - points[next_ - 1]);
        return {value - (right - x) * slope, slope};
    }

private:
    const Elements<Scalar>& elements_;
    const Scalar* values_;
    Scalar ahead_;
    Eigen::Index first_ = 0, next_ = 0, last_ = 0;
};

}  // namespace rollbem::detail
