// A sum of Chebyshev polynomials that vanishes at the leading edge, divided by the distance from this edge. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <Eigen/Core>

namespace rollbem::detail {

/// (sum c_k T_k(x)) / (1 - x) at leading = 1 - x, for c_k that add up to zero, without cancellation at the leading
/// edge: Clenshaw's b_k in Reinsch's form, and sum c_k T_k = (1 - x)(b_1 - 2 sum_{k>0} b_k) if the c_k add up to zero.
template <class Value, class Scalar>
Value quotient_by_leading(const Eigen::Matrix<Value, Eigen::Dynamic, 1>& c, Scalar leading) {
    Value b = 0;
    Value difference = 0;
    Value sum = 0;
    for (Eigen::Index k = c.size() - 1; k > 0; --k) {
        difference += c[k] - 2 * leading * b;
        b += difference;
        sum += b;
    }
    return b - Scalar(2) * sum;
}

}  // namespace rollbem::detail
