// The files that options name: configurations, inputs and what is written.
#include <filesystem>

#include "input.hpp"
#include "options.hpp"
#include "output.hpp"
#include "sidecar.hpp"

namespace study {

std::vector<std::pair<std::string, std::string>> Options::given_values() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& [name, entry] : entries_) {
        if (!given(name) || name == "config") continue;
        result.emplace_back(name, entry.kind == Kind::flag ? raw(name).back() : join(raw(name), ","));
    }
    return result;
}

void Options::read_config() {
    Config config = study::read_config(contents(*this, "config"), said("config"));
    replays_ = config.is_sidecar;
    if (replays_ && !config.program.empty() && config.program != program_) {
        throw BadInput(said("config") + ": program = " + config.program + " must be " + program_ +
                       ", whose run this is to repeat");
    }
    for (Setting& setting : config.settings) {
        const auto found = entries_.find(setting.name);
        if (found == entries_.end() || setting.name == "config") {
            throw BadInput(setting.where + " must name an option of " + program_ + suggestion(setting.name) +
                           "; see --help");
        }
        const Kind kind = found->second.kind;
        const bool writes = kind == Kind::output || kind == Kind::table || kind == Kind::folder;
        if (replays_ && (writes || setting.name == "jobs")) continue;
        if (kind == Kind::flag && setting.values != std::vector<std::string>{"true"} &&
            setting.values != std::vector<std::string>{"false"}) {
            throw BadInput(setting.where + " must be true or false");
        }
        found->second.configured = std::move(setting.values);
    }
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
            add(text(name) + ".toml", said(name) + ", written beside it,", true);
        }
    }
}

}  // namespace study
