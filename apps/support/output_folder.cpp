#include "output_folder.hpp"

#include <system_error>

#include "errors.hpp"

namespace study {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& path, const std::string& name) : path_(path) {
    const auto refuse = [&](const std::string& why) {
        throw BadInput(name + " = " + path + " must be a folder that can be written" + why);
    };
    if (path == "-") refuse(": it cannot be standard output");
    std::error_code error;
    std::vector<fs::path> missing;
    for (fs::path part = path_; !part.empty() && !fs::exists(part, error); part = part.parent_path()) {
        missing.push_back(part);
    }
    error.clear();
    for (auto part = missing.rbegin(); part != missing.rend() && !error; ++part) {
        if (fs::create_directory(*part, error)) made_.push_back({*part, detail::claim_temporary(part->string())});
    }
    std::error_code unknown;
    if (fs::is_directory(path_, unknown)) return;
    remove_made();
    refuse(error ? ": " + error.message() : "");
}

OutputFolder::~OutputFolder() { remove_made(); }

std::string OutputFolder::file(const std::string& file_name) const { return (path_ / file_name).string(); }

void OutputFolder::keep() {
    for (const Made& made : made_) detail::release_temporary(made.slot);
    made_.clear();
}

void OutputFolder::remove_made() {
    while (!made_.empty()) {
        std::error_code error;
        fs::remove(made_.back().path, error);  // it stays if somebody else has put a file there
        detail::release_temporary(made_.back().slot);
        made_.pop_back();
    }
}

}  // namespace study
