// A load that varies over the distance rolled, for time-domain runs. Units: N in N_0, q in a_0, which belongs to N_0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "columns_file.hpp"
#include "options.hpp"

namespace study {

/// N/N_0 = 1 + amplitude sin(2 pi q/length), or linear between the knots of a table.
struct LoadHistory {
    double amplitude = 0, length = 1;
    Numbers knots{}, ratios{};       ///< of a table: ascending places [a_0] and N/N_0 there
    std::vector<Numbers> further{};  ///< other columns of it
    bool breathing = false;          ///< the mesh follows the contact; otherwise it covers the largest one

    double at(double q) const;

    /// Another column at a place.
    double at(double q, const Numbers& column) const;

    /// Largest N/N_0.
    double largest() const;

    /// Whether steps of `dq` [a_0] follow a sine.
    bool resolved(double dq) const;

    /// Where a step has to end: at the first knot between two places, otherwise at the second place.
    double next_stop(double from, double to) const;
};

/// Declares what runs with friction share: --load-sine, --load, --breathing, --from, --dq, --until and --integrator, all
/// for --transient. `load` and `breathing` are what --help says of these besides.
void add_run_options(Options& options, const std::string& load, const std::string& breathing);

/// --load-sine or --load, and --breathing; nothing if the load is constant. The run is `until` long [a_0]. A table may
/// have the columns `further` besides. Throws BadInput.
std::optional<LoadHistory> read_load_history(const Options& options, double until, const std::string& further = "");

}  // namespace study
