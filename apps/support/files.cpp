#include "files.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "errors.hpp"
#include "options.hpp"

namespace study {

namespace {

namespace fs = std::filesystem;

bool find_out(const Place& place, struct stat& status) {
    return (place.descriptor >= 0 ? ::fstat(place.descriptor, &status) : ::stat(place.path.c_str(), &status)) == 0;
}

/// The one name of a file that may not be there yet.
fs::path absolute_name(const std::string& path) {
    const fs::path end(behind_links(path));
    std::error_code error;
    const fs::path folder = fs::canonical(end.has_parent_path() ? end.parent_path() : fs::path("."), error);
    return error ? end : folder / end.filename();
}

}  // namespace

std::string contents(const Options& options, const std::string& name) {
    const std::string path = options.text(name);
    const int descriptor = path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    std::string text;
    std::array<char, 65536> buffer;
    ssize_t count = descriptor < 0 ? -1 : 1;
    while (count > 0) {
        do {
            count = ::read(descriptor, buffer.data(), buffer.size());
        } while (count < 0 && errno == EINTR);
        if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    const int error = errno;
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    if (count < 0) throw BadInput(options.said(name) + " must be a file that can be read: " + std::strerror(error));
    options.note_input(name, text);
    const std::string_view start = std::string_view(text).substr(0, 2);
    if (start == "\xFF\xFE" || start == "\xFE\xFF") throw BadInput(options.said(name) + " must be UTF-8, not UTF-16");
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    std::string lines;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\r') lines += text[i];
        if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) lines += '\n';
    }
    return lines;
}

std::size_t character_length(std::string_view text) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::size_t length = byte < 0x80                   ? 1
                               : byte >= 0xC2 && byte < 0xE0 ? 2
                               : (byte & 0xF0) == 0xE0       ? 3
                               : byte >= 0xF0 && byte < 0xF5 ? 4
                                                             : 0;
    if (length > text.size()) return 0;
    for (std::size_t k = 1; k < length; ++k) {
        if ((static_cast<unsigned char>(text[k]) & 0xC0) != 0x80) return 0;
    }
    return length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

std::string printable(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = character_length(text.substr(i));
        const auto byte = static_cast<unsigned char>(text[i]);
        if (length == 0 || byte < 0x20 || byte == 0x7F) {
            constexpr std::string_view digits = "0123456789ABCDEF";
            result += byte == '\t' ? " " : std::string("\\x") + digits[byte / 16] + digits[byte % 16];
            ++i;
            continue;
        }
        result += text.substr(i, length);
        i += length;
    }
    return result;
}

char separator_of(std::string_view line) {
    bool quoted = false;
    char found = ',';
    for (const char c : line) {
        if (c == '"') quoted = !quoted;
        if (quoted) continue;
        if (c == ',') return c;
        if ((c == ';' || c == '\t') && found == ',') found = c;
    }
    return found;
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            cells.back() += line[i++];  // two stand for one
        } else if (line[i] == '"') {
            quoted = !quoted;
        } else if (line[i] == separator && !quoted) {
            cells.emplace_back();
        } else {
            cells.back() += line[i];
        }
    }
    for (std::string& cell : cells) cell = detail::trim(std::string(cell));
    return cells;
}

std::optional<double> number_of(std::string cell, char separator) {
    if (separator != ',') std::replace(cell.begin(), cell.end(), ',', '.');
    return detail::parse_number<double>(cell);
}

Lines::Lines(const Options& options, const std::string& name)
    : said_(options.said(name)), contents_(contents(options, name)) {}

bool Lines::next() {
    do {
        if (next_ >= contents_.size()) return false;
        const std::size_t end = std::min(contents_.find('\n', next_), contents_.size());
        text_ = detail::trim(std::string_view(contents_).substr(next_, end - next_));
        next_ = end + 1;
        ++number_;
    } while (text_.empty() || text_[0] == '#');
    ++read_;
    const auto is_tab = [](char c) { return c == '\t'; };
    std::string plain = text_;
    std::replace_if(plain.begin(), plain.end(), is_tab, ' ');
    const std::string shown = printable(plain);
    if (shown != plain) throw BadInput(where() + " = " + shown.substr(0, 80) + " must be text");
    return true;
}

const std::string& Lines::text() const { return text_; }

bool Lines::is_first() const { return read_ == 1; }

std::string Lines::where() const { return said_ + ": line " + std::to_string(number_); }

std::string behind_links(const std::string& path) {
    fs::path end(path);
    std::error_code error;
    for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(end, error)); ++links) {
        const fs::path target = fs::read_symlink(end, error);
        if (error) return path;
        end = end.parent_path() / target;  // an absolute target stands alone
    }
    return end.string();
}

bool is_stream(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) return false;
    for (const char* open : {"/dev/fd/", "/dev/std", "/proc/"}) {
        if (path.rfind(open, 0) == 0) return true;
    }
    return !fs::is_regular_file(status);
}

Place Place::input(const std::string& said, const std::string& path) {
    return {said, path, path == "-" ? STDIN_FILENO : -1};
}

Place Place::output(const std::string& said, const std::string& path) {
    return {said, path, path == "-" || path == "/dev/stdout" ? STDOUT_FILENO : -1};
}

bool same_place(const Place& first, const Place& second) {
    if (first.descriptor >= 0 && first.descriptor == second.descriptor) return true;
    struct stat one {
    }, other{};
    const bool one_is = find_out(first, one), other_is = find_out(second, other);
    if (one_is != other_is) return false;
    if (!one_is) return absolute_name(first.path) == absolute_name(second.path);
    return one.st_dev == other.st_dev && one.st_ino == other.st_ino && !S_ISCHR(one.st_mode) && !S_ISSOCK(one.st_mode);
}

}  // namespace study
