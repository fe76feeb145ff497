// Tables of text: the lines of a file, their cells and the numbers in them.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "finite.hpp"

namespace rollbem::detail {

inline std::string_view trimmed(std::string_view text) {
    const char* const blanks = " \t\r\v\f";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return lower;
}

/// Numbers below it in size are none: products of three of them lose digits.
inline constexpr double least_number = 1e-100;

/// The whole text as a number, which may have a plus sign, with a decimal point in any locale, or nothing.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The text as a finite number, 0 if it is below least_number in size, or nothing.
inline std::optional<double> number_of(std::string_view text) {
    const auto value = parse_number<double>(text);
    if (!value || !is_finite(*value)) return std::nullopt;
    return std::abs(*value) < least_number ? 0 : value;
}

/// A text file in memory. Lines end in LF, CR LF or CR; a byte-order mark of UTF-8 is skipped.
class TextFile {
public:
    /// Throws std::invalid_argument if the file cannot be read or is no text.
    explicit TextFile(const std::filesystem::path& path) : TextFile(path, text_of(path)) {}
    /// Takes the text of a file that messages call by this name.
    TextFile(std::filesystem::path name, std::string text) : path_(std::move(name)) {
        if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
        for (std::size_t from = 0; from < text.size();) {
            const std::size_t end = (std::min)(text.find_first_of("\r\n", from), text.size());
            lines_.push_back(text.substr(from, end - from));
            from = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
        }
    }

    const std::filesystem::path& path() const { return path_; }
    std::size_t size() const { return lines_.size(); }
    std::string_view line(std::size_t i) const { return lines_[i]; }  ///< number i + 1

    /// The line up to a comment, which begins with one of the signs.
    std::string_view uncommented(std::size_t i, const char* comment_signs = "%#!") const {
        return line(i).substr(0, line(i).find_first_of(comment_signs));
    }
    /// The line without comment and without blanks at both ends.
    std::string_view content(std::size_t i, const char* comment_signs = "%#!") const {
        return trimmed(uncommented(i, comment_signs));
    }

    /// Throws std::invalid_argument("<path>, line <i + 1> (<its text>): <expectation>").
    [[noreturn]] void refuse(std::size_t i, const std::string& expected) const {
        std::string text(trimmed(line(i)));
        if (text.size() > 60) text = text.substr(0, 57) + "...";
        for (char& c : text) {
            if (static_cast<unsigned char>(c) < ' ') c = '?';
        }
        throw std::invalid_argument(path_.string() + ", line " + std::to_string(i + 1) + " (" + text +
                                    "): " + expected);
    }
    /// Throws std::invalid_argument("<path>: <text>").
    [[noreturn]] void refuse(const std::string& text) const {
        throw std::invalid_argument(path_.string() + ": " + text);
    }

private:
    static std::string text_of(const std::filesystem::path& path) {
        std::error_code error;
        std::ifstream in;
        if (!std::filesystem::is_directory(path, error)) in.open(path, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(in), {}};
        if (!in.is_open() || in.bad()) throw std::invalid_argument(path.string() + ": the file cannot be read");
        if (text.find('\0') != std::string::npos) {
            throw std::invalid_argument(path.string() + ": a file of text was expected, and this has bytes of 0");
        }
        return text;
    }

    std::filesystem::path path_;
    std::vector<std::string> lines_;
};

/// The cells of a line, without their quotes and the blanks around them. A blank as separator stands for any run of
/// blanks and tabs.
inline std::vector<std::string> cells_of(std::string_view line, char separator = ',') {
    const bool blanks = separator == ' ';
    if (blanks) line = trimmed(line);
    std::vector<std::string> cells(1);
    bool quoted = false, between = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool separates = !quoted && (line[i] == separator || (blanks && line[i] == '\t'));
        if (separates && !(blanks && between)) cells.emplace_back();
        between = separates;
        if (separates) continue;
        if (line[i] == '"' && quoted && line.substr(i + 1, 1) == "\"") {
            cells.back() += line[i++];  // two stand for one
        } else if (line[i] == '"') {
            quoted = !quoted;
        } else {
            cells.back() += line[i];
        }
    }
    for (std::string& cell : cells) cell = std::string(trimmed(cell));
    return cells;
}

/// The separator of a table's cells. A line `sep=;` above the table names it; otherwise the first line with a
/// semicolon, a comma or a tab outside quotes has it, in this order, but tabs behind a number are blanks, and a comma
/// in it is its decimal point. Lines without the separator have blanks between their cells.
class Separator {
public:
    /// Whether the line only names the separator, of all that follow.
    bool is_named_by(std::string_view line) {
        const std::string text = lower_case(cells_of(line, '\n')[0]);
        if (text.compare(0, 4, "sep=") != 0 || text.size() > 5) return false;
        sign_ = text.size() == 5 ? text[4] : '\t';  // the tab is trimmed away
        return true;
    }

    /// The cells of the next line, without empty ones at its end.
    std::vector<std::string> split(std::string_view line) {
        if (sign_ == 0) sign_ = sign_in(line);
        std::vector<std::string> cells = cells_of(line, sign_ == 0 ? ' ' : sign_);
        if (cells.size() == 1) cells = cells_of(line, ' ');
        while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
        return cells;
    }

    /// A cell as a finite number, or nothing. Unless commas separate the cells, a comma may be the decimal point.
    std::optional<double> number(const std::string& cell) const {
        return sign_ == ',' ? number_of(cell) : number_with_comma(cell);
    }

    /// "a comma", for messages.
    std::string name() const {
        return sign_ == ',' ? "a comma" : sign_ == ';' ? "a semicolon" : sign_ == '\t' ? "a tab" : "blanks";
    }

private:
    static std::optional<double> number_with_comma(std::string cell) {
        std::replace(cell.begin(), cell.end(), ',', '.');
        return number_of(cell);
    }

    static char sign_in(std::string_view line) {
        const auto has = [line](char sign) { return cells_of(line, sign).size() > 1; };
        if (has(';')) return ';';
        const std::string first = cells_of(trimmed(line), '\t')[0];
        if (has('\t') && number_with_comma(first) && first.back() != ',') return ' ';
        return has(',') ? ',' : has('\t') ? '\t' : '\0';
    }

    char sign_ = 0;  // 0: not known yet
};

}  // namespace rollbem::detail
