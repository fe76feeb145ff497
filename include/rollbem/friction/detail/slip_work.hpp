// Frictional heat of each element: slip is known at the collocation points, tractions on the elements. And the elastic
// energy that a step releases and that neither its slip work nor the energy left contains.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../rolling/stage_equations.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// Work of tractions against slip, element by element, with the slip at the element's centre: interpolated linearly
/// between the two neighbouring collocation points, or extrapolated from the first or last two. At alpha = 0.5, where
/// the collocation point of an element is its leading edge, this is the mean of the slips at its two edges. The slip of
/// the element's own equation would give an error of first order.
///
/// Where slip is turned, the slip at a centre is m_i/2 of TurnedSlip:
/// with the traction against it, elements that slip never gain energy. One that sticks ahead of one that slips gets
/// -p_i . s_(i-1)/2, of either sign, which the sum needs.
///
/// Lengths in units of a, tractions in G. The works of two directions add up in the same sum.
template <class Scalar>
class SlipWork {
public:
    /// `widths` of the elements with unknown tractions, beginning at the trailing edge; `points` the collocation points
    /// x/a, empty if unknown. Without points the slip of each element's own equation is used.
    SlipWork(const ArrayX<Scalar>& widths, const ArrayX<Scalar>& points)
        : widths_(widths), between_(static_cast<std::size_t>(widths.size())), shares_(widths.size()) {
        Scalar edge = 0;  // 1 + x/a of the trailing edge of element i
        for (Index i = 0; i < size(); ++i) {
            place(i, edge + widths[i] / 2, points);
            shares_[i] = between_[static_cast<std::size_t>(i)].share;
            edge += widths[i];
        }
        find_run();
    }

    /// On a line or, in strips, on a patch. There the slip of each element's own equation is used unless slip is
    /// turned.
    SlipWork(const Elements<Scalar>& elements, bool turned)
        : SlipWork(elements.areas, elements.is_one_strip() ? elements.x : ArrayX<Scalar>()) {
        if (!turned) return;
        std::vector<Index> ahead(between_.size(), -1);
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            if (elements.behind[i] >= 0) ahead[static_cast<std::size_t>(elements.behind[i])] = static_cast<Index>(i);
        }
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            const Index own = static_cast<Index>(i), behind = elements.behind[i];
            const bool trails = behind < 0, alone = trails && ahead[i] < 0;
            between_[i] = {.behind = trails ? own : behind,
                           .ahead = alone    ? own
                                    : trails ? ahead[i]
                                             : own,
                           .share = trails ? Scalar(-0.5) : Scalar(0.5)};
            shares_[own] = between_[i].share;
        }
        may_gain_ = true;
        find_run();
    }

    Eigen::Index size() const { return widths_.size(); }

    /// Slip at the centre of an element, from the slips in all equations.
    template <class Vector>
    Scalar at_centre(Eigen::Index element, const Vector& slip) const {
        const Between& between = between_[static_cast<std::size_t>(element)];
        const Scalar behind = slip[between.behind];
        return behind + between.share * (slip[between.ahead] - behind);
    }

    /// Adds -p s dx of each element to `work`; `half_length` is that of the contact.
    template <class Traction, class Slip>
    void add(const Traction& traction, const Slip& slip, VectorX<Scalar>& work, Scalar half_length = 1) const {
        const auto one_by_one = [&](Index begin, Index end) {
            for (Index i = begin; i < end; ++i) work[i] -= half_length * widths_[i] * traction[i] * at_centre(i, slip);
        };
        one_by_one(0, begin_);
        const auto behind = slip.segment(begin_ + behind_, count_).array();
        const auto ahead = slip.segment(begin_ + ahead_, count_).array();
        work.segment(begin_, count_).array() -= half_length * widths_.segment(begin_, count_) *
                                                traction.segment(begin_, count_).array() *
                                                (behind + shares_.segment(begin_, count_) * (ahead - behind));
        one_by_one(begin_ + count_, size());
    }

    /// Sum of p u dx over all elements and directions; twice the elastic energy if u are the displacements in all
    /// equations.
    template <class Traction, class Displacement>
    Scalar product(const Traction& traction, const Displacement& displacement) const {
        Scalar sum = 0;
        for (Index d = 0; d < traction.cols(); ++d) {
            const auto p = traction.col(d);
            const auto u = displacement.col(d);
            const auto one_by_one = [&](Index begin, Index end) {
                for (Index i = begin; i < end; ++i) sum += widths_[i] * p[i] * at_centre(i, u);
            };
            one_by_one(0, begin_);
            const auto behind = u.segment(begin_ + behind_, count_).array();
            const auto ahead = u.segment(begin_ + ahead_, count_).array();
            sum += (widths_.segment(begin_, count_) * p.segment(begin_, count_).array() *
                    (behind + shares_.segment(begin_, count_) * (ahead - behind)))
                       .sum();
            one_by_one(begin_ + count_, size());
        }
        return sum;
    }

    /// Completes a sum: multiplies it by `unit` and, unless it is one of means m_i/2, removes negative values. No
    /// element gains energy, but interpolation may yield a gain of second order where the slip changes sign or vanishes
    /// within an element.
    void end(VectorX<Scalar>& work, Scalar unit = 1) const {
        if (!may_gain_) work = work.cwiseMax(Scalar(0));
        work *= unit;
    }

private:
    using Index = Eigen::Index;

    // The equations on both sides of a centre, and its position between them, from 0 to 1.
    struct Between {
        Index behind, ahead;
        Scalar share = 0;
    };

    // `centre` is its 1 + x/a.
    void place(Index element, Scalar centre, const ArrayX<Scalar>& points) {
        Between& between = between_[static_cast<std::size_t>(element)];
        between = {.behind = element, .ahead = element};
        if (points.size() == 0 || size() < 2) return;
        const auto point = [&](Index k) { return 1 + points[k]; };
        Index behind = (std::min)(element, size() - 2);
        while (behind > 0 && point(behind) > centre) --behind;
        while (behind < size() - 2 && point(behind + 1) <= centre) ++behind;
        const Scalar distance = point(behind + 1) - point(behind);
        if (!(distance > 0)) return;  // the points of tiny elements may coincide after rounding
        between = {.behind = behind, .ahead = behind + 1, .share = (centre - point(behind)) / distance};
    }

    // The longest run of elements with the same offsets to their neighbours, on most meshes nearly all of them. It is
    // treated by vector operations.
    void find_run() {
        count_ = 0;
        for (Index begin = 0, end = 0; begin < size(); begin = end) {
            const auto behind = [&](Index i) { return between_[static_cast<std::size_t>(i)].behind - i; };
            const auto ahead = [&](Index i) { return between_[static_cast<std::size_t>(i)].ahead - i; };
            while (end < size() && behind(end) == behind(begin) && ahead(end) == ahead(begin)) ++end;
            if (end - begin <= count_) continue;
            begin_ = begin;
            count_ = end - begin;
            behind_ = behind(begin);
            ahead_ = ahead(begin);
        }
    }

    ArrayX<Scalar> widths_;
    std::vector<Between> between_;
    ArrayX<Scalar> shares_;
    Index begin_ = 0, count_ = 0, behind_ = 0, ahead_ = 0;  // the run
    bool may_gain_ = false;
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
