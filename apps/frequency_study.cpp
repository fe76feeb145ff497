// Harmonic creepage: the complex creep coefficient c11 over the frequency z = omega a/V, by elements, Chebyshev states
// or the polynomial approach, against the exact response of the plane model; also the contact as linear differential
// equations for other programs:
//
//     ./frequency_study --n 60 --omega 0.1,1,5
//     ./frequency_study --n 20,40,60 --omega-min 0.01 --omega-max 10 --points 101 --output c11.csv --plot c11.svg
//     ./frequency_study --method chebyshev --n 8 --omega 0,1,5 --state-space contact
//     ./frequency_study --n 60 --mesh cosine --alpha 0.5 --omega 0,1,5 --state-space contact --states 6
//     ./frequency_study --method polynomial --basis chebyshev --omega 200
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "studies/monomial.hpp"
#include "support/non_steady.hpp"
#include "support/sheet.hpp"
#include "support/state_space_files.hpp"

namespace {

using Complex = std::complex<double>;

constexpr study::Methods methods{.states = true, .closed = true};

constexpr Complex unknown{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The response at one frequency. The cells of c11 and of the error are empty where c11 is not finite, and cells that
/// need the exact value where the plane model has none.
struct Response {
    double omega;
    Complex c11, exact;
    std::string status;
    std::optional<double> rcond{}, error_estimate{};
    std::optional<Eigen::Index> order{};
    std::string basis{};
};

/// The response of the plane model; unknown if that does not decay.
Complex exact_c11(const rollbem::Contact& contact, double omega) {
    if (!study::plane_model_decays(contact)) return unknown;
    return rollbem::reference::plane_c11(Complex(0, omega), contact.poisson_ratio(), contact.aspect());
}

/// Scenes at frequencies.
struct Job {
    std::vector<double> omegas;  ///< [V/a]
    bool checked;                ///< a c11 that cannot be trusted is left out
    std::vector<study::Scene> scenes{};
    std::string basis{};                 ///< of --method polynomial; empty where there are other scenes
    std::vector<Eigen::Index> orders{};  ///< of these; 0: of each frequency

    bool by_polynomials() const { return !basis.empty(); }
    bool has_orders() const { return by_polynomials() && orders.front() > 0; }
};

/// The frequencies, in units of V/a.
std::vector<double> read_omegas(const study::Options& options) {
    if (options.given("omega")) return options.numbers("omega", study::not_negative());
    const study::Rule rule{
        study::positive().holds,
        "be positive and finite, as points are spaced evenly in its logarithm (--omega takes 0 too)"};
    const double low = options.number("omega-min", rule), high = options.number("omega-max", rule);
    options.require(low < high, "omega-max", "be larger than " + options.said("omega-min"));
    const std::ptrdiff_t points = options.integer("points", 2, 1000000);
    std::vector<double> omegas{low};
    for (std::ptrdiff_t i = 1; i + 1 < points; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(points - 1);
        omegas.push_back(std::exp(std::log(low) + share * (std::log(high) - std::log(low))));
    }
    omegas.push_back(high);
    return omegas;
}

/// One scene without elements for each order and contact.
void read_polynomials(const study::Options& options, Job& job) {
    options.require(!options.given("kernel") || options.choice("kernel", {"strip", "plane"}) == "plane", "kernel",
                    "be plane with --method polynomial");
    const std::vector<rollbem::Contact> contacts = study::make_contacts(options, study::Problem::non_steady);
    for (const rollbem::Contact& contact : contacts) study::require_plane_model(contact);
    job.basis = options.choice("basis", {"monomial", "chebyshev"});
    std::vector<std::ptrdiff_t> orders{0};
    if (options.given("order")) orders = options.integers("order", 1, 100000000);
    for (const double omega : job.omegas) {
        if (orders[0] > 0 || omega <= 1e8) continue;
        throw study::BadInput("--omega = " + study::Cell(omega).text(6) + " must be at most 1e8 without --order");
    }
    for (const std::ptrdiff_t order : orders) {
        for (const rollbem::Contact& contact : contacts) {
            job.scenes.push_back(study::make_scene({.method = "polynomial"}, 0, contact, rollbem::LineModel::plane));
            job.orders.push_back(order);
        }
    }
}

Job read_job(const study::Options& options) {
    const std::string method =
        options.choice("method", {"collocation", "galerkin", "knothe-bc", "nodes", "chebyshev", "polynomial"});
    Job job{read_omegas(options), !options.flag("unchecked")};
    if (method == "polynomial") {
        read_polynomials(options, job);
    } else {
        job.scenes = study::make_non_steady_scenes(options, methods);
    }
    return job;
}

const study::Sheet<Response> sheet{
    "n",
    {{"omega", "frequency omega a/V of the creepage e^{i omega t}", &Response::omega},
     {"c11_re", "real part of c11 = -F/(a G xi)", [](const Response& r) { return r.c11.real(); }},
     {"c11_im", "imaginary part of c11", [](const Response& r) { return r.c11.imag(); }},
     {"exact_re",
      "real part of the exact c11 of the plane model b >> a; empty for contacts so narrow that the model does not "
      "decay",
      [](const Response& r) { return r.exact.real(); }},
     {"exact_im", "imaginary part of the same", [](const Response& r) { return r.exact.imag(); }},
     {"relative_error",
      "|c11/exact - 1|: with the strip kernel it includes the difference of the models, of order (a/b)^2 (up to 5e-5 "
      "at b/a = 100, 5e-7 at 1000); with --kernel plane it is the error of the discretisation alone",
      [](const Response& r) { return std::abs(r.c11 / r.exact - 1.0); }},
     {"alpha_L, alpha_T, lambda", "positions of the points of the scheme"},
     {"order", "order of the polynomials", &Response::order},
     {"rcond",
      "estimate of the reciprocal condition of the equations; rounding contributes 2e-16/rcond to the error of c11",
      &Response::rcond},
     {"error_estimate", "estimated relative error of c11 by polynomials, from truncation and rounding",
      &Response::error_estimate},
     {"status",
      "ok, or why c11 is empty, with --unchecked wrong: ill_conditioned if the equations are singular to working "
      "precision; " +
          study::steady_flaws +
          "; not_converged if --order is too low for eight digits, or states are too few; not_finite, with empty "
          "cells, if b/a is so small or large that G or G' is not finite",
      &Response::status},
     {std::string("method, derivative, mesh, ") + study::settings, "scheme and contact, as in their options"},
     {"basis", "basis of the polynomials", &Response::basis}},
    ""};

/// The responses of a scene of elements or states, assembled and reduced to Hessenberg form once for all frequencies.
class Sweep {
public:
    explicit Sweep(const study::Scene& scene) {
        const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
        if (!system) return;
        steady_ = study::status_of(rollbem::Status::ok, scene, *system);
        sweep_.emplace(*system);
    }

    Response operator()(double omega) const {
        if (!sweep_) return {omega, unknown, {}, name(rollbem::Status::not_finite), std::nan("")};
        const rollbem::Response<Complex> point = (*sweep_)(omega);
        return {
            omega, point.c11(), {}, point.status == rollbem::Status::ok ? steady_ : name(point.status), point.rcond};
    }

private:
    std::string steady_;
    std::optional<rollbem::FrequencySweep> sweep_;
};

/// Emits the responses at the frequencies; if `checked`, a c11 that cannot be trusted is left out.
void emit_sweep(const study::Scene& scene, const std::vector<double>& omegas, bool checked, study::RowRange range,
                const study::Results<Response>& emit) {
    const std::vector<study::Scene> meshes = scene.meshes();
    const Sweep fine(meshes.front());
    std::optional<Sweep> coarse;
    if (scene.coarse) coarse.emplace(meshes.back());
    for (std::size_t i = range.first; i < range.last; ++i) {
        Response point = fine(omegas[i]);
        if (coarse) {
            const Response other = (*coarse)(omegas[i]);
            point.c11 = rollbem::richardson(other.c11, point.c11, scene.order());
            if (point.status == study::ok) point.status = other.status;
        }
        if (point.status != study::ok && checked) point.c11 = unknown;
        point.exact = exact_c11(scene.contact, omegas[i]);
        emit(point);
    }
}

// --- the polynomial approach

/// The response by a polynomial. Monomials that break down are refused. If the order of Chebyshev polynomials is too
/// low, a `checked` c11 is not a number, and the estimate stays.
Response solve(const rollbem::Contact& contact, double omega, Eigen::Index order, const std::string& basis,
               bool checked) {
    const double nu = contact.poisson_ratio();
    Response response{.omega = omega,
                      .c11 = unknown,
                      .exact = exact_c11(contact, omega),
                      .status = "",
                      .order = order,
                      .basis = basis};
    const auto take = [&](const auto& solution) {
        const bool trusted = solution.status == rollbem::Status::ok;
        if (trusted || !checked) response.c11 = solution.c11;
        response.error_estimate = solution.error_estimate;
        response.status = name(solution.status);
        return solution.status;
    };
    if (basis == "chebyshev") {
        take(rollbem::polynomial_c11(Complex(0, omega), nu, contact.aspect(), order));
        return response;
    }
    constexpr Eigen::Index highest = 1000;
    const std::string option = "--order = " + std::to_string(order);
    if (order > highest) {
        throw study::BadInput(option + " must be at most " + std::to_string(highest) +
                              " with --basis monomial, which costs its third power; take --basis chebyshev");
    }
    const rollbem::Status status =
        take(rollbem::studies::solve_monomial<double>(Complex(0, omega), nu, contact.aspect(), order));
    if (checked && status != rollbem::Status::ok) {
        throw study::BadInput(option + " with --basis monomial must give a result that can be trusted; at omega = " +
                              study::Cell(omega).text(6) + " it does not: " +
                              rollbem::studies::polynomial_advice(status) + " (--basis chebyshev, or --unchecked)");
    }
    return response;
}

/// The response by a polynomial or by the closed form, of the task of a scene without elements.
Response solve_without_elements(const Job& job, std::size_t task, double omega) {
    const study::Scene& scene = job.scenes[task];
    if (scene.method == "closed-form") {
        const Complex exact = exact_c11(scene.contact, omega);
        return {omega, exact, exact, study::ok};
    }
    if (!job.by_polynomials()) return solve(scene.contact, omega, scene.degree, "chebyshev", job.checked);
    const Eigen::Index order =
        job.has_orders() ? job.orders[task] : rollbem::default_polynomial_order(Complex(0, omega));
    return solve(scene.contact, omega, order, job.basis, job.checked);
}

// --- differential equations and pictures

/// Throws BadInput, which begins with `said`, unless the scene's G is regular and tractions converge to full adhesion.
rollbem::StateSpace equations_of(const study::Scene& scene, const std::string& said) {
    if (!scene.is_discrete() || scene.coarse) {
        throw study::BadInput(said + " must go with elements or states on one mesh");
    }
    const auto space_of = [&](const auto& system) {
        const std::string flaw = study::flaw_in_steady_rolling(scene, system);
        if (flaw.empty()) return rollbem::state_space(system);
        throw study::BadInput(said + " must go with another scheme: the scheme of n = " + std::to_string(scene.n()) +
                              " " + flaw);
    };
    return scene.chebyshev ? space_of(rolling_system(*scene.chebyshev, scene.kernel))
                           : space_of(rolling_system(*scene.mesh, scene.scheme, scene.kernel));
}

const study::StateSpaceWords words_of_equations{
    .one = "scheme",
    .lists = "--n, --alpha-L, --alpha-T and --lambda",
    .conventions =
        "# equations = d x/d(q/a) = A x + B xi, -F/(a G) = C x + D xi; q = V t, F per unit width\n"
        "# response = c11(s) = C (s I - A)^-1 B + D, s in V/a\n",
    .states = "by elements: their tractions p/G, trailing to leading; chebyshev: coefficients of T_0, T_1, ... in u/a",
    .bounded = "c11"};

/// The Argand diagram, below it both parts over the frequency, and the errors, as the curves coincide.
study::Picture draw_response(const study::Records& rows, const Job& job) {
    std::vector<std::string> also;
    if (job.has_orders()) also.emplace_back("order");  // otherwise it depends on the frequency
    const auto [lowest, highest] = std::minmax_element(job.omegas.begin(), job.omegas.end());
    const study::PlotAxis omega{"ω a / V", *lowest > 0 && *highest > 20 * *lowest};
    const std::string title = "Harmonic creepage";
    study::Plot argand{.title = title, .x = {"Re c_{11}"}, .y = {"Im c_{11}"}, .to_scale = true};
    study::Plot parts{.title = title, .x = omega, .y = {"Re c_{11}, Im c_{11}"}};
    study::Plot errors{.title = title, .x = omega, .y = {"|c_{11} / c_{11,exact} - 1|", true}};
    const auto add = [&](study::Plot& plot, const std::string& x, const std::string& part, const std::string& prefix) {
        sheet.draw(plot, rows, {.by = also, .x = x, .y = "c11_" + part, .prefix = prefix});
        add_series(plot, rows,
                   {.by = {"aspect", "poisson"},
                    .x = x == "omega" ? x : "exact_re",
                    .y = "exact_" + part,
                    .prefix = prefix.empty() ? "exact" : prefix + ", exact",
                    .look = study::Look::exact});
    };
    add(argand, "c11_re", "im", "");
    add(parts, "omega", "re", "Re");
    add(parts, "omega", "im", "Im");
    sheet.draw(errors, rows, {.by = also, .x = "omega", .y = "relative_error", .absolute = true});
    return {argand, parts, errors};
}

/// A row for each scene and frequency. What must be refused of polynomials shows before anything is written.
study::Table table_of(const Job& job) {
    const auto known = std::make_shared<std::vector<std::vector<Response>>>(job.scenes.size());  // without elements
    study::Table table = sheet.table(
        job.scenes, [&](const study::Scene&) { return job.omegas.size(); },
        [=, &job](const study::Scene& scene, study::RowRange range, const study::Results<Response>& emit) {
            if (scene.is_discrete()) return emit_sweep(scene, job.omegas, job.checked, range, emit);
            const std::vector<Response>& own = (*known)[std::size_t(&scene - job.scenes.data())];
            for (std::size_t i = range.first; i < range.last; ++i) emit(own[i]);
        });
    table.prepare = [=, &job](const std::vector<std::size_t>& tasks, const auto& done) {
        std::size_t prepared = 0;
        for (const std::size_t task : tasks) {
            done(double(++prepared) / double(tasks.size()));
            if (job.scenes[task].is_discrete()) continue;
            for (const double omega : job.omegas) (*known)[task].push_back(solve_without_elements(job, task, omega));
        }
    };
    table.plot = [&](const study::Records& rows) { return draw_response(rows, job); };
    if (job.by_polynomials()) table.label = {};
    return table;
}

void add_options(study::Options& options) {
    options.add(
        "omega", "LIST",
        "frequencies omega a/V [dimensionless], at least 0; without it, --points from --omega-min to --omega-max");
    options.add("omega-min", "Z", "lowest frequency omega a/V [dimensionless], above 0", "0.01");
    options.add("omega-max", "Z", "highest frequency omega a/V [dimensionless], above --omega-min", "10");
    options.add(
        "points", "N",
        "number of frequencies [dimensionless], 2 to 1000000, both ends included, evenly spaced in the logarithm",
        "61");
    options.not_with({"omega-min", "omega-max", "points"}, "omega");
    options.add("basis", "NAME", "basis of the polynomials: monomial (the paper's) or chebyshev", "chebyshev")
        .only_with({"method=polynomial"});
    options
        .add("order", "LIST",
             "order of the polynomials [dimensionless], 1 to 100000000; default: enough at each frequency for machine "
             "precision in the Chebyshev basis")
        .only_with({"method=polynomial"});
    options.add_flag(
        "unchecked",
        "no check of the results: c11 is written whatever its status, also where --basis monomial has broken down");
    study::add_state_space_options(options, "the one scheme");
    options.not_with({"n", "mesh", "edges", "derivative", "state-space"}, "method=polynomial",
                     ", which has no elements and no states");
    study::offer_chebyshev(options, "; or polynomial (the paper's approach, of an --order)");
    study::offer_schemes(options, methods);
    options.footer(
        R"(Example: three meshes, with the Argand diagram and both parts over the frequency
  frequency_study --n 20,40,60 --omega-min 0.01 --omega-max 10 --points 101 --output c11.csv --plot c11.svg

One row per scheme and frequency:
)" + sheet.help() +
        R"(--method polynomial has no elements: n is empty and the column order gives the order. --basis monomial is the
paper's; an order at which it has broken down, or has not converged (the Chebyshev basis gives another c11), is
refused without --unchecked.
--method chebyshev: alpha_L, alpha_T, lambda are empty. 8 states have errors of 3e-14 up to omega = 1 and 2e-4
up to 5, 12 states of 6e-9 up to 5; narrow strips need more (b/a = 1: 16). c11 is empty if more states would
change its steady value by more than 1e-2.
--state-space: d x/d(q/a) = A x + B xi, -F/(a G) = C x + D xi, so that c11(s) = C (s I - A)^-1 B + D, s in V/a.
Plain numbers without header; numpy.loadtxt('A.csv', delimiter=',', ndmin=2) reads them. Elements need a regular
G. The table of the full system is written as well. With --states D is not zero; error_bound in state_space.toml is
twice the sum of the Hankel singular values left out and bounds the error of |c11| at every omega.
)");
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("frequency_study",
                           "Complex creep coefficient c11 under harmonic creepage over its frequency, and its error.");
    add_options(options);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const Job job = read_job(given);
        const study::Table table = table_of(job);
        study::OutputFiles files;
        study::write_state_space(
            given, files, job.scenes.size(),
            [&] { return equations_of(job.scenes.front(), given.said("state-space")); }, words_of_equations);
        study::write_table(given, table, files);
        return study::exit_ok;
    });
}
