#include "columns_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "errors.hpp"
#include "files.hpp"

namespace study {

std::vector<Numbers> read_columns(
    const Options& options, const std::string& name, const std::string& names, const std::string& further,
    const std::function<void(const std::vector<Numbers>& columns, const std::string& where)>& check) {
    Lines lines(options, name);
    const std::vector<std::string> needed = cells_of(names, ',');
    const std::vector<std::string> more = further.empty() ? std::vector<std::string>{} : cells_of(further, ',');
    std::vector<Numbers> columns(needed.size() + more.size());
    std::vector<std::string> present;
    std::vector<std::size_t> places;  // in a line, of each column that is read
    char separator = ',';
    const auto read_header = [&](const std::string& where) {
        separator = separator_of(lines.text());
        present = cells_of(lines.text(), separator);
        const auto count = [&](const std::string& one) { return std::count(present.begin(), present.end(), one); };
        std::vector<std::string> read = needed;
        if (std::any_of(needed.begin(), needed.end(), [&](const auto& one) { return count(one) == 0; })) {
            throw BadInput(where + " must be " + names);
        }
        if (std::any_of(more.begin(), more.end(), [&](const auto& one) { return count(one) > 0; })) {
            if (std::any_of(more.begin(), more.end(), [&](const auto& one) { return count(one) == 0; })) {
                throw BadInput(where + " must be " + names + " or " + names + "," + further);
            }
            read.insert(read.end(), more.begin(), more.end());
        }
        for (const std::string& one : read) {
            if (count(one) > 1) throw BadInput(where + " must have one column " + one + " only");
            places.push_back(std::size_t(std::find(present.begin(), present.end(), one) - present.begin()));
        }
    };
    while (lines.next()) {
        const std::string where = lines.where() + " = " + lines.text();
        if (lines.is_first()) {
            read_header(where);
            continue;
        }
        const std::vector<std::string> cells = cells_of(lines.text(), separator);
        for (std::size_t k = 0; k < places.size(); ++k) {
            const auto value = cells.size() == present.size() ? number_of(cells[places[k]], separator) : std::nullopt;
            if (!value || !std::isfinite(*value)) {
                const std::string between = separator == ',' ? "a comma" : separator == ';' ? "a semicolon" : "a tab";
                throw BadInput(where + (present.size() == 2
                                            ? " must be two finite numbers with " + between + " between them"
                                            : " must have " + std::to_string(present.size()) + " cells with " +
                                                  between + " between them, finite numbers under " + names));
            }
            columns[k].push_back(*value);
        }
        if (check) check(columns, where);
    }
    return columns;
}

Pairs read_pairs(const Options& options, const std::string& name, const std::string& names, const Rule& place,
                 const std::string& further) {
    const std::string first = names.substr(0, names.find(','));
    std::vector<Numbers> columns =
        read_columns(options, name, names, further, [&](const auto& read, const auto& where) {
            const Numbers& places = read[0];
            const std::size_t last = places.size() - 1;
            if (!place.holds(places[last])) throw BadInput(where + ": " + first + " must " + place.text);
            if (last > 0 && places[last] < places[last - 1]) {
                throw BadInput(where + " must not lie before the line above it");
            }
            if (last > 1 && places[last] == places[last - 2]) {
                throw BadInput(where + " must not be the third row at one " + first + ": two make a jump");
            }
        });
    if (columns[0].empty()) throw BadInput(options.said(name) + " must have at least one row below its header");
    return {std::move(columns[0]), std::move(columns[1]), {columns.begin() + 2, columns.end()}};
}

}  // namespace study
