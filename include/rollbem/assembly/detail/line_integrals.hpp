// Line integrals: a line kernel, or its derivative, integrated over an element and averaged about a point.
// Every entry of G and G' of Eqs. (12)-(14) is such an integral; this header fills whole matrices of them.
#pragma once

#include "../../detail/require.hpp"
#include "../../types.hpp"
#include "delta_part.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"
#include "logarithmic_series.hpp"
#include "near_differences.hpp"
#include "smooth_part.hpp"

namespace rollbem::detail {

/// The logarithm in closed form, near entries by differences of antiderivatives, far ones (|d| well above
/// h + averages delta) by a series; then the smooth part, and a delta.
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

}  // namespace rollbem::detail
