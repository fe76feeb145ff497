// Files of results: cells and rows of CSV (RFC 4180, lines end in a line feed), files that appear whole or not at all,
// and the TOML file beside a CSV file that says how it was made.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "errors.hpp"
#include "options.hpp"

namespace study {

/// One cell: a number, a text, or nothing. Numbers that are not finite are nothing, and zero has no sign.
class Cell {
public:
    Cell() = default;
    Cell(std::floating_point auto number) {
        if (std::isfinite(number)) value_ = static_cast<double>(number) + 0.0;
    }
    Cell(std::integral auto number) : value_(static_cast<long long>(number)) {}
    Cell(std::string text) : value_(std::move(text)) {}
    Cell(const char* text) : value_(std::string(text)) {}
    template <class Value>
    Cell(const std::optional<Value>& value) : Cell(value ? Cell(*value) : Cell()) {}

    /// A number with up to that many significant digits; without `digits` it is the shortest text that is read back as
    /// the same double.
    std::string text(std::optional<int> digits = {}) const;

    std::optional<double> number() const {
        if (const auto* number = std::get_if<double>(&value_)) return *number;
        if (const auto* integer = std::get_if<long long>(&value_)) return static_cast<double>(*integer);
        return std::nullopt;
    }

private:
    std::variant<std::monostate, double, long long, std::string> value_;
};

using Row = std::vector<Cell>;

/// Both lists, one after the other.
template <class Item>
std::vector<Item> joined(std::vector<Item> first, const std::vector<Item>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

/// Several lists, one after the other.
inline Row row_of(std::initializer_list<Row> parts) {
    Row row;
    for (const Row& part : parts) row.insert(row.end(), part.begin(), part.end());
    return row;
}

/// The place of a column.
inline std::size_t index_of(const std::vector<std::string>& columns, std::string_view name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

/// A row as a line of CSV.
std::string csv_line(const Row& row);

namespace detail {

struct TemporaryPath;

/// Lets an interrupt remove the file or, once it is empty, the folder, until it is released. Null if its name is too
/// long or there are too many of them.
TemporaryPath* claim_temporary(const std::string& path);

/// Does nothing for null.
void release_temporary(TemporaryPath* temporary);

}  // namespace detail

/// An interrupt ends the program with 128 + its number and leaves no partial file; a closed pipe, a stream that the
/// caller closed and a file larger than allowed make write() throw.
void handle_signals();

/// A file to write from start to end. A regular file is written under another name beside it and takes its own name in
/// commit(); without commit() nothing is left. Pipes and devices are written to directly.
class OutputFile {
public:
    static OutputFile standard_output();

    /// `name` is the option or quantity that named the path, for messages. A path of - is standard output; links are
    /// followed, even to a file that does not exist yet. Throws BadInput if it cannot be written.
    OutputFile(const std::string& path, const std::string& name);

    OutputFile(OutputFile&& other) noexcept;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    OutputFile& operator=(OutputFile&&) = delete;

    ~OutputFile();

    bool is_regular() const;  ///< written under another name first
    const std::string& path() const;

    void write(std::string_view text);

    /// Passes everything written so far to the system. Throws WriteError.
    void flush();

    /// Ends the file. A regular one is then completely on the disk, still under the other name. Throws WriteError.
    void close();

    /// Gives the file its name, and ends it if close() has not. Throws WriteError.
    void commit();

private:
    OutputFile(std::string shown, int descriptor);

    [[noreturn]] void fail(int error) const;

    void remove_temporary();

    std::string shown_, target_, temporary_, buffer_;
    int descriptor_ = -1;
    detail::TemporaryPath* slot_ = nullptr;
};

/// The TOML file that stands beside a CSV file.
std::string sidecar_text(const Options& options);

/// A CSV file and, if it is a regular one, the TOML file beside it. Neither takes its name before both are completely
/// on the disk.
class TableFile {
public:
    /// Writes to the file that --name gives, or to standard output without it. Throws BadInput if that cannot be
    /// written.
    TableFile(const Options& options, const std::string& name);

    OutputFile& rows() { return csv_; }

    /// Throws WriteError.
    void commit();

private:
    const Options& options_;
    OutputFile csv_;
    std::optional<OutputFile> sidecar_;
};

}  // namespace study
