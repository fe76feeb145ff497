// Hertz's pressure on the elements of a patch, for friction.
#pragma once

#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../scene/patch_contact.hpp"
#include "../types.hpp"
#include "hertz_ellipse.hpp"

namespace rollbem {

/// The elements of a mesh, in its order [m]; `unit` is its unit of length [m], half_length() of the contact.
template <class Scalar>
std::vector<Rectangle<Scalar>> rectangles(const PatchMesh<Scalar>& mesh, std::type_identity_t<Scalar> unit) {
    std::vector<Rectangle<Scalar>> elements;
    const auto& edges = mesh.along().edges();
    for (Eigen::Index j = 0; j < mesh.strip_count(); ++j) {
        const auto x = [&](Eigen::Index i) { return unit * (mesh.middles_x()[j] + mesh.half_lengths()[j] * edges[i]); };
        for (Eigen::Index i = 0; i < mesh.elements_per_strip(); ++i) {
            elements.push_back({x(i), x(i + 1), unit * mesh.edges()[j], unit * mesh.edges()[j + 1]});
        }
    }
    return elements;
}

/// Mean pressures [Pa] of elements that cover an elliptic patch, whether they end on its edge or beyond, under the load N
/// [N], which they carry exactly: p_n = 3 N/(2 pi a b) sqrt(1 - x^2/a^2 - y^2/b^2). Throws std::invalid_argument for an
/// outline, unless the load is positive and finite and the elements cover nine tenths of it, or if one has no area.
template <class Scalar>
ArrayX<Scalar> hertz_pressures(const PatchContact<Scalar>& contact, const std::vector<Rectangle<Scalar>>& elements,
                               std::type_identity_t<Scalar> load) {
    detail::require(!contact.outline(), "hertz_pressures", "number of lines of an outline",
                    contact.outline() ? contact.outline()->y().size() : 0, "be 0: Hertz's contact is an ellipse");
    detail::require_positive("hertz_pressures", "load", load);
    return detail::ellipse_pressures(contact.half_length(), contact.half_width(), load, elements).mean;
}

/// The same for the elements of the patch's mesh.
template <class Scalar>
ArrayX<Scalar> hertz_pressures(const PatchContact<Scalar>& contact, const PatchMesh<Scalar>& mesh,
                               std::type_identity_t<Scalar> load) {
    return hertz_pressures(contact, rectangles(mesh, contact.half_length()), load);
}

}  // namespace rollbem
