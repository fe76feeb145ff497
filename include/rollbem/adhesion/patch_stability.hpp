// Whether a contact patch in full adhesion is stable in time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "../assembly/patch_shapes.hpp"
#include "../assembly/patch_system.hpp"
#include "../status.hpp"
#include "stability.hpp"
#include "stability_verdict.hpp"

namespace rollbem {

/// The verdict on a patch by its parts, whose 2 n m eigenvalues are those of the whole system. Two halves cost a
/// quarter of the whole.
template <class Scalar>
StabilityVerdict judge_stability(const std::vector<PatchPart<Scalar>>& parts) {
    StabilityVerdict all{.spectral_abscissa = -std::numeric_limits<double>::infinity(), .status = Status::ok};
    for (const PatchPart<Scalar>& part : parts) all = all + judge_stability(part.system);
    return all;
}

/// The worst verdict on the nodes of a set of shapes, each judged by its parts: the largest of each number. The shapes
/// between two nodes are taken to behave as these do.
template <class Scalar>
StabilityVerdict judge_stability(const PatchShapes<Scalar>& shapes) {
    StabilityVerdict worst{.spectral_abscissa = -std::numeric_limits<double>::infinity(), .status = Status::ok};
    for (std::size_t node = 0; node < shapes.node_count(); ++node) {
        const StabilityVerdict own = judge_stability(shapes.parts(node));
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
