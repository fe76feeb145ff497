// The options of friction_study, and the scenes they ask for.
#include <algorithm>
#include <string>
#include <vector>

#include <rollbem/normal/pressure.hpp>

#include "steady.hpp"
#include "support/input.hpp"
#include "support/non_steady.hpp"

namespace friction {

namespace {

/// The options of steady rolling and of the time domain: creepages, pressure, a layer and the law of friction.
void add_contact_options(study::Options& options) {
    options.set_default("mesh", "cosine");
    options.set_default("alpha-L", "0.5");
    options.set_default("alpha-T", "0.5");
    options.add("creepage-ratio", "LIST",
                "creepage ratio delta = xi G/(2 (1-nu) mu p0) [dimensionless], any finite: Carter's contact slides as "
                "a whole from 1 on; with --transient one constant value, which must be given",
                "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1");
    study::add_force(options, history_columns);
    options.add_input("pressure",
                      "CSV file of the normal pressure, with the columns x_over_a [dimensionless], pressure [any "
                      "unit]: linear between its rows, zero before the first and after the last; two rows at one "
                      "x_over_a make a jump; Hertz's pressure without it");
    options.add("lateral-ratio", "LIST",
                "lateral creepage ratio eta G/(2 (1-nu) mu p0) [dimensionless], any finite, for friction in both "
                "directions; with --transient one value, constant; friction along x alone without it");
    options
        .add("spin-ratio", "LIST",
             "spin ratio phi a G/(2 (1-nu) mu p0) [dimensionless] of a rigid lateral slip phi x, any finite; with "
             "--transient one value, constant; no spin without it")
        .only_with({"lateral-ratio"});
    options.add("layer", "L", "compliance of an elastic layer between the bodies [a/G], 0 or more", "0");
    study::add_friction_laws(options);
}

/// The options of steady rolling alone: sweeps, tractions and the exact border of stick.
void add_steady_options(study::Options& options) {
    options
        .add("sweep", "up|down",
             "order of the creepage ratios in which each solution starts from the one before, separately for each "
             "lateral ratio and spin; each starts from rest without it")
        .only_with(study::friction_law_options())
        .not_with("transient");
    options
        .add_table(
            "tractions",
            "CSV file of the tractions, one row per element of every scheme and creepage, with FILE.toml next to "
            "it; none without it")
        .not_with("transient");
    options
        .add_flag("fit-border", "exact border between slip and stick, by series; n elements are used where that fails")
        .not_with("transient");
    for (const std::string& law : study::friction_law_options()) {
        options.not_with({"fit-border"}, law, ", which is solved by elements");
    }
    options.not_with({"mesh", "edges", "method", "derivative", "alpha-L", "alpha-T", "alpha"}, "fit-border",
                     ", which needs no elements");
    options.not_with({"sweep", "fit-border"}, "force");
    options.not_with({"lateral-ratio", "spin-ratio", "layer"}, "fit-border",
                     ", which is for one direction and no layer");
}

void add_rolling_options(study::Options& options) {
    options.add_flag("transient", "rolling in time, one row per step, in place of steady rolling");
    options.add("shift", "W", "rigid shift [mu p0 a/G] before the contact rolls, any finite; none without it")
        .only_with({"transient"});
    study::add_run_options(options, history_columns, "transient", "",
                           "mesh that follows the half-length of the contact, with --kernel plane; without it the mesh "
                           "covers the largest contact");
    options.not_with({"from"}, "shift", ", which starts from rest");
    study::Options::Added{options, "lambda"}.only_with(
        {"transient"}, ": a steady problem builds no G, the only matrix lambda acts on");
    study::add_unchecked(options).only_with({"transient"});
}

// --- scenes --------------------------------------------------------------------------------------------------------

double read_layer(const study::Options& options) {
    const double layer = options.number("layer", study::not_negative());
    const bool analytic = options.given("derivative") && options.text("derivative") == "analytic";
    const bool closed = options.text("method") == "galerkin" && options.text("quadrature") == "exact";
    options.require(
        layer == 0 || !analytic || closed, "derivative",
        "be fd with --layer: the layer's displacement jumps with the traction, and only differences of it exist");
    return layer;
}

/// The title of a Line.
std::string scene_in_title(const study::Options& options) {
    std::string title;
    const auto say = [&](const char* name, const std::string& before, const std::string& between = "",
                         const std::string& after = "") {
        if (!options.given(name)) return;
        const std::string value = options.text(name);
        const std::size_t comma = value.find(',');
        title += ", " + before + value.substr(0, comma);
        if (comma != std::string::npos) title += between + value.substr(comma + 1) + after;
    };
    if (options.given("pressure")) title += ", pressure of a table";
    if (options.flag("transient")) {
        const std::string delta = options.given("lateral-ratio") ? "δ_x = " : "δ = ";
        say("creepage-ratio", delta);
        say("sine", delta, " sin(", " q/a)");
        say("lateral-ratio", "δ_y = ");
        say("spin-ratio", "δ_φ = ");
        say("shift", "shift ");
        say("load-sine", "N/N_0 = 1 + ", " sin(2π q/", ")");
        if (options.given("load")) title += ", load of a table";
    }
    title += study::friction_law_title(options);
    say("layer", "layer ");
    return title;
}

Line read_line(const study::Options& options) {
    return {options.given("lateral-ratio"), read_pressure(options), read_layer(options),
            study::read_friction_law(options), scene_in_title(options)};
}

/// The points in the order of three loops: the longitudinal ratio outermost, then the lateral ratio, spin innermost.
std::vector<CreepPoint> read_points(const study::Options& options) {
    std::vector<std::optional<double>> across{std::nullopt};
    if (options.given("lateral-ratio")) {
        const std::vector<double> lateral = options.numbers("lateral-ratio", study::finite());
        across.assign(lateral.begin(), lateral.end());
    }
    std::vector<double> spins{0};
    if (options.given("spin-ratio")) spins = options.numbers("spin-ratio", study::finite());
    std::vector<double> ratios{0};  // of a force they are found
    if (!options.given("force")) ratios = options.numbers("creepage-ratio", study::finite());
    std::vector<CreepPoint> points;
    for (const double along : ratios) {
        for (const std::optional<double>& lateral : across) {
            for (const double spin : spins) points.push_back({along, lateral, spin});
        }
    }
    return points;
}

}  // namespace

Pressure read_pressure(const study::Options& options) {
    if (!options.given("pressure")) {
        const rollbem::HertzLine::Pressure hertz;
        return {hertz, hertz, true};
    }
    const study::Rule within = study::between(-1, 1);
    const std::vector<study::Numbers> points = study::read_columns(
        options, "pressure", "x_over_a,pressure", "", [&](const auto& read, const std::string& where) {
            if (!within.holds(read[0].back())) throw study::BadInput(where + ": x_over_a must " + within.text);
            study::require_order(read[0], "x_over_a", where);
        });
    options.require(!points[0].empty(), "pressure", "have at least one row below its header");
    const auto table = study::blame(options.said("pressure"), [&] {
        return rollbem::PressureTable(study::array(points[0]), study::array(points[1]));
    });
    const double scale = mu_N / table.integral();
    return {[=](double x_over_a) { return scale * table(x_over_a); },
            [=](const rollbem::Mesh<double>& mesh) { return Eigen::ArrayXd(scale * table(mesh)); }, false};
}

void add_options(study::Options& options) {
    add_contact_options(options);
    add_steady_options(options);
    add_rolling_options(options);
    study::offer_schemes(options, methods);
}

Curve read_curve(const study::Options& options) {
    Curve curve{.line = read_line(options),
                .scenes = study::make_scenes(options, study::Problem::steady, methods),
                .points = read_points(options),
                .timed = study::has_times(options),
                .by_border = options.flag("fit-border"),
                .keeps_tractions = options.given("plot") || options.given("tractions")};
    if (options.given("force")) curve.force = options.number("force", study::finite());
    if (options.given("sweep")) curve.sweep = options.choice("sweep", {"up", "down"});
    return curve;
}

Scenario read_scenario(const study::Options& options) {
    Scenario scenario{.line = read_line(options),
                      .scenes = study::make_non_steady_scenes(options, methods),
                      .run = study::read_run(options, history_columns),
                      .creepage_swept = options.given("sine") || options.given("ramp"),
                      .creepage_constant = options.given("creepage-ratio") || options.given("step")};
    const study::History& imposed = scenario.run.imposed;
    if (!imposed.has("creepage_ratio") && !imposed.has("force") && !imposed.has("shift")) {
        options.require(
            !options.given("history"), "history",
            "have a column creepage_ratio, force or shift, unless an option of one of these names is given");
        throw study::BadInput(
            "one of --creepage-ratio, --step, --ramp, --sine, --history, --force and --shift must be given with "
            "--transient");
    }
    scenario.creepage_swept = scenario.creepage_swept || imposed.values("creepage_ratio").size() > 1;
    scenario.line.both = imposed.has("lateral_ratio");
    if (imposed.has("spin_ratio") && !scenario.line.both) {
        throw study::BadInput("the column spin_ratio must go with lateral_ratio");
    }
    if (imposed.has("speed")) {
        if (!scenario.line.law)
            throw study::BadInput("the column speed must go with " + study::friction_law_flags() +
                                  ": nothing else depends on it");
        const study::Numbers& speeds = imposed.values("speed");
        const double least = *std::min_element(speeds.begin(), speeds.end());
        options.require(least > 0 && imposed.at("speed", 0, true) > 0, "history",
                        "have positive speeds from q_over_a = 0 on");
    }
    if (scenario.run.breathing && options.text("kernel") != "plane") {
        throw study::BadInput("--kernel = " + options.text("kernel") +
                              " must be plane with --breathing: only that kernel knows other half-lengths");
    }
    return scenario;
}

}  // namespace friction
