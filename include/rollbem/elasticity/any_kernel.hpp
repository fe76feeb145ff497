// AnyKernel: the line kernel of a model chosen at run time, so that templates that take a kernel are compiled once.
#pragma once

#include <limits>

#include "../detail/finite.hpp"
#include "detail/parameters.hpp"
#include "line_kernel.hpp"

namespace rollbem {

/// Models of a line contact.
enum class LineModel {
    strip,  ///< StripKernel; if b is infinite, its limit PlaneKernel
    plane,  ///< PlaneKernel
};

/// A StripKernel or a PlaneKernel.
template <class Scalar_ = double>
class AnyKernel {
public:
    using Scalar = Scalar_;

    /// half_width, c1 and c2 as in both kernels.
    AnyKernel(LineModel model, Scalar half_width, Scalar c1, Scalar c2)
        : is_plane_(model == LineModel::plane || !detail::is_finite(half_width)),
          plane_(half_width, c1, c2),
          strip_(half_width, c1, c2) {}

    static AnyKernel longitudinal(LineModel model, const Contact& contact) {
        return detail::longitudinal_kernel<AnyKernel>(contact, model);
    }
    static AnyKernel lateral(LineModel model, const Contact& contact) {
        return detail::lateral_kernel<AnyKernel>(contact, model);
    }

    LineModel model() const { return is_plane_ ? LineModel::plane : LineModel::strip; }
    Scalar half_width() const { return plane_.half_width(); }  ///< b in units of a
    /// Lambda of the plane; infinite for the strip, all of whose modes decay.
    Scalar lambda() const { return is_plane_ ? plane_.lambda() : std::numeric_limits<Scalar>::infinity(); }

    SmoothSplit<Scalar> smooth_split() const { return is_plane_ ? plane_.smooth_split() : strip_.smooth_split(); }
    Scalar smooth_part(Scalar x) const { return is_plane_ ? plane_.smooth_part(x) : strip_.smooth_part(x); }
    Scalar smooth_slope(Scalar x) const { return is_plane_ ? plane_.smooth_slope(x) : strip_.smooth_slope(x); }

private:
    bool is_plane_;
    PlaneKernel<Scalar> plane_;
    StripKernel<Scalar> strip_;
};

}  // namespace rollbem
