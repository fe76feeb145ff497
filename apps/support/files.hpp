// Files by name: what an option reads, which file is written under a name, and whether two names mean the same file.
// As input and as output, - is the standard stream.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace study {

class Options;

/// All of the file that --name gives, without the byte order mark that some programs put before UTF-8; lines end in a
/// line feed. Throws BadInput.
std::string contents(const Options& options, const std::string& name);

/// Bytes of the first character of a text in UTF-8, which must not be empty; 0 if it does not start with a character.
std::size_t character_length(std::string_view text);

bool is_utf8(std::string_view text);

/// The text for a message: control characters and bytes that are not UTF-8 become \xNN.
std::string printable(std::string_view text);

/// The separator of the cells of a line: a comma, or a semicolon or tab if there is no comma outside quotes.
char separator_of(std::string_view line);

/// The cells of a line of CSV, without quotes and the blanks around them.
std::vector<std::string> cells_of(std::string_view line, char separator = ',');

/// A cell as a number, or nothing. Unless the comma separates cells, it may be the decimal point.
std::optional<double> number_of(std::string cell, char separator);

/// The lines of the file that --name gives, without blanks at their ends; empty lines and those that begin with # are
/// passed over. Throws BadInput if a line is not text.
class Lines {
public:
    /// Throws BadInput if the file cannot be read.
    Lines(const Options& options, const std::string& name);

    /// Goes to the next line, at first to the first one; false at the end.
    bool next();

    const std::string& text() const;
    bool is_first() const;      ///< the header of a table
    std::string where() const;  ///< "--name = file: line 3", counted from the top of the file, for messages

private:
    std::string said_, contents_, text_;
    std::size_t next_ = 0, number_ = 0, read_ = 0;
};

/// The end of a chain of symbolic links, whether or not there is a file. A chain that does not end is returned
/// unchanged.
std::string behind_links(const std::string& path);

/// Whether `path` is a stream that is already open, such as /dev/fd/3, or something else that is not a regular file.
bool is_stream(const std::string& path);

/// Where an option reads or writes.
struct Place {
    std::string said;     ///< for messages
    std::string path;     ///< - for a standard stream
    int descriptor = -1;  ///< of the standard stream

    static Place input(const std::string& said, const std::string& path);
    static Place output(const std::string& said, const std::string& path);
};

/// Whether both are the same file, pipe or standard stream, whatever their names. Devices never are the same.
bool same_place(const Place& first, const Place& second);

}  // namespace study
