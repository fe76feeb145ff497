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
#include "support/non_steady.hpp"
#include "support/progress.hpp"
#include "support/runs.hpp"
#include "support/scenes.hpp"
#include "support/sheet.hpp"
#include "surface.hpp"

namespace friction {

namespace {

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
};

History make_history(const study::Options& options, double until) {
    History history;
    history.load = read_load(options, until);
    if (options.given("lateral-ratio")) history.lateral = options.number("lateral-ratio", study::finite());
    if (options.given("spin-ratio")) history.spin = options.number("spin-ratio", study::finite());
    if (options.given("shift")) history.shift = options.number("shift", study::finite());
    history.from_steady = options.choice("from", {"rest", "steady"}) == "steady";
    if (options.given("sine")) {
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

/// What all runs share.
struct Problem {
    History history;
    double dq, layer;
    std::optional<FallingLaw> falling;
    rollbem::Integrator integrator;
    bool hertz;  ///< the closed forms hold
    bool checked;

    bool resolved() const {
        return (!history.omega || study::resolves(*history.omega, dq)) && (!history.load || history.load->resolved(dq));
    }
    std::optional<double> exact_shift(const rollbem::Contact<double>& contact) const {
        if (!hertz || layer > 0 || history.load || falling || !study::plane_model_decays(contact)) return std::nullopt;
        return rollbem::cattaneo_force_ratio(*history.shift, contact.poisson_ratio(), contact.aspect());
    }
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

/// A row of the table. What steps did not follow is not `valid`; of a run that has ended nothing is `computed`.
struct TimeRow {
    const Problem& problem;
    double q, shift;
    Ratios ratios;
    Moment moment;
    double slip_work, jump_work, creep_work;
    std::optional<double> exact;
    bool computed, valid;
    std::string status;

    double load_ratio() const { return problem.history.load_at(q); }
    study::Cell falling(std::size_t k) const { return falling_cells(problem.falling)[k]; }
};

template <class Value>
auto if_valid(const Value& value) {
    return [value](const TimeRow& r) { return r.valid ? study::Cell(value(r)) : study::Cell(); };
}
template <class Value>
auto if_computed(const Value& value) {
    return [value](const TimeRow& r) { return r.computed ? study::Cell(value(r)) : study::Cell(); };
}

const study::Sheet<TimeRow>& time_sheet() {
    using R = TimeRow;
    static const study::Sheet<TimeRow> columns{
        "",
        {{"q_over_a", "distance rolled, of a_0; the first row is at q = dq, with --shift one at q = 0 comes before",
          [](const R& r) { return r.q; }},
         {"creepage_ratio", "there; linear over a step (its end value with implicit-euler)",
          [](const R& r) { return r.ratios.longitudinal; }},
         {"shift", "imposed in this row, in mu p0 a/G", [](const R& r) { return r.shift; }},
         {"force_ratio", "-F_x/(mu N_0)", if_valid([](const R& r) { return r.moment.force_ratio; })},
         {"stick_count", "elements that stick", if_valid([](const R& r) { return r.moment.stick_count; })},
         {"rounds", "of all solutions of a step, two with sdirk2",
          if_computed([](const R& r) { return r.moment.rounds; })},
         {"slip_work", "cumulative, in mu N mu p0 a/G", if_valid([](const R& r) { return r.slip_work; })},
         {"exact", "Cattaneo's after a shift from rest (plane model of this b/a), where it holds",
          if_valid([](const R& r) { return r.exact; })},
         {"relative_error", "force_ratio/exact - 1",
          if_valid([](const R& r) { return relative_error(r.moment.force_ratio, r.exact); })},
         {"complementarity_residual", "as in steady rolling",
          if_computed([](const R& r) { return r.moment.complementarity_residual; })},
         {"pivots", "as in steady rolling", if_valid([](const R& r) { return r.moment.pivots; })},
         {"status",
          "unchecked instead of ok with --unchecked; unresolved, with empty results, with fewer than six steps in a "
          "period "
          "of --sine (OMEGA --dq > 1) or of --load-sine (2 pi --dq > LENGTH); why a step failed; after_failure behind "
          "it",
          [](const R& r) { return r.status; }},
         {"method, derivative, mesh, n, alpha_L, alpha_T, lambda", "the scheme"},
         {"integrator", "as given", [](const R& r) { return study::word(r.problem.integrator); }},
         {"lateral_ratio", "as creepage_ratio", [](const R& r) { return r.ratios.lateral; }},
         {"load_ratio", "N/N_0", [](const R& r) { return r.load_ratio(); }},
         {"half_length_ratio", "a/a_0, Hertz's", [](const R& r) { return std::sqrt(r.load_ratio()); }},
         {"lateral_force_ratio", "-F_y/(mu N_0)", if_valid([](const R& r) { return r.moment.lateral_force_ratio; })},
         {"spin_ratio", "phi a_0 as creepage_ratio",
          [](const R& r) { return r.ratios.lateral ? study::Cell(r.ratios.spin) : study::Cell(); }},
         {"moment_ratio", "-M_z/(mu N_0 a_0)", if_valid([](const R& r) { return r.moment.moment_ratio; })},
         {"creep_work", "-int F.xi dq from the forces at both ends of a step (at its end with implicit-euler)",
          if_valid([](const R& r) { return r.creep_work; })},
         {"layer", "--layer", [](const R& r) { return r.problem.layer; }},
         {"falling_ratio", "--falling and --memory", [](const R& r) { return r.falling(0); }},
         {"half_velocity", "--falling and --memory", [](const R& r) { return r.falling(1); }},
         {"memory_distance", "--falling and --memory", [](const R& r) { return r.falling(2); }},
         {"least_velocity", "--falling and --memory", [](const R& r) { return r.falling(3); }},
         {"elastic_energy", "in the same unit as slip_work",
          if_valid([](const R& r) { return r.moment.elastic_energy; })},
         {"jump_work", "elastic energy that jumps of the tractions release, as under --falling",
          if_valid([](const R& r) { return r.jump_work; })}},
        study::settings};
    return columns;
}

/// One run of a scene.
class Run {
public:
    Run(const Problem& problem, const study::Scene& scene, const StartRolling& start)
        : problem_(problem), history_(problem.history), scene_(scene), contact_(start()) {}

    /// Emits the rows of `range`, but steps from the start, as the state requires. Returns why the run ended before
    /// these rows did; nothing if it did not.
    std::string rows(study::RowRange range, const study::Emit& emit) {
        std::size_t k = 0;
        if (history_.shift) {
            const Ratios shift{*history_.shift, history_.lateral ? std::optional(0.0) : std::nullopt};
            const Moment next = contact_->shift(shift);
            keep(next, 0, creep_work(now_, next, shift, shift, true));
            if (k++ >= range.first) {
                emit(row(0, {0, shift.lateral}, *history_.shift, now_, problem_.exact_shift(scene_.contact)));
            }
        }
        if (history_.from_steady) {
            Moment next = contact_->settle(history_.at(0));
            next.slip_work = next.jump_work = 0;
            keep(next, 0, 0);
        }
        const std::size_t shifts = k;
        for (; k < range.last; ++k) {
            const double end = double(k - shifts + 1) * problem_.dq;
            const bool over = !ended_.empty();
            advance(double(k - shifts) * problem_.dq, end);
            if (k < range.first) continue;
            emit(row(end, history_.at(end), 0, over ? std::nullopt : std::optional(now_), std::nullopt));
        }
        return ended_;
    }

private:
    /// Over the distance of a row, unless the run has ended.
    void advance(double from, double end) {
        int rounds = 0;
        Moment next;  // of the last step, also if that failed
        const auto step = [&](double low, double high) {
            next = contact_->advance(high - low, history_.at(low), history_.at(high), history_.load_at(high));
            if (next.status != rollbem::StepStatus::ok) return next.status;
            rounds += next.rounds;
            const bool both_ends = problem_.integrator == rollbem::Integrator::sdirk2;
            keep(next, high,
                 creepage(scene_, 1) * (high - low) *
                     creep_work(now_, next, history_.at(low), history_.at(high), both_ends));
            return next.status;
        };
        if (!ended_.empty()) return;
        const auto failed = study::roll(from, end, history_.load ? &*history_.load : nullptr, step);
        if (failed) {
            rounds += next.rounds;
            keep(next, *failed, 0);
        }
        now_.rounds = rounds;
    }

    /// The state before a failed step is not that of a later instant: the run is over.
    void keep(const Moment& next, double q, double work) {
        now_ = next;
        if (next.status == rollbem::StepStatus::ok) {
            slip_work_ += next.slip_work;
            jump_work_ += next.jump_work;
            creep_work_ += work;
        } else {
            ended_ = study::why_ended(q, next.status);
        }
    }

    std::string status(const std::optional<Moment>& moment) const {
        if (!moment) return study::after_failure;
        if (moment->status != rollbem::StepStatus::ok) return name(moment->status);
        return !problem_.resolved() ? study::unresolved : problem_.checked ? study::ok : study::unchecked;
    }

    study::Row row(double q, const Ratios& ratios, double shift, const std::optional<Moment>& of_row,
                   std::optional<double> exact) const {
        const Moment moment = of_row.value_or(Moment{});
        return time_sheet().row(scene_, {.problem = problem_,
                                         .q = q,
                                         .shift = shift,
                                         .ratios = ratios,
                                         .moment = moment,
                                         .slip_work = slip_work_,
                                         .jump_work = jump_work_,
                                         .creep_work = creep_work_,
                                         .exact = exact,
                                         .computed = of_row.has_value(),
                                         .valid = moment.status == rollbem::StepStatus::ok && problem_.resolved(),
                                         .status = status(of_row)});
    }

    const Problem& problem_;
    const History& history_;
    const study::Scene& scene_;
    std::unique_ptr<Rolling> contact_;
    Moment now_{.force_ratio = 0, .lateral_force_ratio = 0, .status = rollbem::StepStatus::ok};
    double slip_work_ = 0, jump_work_ = 0, creep_work_ = 0;
    std::string ended_;  // why, if it did
};

}  // namespace

std::string transient_help() { return time_sheet().help(); }

void run_transient(const study::Options& options, const Pressure& pressure) {
    const study::Steps steps = study::read_steps(options);
    Problem problem{.history = make_history(options, double(steps.count) * steps.dq),
                    .dq = steps.dq,
                    .layer = read_layer(options),
                    .falling = read_falling(options),
                    .integrator = rollbem::Integrator::sdirk2,
                    .hertz = pressure.hertz,
                    .checked = !options.flag("unchecked")};
    const History& history = problem.history;
    using rollbem::Integrator;
    problem.integrator = study::read_integrator(options, {Integrator::sdirk2, Integrator::implicit_euler});

    const std::vector<study::Scene> scenes = study::make_non_steady_scenes(options);
    std::vector<StartRolling> starts;
    study::Progress checking(options.program(), scenes.size(), study::shows_progress(options), "schemes checked");
    for (const study::Scene& scene : scenes) {
        checking.doing(scene.label());
        starts.push_back(make_rolling(options, scene, pressure, history.load, history.lateral.has_value(),
                                      problem.falling, problem.integrator, steps.dq));
        checking.update(starts.size());
    }
    checking.clear();
    std::vector<std::string> ended(scenes.size());
    study::Table table = study::table_of(time_sheet().names(), scenes, steps.count + (history.shift ? 1 : 0));
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        ended[task] = Run(problem, scenes[task], starts[task]).rows(range, emit);
    };
    table.plot = [&](const std::vector<study::Row>& rows) {
        return force_in_time(
            time_sheet().names(), rows,
            {.creepage_changes = history.omega.has_value(),
             .load_changes = history.load.has_value(),
             .falling = problem.falling.has_value(),
             .carter = pressure.hertz && problem.layer == 0 && !problem.falling && !history.lateral && !history.load,
             .ratio = history.amplitude,
             .end = double(steps.count) * steps.dq,
             .scene = scene_in_title(options)});
    };
    table.resumable = !options.given("plot");
    study::write_runs(options, table, ended);
}

}  // namespace friction
