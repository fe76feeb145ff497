// A load that varies over the distance rolled, and the ellipse under it, for runs of patch_study in the time domain.
#pragma once

#include <optional>
#include <utility>

#include "support/load_history.hpp"
#include "support/options.hpp"

namespace patch {

/// Semi-axes over those under N_0.
struct AxisRatios {
    double a, b;
};

class Load : public study::LoadHistory {
public:
    explicit Load(study::LoadHistory history) : study::LoadHistory(std::move(history)) {}

    /// Those of a table, else by Hertz the cube root of the load.
    AxisRatios axes(double q) const;

    /// Of a mesh that covers the contact during the whole run.
    AxisRatios largest_axes() const;

    /// Least and largest a/b over that under N_0, which lies between them.
    std::pair<double, double> shapes() const;

private:
    bool has_axes() const { return !further.empty() && !further[0].empty(); }
};

/// --load-sine or --load, and --breathing; nothing if the load is constant. The run is `until` long [a_0]. Throws
/// BadInput.
std::optional<Load> read_load(const study::Options& options, double until);

}  // namespace patch
