// A configuration file: options as NAME = VALUE, one a line, in what TOML and INI have in common and what of TOML
// options have a use for. A value is a text in "" (with TOML's escapes) or in '', a bare word or comma-separated words,
// or a list of such in [], which may go on over several lines. # and, at the start of a line, ; begin a comment. There
// are no sections but in the TOML file beside a CSV file, of which the options stand in the table [given].
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace study {

struct Setting {
    std::string name;
    std::vector<std::string> values;  ///< at least one
    std::string where;                ///< file, line and what stands there, for messages
    std::string section{};            ///< empty above the first
};

/// Whether the contents are those of a file beside a CSV file: they have the table [given].
bool is_sidecar(std::string_view text);

/// Reads the contents of a file, which `said` names in messages. Throws BadInput for whatever is malformed, for a name
/// that comes twice in a section, and for sections where is_sidecar is not true.
std::vector<Setting> read_settings(std::string_view text, const std::string& said);

}  // namespace study
