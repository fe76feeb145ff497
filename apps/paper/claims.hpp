// The statements of the paper's sections 5 to 7: a few of its words, how they are measured here, and whether they hold.
// Each statement counts once, where it is first made. Results that the paper does not have are marked as additions.
// Thresholds are fixed in claims/ and given in the remarks; none depends on the result.
#pragma once

#include <array>
#include <charconv>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "results.hpp"

namespace paper {

struct Finding {
    bool holds;
    std::string measured;
};

struct Claim {
    std::string figure;
    std::string quote;   ///< the paper's words; empty for an addition
    std::string claim;   ///< what is judged
    bool expected;       ///< to hold
    std::string remark;  ///< how it is judged, or why it does not hold
    std::function<Finding(const Results&)> judge;
    bool timed = false;  ///< judged while nothing else runs

    bool is_addition() const { return quote.empty(); }
};

/// All claims, in the paper's order.
std::vector<Claim> claims();

/// The claims of several lists, one after the other.
inline std::vector<Claim> all_of(std::initializer_list<std::vector<Claim> (*)()> lists) {
    std::vector<Claim> all;
    for (const auto list : lists) {
        for (Claim& claim : list()) all.push_back(std::move(claim));
    }
    return all;
}

inline std::string number(double value, int digits = 3) {
    std::array<char, 64> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}
inline std::string percent(double value, int digits = 2) { return number(100 * value, digits) + " %"; }

}  // namespace paper
