// parallel_for: independent tasks on several threads. Internal.
#pragma once

#include "language.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rollbem::detail {

/// Runs task(k) once for every k < count on `jobs` threads, the caller's among them, in any order. done(), which must
/// not throw, is called after each task, never by two threads at a time. If a task throws, no further task is started,
/// and its exception is rethrown when the running ones have ended.
inline void parallel_for(
    std::size_t count, std::size_t jobs, const std::function<void(std::size_t)>& task,
    const std::function<void()>& done = [] {}) {
    std::mutex mutex;
    std::size_t next = 0;
    std::exception_ptr error;
    const auto work = [&] {
        std::unique_lock lock(mutex);
        while (next < count && !error) {
            const std::size_t mine = next++;
            lock.unlock();
            std::exception_ptr failure;
            try {
                task(mine);
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure && !error) error = failure;
            if (!failure) done();
        }
    };
    std::vector<std::thread> threads;
    try {
        for (std::size_t i = 1; i < (std::min)(jobs, count); ++i) threads.emplace_back(work);
    } catch (const std::system_error&) {  // no more threads available: the existing ones do the work
    }
    work();
    for (std::thread& thread : threads) thread.join();
    if (error) std::rethrow_exception(error);
}

}  // namespace rollbem::detail
