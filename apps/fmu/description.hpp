// modelDescription.xml and the documentation of an FMU, written from the table of its variables; numbers as text, and
// the hash of a description or a saved state.
#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <string>

namespace fmu {

/// Categories of messages with fmi2Warning, fmi2Discard and fmi2Error.
inline constexpr std::array log_categories{"logStatusWarning", "logStatusDiscard", "logStatusError"};

/// The text of modelDescription.xml.
std::string model_description();

/// The GUID of the description: a hash of the rest of its text, so that a library matches a description if and only if
/// both say the same.
const std::string& guid();

/// The variables as a table in Markdown.
std::string table_of_variables();

/// The shortest text that is read as the same number.
template <class Number>
std::string text_of(Number value) {
    char buffer[64];
    return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

/// 64 bits of FNV-1a.
template <class Bytes>
std::uint64_t hash_of(const Bytes& bytes, std::uint64_t seed = 0) {
    std::uint64_t hash = 0xcbf29ce484222325u ^ seed;
    for (const auto byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3u;
    return hash;
}

}  // namespace fmu
