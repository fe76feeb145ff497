// OutputFolder: a folder that files of results are written to, made if it is not there.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "csv.hpp"

namespace study {

/// Makes the folder, those above it included. What it made goes away again, with an interrupt too, unless it is kept.
class OutputFolder {
public:
    /// `name` is the option that named the path, for messages. Throws BadInput where it cannot be made or is no folder.
    OutputFolder(const std::string& path, const std::string& name);
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;
    ~OutputFolder();

    /// The path of a file in it.
    std::string file(const std::string& file_name) const;

    /// Nothing goes away any more.
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
