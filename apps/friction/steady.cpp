#include "steady.hpp"

#include <optional>
#include <vector>

#include "creep_curve.hpp"
#include "plots.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "surface.hpp"

namespace friction {

namespace {

/// The lateral ratio is a loop inside that of the longitudinal one, spin the innermost.
std::vector<CreepPoint> read_points(const study::Options& options) {
    std::vector<std::optional<double>> across{std::nullopt};
    if (options.given("lateral-ratio")) {
        across.clear();
        for (const double ratio : options.numbers("lateral-ratio", study::finite())) across.emplace_back(ratio);
    }
    std::vector<double> spins{0};
    if (options.given("spin-ratio")) spins = options.numbers("spin-ratio", study::finite());
    std::vector<CreepPoint> points;
    for (const double along : options.numbers("creepage-ratio", study::finite())) {
        for (const std::optional<double>& lateral : across) {
            for (const double spin : spins) points.push_back({along, lateral, spin});
        }
    }
    return points;
}

}  // namespace

void run_steady(const study::Options& options, const Pressure& pressure) {
    const bool fits = options.flag("fit-border"), both = options.given("lateral-ratio");
    CreepCurve curve{options, pressure, read_points(options), read_layer(options), read_falling(options)};
    if (options.given("sweep")) curve.sweep = options.choice("sweep", {"up", "down"});
    const std::vector<study::Scene> scenes = study::make_scenes(options, study::Problem::steady);

    std::optional<study::TableFile> tractions;
    if (options.given("tractions"))
        tractions.emplace(options, "tractions", study::has_header(options) ? profile_header() : "");
    Profiles profiles;
    if (tractions || options.given("plot")) curve.profiles = &profiles;

    OtherBranch other;
    if (!curve.sweep.empty() && !both && options.given("plot")) curve.other = &other;

    study::Table table = study::table_of(creep_columns(), scenes, curve.points.size());
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        (fits ? border_rows : element_rows)(curve, scenes[task], task, range, emit);
    };
    table.written = [&] {
        if (tractions) write_profiles(profiles, curve, *tractions);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        return both ? combined_creep(table.columns, rows, curve) : creep_picture(table.columns, rows, curve);
    };
    study::write_table(options, table);
}

}  // namespace friction
