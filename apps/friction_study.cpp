// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in time from
// rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>

#include "support/non_steady.hpp"
#include "support/options.hpp"
#include "support/pairs_file.hpp"
#include "support/program.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace {

using State = rollbem::FrictionState<double>;
using Step = rollbem::FrictionStep<double>;

constexpr double largest_steps = 1e7;
constexpr double mu_N = std::numbers::pi / 2;  // with mu = p0 = a = 1

/// Mean pressure of each element of a mesh, scaled to the load of Hertz's with p0 = 1. With mu = a = G = 1, all that is
/// computed is then in the units of the columns, but for forces and works, which are in mu N.
struct Pressure {
    std::function<Eigen::ArrayXd(const rollbem::Mesh<double>&)> mean;
    bool hertz;  ///< the closed forms hold

    Eigen::ArrayXd operator()(const rollbem::Mesh<double>& mesh) const { return mean(mesh); }
};

Pressure make_pressure(const study::Options& options) {
    if (!options.given("pressure")) {
        return {[](const rollbem::Mesh<double>& mesh) { return rollbem::mean_hertz_pressure(mesh); }, true};
    }
    const study::Pairs points = study::read_pairs(options, "pressure", "x_over_a,pressure", study::between(-1, 1));
    const auto column = [](const std::vector<double>& values) {
        return Eigen::ArrayXd(Eigen::Map<const Eigen::ArrayXd>(values.data(), Eigen::Index(values.size())));
    };
    try {
        const rollbem::PressureTable<double> table(column(points.places), column(points.values));
        const double scale = mu_N / table.integral();
        return {[=](const rollbem::Mesh<double>& mesh) { return Eigen::ArrayXd(scale * table(mesh)); }, false};
    } catch (const std::invalid_argument& error) {
        throw study::BadInput(options.said("pressure") + ": " + error.what());
    }
}

/// `consistent` is whether steady rolling of the same scheme in full adhesion is.
const char* name_of(rollbem::StepStatus status, bool consistent) {
    return status == rollbem::StepStatus::ok && !consistent ? name(rollbem::Status::inconsistent) : name(status);
}

double creepage(const study::Scene& scene, double ratio) { return 2 * (1 - scene.contact.poisson_ratio()) * ratio; }

/// value/exact - 1 where both are defined.
study::Cell relative_error(double value, std::optional<double> exact) {
    return exact && *exact != 0 ? study::Cell(value / *exact - 1) : study::Cell();
}

// ---------------------------------------------------------------------------------------------------- steady rolling

/// Traction and slip along the contact at one creepage.
struct Profile {
    const study::Scene* scene;
    std::string mesh_name;
    std::optional<double> alpha_L, alpha_T;
    double ratio;
    std::string status;
    rollbem::Mesh<double> mesh;
    Eigen::VectorXd traction, bound, slip;  // of every element
    std::vector<bool> sticks;
};

const std::vector<std::string> profile_columns{"n",          "creepage_ratio", "x_over_a", "traction", "bound",
                                               "stick",      "slip",           "exact",    "mesh",     "method",
                                               "derivative", "alpha_L",        "alpha_T",  "status"};

/// Profiles of the rows in the order of the rows, whichever thread they come from.
class Profiles {
public:
    void keep(std::size_t task, std::size_t row, Profile profile) {
        const std::lock_guard lock(mutex_);
        profiles_.insert_or_assign({task, row}, std::move(profile));
    }
    const std::map<std::pair<std::size_t, std::size_t>, Profile>& all() const { return profiles_; }

private:
    std::mutex mutex_;
    std::map<std::pair<std::size_t, std::size_t>, Profile> profiles_;
};

/// The plain solver at each ratio of `range`, always from scratch: a row does not depend on the rows before.
void steady_rows(const study::Options& options, const study::Scene& scene, const Pressure& pressure,
                 const std::vector<double>& ratios, study::RowRange range, std::size_t task, Profiles* profiles,
                 const study::Emit& emit) {
    const bool timed = study::job_count(options) == 1;
    const auto assemble = [&] {
        return scene.visit([](const auto& mesh, const auto& scheme, const auto& kernel) {
            return std::pair<Eigen::MatrixXd, Eigen::ArrayXd>(rollbem::assemble_G_prime(mesh, scheme, kernel),
                                                              rollbem::unknown_widths(mesh, scheme));
        });
    };
    const auto [G_prime, widths] = assemble();
    const Eigen::Index unknown = widths.size();
    study::Cell assembly_us;
    if (timed) assembly_us = study::median_time_us([&] { return assemble().first(0, 0); });
    // Slip hides what is wrong with a scheme that does not converge; in full adhesion it shows.
    const bool consistent = rollbem::solve_steady<double>(G_prime, widths).status != rollbem::Status::inconsistent;
    const Eigen::ArrayXd means = pressure(*scene.mesh);
    const rollbem::CoulombFriction<double> friction{1, means.head(unknown)};
    const rollbem::SteadyFrictionModel<double> model(scene.contact, G_prime, widths, friction);
    const State rest = model.at_rest();
    State state = rest;
    const rollbem::FrictionWorkspace<double> fresh = model.workspace();
    rollbem::FrictionWorkspace<double> workspace = fresh;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const double xi = creepage(scene, ratios[i]);
        const auto solve = [&] {
            workspace = fresh;  // without factors
            return model.solve(rest, xi, state, workspace);
        };
        const Step step = solve();
        study::Cell time_us;
        if (timed) time_us = study::median_time_us([&] { return solve().force_per_width; });

        const bool usable = consistent && step.status == rollbem::StepStatus::ok;
        const auto if_usable = [&](double value) { return usable ? value : std::nan(""); };
        const double force_ratio = if_usable(-step.force_per_width / mu_N);
        const std::optional<double> exact =
            pressure.hertz ? std::optional(rollbem::carter_force_ratio(ratios[i])) : std::nullopt;
        emit({scene.method, scene.derivative, scene.mesh_name, scene.n(), scene.alpha_L, scene.alpha_T, ratios[i],
              force_ratio, exact, relative_error(force_ratio, exact), step.stick_count, step.rounds,
              step.complementarity_residual, time_us, assembly_us,
              if_usable(-step.tangent_per_width * creepage(scene, 1) / mu_N),
              if_usable(step.slip_work_per_width / mu_N), step.pivots, name_of(step.status, consistent)});
        if (profiles == nullptr) continue;
        Profile profile{&scene,
                        scene.mesh_name,
                        scene.alpha_L,
                        scene.alpha_T,
                        ratios[i],
                        name_of(step.status, consistent),
                        *scene.mesh,
                        {},
                        means.matrix(),
                        {},
                        {}};
        profile.traction.setZero(scene.n());
        profile.slip.setZero(scene.n());
        profile.traction.head(unknown) = state.traction;
        profile.slip.head(unknown) = workspace.slip();
        for (const rollbem::Zone zone : state.zones) profile.sticks.push_back(zone == rollbem::Zone::stick);
        profile.sticks.resize(std::size_t(scene.n()), false);
        profiles->keep(task, i, std::move(profile));
    }
}

/// The same on meshes fitted to the border between slip and stick.
void fitted_rows(const study::Options& options, const study::Scene& scene, const Pressure& pressure,
                 const std::vector<double>& ratios, study::RowRange range, std::size_t task, Profiles* profiles,
                 const study::Emit& emit) {
    for (std::size_t i = range.first; i < range.last; ++i) {
        const auto solve = [&] {
            return std::visit(
                [&](const auto& kernel) {
                    return rollbem::solve_fitted_friction(scene.contact, scene.n(), kernel, 1.0, pressure,
                                                          creepage(scene, ratios[i]));
                },
                scene.kernel);
        };
        const rollbem::FittedFrictionSolution<double> solution = solve();
        study::Cell time_us;
        if (study::job_count(options) == 1) time_us = study::median_time_us([&] { return solve().force_per_width; });

        Profile profile{&scene,
                        solution.fitted ? "fitted" : "cosine",
                        solution.fitted ? 0 : 0.5,
                        0.5,
                        ratios[i],
                        name_of(solution.status),
                        solution.mesh,
                        solution.traction,
                        pressure(solution.mesh).matrix(),
                        solution.slip,
                        {}};
        for (Eigen::Index k = 0; k < scene.n(); ++k) {
            profile.sticks.push_back(solution.fitted ? solution.mesh.centres()[k] > solution.border
                                                     : solution.slip[k] == 0);
        }
        const double force_ratio =
            solution.status == rollbem::StepStatus::ok ? -solution.force_per_width / mu_N : std::nan("");
        const std::optional<double> exact =
            pressure.hertz ? std::optional(rollbem::carter_force_ratio(ratios[i])) : std::nullopt;
        emit({scene.method, scene.derivative, profile.mesh_name, scene.n(), profile.alpha_L, profile.alpha_T, ratios[i],
              force_ratio, exact, relative_error(force_ratio, exact),
              std::count(profile.sticks.begin(), profile.sticks.end(), true), solution.evaluations,
              solution.complementarity_residual, time_us, study::Cell(),
              -solution.tangent_per_width * creepage(scene, 1) / mu_N, solution.slip_work_per_width / mu_N, 0,
              profile.status});
        if (profiles != nullptr) profiles->keep(task, i, std::move(profile));
    }
}

void write_profiles(const Profiles& profiles, const Pressure& pressure, bool with_header, study::TableFile& file) {
    if (with_header) file.rows().write(study::csv_line(study::Row(profile_columns.begin(), profile_columns.end())));
    for (const auto& [key, profile] : profiles.all()) {
        for (Eigen::Index i = 0; i < profile.mesh.size(); ++i) {
            const double x = profile.mesh.centres()[i];
            study::Cell traction, stick, slip, exact;
            if (profile.status == "ok") {
                traction = profile.traction[i];
                stick = int(profile.sticks[std::size_t(i)]);
                slip = profile.slip[i];
            }
            if (pressure.hertz) exact = rollbem::carter_friction_traction(x, profile.ratio);
            file.rows().write(
                study::csv_line({profile.mesh.size(), profile.ratio, x, traction, profile.bound[i], stick, slip, exact,
                                 profile.mesh_name, profile.scene->method, profile.scene->derivative, profile.alpha_L,
                                 profile.alpha_T, profile.status}));
        }
    }
    file.commit();
}

/// The creep curve, and beside it the tractions at the creepage nearest to half of full sliding, for the last mesh.
study::Plot steady_plot(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                        const Profiles& profiles, const Pressure& pressure, const std::vector<double>& ratios) {
    study::Plot plot{.title = "Creep curve",
                     .x_label = "creepage ratio δ = ξ G / (2 (1 - ν) μ p_0)",
                     .y_label = "-F / (μ N)",
                     .series = {}};
    study::add_series(
        plot, columns, rows,
        {.by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"}, .x = "creepage_ratio", .y = "force_ratio"});
    for (study::Series& series : plot.series) series.line = false;
    if (pressure.hertz) {
        const auto [low, high] = std::minmax_element(ratios.begin(), ratios.end());
        study::Series carter{.label = "Carter", .points = {}, .markers = false};
        const double from = std::min(*low, 0.0), to = std::max(*high, 0.0);
        for (int i = 0; i <= 400; ++i) {
            const double ratio = from + (to - from) * i / 400;
            carter.points.emplace_back(ratio, rollbem::carter_force_ratio(ratio));
        }
        plot.series.push_back(std::move(carter));
    }
    const Profile* shown = nullptr;
    const auto distance = [](const Profile& profile) { return std::abs(std::abs(profile.ratio) - 0.5); };
    for (const auto& [key, profile] : profiles.all()) {
        if (profile.status != "ok") continue;
        if (shown == nullptr || profile.scene != shown->scene || distance(profile) < distance(*shown)) shown = &profile;
    }
    if (shown == nullptr) return plot;
    study::Plot panel{
        .title = "Traction, δ = " + study::Cell(shown->ratio).text(6) + ", n = " + std::to_string(shown->mesh.size()),
        .x_label = "x / a (leading edge at 1)",
        .y_label = "-p / (μ p_0)",
        .x_range = study::PlotRange{-1, 1},
        .series = {}};
    const double sign = shown->ratio < 0 ? -1 : 1;
    study::Series bound{.label = "bound μ p_n", .points = {}, .markers = false, .style = 6};
    study::Series exact{.label = "Carter", .points = {}, .markers = false, .style = 2};
    study::Series slip{.label = "slip", .points = {}, .line = false, .style = 1};
    study::Series stick{.label = "stick", .points = {}, .line = false, .style = 0};
    for (Eigen::Index i = 0; i < shown->mesh.size(); ++i) {
        const double x = shown->mesh.centres()[i];
        bound.points.emplace_back(x, sign * shown->bound[i]);
        (shown->sticks[std::size_t(i)] ? stick : slip).points.emplace_back(x, -shown->traction[i]);
    }
    for (int i = 0; i <= 400 && pressure.hertz; ++i) {
        const double x = -std::cos(std::numbers::pi * i / 400);
        exact.points.emplace_back(x, -rollbem::carter_friction_traction(x, shown->ratio));
    }
    panel.series = {std::move(bound), std::move(exact), std::move(slip), std::move(stick)};
    plot.beside.push_back(std::move(panel));
    return plot;
}

int run_steady(const study::Options& given, const Pressure& pressure) {
    for (const char* name : {"sine", "shift", "dq", "until", "integrator", "unchecked"}) {
        given.ignored(name, "without --transient");
    }
    given.ignored("lambda", "without --transient: a steady problem builds no G, the only matrix lambda acts on");
    const bool fits = given.flag("fit-border");
    if (fits) {
        for (const char* name : {"mesh", "edges", "method", "derivative", "alpha-L", "alpha-T", "alpha"}) {
            given.ignored(name, "with --fit-border, which makes its own mesh");
        }
        for (const std::ptrdiff_t n : given.integers("n", 1, 100000)) {
            if (n < 10 || n % 2 != 0) {
                throw study::BadInput("--n = " + std::to_string(n) + " must be even and at least 10 with --fit-border");
            }
        }
    }
    const std::vector<double> ratios =
        given.numbers("creepage-ratio", {[](double value) { return std::isfinite(value); }, "be finite"});
    const std::vector<study::Scene> scenes = study::make_scenes(given, study::Problem::steady);

    std::optional<study::TableFile> tractions;
    if (given.given("tractions")) tractions.emplace(given, "tractions");
    Profiles profiles;
    Profiles* const kept = tractions || given.given("plot") ? &profiles : nullptr;

    study::Table table;
    table.columns = {"method",
                     "derivative",
                     "mesh",
                     "n",
                     "alpha_L",
                     "alpha_T",
                     "creepage_ratio",
                     "force_ratio",
                     "exact",
                     "relative_error",
                     "stick_count",
                     "rounds",
                     "complementarity_residual",
                     "time_us",
                     "assembly_us",
                     "tangent_ratio",
                     "slip_work",
                     "pivots",
                     "status"};
    table.rows_of_task.assign(scenes.size(), ratios.size());
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        (fits ? fitted_rows : steady_rows)(given, scenes[task], pressure, ratios, range, task, kept, emit);
    };
    const bool has_header = !given.given("shard") || given.text("shard").substr(0, 2) == "1/";
    const auto write_tractions = [&] {
        if (tractions) write_profiles(profiles, pressure, has_header, *tractions);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        write_tractions();  // before the drawing, which may fail
        return steady_plot(table.columns, rows, profiles, pressure, ratios);
    };
    study::write_table(given, table);
    if (!given.given("plot")) write_tractions();
    return study::exit_ok;
}

// -------------------------------------------------------------------------------------------------- rolling in time

/// Creepage ratio over q/a, and a rigid shift before.
struct History {
    double amplitude = 0;
    std::optional<double> omega{};  // of a sine, in V/a; constant without
    std::optional<double> shift{};

    double at(double q) const { return omega ? amplitude * std::sin(*omega * q) : amplitude; }
};

History make_history(const study::Options& options) {
    const study::Rule finite{[](double value) { return std::isfinite(value); }, "be finite"};
    History history;
    if (options.given("shift")) history.shift = options.number("shift", finite);
    if (options.given("sine")) {
        options.ignored("creepage-ratio", "with --sine");
        const study::Sine sine =
            study::read_sine(options, {[](double value) { return std::isfinite(value); }, "finite"});
        history.amplitude = sine.amplitude;
        history.omega = sine.omega;
        return history;
    }
    if (!options.given("creepage-ratio")) {
        throw study::BadInput("one of --creepage-ratio and --sine must be given with --transient");
    }
    history.amplitude = options.number("creepage-ratio", finite);
    return history;
}

/// One run. Emits the rows of `range`, but steps from the start, as the state requires.
void run_history(const study::Scene& scene, const rollbem::FrictionModel<double>& model, const Pressure& pressure,
                 const History& history, double dq, const std::string& integrator, study::RowRange range,
                 const study::Emit& emit) {
    State now = model.at_rest(), next = now;
    rollbem::FrictionWorkspace<double> workspace = model.workspace();
    double slip_work = 0;
    std::size_t row = 0;
    const auto record = [&](double q, double ratio, double shift, const Step& step, std::optional<double> exact) {
        std::swap(now, next);
        slip_work += step.slip_work_per_width / mu_N;
        if (row++ < range.first) return;
        const double force_ratio = step.status == rollbem::StepStatus::ok ? -step.force_per_width / mu_N : std::nan("");
        emit({q,
              ratio,
              shift,
              force_ratio,
              step.stick_count,
              step.rounds,
              slip_work,
              exact,
              relative_error(force_ratio, exact),
              step.complementarity_residual,
              step.pivots,
              name(step.status),
              scene.method,
              scene.derivative,
              scene.mesh_name,
              scene.n(),
              scene.alpha_L,
              scene.alpha_T,
              scene.lambda,
              integrator});
    };
    if (history.shift) {
        std::optional<double> exact;
        if (pressure.hertz && study::plane_model_decays(scene.contact)) {
            exact =
                rollbem::cattaneo_force_ratio(*history.shift, scene.contact.poisson_ratio(), scene.contact.aspect());
        }
        const Step step = model.shift(now, *history.shift, next, workspace);
        record(0, 0, *history.shift, step, exact);
    }
    const std::size_t shifts = row;
    while (row < range.last) {
        const double from = double(row - shifts) * dq, to = double(row - shifts + 1) * dq;
        const auto motion =
            rollbem::RigidMotion<double>::linear(creepage(scene, history.at(from)), creepage(scene, history.at(to)));
        const Step step = model.advance(now, dq, motion, next, workspace);
        record(to, history.at(to), 0, step, std::nullopt);
    }
}

int run_transient(const study::Options& given, const Pressure& pressure) {
    for (const char* name : {"tractions", "fit-border"}) given.ignored(name, "with --transient");
    const History history = make_history(given);
    const double dq = given.number("dq", study::positive());
    const double until = given.number("until", study::positive());
    const double count = std::floor(until / dq * (1 + 1e-12));
    if (count < 1) throw study::BadInput(given.said("until") + " must be at least --dq");
    if (count > largest_steps) throw study::BadInput(given.said("until") + " must be at most 1e7 times --dq");
    const std::string integrator = given.choice("integrator", {"sdirk2", "implicit-euler"});
    const rollbem::Integrator method =
        integrator == "sdirk2" ? rollbem::Integrator::sdirk2 : rollbem::Integrator::implicit_euler;

    const std::vector<study::Scene> scenes = study::make_non_steady_scenes(given);
    std::vector<rollbem::FrictionModel<double>> models;
    for (const study::Scene& scene : scenes) {
        rollbem::ElementSystem<double> system =
            scene.visit([](const auto& mesh, const auto& scheme, const auto& kernel) {
                return rollbem::rolling_system(mesh, scheme, kernel);
            });
        if (!given.flag("unchecked")) study::require_steppable(scene, rollbem::verdict<double>(system), system);
        const rollbem::CoulombFriction<double> friction{1, pressure(*scene.mesh)};
        models.emplace_back(scene.contact, std::move(system), rollbem::unchecked, friction, method);
    }
    study::Table table;
    table.columns = {"q_over_a", "creepage_ratio", "shift",   "force_ratio",    "stick_count",
                     "rounds",   "slip_work",      "exact",   "relative_error", "complementarity_residual",
                     "pivots",   "status",         "method",  "derivative",     "mesh",
                     "n",        "alpha_L",        "alpha_T", "lambda",         "integrator"};
    table.rows_of_task.assign(scenes.size(), std::size_t(count) + (history.shift ? 1 : 0));
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        run_history(scenes[task], models[task], pressure, history, dq, integrator, range, emit);
    };

    // --plot: the force over the distance, with the steady one; under sinusoidal creepage also over the creepage.
    table.plot = [&](const std::vector<study::Row>& rows) {
        const study::Selection over_distance{
            .by = {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lambda"},
            .x = "q_over_a",
            .y = "force_ratio"};
        study::Plot plot{
            .title = "Rolling with friction", .x_label = "distance rolled q/a", .y_label = "-F / (μ N)", .series = {}};
        study::add_series(plot, table.columns, rows, over_distance);
        for (study::Series& series : plot.series) series.markers = false;
        if (history.omega) {
            study::Plot loop{
                .title = "Hysteresis", .x_label = "creepage ratio δ", .y_label = "-F / (μ N)", .series = {}};
            study::Selection over_creepage = over_distance;
            over_creepage.x = "creepage_ratio";
            study::add_series(loop, table.columns, rows, over_creepage);
            for (study::Series& series : loop.series) series.markers = false;
            plot.beside.push_back(std::move(loop));
        } else if (pressure.hertz) {
            const double steady = rollbem::carter_force_ratio(history.amplitude);
            plot.series.push_back(
                {.label = "Carter, steady", .points = {{0, steady}, {count * dq, steady}}, .markers = false});
        }
        return plot;
    };
    study::write_table(given, table);
    return study::exit_ok;
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("friction_study",
                           "Rolling with Coulomb friction: steady, against Carter's creep curve, or in time.");
    options.set_default("mesh", "cosine");
    options.set_default("alpha-L", "0.5");
    options.set_default("alpha-T", "0.5");
    options.add("creepage-ratio", "LIST",
                "creepage as delta = xi G/(2 (1-nu) mu p0): Carter's contact slides as a whole from 1 on; with "
                "--transient a single value (dimensionless)",
                "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1");
    options.add_input(
        "pressure",
        "CSV file with the columns x_over_a,pressure instead of Hertz's pressure: any unit, linear between its "
        "rows, zero before the first and after the last; two rows at one x_over_a make a jump (dimensionless)");
    options.add_table("tractions",
                      "besides, a CSV file with one row per element of every scheme and creepage, and FILE.toml");
    options.add_flag("fit-border", "resolve the border between slip and stick: meshes fitted to it, extrapolated");
    options.add_flag("transient", "roll in time from rest, one row per step");
    options.add("sine", "AMP,OMEGA",
                "with --transient: creepage ratio AMP sin(OMEGA q/a), OMEGA in V/a (dimensionless)");
    options.add("shift", "W", "with --transient: rigid shift in mu p0 a/G first, without rolling (dimensionless)");
    options.add("dq", "D", "with --transient: distance rolled in a step, in units of a (dimensionless)", "0.05");
    options.add("until", "Q", "with --transient: distance rolled in all, in units of a (dimensionless)", "10");
    options.add("integrator", "NAME", "with --transient: sdirk2 (second order) or implicit-euler (first)", "sdirk2");
    options.add_flag("unchecked",
                     "with --transient: step even a scheme that is unstable, or may be, or does not converge");
    options.footer(
        "Examples\n"
        "  the creep curve, with the tractions drawn under their bound\n"
        "    friction_study --n 20,40 --output curve.csv --tractions tractions.csv --plot curve.svg\n"
        "  the same force to 1e-4 and better with 40 elements\n"
        "    friction_study --n 40 --creepage-ratio 0.2,0.5,0.8 --fit-border --kernel plane\n"
        "  under a pressure of one's own\n"
        "    printf 'x_over_a,pressure\\n-1,0\\n0.3,1\\n1,0\\n' > pressure.csv\n"
        "    friction_study --n 40 --pressure pressure.csv\n"
        "  rolling from rest, and from a shift, to the steady state\n"
        "    friction_study --transient --n 40 --creepage-ratio 0.5 --plot rest.svg\n"
        "    friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --aspect 100 --kernel plane\n"
        "  a hysteresis loop\n"
        "    friction_study --transient --n 40 --sine 1.5,0.5 --until 40 --plot loop.svg\n"
        "\n"
        "force_ratio is -F/(mu N). exact is Carter's (plane model b >> a, whatever the kernel) for steady rolling\n"
        "and Cattaneo's for a shift from rest (plane model of this b/a). With --pressure, p0 = 2 N/(pi a) is the\n"
        "peak of Hertz's pressure of the same load, and exact is empty.\n"
        "\n"
        "Steady: one row per mesh, scheme and creepage, each solved from scratch. stick_count: elements that\n"
        "stick; rounds: of the active set; pivots: of the fallback where the rounds did not settle;\n"
        "complementarity_residual: largest violation of |p| <= mu p_n (over mu p0) and of the slip's direction\n"
        "(over |xi|); time_us and assembly_us [microseconds]: medians of at least 5 runs of the solution and of\n"
        "G' before it; tangent_ratio: d force_ratio/d creepage_ratio; slip_work: per distance a rolled, in mu N\n"
        "mu p0 a/G, summed over the elements (of first order in 1/n). Where status is not ok, these two and\n"
        "force_ratio are empty; it is inconsistent where in full adhesion tractions of the same scheme push with the\n"
        "creepage, so that the scheme does not converge: alpha at or below 0 (near 0 on coarse meshes), or above 1.\n"
        "--tractions: traction and bound in mu p0, slip s/V in mu p0/G, stick 1 or 0; traction, stick and slip are\n"
        "empty where status is not ok.\n"
        "\n"
        "--fit-border is for pressures that leave one slip zone at the trailing edge, as Hertz's does. Where that\n"
        "does not hold, mesh = cosine and the plain solver with alpha = 0.5 takes over. rounds then counts\n"
        "meshes, time_us includes their assembly, complementarity_residual is of the order of the mesh's error,\n"
        "and slip_work = -F xi.\n"
        "\n"
        "--transient: one row per step, from q = dq on; with --shift, a row at q = 0 before. shift: imposed in\n"
        "this row, in mu p0 a/G. slip_work: cumulative, in mu N mu p0 a/G. creepage is linear over a step (its\n"
        "end value with implicit-euler). rounds: of all solutions of a step, two with sdirk2.\n"
        "A scheme that is not certainly stable, or that steady rolling shows as inconsistent, is refused unless\n"
        "--unchecked is given: friction bounds its tractions, but they are wrong, and status does not tell. The\n"
        "check finds eigenvalues, in time of order n^3.\n");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const Pressure pressure = make_pressure(given);
        return given.flag("transient") ? run_transient(given, pressure) : run_steady(given, pressure);
    });
}
