#include "terminal_table.hpp"

#include <algorithm>
#include <utility>

namespace study {

namespace {

/// The first of the names; the number of names if there is none.
std::size_t place_of_name(const std::vector<Heading>& headings, const std::string& name) {
    const auto found = std::find_if(headings.begin(), headings.end(), [&](const Heading& h) { return h.name == name; });
    return static_cast<std::size_t>(found - headings.begin());
}

/// A unit for people, and its number of base units.
std::pair<std::string, double> handy(const std::string& unit) {
    if (unit == "[m]") return {"mm", 1e-3};
    if (unit == "[m^2]") return {"mm^2", 1e-6};
    if (unit == "[Pa]") return {"MPa", 1e6};
    return {unit.size() > 2 ? unit.substr(1, unit.size() - 2) : "", 1};
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " more " + what + (count == 1 ? "" : "s");
}

bool is_time(const Heading& heading) { return heading.name.ends_with("_us"); }

constexpr int digits = 6;

/// Texts wider than this give way to results.
constexpr std::size_t wide_text = 40;

/// The results that a reader needs first.
bool is_judgement(const Heading& heading) { return heading.name == "status" || heading.name == "verdict"; }

}  // namespace

Heading heading_of(const std::string& text) {
    const std::size_t unit = text.find(" [");
    return {text.substr(0, unit), unit == std::string::npos ? "" : text.substr(unit + 1)};
}

std::string unit_in(const std::string& meaning) {
    const std::size_t open = meaning.find('['), close = meaning.find(']', open);
    if (open == std::string::npos || close == std::string::npos) return "";
    const std::string unit = meaning.substr(open, close + 1 - open);
    return unit == "[microseconds]" ? "" : unit;
}

void TerminalTable::add(const Row& row) {
    std::vector<std::string> texts;
    for (const Cell& cell : row) texts.push_back(cell.text());
    if (count_++ == 0) first_ = texts;
    const std::size_t scheme = place_of_name(headings_, "scheme");
    const auto& first_of_scheme =
        first_of_scheme_.try_emplace(scheme < texts.size() ? texts[scheme] : "", texts).first->second;
    for (std::size_t i = 0; i < headings_.size(); ++i) {
        varied_[i] |= texts[i] != first_[i];
        filled_[i] |= !texts[i].empty();
        beyond_scheme_[i] |= texts[i] != first_of_scheme[i];
    }
    if (rows_.size() < most_rows) rows_.push_back(row);
}

bool TerminalTable::is_shown(std::size_t column) const {
    const Heading& heading = headings_[column];
    if (!heading.of_case) return filled_[column];
    if (heading.name == "scheme") return by_scheme_ && varied_[column];
    return varied_[column] && (!by_scheme_ || beyond_scheme_[column]);
}

std::vector<std::size_t> TerminalTable::shown(std::size_t width) const {
    std::vector<std::size_t> columns, droppable;  // times first, then results from the right
    std::size_t used = 0;
    std::vector<std::size_t> widths(headings_.size());
    for (std::size_t i = 0; i < headings_.size(); ++i) {
        if (!is_shown(i)) continue;
        columns.push_back(i);
        used += (widths[i] = std::min(lines_of(i).front().size(), wide_text) + 2);
        if (!headings_[i].of_case && !is_judgement(headings_[i])) droppable.insert(droppable.begin(), i);
    }
    std::stable_partition(droppable.begin(), droppable.end(), [&](std::size_t i) { return is_time(headings_[i]); });
    for (std::size_t k = 0; k + 1 < droppable.size() && used > width + 2; ++k) {
        used -= widths[droppable[k]];
        std::erase(columns, droppable[k]);
    }
    return columns;
}

/// The column's name, its unit, and its cells, filled up with blanks to one width; numbers have their points below one
/// another, and texts wider than `widest` end with dots.
std::vector<std::string> TerminalTable::lines_of(std::size_t column, std::size_t widest) const {
    std::vector<std::string> lines{headings_[column].name, headings_[column].unit};
    std::size_t before = 0, behind = 0;
    const auto point = [](const std::string& text) { return std::min(text.find_first_of(".e"), text.size()); };
    for (const Row& row : rows_) {
        if (!row[column].number()) continue;
        const std::string text = row[column].text(digits);
        before = std::max(before, point(text));
        behind = std::max(behind, text.size() - point(text));
    }
    for (const Row& row : rows_) {
        std::string text = row[column].text(digits);
        if (row[column].number()) {
            text.append(behind - (text.size() - point(text)), ' ');
        } else if (text.size() > widest) {
            text.replace(widest - 3, std::string::npos, "...");
        }
        lines.push_back(std::move(text));
    }
    std::size_t width = 0;
    for (const std::string& line : lines) width = std::max(width, line.size());
    for (std::string& line : lines) line.insert(before > 0 ? 0 : line.size(), width - line.size(), ' ');
    return lines;
}

std::string TerminalTable::rest(std::size_t columns) const {
    std::string text;
    if (count_ > rows_.size()) text = counted(count_ - rows_.size(), "row");
    if (columns < headings_.size()) {
        text += (text.empty() ? "" : ", ") + counted(headings_.size() - columns, "column");
    }
    return text.empty() ? "" : text + " in CSV: --output FILE\n";
}

std::string TerminalTable::text(std::size_t width) const {
    const std::vector<std::size_t> columns = shown(width);
    std::vector<std::string> lines(rows_.size() + 2);
    std::size_t used = 0, most = 0;
    for (const std::size_t column : columns) {
        const std::size_t wide = lines_of(column).front().size();
        used += wide + (used > 0 ? 2 : 0);
        most = std::max(most, wide);
    }
    const std::size_t widest = used > width && most > used - width + 8 ? most - (used - width) : most;
    bool has_units = false;
    for (const std::size_t column : columns) {
        has_units = has_units || !headings_[column].unit.empty();
        const std::vector<std::string> cells = lines_of(column, widest);
        for (std::size_t k = 0; k < lines.size(); ++k) lines[k] += (lines[k].empty() ? "" : "  ") + cells[k];
    }
    std::string text;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (k != 1 || has_units) text += lines[k].substr(0, lines[k].find_last_not_of(' ') + 1) + '\n';
    }
    return text + rest(columns.size());
}

std::string TerminalTable::quantity(const Row& row, std::size_t column) const {
    const auto [unit, size] = handy(headings_[column].unit);
    const auto number = row[column].number();
    return (number ? Cell(*number / size) : row[column]).text(digits) + (unit.empty() ? "" : " " + unit);
}

std::string TerminalTable::text(const Blocks& blocks) const {
    std::size_t width = 0;
    for (const std::string& name : blocks.lines) width = std::max(width, name.size());
    std::string text;
    for (const Row& row : rows_) {
        std::string title;
        for (const std::string& name : blocks.title) {
            const std::size_t column = place_of_name(headings_, name);
            if (column == headings_.size() || row[column].text().empty()) continue;
            title += (title.empty() ? "" : ", ") + name + " " + quantity(row, column);
        }
        text += title + '\n';
        for (const std::string& name : blocks.lines) {
            const std::size_t column = place_of_name(headings_, name);
            if (column == headings_.size() || row[column].text().empty()) continue;
            text += "  " + name + std::string(width + 2 - name.size(), ' ') + quantity(row, column) + '\n';
        }
    }
    std::size_t columns = 0;
    for (const auto* names : {&blocks.title, &blocks.lines}) {
        for (const std::string& name : *names) columns += place_of_name(headings_, name) < headings_.size() ? 1 : 0;
    }
    return text + rest(columns);
}

}  // namespace study
