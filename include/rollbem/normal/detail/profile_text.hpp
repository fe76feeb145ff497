// Lines and numbers of text files with profiles, and the points in them: two columns, SIMPACK's and MiniProf's text.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "../../detail/finite.hpp"

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

/// The whole text as a finite number, with a decimal point in any locale, or nothing.
inline std::optional<double> number_of(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !is_finite(value)) return std::nullopt;
    return value;
}

/// A text file in memory. Lines end in LF, CR LF or CR; a byte-order mark of UTF-8 is skipped.
class TextFile {
public:
    /// Throws std::invalid_argument if the file cannot be read or is no text.
    explicit TextFile(const std::filesystem::path& path) : path_(path) {
        std::error_code error;
        std::ifstream in;
        if (!std::filesystem::is_directory(path, error)) in.open(path, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(in), {}};
        if (!in.is_open() || in.bad()) throw std::invalid_argument(path.string() + ": the file cannot be read");
        if (text.find('\0') != std::string::npos) {
            throw std::invalid_argument(path.string() + ": a file of text was expected, and this has bytes of 0");
        }
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

    /// The line without comment, which begins with one of the signs, and without blanks at both ends.
    std::string_view content(std::size_t i, const char* comment_signs = "%#!") const {
        const std::string_view text = line(i);
        return trimmed(text.substr(0, text.find_first_of(comment_signs)));
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
    std::filesystem::path path_;
    std::vector<std::string> lines_;
};

/// Cells separated by semicolons, else by commas, else by blanks.
inline std::vector<std::string_view> cells_of(std::string_view text) {
    std::vector<std::string_view> cells;
    for (const char* separator : {";", ",", " \t"}) {
        if (text.find_first_of(separator) == std::string_view::npos && *separator != ' ') continue;
        for (std::size_t from = 0; from <= text.size();) {
            const std::size_t end = (std::min)(text.find_first_of(separator, from), text.size());
            const std::string_view cell = trimmed(text.substr(from, end - from));
            if (!cell.empty() || *separator != ' ') cells.push_back(cell);
            from = end + 1;
        }
        break;
    }
    return cells;
}

/// Points of a curve [m] and the numbers of their lines, from 0.
struct CurvePoints {
    std::vector<double> y, z;
    std::vector<std::size_t> line;

    std::size_t size() const { return y.size(); }
    void add(double at_y, double at_z, std::size_t in_line) {
        y.push_back(at_y);
        z.push_back(at_z);
        line.push_back(in_line);
    }
};

inline constexpr const char* two_numbers_expected =
    "y and z are expected, two numbers with decimal points, separated by a comma, a semicolon, a tab or blanks";

/// y and z in the cells with these numbers. Throws std::invalid_argument if the cells are not numbers.
inline std::array<double, 2> point_in(const TextFile& file, std::size_t line, std::string_view content,
                                      const std::array<std::size_t, 2>& places = {0, 1}) {
    const std::vector<std::string_view> cells = cells_of(content);
    std::array<double, 2> point;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto value = places[k] < cells.size() ? number_of(cells[places[k]]) : std::nullopt;
        if (!value) file.refuse(line, two_numbers_expected);
        point[k] = *value;
    }
    return point;
}

/// The numbers of the columns named y and z: "y", "Y [mm]", "\"z\"".
inline std::array<std::size_t, 2> places_in_header(const TextFile& file, std::size_t line, std::string_view content) {
    std::array<std::optional<std::size_t>, 2> found;
    std::size_t place = 0;
    for (const std::string_view cell : cells_of(content)) {
        std::string name;
        for (const char c : lower_case(cell.substr(0, cell.find_first_of("[(")))) {
            if (c != '"' && c != '\'' && c != ' ') name += c;
        }
        if (name.empty() && !cell.empty() && cell.find_first_of("[(") == 0) continue;  // a unit between blanks
        if (name == "y" || name == "z") {
            auto& of = found[name == "z"];
            if (of) file.refuse(line, "one column y and one column z are expected");
            of = place;
        }
        ++place;
    }
    if (!found[0] || !found[1]) {
        file.refuse(line, std::string(two_numbers_expected) + ", or a header that names columns y and z");
    }
    return {*found[0], *found[1]};
}

/// y and z of a table, in units of which `per_metre` are a metre.
inline CurvePoints read_columns(const TextFile& file, double per_metre) {
    CurvePoints points;
    std::optional<std::array<std::size_t, 2>> places;
    for (std::size_t i = 0; i < file.size(); ++i) {
        const std::string_view content = file.content(i);
        if (content.empty()) continue;
        if (!places) {
            places.emplace(std::array<std::size_t, 2>{0, 1});
            const std::string_view first = cells_of(content).front();
            if (!first.empty() && first.find_first_of("+-.0123456789") != 0) {
                places = places_in_header(file, i, content);
                continue;
            }
        }
        const auto [y, z] = point_in(file, i, content, *places);
        points.add(y / per_metre, z / per_metre, i);
    }
    return points;
}

/// The settings "name = value" above the points of SIMPACK's text.
class SimpackSettings {
public:
    /// Throws std::invalid_argument if a setting that changes points has no number or an unsupported one.
    void read(const TextFile& file, std::size_t line, std::string_view key, std::string_view text) {
        const auto setting = values_.find(std::string(key));
        if (setting == values_.end()) return;
        const auto value = number_of(cells_of(text).empty() ? text : cells_of(text).front());
        if (!value) file.refuse(line, std::string(key) + " is expected to be a finite number");
        setting->second = *value;
        for (const char* unknown : {"rotate", "approx.smooth", "point.dist.min"}) {
            if (key == unknown && *value != 0) file.refuse(line, std::string(key) + " is expected to be 0");
        }
        if (key == "units.len.f" && !(*value > 0)) file.refuse(line, "units.len.f is expected to be positive");
    }

    double operator[](const char* key) const { return values_.at(key); }

    /// Throws std::invalid_argument if there are bounds.
    void require_no_bounds(const TextFile& file) const {
        for (const std::string of : {"bound.y", "bound.z"}) {
            if (values_.at(of + ".min") < values_.at(of + ".max")) {
                file.refuse(of + ".min must not be below " + of + ".max: cut the points instead");
            }
        }
    }

private:
    // settings that change points; others do not, or only with values other than 0
    std::map<std::string, double> values_{
        {"mirror.y", 0},    {"mirror.z", 0},    {"shift.y", 0},       {"shift.z", 0},        {"units.len.f", 1000},
        {"inversion", 0},   {"rotate", 0},      {"approx.smooth", 0}, {"point.dist.min", 0}, {"bound.y.min", 1},
        {"bound.y.max", 0}, {"bound.z.min", 1}, {"bound.z.max", 0}};
};

/// The points between point.begin and point.end of SIMPACK's .prr and .prw.
inline CurvePoints read_simpack(const TextFile& file) {
    SimpackSettings settings;
    CurvePoints points;
    bool inside = false, ended = false;
    for (std::size_t i = 0; i < file.size() && !ended; ++i) {
        const std::string_view content = file.content(i);
        if (content.empty()) continue;
        const std::size_t equals = content.find('=');
        if (content == "point.begin" || content == "point.end") {
            ended = inside;
            inside = content == "point.begin" && !ended;
        } else if (inside) {
            const auto [y, z] = point_in(file, i, content);
            points.add(y, z, i);
        } else if (equals != std::string_view::npos) {
            settings.read(file, i, trimmed(content.substr(0, equals)), trimmed(content.substr(equals + 1)));
        }
    }
    if (!ended) file.refuse("points are expected between a line point.begin and a line point.end");
    settings.require_no_bounds(file);
    const double sign_y = settings["mirror.y"] != 0 ? -1 : 1, sign_z = settings["mirror.z"] != 0 ? -1 : 1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points.y[i] = sign_y * (points.y[i] + settings["shift.y"]) / settings["units.len.f"];
        points.z[i] = sign_z * (points.z[i] + settings["shift.z"]) / settings["units.len.f"];
    }
    return points;
}

inline bool ends_in(std::string_view text, std::string_view end) {
    return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Index of the first line of points in MiniProf's text: after the header's last line with `=` or `:` or "(Sd/Sh/qR)"
/// at its end, or after the first blank line, whichever is later; the header ends before four lines of points.
inline std::size_t first_point_of_miniprof(const TextFile& file) {
    std::size_t begin = 0, in_a_row = 0, blank = file.size();
    bool any = false, free = false;  // lines of text, and some that are neither points nor keys after the last key
    for (std::size_t i = 0; i < file.size() && in_a_row < 4; ++i) {
        const std::string_view line = trimmed(file.line(i)), content = file.content(i, "%#!\"");
        if (line.empty() && any && blank == file.size() && (in_a_row == 0 || free)) blank = i;
        any = any || !line.empty();
        const bool quality = ends_in(line, "(Sd/Sh/qR)");
        if (content.empty() && !quality) continue;
        const std::vector<std::string_view> cells = cells_of(content);
        if (!quality && cells.size() >= 2 && number_of(cells[0]) && number_of(cells[1])) {
            ++in_a_row;
            continue;
        }
        in_a_row = 0;
        free = !quality && line.find_first_of("=:") == std::string_view::npos;
        if (!free) begin = i + 1;
    }
    return blank < file.size() ? (std::max)(begin, blank + 1) : begin;
}

/// The points of MiniProf's .ban and .whl, with the header's offsets added.
inline CurvePoints read_miniprof(const TextFile& file) {
    CurvePoints points;
    std::array<double, 2> offset{0, 0};
    const std::size_t begin = first_point_of_miniprof(file);
    for (std::size_t i = 0; i < file.size(); ++i) {
        const std::string_view content = file.content(i, "%#!\"");
        if (content.empty()) continue;
        if (i >= begin) {
            const auto [y, z] = point_in(file, i, content);
            points.add((y + offset[0]) / 1000, (z + offset[1]) / 1000, i);
            continue;
        }
        const std::size_t equals = content.find('=');
        if (equals == std::string_view::npos) continue;
        const std::string key = lower_case(trimmed(content.substr(0, equals)));
        const auto value = number_of(trimmed(content.substr(equals + 1)));
        if (value && (key == "xoffset" || key == "yoffset")) offset[key == "yoffset"] = *value;
    }
    return points;
}

}  // namespace rollbem::detail
