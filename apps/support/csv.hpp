// Files of results: cells and rows of CSV (RFC 4180, lines end in a line feed), and files that appear whole or not at
// all, a CSV file with the TOML file beside it that says how it was made.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

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

/// The place of a column.
inline std::size_t index_of(const std::vector<std::string>& columns, std::string_view name) {
    return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
}

/// A row as a line of CSV.
std::string csv_line(const Row& row);

/// A closed pipe and a file larger than allowed then make write() throw instead of ending the program.
void ignore_write_signals();

/// A folder that results are written to, created if it does not exist. Throws BadInput, which names `name`.
void make_folder(const std::string& path, const std::string& name);

/// A file to write from start to end. A regular file is written to FILE.part and takes its own name in commit();
/// without commit() nothing is left. Pipes and devices are written to directly.
class OutputFile {
public:
    static OutputFile standard_output() { return {"-", "standard output"}; }

    /// `name` is the option or quantity that named the path, for messages. A path of - is standard output. The first
    /// `kept` bytes of FILE.part stay. Throws BadInput if the file cannot be written.
    OutputFile(const std::string& path, const std::string& name, std::size_t kept = 0);

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    bool is_regular() const { return !part_.empty(); }  ///< written to FILE.part first
    const std::string& path() const { return path_; }

    /// Throws WriteError.
    void write(std::string_view text);

    /// Passes everything written so far to the system. Throws WriteError.
    void flush();

    /// Ends the file and gives it its name. Throws WriteError.
    void commit();

    /// Leaves FILE.part as it is without commit().
    void keep_part() { part_.clear(); }

private:
    void require(bool done) const;

    std::string path_, target_, part_;
    std::ofstream file_;
    std::ostream* to_ = nullptr;
};

/// A CSV file and, if it is a regular one, the TOML file beside it. Neither takes its name before both are written.
class TableFile {
public:
    /// Writes to the file that --name gives, or to standard output without it. A table that is `resumable` goes on in
    /// FILE.part if that begins with `header` and FILE.toml.part says that the run was this one. Throws BadInput if the
    /// file cannot be written.
    TableFile(const Options& options, const std::string& name, std::string_view header, bool resumable = false);

    OutputFile& rows() { return csv_; }

    /// Lines of CSV that were there, without the header.
    const std::vector<std::string>& found() const { return found_; }

    /// Leaves what is written for another run to go on with.
    void keep_part();

    /// Throws WriteError.
    void commit();

private:
    std::string sidecar_text_;
    std::vector<std::string> found_;
    OutputFile csv_;
    std::optional<OutputFile> sidecar_;
};

}  // namespace study
