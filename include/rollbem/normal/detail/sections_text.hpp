// The text of .slcs and .slcw: the places of sections, their files and features.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "../../detail/require.hpp"
#include "../surface.hpp"
#include "profile_text.hpp"

namespace rollbem::detail {

/// A section in the terms of its file.
struct SectionLine {
    double u;  ///< [m] or [rad]
    std::filesystem::path profile;
    std::size_t line;
    std::vector<double> features;  ///< [m], from the section's first point
};

struct SectionsText {
    std::vector<SectionLine> sections;
    Sections::Interpolation interpolation;
};

/// Reads a text from start to end; missing or unsupported content throws std::invalid_argument with the line.
class SectionsReader {
public:
    /// u is divided by `per_unit`: 1000 for mm along the track, 1 for rad round the wheel.
    static SectionsText read(const TextFile& file, double per_unit) { return SectionsReader(file).all(per_unit); }

private:
    explicit SectionsReader(const TextFile& file) : file_(file) {}

    SectionsText all(double per_unit) {
        const std::vector<double> place = numbers("offset and scale of u are expected", 2);
        const double count = numbers("the number of sections is expected", 1)[0];
        if (!(count >= 2 && count == std::floor(count))) refuse("at least 2 sections are expected");
        const std::vector<double> parts = numbers("the number of features is expected", 1);
        const double features = parts[0];
        if (!(features >= 0 && features == std::floor(features))) refuse("the number of features is expected");
        for (std::size_t k = 1; k < parts.size() && features > 1; ++k) {
            if (parts[k] != 0) refuse("no kinks and no accelerations are expected: these are not supported");
        }
        const std::vector<double> how = numbers("the interpolation is expected, 1 or 2", 1);
        if (how[0] != 1 && how[0] != 2) refuse("the interpolation is expected, 1 (through sections) or 2 (B-spline)");
        if (how.size() > 1) refuse("one number is expected: files with perturbations are not supported");

        SectionsText text{{}, how[0] == 1 ? Sections::Interpolation::through : Sections::Interpolation::spline};
        std::vector<double> read_u;
        for (double k = 0; k < count; ++k) {
            text.sections.push_back(section_line());
            SectionLine& section = text.sections.back();
            read_u.push_back(section.u);
            section.u = (section.u + place[0]) * place[1] / per_unit;
            if (k > 0 && !(section.u > text.sections[text.sections.size() - 2].u)) {
                refuse("u is expected to increase from section to section");
            }
        }
        for (std::size_t k = 0; k < read_u.size() && features > 1; ++k) {
            text.sections[k].features = features_at(read_u[k], features);
        }
        if (next()) refuse("the end of the file is expected after its sections and features");
        return text;
    }

    [[noreturn]] void refuse(const std::string& expected) const { file_.refuse(line_ - 1, expected); }

    // Goes to the next line with content; false at the end of the file.
    bool next() {
        while (line_ < file_.size()) {
            if (!file_.content(line_++, "%!#\"").empty()) return true;
            if (trimmed(file_.line(line_ - 1)).find('"') != std::string_view::npos &&
                trimmed(file_.line(line_ - 1)).find_first_of("%!#") != 0) {
                return true;
            }
        }
        return false;
    }
    void go_on(const std::string& expected) {
        if (!next()) file_.refuse(expected + ", and the file has ended");
    }

    // The numbers at the beginning of a line, separated by blanks or commas.
    static std::vector<double> leading_numbers(std::string_view content) {
        std::vector<double> numbers;
        std::string text(content);
        std::replace(text.begin(), text.end(), ',', ' ');
        for (const std::string& cell : cells_of(text, ' ')) {
            const auto value = number_of(cell);
            if (!value) break;
            numbers.push_back(*value);
        }
        return numbers;
    }

    std::vector<double> numbers(const std::string& expected, std::size_t least) {
        go_on(expected);
        const std::vector<double> found = leading_numbers(file_.content(line_ - 1));
        if (found.size() < least) refuse(expected);
        return found;
    }

    SectionLine section_line() {
        const std::string expected = "u of a section and the name of its file in quotes are expected";
        go_on(expected);
        const std::string_view line = trimmed(file_.line(line_ - 1));
        const std::size_t open = line.find_first_of("'\"");
        const std::size_t close = open == std::string_view::npos ? open : line.find(line[open], open + 1);
        const std::vector<double> u = leading_numbers(line.substr(0, open));
        if (close == std::string_view::npos || close == open + 1 || u.size() != 1) refuse(expected);
        std::string name(line.substr(open + 1, close - open - 1));
        std::replace(name.begin(), name.end(), '\\', '/');
        return {u[0], file_.path().parent_path() / name, line_ - 1, {}};
    }

    std::vector<double> features_at(double u, double count) {
        const std::string expected = "u of a section and " + std::to_string(static_cast<std::size_t>(count)) +
                                     " lengths of features are expected";
        std::vector<double> found = numbers(expected, 1);
        while (static_cast<double>(found.size()) < count + 1) {
            const std::vector<double> more = numbers(expected, 1);  // the numbers continue on the next line
            found.insert(found.end(), more.begin(), more.end());
        }
        if (static_cast<double>(found.size()) > count + 1) refuse(expected);
        if (std::abs(found[0] - u) > 1e-6 * (1 + std::abs(u))) {
            refuse("features are expected in the order of the sections; u = " + to_text(u) + " is the next");
        }
        found.erase(found.begin());
        for (double& feature : found) feature = feature < 0 ? -1 : feature / 1000;
        return found;
    }

    const TextFile& file_;
    std::size_t line_ = 0;  // number of lines read
};

}  // namespace rollbem::detail
