// Four numbers of single precision as doubles, in packets.
#pragma once

#include "../../detail/language.hpp"

#include <Eigen/Core>

namespace rollbem::detail {

/// Converts by packets; Eigen's cast would break up the packets of the expression around it.
inline Eigen::Array4d to_double(const Eigen::Array4f& single) {
    Eigen::Array4d wide;
    for (Eigen::Index i = 0; i < 4; ++i) wide[i] = static_cast<double>(single[i]);
    return wide;
}

}  // namespace rollbem::detail
