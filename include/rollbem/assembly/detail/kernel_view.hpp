// A type-erased view of any kernel, so that the code that integrates kernels is compiled once for each scalar type.
#pragma once

#include <Eigen/Core>

#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// A kernel as data and a function of arrays, whose call costs little next to the work on its array. Keeps a reference
/// to the kernel. Pointers to functions compile faster than std::function.
template <class Scalar>
struct KernelView {
    SmoothSplit<Scalar> split;

    template <LineKernel Kernel>
    KernelView(const Kernel& kernel);  // NOLINT(google-explicit-constructor): a view of any kernel

    /// Replaces each x by the smooth part at x, or by its slope.
    void evaluate(bool slope, ArrayX<Scalar>& x) const { evaluate_(kernel_, slope, x); }

private:
    const void* kernel_;
    void (*evaluate_)(const void*, bool, ArrayX<Scalar>&);
};

template <class Scalar>
template <LineKernel Kernel>
KernelView<Scalar>::KernelView(const Kernel& kernel)
    : split(kernel.smooth_split()), kernel_(&kernel), evaluate_([](const void* self, bool slope, ArrayX<Scalar>& x) {
          const Kernel& k = *static_cast<const Kernel*>(self);
          for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = slope ? k.smooth_slope(x[i]) : k.smooth_part(x[i]);
      }) {}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template detail::KernelView<double>::KernelView(const AnyKernel<double>&);
extern template detail::KernelView<double>::KernelView(const PlaneKernel<double>&);
extern template detail::KernelView<double>::KernelView(const StripKernel<double>&);
}  // namespace rollbem
#endif
