// The creepages at which the ellipse of a point of contact has the forces of the patch.
#pragma once

#include <array>
#include <cmath>

#include "../creep_force_table.hpp"
#include "contact_row.hpp"

namespace rollbem::detail {

/// Creepages at which an ellipse has the forces of the patch that it stands for: the patch's creepages times E^-1 L
/// while the contact sticks. In full sliding two factors remain: the scale, which does not turn the slip, and the share
/// `full_sliding_share` of the rest. Half-way the bend is added. `of(row)` are numbers of the point, `bound` is mu N.
template <class Scalar, class Rows>
std::array<Scalar, 3> ellipse_creepages(const std::array<Scalar, 3>& creepage, const Scalar& a, const Scalar& b,
                                        double shear_modulus, const Scalar& bound, const Rows& of) {
    using std::sqrt;
    using enum ContactRow::Of;
    const Scalar size = of(creepage_scale), c = sqrt(a * b);
    const Scalar xi = creepage[0] * size, eta = creepage[1] * size, spin = creepage[2] * c * size;
    const Scalar along = of(c11) * xi, across = of(c22) * eta + of(c23) * spin;
    const Scalar turning = of(c11) * of(c22) * spin * spin, square = along * along + across * across + turning;
    const Scalar slip = sqrt(square + Scalar(1e-200)) * (shear_modulus * a * b);  // no division by 0 in its derivative
    const Scalar sticking = bound * CreepForceTable::Grid::saturation_scale;
    const Scalar sum = sticking + slip, stick = sum > 0 ? Scalar(sticking / sum) : Scalar(1);
    const Scalar reach = of(full_sliding_share) + (1 - of(full_sliding_share)) * stick,
                 middle = 4 * stick * (1 - stick), half = middle * middle;
    const auto corrected = [&](const Scalar& own, Eigen::Index row) -> Scalar {
        const auto by = [&](Eigen::Index matrix) -> Scalar {
            const Eigen::Index entry = matrix + 3 * row;
            return of(entry) * xi + of(entry + 1) * eta + of(entry + 2) * spin;
        };
        return own + reach * by(correction) + half * by(bend);
    };
    return {corrected(xi, 0), corrected(eta, 1), corrected(spin, 2) / c};
}

}  // namespace rollbem::detail
