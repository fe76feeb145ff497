// Requirements of every model in the time domain on its scheme: eigenvalues that do not grow, and convergence to full
// adhesion. Internal.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../detail/require.hpp"
#include "../../types.hpp"
#include "../rolling_system.hpp"
#include "dissipation.hpp"

namespace rollbem::detail {

/// The tractions of steady rolling at unit creepage, G' p = 1, by an LU that needs no Eigen header; with several
/// directions, the n unknowns of this direction begin at `first`.
template <class Scalar>
VectorX<Scalar> steady_tractions(MatrixX<Scalar> G_prime, Eigen::Index first, Eigen::Index n) {
    std::vector<Eigen::Index> swaps(static_cast<std::size_t>(G_prime.rows()));
    VectorX<Scalar> p = VectorX<Scalar>::Zero(G_prime.rows());
    p.segment(first, n).setOnes();
    factorise_in_place<Scalar>(G_prime, swaps.data());
    solve_in_place<Scalar>(G_prime, swaps.data(), p);
    return p.segment(first, n);
}

/// Throws std::invalid_argument unless the verdict covers n eigenvalues and establishes that none grows.
inline void require_stable(const char* who, Eigen::Index n, const StabilityVerdict& verdict) {
    require(verdict.n == n, who, "n of the verdict", verdict.n, "equal the number of unknowns");
    require(verdict.status == Status::ok, who, "status of the verdict", name(verdict.status), "be ok");
    require(verdict.unstable_count == 0, who, "unstable_count", verdict.unstable_count,
            "be 0: a mode of the scheme grows without bound");
    require(verdict.stable(), who, "uncertain_count", verdict.uncertain_count,
            "be 0: rounding leaves open whether a mode grows");
}

/// Throws std::invalid_argument if steady tractions show that the scheme does not converge to full adhesion
/// (Status::assists_creepage).
template <class Scalar, class Areas>
void require_convergent(const char* who, const VectorX<Scalar>& steady, const Areas& areas,
                        double allowed = largest_assisting_share) {
    require(all_finite(steady), who, "largest steady traction", std::numeric_limits<Scalar>::infinity(),
            "be finite: G_prime is singular");
    const Scalar share = assisting_share<Scalar>(steady.array(), areas);
    const std::string rule =
        "be at most " + to_text(allowed) + ": the scheme does not converge to full adhesion (alpha <= 0, or alpha > 1)";
    require(is_finite(share) && share <= Scalar(allowed), who, "share of steady traction that assists the creepage",
            share, rule.c_str());
}

/// True if G' is dissipative. Otherwise false if the tractions of full adhesion at unit creepages, G' p = inputs,
/// assist the creepage by more than the `allowed` share. True also if G' is so nearly singular that the tractions are
/// meaningless. The first n unknowns are tractions along the first input, and so on.
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
        const Scalar condition = norm * p.cwiseAbs().maxCoeff();  // not greater than the true condition
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

/// The requirements of every time-domain model: its eigenvalues do not grow, and its scheme converges to full adhesion.
template <class Scalar>
void require_usable_in_time(const char* who, const RollingSystem<Scalar>& system, const StabilityVerdict& verdict) {
    require_G(who, system);
    if (!verdict.checked) return;
    require_stable(who, system.size(), verdict);
    if (!system.unknowns_are_tractions()) return;
    require_convergent<Scalar>(who, steady_tractions(system.G_prime(), 0, system.size()), system.weights());
}

/// The requirements in two directions, with a verdict on all 2n eigenvalues.
template <class Scalar>
void require_usable_in_time(const char* who, const ElementSystem<Scalar, 2>& system, const StabilityVerdict& verdict) {
    require_G(who, system);
    if (!verdict.checked) return;
    const Eigen::Index n = system.size();
    const ArrayX<Scalar>& areas = system.elements().areas;
    require_stable(who, 2 * n, verdict);
    if (system.coupled() && is_dissipative(joined(system.G_prime_blocks()), areas)) return;
    for (std::size_t d = 0; d < 2; ++d) {
        if (system.coupled()) {
            const VectorX<Scalar> steady = steady_tractions(joined(system.G_prime_blocks()), d == 0 ? 0 : n, n);
            require_convergent<Scalar>(who, steady, areas, largest_assisting_share_of_patch);
        } else {
            require_convergent<Scalar>(who, steady_tractions(system.G_prime(d, d), 0, n), areas);
        }
    }
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template VectorX<double> detail::steady_tractions<double>(MatrixX<double>, Eigen::Index, Eigen::Index);
extern template void detail::require_convergent<double, ArrayX<double>>(const char*, const VectorX<double>&,
                                                                        const ArrayX<double>&, double);
extern template void detail::require_usable_in_time<double>(const char*, const RollingSystem<double>&,
                                                            const StabilityVerdict&);
extern template bool detail::converges<double>(MatrixX<double>, const ArrayX<double>&, double);
extern template bool detail::converges<double>(const detail::DirectionBlocks<double>&, const ArrayX<double>&);
extern template void detail::require_usable_in_time<double>(const char*, const ElementSystem<double, 2>&,
                                                            const StabilityVerdict&);
}  // namespace rollbem
#endif
