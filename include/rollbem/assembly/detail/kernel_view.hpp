// A type-erased view of any line kernel, so that the code that integrates kernels is compiled once for each scalar
// type.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "../../elasticity/layered_kernel.hpp"
#include "../../elasticity/line_kernel.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

/// A kernel behind functions of arrays: the integrals below are compiled once for each scalar type and not for every
/// kernel, and the cost of a call is negligible next to the work on its array. Keeps a reference to the kernel.
/// Pointers to functions compile faster than std::function.
template <class Scalar>
struct KernelView {
    using Array = ArrayX<Scalar>;
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    template <LineKernel Kernel>
    KernelView(const Kernel& kernel);  // NOLINT(google-explicit-constructor): a view of any kernel

    /// For a kernel with a delta: views its smooth part, and keeps the delta separately.
    template <DeltaKernel Kernel>
    KernelView(const Kernel& kernel)  // NOLINT(google-explicit-constructor)
        : KernelView(kernel.elastic()) {
        compliance_ += kernel.compliance();
    }

    /// The strength of the delta [a/G]; 0 for most kernels.
    Scalar compliance() const { return compliance_; }

    /// g (level 0), H (1), H_integral (2), all without the delta.
    Array antiderivative(int level, const Array& x) const { return antiderivative_(kernel_, level, x); }
    /// Empty if the kernel has none.
    std::optional<LogSplit<Scalar>> log_split(Scalar reach) const {
        if (!log_split_) return std::nullopt;
        return log_split_(kernel_, reach);
    }
    bool has_taylor() const { return taylor_ != nullptr; }
    Table taylor(const Array& x, Eigen::Index order) const { return taylor_(kernel_, x, order); }

private:
    const void* kernel_;
    Array (*antiderivative_)(const void*, int, const Array&);
    std::optional<LogSplit<Scalar>> (*log_split_)(const void*, Scalar) = nullptr;
    Table (*taylor_)(const void*, const Array&, Eigen::Index) = nullptr;
    Scalar compliance_ = 0;
};

template <class Scalar>
template <LineKernel Kernel>
KernelView<Scalar>::KernelView(const Kernel& kernel)
    : kernel_(&kernel), antiderivative_([](const void* self, int level, const Array& x) -> Array {
          const Kernel& k = *static_cast<const Kernel*>(self);
          if (level == 0) return k.g(x);
          if (level == 1) return k.H(x);
          return k.H_integral(x);
      }) {
    if constexpr (SplitKernel<Kernel>) {
        log_split_ = [](const void* self, Scalar reach) { return static_cast<const Kernel*>(self)->log_split(reach); };
    }
    if constexpr (TaylorKernel<Kernel>) {
        taylor_ = [](const void* self, const Array& x, Eigen::Index order) -> Table {
            return static_cast<const Kernel*>(self)->taylor(x, order);
        };
    }
}

}  // namespace rollbem::detail
