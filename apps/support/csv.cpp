#include "csv.hpp"

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <Eigen/Core>
#include <fcntl.h>
#include <gsl/gsl_version.h>
#include <sys/file.h>
#include <unistd.h>

#include "build_info.hpp"
#include "files.hpp"

namespace study {

namespace {

namespace fs = std::filesystem;

std::string part_of(const std::string& target) { return target + ".part"; }

/// The file itself where the path is a link.
std::string target_of(const std::string& path) {
    std::error_code error;
    const fs::path target = fs::canonical(path, error);
    return error ? path : target.string();
}

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A TOML basic string.
std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) {
            std::array<char, 8> escape;
            std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(byte));
            result += escape.data();
            continue;
        }
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result += '"';
}

/// A command line as a shell takes it.
std::string shell_quoted(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) {
        if (!result.empty()) result += ' ';
        const bool plain = !word.empty() && word.find_first_not_of(
                                                "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                "0123456789_-+=./,:@%") == std::string::npos;
        if (plain) {
            result += word;
            continue;
        }
        result += '\'';
        for (const char c : word) result += c == '\'' ? "'\\''" : std::string(1, c);
        result += '\'';
    }
    return result;
}

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line)) {
        const std::size_t colon = line.find(':');
        if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
            return std::string(detail::trim(line.substr(colon + 1)));
    }
    return "unknown";
}

std::string eigen_version() {
#ifdef EIGEN_VERSION_STRING
    return EIGEN_VERSION_STRING;
#else
    return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." +
           std::to_string(EIGEN_MINOR_VERSION);
#endif
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
    if (const auto* integer = std::get_if<long long>(&value_)) {
        return {buffer.data(), std::to_chars(buffer.data(), end, *integer).ptr};
    }
    return {};
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
                   (path == "-" ? ": it cannot be standard output"
                    : error     ? ": " + error.message()
                                : ""));
}

OutputFile::OutputFile(const std::string& path, const std::string& name, std::size_t kept)
    : shown_(path == "-" ? "standard output" : path) {
    const auto refuse = [&](const std::string& why) {
        throw BadInput(name + " = " + path + " must be a file that can be written: " + why);
    };
    if (path == "-" || path == "/dev/stdout") {
        descriptor_ = STDOUT_FILENO;
        return;
    }
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) refuse("it is a directory");
    if (is_stream(path)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) refuse(std::strerror(errno));
        return;
    }
    if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
    const std::string part = part_of(target_of(path));
    descriptor_ = ::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) refuse(std::strerror(errno));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) refuse("another run is writing it");
    const auto size = static_cast<off_t>(kept);
    if (::ftruncate(descriptor_, size) != 0 || ::lseek(descriptor_, size, SEEK_SET) < 0) refuse(std::strerror(errno));
    target_ = target_of(path);
    part_ = part;
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      part_(std::exchange(other.part_, {})),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    if (!part_.empty()) ::unlink(part_.c_str());
}

void OutputFile::write(std::string_view text) {
    buffer_ += text;
    if (buffer_.size() >= 65536) flush();
}

void OutputFile::flush() {
    std::string_view rest = buffer_;
    while (!rest.empty()) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(errno);
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
}

void OutputFile::close() {
    flush();
    if (descriptor_ <= STDERR_FILENO) return;
    // some file systems find out only here that the disk is full
    if (is_regular() && ::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void OutputFile::commit() {
    close();
    if (is_regular() && std::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
    part_.clear();
}

void OutputFile::fail(int error) const { throw WriteError(shown_ + " cannot be written: " + std::strerror(error)); }

std::string sidecar_text(const Options& options) {
    std::string text;
    const auto entry = [&](std::string_view key, std::string_view value) {
        text += std::string(key) + " = " + toml_string(value) + "\n";
    };
    entry("program", options.program());
    entry("command_line", shell_quoted(options.words()));
    entry("version", build_info::version);
    entry("git_revision", build_info::git_revision);
    text += "\n[given]\n";
    for (const auto& [name, value] : options.given_values()) entry(name, value);
    if (!options.inputs().empty()) text += "\n[inputs]  # 64-bit FNV-1a of the contents\n";
    for (const auto& [name, checksum] : options.inputs()) entry(name, checksum);
    text += "\n[options]  # with defaults; what mesh and method do not use has no effect\n";
    for (const auto& [name, value] : options.values()) entry(name, value);
    text += "\n[build]\n";
    entry("compiler", build_info::compiler);
    entry("flags", build_info::flags);
    entry("build_type", build_info::build_type);
    entry("eigen", eigen_version());
    entry("gsl", gsl_version);
    text += "\n[machine]\n";
    entry("cpu", cpu_name());
    text += "\n[conventions]\n";
    if (!options.conventions().empty()) return text + options.conventions();
    entry("x", "rolling direction in units of the half-length a; leading edge at x/a = 1, trailing edge at x/a = -1");
    entry("elements", "numbered from the trailing edge to the leading edge");
    entry("signs", "traction acts on body 1 (the wheel); positive creepage gives negative traction and force");
    entry("c11",
          "of a line: -force per width / (a G creepage); c11_exact = pi/(2(1-nu)), plane limit b >> a of a "
          "rectangle; of a patch: (F_x, F_y, M_z/c) = -G a b (c11 c12 c13; c21 c22 c23; c31 c32 c33) (xi, eta, phi c), "
          "c = sqrt(a b)");
    entry("units", "dimensionless with a = G = V = 1; columns ending in _us in microseconds");
    entry("errors", "relative_error = value/exact - 1, signed, for real quantities; absolute value for complex ones");
    entry("cells", "the shortest text that is read back exactly; an undefined value is an empty cell");
    return text;
}

TableFile::TableFile(const Options& options, const std::string& name, std::string_view header, bool resumable)
    : csv_(options.given(name) ? options.text(name) : "-", "--" + name,
           resumable && options.given(name) ? find_rows(options, target_of(options.text(name)), header) : 0) {
    if (!csv_.is_regular()) {
        csv_.write(header);
        return;
    }
    if (found_.empty()) csv_.write(header);
    sidecar_.emplace(csv_.path() + ".toml", "--" + name);
    sidecar_->write(sidecar_text(options));
    if (resumable) sidecar_->flush();
}

std::size_t TableFile::find_rows(const Options& options, const std::string& path, std::string_view header) {
    if (text_of(part_of(path + ".toml")) != sidecar_text(options)) return 0;
    const std::string text = text_of(part_of(path));
    if (text.rfind(header, 0) != 0) return 0;
    std::size_t kept = header.size();
    for (std::size_t end = 0; (end = text.find('\n', kept)) != std::string::npos; kept = end + 1) {
        found_.push_back(text.substr(kept, end + 1 - kept));
    }
    return found_.empty() ? 0 : kept;
}

void TableFile::keep_part() {
    csv_.keep_part();
    if (sidecar_) sidecar_->keep_part();
}

void TableFile::commit() {
    if (sidecar_) sidecar_->close();
    csv_.commit();
    if (sidecar_) sidecar_->commit();
}

}  // namespace study
