// Preconditions: one line naming the quantity, its value and what must hold.
// Used where objects are constructed; never in a time loop.
#pragma once

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

/// Throws std::invalid_argument("<who>: <quantity> = <value> must <rule>") unless `holds`.
template <class Value>
void require(bool holds, const char* who, const char* quantity, Value value, const char* rule) {
    if (!holds) {
        throw std::invalid_argument(std::string(who) + ": " + quantity + " = " + to_text(value) + " must " + rule);
    }
}

}  // namespace rollbem::detail
