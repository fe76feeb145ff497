#include "joined_rows.hpp"

#include <algorithm>
#include <cmath>

namespace study {

JoinedRows::JoinedRows(const Options& options, const std::vector<std::string>& columns, std::size_t count)
    : columns_(columns), count_(count) {
    const std::string header = join(columns, ",");
    Lines read(options, "rows");
    while (read.next()) {
        if (read.is_first()) {
            if (read.text() != header) throw BadInput(read.where() + " must be " + header);
            continue;
        }
        lines_.push_back(read.text());
        places_.push_back(read.where());
    }
    if (!read.ends_whole()) {
        throw BadInput(read.where() + " must end with a line feed: is the last part complete?");
    }
    places_.push_back(read.where());
}

std::vector<std::string> JoinedRows::cells(std::size_t row, const Row& expected) const {
    if (row >= lines_.size()) {
        throw BadInput(places_.back() + ": the end, after " + std::to_string(lines_.size()) + " of " +
                       std::to_string(count_) + " rows, must be the end of the last part of --shard");
    }
    std::vector<std::string> cells = cells_of(lines_[row]);
    if (cells.size() != columns_.size()) cells.assign(columns_.size(), "");
    for (std::size_t k = 0; k < expected.size(); ++k) {
        const std::optional<double> number = expected[k].number(), found = number_of(cells[k]);
        const bool same =
            number ? found && std::abs(*found - *number) <= 1e-9 * std::abs(*number) : cells[k] == expected[k].text();
        require(same, row,
                columns_[k] + " = " + cells[k] + " must be " + expected[k].text(12) +
                    ", as the options of the grid want it: are all parts there, in order and once?");
    }
    require(row + 1 < count_ || lines_.size() <= count_, std::min(row + 1, lines_.size()),
            "must be the end, after all " + std::to_string(count_) + " rows: is a part there twice?");
    cells.erase(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(expected.size()));
    return cells;
}

}  // namespace study
