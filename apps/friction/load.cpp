#include "load.hpp"

#include <cmath>

#include <rollbem/normal/hertz.hpp>

#include "support/errors.hpp"

namespace friction {

std::optional<study::LoadHistory> read_load(const study::Options& options, double until) {
    std::optional<study::LoadHistory> history = study::read_load_history(options, until);
    if (history && history->breathing && options.text("kernel") != "plane") {
        throw study::BadInput("--kernel = " + options.text("kernel") +
                              " must be plane with --breathing: only that kernel knows other half-lengths");
    }
    return history;
}

double largest_half_length(const study::LoadHistory& history) { return std::sqrt(history.largest()); }

rollbem::HertzLoad<double> hertz_load(const study::LoadHistory& history, const rollbem::Mesh<double>& mesh) {
    const auto line = rollbem::HertzLine<double>::dimensionless();
    return history.breathing ? rollbem::HertzLoad<double>::breathing(line, mesh)
                             : rollbem::HertzLoad<double>::fixed(line, mesh, largest_half_length(history));
}

}  // namespace friction
