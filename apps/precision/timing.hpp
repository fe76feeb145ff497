// Run times of schemes that take turns.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "scene.hpp"
#include "schemes.hpp"

namespace precision {

/// One scheme at one n with the quantities it is measured for.
struct Task {
    Case scheme;
    std::vector<Quantity> quantities;
};

/// Median times [us] of the `wanted` tasks for each of their problems. All take turns, one run each, so that changes in
/// the machine's speed affect all of them. Reports the progress, 0 ... 1, by done(part).
std::vector<std::map<Problem, double>> measure(const std::vector<Task>& tasks, const std::vector<std::size_t>& wanted,
                                               const std::function<void(double part)>& done);

}  // namespace precision
