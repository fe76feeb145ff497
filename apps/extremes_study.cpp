// The library at the edges of its domain: one row for each case, which is right to a stated bound, or ends with a
// status or an exception that says why there is no result:
//
//     ./extremes_study
//     ./extremes_study --large --output extremes.csv
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "extremes/cases.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace extremes {

std::string shown(double number) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%g", number);
    return buffer;
}

}  // namespace extremes

namespace {

using extremes::Case, extremes::Outcome;

Outcome run(const Case& one) {
    try {
        return one.run();
    } catch (const std::exception& error) {
        return {.told = error.what(), .refused = true};
    }
}

/// The verdict on a case: right, told or broken.
std::string verdict(const Case& one, const Outcome& outcome) {
    if (!one.says.empty()) return outcome.told.find(one.says) != std::string::npos ? "told" : "broken";
    const bool within = std::abs(outcome.error) <= outcome.bound;
    if (!outcome.told.empty()) return outcome.may_be_told && within ? "told" : "broken";
    return within ? "right" : "broken";
}

/// The status of a case: ok, the library's name of a failure, or exception.
std::string status(const Outcome& outcome) {
    if (outcome.refused) return "exception";
    const std::string prefix = "status ";
    if (outcome.told.rfind(prefix, 0) == 0) return outcome.told.substr(prefix.size());
    return outcome.told.empty() ? "ok" : "not_converged";
}

/// Random scenes where they are asked for, or all named cases.
extremes::Cases cases_of(const study::Options& given) {
    extremes::Cases cases;
    for (const auto& [option, scene] : std::initializer_list<std::pair<const char*, Case (*)(std::uint64_t)>>{
             {"patches", extremes::patch_scene},
             {"contacts", [](std::uint64_t seed) { return extremes::contact_scene(seed, seed % 99 == 0); }},
             {"positions", extremes::position_scene}}) {
        if (!given.given(option)) continue;
        const auto count = static_cast<std::uint64_t>(given.integer(option, 1, 10'000'000));
        for (std::uint64_t seed = 1; seed <= count; ++seed) cases.all.push_back(scene(seed));
        return cases;
    }
    extremes::adhesion_cases(cases, given.flag("large"));
    extremes::friction_cases(cases);
    extremes::patch_cases(cases);
    // Newton's method alone does not solve these scenes
    for (const std::uint64_t seed : {5405u, 7148u, 24326u, 24949u}) cases.all.push_back(extremes::patch_scene(seed));
    // a flank and a gauge corner in one run of depths, far apart along x
    for (const std::uint64_t seed : {115512u, 136686u}) cases.all.push_back(extremes::contact_scene(seed, false));
    // a tread that lies two millimetres above the rail when the flank touches
    cases.all.push_back(extremes::contact_scene(17164, true));
    return cases;
}

void add_options(study::Options& options) {
    for (const char* group : {"Discretisation", "Contact"}) options.refuse_group(group, "each case has its own");
    options.refuse("plot", "cases have nothing to draw");
    options.refuse("no-timing", "cases are not timed");
    options.not_with({"large", "contacts", "positions"}, "patches");
    options.not_with({"large", "positions"}, "contacts");
    options.not_with({"large"}, "positions");
    options.add_flag("large",
                     "further cases, of strips with b/a = 0.01, n = 1000 in long double, n = 4000 and 1500 states: ten "
                     "seconds and 300 MB more");
    options.add("patches", "N",
                "number of random contact patches [dimensionless], 1 to 10000000, with friction, steady and in four "
                "steps, in place of the named cases");
    options.add("contacts", "N",
                "number of random positions and loads of wheels on rails [dimensionless], 1 to 10000000, in place of "
                "the named cases");
    options.add("positions", "N",
                "number of random positions and loads of S1002 on standard rails, each pair as it is, worn or rough "
                "[dimensionless], 1 to 10000000, in place of the named cases");
    options.footer(R"(Example: all cases, as a file
  extremes_study --large --output extremes.csv

One row for each case:
  case, quantity    name of the case and of what is judged
  value, reference  value, and closed form, Bessel function, spectral solution of the strip, 640 elements, other
                    solver of the same elements, Chebyshev states, or the same discretisation in long double
  relative_error    relative error of the value
  residual          residual of the equations
  condition         condition of the problem, where the reference is in long double: the bound is the rounding error
                    times it
  verdict           right if |relative_error| <= bound; told if a status or an exception, in the column told, says why
                    there is no result; broken if neither: the exit code is then 1, after all rows
  status            ok, the library's word for what went wrong, or exception
--patches: a/b from 0.05 to 20, nu = 0, 0.28 or 0.5, up to 12 elements in each of up to 10 strips, creepages over four
decades (spin alone in every sixth case), steps of 1e-3 to 10 a. In half of the cases creepages and loads jump; in
half a varies, in half of these a/b, too. The error is the largest violation of Coulomb's law and of the equations,
set up anew from G, G' and du/dy (with sdirk2, whose stages are hidden, of |p| <= mu p_n in its steps); value is the
last -F_y over mu N. Steps that a mesh cannot follow must be refused.
--contacts: S1002 on UIC 60, in every second case one of ten pairs of profiles with hollows, bumps and waves, shifted
by up to 12 mm, yaw to 30 mrad, roll to 5 mrad, under 10 kN to 1 MN, on 24 x 16 cells, or on 48 x 32 where the error
would be above 1; every 99th contact is searched in slices, as if surfaces changed along the way. value is the least
gap [m] that a brute-force search finds after the displacements of all patches. relative_error is the largest of three:
the size of that gap over 1 um (3 if something was dropped) and 4 % of the deepest approach (10 % with doubtful_plane),
the error of the vertical load over 1e-6, and the load dropped over 2e-3 of all. A status other than not_finite and
not_converged is told.
--positions: S1002 on UIC 60, 60E1 or 54E1, canted by 0, 1:40 or 1:20, most pairs worn by up to a millimetre over
centimetres, every tenth rough by 10 um, in positions and judged as with --contacts. Besides, each contact must equal
its mirror image x -> -x, of opposite yaw, and carry its load again at the height found, within 2 %; without interaction
its patches must carry no less, and within 2 % the same where they are one region. The column told names what does not
hold; the verdict is then broken.
)");
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("extremes_study",
                           "Extreme cases: right to a stated bound, or with a reason why there is no result.");
    add_options(options);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. The cases, with one row each.
        const std::vector<Case> cases = cases_of(given).all;
        std::atomic<bool> all_kept{true};
        study::Table table;
        table.columns = {"case",      "quantity", "value", "reference", "relative_error", "residual",
                         "condition", "verdict",  "bound", "told",      "status"};
        table.rows_of_task.assign(cases.size(), 1);
        table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
            const Case& one = cases[task];
            const Outcome outcome = run(one);
            const std::string result = verdict(one, outcome);
            if (result == "broken") all_kept = false;
            const double bound = one.says.empty() ? outcome.bound : extremes::nothing;
            emit({one.name, one.quantity, outcome.value, outcome.reference, outcome.error, outcome.residual,
                  outcome.condition, result, bound, outcome.told, status(outcome)});
        };
        study::write_table(given, table);
        return all_kept ? study::exit_ok : study::exit_failed;
    });
}
