// The normal pressure on the patches of patch_study.
#pragma once

#include <optional>

#include <Eigen/Core>

#include <rollbem/normal/pressure_grid.hpp>

#include "patches.hpp"
#include "support/options.hpp"

namespace patch {

/// Hertz's pressure, or that of --pressure.
class Pressure {
public:
    /// Throws BadInput, also if an outline has no --pressure.
    explicit Pressure(const study::Options& options);

    /// Mean pressures of a patch's elements [G], which carry the load mu N = G a b with mu = 1. Throws BadInput if less
    /// than half of the load of --pressure lies on them, or if it covers less than nine tenths of them.
    Eigen::ArrayXd on(const Patch& patch) const;

private:
    std::string said_;
    std::optional<rollbem::PressureGrid<double>> grid_;
};

}  // namespace patch
