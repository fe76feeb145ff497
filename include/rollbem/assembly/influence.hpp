// Influence matrices: G (displacement) and G' (its slope) of Eqs. (12)-(14) for any mesh, scheme and kernel.
// Everything after this stage sees only these matrices and the widths of the elements.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../detail/array_functions.hpp"
#include "../detail/finite.hpp"
#include "../detail/gauss_legendre.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../types.hpp"
#include "detail/line_integrals.hpp"

namespace rollbem {

/// Both matrices of Eq. (12) in the form G' p - (1/V) G dp/dt = xi; row = equation, column = unknown element.
template <class Scalar>
struct InfluenceMatrices {
    MatrixX<Scalar> G;        ///< displacement per traction [a/G]
    MatrixX<Scalar> G_prime;  ///< du/dx per traction [1/G]
};

namespace detail {

// How a scheme takes its rows: at points alpha + nodes (in widths of the row's element), averaged `averages` times over
// that width; a finite difference is one more average. `guard` keeps points off the edges of elements.
template <class Scalar>
struct Sampling {
    double alpha_L, alpha_T;
    QuadratureRule<Scalar> rule;
    int averages;
    bool guard;
};

template <class Scalar>
QuadratureRule<Scalar> single_point() {
    QuadratureRule<Scalar> rule{ArrayX<Scalar>(1), ArrayX<Scalar>(1)};
    rule.nodes[0] = 0;
    rule.weights[0] = 2;
    return rule;
}

template <class Scalar>
Sampling<Scalar> sampling(const Collocation& scheme, Quantity quantity) {
    const double shift = quantity == Quantity::slope ? 1 : scheme.lambda;
    const bool differenced = quantity == Quantity::slope && scheme.derivative == Derivative::finite_difference;
    return {shift * scheme.alpha_L, shift * scheme.alpha_T, single_point<Scalar>(), differenced ? 1 : 0,
            quantity == Quantity::slope && !differenced};
}

template <class Scalar>
Sampling<Scalar> sampling(const Galerkin& scheme, Quantity quantity) {
    const Collocation points{scheme.alpha_L, scheme.alpha_T, scheme.derivative, scheme.lambda};
    Sampling<Scalar> result = sampling<Scalar>(points, quantity);
    if (scheme.quadrature == exact_quadrature) {
        ++result.averages;
        result.guard = false;  // the mean over an interval has no singularity
    } else {
        result.rule = gauss_legendre<Scalar>(scheme.quadrature);
    }
    return result;
}

template <class Scalar>
Sampling<Scalar> sampling(const KnotheBoundary& scheme, Quantity quantity) {
    return sampling<Scalar>(Collocation{0, 0, scheme.derivative, 1}, quantity);
}

inline Eigen::Index first_equation(const Collocation&) { return 0; }
inline Eigen::Index first_equation(const Galerkin&) { return 0; }
inline Eigen::Index first_equation(const KnotheBoundary&) { return 1; }

// Offset from the centre of element `own` of the point `position` widths ahead of it, moved to 0.001 dx from any edge
// it lies nearer to; dx is the width of the element the point lies in, on an edge the one on the trailing side.
template <class Scalar>
Scalar guarded_offset(const Mesh<Scalar>& mesh, Eigen::Index own, Scalar position) {
    const auto& widths = mesh.widths();
    const Scalar half = Scalar(0.5), inside = Scalar(0.499), outside = Scalar(0.501);
    const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon();  // this near to an edge is on it
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

template <class Scalar>
RowPoints<Scalar> row_points(const Mesh<Scalar>& mesh, const Sampling<Scalar>& sampling, Scalar node) {
    const ArrayX<Scalar> alpha = interpolate_alpha(mesh, sampling.alpha_L, sampling.alpha_T);
    RowPoints<Scalar> rows{mesh.from_trailing(), mesh.from_leading(), ArrayX<Scalar>(mesh.size()),
                           halved(mesh.widths())};
    for (Eigen::Index l = 0; l < mesh.size(); ++l) {
        const Scalar position = alpha[l] + node / 2;
        rows.offset[l] = sampling.guard ? guarded_offset(mesh, l, position) : position * mesh.widths()[l];
    }
    return rows;
}

// On a uniform mesh with one alpha the matrix is Toeplitz: the different entries are those of one element seen from as
// many points. Equations from `first` on, as many as `out` has rows.
template <class Scalar>
void fill_toeplitz(const KernelView<Scalar>& kernel, Quantity quantity, int averages, Scalar width, Scalar offset,
                   Eigen::Index first, MatrixX<Scalar>& out) {
    const Eigen::Index columns = out.cols(), count = out.rows() + columns - 1;
    RowPoints<Scalar> rows{ArrayX<Scalar>(count), ArrayX<Scalar>(count), ArrayX<Scalar>(count), ArrayX<Scalar>(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        // distances from the element instead of from an edge: exact multiples of the width
        rows.from_trailing[i] = static_cast<Scalar>(first + 1 - columns + i) * width;
        rows.from_leading[i] = -rows.from_trailing[i];
        rows.offset[i] = offset;
        rows.half[i] = width / 2;
    }
    ColumnElements<Scalar> column{ArrayX<Scalar>(1), ArrayX<Scalar>(1), ArrayX<Scalar>(1)};
    column.from_trailing[0] = column.from_leading[0] = 0;
    column.half[0] = width / 2;
    MatrixX<Scalar> entries(count, 1);
    LineIntegrals<Scalar>(kernel, quantity, averages, rows, column, true).fill(entries);
    for (Eigen::Index m = 0; m < columns; ++m) {
        std::copy_n(entries.data() + columns - 1 - m, out.rows(), out.data() + m * out.rows());
    }
}

// Equations from `first` on for the tractions of elements from 0 on, as many as `out` has rows and columns.
template <class Scalar>
void influence_rows(const Mesh<Scalar>& mesh, const Sampling<Scalar>& samples, Eigen::Index first,
                    const KernelView<Scalar>& kernel, Quantity quantity, MatrixX<Scalar>& out) {
    const Eigen::Index count = out.rows();
    const ColumnElements<Scalar> columns{segment(mesh.from_trailing(), 0, out.cols()),
                                         segment(mesh.from_leading(), 0, out.cols()),
                                         segment(halved(mesh.widths()), 0, out.cols())};
    const auto fill = [&](Scalar node, MatrixX<Scalar>& result) {
        const RowPoints<Scalar> rows = row_points(mesh, samples, node);
        // the guard can move the points of the outermost rows elsewhere than those of the others
        const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * rows.half[0];
        bool toeplitz = mesh.is_uniform();
        for (Eigen::Index l = 0; toeplitz && l < mesh.size(); ++l) {
            toeplitz = std::abs(rows.offset[l] - rows.offset[0]) <= rounding;
        }
        if (toeplitz) {
            fill_toeplitz<Scalar>(kernel, quantity, samples.averages, mesh.widths()[0], rows.offset[0], first, result);
            return;
        }
        const RowPoints<Scalar> asked{segment(rows.from_trailing, first, count),
                                      segment(rows.from_leading, first, count), segment(rows.offset, first, count),
                                      segment(rows.half, first, count)};
        LineIntegrals<Scalar>(kernel, quantity, samples.averages, asked, columns, mesh.is_uniform()).fill(result);
    };
    if (samples.rule.nodes.size() == 1) {
        fill(samples.rule.nodes[0], out);
        return;
    }
    std::fill_n(out.data(), out.size(), Scalar(0));
    MatrixX<Scalar> sample(count, out.cols());
    for (Eigen::Index k = 0; k < samples.rule.nodes.size(); ++k) {
        fill(samples.rule.nodes[k], sample);
        const Scalar weight = samples.rule.weights[k] / 2;
        for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] += weight * sample.data()[i];
    }
}

// Equations first ... first + size - 1 for the tractions of elements 0 ... size - 1.
template <class Scalar>
MatrixX<Scalar> influence_matrix(const Mesh<Scalar>& mesh, const Sampling<Scalar>& samples, Eigen::Index first,
                                 Eigen::Index size, const KernelView<Scalar>& kernel, Quantity quantity) {
    MatrixX<Scalar> result(size, size);
    influence_rows<Scalar>(mesh, samples, first, kernel, quantity, result);
    return result;
}

template <class Scalar, class Scheme>
MatrixX<Scalar> influence_matrix(const Mesh<Scalar>& mesh, const Scheme& scheme, const KernelView<Scalar>& kernel,
                                 Quantity quantity) {
    check_scheme(scheme, mesh.size());
    return influence_matrix(mesh, sampling<Scalar>(scheme, quantity), first_equation(scheme),
                            unknown_count(scheme, mesh.size()), kernel, quantity);
}

// G' p without storing G': a few rows at a time.
template <class Scalar>
VectorX<Scalar> influence_product(const Mesh<Scalar>& mesh, const Sampling<Scalar>& samples, Eigen::Index first,
                                  const KernelView<Scalar>& kernel, Quantity quantity, const VectorX<Scalar>& p) {
    constexpr Eigen::Index block = 32;
    const Eigen::Index n = p.size();
    VectorX<Scalar> product(n);
    MatrixX<Scalar> rows;
    VectorX<Scalar> part;
    for (Eigen::Index l = 0; l < n; l += block) {
        rows.resize(std::min(block, n - l), n);
        influence_rows<Scalar>(mesh, samples, first + l, kernel, quantity, rows);
        part.noalias() = rows * p;
        std::copy_n(part.data(), part.size(), product.data() + l);
    }
    return product;
}

template <class Scalar, class Scheme, LineKernel Kernel>
VectorX<Scalar> G_prime_times(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel,
                              const VectorX<Scalar>& p) {
    return influence_product<Scalar>(mesh, sampling<Scalar>(scheme, Quantity::slope), first_equation(scheme),
                                     KernelView<Scalar>(kernel), Quantity::slope, p);
}

}  // namespace detail

/// G' of Eq. (12), n x n (n-1 x n-1 for KnotheBoundary), in units of 1/G. All that a steady problem needs.
/// Throws std::invalid_argument when the scheme does not fit the mesh.
template <class Scalar, class Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G_prime(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::influence_matrix<Scalar>(mesh, scheme, detail::KernelView<Scalar>(kernel), detail::Quantity::slope);
}

/// G of Eqs. (13) and (14), same shape, in units of a/G. The kernel's half-width must be finite.
/// Throws std::invalid_argument when the scheme does not fit the mesh or G is not finite.
template <class Scalar, class Scheme, LineKernel Kernel>
MatrixX<Scalar> assemble_G(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    MatrixX<Scalar> G = detail::influence_matrix<Scalar>(mesh, scheme, detail::KernelView<Scalar>(kernel),
                                                         detail::Quantity::displacement);
    detail::require(detail::is_finite(G(0, 0)), "assemble_G", "displacement per traction", G(0, 0),
                    "be finite: an infinite aspect is for steady problems only");
    return G;
}

/// Both matrices, for the problems that need both.
template <class Scalar, class Scheme, LineKernel Kernel>
InfluenceMatrices<Scalar> assemble(const Mesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return {assemble_G(mesh, scheme, kernel), assemble_G_prime(mesh, scheme, kernel)};
}

}  // namespace rollbem
