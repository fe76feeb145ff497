// Bodies of discretisation/patch_mesh.hpp. Internal.
#pragma once

#include "../patch_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../detail/require.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../types.hpp"
#include "../mesh.hpp"

namespace rollbem {

template <class Scalar>
PatchMesh<Scalar> PatchMesh<Scalar>::joined(const std::vector<PatchMesh>& pieces) {
    detail::require(!pieces.empty(), "PatchMesh", "number of pieces", pieces.size(), "be at least 1");
    PatchMesh whole = pieces.front();
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        const PatchMesh& piece = pieces[k];
        detail::require(
            piece.along().size() == whole.along().size() && (piece.along().edges() == whole.along().edges()).all(),
            "PatchMesh", "number of elements of a piece's strips", piece.elements_per_strip(),
            "be the number of the other strips, with the same edges");
        for (const auto part : {&PatchMesh::lower_, &PatchMesh::upper_, &PatchMesh::middles_y_, &PatchMesh::middles_x_,
                                &PatchMesh::half_lengths_}) {
            Array both((whole.*part).size() + (piece.*part).size());
            both << whole.*part, piece.*part;
            whole.*part = std::move(both);
        }
    }
    whole.check();
    return whole;
}

template <class Scalar>
PatchMesh<Scalar> ellipse_mesh(std::type_identity_t<Scalar> a_over_b, Mesh<Scalar> along, const Mesh<Scalar>& across) {
    detail::require_positive("ellipse_mesh", "a_over_b", a_over_b);
    // sqrt(1 - (y/b)^2) by the distances from both ends, without cancellation
    return PatchMesh<Scalar>({.along = std::move(along),
                              .edges = across.edges() / a_over_b,
                              .middles_y = across.centres() / a_over_b,
                              .middles_x = ArrayX<Scalar>::Zero(across.size()),
                              .half_lengths = (across.from_trailing() * across.from_leading()).sqrt()});
}

template <class Scalar>
PatchMesh<Scalar> outline_mesh(const Outline& outline, std::type_identity_t<Scalar> unit, Mesh<Scalar> along,
                               const Mesh<Scalar>& across) {
    const double middle = (outline.low() + outline.high()) / 2, half_height = (outline.high() - outline.low()) / 2;
    const Eigen::Index m = across.size();
    const auto place = [&](Scalar t) { return static_cast<Scalar>(middle + half_height * t); };
    ArrayX<Scalar> edges = across.edges(), middles = across.centres(), middles_x(m), half_lengths(m);
    for (Scalar& y : edges) y = place(y) / unit;
    for (Eigen::Index j = 0; j < m; ++j) {
        const Scalar y = place(middles[j]);
        const double trailing = outline.trailing(y), leading = outline.leading(y);
        middles[j] = y / unit;
        middles_x[j] = static_cast<Scalar>((trailing + leading) / 2 / unit);
        half_lengths[j] = static_cast<Scalar>((leading - trailing) / 2 / unit);
    }
    return PatchMesh<Scalar>({std::move(along), edges, middles, middles_x, half_lengths});
}

template <class Scalar>
PatchMesh<Scalar> patch_mesh(const PatchContact& contact, Mesh<Scalar> along, const Mesh<Scalar>& across) {
    if (contact.outline()) {
        return outline_mesh<Scalar>(*contact.outline(), static_cast<Scalar>(contact.half_length()), std::move(along),
                                    across);
    }
    return ellipse_mesh<Scalar>(static_cast<Scalar>(contact.a_over_b()), std::move(along), across);
}

}  // namespace rollbem
