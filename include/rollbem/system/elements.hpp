// Elements: the coordinates of a system's elements and equations for friction, moments and spin, on a line and on a
// patch alike.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../types.hpp"

namespace rollbem {

/// Coordinates of n elements and of their equations, in the system's unit of length (a; for outlines c). Elements are
/// numbered from trailing to leading, strip by strip from small to large y; equation i belongs to element i.
///
/// Invariant: all areas are positive and finite; the other arrays have as many entries, or none if coordinates are not
/// known, as for ready matrices.
template <class Scalar>
struct Elements {
    ArrayX<Scalar> x, y;                ///< the point of each equation, at which the rigid slip is taken
    ArrayX<Scalar> centre_x, centre_y;  ///< the centre of each element, at which its traction acts in moments
    ArrayX<Scalar> areas;               ///< area of each element; on a line contact its width
    /// Length along x of the interval, about its point, in which each equation holds; for a difference of u, the
    /// distance between its two points. Empty where it is not known.
    ArrayX<Scalar> intervals;
    std::vector<Eigen::Index> behind;  ///< the equation behind in the same strip; -1 for a trailing element
    /// Whether each equation belongs to a point half an element ahead of its element's centre: node differences, and
    /// finite differences at equal alphas of 0.5. False where it is not known.
    bool half_element_ahead = false;

    Eigen::Index size() const { return areas.size(); }
    bool places_are_known() const { return x.size() == size(); }
    bool is_one_strip() const { return behind == one_strip(size()); }

    /// `behind` for n elements in one strip.
    static std::vector<Eigen::Index> one_strip(Eigen::Index n) {
        std::vector<Eigen::Index> behind(static_cast<std::size_t>(n));
        for (Eigen::Index i = 0; i < n; ++i) behind[static_cast<std::size_t>(i)] = i - 1;
        return behind;
    }

    /// Elements of one strip at unknown coordinates.
    static Elements unplaced(const ArrayX<Scalar>& areas) {
        Elements elements;
        elements.areas = areas;
        elements.behind = one_strip(areas.size());
        return elements;
    }

    /// Throws std::invalid_argument if the invariant does not hold; `area` is the name of the areas in the terms of
    /// `who`.
    void require_valid(const char* who, const char* area) const;
};

template <class Scalar>
void Elements<Scalar>::require_valid(const char* who, const char* area) const {
    const Eigen::Index n = size();
    detail::require(n >= 1, who, "number of elements", n, "be at least 1");
    for (Eigen::Index i = 0; i < n; ++i) {
        detail::require_positive(who, area, areas[i]);
    }
    for (const ArrayX<Scalar>* places : {&x, &y, &centre_x, &centre_y}) {
        detail::require(places->size() == (places_are_known() ? n : 0), who, "number of places", places->size(),
                        "equal the number of elements");
        detail::require(detail::all_finite(*places), who, "a place", places->sum(), "be finite");
    }
    const Eigen::Index ways = intervals.size();
    detail::require(ways == 0 || ways == n, who, "number of intervals", ways, "equal the number of elements");
    detail::require(detail::all_finite(intervals), who, "an interval", intervals.sum(), "be finite");
    detail::require(behind.size() == static_cast<std::size_t>(n), who, "number of equations behind", behind.size(),
                    "equal the number of elements");
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index other = behind[static_cast<std::size_t>(i)];
        detail::require(other >= -1 && other < n && other != i, who, "equation behind", other,
                        "be the index of another element, or -1");
    }
}

}  // namespace rollbem
