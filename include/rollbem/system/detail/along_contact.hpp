// AlongContact: values at points of a line contact as a function of the place. Internal.
#pragma once

#include <Eigen/Core>

#include "../../types.hpp"

namespace rollbem::detail {

/// Piecewise linear function of x/a with given values at the `points`, in ascending order, and the value `ahead` from
/// the leading edge on, or from the last point on if this point lies in front of the contact; constant behind the first
/// point.
template <class Scalar>
class AlongContact {
public:
    struct Point {
        Scalar value;
        Scalar slope;  ///< slope; at one of the points, the slope behind it
    };

    AlongContact(const ArrayX<Scalar>& points, const Scalar* values, Scalar ahead)
        : points_(points), values_(values), ahead_(ahead) {}

    /// Arguments must not decrease from call to call.
    Point operator()(Scalar x) {
        while (next_ < points_.size() && points_[next_] < x) ++next_;
        const bool between = next_ < points_.size();
        const Scalar right = between ? points_[next_] : Scalar(1), value = between ? values_[next_] : ahead_;
        if (next_ == 0 || (!between && x >= right)) return {value, 0};
        const Scalar slope = (value - values_[next_ - 1]) / (right - points_[next_ - 1]);
        return {value - (right - x) * slope, slope};
    }

private:
    const ArrayX<Scalar>& points_;
    const Scalar* values_;
    Scalar ahead_;
    Eigen::Index next_ = 0;
};

}  // namespace rollbem::detail
