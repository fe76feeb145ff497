#include "transient.hpp"

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/friction.hpp>

#include "load.hpp"
#include "plots.hpp"
#include "rolling.hpp"
#include "support/errors.hpp"
#include "support/files.hpp"
#include "support/non_steady.hpp"
#include "support/progress.hpp"
#include "support/runs.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "surface.hpp"

namespace friction {

namespace {

const std::vector<std::string> columns = study::joined(
    study::cells_of("q_over_a,creepage_ratio,shift,force_ratio,stick_count,rounds,slip_work,exact,relative_error,"
                    "complementarity_residual,pivots,status,method,derivative,mesh,n,alpha_L,alpha_T,lambda,integrator,"
                    "lateral_ratio,load_ratio,half_length_ratio,lateral_force_ratio,spin_ratio,moment_ratio,creep_work,"
                    "layer,falling_ratio,half_velocity,memory_distance,least_velocity,elastic_energy,jump_work"),
    study::setting_columns());

/// Creepage ratios and load over q/a, and what comes before.
struct History {
    double amplitude = 0;
    std::optional<double> omega{};    ///< of a sine [V/a]; constant without
    std::optional<double> lateral{};  ///< constant; nothing in one direction
    double spin = 0;                  ///< constant
    std::optional<double> shift{};    ///< rigid, before rolling [mu p0 a/G]
    bool from_steady = false;         ///< starts from steady rolling
    std::optional<study::LoadHistory> load{};

    Ratios at(double q) const { return {omega ? amplitude * std::sin(*omega * q) : amplitude, lateral, spin}; }
    double load_at(double q) const { return load ? load->at(q) : 1; }
    double next_stop(double from, double to) const { return load ? load->next_stop(from, to) : to; }
};

History make_history(const study::Options& options, double until) {
    History history;
    history.load = read_load(options, until);
    if (options.given("lateral-ratio")) history.lateral = options.number("lateral-ratio", study::finite());
    if (!history.lateral) options.ignored("spin-ratio", "without --lateral-ratio");
    if (options.given("spin-ratio")) history.spin = options.number("spin-ratio", study::finite());
    if (options.given("shift")) {
        options.ignored("from", "with --shift, which starts from rest");
        history.shift = options.number("shift", study::finite());
    }
    history.from_steady = options.choice("from", {"rest", "steady"}) == "steady";
    if (options.given("sine")) {
        options.ignored("creepage-ratio", "with --sine");
        const study::Sine sine = study::read_sine(options);
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
    const StartRolling& start;
    const History& history;
    double dq, layer;
    const std::optional<FallingLaw>& falling;
    rollbem::Integrator integrator;
    bool hertz;  ///< the closed forms hold
    bool checked;

    std::string status(const std::optional<Moment>& moment) const {
        if (!moment) return study::after_failure;
        if (moment->status != rollbem::StepStatus::ok) return name(moment->status);
        return !resolved() ? study::unresolved : checked ? study::ok : study::unchecked;
    }
    bool resolved() const {
        return (!history.omega || study::resolves(*history.omega, dq)) && (!history.load || history.load->resolved(dq));
    }

    std::optional<double> exact_shift() const {
        if (!hertz || layer > 0 || history.load || falling || !study::plane_model_decays(scene.contact))
            return std::nullopt;
        return rollbem::cattaneo_force_ratio(*history.shift, scene.contact.poisson_ratio(), scene.contact.aspect());
    }

    /// Emits the rows of `range`, but steps from the start, as the state requires. Returns why the run ended before
    /// these rows did; nothing if it did not.
    std::string rows(study::RowRange range, const study::Emit& emit) const;
};

/// -F.s of a relative motion s: the mean of the forces at both ends of a step (at its end with implicit Euler, which
/// knows no other) times what the rigid bodies have moved.
double creep_work(const Moment& before, const Moment& after, const Ratios& start, const Ratios& end, bool both_ends) {
    const auto part = [&](double force_start, double force_end, double from, double to) {
        return both_ends ? (force_start * from + force_end * to) / 2 : force_end * to;
    };
    double work = part(before.force_ratio, after.force_ratio, start.longitudinal, end.longitudinal);
    if (end.lateral) {
        work += part(before.lateral_force_ratio.value_or(0), after.lateral_force_ratio.value_or(0), *start.lateral,
                     *end.lateral);
        work += part(before.moment_ratio.value_or(0), after.moment_ratio.value_or(0), start.spin, end.spin);
    }
    return work;
}

std::string Run::rows(study::RowRange range, const study::Emit& emit) const {
    const std::unique_ptr<Rolling> contact = start();
    const bool both_ends = integrator == rollbem::Integrator::sdirk2;
    double slip_work = 0, jump_work = 0, work = 0;
    std::size_t row = 0;
    const auto record = [&](double q, const Ratios& ratios, double shift, const std::optional<Moment>& of_row,
                            std::optional<double> exact) {
        if (row++ < range.first) return;
        const Moment moment = of_row.value_or(Moment{});
        const auto given_if = [](bool condition) {
            return [condition](const auto& value) { return condition ? study::Cell(value) : study::Cell(); };
        };
        const auto computed = given_if(of_row.has_value());
        // what steps did not follow is left out
        const auto valid = given_if(moment.status == rollbem::StepStatus::ok && resolved());
        emit(study::row_of(
            {{q, ratios.longitudinal, shift, valid(moment.force_ratio), valid(moment.stick_count)},
             {computed(moment.rounds), valid(slip_work), valid(exact),
              valid(relative_error(moment.force_ratio, exact))},
             {computed(moment.complementarity_residual), valid(moment.pivots), status(of_row)},
             {scene.method, scene.derivative, scene.mesh_name, scene.n(), scene.alpha_L, scene.alpha_T, scene.lambda},
             {study::word(integrator), ratios.lateral, history.load_at(q), std::sqrt(history.load_at(q))},
             {valid(moment.lateral_force_ratio), ratios.lateral ? study::Cell(ratios.spin) : study::Cell()},
             {valid(moment.moment_ratio), valid(work), layer},
             falling_cells(falling),
             {valid(moment.elastic_energy), valid(jump_work)},
             study::setting_cells(scene)}));
    };
    Moment now{.force_ratio = 0, .lateral_force_ratio = 0, .status = rollbem::StepStatus::ok};
    std::string ended;
    // The state before a failed step is not that of a later instant: the run is over.
    const auto keep = [&](const Moment& next, double q, double done) {
        now = next;
        if (next.status == rollbem::StepStatus::ok) {
            slip_work += next.slip_work;
            jump_work += next.jump_work;
            work += done;
        } else {
            ended = study::why_ended(q, next.status);
        }
    };
    if (history.shift) {
        const Ratios shift{*history.shift, history.lateral ? std::optional(0.0) : std::nullopt};
        const Moment next = contact->shift(shift);
        keep(next, 0, creep_work(now, next, shift, shift, true));
        record(0, {0, shift.lateral}, *history.shift, now, exact_shift());
    }
    if (history.from_steady) {
        Moment next = contact->settle(history.at(0));
        next.slip_work = next.jump_work = 0;
        keep(next, 0, 0);
    }
    int rounds = 0;
    Moment next;  // of the last step, also if that failed
    const auto step = [&](double from, double to) {
        next = contact->advance(to - from, history.at(from), history.at(to), history.load_at(to));
        if (next.status != rollbem::StepStatus::ok) return next.status;
        rounds += next.rounds;
        keep(next, to,
             creepage(scene, 1) * (to - from) * creep_work(now, next, history.at(from), history.at(to), both_ends));
        return next.status;
    };
    const std::size_t shifts = row;
    while (row < range.last) {
        const double end = double(row - shifts + 1) * dq;
        const bool over = !ended.empty();
        rounds = 0;
        for (double from = double(row - shifts) * dq; from < end && ended.empty();) {
            const double to = history.next_stop(from, end);
            if (const auto failed = study::roll(from, to, step)) {
                rounds += next.rounds;
                keep(next, *failed, 0);
            }
            from = to;
        }
        now.rounds = rounds;
        record(end, history.at(end), 0, over ? std::nullopt : std::optional(now), std::nullopt);
    }
    return ended;
}

}  // namespace

void run_transient(const study::Options& options, const Pressure& pressure) {
    for (const char* name : {"tractions", "fit-border"}) options.ignored(name, "with --transient");
    const study::Steps steps = study::read_steps(options);
    const History history = make_history(options, double(steps.count) * steps.dq);
    const double layer = read_layer(options);
    const std::optional<FallingLaw> falling = read_falling(options);
    options.ignored("sweep", "with --transient");
    using rollbem::Integrator;
    const Integrator integrator = study::read_integrator(options, {Integrator::sdirk2, Integrator::implicit_euler});

    const std::vector<study::Scene> scenes = study::make_non_steady_scenes(options);
    std::vector<StartRolling> starts;
    study::Progress checking(options.program(), scenes.size(), study::shows_progress(options), "schemes checked");
    for (const study::Scene& scene : scenes) {
        checking.doing(scene.label());
        starts.push_back(make_rolling(options, scene, pressure, history.load, history.lateral.has_value(), falling,
                                      integrator, steps.dq));
        checking.update(starts.size());
    }
    checking.clear();
    std::vector<std::string> ended(scenes.size());
    study::Table table = study::table_of(columns, scenes, steps.count + (history.shift ? 1 : 0));
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        ended[task] = Run{scenes[task], starts[task],   history,
                          steps.dq,     layer,          falling,
                          integrator,   pressure.hertz, !options.flag("unchecked")}
                          .rows(range, emit);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        return force_in_time(columns, rows,
                             {.creepage_changes = history.omega.has_value(),
                              .load_changes = history.load.has_value(),
                              .falling = falling.has_value(),
                              .carter = pressure.hertz && layer == 0 && !falling && !history.lateral && !history.load,
                              .ratio = history.amplitude,
                              .end = double(steps.count) * steps.dq,
                              .scene = scene_in_title(options)});
    };
    study::write_runs(options, table, ended);
}

}  // namespace friction
