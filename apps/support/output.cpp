#include "output.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <random>
#include <system_error>
#include <utility>

#include <sys/ioctl.h>
#include <unistd.h>

#include "sidecar.hpp"

namespace study {

namespace fs = std::filesystem;

/// A file, or a folder if it is empty, that a run has made and must not leave.
struct Unfinished {
    std::string path;
    Unfinished* older;
    std::atomic<bool> removable{true};

    void keep() { removable = false; }
    void remove() {
        if (removable.exchange(false) && ::unlink(path.c_str()) != 0) ::rmdir(path.c_str());
    }
};

namespace {

/// The head of a list that only grows: an interrupt may come at any time.
std::atomic<Unfinished*> newest{nullptr};

Unfinished* unfinished(const std::string& path) { return newest = new Unfinished{path, newest}; }

extern "C" void end_by(int signal) {
    for (Unfinished* one = newest; one != nullptr; one = one->older) one->remove();
    std::raise(signal);  // whose action is the default by now
}

/// Signals wait while it lives.
class Uninterrupted {
public:
    Uninterrupted() {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_BLOCK, &all, &before_);
    }
    Uninterrupted(const Uninterrupted&) = delete;
    ~Uninterrupted() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

private:
    sigset_t before_;
};

}  // namespace

void handle_signals() {
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
        struct sigaction action = {};
        ::sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN) continue;
        action.sa_handler = end_by;
        ::sigfillset(&action.sa_mask);
        action.sa_flags = static_cast<int>(SA_RESETHAND);
        ::sigaction(signal, &action, nullptr);
    }
}

std::string place_of(const std::string& path) {
    std::error_code error;
    const fs::path place = fs::weakly_canonical(fs::absolute(path, error), error);
    return error ? path : place.string();
}

OutputFile::OutputFile(const std::string& path, const std::string& name)
    : path_(path == "-" ? "standard output" : path) {
    const auto refuse = [&](const std::string& why) {
        throw BadInput(name + " = " + path + " must be a file that can be written: " + why);
    };
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (path == "-" || path == "/dev/stdout") {
        file_ = stdout;
    } else if (fs::is_directory(status)) {
        refuse("it is a directory");
    } else if (fs::exists(status) && !fs::is_regular_file(status)) {
        file_ = std::fopen(path.c_str(), "a");
    } else {
        target_ = place_of(path);  // a link stays a link
        if (fs::exists(status) && ::access(target_.c_str(), W_OK) != 0) refuse(std::strerror(errno));
        std::random_device random;
        std::string part;
        const Uninterrupted making;
        do {
            part = target_ + "." + std::to_string(random()) + ".part";
            file_ = std::fopen(part.c_str(), "wx");
        } while (file_ == nullptr && errno == EEXIST);
        if (file_ != nullptr) part_ = unfinished(part);
    }
    if (file_ == nullptr) refuse(std::strerror(errno));
}

OutputFile::~OutputFile() {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
    if (part_ != nullptr) part_->remove();
}

bool OutputFile::is_terminal() const { return ::isatty(::fileno(file_)) == 1; }

std::size_t OutputFile::width() const {
    struct winsize size = {};
    return ::ioctl(::fileno(file_), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

void OutputFile::require(bool done) {
    if (!done && errno == EPIPE) has_no_reader_ = true;
    if (!done && errno != EPIPE) throw WriteError(path_ + " cannot be written: " + std::strerror(errno));
}

void OutputFile::write(std::string_view text) {
    require(std::fwrite(text.data(), 1, text.size(), file_) == text.size());
}

void OutputFile::flush() { require(std::fflush(file_) == 0); }

void OutputFile::close() {
    if (file_ == nullptr) return;
    flush();
    // some file systems find out only here that the disk is full
    if (std::FILE* const file = std::exchange(file_, nullptr); file != stdout) require(std::fclose(file) == 0);
}

void OutputFile::commit() {
    close();
    if (part_ == nullptr) return;
    require(std::rename(part_->path.c_str(), target_.c_str()) == 0);
    part_->keep();
}

OutputFiles::~OutputFiles() {
    files_.clear();
    for (Unfinished* const folder : folders_) folder->remove();
}

void OutputFiles::make_folder(const std::string& path, const std::string& name) {
    std::error_code error, unknown;
    fs::path made;
    const Uninterrupted making;
    for (const fs::path& part : fs::path(path)) {
        made /= part;
        if (path != "-" && !error && fs::create_directory(made, error)) folders_.push_front(unfinished(made.string()));
    }
    if (path != "-" && fs::is_directory(path, unknown)) return;
    throw BadInput(name + " = " + path + " must be a folder that can be written" +
                   (error ? ": " + error.message() : ""));
}

OutputFile& OutputFiles::open(const std::string& path, const std::string& name) {
    OutputFile& file = files_.emplace_back(path, name);
    for (const OutputFile& other : files_) {
        if (&other == &file || !file.is_regular() || other.target() != file.target()) continue;
        throw BadInput(name + " = " + path + " must not be the same file as " + other.path() + ", of the same run");
    }
    return file;
}

void OutputFiles::add(const std::string& path, const std::string& name, std::string_view text) {
    OutputFile& file = open(path, name);
    file.write(text);
    file.close();
}

OutputFile& OutputFiles::open_table(const Options& options, const std::string& name, std::string_view header) {
    OutputFile& rows = open(options.given(name) ? options.text(name) : "-", "--" + name);
    rows.write(header);
    if (rows.is_regular()) {
        add(rows.path() + ".toml", "--" + name, sidecar_text(options));
    } else if (name == "output") {
        options.say_doubts();
    }
    return rows;
}

void OutputFiles::commit() {
    for (OutputFile& file : files_) file.close();
    const Uninterrupted renaming;
    for (OutputFile& file : files_) file.commit();
    for (Unfinished* const folder : folders_) folder->keep();
}

}  // namespace study
