#include "csv.hpp"

#include <array>
#include <charconv>

namespace study {

std::string Cell::text(std::optional<int> digits) const {
    if (const auto* text = std::get_if<std::string>(&value_)) return *text;
    std::array<char, 64> buffer;
    char* const end = buffer.data() + buffer.size();
    if (const auto* number = std::get_if<double>(&value_)) {
        return {buffer.data(), digits
                                   ? std::to_chars(buffer.data(), end, *number, std::chars_format::general, *digits).ptr
                                   : std::to_chars(buffer.data(), end, *number).ptr};
    }
    const auto* integer = std::get_if<long long>(&value_);
    return integer != nullptr ? std::to_string(*integer) : "";
}

std::string csv_line(const Row& row) {
    std::string line;
    for (const Cell& cell : row) {
        if (&cell != &row.front()) line += ',';
        const std::string text = cell.text();
        if (text.find_first_of(",\"\r\n") == std::string::npos) {
            line += text;
            continue;
        }
        line += '"';
        for (const char c : text) line.append(c == '"' ? 2 : 1, c);
        line += '"';
    }
    return line += '\n';
}

std::set<double> Records::numbers(std::string_view name) const {
    std::set<double> found;
    for (const Row& row : rows) {
        if (const auto number = cell(row, name).number()) found.insert(*number);
    }
    return found;
}

std::set<std::string> Records::texts(std::string_view name) const {
    std::set<std::string> found;
    for (const Row& row : rows) found.insert(cell(row, name).text());
    return found;
}

Records Records::with(std::string_view name, const std::string& text) const {
    Records found{columns};
    for (const Row& row : rows) {
        if (cell(row, name).text() == text) found.rows.push_back(row);
    }
    return found;
}

}  // namespace study
