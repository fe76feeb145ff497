#include "falling.hpp"

#include <cmath>
#include <cstddef>

#include "support/errors.hpp"

namespace friction {

namespace {

/// The two numbers of NAME FIRST,SECOND; nothing where they are none.
std::optional<std::pair<double, double>> read_pair(const study::Options& options, const char* name) {
    const std::string text = options.text(name);
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) return std::nullopt;
    const auto first = study::detail::parse_number<double>(text.substr(0, comma)),
               second = study::detail::parse_number<double>(text.substr(comma + 1));
    if (!first || !second || !std::isfinite(*first) || !std::isfinite(*second)) return std::nullopt;
    return std::pair(*first, *second);
}

}  // namespace

std::optional<FallingLaw> read_falling(const study::Options& options) {
    if (!options.given("falling")) {
        for (const char* name : {"memory", "sweep"}) options.ignored(name, "without --falling");
        return std::nullopt;
    }
    options.ignored("fit-border", "with --falling, which is solved by elements");
    const auto law = read_pair(options, "falling");
    if (!law || law->first < 0 || !(law->second > 0)) {
        throw study::BadInput(options.said("falling") + " must be K,VH with K >= 0 and VH > 0, both finite");
    }
    FallingLaw falling{{.mu_0 = 1, .mu_k = law->first, .half_velocity = law->second}, {}};
    if (options.given("memory")) {
        const auto memory = read_pair(options, "memory");
        if (!memory || !(memory->first > 0) || memory->second < 0) {
            throw study::BadInput(options.said("memory") + " must be D,V0 with D > 0 and V0 >= 0, both finite");
        }
        falling.memory = {.distance = memory->first, .least_velocity = memory->second};
    }
    return falling;
}

}  // namespace friction
