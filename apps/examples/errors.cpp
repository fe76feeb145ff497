// Part of every example: an exception ends it with its message, one line, and exit code 1.
#include <cstdio>
#include <cstdlib>
#include <exception>

namespace {

[[noreturn]] void end_with_message() {
    std::fflush(stdout);
    try {
        if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
    }
    std::_Exit(EXIT_FAILURE);
}

[[maybe_unused]] const std::terminate_handler replaced = std::set_terminate(end_with_message);

}  // namespace
