// A load that varies over the distance rolled, and the ellipse under it, for runs of patch_study in time.
#pragma once

#include <optional>

#include "support/load_history.hpp"
#include "support/options.hpp"

namespace patch {

/// Semi-axes over those under N_0.
struct AxisRatios {
    double a, b;
};

struct Load : study::LoadHistory {
    /// Those of a table, else by Hertz the cube root of the load.
    AxisRatios axes(double q) const;

    /// Of a mesh that covers the contact during the whole run.
    AxisRatios largest_axes() const;
};

/// --load-sine or --load, and --breathing; nothing if the load is constant. The run is `until` long [a_0]. Throws
/// BadInput.
std::optional<Load> read_load(const study::Options& options, double until);

}  // namespace patch
