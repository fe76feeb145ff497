// Points in text files with profiles: two columns, SIMPACK's and MiniProf's text.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "../../detail/text_table.hpp"

namespace rollbem::detail {

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
    "y and z are expected, two numbers separated by a semicolon or a tab, or with decimal points by a comma or blanks";

/// y and z in the cells with these numbers of the line up to a comment. Throws std::invalid_argument if the cells are
/// not numbers.
inline std::array<double, 2> point_in(const TextFile& file, std::size_t line, Separator& separator,
                                      const std::array<std::size_t, 2>& places = {0, 1},
                                      const char* comment_signs = "%#!") {
    const std::vector<std::string> cells = separator.split(file.uncommented(line, comment_signs));
    std::array<double, 2> point;
    for (std::size_t k = 0; k < 2; ++k) {
        const auto value = places[k] < cells.size() ? separator.number(cells[places[k]]) : std::nullopt;
        if (!value) file.refuse(line, two_numbers_expected);
        point[k] = *value;
    }
    return point;
}

/// The numbers of the columns named y and z: "y", "Y [mm]", "'z'".
inline std::array<std::size_t, 2> places_in_header(const TextFile& file, std::size_t line,
                                                   const std::vector<std::string>& cells) {
    std::array<std::optional<std::size_t>, 2> found;
    std::size_t place = 0;
    for (const std::string& cell : cells) {
        std::string name = lower_case(cell.substr(0, cell.find_first_of("[(")));
        std::erase_if(name, [](char c) { return c == '\'' || c == ' '; });
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
    Separator separator;
    std::optional<std::array<std::size_t, 2>> places;
    for (std::size_t i = 0; i < file.size(); ++i) {
        if (file.content(i).empty() || (!places && separator.is_named_by(file.content(i)))) continue;
        if (!places) {
            places.emplace(std::array<std::size_t, 2>{0, 1});
            const std::vector<std::string> cells = separator.split(file.uncommented(i));
            if (!cells[0].empty() && cells[0].find_first_of("+-.0123456789") != 0) {
                places = places_in_header(file, i, cells);
                continue;
            }
        }
        const auto [y, z] = point_in(file, i, separator, *places);
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
        const auto value = number_of(Separator().split(text).front());
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
    Separator separator;
    bool inside = false, ended = false;
    for (std::size_t i = 0; i < file.size() && !ended; ++i) {
        const std::string_view content = file.content(i);
        if (content.empty()) continue;
        const std::size_t equals = content.find('=');
        if (content == "point.begin" || content == "point.end") {
            ended = inside;
            inside = content == "point.begin" && !ended;
        } else if (inside) {
            const auto [y, z] = point_in(file, i, separator);
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
        Separator separator;
        const std::vector<std::string> cells = separator.split(content);
        if (!quality && cells.size() >= 2 && separator.number(cells[0]) && separator.number(cells[1])) {
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
    Separator separator;
    const std::size_t begin = first_point_of_miniprof(file);
    for (std::size_t i = 0; i < file.size(); ++i) {
        const std::string_view content = file.content(i, "%#!\"");
        if (content.empty()) continue;
        if (i >= begin) {
            const auto [y, z] = point_in(file, i, separator, {0, 1}, "%#!\"");
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
