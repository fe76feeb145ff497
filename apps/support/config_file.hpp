// A configuration file in TOML: options as NAME = VALUE. The file beside a CSV file is one, too, whose options are in the
// table [given].
#pragma once

#include <map>
#include <string>
#include <vector>

namespace study {

struct Setting {
    std::string name;
    std::vector<std::string> values;  ///< at least one
    std::string where;                ///< file, line and what stands there, for messages
};

struct Config {
    std::vector<Setting> settings{};
    bool is_sidecar = false;                      ///< it stands beside a CSV file
    std::string program{};                        ///< that wrote the sidecar
    std::map<std::string, std::string> inputs{};  ///< checksums of the files that were read, by option
};

/// Reads the contents of a file, which `said` names in messages. Throws BadInput if they are malformed.
Config read_config(const std::string& text, const std::string& said);

}  // namespace study
