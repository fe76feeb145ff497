#include "progress.hpp"

#include <cstdio>
#include <utility>

#include <unistd.h>

namespace study {

Progress::Progress(std::string what, std::size_t total, bool enabled, std::string unit)
    : what_(std::move(what)), unit_(std::move(unit)), total_(total), enabled_(enabled && isatty(STDERR_FILENO) != 0) {
    if (!enabled_) return;
    clock_ = std::thread([this] {
        std::unique_lock lock(mutex_);
        auto pause = std::chrono::milliseconds(500);
        while (!stopped_.wait_for(lock, pause, [this] { return stop_; })) {
            show();
            pause = std::chrono::milliseconds(200);
        }
    });
}

void Progress::update(std::size_t done) {
    if (!enabled_) return;
    const std::lock_guard lock(mutex_);
    done_ = done;
}

void Progress::doing(const std::string& now) {
    if (!enabled_) return;
    const std::lock_guard lock(mutex_);
    now_ = now;
}

void Progress::clear() {
    if (!clock_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    stopped_.notify_all();
    clock_.join();
    if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show() {
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
