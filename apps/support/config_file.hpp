// Configuration files: lines NAME = VALUE, and NAME alone for a flag.
#pragma once

#include <string>
#include <vector>

#include "input.hpp"

namespace study {

/// A line of a configuration file. A value is one text, several between blanks, or a list [A, B] that may go on over
/// lines; texts may stand in quotes.
struct Setting {
    std::string name, where;          ///< `where` as Lines::where
    std::vector<std::string> values;  ///< none after a name alone
};

/// Throws BadInput, which names the line, if a list is not closed, or a value or an item of a list is missing.
std::vector<Setting> read_settings(Lines lines);

}  // namespace study
