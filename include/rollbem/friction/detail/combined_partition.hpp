// Which elements stick, which slip and in what direction, and the conditions of friction in two directions for each.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../../detail/length.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// The zones assumed in a Newton step. An element sticks, or slips, or has no pressure and does neither.
template <class Scalar>
struct CombinedPartition {
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;

    explicit CombinedPartition(Index n)
        : stick(Vector::Ones(n)), slide(Vector::Zero(n)), stiffness(Vector::Zero(n)), direction(Vectors::Zero(n, 2)) {}

    void let_stick(Index i) { set(i, 1); }
    void let_go(Index i) { set(i, 0); }
    /// The traction points along (x, y), whose length is `norm`; k is the slip against it over its size.
    void let_slide(Index i, Scalar x, Scalar y, Scalar norm, Scalar k) {
        stick[i] = 0;
        slide[i] = 1;
        direction(i, 0) = x / norm;
        direction(i, 1) = y / norm;
        // finite, however small the bound
        stiffness[i] = (std::min)(k, (std::numeric_limits<Scalar>::max)() / 1000);
    }

    /// Zone from the natural map, (x, y) = p - reach s. `margin`: round-off relative to the bound.
    void place(Index i, Scalar x, Scalar y, Scalar bound, Scalar reach, Scalar margin) {
        const Scalar norm = length(x, y);
        if (bound == 0) {
            let_go(i);
        } else if (norm > (1 + margin) * bound) {
            let_slide(i, x, y, norm, (norm - bound) / (bound * reach));
        } else {
            let_stick(i);
        }
    }

    /// Whether tractions and slip satisfy all conditions, to `margin` relative to each bound and to `creep` in the
    /// slip.
    bool holds(const Vector& bound, const Vectors& p, const Vectors& s, Scalar margin, Scalar creep) const {
        for (Index i = 0; i < bound.size(); ++i) {
            const Scalar x = p(i, 0), y = p(i, 1), u = s(i, 0), v = s(i, 1), norm = length(x, y);
            if (stick[i] != 0) {
                if (!(norm <= (1 + margin) * bound[i])) return false;
                if (!(length(u, v) <= creep)) return false;
            } else if (slide[i] != 0) {
                if (!(std::abs(norm - bound[i]) <= margin * bound[i])) return false;
                if (!(std::abs(x * v - y * u) <= creep * bound[i])) return false;
                if (!(x * u + y * v <= creep * bound[i])) return false;
            }
        }
        return true;
    }

    Vector stick, slide;  // 1 for the elements that do
    Vector stiffness;     // of elements that slip; 0 for others, as is the direction
    Vectors direction;

private:
    void set(Index i, Scalar sticks) {
        stick[i] = sticks;
        slide[i] = 0;
        direction.row(i).setZero();
        stiffness[i] = 0;
    }
};

/// Sum of |p - P(p - reach s)| over the elements with pressure, P the projection onto the circle of the bound: zero at
/// solutions alone.
template <class Scalar>
Scalar natural_residual(const VectorX<Scalar>& bound, const VectorX<Scalar>& reach, const ElementVectors<Scalar>& p,
                        const ElementVectors<Scalar>& s) {
    Scalar sum = 0;
    for (Eigen::Index i = 0; i < bound.size(); ++i) {
        if (bound[i] == 0) continue;
        const Scalar x = p(i, 0) - reach[i] * s(i, 0), y = p(i, 1) - reach[i] * s(i, 1), norm = length(x, y);
        const Scalar share = norm > bound[i] ? bound[i] / norm : Scalar(1);
        sum += length(p(i, 0) - share * x, p(i, 1) - share * y);
    }
    return sum;
}

}  // namespace rollbem::detail
