// The system of a line: influence matrices G (displacement) and G' (its slope) of Eqs. (12)-(14) for any mesh, scheme and
// kernel, and the coordinates of its elements.
#pragma once

#include <utility>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/detail/plane_model.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "detail/influence_rows.hpp"
#include "detail/kernel_view.hpp"

namespace rollbem {

/// G' of Eq. (12), n x n (n-1 x n-1 for KnotheBoundary), in units of 1/G: G'_lm is the slope du/dx at the point of row
/// l, Eq. (28), or its mean about that point, Eqs. (14) and (29), or between two nodes, under unit traction of element
/// m. A steady problem needs nothing else. Throws std::invalid_argument if the scheme does not fit the mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G_prime(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::slope, mesh),
                                            detail::KernelView<Scalar>(kernel), Quantity::slope);
}

/// G of Eq. (13), for Galerkin of Eq. (14), with the shape of G', in units of a/G: the displacement u instead of its
/// slope. The kernel's half-width must be finite. Throws std::invalid_argument if the scheme does not fit the mesh or G
/// is not finite.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    MatrixX<Scalar> G = detail::influence_matrix<Scalar>(mesh, scheme_rows(scheme, Quantity::displacement, mesh),
                                                         detail::KernelView<Scalar>(kernel), Quantity::displacement);
    detail::require(detail::is_finite(G(0, 0)), "assemble_G", "displacement per traction", G(0, 0),
                    "be finite: an infinite aspect is for steady problems only");
    return G;
}

namespace detail {

/// The rows of a scheme for both matrices.
template <class Scalar>
struct BothRows {
    SchemeRows<Scalar> slope, displacement;

    template <class Scheme>
    BothRows(const Scheme& scheme, const Mesh<Scalar>& mesh)
        : slope(scheme_rows(scheme, Quantity::slope, mesh)),
          displacement(scheme_rows(scheme, Quantity::displacement, mesh)) {}

    /// Whether each row belongs to a point half an element ahead of its element's centre.
    bool half_element_ahead() const { return slope.half_element_ahead && displacement.half_element_ahead; }

    /// Whether the equations hold at points, the same for G and G'. Differences count, as they are the mean of the
    /// slope over the width of one element; Galerkin's integrals and quadratures do not.
    bool at_points() const {
        return slope.offsets.size() == 1 && slope.averages <= 1 && displacement.offsets.size() == 1 &&
               displacement.averages == 0 && slope.offsets[0] == displacement.offsets[0] &&
               (half_element_ahead() || (slope.alpha == displacement.alpha).all());
    }

    /// Throws std::invalid_argument unless G and G' have the same unknowns and the same equations.
    void require_one_system() const {
        require(displacement.unknown_count == slope.unknown_count, "rolling_system",
                "unknown_count of the scheme for G", displacement.unknown_count, "equal that for G_prime");
        require(displacement.first_equation == slope.first_equation, "rolling_system",
                "first_equation of the scheme for G", displacement.first_equation, "equal that for G_prime");
    }
};

/// The coordinates of the unknown elements of a line and of their equations, in units of a.
template <class Scalar>
Elements<Scalar> line_elements(const Mesh<Scalar>& mesh, const BothRows<Scalar>& both) {
    const SchemeRows<Scalar>& rows = both.slope;
    const Eigen::Index n = rows.unknown_count;
    Scalar offset = 0;
    for (Eigen::Index k = 0; k < rows.offsets.size(); ++k) offset += rows.weights[k] * rows.offsets[k];
    Elements<Scalar> elements;
    elements.x.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index element = rows.first_equation + i;
        elements.x[i] =
            mesh.centres()[element] + (rows.alpha[element] + offset * rows.lengths[element]) * mesh.widths()[element];
    }
    elements.intervals =
        rows.way * rows.lengths.segment(rows.first_equation, n) * mesh.widths().segment(rows.first_equation, n);
    elements.y = ArrayX<Scalar>::Zero(n);
    elements.centre_x = mesh.centres().head(n);
    elements.centre_y = ArrayX<Scalar>::Zero(n);
    elements.areas = mesh.widths().head(n);
    elements.behind = Elements<Scalar>::one_strip(n);
    elements.half_element_ahead = both.half_element_ahead();
    return elements;
}

}  // namespace detail

/// Assembles both matrices. Throws std::invalid_argument if the scheme does not fit the mesh, if G is not finite (an
/// infinite half-width), and for a plane kernel with Lambda <= 0, whose model is unstable in the time domain.
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

/// G' alone, which costs less than both, for steady friction; the half-width may be infinite. Throws
/// std::invalid_argument if assemble_G_prime refuses the scheme.
template <class Scalar, RollingScheme<Scalar> Scheme, LineKernel Kernel>
ElementSystem<Scalar> steady_system(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    Elements<Scalar> elements = detail::line_elements(mesh, detail::BothRows<Scalar>(scheme, mesh));
    auto origin = detail::origin_of<Scalar>(kernel, elements.x, false);
    return {MatrixX<Scalar>(), assemble_G_prime(mesh, scheme, kernel), std::move(elements), mesh.size(),
            std::move(origin)};
}

}  // namespace rollbem
