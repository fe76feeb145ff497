#include "csv.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <Eigen/Core>
#include <fcntl.h>
#include <gsl/gsl_version.h>
#include <sys/stat.h>
#include <unistd.h>

#include "build_info.hpp"
#include "files.hpp"

namespace study {

namespace detail {

// Temporary files, and folders made for them, that a signal must remove. A handler may touch lock-free atomics and
// plain memory only.
struct TemporaryPath {
    std::atomic<bool> used{false};
    std::array<char, 4096> path{};
};

}  // namespace detail

namespace {

std::array<detail::TemporaryPath, 128> temporary_paths;
static_assert(std::atomic<bool>::is_always_lock_free);

extern "C" void remove_temporaries_and_exit(int signal) {
    for (const detail::TemporaryPath& temporary : temporary_paths) {
        if (temporary.used) ::unlink(temporary.path.data());
    }
    for (auto folder = temporary_paths.rbegin(); folder != temporary_paths.rend(); ++folder) {  // inner ones first
        if (folder->used) ::rmdir(folder->path.data());
    }
    ::_exit(128 + signal);
}

/// A TOML basic string. Bytes that are not UTF-8, which TOML does not allow, become U+FFFD.
std::string toml_string(std::string_view text) {
    std::string result = "\"";
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const std::size_t length = character_length(text.substr(i));
        if (length == 0) {
            result += "\\uFFFD";
            ++i;
            continue;
        }
        if (byte == '"' || byte == '\\') {
            result += '\\';
            result += text[i];
        } else if (byte < 0x20 || byte == 0x7F) {
            std::array<char, 8> escape;
            std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(byte));
            result += escape.data();
        } else {
            result += text.substr(i, length);
        }
        i += length;
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

detail::TemporaryPath* detail::claim_temporary(const std::string& path) {
    for (TemporaryPath& slot : temporary_paths) {
        if (slot.used || path.size() >= slot.path.size()) continue;
        std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
        slot.used = true;
        return &slot;
    }
    return nullptr;
}

void detail::release_temporary(TemporaryPath* temporary) {
    if (temporary != nullptr) temporary->used = false;
}

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

void handle_signals() {
    // A stream that the caller closed must not become the number of a file of results. Opened the wrong way round, what
    // goes to a closed output still fails.
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        const bool closed = ::fcntl(stream, F_GETFD) < 0;
        if (closed) [[maybe_unused]]
            const int opened = ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
    struct sigaction action {};
    action.sa_handler = remove_temporaries_and_exit;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
    struct sigaction hangup {};
    sigaction(SIGHUP, nullptr, &hangup);
    if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // not under nohup
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

OutputFile OutputFile::standard_output() { return OutputFile("standard output", STDOUT_FILENO); }

OutputFile::OutputFile(const std::string& path, const std::string& name) : shown_(path) {
    namespace fs = std::filesystem;
    const auto refuse = [&](const std::string& why) {
        throw BadInput(name + " = " + path + " must be a file that can be written: " + why);
    };
    std::error_code error;
    if (path == "-" || path == "/dev/stdout") {
        descriptor_ = ::dup(STDOUT_FILENO);
        if (descriptor_ < 0) refuse(std::strerror(errno));
        return;
    }
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) refuse("it is a directory");
    if (is_stream(path)) {
        descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
        if (descriptor_ < 0) refuse(std::strerror(errno));
        return;
    }
    if (fs::exists(status) && ::access(path.c_str(), W_OK) != 0) refuse(std::strerror(errno));
    target_ = behind_links(path);  // a link stays a link
    if (fs::is_symlink(fs::symlink_status(target_, error))) refuse("its chain of links has no end");
    temporary_ = target_ + ".part-" + std::to_string(::getpid());
    slot_ = detail::claim_temporary(temporary_);
    if (slot_ == nullptr) refuse("its name is too long");
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
        detail::release_temporary(slot_);
        refuse(std::strerror(errno));
    }
    struct stat before {};
    if (fs::exists(status) && ::stat(target_.c_str(), &before) == 0) {
        [[maybe_unused]] const int kept = ::fchmod(descriptor_, before.st_mode & 07777);  // best effort
    }
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : shown_(std::move(other.shown_)),
      target_(std::move(other.target_)),
      temporary_(std::move(other.temporary_)),
      buffer_(std::move(other.buffer_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      slot_(std::exchange(other.slot_, nullptr)) {}

OutputFile::~OutputFile() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    remove_temporary();
}

bool OutputFile::is_regular() const { return !target_.empty(); }

const std::string& OutputFile::path() const { return shown_; }

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
    if (slot_ != nullptr && ::fsync(descriptor_) != 0 && errno != EINVAL) fail(errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
}

void OutputFile::commit() {
    close();
    if (slot_ == nullptr) return;
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
    detail::release_temporary(std::exchange(slot_, nullptr));
}

OutputFile::OutputFile(std::string shown, int descriptor) : shown_(std::move(shown)), descriptor_(descriptor) {}

void OutputFile::fail(int error) const { throw WriteError(shown_ + " cannot be written: " + std::strerror(error)); }

void OutputFile::remove_temporary() {
    if (slot_ == nullptr) return;
    ::unlink(temporary_.c_str());
    detail::release_temporary(std::exchange(slot_, nullptr));
}

std::string sidecar_text(const Options& options) {
    std::string text;
    const auto entry = [&](std::string_view key, std::string_view value) {
        text += std::string(key) + " = " + toml_string(value) + "\n";
    };
    entry("program", options.program());
    entry("command_line", shell_quoted(options.words()));
    entry("version", build_info::version);
    entry("git_revision", build_info::git_revision);
    if (!options.replay_note().empty()) entry("replay", options.replay_note());
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

TableFile::TableFile(const Options& options, const std::string& name)
    : options_(options),
      csv_(options.given(name) ? OutputFile(options.text(name), "--" + name) : OutputFile::standard_output()) {
    if (csv_.is_regular()) sidecar_.emplace(csv_.path() + ".toml", "--" + name);
}

void TableFile::commit() {
    if (sidecar_) {
        sidecar_->write(sidecar_text(options_));
        sidecar_->close();
    }
    csv_.commit();
    if (sidecar_) sidecar_->commit();
}

}  // namespace study
