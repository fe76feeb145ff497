// Hertz's line contact under a load that varies. Lengths in a_0, the half-length under N_0.
#pragma once

#include <optional>

#include <rollbem/normal/hertz_load.hpp>

#include "support/load_history.hpp"
#include "support/options.hpp"

namespace friction {

/// --load-sine or --load, and --breathing; nothing if the load is constant. The run is `until` long [a_0]. Throws
/// BadInput.
std::optional<study::LoadHistory> read_load(const study::Options& options, double until);

/// Half-length of a mesh that covers the contact during the whole run [a_0].
double largest_half_length(const study::LoadHistory& history);

/// Hertz's contact with a_0 = 1 and p_0 = 1 under N_0, on the mesh that the history needs.
rollbem::HertzLoad<double> hertz_load(const study::LoadHistory& history, const rollbem::Mesh<double>& mesh);

}  // namespace friction
