// Friction that falls with slip in the units of the programs, with the rolling velocity 1: --falling, --memory.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include <rollbem/friction/law.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"

namespace friction {

/// mu/mu_0 of the slip velocity in V mu_0 p0/G, and its memory: distance in a mu_0 p0/G, velocity as that of slip.
struct FallingLaw {
    rollbem::ExponentialFall<double> law;
    rollbem::FrictionMemory<double> memory;

    rollbem::Friction<rollbem::ExponentialFall<>> under(const Eigen::ArrayXd& pressure) const {
        return {law, pressure, memory};
    }
};

/// --falling and --memory; std::nullopt without --falling. Throws BadInput, also for what does not go with them.
std::optional<FallingLaw> read_falling(const study::Options& options);

/// falling_ratio, half_velocity, memory_distance, least_velocity; empty without --falling.
study::Row falling_cells(const std::optional<FallingLaw>& falling);

}  // namespace friction
