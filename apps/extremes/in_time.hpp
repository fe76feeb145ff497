// What cases in full adhesion over time share: steps from rest, and the slowest mode.
#pragma once

#include <utility>

#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/transient.hpp>

#include "cases.hpp"

namespace extremes {

/// Force per width after `count` steps of dq [m] at unit creepage, from rest.
inline Outcome roll(const rollbem::AdhesionModel<>& model, double dq, int count) {
    auto now = model.at_rest(), next = now;
    auto workspace = model.workspace();
    Outcome outcome;
    for (int k = 0; k < count; ++k) {
        const rollbem::AdhesionStep<> result = model.advance(now, dq, 1.0, next, workspace);
        outcome.value = result.force_per_width;
        outcome.told = told_by(result.status);
        std::swap(now, next);
    }
    return outcome;
}

/// The spectral abscissa of a scheme that must be stable.
inline Outcome slowest_mode(const rollbem::RollingSystem<double>& system, double reference, double bound) {
    const auto result = rollbem::solve_stability<double>(system, {.settle_signs = true, .condition = true});
    Outcome outcome = compare(result.spectral_abscissa, reference, bound, told_by(result.status));
    outcome.condition = *result.cond_G;
    if (!rollbem::judge_stability(result).stable()) outcome.told = "not certainly stable";
    return outcome;
}

}  // namespace extremes
