// Bitwise comparison of two vectors.
#pragma once

#include "../../detail/language.hpp"

#include <cstddef>
#include <cstring>

namespace rollbem::detail {

/// For vectors of equal length; faster than ==. Zeros of different sign count as different, and so may equal values of
/// long double, because of padding: use it only to decide whether something is computed again.
template <class Values>
bool same_bits(const Values& x, const Values& y) {
    return std::memcmp(x.data(), y.data(), static_cast<std::size_t>(x.size()) * sizeof(*x.data())) == 0;
}

}  // namespace rollbem::detail
