#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include <rollbem/closed_form/carter.hpp>

#include "rolling.hpp"
#include "steady.hpp"
#include "support/non_steady.hpp"

namespace friction {

namespace {

// --- contacts ------------------------------------------------------------------------------------------------------

// The ratio b/a falls as the load grows on a mesh that breathes. `system` has one direction or both.
template <class System>
void require_plane_model(const study::Scene& scene, const study::Run& run, const System& system, const char* term) {
    const double longest = largest_half_length(run);
    if (longest < system.half_length_limit()) return;
    const double least = scene.contact.aspect() * longest / system.half_length_limit();
    throw study::BadInput("--aspect = " + study::Cell(scene.contact.aspect()).text(6) + " must be larger than " +
                          study::Cell(least).text(4) + " with --breathing, as a grows to " +
                          study::Cell(longest).text(4) + " a_0: Lambda = ln(4b/a) " + term +
                          " must be positive, or the plane model itself is unstable in time");
}

rollbem::FrictionModel make_contact(const Scenario& scenario, const study::Scene& scene) {
    const Line& line = scenario.line;
    const study::Run& run = scenario.run;
    const bool breathes = run.breathing, varies = run.load_varies();
    const double half_length = varies && !breathes ? largest_half_length(run) : 1;
    System along = line.system(scene, Line::Direction::longitudinal, true, half_length);
    std::optional<System> across = line.lateral_system(scene, true, half_length);
    if (run.checked) study::require_steppable(scene, along);
    if (breathes && !along.log_strength()) {
        throw study::BadInput(
            "--breathing needs equations that hold at points and a kernel without a layer: --method collocation, nodes "
            "or knothe-bc, lambda = 1, no --layer");
    }
    if (run.checked && across) study::require_steppable(scene, *across);
    if (breathes && across) require_plane_model(scene, run, rollbem::ElementSystem(along, *across), "- nu");
    if (breathes && !across) require_plane_model(scene, run, along, "+ nu/(1-nu)");
    // the law has the pressures of the largest load; the load that a run starts under is in its state
    const Eigen::ArrayXd means = varies
                                     ? hertz_load(run, *scene.mesh).at(half_length * half_length * mu_N).normal_pressure
                                     : line.pressure(*scene.mesh);
    return line.contact(scene, along, across, means, rollbem::unchecked, run.integrator, half_length);
}

/// The smallest half-length [a_0] that a fixed mesh resolves: three elements long in the middle of it.
double least_half_length(const study::Run& run, const rollbem::Mesh<double>& mesh) {
    const Eigen::ArrayXd edges = mesh.edges();
    const Eigen::Index count = std::min<Eigen::Index>(3, edges.size() - 1), first = (edges.size() - 1 - count) / 2;
    return largest_half_length(run) * (edges[first + count] - edges[first]) / 2 * (1 - 1e-12);
}

Rolling make_rolling(const Scenario& scenario, const study::Scene& scene) {
    const study::Run& run = scenario.run;
    Rolling rolling{.contact = make_contact(scenario, scene),
                    .run = run,
                    .creepage_unit = creepage_unit(scene),
                    .spin_unit = creepage_unit(scene),
                    .full = mu_N * scene.contact.width()};
    if (!run.load_varies()) return rolling;
    if (!run.breathing) {
        rolling.fits = [&run, least = least_half_length(run, *scene.mesh)](double q) {
            const double ratio = run.load_ratio(q);
            return ratio == 0 || std::sqrt(ratio) >= least;
        };
    }
    rolling.load_at = [&run, hertz = hertz_load(run, *scene.mesh)](double q) {
        rollbem::NormalLoad normal = hertz.at(hertz.breathes() ? mu_N : 0);
        hertz.set(run.load_ratio(q) * mu_N, normal);  // a step refuses what is no load
        return normal;
    };
    return rolling;
}

// --- rows ----------------------------------------------------------------------------------------------------------

struct TimeRow {
    const Scenario& scenario;
    const Line& line;
    const study::Scene& scene;
    const Moment& moment;
    double full;  ///< force of full sliding

    CreepPoint ratios() const {
        if (moment.shifted) return {0, line.both ? std::optional(0.0) : std::nullopt};
        CreepPoint point = scenario.at(moment.q);
        if (scenario.run.by_force()) point.longitudinal = moment.creepage.longitudinal / creepage_unit(scene);
        return point;
    }
    double load_ratio() const { return scenario.run.load_ratio(moment.q); }
    double force_ratio() const { return 0 - moment.step.force.longitudinal / full; }  // 0 without load, not -0
    std::optional<double> exact() const {
        const bool holds =
            moment.shifted && line.carter() && !scenario.run.load_varies() && study::plane_model_decays(scene.contact);
        if (!holds) return std::nullopt;
        return rollbem::cattaneo_force_ratio(moment.shift.longitudinal, scene.contact.poisson_ratio(),
                                             scene.contact.aspect());
    }
    study::Cell if_both(double value) const { return line.both ? study::Cell(value) : study::Cell(); }
};

const study::Sheet<TimeRow>& time_sheet() {
    using R = TimeRow;
    static const study::Sheet<TimeRow> columns{
        "",
        study::joined<study::Column<R>>(
            {{"q_over_a", "distance rolled q/a_0; the first row is at q = dq, with --shift one at q = 0 comes before",
              [](const R& r) { return r.moment.q; }},
             {"creepage_ratio",
              "creepage ratio at q, given (linear over a step, with implicit-euler its end value) or found for --force",
              [](const R& r) { return r.ratios().longitudinal; }},
             {"shift", "rigid shift of this row [mu p0 a/G], given or found for --force",
              [](const R& r) { return r.moment.shift.longitudinal; }},
             {"force_ratio", "longitudinal force -F_x/(mu N_0)", if_valid(&R::force_ratio)},
             {"stick_count", "number of elements that stick",
              if_valid([](const R& r) { return r.moment.step.stick_count; })},
             {"rounds", "number of Newton or active-set steps of all solutions of a step, two with sdirk2",
              if_computed([](const R& r) { return r.moment.rounds; })},
             {"slip_work", "work of slip since the start [mu N mu p0 a/G]",
              if_valid([](const R& r) { return r.moment.slip_work / r.full; })},
             {"exact", "Cattaneo's force_ratio after a shift from rest (plane model of this b/a), where it holds",
              if_valid(&R::exact)},
             {"relative_error", "force_ratio/exact - 1",
              if_valid([](const R& r) { return relative_error(r.force_ratio(), r.exact()); })},
             {"complementarity_residual", "largest violation, as in steady rolling",
              if_computed([](const R& r) { return r.moment.step.complementarity_residual; })},
             {"path_points", "number of points of the fallback, as in steady rolling",
              if_valid([](const R& r) { return study::Cell(r.moment.step.path_points); })},
             {"status",
              "ok, with --unchecked unchecked; unresolved, with empty results, with fewer than six steps in a period "
              "of --sine (OMEGA --dq > 1) or of --load-sine (2 pi --dq > LENGTH), or a contact shorter than three "
              "elements of a fixed mesh; the reason where a step failed; after_failure behind it",
              [](const R& r) { return r.moment.status; }},
             {"method, derivative, mesh, n, alpha_L, alpha_T, lambda", "scheme, as in its options"},
             {"integrator", "integrator, as in its option",
              [](const R& r) { return study::word(r.scenario.run.integrator); }},
             {"lateral_ratio", "lateral creepage ratio at q", [](const R& r) { return r.ratios().lateral; }},
             {"load_ratio", "load N/N_0", &R::load_ratio},
             {"half_length_ratio", "half-length a/a_0 by Hertz", [](const R& r) { return std::sqrt(r.load_ratio()); }},
             {"lateral_force_ratio", "lateral force -F_y/(mu N_0)",
              if_valid([](const R& r) { return r.if_both(0 - r.moment.step.force.lateral / r.full); })},
             {"spin_ratio", "spin ratio phi a_0 G/(2 (1-nu) mu p0) at q",
              [](const R& r) { return r.if_both(r.ratios().spin); }},
             {"moment_ratio", "moment -M_z/(mu N_0 a_0)",
              if_valid([](const R& r) { return r.if_both(0 - r.moment.step.force.moment / r.full); })},
             {"creep_work",
              "work of the creepages -int F.xi dq since the start [mu N mu p0 a/G], from the forces at both ends of a "
              "step (at its end with implicit-euler)",
              if_valid([](const R& r) { return r.moment.creep_work / r.full; })},
             {"elastic_energy", "elastic energy [mu N mu p0 a/G]",
              if_valid([](const R& r) { return r.moment.elastic_energy / r.full; })},
             {"jump_work",
              "elastic energy that jumps of the tractions have released [mu N mu p0 a/G], as under " +
                  study::friction_law_flags(),
              if_valid([](const R& r) { return r.moment.jump_work / r.full; })}},
            law_columns<R>()),
        study::settings};
    return columns;
}

// --- pictures ------------------------------------------------------------------------------------------------------

/// The forces over the distance, with the load if it changes; in a second panel over the creepage if that changes.
study::Picture force_in_time(const study::Records& rows, const Scenario& scenario) {
    const bool lateral = scenario.line.both, load_changes = scenario.run.load_varies();
    const bool carter = scenario.line.carter() && !lateral && !load_changes;
    const double end = scenario.run.until();
    const auto add = [&](study::Plot& plot, const char* x, const char* y, const std::string& prefix) {
        time_sheet().draw(plot, rows, {.x = x, .y = y, .prefix = prefix});
    };
    study::Plot plot{.title = "Rolling with friction" + scenario.line.title,
                     .x = {.label = "distance rolled q/a", .range = study::PlotRange{0, end}},
                     .y = {force_label(scenario.line.law.has_value(), "-F", load_changes ? "N_0" : "N")}};
    if (rows.rows.empty()) return {plot};  // of a shard
    if (scenario.run.by_force()) {         // what is found is the creepage
        plot.y.label = "creepage ratio δ";
        add(plot, "q_over_a", "creepage_ratio", "");
        return {plot};
    }
    add(plot, "q_over_a", "force_ratio", lateral ? "longitudinal" : "");
    if (lateral) add(plot, "q_over_a", "lateral_force_ratio", "lateral");
    if (load_changes) {
        add_series(plot, rows,
                   {.x = "q_over_a", .y = "load_ratio", .prefix = "load N/N_0", .look = study::Look::exact});
    }
    if (scenario.creepage_swept) {
        study::Plot loop{.x = {"creepage ratio δ"}, .y = {plot.y.label}};
        add(loop, "creepage_ratio", "force_ratio", "");
        loop.title = "Hysteresis";
        double most = 0;
        for (const double ratio : rows.numbers("creepage_ratio")) most = std::max(most, std::abs(ratio));
        if (carter) loop.series.push_back(carter_curve(-most, most));
        if (!load_changes) loop.y.range = force_range(loop);
        return {plot, loop};
    }
    if (carter && scenario.creepage_constant) {
        const double force = rollbem::carter_force_ratio(scenario.at(end).longitudinal);
        plot.series.push_back({"Carter, steady", study::Look::exact, {{0, force}, {end, force}}});
    }
    return {plot};
}

}  // namespace

std::string transient_help() { return time_sheet().help(); }

study::Table transient_table(const Scenario& scenario) {
    const auto make = [&](const study::Scene& scene) {
        try {
            return make_rolling(scenario, scene);
        } catch (const study::BadInput&) {
            throw;
        } catch (const std::invalid_argument&) {  // all else has been checked with the options
            throw study::BadInput("--aspect = " + study::aspect_cell(scene.contact).text() + " and --layer = " +
                                  study::Cell(scenario.line.layer).text() + " must be such that G and G' are finite");
        }
    };
    const auto row = [&](const study::Scene& scene, const Moment& moment) {
        return TimeRow{scenario, scenario.line, scene, moment, mu_N * scene.contact.width()};
    };
    study::Table table = rolling_table(time_sheet(), scenario.scenes, scenario.run, make, row);
    table.plot = [&](const study::Records& rows) { return force_in_time(rows, scenario); };
    return table;
}

}  // namespace friction
