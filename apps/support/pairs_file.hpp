// A CSV file with two columns of numbers as input, e.g. a history of creepage or a pressure along the contact.
// Every message names the option, the file and the line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "errors.hpp"
#include "files.hpp"
#include "options.hpp"

namespace study {

/// Two columns of finite numbers, the first ascending (equal neighbours are allowed).
struct Pairs {
    std::vector<double> places, values;
};

/// Reads the file that --name gives. `header` are the two columns that its first line must name, e.g.
/// "q_over_a,creepage"; further columns are ignored, and a semicolon or tab may take the place of the comma. `place` is
/// the rule for the first column. Throws BadInput.
inline Pairs read_pairs(const Options& options, const std::string& name, const std::string& header, const Rule& place) {
    Lines lines(options, name);
    const std::vector<std::string> names = cells_of(header, ',');
    Pairs pairs;
    char separator = ',';
    std::vector<std::string> columns;
    const auto column = [&](std::size_t k) {
        return static_cast<std::size_t>(std::find(columns.begin(), columns.end(), names[k]) - columns.begin());
    };
    while (lines.next()) {
        const std::string& text = lines.text();
        const std::string where = lines.where() + " = " + text;
        if (lines.number() == 1) {
            separator = separator_of(text);
            columns = cells_of(text, separator);
            const bool has_both = column(0) < columns.size() && column(1) < columns.size();
            if (!has_both) throw BadInput(where + " must be " + header);
            for (const std::string& one : names) {
                if (std::count(columns.begin(), columns.end(), one) > 1) {
                    throw BadInput(where + " must have one column " + one + " only");
                }
            }
            continue;
        }
        const std::vector<std::string> cells = cells_of(text, separator);
        const bool fits = cells.size() == columns.size();
        const auto x = fits ? number_of(cells[column(0)], separator) : std::nullopt;
        const auto y = fits ? number_of(cells[column(1)], separator) : std::nullopt;
        if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
            const std::string between = separator == ',' ? "a comma" : separator == ';' ? "a semicolon" : "a tab";
            throw BadInput(where + (columns.size() == 2
                                        ? " must be two finite numbers with " + between + " between them"
                                        : " must have " + std::to_string(columns.size()) + " cells with " + between +
                                              " between them, finite numbers under " + header));
        }
        if (!place.holds(*x)) throw BadInput(where + ": " + names[0] + " must " + place.text);
        if (!pairs.places.empty() && *x < pairs.places.back()) {
            throw BadInput(where + " must not lie before the line above it");
        }
        const std::size_t count = pairs.places.size();
        if (count > 1 && *x == pairs.places[count - 1] && *x == pairs.places[count - 2]) {
            throw BadInput(where + " must not be the third row at one " + names[0] + ": two make a jump");
        }
        pairs.places.push_back(*x);
        pairs.values.push_back(*y);
    }
    if (pairs.places.empty()) throw BadInput(options.said(name) + " must have at least one row below its header");
    return pairs;
}

}  // namespace study
