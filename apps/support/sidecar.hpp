// TOML: the file beside a table, which says how it was made, and configuration files. The former is one of the latter,
// with its options in the table [given].
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace study {

/// An option of a configuration file.
struct Setting {
    std::string name;
    std::vector<std::string> values;  ///< at least one
    std::string where;                ///< file, line and what stands there, for messages
};

struct Config {
    std::vector<Setting> settings{};
    bool is_sidecar = false;  ///< it stands beside a table
    std::string program{};    ///< that wrote the sidecar
};

/// Reads the contents of a file, which `said` names in messages. Throws BadInput if they are malformed.
Config read_config(const std::string& text, const std::string& said);

/// The file beside a table of this run.
std::string sidecar_text(const Options& options);

}  // namespace study
