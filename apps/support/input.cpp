#include "input.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <utility>

#include "csv.hpp"

namespace study {

std::string contents(const Options& options, const std::string& name) {
    const std::string path = options.text(name);
    std::ifstream file;
    errno = 0;
    if (path != "-") file.open(path, std::ios::binary);
    std::istream& from = path == "-" ? std::cin : file;
    std::ostringstream read;
    if (from.good() && from.peek() != std::istream::traits_type::eof()) read << from.rdbuf();
    options.require(from.good() || from.eof(), name,
                    std::string("be a file that can be read: ") + std::strerror(errno));
    const std::string text = read.str();
    return text.rfind("\xEF\xBB\xBF", 0) == 0 ? text.substr(3) : text;
}

std::string printable(std::string_view text) {
    std::string result;
    for (const char c : text) {
        char escape[8] = {c};
        const auto byte = static_cast<unsigned char>(c);
        if ((byte < 0x20 && c != '\t') || byte == 0x7F) std::snprintf(escape, sizeof escape, "\\x%02X", byte);
        result += escape;
    }
    return result;
}

bool Lines::next() {
    do {
        if (next_ >= file_.size()) return false;
        text_ = file_.content(next_++, "");
    } while (text_.empty() || text_[0] == '#' || (read_ == 0 && separator_.is_named_by(text_)));
    ++read_;
    const std::string shown = printable(text_);
    if (shown != text_) throw BadInput(where() + " = " + shown.substr(0, 80) + " must be text");
    return true;
}

Numbers read_edges(const Options& options, const std::string& name, double low, double high, const std::string& lowest,
                   const std::string& highest) {
    Lines lines(options, name);
    Numbers edges;
    while (lines.next()) {
        const std::string where = lines.where() + " = " + lines.text();
        const std::vector<std::string> cells = lines.cells();
        const std::optional<double> place = lines.number(cells[0]);
        if (!place || cells.size() > 1) throw BadInput(where + " must be a finite number");
        double edge = (*place - (low + high) / 2) / ((high - low) / 2);
        const double end = edges.empty() ? -1 : 1;
        if (std::abs(edge - end) < 1e-12) edge = end;
        if (edges.empty() && edge != -1) throw BadInput(where + " must be " + lowest);
        if (!edges.empty() && !(edge > edges.back() && edge <= 1)) {
            throw BadInput(where + " must be larger than the line before and at most " + highest);
        }
        edges.push_back(edge);
    }
    options.require(edges.size() >= 2 && edges.back() == 1, name, "end with " + highest);
    return edges;
}

namespace {

// A misspelt column that may be missing would pass for one that is not there.
void require_meant(const std::string& cell, const std::vector<std::string>& names, const std::string& where) {
    if (cell.empty() || contains(names, cell)) return;
    for (const std::string& name : names) {
        if (detail::edit_distance(cell, name) > (name.size() > 4 ? 2U : 1U)) continue;
        throw BadInput(where + " must not have a column " + cell + ", which is next to " + name + ": another name");
    }
}

}  // namespace

std::vector<Numbers> read_columns(
    const Options& options, const std::string& name, const std::string& names, const std::string& further,
    const std::function<void(const std::vector<Numbers>& columns, const std::string& where)>& check,
    const std::vector<std::string>& only) {
    std::string expected = names;
    std::vector<std::string> all = cells_of(names), groups;
    if (!further.empty()) groups = cells_of(further, ';');
    for (const std::string& group : groups) all = joined(std::move(all), cells_of(group));
    std::vector<Numbers> columns(all.size());
    std::size_t present = 0;                                  // columns of the file
    std::vector<std::pair<std::size_t, std::size_t>> places;  // a column that is read, and its place in a line
    Lines lines(options, name);
    while (lines.next()) {
        const std::string where = lines.where() + " = " + lines.text();
        const std::vector<std::string> cells = lines.cells();
        if (lines.is_first()) {
            const auto count = [&](const std::string& one) { return std::count(cells.begin(), cells.end(), one); };
            for (const std::string& group : groups) {
                const std::vector<std::string> own = cells_of(group);
                if (std::any_of(own.begin(), own.end(), count)) expected += "," + group;
            }
            for (const std::string& one : cells_of(expected)) {
                if (count(one) == 0) throw BadInput(where + " must be " + expected);
                if (count(one) > 1) throw BadInput(where + " must have one column " + one + " only");
                places.emplace_back(index_of(all, one), index_of(cells, one));
            }
            for (const std::string& cell : cells) {
                require_meant(cell, all, where);
                if (only.empty() || cell.empty() || contains(all, cell)) continue;
                throw BadInput(where + ": the column " + cell + " does not apply here; those that do are " +
                               listed(only, "and"));
            }
            present = cells.size();
            continue;
        }
        for (const auto& [column, place] : places) {
            const bool there = place < cells.size() && cells.size() <= present;
            const auto value = there ? lines.number(cells[place]) : std::nullopt;
            if (!value) {
                throw BadInput(where + " must have " + std::to_string(present) + " cells with " + lines.separator() +
                               " between them, finite numbers under " + expected);
            }
            columns[column].push_back(*value);
        }
        if (check) check(columns, where);
    }
    return columns;
}

void require_order(const Numbers& places, const std::string& name, const std::string& where) {
    const std::size_t last = places.size() - 1;
    if (last > 0 && places[last] < places[last - 1]) throw BadInput(where + " must not lie before the line above it");
    if (last > 1 && places[last] == places[last - 2]) {
        throw BadInput(where + " must not be the third row at one " + name + ": two make a jump");
    }
}

}  // namespace study
