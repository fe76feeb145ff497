// JoinedRows: the rows of a table that was computed in parts, read back to make a file of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "csv.hpp"
#include "input.hpp"
#include "options.hpp"

namespace study {

/// The rows of --rows: the parts of --shard, one after the other, each row at its place.
class JoinedRows {
public:
    /// The file should have `count` rows. Throws BadInput unless it has a header of these columns and ends with a whole
    /// line.
    JoinedRows(const Options& options, const std::vector<std::string>& columns, std::size_t count);

    /// The row that begins with `expected`; its other cells from there on are the result. Throws BadInput, which names
    /// the line, if it is another row, missing, or the last one and not the end.
    std::vector<std::string> cells(std::size_t row, const Row& expected) const;

    /// Throws BadInput with the line of a row.
    void require(bool holds, std::size_t row, const std::string& what) const {
        if (!holds) throw BadInput(places_[row] + ": " + what);
    }

    const std::vector<std::string>& lines() const { return lines_; }  ///< without the header

private:
    std::vector<std::string> columns_, lines_, places_;  ///< the last place is the end
    std::size_t count_;
};

}  // namespace study
