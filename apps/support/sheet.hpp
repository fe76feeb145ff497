// Sheet: the columns of a study. Each is a name, its meaning for --help, and a value of what was computed, so that header,
// help and cells cannot differ. Columns of the scene stand before and behind them.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "csv.hpp"
#include "files.hpp"
#include "plot.hpp"
#include "scenes.hpp"
#include "table.hpp"

namespace study {

template <class Result>
struct Column {
    std::string name, meaning;
    std::function<Cell(const Result&)> value{};  ///< without, it is the scene's column of that name
};

/// The cells of a case, found by its namespace.
template <class Case>
Row cells_of_case(const Case& one, const std::vector<std::string>& names) {
    Row row;
    for (const std::string& name : names) row.push_back(scene_cell(one, name));
    return row;
}

/// What takes the results of a scene, one by one.
template <class Result>
using Results = std::function<void(const Result&)>;

/// "name  meaning" as a line of --help, wrapped.
std::string help_line(const std::string& name, const std::string& meaning);

/// Case has label() and scene_cell(case, name).
template <class Result, class Case = Scene>
class Sheet {
public:
    /// `before` and `behind` are names of columns of the scene, separated by commas; so is the name of an own column
    /// without a value.
    Sheet(const std::string& before, const std::vector<Column<Result>>& own, const std::string& behind)
        : before_(names_of(before)), behind_(names_of(behind)) {
        for (const Column<Result>& column : own) {
            for (const std::string& name : names_of(column.name)) own_.push_back({name, column.meaning, column.value});
        }
    }

    std::vector<std::string> names() const {
        std::vector<std::string> result = before_;
        for (const Column<Result>& column : own_) result.push_back(column.name);
        return joined(result, behind_);
    }

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
        Row row = cells_of_case(scene, before_);
        for (const Column<Result>& column : own_) {
            row.push_back(column.value ? column.value(result) : scene_cell(scene, column.name));
        }
        return joined(std::move(row), cells_of_case(scene, behind_));
    }

    /// A table with as many rows for each scene as rows(scene) says; compute(scene, range, emit) emits their results.
    template <class Count, class Compute>
    Table table(const std::vector<Case>& scenes, const Count& rows, const Compute& compute) const {
        Table table = table_of(names(), scenes);
        for (std::size_t i = 0; i < scenes.size(); ++i) table.rows_of_task[i] = std::size_t(rows(scenes[i]));
        table.compute = [=, this, &scenes](std::size_t task, RowRange range, const Emit& emit) {
            const Case& scene = scenes[task];
            compute(scene, range, Results<Result>([&](const Result& result) { emit(row(scene, result)); }));
        };
        return table;
    }

    /// A table with one row for each scene, of compute(scene).
    template <class Compute>
    Table table(const std::vector<Case>& scenes, const Compute& compute) const {
        return table(
            scenes, [](const Case&) { return 1; },
            [=](const Case& scene, RowRange, const Results<Result>& emit) { emit(compute(scene)); });
    }

    /// Adds the column `y` over the column `x`, a curve for each combination of the scene's columns but `x` and those of
    /// `without`.
    void draw(Plot& plot, const std::vector<Row>& rows, const std::string& x, const std::string& y,
              const std::vector<std::string>& without = {}, bool absolute = false) const {
        std::vector<std::string> by;
        for (const std::string& name : before_) {
            if (name != x && index_of(without, name) == without.size()) by.push_back(name);
        }
        add_series(plot, names(), rows, {.by = by, .x = x, .y = y, .absolute = absolute, .apart = behind_});
    }

private:
    static std::vector<std::string> names_of(const std::string& text) {
        return text.empty() ? std::vector<std::string>{} : cells_of(text);
    }

    std::vector<std::string> before_;
    std::vector<Column<Result>> own_;
    std::vector<std::string> behind_;
};

/// The columns that identify a scene behind the others.
inline constexpr const char* settings = "kernel,aspect,poisson,size_ratio,epsilon,quadrature,nodes";

/// Whichever of n, alpha_T, alpha_L and lambda the scenes vary most, for the x axis of a picture.
struct Axis {
    std::string column, label;
    std::vector<std::string> same{};  ///< columns that follow it

    bool is_n() const { return column == "n"; }
};
Axis most_varied(const std::vector<Scene>& scenes);

}  // namespace study
