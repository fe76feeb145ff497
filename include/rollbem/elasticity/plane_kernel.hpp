// PlaneKernel: the line kernel of a contact far wider than long, b >> a.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "../closed_form/plane_lambda.hpp"
#include "../scene/contact.hpp"
#include "detail/parameters.hpp"
#include "kernel_concepts.hpp"

namespace rollbem {

/// Limit b >> a of the strip, the kernel of Eq. (20): g = (1/(pi G)) [c1 ln(4 b^2/x^2) + 2 c2]. b remains a parameter;
/// for b = inf only g' exists, and hence only steady problems.
template <class Scalar_ = double>
class PlaneKernel {
public:
    using Scalar = Scalar_;

    /// half_width b in units of a; (c1, c2) = (1 - nu, nu) for longitudinal creepage and (1, -nu) for lateral. Throws
    /// std::invalid_argument unless b > 0 and c1 and c2 are finite.
    PlaneKernel(Scalar half_width, Scalar c1, Scalar c2)
        : b_(half_width),
          lambda_(detail::plane_lambda_of(half_width, c2 / c1)),
          strength_(2 * c1 / std::numbers::pi_v<Scalar>),
          constant_(2 / std::numbers::pi_v<Scalar> * (c1 * std::log(2 * half_width) + c2)) {
        detail::check_line_kernel("PlaneKernel", half_width, c1, c2);
    }

    static PlaneKernel longitudinal(const Contact& contact) {
        return detail::longitudinal_kernel<PlaneKernel>(contact);
    }
    static PlaneKernel lateral(const Contact& contact) { return detail::lateral_kernel<PlaneKernel>(contact); }

    Scalar half_width() const { return b_; }  ///< b in units of a

    /// Lambda = ln(4b/a) + c2/c1, for longitudinal creepage ln(4b/a) + nu/(1-nu): the compliance for a constant
    /// displacement over the compliance for the first harmonic. All modes of the plane model decay for positive Lambda;
    /// one grows for negative Lambda, where the kernel is used far outside b >> a.
    Scalar lambda() const { return lambda_; }

    SmoothSplit<Scalar> smooth_split() const { return {constant_, strength_, std::numeric_limits<Scalar>::infinity()}; }
    Scalar smooth_part(Scalar) const { return 0; }
    Scalar smooth_slope(Scalar) const { return 0; }

private:
    Scalar b_, lambda_, strength_, constant_;
};

}  // namespace rollbem
