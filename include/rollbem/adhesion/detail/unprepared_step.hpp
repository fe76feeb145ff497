// One step in full adhesion of any dq for one state: what prepare() does for a whole matrix, on the stack.
#pragma once

#include "../../detail/language.hpp"

#include <array>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "rational_exponential.hpp"

namespace rollbem::detail {

/// For up to `largest` unknowns and two stages. Lengths are in units of the half-length.
template <class Scalar, Eigen::Index largest>
class UnpreparedStep {
public:
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1, Eigen::ColMajor, largest, 1>;

    /// Writes the unknowns after a step of dq without motion to `to`.
    void solve(const RollingSystem<Scalar>& system, const RationalExponential<Scalar>& rational, Scalar dq,
               const VectorX<Scalar>& from, VectorX<Scalar>& to) {
        const Eigen::Index n = system.size();
        const Scalar part = rational.gamma * dq;
        alignas(64) std::array<Scalar, largest * largest> memory;
        std::array<Eigen::Index, largest> swaps;
        Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n) = system.G() - part * system.G_prime();
        const MatrixRef<Scalar> factors(Eigen::Map<MatrixX<Scalar>>(memory.data(), n, n));
        factorise_in_place<Scalar>(factors, swaps.data());

        Vector unit = Vector::Constant(n, rational.gamma);
        solve_in_place<Scalar>(factors, swaps.data(), unit);
        Vector right(n);
        Vector change(n);
        change.noalias() = system.G_prime() * from;
        change *= part;
        solve_in_place<Scalar>(factors, swaps.data(), change);
        per_shift_ = rational.b(1) * unit;
        per_ramp_ = rational.ramp_weight(1) * unit;
        to = from + rational.b(1) * change;
        for (int j = 2; j <= rational.stages; ++j) {
            right.noalias() = system.G_prime() * unit;
            unit = part * right;
            solve_in_place<Scalar>(factors, swaps.data(), unit);
            per_shift_ += rational.b(j) * unit;
            per_ramp_ += rational.ramp_weight(j) * unit;
            right.noalias() = system.G_prime() * change;
            change = part * right;
            solve_in_place<Scalar>(factors, swaps.data(), change);
            to += rational.b(j) * change;
        }
    }

    const Vector& per_shift() const { return per_shift_; }  ///< decrease of the unknowns per unit shift
    const Vector& per_ramp() const { return per_ramp_; }    ///< decrease per change of creepage times dq

private:
    Vector per_shift_, per_ramp_;
};

}  // namespace rollbem::detail
