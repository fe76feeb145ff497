// TerminalTable: rows for people on a terminal, in place of CSV: the columns that a case varies and its results,
// aligned, with units in the head.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "csv.hpp"

namespace study {

/// A column of a table.
struct Heading {
    std::string name;
    std::string unit{};    ///< in brackets; empty where the name says it, or there is none
    bool of_case = false;  ///< input of the computation, which is shown where it varies; other columns are results
};

/// "NAME [UNIT]", or NAME alone.
Heading heading_of(const std::string& text);

/// The first unit in brackets in the meaning of a column. Microseconds are none, as names of times end in _us.
std::string unit_in(const std::string& meaning);

/// Columns of rows that are shown as blocks, a value a line, below a title.
struct Blocks {
    std::vector<std::string> title, lines;
};

class TerminalTable {
public:
    static constexpr std::size_t most_rows = 40;  ///< that are shown

    /// With `by_scheme` the column scheme stands for all that it says, else these columns do.
    TerminalTable(std::vector<Heading> headings, bool by_scheme)
        : headings_(std::move(headings)),
          by_scheme_(by_scheme),
          varied_(headings_.size()),
          filled_(headings_.size()),
          beyond_scheme_(headings_.size()) {}

    void add(const Row& row);

    /// The first rows below their columns, and a line that counts all others. No more columns than are `width` wide,
    /// unless the case varies so many; the widest texts end with dots where they would not fit.
    std::string text(std::size_t width) const;

    /// The first rows as blocks, lengths in millimetres and pressures in megapascals.
    std::string text(const Blocks& blocks) const;

private:
    /// The places of the columns to show.
    std::vector<std::size_t> shown(std::size_t width) const;
    bool is_shown(std::size_t column) const;
    std::vector<std::string> lines_of(std::size_t column, std::size_t widest = std::string::npos) const;
    std::string quantity(const Row& row, std::size_t column) const;
    std::string rest(std::size_t columns) const;

    std::vector<Heading> headings_;
    bool by_scheme_;
    std::vector<Row> rows_{};  ///< the first
    std::size_t count_ = 0;    ///< of all
    std::vector<std::string> first_{};
    std::map<std::string, std::vector<std::string>> first_of_scheme_{};
    std::vector<char> varied_, filled_, beyond_scheme_;  ///< a column varies, has values, varies within a scheme
};

}  // namespace study
