// Numbers that are not finite, and a scene, for units compiled with -ffast-math.
#pragma once

#include <cstdint>
#include <cstring>

#include <rollbem/friction/friction.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

#ifndef __FAST_MATH__
#error "compile this file with -ffast-math"
#endif

namespace fast_math_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

// numbers that the compiler cannot reason about
inline double from_bits(std::uint64_t number) {
    const volatile std::uint64_t hidden = number;
    const std::uint64_t bits = hidden;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}
inline const double nan = from_bits(0x7ff8'0000'0000'0000U), infinity = from_bits(0x7ff0'0000'0000'0000U);

inline bool finite(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits >> 52 & 0x7ffU) != 0x7ffU;
}

inline const Contact<double> contact = Contact<double>::dimensionless(10, 0.25);
inline const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
constexpr Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
constexpr Eigen::Index n = 6;

struct Fixture {
    Mesh<double> mesh = uniform_mesh(n);
    ArrayX<double> widths = mesh.widths();
    ElementSystem<double> good = rolling_system(mesh, scheme, kernel);
    Friction<> friction{0.3, ArrayX<double>::Ones(n)};
};

}  // namespace fast_math_tests
