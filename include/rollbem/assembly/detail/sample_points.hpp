// The points and intervals at which a scheme takes its rows, Eqs. (28) and (29), kept off the edges of elements if the
// scheme requires it.
#pragma once

#include <limits>

#include "../../detail/array_functions.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

// Offset from the centre of element `own` to the point `position` widths ahead of it. A point closer than 0.001 dx to
// an edge is moved to that distance; dx is the width of the element that contains the point, on an edge the trailing
// one.
template <class Scalar>
Scalar guarded_offset(const Mesh<Scalar>& mesh, Eigen::Index own, Scalar position) {
    const auto& widths = mesh.widths();
    const Scalar half = Scalar(0.5), inside = Scalar(0.499), outside = Scalar(0.501);
    const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();  // a point this close to an edge is on it
    const Scalar upper = half + rounding, lower = rounding - half;
    Eigen::Index e = own;
    while (position > upper && e + 1 < mesh.size()) {
        position = (position - half) * widths[e] / widths[e + 1] - half;
        ++e;
    }
    while (position <= lower && e > 0) {
        position = half - (-half - position) * widths[e] / widths[e - 1];
        --e;
    }
    if (position > inside && position <= upper) position = inside;
    if (position > upper && position < outside) position = outside;
    if (position < -inside && position > lower) position = -inside;
    if (position <= lower && position > -outside) position = -outside;
    const Scalar between = mesh.centres()[own] < 0 ? mesh.from_trailing()[e] - mesh.from_trailing()[own]
                                                   : mesh.from_leading()[own] - mesh.from_leading()[e];
    return between + position * widths[e];
}

// The points x_l + (alpha_l + offset length_l) dx_l of every element, and the intervals about them over which Eq. (29)
// takes differences and Eq. (14) means.
template <class Scalar>
RowPoints<Scalar> row_points(const Mesh<Scalar>& mesh, const SchemeRows<Scalar>& scheme, Scalar offset) {
    RowPoints<Scalar> rows{mesh.from_trailing(), mesh.from_leading(), ArrayX<Scalar>(mesh.size()),
                           ArrayX<Scalar>(mesh.size()), scheme.unloaded_ahead};
    for (Eigen::Index l = 0; l < mesh.size(); ++l) {
        const Scalar position = scheme.alpha[l] + offset * scheme.lengths[l];
        rows.offset[l] = scheme.guard ? guarded_offset(mesh, l, position) : position * mesh.widths()[l];
        rows.half[l] = scheme.lengths[l] * mesh.widths()[l] / 2;
    }
    return rows;
}

}  // namespace rollbem::detail
