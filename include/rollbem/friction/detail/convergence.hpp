// Whether a scheme converges to full adhesion: by proof, else judged from its tractions in steady rolling. Slip hides
// what is wrong with a scheme that does not; in full adhesion it shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../adhesion/dissipation.hpp"
#include "../../detail/fingerprint.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../rolling/consistency.hpp"
#include "../../system/element_blocks.hpp"
#include "../../system/elements.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"

namespace rollbem {

namespace detail {

/// The fingerprint of G' and the elements' areas, by which states are recognised.
template <class Scalar>
std::uint64_t fingerprint_of_steady(const MatrixX<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    fingerprint.add(G_prime);
    fingerprint.add(areas);
    return fingerprint.value();
}
template <class Scalar>
std::uint64_t fingerprint_of_steady(const DirectionBlocks<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    Fingerprint fingerprint;
    add_blocks(G_prime, fingerprint);
    fingerprint.add(areas);
    return fingerprint.value();
}

/// True if G' is dissipative. Otherwise false if the tractions of full adhesion at unit creepages, G' p = inputs, assist
/// the creepage by more than the `allowed` share. True also if G' is so nearly singular that nothing follows from them.
/// The first n unknowns are tractions along the first input, and so on.
template <class Scalar>
bool converges(MatrixX<Scalar> G_prime, const ArrayX<Scalar>& areas, double allowed = largest_assisting_share) {
    if (is_dissipative(G_prime, areas)) return true;
    const Eigen::Index n = areas.size(), count = G_prime.rows() / n;
    const Scalar norm = G_prime.cwiseAbs().rowwise().sum().maxCoeff();
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(G_prime.rows()));
    factorise_in_place<Scalar>(G_prime, swaps.data());
    for (Eigen::Index d = 0; d < count; ++d) {
        VectorX<Scalar> p = VectorX<Scalar>::Zero(G_prime.rows());
        p.segment(d * n, n).setOnes();
        solve_in_place<Scalar>(G_prime, swaps.data(), p);
        const Scalar condition = norm * p.cwiseAbs().maxCoeff();  // at most the true one
        const Scalar rounding = static_cast<Scalar>(G_prime.rows()) * std::numeric_limits<Scalar>::epsilon();
        if (!all_finite(p) || !(condition * rounding * 100 < 1)) return true;
        const VectorX<Scalar> along = p.segment(d * n, n);
        if (!opposes_creepage<Scalar>(along, areas, allowed)) return false;
    }
    return true;
}
template <class Scalar>
bool converges(const DirectionBlocks<Scalar>& G_prime, const ArrayX<Scalar>& areas) {
    if (G_prime[0][1].size() > 0) return converges(joined(G_prime), areas, largest_assisting_share_of_patch);
    return converges(G_prime[0][0], areas) && converges(G_prime[1][1], areas);
}

}  // namespace detail

}  // namespace rollbem
