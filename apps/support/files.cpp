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
    return text;
}

Lines::Lines(const Options& options, const std::string& name)
    : said_(options.said(name)), contents_(contents(options, name)) {}

bool Lines::next() {
    if (next_ >= contents_.size()) return false;
    const std::size_t end = std::min(contents_.find('\n', next_), contents_.size());
    text_ = detail::trim(std::string_view(contents_).substr(next_, end - next_));
    next_ = end + 1;
    ++number_;
    return !text_.empty() || next_ < contents_.size();
}

const std::string& Lines::text() const { return text_; }

std::size_t Lines::number() const { return number_; }

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
