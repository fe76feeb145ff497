// Elastic energy that a step releases and that neither its slip work nor the energy left contains.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "rolling_stage.hpp"
#include "slip_work.hpp"

namespace rollbem::detail {

/// Slip work takes the tractions at the end of a stage. Let (x, y) be the integral of x times the displacement caused
/// by y, so that E(p) = (p, p)/2, and p_0, p_1, p_2 the tractions at the start of a step and after its stages. The
/// equations of the stages, s = rigid - u' + (change of u), times their tractions give
///
///     work of the rigid bodies = slip work + E(p_2) - E(p_0) + J
///     J = (b, b)/2,                       b = p_2 - p_0, for one stage (implicit Euler)
///     J = (b, b)/2 - r (a, b - a),        a = p_1 - p_0, r = sdirk2_ratio, for two stages (sdirk2)
///
/// because the kernel is even: the integral of p u' vanishes. While the tractions vary smoothly J is of second order in
/// dq for one stage, of third for two, where b = a/part. If they jump within a step, b stays finite however short the
/// step is, and J is the energy (b, b)/2 that the jump releases in addition, for either scheme, whichever stage the
/// jump is in. A half-length that varies within the step changes J by as much as it changes (b, b).
///
/// A rigid shift is a single stage whose work is that of the mean of the forces at both ends: J = integral of b s/2.
///
/// Lengths in a_0, tractions in G, for n elements and one direction or two. All memory is allocated by the constructor.
template <int directions, class Scalar>
class JumpWork {
public:
    using Vectors = ElementVectors<Scalar, directions>;

    explicit JumpWork(Eigen::Index n)
        : first_(Vectors::Zero(n, directions)), change_(first_), part_(first_), displacement_(first_) {}

    /// The tractions after the first of two stages.
    void keep_first(const Vectors& traction) { first_ = traction; }

    /// J of a step that rolls, per unit of G a_0^2, with the semi-axes `axes` at its end; `two_stages` after keep_first().
    template <class System, class Start>
    Scalar rolled(const System& system, const SlipWork<Scalar>& work, const SemiAxes<Scalar>& axes, bool two_stages,
                  const Eigen::MatrixBase<Start>& start, const Vectors& end) {
        change_ = end - start;
        if (two_stages) part_ = first_ - start;
        // settled: J is below the rounding of the energies
        const Scalar least = std::numeric_limits<Scalar>::epsilon() * end.squaredNorm();
        if (change_.squaredNorm() <= least && (!two_stages || part_.squaredNorm() <= least)) return 0;
        find_displacements(system, axes, change_, displacement_);
        Scalar sum = work.product(change_, displacement_) / 2;
        if (two_stages) {
            change_ = end - first_;
            find_displacements(system, axes, change_, displacement_);
            sum -= sdirk2_ratio<Scalar> * work.product(part_, displacement_);
        }
        return axes.half_length * axes.half_width * sum;
    }

    /// J of a rigid shift with this slip.
    template <class Start>
    Scalar shifted(const SlipWork<Scalar>& work, const SemiAxes<Scalar>& axes, const Eigen::MatrixBase<Start>& start,
                   const Vectors& end, const Vectors& slip) {
        change_ = end - start;
        return axes.half_length * axes.half_width * work.product(change_, slip) / 2;
    }

private:
    Vectors first_, change_, part_, displacement_;
};

}  // namespace rollbem::detail
