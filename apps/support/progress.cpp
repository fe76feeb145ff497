#include "progress.hpp"

#include <cstdio>
#include <utility>

#include <unistd.h>

namespace study {

Progress::Progress(std::string what, std::size_t total, bool enabled, std::string unit)
    : what_(std::move(what)), unit_(std::move(unit)), total_(total), enabled_(enabled && isatty(STDERR_FILENO) != 0) {}

void Progress::update(std::size_t done) {
    const std::lock_guard lock(mutex_);
    done_ = done;
    show();
}

void Progress::doing(const std::string& now) {
    const std::lock_guard lock(mutex_);
    now_ = now;
    show();
}

void Progress::clear() {
    if (std::exchange(shown_, false)) std::fputs("\r\033[K", stderr);
}

void Progress::show() {
    if (!enabled_ || Clock::now() < next_) return;
    next_ = Clock::now() + std::chrono::milliseconds(200);
    const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
    std::string line = what_ + ": " + std::to_string(done_) + " of " + std::to_string(total_) + " " + unit_;
    if (!now_.empty()) line += ", " + now_;
    const auto seconds = [](double time) { return std::to_string(static_cast<long long>(time)) + " s"; };
    line += ", " + seconds(elapsed);
    if (done_ > 0) {
        line +=
            ", about " + seconds(elapsed * static_cast<double>(total_ - done_) / static_cast<double>(done_)) + " to go";
    }
    std::fprintf(stderr, "\r\033[K%s", line.c_str());
    std::fflush(stderr);
    shown_ = true;
}

}  // namespace study
