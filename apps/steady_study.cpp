// Steady rolling in full adhesion: the creep coefficient c11 of a discretised contact against Carter's exact value, and
// what it costs to compute. The paper's scheme (alpha_L = 0, alpha_T = 0.63) is within 0.02 % for n >= 20:
//
//     ./steady_study --n 20,40,80 --alpha-T 0.63
//     ./steady_study --mesh cosine --alpha 0.5 --aspect inf --output cosine.csv --plot cosine.svg
//     ./steady_study --method chebyshev --n 4,8,16 --aspect 1
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "support/options.hpp"
#include "support/program.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace {

const std::vector<std::string> columns =
    study::joined({"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "c11", "c11_exact", "c11_ratio",
                   "relative_error", "residual", "assembly_us", "solve_us", "error_estimate", "status"},
                  study::setting_columns());

/// Results of elements or of Chebyshev states.
struct Steady {
    double c11;
    rollbem::Status status;
    study::Cell residual{}, assembly_us{}, solve_us{}, error_estimate{};
};

Steady by_elements(const study::Scene& scene, bool timed) {
    // 3. Assemble G' and solve G' p = xi for unit creepage.
    const auto assemble = [&] { return rollbem::assemble_G_prime(*scene.mesh, scene.scheme, scene.kernel); };
    const Eigen::MatrixXd G_prime = assemble();
    const Eigen::ArrayXd widths = rollbem::unknown_widths(*scene.mesh, scene.scheme);
    const rollbem::Response<double> solution = rollbem::solve_steady<double>(G_prime, widths);
    Steady result{.c11 = solution.c11(), .status = solution.status, .residual = solution.residual};

    // 4. Time both steps, unless other jobs would spoil it.
    if (timed) {
        result.assembly_us = study::median_time_us([&] { return assemble()(0, 0); });
        result.solve_us = study::median_time_us([&] { return rollbem::solve_steady<double>(G_prime, widths).c11(); });
    }
    return result;
}

/// The same by Chebyshev states, which are assembled and solved in one call.
Steady by_states(const study::Scene& scene, bool timed) {
    const auto solve = [&] { return solve_steady(*scene.chebyshev, scene.kernel); };
    const rollbem::Response<double> solution = solve();
    Steady result{.c11 = solution.c11(), .status = solution.status, .error_estimate = solution.error_estimate()};
    if (timed) result.solve_us = study::median_time_us([&] { return solve().c11(); });
    return result;
}

study::Row steady_row(const study::Options& options, const study::Scene& scene) {
    const bool timed = study::has_times(options);
    const Steady result = (scene.chebyshev ? by_states : by_elements)(scene, timed);

    // 5. Compare with the closed form. A c11 that cannot be trusted is left out.
    const std::string status = study::steady_status(scene, result.status, result.c11);
    const double c11 = status == study::ok ? result.c11 : std::nan("");
    const double exact = rollbem::steady_c11(scene.contact.poisson_ratio()), ratio = c11 / exact;
    return study::joined(
        {scene.method, scene.derivative, scene.mesh_name, scene.n(), scene.alpha_L, scene.alpha_T, c11, exact, ratio,
         ratio - 1, result.residual, result.assembly_us, result.solve_us, result.error_estimate, status},
        study::setting_cells(scene));
}

/// 6. --plot: the error over n, one line for each scheme; over alpha if there are more alphas than n.
study::Plot draw_errors(const std::vector<study::Scene>& scenes, const std::vector<study::Row>& rows) {
    std::set<Eigen::Index> numbers;
    std::set<double> alphas_L, alphas_T;
    bool equal = true;
    for (const study::Scene& scene : scenes) {
        numbers.insert(scene.n());
        alphas_L.insert(scene.alpha_L.value_or(0));
        alphas_T.insert(scene.alpha_T.value_or(0));
        equal = equal && scene.alpha_L == scene.alpha_T;
    }
    const bool over_L = alphas_L.size() > alphas_T.size();
    const bool over_alpha = std::max(alphas_L.size(), alphas_T.size()) > numbers.size();
    study::Plot plot{.title = "Steady rolling",
                     .x_label = scenes.front().n_label(),
                     .y_label = "|c_{11} / c_{11,exact} - 1|",
                     .log_x = !over_alpha,
                     .log_y = true};
    study::Selection selection{.by = {"method", "derivative", "mesh", "alpha_L", "alpha_T"},
                               .x = "n",
                               .y = "relative_error",
                               .absolute = true,
                               .apart = study::setting_columns()};
    if (over_alpha) {
        plot.x_label = equal ? "α_L = α_T" : over_L ? "α_L" : "α_T";
        selection.by = {"method", "derivative", "mesh", "n"};
        if (!equal) selection.by.emplace_back(over_L ? "alpha_T" : "alpha_L");
        selection.x = over_L ? "alpha_L" : "alpha_T";
    }
    study::add_series(plot, columns, rows, selection);
    for (study::Series& series : plot.series) {  // a logarithmic axis has no zero, and states can be exact
        for (auto& [n, error] : series.points) {
            error = std::max(error, study::least_drawn);
        }
    }
    study::add_model_differences(plot, scenes, [&](const auto& states, const auto& kernel, const auto& contact) {
        const double c11 = solve_steady(states, kernel).c11();
        const double difference = std::abs(c11 / rollbem::steady_c11(contact.poisson_ratio()) - 1);
        std::vector<std::pair<double, double>> points;
        for (const study::Row& row : rows) {
            points.emplace_back(*row[selection.x == "n" ? 3 : over_L ? 4 : 5].number(), difference);
        }
        std::sort(points.begin(), points.end());
        return points;
    });
    return plot;
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options(
        "steady_study",
        "Creep coefficient c11 of steady rolling, its error and its cost, over the number of elements.");
    options.set_default("n", "10,20,40,80,160,320");
    options.refuse("lambda", "a steady problem builds no G, the only matrix lambda acts on");
    study::offer_chebyshev(options);
    options.footer(R"(Example: three positions of the trailing point, as a file and a plot of the error
  steady_study --n 40,80,160 --alpha-L 0 --alpha-T 0.5,0.63,0.7 --output c11.csv --plot c11.svg

One row per scheme and n. c11_exact = pi/(2(1-nu)) is the plane limit b >> a, whatever the kernel: with the
strip kernel relative_error cannot fall below a floor of order (a/b)^2 (up to 5e-5 at b/a = 100, 5e-7 at 1000);
--aspect inf has none. c11_ratio = c11/c11_exact, relative_error = c11_ratio - 1. residual is what the solution p
leaves of its equations, max|G' p - xi| / (|G'| max|p| + |xi|) with the largest row sum |G'|: near 1e-16 the
equations are solved to rounding, whatever the error of the discretisation. assembly_us and solve_us
[microseconds] are medians of at least 5 runs. If status is not ok, c11 and all that follows from it are empty:
ill_conditioned or not_finite if G' is singular to working precision; assists_creepage if tractions assist the
creepage, so that the scheme does not converge to full adhesion: alpha at or below 0 (near 0 on coarse meshes), or
above 1; coarse if c11 of fewer than 10 elements is wrong by more than half (plane kernel, or strip with
b/a >= 10). The columns kernel to quadrature identify rows; they are empty if they do not apply to mesh or method.
--method chebyshev: columns that apply to elements only are empty, residual among them; solve_us includes
assembly. error_estimate (relative, of c11) estimates what more states would change. If it is above 1e-2, as
with few states in narrow strips (4 at b/a = 0.3), status is not_converged and c11 empty.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. One row for each scene.
        const std::vector<study::Scene> scenes =
            study::make_scenes(given, study::Problem::steady, study::Methods::elements_and_states);
        study::Table table = study::table_of(columns, scenes);
        table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
            emit(steady_row(given, scenes[task]));
        };

        table.plot = [&](const std::vector<study::Row>& rows) { return draw_errors(scenes, rows); };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
