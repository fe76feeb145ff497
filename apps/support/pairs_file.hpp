// A CSV file with two columns of numbers as input, e.g. a history of creepage or a pressure along the contact.
// Every complaint names the option, the file and the line.
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

/// Reads the file that --name gives. `header` is its first line, e.g. "q_over_a,creepage". `place` says what the first
/// column must fulfil. Throws BadInput.
inline Pairs read_pairs(const Options& options, const std::string& name, const std::string& header, const Rule& place) {
    Lines lines(options, name);
    Pairs pairs;
    while (lines.next()) {
        const std::string& text = lines.text();
        const std::string where = lines.where() + " = " + text;
        if (lines.number() == 1) {
            if (text != header) throw BadInput(where + " must be " + header);
            continue;
        }
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto x = detail::parse_number<double>(detail::trim(text.substr(0, comma)));
        const auto y = detail::parse_number<double>(detail::trim(text.substr(std::min(comma + 1, text.size()))));
        if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) {
            throw BadInput(where + " must be two finite numbers with a comma between them");
        }
        if (!place.holds(*x)) throw BadInput(where + ": " + header.substr(0, header.find(',')) + " must " + place.text);
        if (!pairs.places.empty() && *x < pairs.places.back()) {
            throw BadInput(where + " must not lie before the line above it");
        }
        pairs.places.push_back(*x);
        pairs.values.push_back(*y);
    }
    if (pairs.places.empty()) throw BadInput(options.said(name) + " must have at least one row below its header");
    return pairs;
}

}  // namespace study
