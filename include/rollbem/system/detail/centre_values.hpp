// CentreValues: interpolation to the centres of elements from the points of their equations. Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"

namespace rollbem::detail {

/// Each value is taken from one row, or lies on the straight line through the values of two rows.
template <class Scalar>
class CentreValues {
public:
    using Index = Eigen::Index;

    /// One strip, of elements with these `widths` from the trailing edge on: interpolated between the two neighbouring
    /// `points`, x/a, or extrapolated from the first or last two. Without points each value is taken from the element's
    /// own equation.
    static CentreValues in_one_strip(const ArrayX<Scalar>& widths, const ArrayX<Scalar>& points) {
        CentreValues values(widths.size());
        Scalar edge = 0;  // 1 + x/a of the trailing edge of an element
        for (Index i = 0; i < widths.size(); ++i) {
            values.place(i, edge + widths[i] / 2, points);
            edge += widths[i];
        }
        values.find_shares();
        return values;
    }
    /// Strips with equations half an element ahead of the centres: means of an element's own value and the value of the
    /// row `behind`; a trailing element, -1, takes 3/2 of its own value less half of the value ahead, if there is one.
    static CentreValues in_strips(const std::vector<Index>& behind) {
        CentreValues values(static_cast<Index>(behind.size()));
        for (std::size_t i = 0; i < behind.size(); ++i) {
            if (behind[i] < 0) continue;
            const auto other = static_cast<std::size_t>(behind[i]), own = i;
            values.between_[own] = {behind[i], static_cast<Index>(own), Scalar(0.5)};
            if (behind[other] < 0) values.between_[other] = {behind[i], static_cast<Index>(own), Scalar(-0.5)};
        }
        return values;
    }

    /// The value of an element, from the values of all equations.
    template <class Values>
    Scalar at(Index i, const Values& values) const {
        const Between& between = between_[static_cast<std::size_t>(i)];
        const Scalar behind = values[between.behind];
        return behind + between.share * (values[between.ahead] - behind);
    }

    /// If every centre but the first lies between the points of the element behind and of its own: the places of these
    /// centres between the points. Otherwise empty.
    const ArrayX<Scalar>& shares() const { return shares_; }

private:
    // Two equations, and the place of a centre between their points, from 0 to 1 unless it is extrapolated.
    struct Between {
        Index behind, ahead;
        Scalar share = 0;
    };

    explicit CentreValues(Index n) : between_(static_cast<std::size_t>(n)) {
        for (Index i = 0; i < n; ++i) between_[static_cast<std::size_t>(i)] = {i, i};
    }

    void find_shares() {
        const Index n = static_cast<Index>(between_.size());
        ArrayX<Scalar> shares(n - 1);
        for (Index i = 1; i < n; ++i) {
            const Between& own = between_[static_cast<std::size_t>(i)];
            if (own.behind != i - 1 || own.ahead != i) return;
            shares[i - 1] = own.share;
        }
        shares_ = std::move(shares);
    }
    // Places the centre of an element; `centre` is its 1 + x/a.
    void place(Index element, Scalar centre, const ArrayX<Scalar>& points) {
        const Index n = static_cast<Index>(between_.size());
        if (points.size() == 0 || n < 2) return;
        const auto point = [&](Index k) { return 1 + points[k]; };
        Index behind = (std::min)(element, n - 2);
        while (behind > 0 && point(behind) > centre) --behind;
        while (behind < n - 2 && point(behind + 1) <= centre) ++behind;
        const Scalar distance = point(behind + 1) - point(behind);
        if (!(distance > 0)) return;  // the points of tiny elements may coincide after rounding
        between_[static_cast<std::size_t>(element)] = {behind, behind + 1, (centre - point(behind)) / distance};
    }

    std::vector<Between> between_;
    ArrayX<Scalar> shares_;
};

}  // namespace rollbem::detail
