#include "falling.hpp"

#include "support/errors.hpp"

namespace friction {

std::optional<FallingLaw> read_falling(const study::Options& options) {
    if (!options.given("falling")) return std::nullopt;
    const auto law = options.pair("falling");
    if (!law || law->first < 0 || !(law->second > 0)) {
        throw study::BadInput(options.said("falling") + " must be K,VH with K >= 0 and VH > 0, both finite");
    }
    FallingLaw falling{{.mu_0 = 1, .mu_k = law->first, .half_velocity = law->second}, {}};
    if (options.given("memory")) {
        const auto memory = options.pair("memory");
        if (!memory || !(memory->first > 0) || memory->second < 0) {
            throw study::BadInput(options.said("memory") + " must be D,V0 with D > 0 and V0 >= 0, both finite");
        }
        falling.memory = {.distance = memory->first, .least_velocity = memory->second};
    }
    return falling;
}

study::Row falling_cells(const std::optional<FallingLaw>& falling) {
    if (!falling) return study::Row(4);
    return {falling->law.mu_k, falling->law.half_velocity, falling->memory.distance, falling->memory.least_velocity};
}

}  // namespace friction
