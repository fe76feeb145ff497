// Preconditions: one line naming the quantity, its value and the rule.
// Used where objects are constructed; never in a time loop.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "finite.hpp"

namespace rollbem::detail {

/// A number as a user would type it: 12 significant digits (float: 6), no trailing zeros.
template <class Value>
std::string to_text(Value value) {
    if constexpr (std::is_floating_point_v<Value>) {
        if (is_nan(value)) return "nan";
    }
    const int digits = std::is_same_v<Value, float> ? 6 : 12;
    char text[64];
    std::snprintf(text, sizeof text, "%.*Lg", digits, static_cast<long double>(value));
    return text;
}

inline std::string to_text(const char* text) { return text; }

/// Throws std::invalid_argument("<who>: <quantity> = <value> must <rule>") unless `holds`.
template <class Value>
void require(bool holds, const char* who, const char* quantity, Value value, const char* rule) {
    if (!holds) {
        throw std::invalid_argument(std::string(who) + ": " + quantity + " = " + to_text(value) + " must " + rule);
    }
}

template <std::floating_point Value>
void require_positive(const char* who, const char* quantity, Value value) {
    if (is_positive(value)) return;
    require(is_finite(value) && value > 0, who, quantity, value, "be positive and finite");
    require(value >= negligible<Value>, who, quantity, value, "be positive and finite, and not next to nothing");
}
/// Requires a half-length of a contact whose products with a modulus and other sizes stay finite. The range includes
/// all half-lengths under a positive load.
template <std::floating_point Value>
void require_half_length(const char* who, Value value) {
    require_positive(who, "half_length", value);
    constexpr bool is_single = std::is_same_v<Value, float>;
    constexpr Value least = is_single ? Value(1e-18F) : Value(1e-120), most = is_single ? Value(1e12F) : Value(1e60);
    require(value >= least && value <= most, who, "half_length", value,
            is_single ? "lie in [1e-18, 1e12]" : "lie in [1e-120, 1e60]");
}
template <class Value>
void require_not_negative(const char* who, const char* quantity, Value value) {
    require(is_finite(value) && value >= 0, who, quantity, value, "be finite and not negative");
}
template <std::floating_point Value>
void require_finite(const char* who, const char* quantity, const Value& value) {
    require(is_finite(value), who, quantity, value, "be finite");
}
template <class Value>
void require_poisson_ratio(const char* who, Value value) {
    require(is_finite(value) && value >= 0 && value <= Value(0.5), who, "poisson_ratio", value, "lie in [0, 0.5]");
}

/// Throws std::invalid_argument if a matrix has an entry that is not finite, naming the first, by row and column from
/// 0.
template <class Matrix>
void require_finite(const char* who, const char* name, const Matrix& matrix) {
    if (all_finite(matrix)) return;
    for (std::ptrdiff_t j = 0; j < matrix.cols(); ++j) {
        for (std::ptrdiff_t i = 0; i < matrix.rows(); ++i) {
            if (is_finite(matrix(i, j))) continue;
            const std::string entry = std::string(name) + '(' + to_text(i) + ", " + to_text(j) + ')';
            require(false, who, entry.c_str(), matrix(i, j), "be finite (row and column counted from 0)");
        }
    }
}

/// Throws std::invalid_argument unless a matrix is n x n and finite; `equals` names the quantity n.
template <class Matrix>
void require_square(const char* who, const char* name, const Matrix& matrix, std::ptrdiff_t n, const char* equals) {
    const std::string of = std::string(" of ") + name, rule = std::string("equal the number of ") + equals;
    require(matrix.rows() == n, who, ("number of rows" + of).c_str(), matrix.rows(), rule.c_str());
    require(matrix.cols() == n, who, ("number of columns" + of).c_str(), matrix.cols(), rule.c_str());
    require_finite(who, name, matrix);
}

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template void detail::require<double>(bool, const char*, const char*, double, const char*);
extern template void detail::require<std::ptrdiff_t>(bool, const char*, const char*, std::ptrdiff_t, const char*);
extern template void detail::require<int>(bool, const char*, const char*, int, const char*);
}  // namespace rollbem
#endif
