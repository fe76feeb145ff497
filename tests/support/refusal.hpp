// The message with which a call is rejected.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

/// The message of the std::invalid_argument that a call throws, "" where it throws none.
inline std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}
