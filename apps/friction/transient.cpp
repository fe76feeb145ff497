#include "transient.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>

#include "plots.hpp"
#include "support/errors.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"

namespace friction {

namespace {

const std::vector<std::string> columns{
    "q_over_a", "creepage_ratio", "shift",   "force_ratio",    "stick_count",
    "rounds",   "slip_work",      "exact",   "relative_error", "complementarity_residual",
    "pivots",   "status",         "method",  "derivative",     "mesh",
    "n",        "alpha_L",        "alpha_T", "lambda",         "integrator"};

/// Creepage ratio over q/a, and a rigid shift before.
struct History {
    double amplitude = 0;
    std::optional<double> omega{};  ///< of a sine [V/a]; constant without
    std::optional<double> shift{};  ///< [mu p0 a/G]

    double at(double q) const { return omega ? amplitude * std::sin(*omega * q) : amplitude; }
};

History make_history(const study::Options& options) {
    History history;
    if (options.given("shift")) history.shift = options.number("shift", study::finite());
    if (options.given("sine")) {
        options.ignored("creepage-ratio", "with --sine");
        const study::Sine sine = study::read_sine(options, {study::finite().holds, "finite"});
        history.amplitude = sine.amplitude;
        history.omega = sine.omega;
        return history;
    }
    if (!options.given("creepage-ratio")) {
        throw study::BadInput("one of --creepage-ratio and --sine must be given with --transient");
    }
    history.amplitude = options.number("creepage-ratio", study::finite());
    return history;
}

/// One run of a scene.
struct Run {
    const study::Scene& scene;
    const rollbem::FrictionModel<double>& model;
    const History& history;
    double dq;
    bool hertz;  ///< the closed forms hold

    std::optional<double> exact_shift() const {
        if (!hertz || !study::plane_model_decays(scene.contact)) return std::nullopt;
        return rollbem::cattaneo_force_ratio(*history.shift, scene.contact.poisson_ratio(), scene.contact.aspect());
    }

    /// Emits the rows of `range`, but steps from the start, as the state requires.
    void rows(study::RowRange range, const study::Emit& emit) const;
};

void Run::rows(study::RowRange range, const study::Emit& emit) const {
    rollbem::FrictionState<double> now = model.at_rest(), next = now;
    rollbem::FrictionWorkspace<double> workspace = model.workspace();
    double slip_work = 0;
    std::size_t row = 0;
    const auto record = [&](double q, double ratio, double shift, const rollbem::FrictionStep<double>& step,
                            std::optional<double> exact) {
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
              study::word(model.integrator())});
    };
    if (history.shift) {
        record(0, 0, *history.shift, model.shift(now, *history.shift, next, workspace), exact_shift());
    }
    const std::size_t shifts = row;
    while (row < range.last) {
        const double from = double(row - shifts) * dq, to = double(row - shifts + 1) * dq;
        const auto motion =
            rollbem::RigidMotion<double>::linear(creepage(scene, history.at(from)), creepage(scene, history.at(to)));
        record(to, history.at(to), 0, model.advance(now, dq, motion, next, workspace), std::nullopt);
    }
}

}  // namespace

void run_transient(const study::Options& options, const Pressure& pressure) {
    for (const char* name : {"tractions", "fit-border"}) options.ignored(name, "with --transient");
    const History history = make_history(options);
    const study::Steps steps = study::read_steps(options);
    using rollbem::Integrator;
    const Integrator integrator = study::read_integrator(options, {Integrator::sdirk2, Integrator::implicit_euler});

    const std::vector<study::Scene> scenes = study::make_non_steady_scenes(options);
    std::vector<rollbem::FrictionModel<double>> models;
    for (const study::Scene& scene : scenes) {
        models.emplace_back(scene.contact, study::steppable_system(options, scene), rollbem::unchecked,
                            rollbem::CoulombFriction<double>{1, pressure(*scene.mesh)}, integrator);
    }
    study::Table table;
    table.columns = columns;
    table.rows_of_task.assign(scenes.size(), steps.count + (history.shift ? 1 : 0));
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        Run{scenes[task], models[task], history, steps.dq, pressure.hertz}.rows(range, emit);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        const double force = rollbem::carter_force_ratio(history.amplitude), end = double(steps.count) * steps.dq;
        const study::Series steady{.label = "Carter, steady", .points = {{0, force}, {end, force}}, .markers = false};
        const bool has_steady = !history.omega && pressure.hertz;
        return force_in_time(columns, rows, history.omega.has_value(), has_steady ? &steady : nullptr);
    };
    study::write_table(options, table);
}

}  // namespace friction
