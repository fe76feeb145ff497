// Files of results appear whole or not at all, and the files of a run together. Until then they are written beside
// their places under names of their own, so that runs do not disturb each other: the last to finish wins.
#pragma once

#include <cstddef>
#include <cstdio>
#include <deque>
#include <string>
#include <string_view>

#include "options.hpp"

namespace study {

/// From now on SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGXCPU, unless they are ignored, remove what is unfinished before
/// they end the program; a closed pipe ends nothing, and a file larger than allowed makes write() throw.
void handle_signals();

/// A path without links and detours, to tell whether two are one file. A file that does not exist has one, too.
std::string place_of(const std::string& path);

struct Unfinished;

/// A file to write from start to end. A regular file is written to FILE.NUMBER.part and takes its name in commit();
/// without commit() nothing is left. Pipes and devices are written to directly; what the reader of a pipe leaves unread
/// is lost without an error.
class OutputFile {
public:
    static OutputFile standard_output() { return {"-", "standard output"}; }

    /// `name` is the option or quantity that named the path, for messages. A path of - is standard output. Throws
    /// BadInput if the file cannot be written.
    OutputFile(const std::string& path, const std::string& name);
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;
    ~OutputFile();

    bool is_regular() const { return part_ != nullptr; }  ///< written to FILE.NUMBER.part first
    bool is_terminal() const;
    std::size_t width() const;                             ///< of a terminal, in letters; 80 where it does not say
    bool has_no_reader() const { return has_no_reader_; }  ///< a pipe that is read no longer
    const std::string& path() const { return path_; }
    const std::string& target() const { return target_; }  ///< of a regular file: the place that it takes

    // All of these throw WriteError.
    void write(std::string_view text);
    void flush();   ///< passes everything written so far to the system
    void close();   ///< the end of what is written
    void commit();  ///< close(), and the file has its name

private:
    void require(bool done);

    std::string path_, target_;
    Unfinished* part_ = nullptr;
    std::FILE* file_ = nullptr;
    bool has_no_reader_ = false;
};

/// All files of a run but its picture.
class OutputFiles {
public:
    OutputFiles() = default;
    OutputFiles(const OutputFiles&) = delete;
    ~OutputFiles();

    /// A folder to write to, created if it does not exist. Throws BadInput, which names `name`.
    void make_folder(const std::string& path, const std::string& name);

    /// Opens a file as the constructor of OutputFile does. Throws BadInput also if this run writes that file already.
    OutputFile& open(const std::string& path, const std::string& name);

    /// A file of this text.
    void add(const std::string& path, const std::string& name, std::string_view text);

    /// The CSV file that --name gives, or standard output without it, and if it is a regular file the TOML file beside
    /// it that says how it was made. Throws BadInput.
    OutputFile& open_table(const Options& options, const std::string& name, std::string_view header);

    /// Gives all files their names when all of them are whole. Throws WriteError.
    void commit();

private:
    std::deque<Unfinished*> folders_;  // those within others first
    std::deque<OutputFile> files_;
};

}  // namespace study
