// Line integrals: a line kernel, or its derivative, integrated over an element and averaged about a point.
// Every entry of G and G' of Eqs. (12)-(14) is such an integral; this header fills whole matrices of them.
#pragma once

#include <optional>

#include "../../detail/require.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"
#include "delta_part.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"
#include "logarithmic_series.hpp"
#include "near_differences.hpp"
#include "polynomial_part.hpp"
#include "taylor_series.hpp"

namespace rollbem::detail {

/// Chooses how each entry is computed: near entries by differences of antiderivatives, far ones (|d| well above
/// h + averages delta) by a series if the kernel offers one. A delta is added to either.
template <class Scalar>
class LineIntegrals {
public:
    /// `equal_widths`: all h and delta are equal, and neighbours are 2h apart. Keeps a reference to the kernel. Throws
    /// std::invalid_argument for the slope at points if the kernel has a delta.
    LineIntegrals(KernelView<Scalar> kernel, Quantity quantity, int averages, const RowPoints<Scalar>& rows,
                  const ColumnElements<Scalar>& columns, bool equal_widths)
        : kernel_(kernel), entries_(quantity, averages, rows, columns, equal_widths) {
        require(kernel_.compliance() == 0 || averages > 0 || !entries_.slope(), "LayeredKernel", "compliance",
                kernel_.compliance(),
                "be 0 where the derivative is analytic: the layer's displacement jumps at the edges of elements; take "
                "Derivative::finite_difference, or Galerkin in closed form");
        split_ = kernel_.log_split(entries_.reach());
        if (split_) polynomial_.emplace(entries_, split_->even);
        // near differences lose about d^2 / (4 h delta) rounding errors: with equal widths that allows a larger d, and
        // so a Taylor series of fewer terms, each of which costs more than one of the other series
        const bool short_series = !split_ && equal_widths;
        if (split_ || kernel_.has_taylor()) entries_.far_ratio = Scalar(1) / (short_series ? 4096 : 16);
        last_taylor_ = short_series ? last_moment<Scalar> / 3 + 1 : last_moment<Scalar>;
    }

    LineIntegrals(const LineIntegrals&) = delete;  // its parts keep references to it
    LineIntegrals& operator=(const LineIntegrals&) = delete;

    /// Writes the integral for every row l and element m to out(l, m).
    void fill(MatrixX<Scalar>& out) const {
        if (split_) {
            LogarithmicSeries<Scalar>(entries_, *split_, *polynomial_).fill(out);
        } else if (kernel_.has_taylor()) {
            TaylorSeries<Scalar>(entries_, kernel_, last_taylor_).fill(out);
        }
        NearDifferences<Scalar>(entries_, kernel_, split_, polynomial_).fill(out);
        if (kernel_.compliance() != 0) DeltaPart<Scalar>(entries_, kernel_.compliance()).add(out);
    }

private:
    KernelView<Scalar> kernel_;
    Entries<Scalar> entries_;
    std::optional<LogSplit<Scalar>> split_;
    std::optional<PolynomialPart<Scalar>> polynomial_;
    int last_taylor_;  // far_ratio^last is below round-off
};

}  // namespace rollbem::detail
