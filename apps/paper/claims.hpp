// Every quantitative or comparative statement of the paper's sections 5 to 7: what it says, how it is measured here,
// and whether it holds. Thresholds are fixed in claims.cpp and told in the remarks; none depends on the result.
#pragma once

#include <array>
#include <charconv>
#include <functional>
#include <string>
#include <vector>

#include "results.hpp"

namespace paper {

struct Finding {
    bool holds;
    std::string measured;
};

struct Claim {
    std::string figure;
    std::string claim;
    std::string paper;   ///< the figure the paper gives
    bool expected;       ///< whether it is known to hold
    std::string reason;  ///< why it does not hold, or a remark
    std::function<Finding(const Results&)> judge;
    bool timed = false;  ///< to be judged while nothing else runs
};

/// All claims, in the paper's order.
std::vector<Claim> claims();

inline std::string number(double value, int digits = 3) {
    std::array<char, 64> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}
inline std::string percent(double value, int digits = 2) { return number(100 * value, digits) + " %"; }

}  // namespace paper
