// Bodies of adhesion/stability.hpp. Internal.
#pragma once

#include "../stability.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "../../status.hpp"
#include "../../system/rolling_system.hpp"

namespace rollbem {

template <class Shapes>
requires requires(const Shapes& shapes) { shapes.subsystems(shapes.node_count()); }
StabilityVerdict judge_stability(const Shapes& shapes) {
    StabilityVerdict worst{.spectral_abscissa = -std::numeric_limits<double>::infinity(), .status = Status::ok};
    for (std::size_t node = 0; node < shapes.node_count(); ++node) {
        const StabilityVerdict own = judge_stability(shapes.subsystems(node));
        worst.n = own.n;
        worst.decay_proved = (node == 0 || worst.decay_proved) && own.stable();
        worst.unstable_count = (std::max)(worst.unstable_count, own.unstable_count);
        worst.settled_unstable_count = (std::max)(worst.settled_unstable_count, own.settled_unstable_count);
        worst.uncertain_count = (std::max)(worst.uncertain_count, own.uncertain_count);
        worst.spectral_abscissa = (std::max)(worst.spectral_abscissa, own.spectral_abscissa);
        if (worst.status == Status::ok) worst.status = own.status;
    }
    return worst;
}

}  // namespace rollbem
