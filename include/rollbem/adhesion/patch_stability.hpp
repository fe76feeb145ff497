// Whether a contact patch in full adhesion is stable in time.
#pragma once

#include "../detail/language.hpp"

#include <limits>
#include <vector>

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

}  // namespace rollbem
