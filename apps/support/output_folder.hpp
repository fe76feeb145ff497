// OutputFolder: a folder that results are written to, created if it does not exist.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "csv.hpp"

namespace study {

/// Creates the folder and those above it. What it created is removed again, also by an interrupt, unless it is kept.
class OutputFolder {
public:
    /// `name` is the option that named the path, for messages. Throws BadInput if it cannot be created or is no folder.
    OutputFolder(const std::string& path, const std::string& name);
    OutputFolder(OutputFolder&&) noexcept = default;  // what is moved from has nothing to remove
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

    /// The path of a file in it.
    std::string file(const std::string& file_name) const;

    /// Removes nothing any more.
    void keep();

private:
    struct Made {
        std::filesystem::path path;
        detail::TemporaryPath* slot;
    };

    void remove_made();

    std::filesystem::path path_;
    std::vector<Made> made_;  ///< outer ones first
};

}  // namespace study
