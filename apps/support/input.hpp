// Files that are read: line by line, cell by cell, and CSV files of numbers, e.g. a history of creepage, a pressure or
// an outline. Every message names the option, the file and the line. As a name, - is standard input.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "options.hpp"

namespace study {

/// All of the file that --name gives, without the byte-order mark of UTF-8. Throws BadInput.
std::string contents(const Options& options, const std::string& name);

/// The text for a message: control characters become \xNN.
std::string printable(std::string_view text);

using rollbem::detail::cells_of;
using rollbem::detail::number_of;

/// The lines of the file that --name gives, without blanks at their ends; empty lines and those that begin with # are
/// passed over. Throws BadInput if the file cannot be read or a line is not text.
class Lines {
public:
    Lines(const Options& options, const std::string& name) : Lines(options.said(name), contents(options, name)) {}
    /// The lines of a text that has been read, of a file that messages call by `said`.
    Lines(const std::string& said, std::string text)
        : ends_whole_(text.empty() || text.back() == '\n'), file_(said, std::move(text)) {}

    /// Goes to the next line, at first to the first one; false at the end.
    bool next();

    const std::string& text() const { return text_; }
    bool is_first() const { return read_ == 1; }     ///< the header of a table
    bool ends_whole() const { return ends_whole_; }  ///< with a line feed, or nowhere

    std::vector<std::string> cells() { return separator_.split(file_.line(next_ - 1)); }  ///< of the table's line
    std::optional<double> number(const std::string& cell) const { return separator_.number(cell); }
    std::string separator() const { return separator_.name(); }  ///< "a comma"

    /// "--name = file: line 3", counted from the top of the file, for messages.
    std::string where() const { return file_.path().string() + ": line " + std::to_string(next_); }

private:
    bool ends_whole_;
    rollbem::detail::TextFile file_;
    rollbem::detail::Separator separator_;
    std::string text_;
    std::size_t next_ = 0, read_ = 0;
};

using Numbers = std::vector<double>;

inline Eigen::ArrayXd array(const Numbers& numbers) {
    return Eigen::ArrayXd::Map(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// Ascending edges, one a line, from `low` to `high`, which messages call by these names; scaled to -1 ... 1. Throws
/// BadInput.
Numbers read_edges(const Options& options, const std::string& name, double low = -1, double high = 1,
                   const std::string& lowest = "-1, the trailing edge",
                   const std::string& highest = "1, the leading edge");

/// The columns `names` of the file that --name gives, separated by commas in `names`: finite numbers. They are found by
/// their names in the first line; further columns are ignored unless a letter or two make them one of these, and a
/// semicolon, a tab or blanks may take the place of the comma. Those of `further`, groups with a semicolon between
/// them, follow; the columns of a group are empty if the file has none of them. A named column other than these is
/// refused if `only` lists those that apply. `check` is called after each line with all columns and the line for
/// messages. Throws BadInput.
std::vector<Numbers> read_columns(
    const Options& options, const std::string& name, const std::string& names, const std::string& further = "",
    const std::function<void(const std::vector<Numbers>& columns, const std::string& where)>& check = {},
    const std::vector<std::string>& only = {});

/// Throws BadInput, which names the line `where`, unless the last of the places, which `name` calls, lies behind that
/// before it or is the second one there.
void require_order(const Numbers& places, const std::string& name, const std::string& where);

}  // namespace study
