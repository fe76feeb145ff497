// Operations on whole arrays in one place: every Eigen expression has a type of its own, which costs compile time.
// Operations that need no vector instructions are therefore plain loops; the others are here.
#pragma once

#include "language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <Eigen/Core>

namespace rollbem::detail {

/// Sum of a_i b_i, i < size.
template <class Scalar>
Scalar dot(const Scalar* a, const Scalar* b, Eigen::Index size) {
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    return Eigen::Map<const Vector>(a, size).dot(Eigen::Map<const Vector>(b, size));
}

/// Sum of |a_i|, i < size.
template <class Scalar>
Scalar sum_of_magnitudes(const Scalar* a, Eigen::Index size) {
    return Eigen::Map<const Eigen::Array<Scalar, Eigen::Dynamic, 1>>(a, size).abs().sum();
}

/// An array of `size` equal values.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> constant_array(Eigen::Index size, Scalar value) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(size);
    std::fill_n(result.data(), size, value);
    return result;
}

/// Entries first ... first + count - 1.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> segment(const Eigen::Array<Scalar, Eigen::Dynamic, 1>& x, Eigen::Index first,
                                                Eigen::Index count) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(count);
    std::copy_n(x.data() + first, count, result.data());
    return result;
}

/// x / 2.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> halved(const Eigen::Array<Scalar, Eigen::Dynamic, 1>& x) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = x[i] / 2;
    return result;
}

/// Whether two vectors of equal length have the same bits, which is faster than ==. Zeros of different sign count as
/// different, and so may equal values of long double, because of padding: use it only to decide whether something is
/// computed again.
template <class Values>
bool same_bits(const Values& x, const Values& y) {
    return std::memcmp(x.data(), y.data(), static_cast<std::size_t>(x.size()) * sizeof(*x.data())) == 0;
}

/// The logarithm of |x|, or of `least` where that is larger; with vector instructions, which std::log lacks.
template <class Scalar>
Eigen::Array<Scalar, Eigen::Dynamic, 1> log_of_magnitude(const Eigen::Array<Scalar, Eigen::Dynamic, 1>& x,
                                                         Scalar least) {
    Eigen::Array<Scalar, Eigen::Dynamic, 1> result(x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = (std::max)(std::abs(x[i]), least);
    result = result.log();
    return result;
}

}  // namespace rollbem::detail
