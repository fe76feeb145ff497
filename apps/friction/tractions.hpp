// --tractions: a second table, with a row per element of every row of the study's table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "support/csv.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/table.hpp"

namespace friction {

struct Tractions {
    /// Opens the file if --tractions was given. Throws BadInput.
    Tractions(const study::Options& options, const std::vector<std::string>& names, std::size_t tasks, bool drawn)
        : columns(names), wanted(drawn || options.given("tractions")), rows(tasks) {
        if (!options.given("tractions")) return;
        const bool header = study::has_header(options);
        file = &files.open_table(options, "tractions", header ? study::csv_line({names.begin(), names.end()}) : "");
    }

    void write() {
        if (file == nullptr) return;
        for (const std::vector<study::Row>& of_task : rows) {
            for (const study::Row& row : of_task) file->write(study::csv_line(row));
        }
    }

    /// A cell as a number.
    std::optional<double> number(const study::Row& row, const char* column) const {
        return row[study::index_of(columns, column)].number();
    }

    std::vector<std::string> columns;
    bool wanted;                                ///< in a file or for a picture
    std::vector<std::vector<study::Row>> rows;  ///< of each task, which one thread computes
    study::OutputFiles files;                   ///< for those of the study's table, too
    study::OutputFile* file = nullptr;
};

}  // namespace friction
