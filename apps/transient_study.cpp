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

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/rolling/run.hpp>

#include "support/non_steady.hpp"
#include "support/runs.hpp"
#include "support/sheet.hpp"

namespace {

using Model = rollbem::AdhesionModel<>;

constexpr study::Methods methods{.states = true};

const study::HistoryColumns columns{{"creepage"}};

/// A run from rest, its exact force -F_bar/(a G) if there is one, and the reference for forces.
struct Creepage {
    study::Run run;
    std::string label;
    std::function<double(const rollbem::reference::StepResponse& response, double q)> exact{};
    double largest = 0;  ///< |creepage|, knots within the run included

    double at(double q, bool behind) const { return run.imposed.at(columns.main(), q, behind); }
};

double largest_creepage(const Creepage& creepage) {
    const study::Run& run = creepage.run;
    double largest = 0;
    for (std::size_t k = 1; k <= run.steps.count; ++k) {
        largest = std::max(largest, std::abs(creepage.at(static_cast<double>(k) * run.steps.dq, false)));
    }
    const study::Numbers &places = run.imposed.places(), &values = run.imposed.values(columns.main());
    for (std::size_t j = 0; j < places.size() && places[j] <= run.until(); ++j) {
        largest = std::max(largest, std::abs(values[j]));
    }
    return largest;
}

Creepage read_creepage(const study::Options& options) {
    using Response = rollbem::reference::StepResponse;
    Creepage creepage{study::read_run(options, columns), "creepage of a table"};
    const study::History& given = creepage.run.imposed;
    if (!given.has(columns.main())) throw study::BadInput("one of --step, --ramp, --sine and --history must be given");
    const double at_1 = given.at(columns.main(), 1, false);
    if (options.given("step")) {
        creepage.label = "a step of creepage";
        creepage.exact = [=](const Response& response, double q) { return at_1 * response.step(q); };
    } else if (options.given("ramp")) {
        creepage.label = "a ramp of creepage";
        creepage.exact = [=](const Response& response, double q) { return at_1 * response.ramp(q); };
    } else if (options.given("sine")) {
        const auto [amplitude, omega] = study::read_sine(options);
        creepage.label = "a sine of creepage, ω a/V = " + study::Cell(omega).text(6);
        creepage.exact = [amplitude = amplitude, omega = omega](const Response& response, double q) {
            return amplitude * response.sine(omega, q);
        };
    } else {
        creepage.exact = [table = given](const Response& response, double q) {
            return response.history(table.places(), table.values(columns.main()), q);
        };
    }
    creepage.largest = largest_creepage(creepage);
    if (creepage.largest == 0) throw study::BadInput("the creepage must not be 0 all the way up to --until");
    return creepage;
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

/// One model for each mesh of a scene, if eigenvalues and steady rolling tell that stepping makes sense, and the exact
/// response of its contact.
Rolling make_rolling(const study::Scene& scene, const study::Run& run) {
    Rolling rolling{scene.order()};
    for (const study::Scene& one : scene.meshes()) {
        rollbem::RollingSystem<double> system = study::system_of(one);
        if (run.checked) study::require_steppable(one, system);
        rolling.models.emplace_back(one.contact, std::move(system), rollbem::unchecked, run.integrator);
    }
    if (study::plane_model_decays(scene.contact)) {
        rolling.exact.emplace(scene.contact.poisson_ratio(), scene.contact.aspect());
    }
    return rolling;
}

/// One run: emits the rows of `range`, but steps from the start, because each state needs the one before.
void roll(const Rolling& rolling, const Creepage& creepage, study::RowRange range, const study::Results<Moment>& emit) {
    const study::Run& run = creepage.run;
    const study::Steps& steps = run.steps;
    const bool resolved = run.imposed.resolved(steps.dq);
    const std::string status = !resolved ? study::unresolved : run.checked ? study::ok : study::unchecked;

    // 3. Step by step, with creepage linear over each. A step with a knot inside is divided there.
    std::vector<rollbem::Run<Model>> contacts(rolling.models.begin(), rolling.models.end());
    for (std::size_t k = 1; k <= std::min(range.last, steps.count); ++k) {
        const double start = static_cast<double>(k - 1) * steps.dq, end = static_cast<double>(k) * steps.dq;
        double force = 0;
        const auto failed = study::roll(start, end, run.imposed.places(), [&](double from, double to) {
            const auto motion = rollbem::RigidMotion<double>::linear(creepage.at(from, true), creepage.at(to, false));
            std::vector<double> forces;
            for (auto& contact : contacts) {
                const auto step = contact.advance({from == start && to == end ? steps.dq : to - from, motion});
                if (step.status != rollbem::Status::ok) return step.status;
                forces.push_back(-step.force_per_width / creepage.largest);  // a = G = 1
            }
            force = forces.size() == 1 ? forces[0] : rollbem::richardson(forces[1], forces[0], rolling.order);
            return rollbem::Status::ok;
        });
        if (failed) {
            throw study::BadInput("the force is not finite at q/a = " + study::Cell(end).text(6) +
                                  ": creepage or --until is too large");
        }
        if (k <= range.first) continue;

        // 4. Compare with the exact response of the plane model.
        emit({end, creepage.at(end, false), resolved ? force : std::nan(""),
              rolling.exact ? std::optional(creepage.exact(*rolling.exact, end) / creepage.largest) : std::nullopt,
              study::word(run.integrator), status});
    }
}

/// The force over the distance with the exact one if there is one, and below it their difference, as the curves
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
    study::add_run_options(options, columns);
    study::add_unchecked(options);
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
        const Creepage creepage = read_creepage(given);
        const std::vector<study::Scene> scenes = study::make_non_steady_scenes(given, methods);
        study::Table table = study::run_table(
            sheet, scenes, creepage.run.steps.count,
            [&](const study::Scene& scene) { return make_rolling(scene, creepage.run); },
            [&](const Rolling& rolling, const study::Scene&, study::RowRange range, const auto& emit) {
                roll(rolling, creepage, range, emit);
                return "";
            });
        table.plot = [&](const study::Records& rows) { return draw_force(creepage, rows); };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
