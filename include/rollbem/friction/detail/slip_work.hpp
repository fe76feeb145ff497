// Frictional heat of each element: slip is known at the collocation points, tractions on the elements. And the elastic
// energy that a step releases and that neither its slip work nor the energy left contains.
#pragma once

#include <limits>
#include <utility>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "centre_values.hpp"

namespace rollbem::detail {

/// Work of tractions against slip, element by element, with the slip at the element's centre: CentreValues. At alpha =
/// 0.5 on a line, where the collocation point of an element is its leading edge, this is the mean of the slips at its
/// two edges. The slip of the element's own equation would give an error of first order.
///
/// Where slip is turned, with the traction against the slip at the centre, elements that slip never gain energy. One
/// that sticks ahead of one that slips gets -p_i . s_(i-1)/2, of either sign, which the sum needs.
///
/// Lengths in units of a, tractions in G. The works of two directions add up in the same sum.
template <class Scalar>
class SlipWork {
public:
    SlipWork(const ArrayX<Scalar>& widths, CentreValues<Scalar> centres, bool turned = false)
        : widths_(widths), centres_(std::move(centres)), turned_(turned) {}

    /// In strips on a patch the slip of each element's own equation is used unless slip is turned.
    SlipWork(const Elements<Scalar>& elements, bool turned)
        : SlipWork(elements.areas,
                   turned ? CentreValues<Scalar>::in_strips(elements.behind)
                          : CentreValues<Scalar>::in_one_strip(elements.areas,
                                                               elements.is_one_strip() ? elements.x : ArrayX<Scalar>()),
                   turned) {}

    const CentreValues<Scalar>& centres() const { return centres_; }

    /// Adds -p s dx of each element to `work`; `half_length` is that of the contact.
    template <class Traction, class Slip>
    void add(const Traction& traction, const Slip& slip, VectorX<Scalar>& work, Scalar half_length = 1) const {
        for (Index i = 0; i < widths_.size(); ++i) {
            work[i] -= half_length * widths_[i] * traction[i] * centres_.at(i, slip);
        }
    }

    /// Sum of p u dx over all elements and directions; twice the elastic energy if u are the displacements in all
    /// equations.
    template <class Traction, class Displacement>
    Scalar product(const Traction& traction, const Displacement& displacement) const {
        Scalar sum = 0;
        for (Index d = 0; d < traction.cols(); ++d) {
            for (Index i = 0; i < widths_.size(); ++i) {
                sum += widths_[i] * traction(i, d) * centres_.at(i, displacement.col(d));
            }
        }
        return sum;
    }

    /// Completes a sum: multiplies it by `unit` and, unless slip is turned, removes negative values. No element gains
    /// energy, but interpolation may yield a gain of second order where the slip changes sign or vanishes within an
    /// element.
    void end(VectorX<Scalar>& work, Scalar unit = 1) const {
        if (!turned_) work = work.cwiseMax(Scalar(0));
        work *= unit;
    }

private:
    using Index = Eigen::Index;

    ArrayX<Scalar> widths_;
    CentreValues<Scalar> centres_;
    bool turned_;
};

/// Slip work takes the tractions at the end of a stage. Let (x, y) be the integral of x times the displacement caused
/// by y, so that E(p) = (p, p)/2, and p_0, p_1, p_2 the tractions at the start of a step and after its stages. The
/// equations of the stages, s = rigid - u' + (change of u), times their tractions give
///
///     work of the rigid bodies = slip work + E(p_2) - E(p_0) + J
///     J = (b, b)/2,                       b = p_2 - p_0, for one stage (implicit Euler)
///     J = (b, b)/2 - r (a, b - a),        a = p_1 - p_0, r = StagePlace::ratio(), for two stages (sdirk2)
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
        : first_(Vectors::Zero(n, directions)), change_(first_), first_change_(first_), displacement_(first_) {}

    /// The tractions after the first of two stages.
    void keep_first(const Vectors& traction) { first_ = traction; }

    /// J of a step that rolls, per unit of G a_0^2, with the semi-axes `axes` at its end; `ratio`: see
    /// StagePlace; 0 for one stage, else after keep_first().
    template <class System, class Start>
    Scalar rolled(const System& system, const SlipWork<Scalar>& work, const SemiAxes<Scalar>& axes, Scalar ratio,
                  const Eigen::MatrixBase<Start>& start, const Vectors& end) {
        change_ = end - start;
        const bool two_stages = ratio != 0;
        if (two_stages) first_change_ = first_ - start;
        // settled: J is below the rounding of the energies
        const Scalar least = std::numeric_limits<Scalar>::epsilon() * end.squaredNorm();
        if (change_.squaredNorm() <= least && (!two_stages || first_change_.squaredNorm() <= least)) return 0;
        find_displacements(system, axes, change_, displacement_);
        Scalar sum = work.product(change_, displacement_) / 2;
        if (two_stages) {
            change_ = end - first_;
            find_displacements(system, axes, change_, displacement_);
            sum -= ratio * work.product(first_change_, displacement_);
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
    Vectors first_, change_, first_change_, displacement_;
};

}  // namespace rollbem::detail
