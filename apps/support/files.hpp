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

/// The text for a message: control characters become \xNN.
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

/// Whether `path` is there and is not a regular file.
bool is_stream(const std::string& path);

/// Whether both are the same file, or - for the same standard stream, whatever their names. Devices never are the same.
bool same_place(const std::string& first, const std::string& second);

}  // namespace study
