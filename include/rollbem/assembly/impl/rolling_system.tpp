// Bodies of assembly/rolling_system.hpp. Internal.
#pragma once

#include "../rolling_system.hpp"

#include <utility>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/detail/plane_model.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../detail/influence_rows.hpp"
#include "../detail/kernel_view.hpp"

namespace rollbem {

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G_prime(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::slope, mesh),
                                            detail::KernelView<Scalar>(kernel), Quantity::slope);
}

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    MatrixX<Scalar> G = detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::displacement, mesh),
                                                         detail::KernelView<Scalar>(kernel), Quantity::displacement);
    detail::require(detail::is_finite(G(0, 0)), "assemble_G", "displacement per traction", G(0, 0),
                    "be finite: an infinite aspect is for steady problems only");
    return G;
}

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
ElementSystem<Scalar> rolling_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    detail::require_stable_model(kernel);
    const detail::BothRows<Scalar> rows(scheme, mesh);
    rows.require_one_system();
    Elements<Scalar> elements = detail::line_elements(mesh, rows);
    auto origin = detail::origin_of<Scalar>(kernel, elements.x, rows.at_points());
    return {assemble_G(mesh, scheme, kernel), assemble_G_prime(mesh, scheme, kernel), std::move(elements), mesh.size(),
            std::move(origin)};
}

template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
ElementSystem<Scalar> steady_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    Elements<Scalar> elements = detail::line_elements(mesh, detail::BothRows<Scalar>(scheme, mesh));
    auto origin = detail::origin_of<Scalar>(kernel, elements.x, false);
    return {MatrixX<Scalar>(), assemble_G_prime(mesh, scheme, kernel), std::move(elements), mesh.size(),
            std::move(origin)};
}

}  // namespace rollbem
