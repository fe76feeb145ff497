// A fingerprint of numbers, by which a model recognises another model's state. It depends on the values alone, and so
// is the same in another process.
#pragma once

#include "language.hpp"

#include <bit>
#include <concepts>
#include <cstdint>

#include <Eigen/Core>

namespace rollbem::detail {

/// Mixes numbers into 64 bits, one after another.
class Fingerprint {
public:
    template <std::floating_point Scalar>
    void add(Scalar value) {
        // a long double has padding bytes, so it is added as two doubles
        const double high = static_cast<double>(value);
        mix(std::bit_cast<std::uint64_t>(high));
        if constexpr (sizeof(Scalar) > sizeof(double)) {
            mix(std::bit_cast<std::uint64_t>(static_cast<double>(value - static_cast<Scalar>(high))));
        }
    }
    template <class Derived>
    void add(const Eigen::DenseBase<Derived>& values) {
        mix(static_cast<std::uint64_t>(values.rows()));
        for (Eigen::Index j = 0; j < values.cols(); ++j) {
            for (Eigen::Index i = 0; i < values.rows(); ++i) add(values(i, j));
        }
    }

    std::uint64_t value() const { return state_; }

private:
    // the odd factor is 2^64 over the golden ratio
    void mix(std::uint64_t bits) { state_ = (std::rotl(state_, 23) ^ bits) * 0x9E3779B97F4A7C15u; }

    std::uint64_t state_ = 0x6A09E667F3BCC908u;
};

}  // namespace rollbem::detail
