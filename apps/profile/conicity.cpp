#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/vehicle/equivalent_conicity.hpp>

#include "profile.hpp"
#include "support/table.hpp"

namespace profile {

namespace {

using rollbem::EquivalentConicity;
using rollbem::RadiusDifference;
using rollbem::RollingRadii;
using rollbem::Status;

/// A wheelset, Delta r if it has an equilibrium, and why it has none.
struct Wheelset {
    rollbem::WheelsetOnTrack on_track;
    std::optional<RadiusDifference> radii;
    Status status;
};

Wheelset read(const study::Options& options) {
    Wheelset wheelset{read_wheelset(options, read_dimensions(options)), {}, Status::ok};
    for (const Side side : rollbem::WheelsetOnTrack::sides) {
        if (wheelset.on_track.wheel(side).geometry().is_plain()) continue;
        throw study::BadInput("--conicity = true must have round wheels on straight rails of one profile");
    }
    wheelset.radii = radius_difference(wheelset.on_track);
    if (!wheelset.radii) {
        // where Delta r rises, its zero lies beyond what the wheels reach
        const auto difference = [&](double lateral) { return rolling_radii(wheelset.on_track, lateral).difference(); };
        const Status centred = rolling_radii(wheelset.on_track, 0).status;
        wheelset.status = centred != Status::ok                  ? centred
                          : difference(1e-3) > difference(-1e-3) ? Status::beyond_clearance
                                                                 : Status::unstable;
    }
    return wheelset;
}

study::Plot difference_plot(const RadiusDifference& radii) {
    study::Plot plot{.title = "Difference of the rolling radii", .x_label = "y [mm]", .y_label = "Δr [mm]"};
    study::Series& series = plot.series.emplace_back(study::Series{.label = "right less left", .markers = false});
    for (Eigen::Index i = 0; i < radii.lateral().size(); ++i) {
        series.points.emplace_back(1e3 * radii.lateral()[i], 1e3 * radii.difference()[i]);
    }
    return plot;
}

study::Series curve(const std::vector<study::Row>& rows, const char* label, std::size_t column, double unit) {
    study::Series series{.label = label, .markers = rows.size() <= 30};
    for (const study::Row& row : rows) {
        series.points.emplace_back(1e3 * row[0].number().value_or(std::nan("")),
                                   unit * row[column].number().value_or(std::nan("")));
    }
    return series;
}

study::Table conicity_table(const Wheelset& wheelset, const std::vector<double>& amplitudes) {
    study::Table table;
    table.columns = {"amplitude", "tan_gamma", "tan_gamma_linear", "wavelength", "y_min", "y_max", "status"};
    table.rows_of_task.assign(amplitudes.size(), 1);
    table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
        const double amplitude = amplitudes[task];
        EquivalentConicity wave{.status = wheelset.status};
        if (wheelset.radii) wave = equivalent_conicity(*wheelset.radii, amplitude);
        study::Row row{amplitude};
        for (const double value : {wave.tan_gamma, wave.tan_gamma_linear, wave.wavelength, wave.y_min, wave.y_max}) {
            row.push_back(wave.status == Status::ok ? study::Cell(value) : study::Cell());
        }
        row.emplace_back(name(wave.status));
        emit(std::move(row));
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        study::Plot plot{.title = "Equivalent conicity", .x_label = "amplitude [mm]", .y_label = "tan γ_e"};
        plot.series = {curve(rows, "kinematic wave", 1, 1), curve(rows, "harmonic", 2, 1)};
        if (!wheelset.radii) return plot;
        study::Plot left = difference_plot(*wheelset.radii);
        left.below.push_back(std::move(plot));
        return left;
    };
    return table;
}

study::Table radii_table(const Wheelset& wheelset, const std::vector<double>& positions) {
    study::Table table;
    table.columns = {"y", "delta_r", "right_radius", "left_radius", "right_angle", "left_angle"};
    table.rows_of_task.assign(positions.size(), 1);
    table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
        const RollingRadii at = rolling_radii(wheelset.on_track, positions[task]);
        const auto& [left, right] = at.wheels;
        study::Row row{positions[task]};
        for (const double value :
             {at.difference(), right.rolling_radius, left.rolling_radius, right.angle, -left.angle}) {
            row.push_back(at.status == Status::ok ? study::Cell(value) : study::Cell());
        }
        emit(std::move(row));
    };
    table.plot = [](const std::vector<study::Row>& rows) {
        study::Plot plot{.title = "Difference of the rolling radii", .x_label = "y [mm]", .y_label = "Δr [mm]"};
        plot.series = {curve(rows, "right less left", 1, 1e3)};
        study::Plot angles{.title = "Angles of contact", .x_label = "y [mm]", .y_label = "δ [rad]"};
        angles.series = {curve(rows, "right", 4, 1), curve(rows, "left", 5, 1)};
        plot.below.push_back(std::move(angles));
        return plot;
    };
    return table;
}

/// Multiples of a tenth of a millimetre between the ends of what both wheels can reach.
std::vector<double> all_positions(const RadiusDifference& radii) {
    std::vector<double> positions;
    for (double k = std::ceil(1e4 * radii.low()); k <= 1e4 * radii.high(); ++k) positions.push_back(k / 1e4);
    return positions;
}

}  // namespace

void add_conicity_options(study::Options& options) {
    options.group("Equivalent conicity (EN 15302)");
    options.add_flag("conicity",
                     "instead of patches: tan gamma of the free wheelset's kinematic wave over its amplitude, of rigid "
                     "contact without roll");
    options
        .add("amplitude", "LIST", "of the wave [m]",
             "0.001,0.0015,0.002,0.0025,0.003,0.0035,0.004,0.0045,0.005,0.0055,0.006,0.0065,0.007,0.0075,0.008")
        .only_with({"conicity"})
        .not_with("rolling-radii");
    options
        .add_flag("rolling-radii",
                  "radii and angles of contact of both wheels over the lateral position: --shift, or all within the "
                  "clearance")
        .only_with({"conicity"});
    options.not_with({"load", "shear-modulus", "poisson"}, "conicity");
}

void study_conicity(const study::Options& options) {
    const bool of_radii = options.flag("rolling-radii");
    if (!of_radii) options.ignored("shift", "with --conicity unless --rolling-radii is given");
    const Wheelset wheelset = read(options);
    if (of_radii) {
        std::vector<double> positions{0};
        if (options.given("shift")) {
            positions = options.numbers("shift", study::between(-0.1, 0.1));
        } else if (wheelset.radii) {
            positions = all_positions(*wheelset.radii);
        }
        study::write_table(options, radii_table(wheelset, positions));
        return;
    }
    const std::optional<double> nonlinearity = wheelset.radii ? conicity_nonlinearity(*wheelset.radii) : std::nullopt;
    options.note("nonlinearity (tan gamma at 4 mm - at 2 mm)/2 mm [1/m]: " +
                 (nonlinearity ? study::Cell(*nonlinearity).text(6) : "none, as one of them has no wave"));
    const study::Rule at_least_a_micrometre{[](double value) { return value >= 1e-6 && std::isfinite(value); },
                                            "be positive and finite, and at least 1e-6 m"};
    const std::vector<double> amplitudes = options.numbers("amplitude", at_least_a_micrometre);
    study::write_table(options, conicity_table(wheelset, amplitudes));
}

}  // namespace profile
