// A load that varies over the distance rolled, for runs in time. Units of the columns: N in N_0, q and lengths in a_0,
// the half-length under N_0.
#pragma once

#include <optional>
#include <vector>

#include <rollbem/normal/hertz_load.hpp>

#include "support/options.hpp"

namespace friction {

/// N/N_0 = 1 + amplitude sin(2 pi q/length), or linear between the knots of a table.
struct LoadHistory {
    double amplitude = 0, length = 1;
    std::vector<double> knots{}, ratios{};  ///< of a table: ascending places [a_0] and N/N_0 there
    bool breathing = false;  ///< the mesh follows the half-length; otherwise it covers the largest contact

    double at(double q) const;

    /// Whether steps of `dq` [a_0] follow a sine.
    bool resolved(double dq) const;

    /// Half-length of the mesh that covers the contact during the whole run [a_0].
    double largest_half_length() const;

    /// Where a step has to end: at the first knot between two places, otherwise at the second place.
    double next_stop(double from, double to) const;
};

/// --load-sine or --load, and --breathing; nothing if the load is constant. The run is `until` long [a_0]. Throws
/// BadInput.
std::optional<LoadHistory> read_load(const study::Options& options, double until);

/// Hertz's contact with a_0 = 1 and p_0 = 1 under N_0, on the mesh that the history needs.
rollbem::HertzLoad<double> hertz_load(const LoadHistory& history, const rollbem::Mesh<double>& mesh);

}  // namespace friction
