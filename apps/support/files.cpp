#include "files.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <system_error>

#include "errors.hpp"
#include "options.hpp"

namespace study {

namespace fs = std::filesystem;

std::string contents(const Options& options, const std::string& name) {
    const std::string path = options.text(name);
    std::ifstream file;
    errno = 0;
    if (path != "-") file.open(path, std::ios::binary);
    std::istream& from = path == "-" ? std::cin : file;
    std::ostringstream read;
    if (from.good() && from.peek() != std::istream::traits_type::eof()) read << from.rdbuf();
    std::string text = read.str();
    if (!from.good() && !from.eof()) {
        throw BadInput(options.said(name) + " must be a file that can be read: " + std::strerror(errno));
    }
    options.note_input(name, text);
    if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
    std::string lines;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\r') lines += text[i];
        if (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n')) lines += '\n';
    }
    return lines;
}

std::string printable(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        constexpr std::string_view digits = "0123456789ABCDEF";
        if (c == '\t') {
            result += ' ';
        } else if (byte < 0x20 || byte == 0x7F) {
            result += std::string("\\x") + digits[byte / 16] + digits[byte % 16];
        } else {
            result += c;
        }
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

bool is_stream(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status);
}

bool same_place(const std::string& first, const std::string& second) {
    if (first == "-" || second == "-") return first == second;
    std::error_code error;
    if (fs::is_character_file(first, error)) return false;
    const fs::path one = fs::weakly_canonical(fs::absolute(first), error);
    return one == fs::weakly_canonical(fs::absolute(second), error) || fs::equivalent(first, second, error);
}

}  // namespace study
