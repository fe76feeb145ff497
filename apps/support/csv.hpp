// Cells and rows of CSV: RFC 4180, but lines end in a line feed.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

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

/// Rows and the names of their columns.
struct Records {
    std::vector<std::string> columns;
    std::vector<Row> rows{};

    const Cell& cell(const Row& row, std::string_view name) const { return row.at(index_of(columns, name)); }

    /// The number of a cell; not a number if it has none.
    double number(const Row& row, std::string_view name) const {
        return cell(row, name).number().value_or(std::nan(""));
    }

    /// The numbers of a column, and the texts of its cells, each once.
    std::set<double> numbers(std::string_view name) const;
    std::set<std::string> texts(std::string_view name) const;

    /// The rows with that text in a column.
    Records with(std::string_view name, const std::string& text) const;
};

}  // namespace study
