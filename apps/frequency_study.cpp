// Harmonic creepage: the complex creep coefficient c11 over the frequency z = omega a/V, by elements, Chebyshev states
// or the polynomial approach, against the exact response of the plane model; also the contact as linear differential
// equations for other programs:
//
//     ./frequency_study --n 60 --omega 0.1,1,5
//     ./frequency_study --n 20,40,60 --omega-min 0.01 --omega-max 10 --points 101 --output c11.csv --plot c11.svg
//     ./frequency_study --method chebyshev --n 8 --omega 0,1,5 --state-space contact
//     ./frequency_study --n 60 --mesh cosine --alpha 0.5 --omega 0,1,5 --state-space contact --states 6
//     ./frequency_study --method polynomial --basis chebyshev --omega 200
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/monomial.hpp>
#include <rollbem/reference/bessel.hpp>

#include "frequency/state_space.hpp"
#include "support/non_steady.hpp"
#include "support/options.hpp"
#include "support/program.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"

namespace {

using Complex = std::complex<double>;

const std::vector<std::string> columns =
    study::joined(study::joined({"n", "omega", "c11_re", "c11_im", "exact_re", "exact_im", "relative_error", "alpha_L",
                                 "alpha_T", "lambda", "order", "rcond", "error_estimate", "status"},
                                study::all_setting_columns()),
                  {"basis"});

constexpr Complex unknown{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The frequencies, in units of V/a.
std::vector<double> make_omegas(const study::Options& options) {
    if (options.given("omega")) {
        for (const char* name : {"omega-min", "omega-max", "points"}) options.ignored(name, "with --omega");
        return options.numbers("omega",
                               {[](double z) { return z >= 0 && std::isfinite(z); }, "be at least 0 and finite"});
    }
    const study::Rule rule{study::positive().holds,
                           "be positive and finite, as points are spaced evenly in its "
                           "logarithm (--omega takes 0 too)"};
    const double low = options.number("omega-min", rule), high = options.number("omega-max", rule);
    if (!(low < high)) {
        throw study::BadInput(options.said("omega-max") + " must be larger than " + options.said("omega-min"));
    }
    const std::ptrdiff_t points = options.integer("points", 2, 1000000);
    std::vector<double> omegas{low};
    for (std::ptrdiff_t i = 1; i + 1 < points; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(points - 1);
        omegas.push_back(std::exp(std::log(low) + share * (std::log(high) - std::log(low))));
    }
    omegas.push_back(high);
    return omegas;
}

/// The response of the plane model; unknown if that does not decay.
Complex exact_c11(const rollbem::Contact<double>& contact, double omega) {
    if (!study::plane_model_decays(contact)) return unknown;
    return rollbem::reference::plane_c11(Complex(0, omega), contact.poisson_ratio(), contact.aspect());
}

/// The row's cells up to relative_error. Where `c11` is not finite, it and the error are left out, as is what needs the
/// exact value where the plane model has none.
study::Row response_cells(const study::Cell& n, const rollbem::Contact<double>& contact, double omega, Complex c11) {
    const Complex exact = exact_c11(contact, omega);
    return {n, omega, c11.real(), c11.imag(), exact.real(), exact.imag(), std::abs(c11 / exact - 1.0)};
}

// --- elements and Chebyshev states ---------------------------------------------------------------------------------

void emit_sweep(const study::Scene& scene, const std::vector<double>& omegas, bool checked, study::RowRange range,
                const study::Emit& emit) {
    // 3. Assemble and reduce to Hessenberg form, once for all frequencies.
    const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
    std::string steady;
    std::optional<rollbem::FrequencySweep<double>> sweep;
    if (system) {
        steady = study::status_of(rollbem::Status::ok, scene, *system);
        sweep.emplace(*system);
    }

    // 4. Solve for each. A c11 that cannot be trusted is left out, unless --unchecked is given.
    for (std::size_t i = range.first; i < range.last; ++i) {
        rollbem::Response<Complex> point{.rcond = std::nan("")};  // its status is not_finite
        point.coefficients.setConstant(1, 1, unknown);
        if (sweep) point = (*sweep)(omegas[i]);
        const std::string status = point.status == rollbem::Status::ok ? steady : name(point.status);
        const Complex c11 = status == study::ok || !checked ? point.c11() : unknown;
        study::Row row = response_cells(scene.n(), scene.contact, omegas[i], c11);
        row.insert(row.end(),
                   {scene.alpha_L, scene.alpha_T, scene.lambda, study::Cell(), point.rcond, study::Cell(), status});
        row = study::joined(row, study::all_setting_cells(scene));
        row.emplace_back();
        emit(std::move(row));
    }
}

// --- the polynomial approach ---------------------------------------------------------------------------------------

struct PolynomialResult {
    Complex c11;
    double error_estimate;
    rollbem::Status status;
};

/// Throws BadInput where monomials have broken down and that is `checked`.
PolynomialResult monomial_c11(const rollbem::Contact<double>& contact, double omega, Eigen::Index order, bool checked) {
    constexpr Eigen::Index highest = 1000;
    const std::string name = "--order = " + std::to_string(order);
    if (order > highest) {
        throw study::BadInput(name + " must be at most " + std::to_string(highest) +
                              " with --basis monomial, which costs its third power; take --basis chebyshev");
    }
    const rollbem::PolynomialSolution<double> solution =
        rollbem::solve_monomial<double>(Complex(0, omega), contact.poisson_ratio(), contact.aspect(), order);
    if (checked && solution.status != rollbem::Status::ok) {
        throw study::BadInput(name + " with --basis monomial must give a result that can be trusted; at omega = " +
                              study::Cell(omega).text(6) + " it does not: " + rollbem::advice(solution.status) +
                              " (--basis chebyshev, or --unchecked)");
    }
    return {solution.c11, solution.error_estimate, solution.status};
}

/// Chebyshev polynomials do not break down, but an order can be too low: then a c11 that is `checked` is not a number,
/// and the estimate stays.
PolynomialResult chebyshev_c11(const rollbem::Contact<double>& contact, double omega, Eigen::Index order,
                               bool checked) {
    const rollbem::EstimatedC11<double> result =
        rollbem::polynomial_c11(Complex(0, omega), contact.poisson_ratio(), contact.aspect(), order);
    const bool trusted = result.status == rollbem::Status::ok;
    return {trusted || !checked ? result.c11 : unknown, result.error_estimate, result.status};
}

/// All rows, one for each order and frequency: what must be refused shows before anything is written.
std::vector<study::Row> polynomial_rows(const study::Options& options, const std::vector<double>& omegas) {
    options.ignored("state-space", "with --method polynomial, which has no states");
    options.ignored_group("Discretisation", "with --method polynomial, which has no elements", {"method"});
    if (options.given("kernel") && options.choice("kernel", {"strip", "plane"}) != "plane") {
        throw study::BadInput(options.said("kernel") + " must be plane with --method polynomial");
    }
    const std::vector<rollbem::Contact<double>> contacts = study::make_contacts(options, study::Problem::non_steady);
    for (const rollbem::Contact<double>& contact : contacts) study::require_plane_model(contact);
    const std::string basis = options.choice("basis", {"monomial", "chebyshev"});
    const auto solve = basis == "monomial" ? monomial_c11 : chebyshev_c11;
    const bool checked = !options.flag("unchecked");
    std::vector<std::optional<Eigen::Index>> orders{std::nullopt};  // the default order of each frequency
    if (options.given("order")) {
        orders.clear();
        for (const Eigen::Index order : options.integers("order", 1, 100000000)) orders.emplace_back(order);
    }

    std::vector<study::Row> rows;
    const auto add_row = [&](const rollbem::Contact<double>& contact, std::optional<Eigen::Index> given, double omega) {
        const Complex s(0, omega);
        if (!given && omega > 1e8) {
            throw study::BadInput("--omega = " + study::Cell(omega).text(6) + " must be at most 1e8 without --order");
        }
        const Eigen::Index order = given ? *given : rollbem::default_polynomial_order(s);
        const PolynomialResult result = solve(contact, omega, order, checked);
        study::Row row = response_cells({}, contact, omega, result.c11);
        const study::Cell none;  // no alphas, no lambda, no mesh
        rows.push_back(study::joined(
            row, {none, none, none, order, none, result.error_estimate, name(result.status), "polynomial", none, none,
                  "plane", study::aspect_cell(contact), contact.poisson_ratio(), none, none, none, basis}));
    };
    for (const std::optional<Eigen::Index>& given : orders) {
        for (const rollbem::Contact<double>& contact : contacts) {
            for (const double omega : omegas) add_row(contact, given, omega);
        }
    }
    return rows;
}

// --- the plot ------------------------------------------------------------------------------------------------------

using Responses = std::map<std::string, std::map<double, Complex>>;  // over the frequency, of every contact

Responses exact_responses(const std::vector<study::Row>& rows) {
    Responses exact;
    const std::size_t aspect = study::index_of(columns, "aspect");
    for (const study::Row& row : rows) {
        const std::optional<double> omega = row[1].number(), re = row[4].number(), im = row[5].number();
        const std::string contact = "b/a = " + row[aspect].text(6) + ", ν = " + row[aspect + 1].text(6);
        if (omega && re && im) exact[contact][*omega] = {*re, *im};
    }
    return exact;
}

/// The lines of exact responses, whose points are point(omega, c11).
void add_exact(study::Plot& plot, const Responses& exact, const std::string& prefix, const auto& point) {
    for (const auto& [contact, response] : exact) {
        study::Series curve{.label = prefix + (exact.size() > 1 ? "exact, " + contact : std::string("exact")),
                            .markers = false,
                            .reference = true};
        for (const auto& [omega, c11] : response) curve.points.push_back(point(omega, c11));
        plot.series.push_back(std::move(curve));
    }
}

/// The Argand diagram, and beside it both parts over the frequency.
study::Plot draw_response(const std::vector<study::Row>& rows, bool order_given,
                          const std::vector<study::Scene>& scenes, const std::vector<double>& omegas) {
    std::vector<std::string> by{"n", "alpha_L", "alpha_T", "lambda"};
    if (order_given) by.emplace_back("order");  // otherwise it depends on the frequency
    const std::vector<std::string> apart = study::all_setting_columns();
    const Responses exact = exact_responses(rows);

    study::Plot argand{.title = "Harmonic creepage", .x_label = "Re c_{11}", .y_label = "Im c_{11}"};
    study::add_series(argand, columns, rows, {.by = by, .x = "c11_re", .y = "c11_im", .apart = apart});
    const std::size_t cases = argand.series.size();
    if (cases == 1) argand.series[0].label = "computed";
    add_exact(argand, exact, "", [](double, Complex c11) { return std::pair(c11.real(), c11.imag()); });

    study::Plot parts{.x_label = "ω a / V", .y_label = "Re c_{11}, Im c_{11}"};
    for (const bool real : {true, false}) {
        const std::string prefix = real ? "Re, " : "Im, ";
        study::Plot part;
        study::add_series(part, columns, rows,
                          {.by = by, .x = "omega", .y = real ? "c11_re" : "c11_im", .apart = apart});
        for (std::size_t k = 0; k < cases; ++k) {
            study::Series& series = part.series[k];
            series.label = prefix + argand.series[k].label;
            series.style = k;
            parts.series.push_back(std::move(series));
        }
        add_exact(parts, exact, prefix,
                  [&](double omega, Complex c11) { return std::pair(omega, real ? c11.real() : c11.imag()); });
    }

    // markers if there are few points, a logarithmic axis if the frequencies span several orders
    double lowest = HUGE_VAL, highest = 0;
    for (study::Plot* panel : {&argand, &parts}) {
        for (study::Series& series : panel->series) series.markers = series.markers && series.points.size() <= 30;
    }
    for (const study::Series& series : parts.series) {
        for (const auto& [omega, value] : series.points) {
            lowest = std::min(lowest, omega);
            highest = std::max(highest, omega);
        }
    }
    parts.log_x = lowest > 0 && highest > 20 * lowest;

    // the curves coincide: show their differences
    study::Plot errors{
        .x_label = parts.x_label, .y_label = "|c_{11} / c_{11,exact} - 1|", .log_x = parts.log_x, .log_y = true};
    study::add_series(errors, columns, rows,
                      {.by = by, .x = "omega", .y = "relative_error", .absolute = true, .apart = apart});
    for (std::size_t k = 0; k < cases; ++k) {
        errors.series[k].label = argand.series[k].label;
        errors.series[k].markers = argand.series[k].markers;
        for (auto& [omega, error] : errors.series[k].points) error = std::max(error, study::least_drawn);
    }
    errors.title.clear();
    study::add_model_differences(errors, scenes, [&](const auto& states, const auto& kernel, const auto& contact) {
        std::vector<std::pair<double, double>> points;
        if (!study::plane_model_decays(contact)) return points;
        const rollbem::FrequencySweep<double> strip(rolling_system(states, kernel));
        for (const double omega : omegas) {
            if (omega > 20) continue;  // more than the states resolve
            const Complex plane = exact_c11(contact, omega);
            points.emplace_back(omega, std::abs(strip(omega).c11() / plane - 1.0));
        }
        return points;
    });
    argand.beside.push_back(std::move(parts));
    if (can_be_drawn(errors)) argand.beside.push_back(std::move(errors));
    return argand;
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("frequency_study",
                           "Complex creep coefficient c11 under harmonic creepage over its frequency, and its error.");
    options.add("omega", "LIST", "frequencies omega a/V, at least 0 (dimensionless)");
    options.add("omega-min", "Z", "or: the lowest frequency omega a/V, above 0 (dimensionless)", "0.01");
    options.add("omega-max", "Z", "the highest, above --omega-min (dimensionless)", "10");
    options.add(
        "points", "N",
        "number of frequencies, 2 to 1000000, both ends included, evenly spaced in the logarithm (dimensionless)",
        "61");
    options.replaces("omega", {"omega-min", "omega-max", "points"});
    options.add("basis", "NAME", "with --method polynomial: monomial or chebyshev", "chebyshev");
    options.add(
        "order", "LIST",
        "with --method polynomial: its order, 1 to 100000000 (dimensionless); default: what the Chebyshev basis "
        "needs for machine precision at each frequency");
    options.add_flag("unchecked", "print c11 whatever its status, also where --basis monomial has broken down");
    study::StateSpaceFiles::add_options(options, "the scheme, a single one,");
    study::offer_chebyshev(options, "; or polynomial, of an --order");
    options.footer(R"(Example: three meshes, with the Argand diagram and both parts over the frequency
  frequency_study --n 20,40,60 --omega-min 0.01 --omega-max 10 --points 101 --output c11.csv --plot c11.svg

Creepage e^{i omega t}; --omega is omega a/V, c11 = -F/(a G xi), both dimensionless. exact_re + i exact_im is the
response of the plane model b >> a in closed form; relative_error = |c11/exact - 1|. With the strip kernel it
includes the difference of the models, of order (a/b)^2 (up to 5e-5 at b/a = 100, 5e-7 at 1000); with --kernel
plane it is the error of the discretisation alone.
--method polynomial has no elements: n is empty and the column order gives the order. --basis monomial is the
paper's; an order at which it has broken down, or has not converged (orders m and m + 10 disagree), is refused
without --unchecked. If status is not ok, c11 is empty, or wrong with --unchecked: ill_conditioned if the
equations are singular to working precision; assists_creepage if the scheme does not converge to full adhesion
(alpha at or below 0, or above 1); coarse if the steady c11 of fewer than 10 elements is wrong by more than half;
not_converged if --order is too low for eight digits, or states are too few. exact and error are empty for
contacts so narrow that the plane model does not decay. rcond: estimate of the reciprocal condition of the
equations of elements or states; rounding contributes 2e-16/rcond to the error of c11. error_estimate: relative,
of c11 by polynomials, truncation and rounding. not_finite, with empty cells: b/a is so small or large that G
or G' is not finite.
--method chebyshev: alpha_L, alpha_T, lambda are empty. 8 states have errors of 3e-14 up to omega = 1 and 2e-4
up to 5, 12 states of 6e-9 up to 5; narrow strips need more (b/a = 1: 16). c11 is empty if more states would
change its steady value by more than 1e-2.
--state-space: d x/d(q/a) = A x + B xi, -F/(a G) = C x + D xi, so that c11(s) = C (s I - A)^-1 B + D, s in V/a.
Plain numbers without header; numpy.loadtxt('A.csv', delimiter=',', ndmin=2) reads them. Elements need a regular
G. The table is written as well, of the full system. With --states D is not zero; error_bound in state_space.toml
holds for |c11| at every omega, and is twice the sum of the Hankel singular values left out.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. One row for each scene, or order, and frequency.
        const std::string method =
            given.choice("method", {"collocation", "galerkin", "knothe-bc", "nodes", "chebyshev", "polynomial"});
        const std::vector<double> omegas = make_omegas(given);
        if (given.given("state-space") && given.given("shard")) {
            throw study::BadInput(given.said("shard") + " cannot go with --state-space: every part would write it");
        }
        if (!given.given("state-space")) given.ignored("states", "without --state-space");
        study::Table table;
        table.columns = columns;
        std::vector<study::Scene> scenes;
        std::vector<study::Row> polynomial;
        std::unique_ptr<study::StateSpaceFiles> state_space;
        if (method == "polynomial") {
            polynomial = polynomial_rows(given, omegas);
            table.rows_of_task = {polynomial.size()};
            table.compute = [&](std::size_t, study::RowRange range, const study::Emit& emit) {
                for (std::size_t i = range.first; i < range.last; ++i) emit(polynomial[i]);
            };
        } else {
            for (const char* name : {"order", "basis"}) {
                given.ignored(name, "with --method " + method + "; it is for --method polynomial");
            }
            scenes = study::make_non_steady_scenes(given, study::Methods::elements_and_states);
            if (given.given("state-space")) state_space = frequency::state_space_files(given, scenes);
            table.rows_of_task.assign(scenes.size(), omegas.size());
            table.label = [&](std::size_t task) { return scenes[task].label(); };
            table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
                emit_sweep(scenes[task], omegas, !given.flag("unchecked"), range, emit);
            };
        }

        table.written = [&] {
            if (state_space) state_space->commit();
        };

        // 5. --plot.
        table.plot = [&](const std::vector<study::Row>& rows) {
            return draw_response(rows, given.given("order"), scenes, omegas);
        };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
