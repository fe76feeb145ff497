// Numbers in binary streams, little-endian, with the checksum FNV-1a of all bytes.
#pragma once

#include "language.hpp"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace rollbem::detail {

/// 64 bits of FNV-1a.
class Fnv1a {
public:
    void add(const char* data, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            value_ = (value_ ^ static_cast<unsigned char>(data[i])) * 0x100000001b3U;
        }
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xcbf29ce484222325U;
};

class CheckedWriter {
public:
    /// Begins the stream with the text.
    CheckedWriter(std::ostream& stream, const std::string& text) : stream_(stream) { bytes(text.data(), text.size()); }

    template <class Integer>
    void integer(Integer value) {
        std::array<char, sizeof value> data;
        for (std::size_t i = 0; i < sizeof value; ++i) data[i] = static_cast<char>(value >> 8 * i & 0xff);
        bytes(data.data(), data.size());
    }
    void number(double value) { integer(std::bit_cast<std::uint64_t>(value)); }
    void number(float value) { integer(std::bit_cast<std::uint32_t>(value)); }
    void finish() { integer(checksum_.value()); }

private:
    void bytes(const char* data, std::size_t count) {
        checksum_.add(data, count);
        stream_.write(data, static_cast<std::streamsize>(count));
    }

    std::ostream& stream_;
    Fnv1a checksum_;
};

/// Throws std::invalid_argument, beginning with `who`, if the stream could not be opened, does not begin with the text,
/// ends too early, or does not agree with its checksum.
class CheckedReader {
public:
    CheckedReader(std::istream& stream, const char* who, const std::string& text) : stream_(stream), who_(who) {
        std::string found(text.size(), ' ');
        bytes(found.data(), found.size());
        if (found != text) refuse("the stream must begin with \"" + text + '"');
    }

    template <class Integer>
    Integer integer() {
        std::array<char, sizeof(Integer)> data;
        bytes(data.data(), data.size());
        Integer value = 0;
        for (std::size_t i = 0; i < data.size(); ++i) {
            value |= static_cast<Integer>(static_cast<unsigned char>(data[i])) << 8 * i;
        }
        return value;
    }
    double number() { return std::bit_cast<double>(integer<std::uint64_t>()); }
    float single() { return std::bit_cast<float>(integer<std::uint32_t>()); }
    void finish() {
        const std::uint64_t checksum = checksum_.value();
        if (integer<std::uint64_t>() != checksum) refuse("the numbers must agree with their checksum");
    }

private:
    void bytes(char* data, std::size_t count) {
        if (!stream_) refuse("the stream must be readable: is the file there?");
        if (!stream_.read(data, static_cast<std::streamsize>(count)))
            refuse("the stream must not end within the table");
        checksum_.add(data, count);
    }
    [[noreturn]] void refuse(const std::string& rule) const { throw std::invalid_argument(who_ + (": " + rule)); }

    std::istream& stream_;
    std::string who_;
    Fnv1a checksum_;
};

/// Reads the table in a file. Throws std::invalid_argument, beginning with `who`, if the file cannot be opened, or is a
/// folder, which some systems open.
template <class Table>
Table read_file(const std::filesystem::path& path, const std::string& who) {
    std::ifstream file(path, std::ios::binary);
    std::error_code unknown;
    if (!file || std::filesystem::is_directory(path, unknown))
        throw std::invalid_argument(who + ": " + path.string() + " must be a file that can be read");
    return Table::read(file);
}

}  // namespace rollbem::detail
