// Sheet: the columns of a study. Each is a name, its meaning for --help, and a value of what was computed, so that
// header, help and cells cannot differ. Columns of the case, such as a Scene, stand before and behind them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "csv.hpp"
#include "plot.hpp"
#include "scenes.hpp"
#include "table.hpp"

namespace study {

template <class Result>
struct Column {
    std::string name, meaning;                   ///< an empty meaning is that of the column before
    std::function<Cell(const Result&)> value{};  ///< without, it is the case's column of that name
};

/// The value of a column where the condition holds; either is a member or a function of the result.
template <class Condition, class Value>
auto where(const Condition& condition, const Value& value) {
    return [=](const auto& r) { return std::invoke(condition, r) ? Cell(std::invoke(value, r)) : Cell(); };
}

/// The function that takes the results of a case, one by one.
template <class Result>
using Results = std::function<void(const Result&)>;

/// "name  meaning" as a line of --help, wrapped.
inline std::string help_line(const std::string& name, const std::string& meaning) {
    constexpr std::size_t indent = 20;
    const std::string margin(indent, ' ');
    std::string start = "  " + name, text;
    if (start.size() >= indent) start += '\n' + margin;
    start.resize(std::max(start.size(), indent), ' ');
    for (const char c : wrap(meaning, 110 - indent)) text += c == '\n' ? '\n' + margin : std::string{c};
    return start + text + '\n';
}

/// The columns of a Case, if it has any, are scene_cell(case, name), found in its namespace.
template <class Result, class Case = Scene>
class Sheet {
public:
    /// `before` and `behind` are names of columns of the case, separated by commas, "NAME [UNIT]" where they have
    /// units; the name of an own column without a value is one, too.
    Sheet(const std::string& before, const std::vector<Column<Result>>& own, const std::string& behind)
        : before_(headings_of(before)), behind_(headings_of(behind)) {
        for (const Column<Result>& column : own) {
            for (const std::string& name : columns_of(column.name)) {
                const bool shared = column.meaning.empty() && !own_.empty();
                own_.push_back({name, shared ? own_.back().meaning : column.meaning, column.value});
            }
        }
    }

    std::vector<Heading> headings() const {
        std::vector<Heading> result = before_;
        for (const Column<Result>& column : own_) {
            result.push_back({column.name, unit_in(column.meaning), column.value == nullptr});
        }
        return joined(result, behind_);
    }

    std::vector<std::string> names() const { return names_of(headings()); }

    /// The own columns for --help.
    std::string help() const {
        std::string text;
        for (std::size_t i = 0; i < own_.size(); ++i) {  // columns that share a meaning stand together
            std::string names = own_[i].name;
            while (i + 1 < own_.size() && own_[i + 1].meaning == own_[i].meaning) names += ", " + own_[++i].name;
            text += help_line(names, own_[i].meaning);
        }
        return text;
    }

    Row row(const Case& scene, const Result& result) const {
        Row row;
        const auto add = [&](const std::string& name) {
            if constexpr (requires { scene_cell(scene, name); }) {
                row.push_back(scene_cell(scene, name));
            } else {
                throw std::logic_error("no cell of a scene for the column " + name);
            }
        };
        for (const Heading& column : before_) add(column.name);
        for (const Column<Result>& column : own_) {
            column.value ? row.push_back(column.value(result)) : add(column.name);
        }
        for (const Heading& column : behind_) add(column.name);
        return row;
    }

    /// A table with `rows` rows for each case, whose computation is still to be set.
    Table frame(const std::vector<Case>& cases, std::size_t rows = 1) const {
        Table table = table_of(names(), cases, rows);
        table.headings = headings();
        return table;
    }

    /// A table with as many rows for each case as rows(case) says; compute(case, range, emit) emits their results.
    template <class Count, class Compute>
    Table table(const std::vector<Case>& cases, const Count& rows, const Compute& compute) const {
        Table table = frame(cases);
        for (std::size_t i = 0; i < cases.size(); ++i) table.rows_of_task[i] = std::size_t(rows(cases[i]));
        table.compute = [=, this, &cases](std::size_t task, RowRange range, const Emit& emit) {
            compute(cases[task], range, Results<Result>([&](const Result& result) { emit(row(cases[task], result)); }));
        };
        return table;
    }

    /// A table with one row for each case, of compute(case).
    template <class Compute>
    Table table(const std::vector<Case>& cases, const Compute& compute) const {
        return table(
            cases, [](const Case&) { return 1; },
            [=](const Case& scene, RowRange, const Results<Result>& emit) { emit(compute(scene)); });
    }

    /// Adds the column y over the column x, a curve for each combination of the columns of the case, and of `by`, but
    /// not of x and `without`.
    void draw(Plot& plot, const Records& records, Selection selection,
              const std::vector<std::string>& without = {}) const {
        std::vector<std::string> by = names_of(before_);
        for (const Column<Result>& column : own_) {
            if (!column.value) by.push_back(column.name);
        }
        selection.by = joined(joined(std::move(by), selection.by), names_of(behind_));
        // the columns of a scheme say what its name says
        std::erase_if(selection.by, [&](const auto& name) {
            return name == selection.x || name == "scheme" || contains(without, name);
        });
        add_series(plot, records, selection);
    }

private:
    /// The columns of a case in a text that commas separate.
    static std::vector<Heading> headings_of(const std::string& text) {
        std::vector<Heading> result;
        for (const std::string& column : columns_of(text)) {
            result.push_back(heading_of(column));
            result.back().of_case = true;
        }
        return result;
    }
    static std::vector<std::string> names_of(const std::vector<Heading>& headings) {
        std::vector<std::string> names;
        for (const Heading& heading : headings) names.push_back(heading.name);
        return names;
    }

    std::vector<Heading> before_;
    std::vector<Column<Result>> own_;
    std::vector<Heading> behind_;
};

}  // namespace study
