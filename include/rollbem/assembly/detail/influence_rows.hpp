// Rows of G or G' for any mesh, scheme and kernel: a whole matrix, or a few rows at a time. Every entry of G and G' of
// Eqs. (12)-(14) is a line integral: a kernel, or its derivative, integrated over an element and averaged about a
// point. Compiled once for each scalar type: schemes come as their rows, kernels as a view.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../types.hpp"
#include "delta_part.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"
#include "logarithmic_series.hpp"
#include "near_differences.hpp"
#include "smooth_part.hpp"

namespace rollbem::detail {

/// Integrates a kernel in parts:
///
/// - the logarithm in closed form, near entries by differences of antiderivatives, far ones (|d| well above h +
///   averages delta) by a series;
/// - the smooth part;
/// - a delta.
template <class Scalar>
class LineIntegrals {
public:
    /// Keeps a reference to the kernel. Throws std::invalid_argument for the slope at points if the kernel has a delta.
    LineIntegrals(KernelView<Scalar> kernel, Quantity quantity, int averages, const RowPoints<Scalar>& rows,
                  const ColumnElements<Scalar>& columns)
        : kernel_(kernel), entries_(quantity, averages, rows, columns) {
        require(kernel_.split.compliance == 0 || averages > 0 || !entries_.slope(), "LayeredKernel", "compliance",
                kernel_.split.compliance,
                "be 0 where the derivative is analytic: the layer's displacement jumps at the edges of elements; take "
                "Derivative::finite_difference, or Galerkin in closed form");
        require(kernel_.split.distance > 0, "assembly", "distance of the kernel's smooth part", kernel_.split.distance,
                "be positive");
    }

    LineIntegrals(const LineIntegrals&) = delete;  // its parts keep references to it
    LineIntegrals& operator=(const LineIntegrals&) = delete;

    /// Writes the integral for every row l and element m to out(l, m).
    void fill(MatrixX<Scalar>& out) const {
        LogarithmicSeries<Scalar>(entries_, kernel_.split).fill(out);
        NearDifferences<Scalar>(entries_, kernel_.split).fill(out);
        SmoothPart<Scalar>(entries_, kernel_).add(out);
        if (kernel_.split.compliance != 0) DeltaPart<Scalar>(entries_, kernel_.split.compliance).add(out);
    }

private:
    KernelView<Scalar> kernel_;
    Entries<Scalar> entries_;
};

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

// The points x_l + (alpha_l + offset length_l) dx_l of every element, and the intervals about them over which
// differences, Eq. (29), and means, Eq. (14), are taken.
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

// On a uniform mesh with one alpha the matrix is Toeplitz: its distinct entries belong to one element seen from all
// points. Computes `equations` from `first` into the first rows of `out`.
template <class Scalar>
void fill_toeplitz(const KernelView<Scalar>& kernel, Quantity quantity, int averages, Scalar width, Scalar offset,
                   Eigen::Index first, Eigen::Index equations, MatrixX<Scalar>& out) {
    const Eigen::Index columns = out.cols(), count = equations + columns - 1;
    RowPoints<Scalar> rows{ArrayX<Scalar>(count), ArrayX<Scalar>(count), ArrayX<Scalar>(count), ArrayX<Scalar>(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        // distances from the element rather than from an edge: exact multiples of the width
        rows.from_trailing[i] = static_cast<Scalar>(first + 1 - columns + i) * width;
        rows.from_leading[i] = -rows.from_trailing[i];
        rows.offset[i] = offset;
        rows.half[i] = width / 2;
    }
    ColumnElements<Scalar> column{ArrayX<Scalar>(1), ArrayX<Scalar>(1), ArrayX<Scalar>(1)};
    column.from_trailing[0] = column.from_leading[0] = 0;
    column.half[0] = width / 2;
    MatrixX<Scalar> entries(count, 1);
    LineIntegrals<Scalar>(kernel, quantity, averages, rows, column).fill(entries);
    for (Eigen::Index m = 0; m < columns; ++m) {
        std::copy_n(entries.data() + columns - 1 - m, equations, out.data() + m * out.rows());
    }
}

// The equations from `first` for the tractions of the first elements, as many as `out` has rows and columns.
template <class Scalar>
void influence_rows(const Mesh<Scalar>& mesh, const SchemeRows<Scalar>& scheme, Eigen::Index first,
                    const KernelView<Scalar>& kernel, Quantity quantity, MatrixX<Scalar>& out) {
    const Eigen::Index count = out.rows();
    const ColumnElements<Scalar> columns{segment(mesh.from_trailing(), 0, out.cols()),
                                         segment(mesh.from_leading(), 0, out.cols()),
                                         segment(halved(mesh.widths()), 0, out.cols())};
    const auto fill = [&](Scalar offset, MatrixX<Scalar>& result) {
        const RowPoints<Scalar> rows = row_points(mesh, scheme, offset);
        // the first rows with intervals as long as an element: all rows except the ones that end on an edge of the
        // contact
        Eigen::Index regular = 0;
        while (mesh.is_uniform() && regular < mesh.size() && scheme.lengths[regular] == 1) ++regular;
        // the guard can move the points of the outermost rows differently from the others
        const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * rows.half[0];
        bool toeplitz = regular > 0;
        for (Eigen::Index l = 0; toeplitz && l < regular; ++l) {
            toeplitz = std::abs(rows.offset[l] - rows.offset[0]) <= rounding;
        }
        const Eigen::Index done = toeplitz ? std::clamp(regular - first, Eigen::Index(0), count) : 0;
        if (done > 0) {
            fill_toeplitz<Scalar>(kernel, quantity, scheme.averages, mesh.widths()[0], rows.offset[0], first, done,
                                  result);
        }
        if (done == count) return;
        const auto asked = [&](const ArrayX<Scalar>& values) { return segment(values, first + done, count - done); };
        const RowPoints<Scalar> others{asked(rows.from_trailing), asked(rows.from_leading), asked(rows.offset),
                                       asked(rows.half), rows.unloaded_ahead};
        const LineIntegrals<Scalar> integrals(kernel, quantity, scheme.averages, others, columns);
        if (done == 0) {
            integrals.fill(result);
            return;
        }
        MatrixX<Scalar> last(count - done, out.cols());
        integrals.fill(last);
        for (Eigen::Index m = 0; m < out.cols(); ++m) {
            std::copy_n(last.data() + m * last.rows(), last.rows(), result.data() + m * count + done);
        }
    };
    if (scheme.offsets.size() == 1) {
        fill(scheme.offsets[0], out);
        return;
    }
    std::fill_n(out.data(), out.size(), Scalar(0));
    MatrixX<Scalar> sample(count, out.cols());
    for (Eigen::Index k = 0; k < scheme.offsets.size(); ++k) {
        fill(scheme.offsets[k], sample);
        const Scalar weight = scheme.weights[k];
        for (Eigen::Index i = 0; i < out.size(); ++i) out.data()[i] += weight * sample.data()[i];
    }
}

// All equations of a scheme: G or G'.
template <class Scalar>
MatrixX<Scalar> influence_matrix(const Mesh<Scalar>& mesh, const SchemeRows<Scalar>& scheme,
                                 const KernelView<Scalar>& kernel, Quantity quantity) {
    MatrixX<Scalar> result(scheme.unknown_count, scheme.unknown_count);
    influence_rows<Scalar>(mesh, scheme, scheme.first_equation, kernel, quantity, result);
    return result;
}

// G p or G' p without storing the matrix: a few rows at a time.
template <class Scalar>
VectorX<Scalar> influence_product(const Mesh<Scalar>& mesh, const SchemeRows<Scalar>& scheme,
                                  const KernelView<Scalar>& kernel, Quantity quantity, const VectorX<Scalar>& p) {
    constexpr Eigen::Index block = 32;
    const Eigen::Index n = p.size();
    VectorX<Scalar> product(n);
    MatrixX<Scalar> rows;
    VectorX<Scalar> part;
    for (Eigen::Index l = 0; l < n; l += block) {
        rows.resize((std::min)(block, n - l), n);
        influence_rows<Scalar>(mesh, scheme, scheme.first_equation + l, kernel, quantity, rows);
        part.noalias() = rows * p;
        std::copy_n(part.data(), part.size(), product.data() + l);
    }
    return product;
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template MatrixX<double> detail::influence_matrix<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                 const detail::KernelView<double>&, Quantity);
extern template VectorX<double> detail::influence_product<double>(const Mesh<double>&, const SchemeRows<double>&,
                                                                  const detail::KernelView<double>&, Quantity,
                                                                  const VectorX<double>&);
}  // namespace rollbem
#endif
