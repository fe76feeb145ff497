// The condition that problems with G'^-1 G require of G'. Internal.
#pragma once

#include "../../detail/language.hpp"

namespace rollbem::detail {

/// Below this rcond(G') no result is taken from G'^-1 G: it could have lost more than four digits.
inline constexpr double least_rcond_of_G_prime = 1e-4;

}  // namespace rollbem::detail
