// The files that options name: configurations, inputs and what is written.
#include <cstdint>
#include <cstdio>
#include <iomanip>
#include <sstream>

#include "csv.hpp"
#include "input.hpp"
#include "options.hpp"
#include "sidecar.hpp"

namespace study {

namespace {

/// By which a changed text is noticed: FNV-1a.
std::string checksum(std::string_view text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    std::ostringstream result;
    result << "fnv1a64:" << std::hex << std::setw(16) << std::setfill('0') << hash;
    return result.str();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> Options::given_values() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& [name, entry] : entries_) {
        if (!given(name) || name == "config") continue;
        result.emplace_back(name, entry.kind == Kind::flag ? raw(name).back() : join(raw(name), ","));
    }
    return result;
}

void Options::note_input(const std::string& name, std::string_view contents) const {
    if (name == "config") return;
    const std::string text = checksum(contents);
    const auto expected = expected_.find(name);
    if (expected != expected_.end() && expected->second != text) {
        std::fprintf(stderr, "%s: %s is not as it was in the run that %s repeats\n", program_.c_str(),
                     said(name).c_str(), said("config").c_str());
    }
    inputs_[name] = text;
}

void Options::read_config() {
    Config config = study::read_config(contents(*this, "config"), said("config"));
    replays_ = config.is_sidecar;
    expected_ = std::move(config.inputs);
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
    struct File {
        std::string said, path;
        bool written, is_sidecar = false;
    };
    std::vector<File> files;
    if (!given("output")) files.push_back({"standard output", "-", true});
    for (const auto& [name, entry] : entries_) {
        if (!given(name) || entry.kind == Kind::value || entry.kind == Kind::flag) continue;
        const std::string path = text(name);
        if (entry.kind != Kind::folder) files.push_back({said(name), path, entry.kind != Kind::input});
        for (const std::string& file : entry.files) {
            files.push_back({file + " of " + said(name), path + "/" + file, true});
        }
        if (entry.kind == Kind::table && path != "-" && !is_stream(path)) {
            files.push_back({said(name) + ".toml, written beside it,", path + ".toml", true, true});
        }
    }
    for (const File& file : files) {
        for (const File& other : files) {
            if (&file == &other || !same_place(file.path, other.path)) continue;
            if (!file.written && !other.written && file.path == "-" && &file > &other) {
                throw BadInput(file.said + " must be a file: standard input is read as " + other.said);
            }
            // a repeated run may overwrite the file that describes it: it has been read by then
            const bool repeats = replays_ && file.is_sidecar && other.said == said("config");
            if (file.written && !other.written && file.path != "-" && !repeats) {
                throw BadInput(file.said + " must not be a file that this run reads: " + other.said);
            }
            if (file.written && other.written && &file > &other) {
                throw BadInput(file.said + " must not be written to as well as " + other.said);
            }
        }
    }
}

}  // namespace study
