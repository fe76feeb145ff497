// Rows of G or G' for any mesh, scheme and kernel: a whole matrix, or a few rows at a time. Compiled once for each
// scalar type: schemes come as their rows, kernels as a view.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../discretisation/mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../types.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"
#include "line_integrals.hpp"
#include "sample_points.hpp"

namespace rollbem::detail {

// On a uniform mesh with one alpha the matrix is Toeplitz: its distinct entries are those of one element seen from all
// points. Computes the equations from `first`, as many as `out` has rows.
template <class Scalar>
void fill_toeplitz(const KernelView<Scalar>& kernel, Quantity quantity, int averages, Scalar width, Scalar offset,
                   Eigen::Index first, MatrixX<Scalar>& out) {
    const Eigen::Index columns = out.cols(), count = out.rows() + columns - 1;
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
    LineIntegrals<Scalar>(kernel, quantity, averages, rows, column, true).fill(entries);
    for (Eigen::Index m = 0; m < columns; ++m) {
        std::copy_n(entries.data() + columns - 1 - m, out.rows(), out.data() + m * out.rows());
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
        // the guard can move the points of the outermost rows differently from the others
        const Scalar rounding = 64 * std::numeric_limits<Scalar>::epsilon() * rows.half[0];
        bool toeplitz = mesh.is_uniform();
        for (Eigen::Index l = 0; toeplitz && l < mesh.size(); ++l) {
            toeplitz = std::abs(rows.offset[l] - rows.offset[0]) <= rounding;
        }
        if (toeplitz) {
            fill_toeplitz<Scalar>(kernel, quantity, scheme.averages, mesh.widths()[0], rows.offset[0], first, result);
            return;
        }
        const RowPoints<Scalar> asked{segment(rows.from_trailing, first, count),
                                      segment(rows.from_leading, first, count), segment(rows.offset, first, count),
                                      segment(rows.half, first, count)};
        LineIntegrals<Scalar>(kernel, quantity, scheme.averages, asked, columns, mesh.is_uniform()).fill(result);
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
        rows.resize(std::min(block, n - l), n);
        influence_rows<Scalar>(mesh, scheme, scheme.first_equation + l, kernel, quantity, rows);
        part.noalias() = rows * p;
        std::copy_n(part.data(), part.size(), product.data() + l);
    }
    return product;
}

}  // namespace rollbem::detail
