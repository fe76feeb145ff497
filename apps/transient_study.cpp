// Rolling in the time domain: the force after a step, a ramp, a sine or any history of creepage from rest, step by
// step, against the exact response of the plane model:
//
//     ./transient_study --step 1 --mesh cosine --alpha 0.5 --kernel plane --aspect 100 --poisson 0.25 --until 20
//     ./transient_study --step 1 --method chebyshev --n 24 --kernel plane --aspect 100 --integrator exponential
//     ./transient_study --history creepage.csv --integrator exponential --dq 0.1 --output force.csv --plot force.svg
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/rolling/run.hpp>

#include "support/non_steady.hpp"
#include "support/runs.hpp"
#include "support/sheet.hpp"

namespace {

using Model = rollbem::AdhesionModel<>;

constexpr study::Methods methods{.states = true};

const study::HistoryColumns columns{{"creepage"}};

/// Creepage over q/a from rest, and the exact force -F_bar/(a G) if there is one.
struct Creepage {
    std::string label;
    study::History history;
    std::function<double(const rollbem::reference::StepResponse& response, double q)> exact;

    double at(double q, bool behind) const { return history.at(columns.main(), q, behind); }
};

Creepage make_creepage(const study::Options& options) {
    using Response = rollbem::reference::StepResponse;
    const study::History given = study::read_history(options, columns);
    if (!given.has(columns.main())) throw study::BadInput("one of --step, --ramp, --sine and --history must be given");
    const double at_1 = given.at(columns.main(), 1, false);
    if (options.given("step")) {
        return {"a step of creepage", given,
                [=](const Response& response, double q) { return at_1 * response.step(q); }};
    }
    if (options.given("ramp")) {
        return {"a ramp of creepage", given,
                [=](const Response& response, double q) { return at_1 * response.ramp(q); }};
    }
    if (options.given("sine")) {
        const study::Sine sine = study::read_sine(options);
        return {"a sine of creepage, ω a/V = " + study::Cell(sine.omega).text(6), given,
                [=](const Response& response, double q) { return sine.amplitude * response.sine(sine.omega, q); }};
    }
    return {"creepage of a table", given, [table = given](const Response& response, double q) {
                return response.history(table.places(), table.values(columns.main()), q);
            }};
}

/// The largest |creepage| of the run, the reference for the force, knots within the run included. Throws BadInput if it
/// is 0.
double largest_creepage(const Creepage& creepage, const study::Steps& steps) {
    double largest = 0;
    for (std::size_t k = 1; k <= steps.count; ++k) {
        largest = std::max(largest, std::abs(creepage.at(static_cast<double>(k) * steps.dq, false)));
    }
    const double end = static_cast<double>(steps.count) * steps.dq;
    const study::Numbers& places = creepage.history.places();
    for (std::size_t j = 0; j < places.size(); ++j) {
        if (places[j] <= end) largest = std::max(largest, std::abs(creepage.history.values(columns.main())[j]));
    }
    if (largest == 0) throw study::BadInput("the creepage must not be 0 all the way up to --until");
    return largest;
}

/// The creepage and force after a step.
struct Moment {
    double q, creepage, force;
    std::optional<double> exact;
    std::string integrator, status;

    std::optional<double> error() const {
        return exact && *exact != 0 ? std::optional(force / *exact - 1) : std::nullopt;
    }
};

const study::Sheet<Moment> sheet{
    "",
    {{"q_over_a", "distance rolled q/a; the first row is at q = dq", &Moment::q},
     {"creepage", "creepage at q", &Moment::creepage},
     {"force", "force -F_bar/(a G xi_ref), xi_ref the largest |creepage| of the run", &Moment::force},
     {"exact",
      "exact force of the plane model, b >> a, whatever the kernel: the strip kernel differs from it by O((a/b)^2); "
      "empty if the plane model itself is unstable (b/a below 0.18 at nu = 0.25)",
      &Moment::exact},
     {"relative_error", "force/exact - 1", &Moment::error},
     {"method, derivative, mesh, n, alpha_L, alpha_T, lambda", "scheme, as in its options"},
     {"integrator", "integrator, as in its option", &Moment::integrator},
     {"status",
      "ok; unresolved, with an empty force, if OMEGA --dq > 1: fewer than six steps in a period of --sine; unchecked "
      "with --unchecked, which steps schemes that are refused without it: those that are not certainly stable, or "
      "whose steady tractions assist the creepage (alpha near or below 0, or above 1)",
      &Moment::status}},
    study::settings};

/// A model, or two whose forces are extrapolated, the coarse one last; and the exact response of the contact.
struct Rolling {
    double order;  ///< of convergence
    std::vector<Model> models{};
    std::optional<rollbem::reference::StepResponse> exact{};
};

/// One run: emits the rows of `range`, but steps from the start, because each state needs the one before.
void run(const Rolling& rolling, const Creepage& creepage, const study::Steps& steps, bool checked,
         study::RowRange range, const study::Results<Moment>& emit) {
    const bool resolved = creepage.history.resolved(steps.dq);
    const std::string status = !resolved ? study::unresolved : checked ? study::ok : study::unchecked;

    // 3. The reference for the force.
    const double reference = largest_creepage(creepage, steps);

    // 4. Step by step, with creepage linear over each. A step with a knot inside is divided there.
    std::vector<rollbem::Run<Model>> contacts(rolling.models.begin(), rolling.models.end());
    for (std::size_t k = 1; k <= std::min(range.last, steps.count); ++k) {
        const double start = static_cast<double>(k - 1) * steps.dq, end = static_cast<double>(k) * steps.dq;
        double force = 0;
        const auto failed = study::roll(start, end, creepage.history.places(), [&](double from, double to) {
            const auto motion = rollbem::RigidMotion<double>::linear(creepage.at(from, true), creepage.at(to, false));
            std::vector<double> forces;
            for (auto& contact : contacts) {
                const auto step = contact.advance({from == start && to == end ? steps.dq : to - from, motion});
                if (step.status != rollbem::Status::ok) return step.status;
                forces.push_back(-step.force_per_width / reference);  // a = G = 1
            }
            force = forces.size() == 1 ? forces[0] : rollbem::richardson(forces[1], forces[0], rolling.order);
            return rollbem::Status::ok;
        });
        if (failed) {
            throw study::BadInput("the force is not finite at q/a = " + study::Cell(end).text(6) +
                                  ": creepage or --until is too large");
        }
        if (k <= range.first) continue;

        // 5. Compare with the exact response of the plane model.
        emit({end, creepage.at(end, false), resolved ? force : std::nan(""),
              rolling.exact ? std::optional(creepage.exact(*rolling.exact, end) / reference) : std::nullopt,
              study::word(rolling.models.front().integrator()), status});
    }
}

/// The force over the distance with the exact one if there is one, and beside it their difference, as the curves
/// coincide.
study::Picture draw_force(const Creepage& creepage, const study::Records& rows) {
    study::Plot force{
        .title = "Rolling from rest, " + creepage.label, .x = {"distance rolled q/a"}, .y = {"-F / (a G ξ_{ref})"}};
    study::Plot difference{force.title, force.x, {"|F - F_{exact}| / (a G ξ_{ref})", true}};
    sheet.draw(force, rows, {.x = "q_over_a", .y = "force"});
    add_series(
        force, rows,
        {.by = {"aspect", "poisson"}, .x = "q_over_a", .y = "exact", .prefix = "exact", .look = study::Look::exact});
    study::Records errors = rows;
    const std::size_t column = study::index_of(rows.columns, "force");
    for (study::Row& row : errors.rows) row[column] = rows.number(row, "force") - rows.number(row, "exact");
    sheet.draw(difference, errors, {.x = "q_over_a", .y = "force", .absolute = true});
    return {force, difference};
}

void add_options(study::Options& options) {
    options.set_default("n", "40");
    study::add_history_options(options, columns);
    study::add_steps(options);
    study::add_integrator(options, false);
    options.add_flag(
        "unchecked",
        "no check of the schemes: those that are unstable, may be unstable or do not converge are stepped, too");
    study::offer_chebyshev(options);
    study::offer_schemes(options, methods);
    options.footer(
        R"(Example: the step response of the second-order scheme
  transient_study --step 1 --mesh cosine --alpha 0.5 --kernel plane --aspect 100 --poisson 0.25 \
      --integrator exponential --until 40 --output step.csv --plot step.svg

One row per step:
)" + sheet.help() +
        R"(--method chebyshev: columns that apply to elements only are empty. Smooth motion needs few states, a jump
more: 12 states have an error of 4e-5 one half-length after it, 8 states of 2e-7 five half-lengths after it.
)");
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options(
        "transient_study",
        "Force of a contact that rolls from rest under a given creepage, step by step, and its error.");
    add_options(options);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const study::Steps steps = study::read_steps(given);
        const Creepage creepage = make_creepage(given);
        const bool checked = !given.flag("unchecked");
        const rollbem::Integrator integrator = study::read_integrator(given, false);

        const std::vector<study::Scene> scenes = study::make_non_steady_scenes(given, methods);
        std::vector<Rolling> runs;
        study::Table table = sheet.table(
            scenes, [&](const study::Scene&) { return steps.count; },
            [&](const study::Scene& scene, study::RowRange range, const study::Results<Moment>& emit) {
                run(runs[std::size_t(&scene - scenes.data())], creepage, steps, checked, range, emit);
            });

        // 2. One model for each scene, if eigenvalues and steady rolling tell that stepping makes sense, and the exact
        // response of its contact.
        study::prepare_runs(table, runs, scenes, [&](const study::Scene& scene) {
            Rolling rolling{scene.order()};
            for (const study::Scene& one : scene.meshes()) {
                rollbem::RollingSystem<double> system = study::system_of(one);
                if (checked) study::require_steppable(one, system);
                rolling.models.emplace_back(one.contact, std::move(system), rollbem::unchecked, integrator);
            }
            if (study::plane_model_decays(scene.contact)) {
                rolling.exact.emplace(scene.contact.poisson_ratio(), scene.contact.aspect());
            }
            return rolling;
        });
        table.plot = [&](const study::Records& rows) { return draw_force(creepage, rows); };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
