#include "steady.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <rollbem/closed_form/carter.hpp>

#include "support/timing.hpp"

namespace friction {

namespace {

// --- rows ----------------------------------------------------------------------------------------------------------

/// A row of the table of forces or, with an element i, of the table of tractions.
struct CreepRow {
    const Curve& curve;
    const Line& line;
    const study::Scene& scene;
    CreepPoint point;
    const Solution& of;
    Eigen::Index i = 0;

    bool ok() const { return of.status == "ok"; }
    bool carter() const { return line.carter() && point.spin == 0; }
    double force_ratio() const { return ok() ? 0 - of.step.force.longitudinal / of.full : std::nan(""); }
    double lateral_force_ratio() const { return ok() ? 0 - of.step.force.lateral / of.full : std::nan(""); }
    double tangent_ratio(double tangent) const { return -tangent * creepage_unit(scene) / of.full; }
    study::Cell if_both(double value) const { return line.both ? study::Cell(value) : study::Cell(); }

    /// The force by a closed form where there is one: Carter's, along the creepage where nu = 0, and in either
    /// direction alone.
    struct Exact {
        std::optional<double> longitudinal{}, lateral{};
    };
    Exact exact() const {
        using rollbem::carter_force_ratio;
        if (!carter() || std::isnan(point.longitudinal)) return {};
        const double nu = scene.contact.poisson_ratio(), along = point.longitudinal, across = point.lateral.value_or(0);
        if (!line.both) return {carter_force_ratio(along), std::nullopt};
        if (across == 0) return {carter_force_ratio(along), 0.0};
        // the ratio is in units of the longitudinal compliance 1 - nu; across it is 1
        if (along == 0) return {0.0, carter_force_ratio((1 - nu) * across)};
        if (nu != 0) return {};
        const double size = std::hypot(along, across), force = carter_force_ratio(size);
        return {force * along / size, force * across / size};
    }
};

template <class Value>
auto if_ok(const Value& value) {
    return study::where(&CreepRow::ok, value);
}

const study::Sheet<CreepRow>& creep_sheet() {
    using R = CreepRow;
    static const study::Sheet<CreepRow> columns{
        "method, derivative",
        study::joined<study::Column<R>>(
            {{"mesh", "mesh of the scheme; fitted where --fit-border has an exact solution",
              [](const R& r) { return r.of.mesh_name; }},
             {"n", "number of elements"},
             {"alpha_L", "positions of the points of the scheme; empty with --fit-border",
              [](const R& r) { return r.of.alpha_L; }},
             {"alpha_T", "", [](const R& r) { return r.of.alpha_T; }},
             {"creepage_ratio", "creepage ratio delta = xi G/(2 (1-nu) mu p0), given or found for --force",
              [](const R& r) { return r.point.longitudinal; }},
             {"force_ratio", "longitudinal force -F_x/(mu N)", &R::force_ratio},
             {"exact", "Carter's force_ratio, where it holds", [](const R& r) { return r.exact().longitudinal; }},
             {"relative_error", "force_ratio/exact - 1",
              [](const R& r) { return relative_error(r.force_ratio(), r.exact().longitudinal); }},
             {"stick_count", "number of elements that stick", [](const R& r) { return r.of.step.stick_count; }},
             {"rounds", "number of Newton steps; for one direction steps of an active set",
              [](const R& r) { return r.of.step.rounds; }},
             {"complementarity_residual",
              "largest violation of |p| <= mu p_n (over mu p0) and of the direction of slip (over |xi|)",
              [](const R& r) { return r.of.step.complementarity_residual; }},
             {"time_us", std::string("time of the solution [microseconds], ") + study::median_of_runs,
              [](const R& r) { return r.of.time_us; }},
             {"lateral_ratio", "lateral creepage ratio eta G/(2 (1-nu) mu p0)",
              [](const R& r) { return r.point.lateral; }},
             {"lateral_force_ratio", "lateral force -F_y/(mu N)",
              [](const R& r) { return r.if_both(r.lateral_force_ratio()); }},
             {"assembly_us", std::string("time of the assembly of G' [microseconds], ") + study::median_of_runs,
              [](const R& r) { return r.of.assembly_us; }},
             {"tangent_ratio", "derivative d force_ratio/d creepage_ratio",
              if_ok([](const R& r) { return r.tangent_ratio(r.of.step.tangent.by_longitudinal.longitudinal); })},
             {"slip_work",
              "work of slip for each distance a rolled [mu N mu p0 a/G], summed over the elements (second order in "
              "1/n)",
              if_ok([](const R& r) { return r.of.step.slip_work / r.of.full; })},
             {"path_points", "number of points on the path of the fallback, where rounds did not settle",
              [](const R& r) { return r.of.path_points; }},
             {"status",
              "ok, or why force_ratio, tangent_ratio and slip_work are empty: assists_creepage where some tractions of "
              "the same scheme in full adhesion assist the creepage, so that the scheme does not converge there: alpha "
              "<= 0 (or close to 0 on coarse meshes), or alpha > 1 (with friction, alpha = 0 converges, to first "
              "order, where several elements slip)",
              [](const R& r) { return r.of.status; }},
             {"lateral_exact", "Carter's lateral_force_ratio, where it holds",
              [](const R& r) { return r.exact().lateral; }},
             {"lateral_relative_error", "lateral_force_ratio/lateral_exact - 1",
              [](const R& r) { return relative_error(r.lateral_force_ratio(), r.exact().lateral); }},
             {"lateral_tangent_ratio", "derivative d lateral_force_ratio/d lateral_ratio",
              if_ok([](const R& r) { return r.if_both(r.tangent_ratio(r.of.step.tangent.by_lateral.lateral)); })},
             {"spin_ratio", "spin ratio phi a G/(2 (1-nu) mu p0)", [](const R& r) { return r.if_both(r.point.spin); }},
             {"moment_ratio", "moment -M_z/(mu N a)",
              if_ok([](const R& r) { return r.if_both(0 - r.of.step.force.moment / r.of.full); })},
             {"sweep", "order of the sweep, as in --sweep", [](const R& r) { return study::Cell(r.curve.sweep); }}},
            law_columns<R>()),
        study::settings};
    return columns;
}

const study::Sheet<CreepRow>& traction_sheet() {
    using R = CreepRow;
    static const study::Sheet<CreepRow> columns{
        "n",
        {{"creepage_ratio", "creepage ratio, as above", [](const R& r) { return r.point.longitudinal; }},
         {"x_over_a", "position x/a of the element's centre", [](const R& r) { return r.of.x[r.i]; }},
         {"traction", "traction along x [mu p0]", if_ok([](const R& r) { return r.of.traction(r.i, 0); })},
         {"bound", "bound of the traction [mu p0], by mu_0 under " + study::friction_law_flags(),
          [](const R& r) { return r.of.bound[r.i]; }},
         {"stick", "1 where the element sticks, else 0",
          if_ok([](const R& r) { return int(r.of.sticks[std::size_t(r.i)]); })},
         {"slip", "slip s/V along x [mu p0/G]", if_ok([](const R& r) { return r.of.slip(r.i, 0); })},
         {"exact", "Carter's traction [mu p0], where it holds",
          [](const R& r) {
              const bool holds = r.carter() && r.point.lateral.value_or(0) == 0;
              return holds ? study::Cell(rollbem::carter_friction_traction(r.of.x[r.i], r.point.longitudinal))
                           : study::Cell();
          }},
         {"mesh", "scheme, as above", [](const R& r) { return r.of.mesh_name; }},
         {"method, derivative", ""},
         {"alpha_L", "", [](const R& r) { return r.of.alpha_L; }},
         {"alpha_T", "", [](const R& r) { return r.of.alpha_T; }},
         {"status", "ok, or why traction, stick and slip are empty, as above", [](const R& r) { return r.of.status; }},
         {"lateral_ratio", "lateral creepage ratio, as above", [](const R& r) { return r.point.lateral; }},
         {"lateral_traction", "traction across the rolling direction [mu p0]",
          if_ok([](const R& r) { return r.if_both(r.of.traction(r.i, 1)); })},
         {"lateral_slip", "slip s/V across the rolling direction [mu p0/G]",
          if_ok([](const R& r) { return r.if_both(r.of.slip(r.i, 1)); })},
         {"layer", "compliance of the layer [a/G]", [](const R& r) { return r.line.layer; }},
         {"friction_ratio", "coefficient of friction mu/mu_0",
          if_ok([](const R& r) { return r.line.law ? study::Cell(r.of.friction[r.i]) : study::Cell(); })}},
        study::settings};
    return columns;
}

// --- pictures ------------------------------------------------------------------------------------------------------

/// The tractions of the last scene with a result at the creepage nearest to half of full sliding; an empty panel if
/// there are none.
study::Plot draw_tractions(const study::SideTable& tractions, const Line& line) {
    double shown = std::nan("");
    study::Records of_scene{tractions.columns};
    for (const std::vector<study::Row>& rows : tractions.rows) {
        bool is_first = true;
        for (const study::Row& row : rows) {
            if (std::isnan(of_scene.number(row, "traction"))) continue;
            const double ratio = of_scene.number(row, "creepage_ratio");
            const auto distance = [](double one) { return std::abs(std::abs(one) - 0.5); };
            if (is_first || distance(ratio) < distance(shown)) shown = ratio;
            if (std::exchange(is_first, false)) of_scene.rows = rows;
        }
    }
    const bool falling = line.law.has_value();
    const double sign = shown < 0 ? -1 : 1;
    study::Series exact{"Carter", study::Look::exact},
        bound{"bound " + coefficient(falling) + " p_n", study::Look::exact};
    study::Series slip{"slip", study::Look::slip}, stick{"stick", study::Look::stick};
    double highest = 0;
    for (const study::Row& row : of_scene.rows) {
        if (of_scene.number(row, "creepage_ratio") != shown) continue;
        const double x = of_scene.number(row, "x_over_a"), most = of_scene.number(row, "bound");
        highest = std::max(highest, 1.05 * most);
        bound.points.emplace_back(x, sign * most);
        auto& zone = of_scene.number(row, "stick") > 0 ? stick : slip;
        zone.points.emplace_back(x, -of_scene.number(row, "traction"));
    }
    for (int i = 0; i <= line_points && line.carter() && !of_scene.rows.empty(); ++i) {
        const double x = -std::cos(std::numbers::pi * i / line_points);
        exact.points.emplace_back(x, -rollbem::carter_friction_traction(x, shown));
    }
    return {.title = "Traction, δ = " + study::Cell(shown).text(6) + ", n = " + std::to_string(bound.points.size()),
            .x = {.label = "x / a (leading edge at 1)", .range = study::PlotRange{-1, 1}},
            .y = {.label = force_label(falling, "-p", "p_0"),
                  .range = study::PlotRange{std::min(0.0, sign * highest), std::max(0.0, sign * highest)}},
            .series = {std::move(exact), std::move(bound), std::move(slip), std::move(stick)}};
}

/// The creep curve, with the tractions below it at the creepage nearest to half of full sliding, for the last mesh.
study::Picture creep_picture(const study::Records& rows, const Curve& curve, const study::SideTable& tractions) {
    const bool falling = curve.line.law.has_value();
    study::Plot plot{.title = "Creep curve" + curve.line.title,
                     .x = {creepage_label(falling, "δ = ξ")},
                     .y = {force_label(falling)}};
    study::add_series(plot, rows,
                      {.by = case_columns, .x = "creepage_ratio", .y = "force_ratio", .look = study::Look::markers});
    if (plot.series.size() == 1 && !curve.sweep.empty()) plot.series[0].label = "sweep " + curve.sweep;
    plot.y.range = force_range(plot);
    const std::set<double> ratios = rows.numbers("creepage_ratio");
    if (curve.line.carter() && !ratios.empty()) {
        plot.series.push_back(carter_curve(*ratios.begin(), *ratios.rbegin()));
    }
    return {plot, draw_tractions(tractions, curve.line)};
}

/// The two forces over the creepage ratio, a panel each, one line for each lateral ratio.
study::Picture combined_creep(const study::Records& rows, const Curve& curve) {
    const bool falling = curve.line.law.has_value();
    const auto panel = [&](const std::string& title, const char* force, const char* y) {
        study::Plot plot{title, {creepage_label(falling, "δ_x = ξ_x")}, {force_label(falling, force)}};
        study::add_series(
            plot, rows,
            {.by = study::joined(case_columns, {"lateral_ratio", "spin_ratio"}), .x = "creepage_ratio", .y = y});
        plot.y.range = force_range(plot);
        return plot;
    };
    return {panel("Longitudinal force" + curve.line.title, "-F_x", "force_ratio"),
            panel("Lateral force", "-F_y", "lateral_force_ratio")};
}

}  // namespace

std::string curve_help() {
    return creep_sheet().help() + "--tractions FILE, one row for each element:\n" + traction_sheet().help();
}

study::Table curve_table(const Curve& curve) {
    study::Table table = creep_sheet().frame(curve.scenes, curve.points.size());
    study::SideTable& tractions = table.put_beside("tractions", traction_sheet().names(), curve.keeps_tractions);
    table.compute = [&curve, &tractions](std::size_t task, study::RowRange range, const study::Emit& emit) {
        const study::Scene& scene = curve.scenes[task];
        const auto solve = curve.by_border ? solve_by_border : solve_by_elements;
        solve(curve, scene, range, [&](std::size_t k, const Solution& solution) {
            CreepRow row{curve, curve.line, scene, curve.points[k], solution};
            row.point.longitudinal = solution.creepage_ratio.value_or(row.point.longitudinal);
            emit(creep_sheet().row(scene, row));
            for (; tractions.wanted && row.i < solution.x.size(); ++row.i) {
                tractions.rows[task].push_back(traction_sheet().row(scene, row));
            }
        });
    };
    table.plot = [&curve, &tractions](const study::Records& rows) {
        return curve.line.both ? combined_creep(rows, curve) : creep_picture(rows, curve, tractions);
    };
    return table;
}

}  // namespace friction
