#include "steady.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/steady.hpp>

#include "plots.hpp"
#include "profiles.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace friction {

namespace {

const std::vector<std::string> columns{"method",
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

/// What all rows need.
struct CreepCurve {
    const study::Options& options;
    const Pressure& pressure;
    std::vector<double> ratios;
    Profiles* profiles;  ///< null where none are wanted

    bool timed() const { return study::job_count(options) == 1; }

    std::optional<double> exact_force(double ratio) const {
        return pressure.hertz ? std::optional(rollbem::carter_force_ratio(ratio)) : std::nullopt;
    }
};

/// `consistent` is whether steady rolling of the same scheme in full adhesion is.
std::string status_of(rollbem::StepStatus status, bool consistent) {
    return status == rollbem::StepStatus::ok && !consistent ? name(rollbem::Status::inconsistent) : name(status);
}

/// Elements beyond the solution's, at the leading edge, carry nothing and slip.
Profile profile_of(const study::Scene& scene, double ratio, std::string status, const Eigen::ArrayXd& means,
                   const rollbem::FrictionState<double>& state, const Eigen::VectorXd& slip) {
    const Eigen::Index n = scene.n();
    Profile profile{&scene,
                    scene.mesh_name,
                    scene.alpha_L,
                    scene.alpha_T,
                    ratio,
                    std::move(status),
                    *scene.mesh,
                    Eigen::VectorXd::Zero(n),
                    means.matrix(),
                    Eigen::VectorXd::Zero(n),
                    {}};
    profile.traction.head(state.traction.size()) = state.traction;
    profile.slip.head(slip.size()) = slip;
    for (const rollbem::Zone zone : state.zones) profile.sticks.push_back(zone == rollbem::Zone::stick);
    profile.sticks.resize(std::size_t(n), false);
    return profile;
}

/// The plain solver at each ratio of `range`, always from scratch: a row does not depend on the rows before.
void plain_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                const study::Emit& emit) {
    const auto assemble = [&] {
        return scene.visit([](const auto& mesh, const auto& scheme, const auto& kernel) {
            return std::pair<Eigen::MatrixXd, Eigen::ArrayXd>(rollbem::assemble_G_prime(mesh, scheme, kernel),
                                                              rollbem::unknown_widths(mesh, scheme));
        });
    };
    const auto [G_prime, widths] = assemble();
    study::Cell assembly_us;
    if (curve.timed()) assembly_us = study::median_time_us([&] { return assemble().first(0, 0); });
    // Slip hides what is wrong with a scheme that does not converge; in full adhesion it shows.
    const bool consistent = rollbem::solve_steady<double>(G_prime, widths).status != rollbem::Status::inconsistent;
    const Eigen::ArrayXd means = curve.pressure(*scene.mesh);
    const rollbem::SteadyFrictionModel<double> model = scene.visit([&](const auto&... parts) {
        return rollbem::SteadyFrictionModel<double>(scene.contact, parts..., {1, means});
    });
    const rollbem::FrictionState<double> rest = model.at_rest();
    rollbem::FrictionState<double> state = rest;
    const rollbem::FrictionWorkspace<double> fresh = model.workspace();
    rollbem::FrictionWorkspace<double> workspace = fresh;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const double ratio = curve.ratios[i], xi = creepage(scene, ratio);
        const auto solve = [&] {
            workspace = fresh;  // without factors
            return model.solve(rest, xi, state, workspace);
        };
        const rollbem::FrictionStep<double> step = solve();
        study::Cell time_us;
        if (curve.timed()) time_us = study::median_time_us([&] { return solve().force_per_width; });

        const bool usable = consistent && step.status == rollbem::StepStatus::ok;
        const auto if_usable = [&](double value) { return usable ? value : std::nan(""); };
        const double force_ratio = if_usable(-step.force_per_width / mu_N);
        const std::optional<double> exact = curve.exact_force(ratio);
        const std::string status = status_of(step.status, consistent);
        emit({scene.method, scene.derivative, scene.mesh_name, scene.n(), scene.alpha_L, scene.alpha_T, ratio,
              force_ratio, exact, relative_error(force_ratio, exact), step.stick_count, step.rounds,
              step.complementarity_residual, time_us, assembly_us,
              if_usable(-step.tangent_per_width * creepage(scene, 1) / mu_N),
              if_usable(step.slip_work_per_width / mu_N), step.pivots, status});
        if (curve.profiles != nullptr) {
            curve.profiles->keep(task, i, profile_of(scene, ratio, status, means, state, workspace.slip()));
        }
    }
}

/// At the centres of the cosine mesh that takes over where the border has no exact solution.
Profile profile_of(const study::Scene& scene, double ratio, const rollbem::StickBorderSolution<double>& solution,
                   const Pressure& pressure) {
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh<double>(scene.n());
    const std::optional<double> alpha = solution.exact ? std::nullopt : std::optional(0.5);
    Profile profile{&scene,
                    solution.exact ? "fitted" : "cosine",
                    alpha,
                    alpha,
                    ratio,
                    name(solution.status),
                    mesh,
                    Eigen::VectorXd(scene.n()),
                    pressure(mesh).matrix(),
                    Eigen::VectorXd(scene.n()),
                    {}};
    for (Eigen::Index k = 0; k < scene.n(); ++k) {
        const double x = mesh.centres()[k];
        if (solution.exact) profile.bound[k] = pressure(x);
        profile.traction[k] = solution.traction(x);
        profile.slip[k] = solution.slip(x);
        profile.sticks.push_back(solution.exact ? x > solution.border : profile.slip[k] == 0);
    }
    return profile;
}

/// The same with the exact border between slip and stick.
void fitted_rows(const CreepCurve& curve, const study::Scene& scene, std::size_t task, study::RowRange range,
                 const study::Emit& emit) {
    for (std::size_t i = range.first; i < range.last; ++i) {
        const double ratio = curve.ratios[i];
        const auto solve = [&] {
            return std::visit(
                [&](const auto& kernel) {
                    return rollbem::solve_stick_border(scene.contact, kernel, 1.0, curve.pressure,
                                                       creepage(scene, ratio), scene.n());
                },
                scene.kernel);
        };
        const rollbem::StickBorderSolution<double> solution = solve();
        study::Cell time_us;
        if (curve.timed()) time_us = study::median_time_us([&] { return solve().force_per_width; });

        Profile profile = profile_of(scene, ratio, solution, curve.pressure);
        const double force_ratio =
            solution.status == rollbem::StepStatus::ok ? -solution.force_per_width / mu_N : std::nan("");
        const std::optional<double> exact = curve.exact_force(ratio);
        emit({scene.method, scene.derivative, profile.mesh_name, scene.n(), profile.alpha_L, profile.alpha_T, ratio,
              force_ratio, exact, relative_error(force_ratio, exact),
              std::count(profile.sticks.begin(), profile.sticks.end(), true), solution.evaluations,
              solution.complementarity_residual, time_us, study::Cell(),
              -solution.tangent_per_width * creepage(scene, 1) / mu_N, solution.slip_work_per_width / mu_N, 0,
              profile.status});
        if (curve.profiles != nullptr) curve.profiles->keep(task, i, std::move(profile));
    }
}

/// Throws BadInput for options that have no effect where there are no elements.
void refuse_element_options(const study::Options& options) {
    for (const char* name : {"mesh", "edges", "method", "derivative", "alpha-L", "alpha-T", "alpha"}) {
        options.ignored(name, "with --fit-border, which needs no elements");
    }
}

}  // namespace

void run_steady(const study::Options& options, const Pressure& pressure) {
    for (const char* name : {"sine", "shift", "dq", "until", "integrator", "unchecked"}) {
        options.ignored(name, "without --transient");
    }
    options.ignored("lambda", "without --transient: a steady problem builds no G, the only matrix lambda acts on");
    const bool fits = options.flag("fit-border");
    if (fits) refuse_element_options(options);
    CreepCurve curve{options, pressure, options.numbers("creepage-ratio", study::finite()), nullptr};
    const std::vector<study::Scene> scenes = study::make_scenes(options, study::Problem::steady);

    std::optional<study::TableFile> tractions;
    if (options.given("tractions")) tractions.emplace(options, "tractions");
    Profiles profiles;
    if (tractions || options.given("plot")) curve.profiles = &profiles;

    study::Table table;
    table.columns = columns;
    table.rows_of_task.assign(scenes.size(), curve.ratios.size());
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        (fits ? fitted_rows : plain_rows)(curve, scenes[task], task, range, emit);
    };
    const auto write_tractions = [&] {
        if (tractions) write_profiles(profiles, pressure, study::has_header(options), *tractions);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        write_tractions();  // before the drawing, which may fail
        return creep_curve(columns, rows, profiles, pressure, curve.ratios);
    };
    study::write_table(options, table);
    if (!options.given("plot")) write_tractions();
}

}  // namespace friction
