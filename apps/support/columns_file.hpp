// CSV files of numbers as input, e.g. a history of creepage, a pressure or an outline. Columns are found by their names
// in the first line that is not a comment; further columns are ignored, and a semicolon or tab may take the place of the comma. Every message
// names the option, the file and the line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "options.hpp"

namespace study {

using Numbers = std::vector<double>;

/// The columns `names` of the file that --name gives, separated by commas in `names`: finite numbers. Those of
/// `further` follow them if the file has all of these, and are empty if it has none. `check` is called after each line
/// with all columns and the line for messages. Throws BadInput.
std::vector<Numbers> read_columns(
    const Options& options, const std::string& name, const std::string& names, const std::string& further = "",
    const std::function<void(const std::vector<Numbers>& columns, const std::string& where)>& check = {});

/// Two columns of finite numbers, the first ascending (equal neighbours are allowed), and further ones.
struct Pairs {
    Numbers places, values;
    std::vector<Numbers> further{};
};

/// The same for two columns with at least one row; `place` is the rule for the first one. Throws BadInput.
Pairs read_pairs(const Options& options, const std::string& name, const std::string& names, const Rule& place,
                 const std::string& further = "");

}  // namespace study
