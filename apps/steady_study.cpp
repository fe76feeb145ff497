// Steady rolling in full adhesion: the creep coefficient c11 of a discretised contact against Carter's exact value, and
// what it costs to compute. The paper's scheme (alpha_L = 0, alpha_T = 0.63) is within 0.02 % for n >= 20:
//
//     ./steady_study --n 20,40,80 --alpha-T 0.63
//     ./steady_study --mesh cosine --alpha 0.5 --aspect inf --output cosine.csv --plot cosine.svg
//     ./steady_study --method chebyshev --n 4,8,16 --aspect 1
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/spectral/polynomial.hpp>
#include <rollbem/steady/steady.hpp>

#include "support/sheet.hpp"
#include "support/timing.hpp"

namespace {

using study::Cell;

constexpr study::Methods methods{.states = true, .closed = true};

/// The result for one scene. A c11 that cannot be trusted is not a number.
struct Steady {
    double c11, exact;
    std::string status;
    Cell residual{}, assembly_us{}, solve_us{}, error_estimate{};

    double ratio() const { return c11 / exact; }
};

const study::Sheet<Steady> sheet{
    "method, derivative, mesh, n, alpha_L, alpha_T",
    {{"c11", "creep coefficient -F/(a G xi), F per unit width", &Steady::c11},
     {"c11_exact",
      "pi/(2(1-nu)), the plane limit b >> a, whatever the kernel: with the strip kernel relative_error cannot fall "
      "below a floor of order (a/b)^2 (up to 5e-5 at b/a = 100, 5e-7 at 1000); --aspect inf has none",
      &Steady::exact},
     {"c11_ratio", "c11/c11_exact", &Steady::ratio},
     {"relative_error", "c11_ratio - 1", [](const Steady& s) { return s.ratio() - 1; }},
     {"residual",
      "residual of the equations for the tractions p, max|G' p - xi| / (|G'| max|p| + |xi|) with the largest row sum "
      "|G'|: near 1e-16 where they are solved to rounding, whatever the error of the discretisation; empty with "
      "chebyshev",
      &Steady::residual},
     {"assembly_us", std::string("time of G' [microseconds], ") + study::median_of_runs + "; empty with chebyshev",
      &Steady::assembly_us},
     {"solve_us",
      std::string("time of its equations [microseconds], ") + study::median_of_runs + "; with chebyshev time of both",
      &Steady::solve_us},
     {"error_estimate", "relative change of c11 by more states or a higher order of polynomials; empty for elements",
      &Steady::error_estimate},
     {"status",
      "ok, or why c11 and all that follows from it are empty: ill_conditioned or not_finite if G' is singular to "
      "working precision; " +
          study::steady_flaws +
          "; not_converged if error_estimate is above 1e-2, as with few states in narrow strips (4 at b/a = 0.3)",
      &Steady::status}},
    study::settings};

/// A polynomial's result, or the exact one.
Steady solve_without_elements(const study::Scene& scene, bool timed) {
    Steady result{.c11 = 0, .exact = rollbem::steady_c11(scene.contact.poisson_ratio()), .status = study::ok};
    result.c11 = result.exact;
    if (scene.degree == 0) return result;
    constexpr double aspect = 1000;  // of no influence, but some the polynomials need
    rollbem::EstimatedC11<double> found;
    result.solve_us = study::time_us_if(timed, [&] {
        found = rollbem::polynomial_c11(std::complex<double>(0), scene.contact.poisson_ratio(), aspect, scene.degree);
        return found.c11.real();
    });
    result.c11 = found.status == rollbem::Status::ok ? found.c11.real() : std::nan("");
    result.error_estimate = found.error_estimate;
    result.status = name(found.status);
    return result;
}

/// Assembles G' and solves G' p = xi for unit creepage, by Chebyshev states in one call; times both, unless other jobs
/// would spoil it.
Steady solve_once(const study::Scene& scene, bool timed) {
    const bool has_elements = !scene.chebyshev;
    std::optional<double> assembly_us;
    Eigen::MatrixXd G_prime;
    if (has_elements) {
        assembly_us = study::time_us_if(timed, [&] {
            G_prime = rollbem::assemble_G_prime(*scene.mesh, scene.scheme, scene.kernel);
            return G_prime(0, 0);
        });
    }
    rollbem::Response<double> solution;
    const std::optional<double> solve_us = study::time_us_if(timed, [&] {
        solution = has_elements
                       ? rollbem::solve_steady<double>(G_prime, rollbem::unknown_widths(*scene.mesh, scene.scheme))
                       : solve_steady(*scene.chebyshev, scene.kernel);
        return solution.c11();
    });
    Steady result{.c11 = solution.c11(),
                  .exact = rollbem::steady_c11(scene.contact.poisson_ratio()),
                  .status = study::steady_status(scene, solution.status, solution.c11()),
                  .assembly_us = assembly_us,
                  .solve_us = solve_us};
    if (result.status != study::ok) result.c11 = std::nan("");
    if (has_elements) result.residual = solution.residual;
    if (!has_elements) result.error_estimate = solution.error_estimate();
    return result;
}

/// The solution of a scene without elements, on one mesh, or extrapolated from two, whose times are added.
Steady solve(const study::Scene& scene, bool timed) {
    if (!scene.is_discrete()) return solve_without_elements(scene, timed);
    if (!scene.coarse) return solve_once(scene, timed);
    const std::vector<study::Scene> meshes = scene.meshes();
    const Steady coarse = solve_once(meshes.back(), timed);
    Steady fine = solve_once(meshes.front(), timed);
    fine.c11 = rollbem::richardson(coarse.c11, fine.c11, scene.order());
    if (fine.status == study::ok) fine.status = coarse.status;
    for (study::Cell Steady::*time : {&Steady::assembly_us, &Steady::solve_us}) {
        if (timed) fine.*time = *(fine.*time).number() + *(coarse.*time).number();
    }
    return fine;
}

/// The error over n, one line for each scheme; over alpha if there are more alphas than n.
study::Picture draw_errors(const std::vector<study::Scene>& scenes, const study::Records& rows) {
    const study::Axis x = study::most_varied(scenes);
    study::Plot plot{.title = "Steady rolling", .x = {x.label, x.is_n()}, .y = {"|c_{11} / c_{11,exact} - 1|", true}};
    sheet.draw(plot, rows, {.x = x.column, .y = "relative_error", .absolute = true}, x.same);
    return {plot};
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options(
        "steady_study",
        "Creep coefficient c11 of steady rolling, its error and its cost, over the number of elements.");
    options.set_default("n", "10,20,40,80,160,320");
    options.refuse("lambda", study::no_lambda);
    study::offer_chebyshev(options);
    study::offer_schemes(options, methods);
    options.footer(R"(Example: three positions of the trailing point, as a file and a plot of the error
  steady_study --n 40,80,160 --alpha-L 0 --alpha-T 0.5,0.63,0.7 --output c11.csv --plot c11.svg

One row per scheme and n. Columns before c11 and after status identify the case; they are empty where they do not apply.
)" + sheet.help());

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const auto scenes = study::make_scenes(given, study::Problem::steady, methods);
        const bool timed = study::has_times(given);
        study::Table table = sheet.table(scenes, [&](const study::Scene& scene) { return solve(scene, timed); });
        table.plot = [&](const study::Records& rows) { return draw_errors(scenes, rows); };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
