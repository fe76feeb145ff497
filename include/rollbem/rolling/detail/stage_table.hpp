// The stages of time integrators. Internal.
#pragma once

#include <numbers>
#include <optional>

#include "../run.hpp"
#include "stage.hpp"

namespace rollbem {

namespace detail {

/// Called by a stage table that must not compile, because this function is not constexpr.
void a_scheme_has_one_stage_of_the_whole_step_or_two_with_a_part_from_1_minus_1_over_sqrt_2_to_1();

/// The stages of a step, solved one by one. Each stage takes `part` of the step, gamma of Hairer & Wanner (II, IV.6).
/// The last stage ends with the step; a stage before it ends after its own part, and the last one then starts from U +
/// (1 - part)/part (U_1 - U). A step's slip is this ratio times the slip of the first stage plus the slip of the
/// second.
///
/// Invariant: one stage has part = 1, and two have 1 - 1/sqrt(2) <= part < 1. It follows that
///
/// - tractions at the end of a step are a stage's tractions, which friction bounds;
/// - every slip counts with a positive weight;
/// - loads and lengths are never extrapolated;
/// - e^w becomes 1/(1 - w) or (1 + (1 - 2 part) w)/(1 - part w)^2, which are L-stable.
class StageTable {
public:
    consteval StageTable(int count, double part) : count_(count), part_(part) {
        const bool possible = count == 1 ? part == 1 : count == 2 && part >= 1 - std::numbers::sqrt2 / 2 && part < 1;
        if (!possible) {
            a_scheme_has_one_stage_of_the_whole_step_or_two_with_a_part_from_1_minus_1_over_sqrt_2_to_1();
        }
    }

    int count() const { return count_; }
    double part() const { return part_; }
    /// The place of a stage, counted from 1.
    StagePlace place(int stage) const { return {part_, stage == count_ ? 1.0 : part_, stage == 2}; }

private:
    int count_;
    double part_;
};

/// One stage of the whole step.
inline constexpr StageTable single_stage(1, 1);

/// The stages of an integrator; empty for matrix_exponential, which has none.
inline std::optional<StageTable> stage_table(Integrator integrator) {
    switch (integrator) {
        case Integrator::implicit_euler: return single_stage;
        case Integrator::sdirk2: return StageTable(2, 1 - std::numbers::sqrt2 / 2);
        case Integrator::matrix_exponential: break;
    }
    return std::nullopt;
}

}  // namespace detail

}  // namespace rollbem
