// Numbers as text, and the hash of a description or a saved state.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

namespace fmu {

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
