// Tests whether numbers are finite by their bits. With -ffast-math compilers assume that std::isfinite is true,
// std::isnan false and !(x > 0) the same as x <= 0, so neither a status nor a check of arguments may rely on these
// alone.
#pragma once

#include "language.hpp"

#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace rollbem::detail {

/// Numbers below this one, 1e-292 for double, lose digits when they are multiplied by a rounding error: they are
/// treated as zero.
template <class Scalar>
inline constexpr Scalar negligible = (std::numeric_limits<Scalar>::min)() / std::numeric_limits<Scalar>::epsilon();

inline constexpr std::uint32_t float_exponent = 0x7f80'0000U;
inline constexpr std::uint64_t double_exponent = 0x7ff0'0000'0000'0000U;

/// The bits of a number except its sign, read in a way that hides from the optimiser how the number was computed.
inline std::uint32_t magnitude_bits(const float& x) {
    const volatile float hidden = x;
    const float copy = hidden;
    std::uint32_t bits;
    std::memcpy(&bits, &copy, sizeof bits);
    return bits & 0x7fff'ffffU;
}
inline std::uint64_t magnitude_bits(const double& x) {
    const volatile double hidden = x;
    const double copy = hidden;
    std::uint64_t bits;
    std::memcpy(&bits, &copy, sizeof bits);
    return bits & 0x7fff'ffff'ffff'ffffU;
}
/// A long double is represented by its fraction, as its layout differs from machine to machine.
inline std::uint64_t magnitude_bits(const long double& x) {
    int exponent = 0;
    return magnitude_bits(static_cast<double>(std::frexp(x, &exponent)));
}

inline bool is_finite(const float& x) { return magnitude_bits(x) < float_exponent; }
inline bool is_finite(const double& x) { return magnitude_bits(x) < double_exponent; }
inline bool is_finite(const long double& x) { return magnitude_bits(x) < double_exponent; }
template <class Scalar>
bool is_finite(const std::complex<Scalar>& z) {
    return is_finite(z.real()) && is_finite(z.imag());
}

/// Whether a number is finite, positive and not negligible.
template <class Value>
bool is_positive(const Value& x) {
    return x >= negligible<Value> && is_finite(x);
}

inline bool is_nan(const float& x) { return magnitude_bits(x) > float_exponent; }
inline bool is_nan(const double& x) { return magnitude_bits(x) > double_exponent; }
inline bool is_nan(const long double& x) { return magnitude_bits(x) > double_exponent; }

// Adding one to the exponent carries into the sign bit if the exponent is all ones: no branch in the loop.
inline bool all_finite(const float* x, std::ptrdiff_t count) {
    std::uint32_t full = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, x + i, sizeof bits);
        full |= (bits & float_exponent) + 0x0080'0000U;
    }
    return full >> 31 == 0;
}
inline bool all_finite(const double* x, std::ptrdiff_t count) {
    std::uint64_t full = 0;
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, x + i, sizeof bits);
        full |= (bits & double_exponent) + 0x0010'0000'0000'0000U;
    }
    return full >> 63 == 0;
}
inline bool all_finite(const long double* x, std::ptrdiff_t count) {
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        if (!is_finite(x[i])) return false;
    }
    return true;
}
template <class Scalar>
bool all_finite(const std::complex<Scalar>* z, std::ptrdiff_t count) {
    return all_finite(reinterpret_cast<const Scalar*>(z), 2 * count);
}

/// Whether all entries of a dense matrix, vector or array of Eigen that owns its memory are finite.
template <class Dense>
bool all_finite(const Dense& x) {
    return all_finite(x.data(), x.size());
}

}  // namespace rollbem::detail
