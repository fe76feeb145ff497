// A configuration file: options as NAME = VALUE, one on each line, in the common part of TOML and INI and the part of
// TOML that options need. A value is a text in "" (with TOML's escapes) or in '', a bare word or comma-separated words,
// or a list of these in [], which may span several lines. # and, at the start of a line, ; begin a comment. Only the
// TOML file beside a CSV file has sections; its options are in the table [given].
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

/// Whether these are the contents of a file beside a CSV file: only that has the table [given].
bool is_sidecar(std::string_view text);

/// Reads the contents of a file, which `said` names in messages. Throws BadInput if something is malformed, if a
/// section has a name twice, and if there are sections although is_sidecar is false.
std::vector<Setting> read_settings(std::string_view text, const std::string& said);

}  // namespace study
