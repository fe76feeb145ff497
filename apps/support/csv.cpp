#include "csv.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <iterator>

#include <unistd.h>

#include "sidecar.hpp"

namespace study {

namespace {

namespace fs = std::filesystem;

/// Where a file is written before it has its name, that of the file itself where the path is a link.
std::string part_of(const std::string& path) {
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    return (error ? path : target.string()) + ".part";
}

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The whole lines of `path` if it begins with the first of them.
std::vector<std::string> lines_of(const std::string& path, std::string_view first) {
    const std::string text = text_of(path);
    std::vector<std::string> lines;
    if (text.rfind(first, 0) != 0) return lines;
    std::size_t begin = first.size();
    for (std::size_t end = 0; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        lines.push_back(text.substr(begin, end + 1 - begin));
    }
    return lines;
}

/// Whether `path` is there and is not a regular file.
bool is_stream(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

std::string Cell::text(std::optional<int> digits) const {
    if (const auto* text = std::get_if<std::string>(&value_)) return *text;
    std::array<char, 64> buffer;
    char* const end = buffer.data() + buffer.size();
    if (const auto* number = std::get_if<double>(&value_)) {
        return {buffer.data(), digits
                                   ? std::to_chars(buffer.data(), end, *number, std::chars_format::general, *digits).ptr
                                   : std::to_chars(buffer.data(), end, *number).ptr};
    }
    const auto* integer = std::get_if<long long>(&value_);
    return integer != nullptr ? std::to_string(*integer) : "";
}

std::string csv_line(const Row& row) {
    std::string line;
    for (const Cell& cell : row) {
        if (&cell != &row.front()) line += ',';
        const std::string text = cell.text();
        if (text.find_first_of(",\"\r\n") == std::string::npos) {
            line += text;
            continue;
        }
        line += '"';
        for (const char c : text) line.append(c == '"' ? 2 : 1, c);
        line += '"';
    }
    return line += '\n';
}

void ignore_write_signals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

void make_folder(const std::string& path, const std::string& name) {
    std::error_code error;
    if (path != "-") fs::create_directories(path, error);
    if (path != "-" && fs::is_directory(path)) return;
    throw BadInput(name + " = " + path + " must be a folder that can be written" +
                   (error ? ": " + error.message() : ""));
}

OutputFile::OutputFile(const std::string& path, const std::string& name, std::size_t kept)
    : path_(path == "-" ? "standard output" : path), to_(&file_) {
    const auto refuse = [&](const std::string& why) {
        throw BadInput(name + " = " + path + " must be a file that can be written: " + why);
    };
    if (path == "-" || path == "/dev/stdout") to_ = &std::cout;
    if (to_ == &std::cout) return;
    if (fs::is_directory(path)) refuse("it is a directory");
    const bool regular = !is_stream(path);
    if (regular && fs::exists(path) && ::access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
    const std::string opened = regular ? part_of(path) : path;
    if (kept > 0) fs::resize_file(opened, kept);
    file_.open(opened, std::ios::binary | (kept > 0 || !regular ? std::ios::app : std::ios::trunc));
    if (!file_.is_open()) refuse(std::strerror(errno));
    if (!regular) return;
    part_ = opened;
    target_ = opened.substr(0, opened.size() - std::strlen(".part"));
}

OutputFile::~OutputFile() {
    if (!part_.empty()) ::unlink(part_.c_str());
}

void OutputFile::require(bool done) const {
    if (!done) throw WriteError(path_ + " cannot be written: " + std::strerror(errno));
}

void OutputFile::write(std::string_view text) { require(bool(*to_ << text)); }

void OutputFile::flush() { require(bool(to_->flush())); }

void OutputFile::commit() {
    flush();
    if (to_ == &file_) file_.close();  // some file systems find out only here that the disk is full
    require(!file_.fail());
    require(part_.empty() || std::rename(part_.c_str(), target_.c_str()) == 0);
    part_.clear();
}

TableFile::TableFile(const Options& options, const std::string& name, std::string_view header, bool resumable)
    : sidecar_text_(sidecar_text(options)),
      found_(resumable && options.given(name) && text_of(part_of(options.text(name) + ".toml")) == sidecar_text_
                 ? lines_of(part_of(options.text(name)), header)
                 : std::vector<std::string>{}),
      csv_(options.given(name) ? options.text(name) : "-", "--" + name,
           found_.empty() ? 0 : header.size() + join(found_, "").size()) {
    if (found_.empty()) csv_.write(header);
    if (!csv_.is_regular()) return;
    sidecar_.emplace(csv_.path() + ".toml", "--" + name);
    sidecar_->write(sidecar_text_);
    if (resumable) sidecar_->flush();
}

void TableFile::keep_part() {
    csv_.keep_part();
    if (sidecar_) sidecar_->keep_part();
}

void TableFile::commit() {
    csv_.flush();
    if (sidecar_) sidecar_->flush();
    csv_.commit();
    if (sidecar_) sidecar_->commit();
}

}  // namespace study
