// Preconditions: one line naming the quantity, its value and what must hold.
// Used where objects are constructed; never in a time loop.
#pragma once

#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace rollbem::detail {

/// A number as a user would type it: 12 significant digits (float: 6), no trailing zeros.
template <class Value>
std::string to_text(Value value) {
    if (value != value) return "nan";
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

/// Throws std::invalid_argument naming the first entry of a matrix that is not finite.
template <class Matrix>
void require_finite(const char* who, const Matrix& matrix) {
    for (auto j = 0 * matrix.cols(); j < matrix.cols(); ++j) {
        for (auto i = 0 * matrix.rows(); i < matrix.rows(); ++i) {
            if (std::isfinite(matrix(i, j))) continue;
            const std::string entry = "entry (" + std::to_string(i) + ", " + std::to_string(j) + ")";
            require(false, who, entry.c_str(), matrix(i, j), "be finite");
        }
    }
}

}  // namespace rollbem::detail
