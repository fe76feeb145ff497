// The files that options name: inputs and what is written.
#include <filesystem>

#include "input.hpp"
#include "options.hpp"
#include "output.hpp"

namespace study {

std::vector<Given> Options::given() const {
    std::vector<Given> result;
    for (const auto& [name, entry] : entries_) {
        if (!given(name) || name == "config") continue;
        const bool writes = entry.kind == Kind::output || entry.kind == Kind::table || entry.kind == Kind::folder;
        result.push_back({name, entry.kind == Kind::flag ? raw(name).back() : join(raw(name), ","),
                          !writes && name != "jobs" && name != "csv"});
    }
    return result;
}

void Options::check_files() const {
    struct Use {
        std::string said;
        bool written;
    };
    std::map<std::string, Use> uses;  // of each file, however its name is written
    const auto is_device = [](const std::string& path) {
        std::error_code error;
        return path != "-" && std::filesystem::is_character_file(path, error);
    };
    const auto add = [&](const std::string& path, const std::string& said, bool written) {
        if (is_device(path)) return;
        const std::string key = path != "-" ? place_of(path) : written ? "standard output" : "standard input";
        const auto [found, is_new] = uses.emplace(key, Use{said, written});
        const bool conflict = written || found->second.written || path == "-";
        if (!is_new && conflict) throw BadInput(said + " must not be the same file as " + found->second.said);
    };
    if (!given("output")) add("-", "standard output", true);
    for (const auto& [name, entry] : entries_) {
        const bool is_read = entry.kind == Kind::input || entry.kind == Kind::argument;
        const bool is_written = entry.kind == Kind::output || entry.kind == Kind::table;
        if (given(name) && (is_read || is_written)) add(text(name), said(name), is_written);
        // a replay writes its own again
        if (given(name) && entry.kind == Kind::table && text(name) != "-" && !is_device(text(name)) && !replays_) {
            add(text(name) + ".toml", said(name) + ", written next to it,", true);
        }
    }
}

}  // namespace study
