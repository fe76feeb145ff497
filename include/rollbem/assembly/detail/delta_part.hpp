// The delta function of a kernel that has one, integrated: the contribution of a layer's compliance to G and G'. It
// depends only on which points lie in which elements.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

/// The integrals of compliance delta(x). Keeps a reference to the entries.
///
/// - Displacement at a point: 1 inside the element, 0 outside and 1/2 on an edge, but 0 on the leading edge of the
///   contact if the rows are unloaded_ahead.
/// - Displacement averaged over +-delta: the part of the interval that lies inside the element.
/// - Slope: a difference of such parts; at a point it does not exist.
template <class Scalar>
class DeltaPart {
public:
    DeltaPart(const Entries<Scalar>& entries, Scalar compliance) : entries_(entries), compliance_(compliance) {}

    /// Adds every entry to result(l, m).
    void add(MatrixX<Scalar>& result) const {
        for (Eigen::Index m = 0; m < result.cols(); ++m) {
            const Scalar h = entries_.columns.half[m];
            const Scalar from = (std::min)(entries_.columns.from_trailing[m], entries_.columns.from_leading[m]);
            const bool leading = entries_.columns.from_leading[m] < 3 * h / 2;  // its leading edge is the contact's
            const Scalar front = leading && entries_.rows.unloaded_ahead ? Scalar(0) : Scalar(0.5);
            for (Eigen::Index l = 0; l < result.rows(); ++l) {
                const Scalar d = entries_.distance(l, m), delta = entries_.rows.half[l];
                const Scalar reach = h + Scalar(entries_.averages) * delta;
                if (std::abs(d) > 2 * reach) continue;
                // distances are as accurate as positions, which are measured from the nearer edge of the contact
                const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * (from + reach);
                result(l, m) += compliance_ * entry(d, h, delta, front, (std::min)(rounding, h / 8));
            }
        }
    }

private:
    // `front`: the displacement on the element's leading edge
    Scalar entry(Scalar d, Scalar h, Scalar delta, Scalar front, Scalar rounding) const {
        const int differences = entries_.slope() ? 1 : 0, averages = entries_.averages - differences;
        const auto share = [&](Scalar x) {
            if (averages == 0) return inside(x, h, front, rounding);
            return (std::max)(Scalar(0), (std::min)(x + delta, h) - (std::max)(x - delta, -h)) / (2 * delta);
        };
        return differences == 0 ? share(d) : (share(d + delta) - share(d - delta)) / (2 * delta);
    }

    static Scalar inside(Scalar x, Scalar h, Scalar front, Scalar rounding) {
        const Scalar beyond = std::abs(x) - h;
        if (std::abs(beyond) <= rounding) return x < 0 ? Scalar(0.5) : front;
        return beyond < 0 ? Scalar(1) : Scalar(0);
    }

    const Entries<Scalar>& entries_;
    Scalar compliance_;
};

}  // namespace rollbem::detail
