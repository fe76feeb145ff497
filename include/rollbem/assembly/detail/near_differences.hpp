// Entries near the singularity: differences of the logarithm's antiderivatives, in closed form.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

/// The integral over an element is a difference of the antiderivative at its edges; each average over 2 delta adds one
/// more difference, of the next antiderivative. Keeps references to its arguments.
template <class Scalar>
class NearDifferences {
public:
    using Array = ArrayX<Scalar>;

    NearDifferences(const Entries<Scalar>& entries, const SmoothSplit<Scalar>& split)
        : entries_(entries), split_(split) {}

    /// Writes every near entry to result(l, m), and entries between near ones.
    void fill(MatrixX<Scalar>& result) const {
        const Eigen::Index n = entries_.columns.half.size(), points = entries_.averages + 1;
        Array edges;
        for (Eigen::Index l = 0; l < entries_.count; ++l) {
            Eigen::Index first = 0, end = n;
            while (first < n && !entries_.is_near(l, first)) ++first;
            while (end > first && !entries_.is_near(l, end - 1)) --end;
            if (first == end) continue;
            // the differences run over the elements' edges, which neighbours share, and, once for each average, over
            // +-delta about the point
            const Eigen::Index count = end - first, stride = count + 1;
            const Scalar delta = entries_.rows.half[l];
            const Eigen::Index next =
                entries_.equal_widths ? 1 : stride;  // the shifted edges are then the neighbours' edges
            edges.resize((points - 1) * next + stride);
            for (Eigen::Index i = 0; i < stride; ++i) {
                const Eigen::Index m = (std::min)(first + i, end - 1);
                const Scalar h = i < count ? entries_.columns.half[m] : -entries_.columns.half[m];
                const Scalar distance = entries_.distance(l, m) + h;
                for (Eigen::Index k = 0; k < points; ++k) {
                    edges[k * next + i] = distance + static_cast<Scalar>(points - 1 - 2 * k) * delta;
                }
            }
            const Array values = antiderivative(edges);
            Scalar divisor = 1;
            for (int k = 0; k < entries_.averages; ++k) divisor *= 2 * delta;
            for (Eigen::Index i = 0; i < count; ++i) {
                const auto element = [&](Eigen::Index point) {
                    const Scalar* const v = values.data() + point * next + i;
                    return v[0] - v[1];
                };
                const Scalar sum = points == 1   ? element(0)
                                   : points == 2 ? element(0) - element(1)
                                                 : (element(0) - element(1)) - (element(1) - element(2));
                result(l, first + i) = sum / divisor;
            }
        }
    }

private:
    // Antiderivative of the logarithm: for the slope integrated once for each average, for the displacement once more;
    // constants that cancel in the slope are left out.
    Array antiderivative(const Array& x) const {
        const int level = entries_.averages + (entries_.slope() ? 0 : 1);
        const Scalar s = split_.strength, harmonic[] = {0, 1, Scalar(1.5)};
        const Scalar constant = entries_.slope() ? Scalar(0) : split_.constant + s * harmonic[level];
        // x^k ln|x| is 0 at x = 0
        Array result = log_of_magnitude(x, level > 0 ? (std::numeric_limits<Scalar>::min)() : Scalar(0));
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            const Scalar power = level == 0 ? 1 : level == 1 ? x[i] : x[i] * x[i] / 2;
            result[i] = power * (constant - s * result[i]);
        }
        return result;
    }

    const Entries<Scalar>& entries_;
    const SmoothSplit<Scalar>& split_;
};

}  // namespace rollbem::detail
