// The rows of a scheme for G and G' of a line, and the coordinates of its elements. Internal.
#pragma once

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
#include "influence_rows.hpp"
#include "kernel_view.hpp"

namespace rollbem::detail {

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
    elements.leading_edge = ArrayX<Scalar>::Ones(n);
    elements.behind = Elements<Scalar>::one_strip(n);
    elements.half_element_ahead = both.half_element_ahead();
    return elements;
}

}  // namespace rollbem::detail
