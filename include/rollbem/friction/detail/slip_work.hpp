// The work that slip turns into heat on each element: slip is known where the equations hold, tractions on elements.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"

namespace rollbem::detail {

/// Work of tractions against slip, element by element, with the slip taken at the element's centre: linear between the
/// two neighbouring points of the equations, and beyond the first or the last of them. At alpha = 0.5, where the
/// equation of an element holds at its leading edge, that is the mean of the slips at its two edges. The slip of the
/// element's own equation would leave an error of first order.
///
/// Lengths in units of a, tractions in G. Two directions share one: their works add up.
template <class Scalar>
class SlipWork {
public:
    /// `widths` of the elements with unknown tractions, which begin at the trailing edge; `points` x/a of their
    /// equations. Without points each slip is taken as it is.
    SlipWork(const ArrayX<Scalar>& widths, const std::optional<ArrayX<Scalar>>& points)
        : widths_(widths), between_(static_cast<std::size_t>(widths.size())), shares_(widths.size()) {
        Scalar edge = 0;  // 1 + x/a of the trailing edge of element i
        for (Index i = 0; i < size(); ++i) {
            place(i, edge + widths[i] / 2, points);
            shares_[i] = between_[static_cast<std::size_t>(i)].share;
            edge += widths[i];
        }
        find_run();
    }

    Eigen::Index size() const { return widths_.size(); }

    /// Slip at the centre of an element from the slips of all equations.
    template <class Vector>
    Scalar at_centre(Eigen::Index element, const Vector& slip) const {
        const Between& between = between_[static_cast<std::size_t>(element)];
        const Scalar behind = slip[between.behind];
        return behind + between.share * (slip[between.ahead] - behind);
    }

    /// Adds -p s dx of each element to `work`, on a contact of another half-length where one is given.
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

    /// Sum of p u dx of all elements: with u the displacements in all equations, twice the elastic energy.
    template <class Traction, class Displacement>
    Scalar product(const Traction& traction, const Displacement& displacement) const {
        Scalar sum = 0;
        for (Index i = 0; i < size(); ++i) sum += widths_[i] * traction[i] * at_centre(i, displacement);
        return sum;
    }

    /// Ends a sum, in other units if so wished: no element gains energy. Where the slip turns round or ends within an
    /// element, interpolation may say so, by an amount of second order.
    static void end(VectorX<Scalar>& work, Scalar unit = 1) { work = unit * work.cwiseMax(Scalar(0)); }

private:
    using Index = Eigen::Index;

    // The equations about a centre, and the share of the way from the one to the other at which it lies.
    struct Between {
        Index behind, ahead;
        Scalar share = 0;
    };

    // `centre` is its 1 + x/a.
    void place(Index element, Scalar centre, const std::optional<ArrayX<Scalar>>& points) {
        Between& between = between_[static_cast<std::size_t>(element)];
        between = {.behind = element, .ahead = element};
        if (!points || size() < 2) return;
        const auto point = [&](Index k) { return 1 + (*points)[k]; };
        Index behind = std::min(element, size() - 2);
        while (behind > 0 && point(behind) > centre) --behind;
        while (behind < size() - 2 && point(behind + 1) <= centre) ++behind;
        const Scalar distance = point(behind + 1) - point(behind);
        if (!(distance > 0)) return;  // points of tiny elements may round to one number
        between = {.behind = behind, .ahead = behind + 1, .share = (centre - point(behind)) / distance};
    }

    // The longest run of elements whose neighbours lie as many elements behind and ahead: on most meshes nearly all.
    void find_run() {
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
};

}  // namespace rollbem::detail
