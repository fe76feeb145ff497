// Bodies of assembly/patch_system.hpp. Internal.
#pragma once

#include "../patch_system.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../system/detail/shape_set.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../detail/patch_rows.hpp"
#include "../rolling_system.hpp"

namespace rollbem {

template <class Scalar, RollingScheme<Scalar> Scheme>
Elements<Scalar> patch_elements(const PatchMesh<Scalar>& mesh, const Scheme& scheme) {
    const detail::StripRows<Scalar> rows = detail::strip_rows(mesh.along(), scheme, Quantity::slope);
    const Eigen::Index n = mesh.elements_per_strip(), size = mesh.size();
    Elements<Scalar> elements;
    for (ArrayX<Scalar>* values : {&elements.x, &elements.y, &elements.centre_x, &elements.centre_y, &elements.areas,
                                   &elements.intervals, &elements.leading_edge}) {
        values->resize(size);
    }
    for (Eigen::Index j = 0; j < mesh.strip_count(); ++j) {
        const Scalar middle = mesh.middles_x()[j], scale = mesh.half_lengths()[j];
        elements.x.segment(j * n, n) = middle + scale * rows.points;
        elements.centre_x.segment(j * n, n) = middle + scale * mesh.along().centres();
        elements.y.segment(j * n, n).setConstant(mesh.middles_y()[j]);
        elements.intervals.segment(j * n, n) = scale * rows.lengths;
        elements.leading_edge.segment(j * n, n).setConstant(middle + scale);
        elements.areas.segment(j * n, n) = scale * mesh.widths()[j] * mesh.along().widths();
        for (Eigen::Index i = 0; i < n; ++i) elements.behind.push_back(i == 0 ? -1 : j * n + i - 1);
    }
    elements.centre_y = elements.y;
    elements.half_element_ahead = detail::BothRows<Scalar>(scheme, mesh.along()).half_element_ahead();
    return elements;
}

template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> rolling_system(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::system_of(mesh, scheme, detail::patch_blocks(mesh, scheme, kernel, Quantity::displacement),
                             assemble_G_prime(mesh, scheme, kernel));
}

template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
std::vector<RollingSystem<Scalar>> patch_subsystems(const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                                    const Kernel& kernel) {
    if (!mesh.is_mirrored()) return {{rolling_system(mesh, scheme, kernel).joined()}};
    const auto rows = [&](Quantity quantity) {
        return detail::patch_rows(mesh, detail::strip_rows(mesh.along(), scheme, quantity), kernel, quantity,
                                  detail::has_wide_strips(mesh));
    };
    return detail::mirrored_parts<Scalar>(rows(Quantity::displacement), rows(Quantity::slope),
                                          patch_elements(mesh, scheme), mesh.strip_count(), 1);
}

template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> breathing_system(const PatchContact& contact, const PatchMesh<Scalar>& mesh,
                                          const Scheme& scheme, const Kernel& kernel) {
    Elements<Scalar> elements = patch_elements(mesh, scheme);
    auto set = std::make_shared<detail::ShapeSet<Scalar>>();
    set->nodes.push_back(detail::shape_node(
        mesh, scheme, kernel, static_cast<Scalar>(contact.c() / contact.half_length()), detail::has_wide_strips(mesh)));
    const auto a_over_b = static_cast<Scalar>(contact.a_over_b());
    set->first = std::log(a_over_b);
    set->zeta = elements.x;
    set->upsilon = elements.y * a_over_b;
    set->coupled = kernel.couples();
    return detail::system_of<Scalar>(std::move(set), std::move(elements), a_over_b);
}

template <class Scalar_>
ElementSystem<Scalar_, 2> PatchShapes<Scalar_>::system(std::type_identity_t<Scalar> a_over_b) const {
    detail::require(detail::is_finite(a_over_b) && a_over_b > 0 && covers(a_over_b), "PatchShapes", "a_over_b",
                    a_over_b, "lie in the range of the shapes");
    return detail::system_of<Scalar>(set_, elements(a_over_b), a_over_b);
}

template <class Scalar_>
std::vector<RollingSystem<Scalar_>> PatchShapes<Scalar_>::subsystems(std::size_t node) const {
    const Scalar a_over_b = std::exp(set_->first + static_cast<Scalar>(node) * set_->step);
    if (!mirrored_) return {{system(a_over_b).joined()}};
    const detail::ShapeNode<Scalar>& at = set_->nodes[node];
    return detail::mirrored_parts<Scalar>(at.G, at.G_prime, elements(a_over_b), strips_, std::sqrt(a_over_b));
}

template <class Scalar_>
template <RollingScheme<Scalar_> Scheme, RectangleKernel Kernel>
PatchShapes<Scalar_>::PatchShapes(const Mesh<Scalar>& along, const Mesh<Scalar>& across, const Scheme& scheme,
                                  const Kernel& kernel, const Range& range)
    : circle_(patch_elements(ellipse_mesh<Scalar>(1, along, across), scheme)),
      mirrored_(ellipse_mesh<Scalar>(1, along, across).is_mirrored()),
      strips_(across.size()) {
    detail::require(range.least > 0, "PatchShapes", "least a/b", range.least, "be positive");
    detail::require(detail::is_finite(range.largest) && range.largest > range.least, "PatchShapes", "largest a/b",
                    range.largest, "be finite and more than the least");
    detail::require(range.factor > 1 && range.factor <= 2, "PatchShapes", "factor from node to node", range.factor,
                    "be more than 1 and at most 2");
    auto set = std::make_shared<detail::ShapeSet<Scalar>>();
    const Scalar length = std::log(range.largest / range.least);
    const int count = (std::max)(4, static_cast<int>(std::ceil(length / std::log(range.factor) - Scalar(1e-6))) + 1);
    set->first = std::log(range.least);
    set->step = length / static_cast<Scalar>(count - 1);
    // the same kind for all, as entries of the two kinds cannot be interpolated
    const bool over_width = detail::has_wide_strips(ellipse_mesh<Scalar>(range.least, along, across));
    for (int k = 0; k < count; ++k) {
        const Scalar a_over_b = std::exp(set->first + static_cast<Scalar>(k) * set->step);
        set->nodes.push_back(detail::shape_node(ellipse_mesh<Scalar>(a_over_b, along, across), scheme, kernel,
                                                1 / std::sqrt(a_over_b), over_width));
    }
    set->zeta = circle_.x;
    set->upsilon = circle_.y;
    set->coupled = kernel.couples();
    set_ = std::move(set);
}

}  // namespace rollbem
