// Stability in time: the eigenvalues nu of G' p = nu G p, whose modes grow like e^{nu V t}. Their number, and the signs
// that rounding leaves open; the smallest alpha_T at which a mode grows; or the eigenvalues beside the exact ones:
//
//     ./stability_study --n 20,40,60 --alpha-T 0.6,0.7,0.8,0.9
//     ./stability_study --critical --n 20,40,80,160
//     ./stability_study --spectrum --n 60 --mesh cosine --alpha 0.5 --plot spectrum.svg
//     ./stability_study --spectrum --method chebyshev --n 16 --kernel plane --aspect 100
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/compiled/stability.hpp>
#include <rollbem/studies/critical_alpha.hpp>

#include "stability/exact_spectrum.hpp"
#include "support/non_steady.hpp"
#include "support/options.hpp"
#include "support/program.hpp"
#include "support/scenes.hpp"
#include "support/table.hpp"
#include "support/timing.hpp"

namespace {

using Complex = std::complex<double>;

// --- how many modes grow -------------------------------------------------------------------------------------------

const std::vector<std::string> count_columns = study::joined(
    {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lambda", "unstable_count", "uncertain_count",
     "unstable_fraction", "spectral_abscissa", "cond_G", "time_us", "spectral_radius", "stiffness_ratio", "status"},
    study::setting_columns());

study::Row count_row(const study::Options& options, const study::Scene& scene) {
    // 3. All eigenvalues by QZ, how far rounding can move each, and the condition of G.
    const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
    rollbem::StabilityResult<double> result;
    if (system) result = rollbem::solve_stability<double>(*system, {.settle_signs = true, .condition = true});

    // 4. Time the bare count, unless other jobs would disturb it.
    study::Cell time_us;
    if (system && study::has_times(options)) {
        time_us = study::median_time_us(
            [&] { return rollbem::solve_stability<double>(study::system_of(scene)).spectral_abscissa; });
    }

    study::Row row{scene.method,  scene.derivative, scene.mesh_name, scene.n(),
                   scene.alpha_L, scene.alpha_T,    scene.lambda};
    if (result.status == rollbem::Status::ok) {
        row.insert(row.end(),
                   {result.unstable_count, result.uncertain_count, result.unstable_fraction(), result.spectral_abscissa,
                    result.cond_G, time_us, result.spectral_radius, result.stiffness_ratio});
    }
    row.resize(count_columns.size() - study::setting_columns().size() - 1);
    row.emplace_back(system ? study::status_of(result.status, scene, *system) : name(result.status));
    return study::joined(row, study::setting_cells(scene));
}

study::Table count_table(const study::Options& options, const std::vector<study::Scene>& scenes) {
    study::Table table = study::table_of(count_columns, scenes);
    table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
        emit(count_row(options, scenes[task]));
    };

    // 5. --plot: the share of growing modes over the swept quantity.
    table.plot = [&](const std::vector<study::Row>& rows) {
        const auto swept = [&](const char* name) { return options.text(name).find(',') != std::string::npos; };
        const bool equal = options.given("alpha");
        const std::string x = equal && swept("alpha")      ? "alpha_T"
                              : !equal && swept("alpha-T") ? "alpha_T"
                              : swept("lambda")            ? "lambda"
                              : !equal && swept("alpha-L") ? "alpha_L"
                                                           : "n";
        study::Plot plot{.title = "Stability",
                         .x_label = equal && x == "alpha_T" ? "α_L = α_T"
                                    : x == "n"              ? scenes.front().n_label()
                                                            : study::shown_name(x),
                         .y_label = "share of unstable eigenvalues",
                         .log_x = x == "n"};
        study::Selection selection{.by = {}, .x = x, .y = "unstable_fraction", .apart = study::setting_columns()};
        for (const char* name : {"method", "derivative", "mesh", "n", "alpha_L", "alpha_T", "lambda"}) {
            const bool follows = equal && x == "alpha_T" && name == std::string("alpha_L");
            if (name != x && !follows) selection.by.emplace_back(name);
        }
        study::add_series(plot, count_columns, rows, selection);
        double largest = 0;
        for (const study::Series& series : plot.series) {
            for (const auto& [place, share] : series.points) largest = std::max(largest, share);
        }
        if (largest == 0) plot.y_range = study::PlotRange{0, 1};
        return plot;
    };
    return table;
}

// --- the smallest unstable alpha_T ---------------------------------------------------------------------------------

const std::vector<std::string> critical_columns = study::joined(
    {"method", "derivative", "mesh", "n", "alpha_L", "critical_alpha_T", "lambda", "status"}, study::setting_columns());

std::optional<double> critical_alpha_T(const study::Scene& scene) {
    const auto scheme_of = [&](double alpha_T) {
        const auto changed = [alpha_T](auto scheme) -> rollbem::AnyScheme {
            scheme.alpha_T = alpha_T;
            return scheme;
        };
        const auto* galerkin = scene.scheme.get_if<rollbem::Galerkin>();
        return galerkin != nullptr ? changed(*galerkin) : changed(*scene.scheme.get_if<rollbem::Collocation>());
    };
    return rollbem::critical_alpha_T(*scene.mesh, scheme_of, scene.kernel);
}

study::Table critical_table(const std::vector<study::Scene>& scenes) {
    study::Table table = study::table_of(critical_columns, scenes);
    table.compute = [&](std::size_t task, study::RowRange, const study::Emit& emit) {
        const study::Scene& scene = scenes[task];
        const bool finite = study::system_if_finite(scene).has_value();
        const std::optional<double> critical = finite ? critical_alpha_T(scene) : std::nullopt;
        const std::string status = !finite ? name(rollbem::Status::not_finite) : critical ? study::ok : "all_stable";
        emit(study::joined(
            {scene.method, scene.derivative, scene.mesh_name, scene.n(), scene.alpha_L, critical, scene.lambda, status},
            study::setting_cells(scene)));
    };
    table.plot = [](const std::vector<study::Row>& rows) {
        study::Plot plot{.title = "Smallest unstable α_T",
                         .x_label = "number of elements n",
                         .y_label = "critical α_T",
                         .log_x = true};
        study::add_series(plot, critical_columns, rows,
                          {.by = {"method", "derivative", "mesh", "alpha_L", "lambda"},
                           .x = "n",
                           .y = "critical_alpha_T",
                           .apart = study::setting_columns()});
        return plot;
    };
    return table;
}

// --- the eigenvalues -----------------------------------------------------------------------------------------------

const std::vector<std::string> spectrum_columns = study::joined(
    {"n", "re", "im", "exact_re", "exact_im", "alpha_L", "alpha_T", "lambda", "status"}, study::all_setting_columns());

void emit_spectrum(const study::Scene& scene, study::RowRange range, const study::Emit& emit) {
    // 3. The eigenvalues by ascending modulus; infinite ones come last.
    const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
    rollbem::StabilityResult<double> result;
    if (system) result = rollbem::solve_stability<double>(*system);
    const std::string status = system ? study::status_of(result.status, scene, *system) : name(result.status);
    std::vector<Complex> eigenvalues(range.last, Complex(std::nan("")));
    if (result.status == rollbem::Status::ok) {
        const Eigen::VectorXcd computed = result.eigenvalues();
        eigenvalues.assign(computed.begin(), computed.end());
        std::stable_sort(eigenvalues.begin(), eigenvalues.end(),
                         [](const Complex& left, const Complex& right) { return std::abs(left) < std::abs(right); });
    }

    // 4. Each beside the nearest exact one.
    const stability::ExactSpectrum exact(scene.contact, eigenvalues);
    for (std::size_t k = range.first; k < range.last; ++k) {
        const Complex nu = eigenvalues[k];
        const bool finite = std::isfinite(nu.real());
        const std::optional<Complex> near = exact.nearest(nu);
        study::Cell im, exact_re, exact_im;
        if (finite) im = nu.imag();
        if (near) exact_re = near->real();
        if (near) exact_im = near->imag();
        const bool infinite = result.status == rollbem::Status::ok && !finite;
        emit(study::joined({scene.n(), nu.real(), im, exact_re, exact_im, scene.alpha_L, scene.alpha_T, scene.lambda,
                            infinite ? name(rollbem::Status::not_finite) : status},
                           study::all_setting_cells(scene)));
    }
}

/// 5. --plot: the complex plane up to the highest wavenumber that the elements resolve, with a margin.
study::Plot draw_spectrum(const std::vector<study::Scene>& scenes, const std::vector<study::Row>& rows) {
    Eigen::Index n = 0;
    for (const study::Scene& scene : scenes) n = std::max(n, scene.n());
    const double height = std::numbers::pi / 2 * static_cast<double>(n);
    const std::string mesh = scenes.front().mesh_name;
    study::Plot plot{.title = "Eigenvalues, " + scenes.front().method + (mesh.empty() ? "" : ", " + mesh),
                     .x_label = "Re(ν a)",
                     .y_label = "Im(ν a)"};
    study::add_series(
        plot, spectrum_columns, rows,
        {.by = {"n", "alpha_L", "alpha_T", "lambda"}, .x = "re", .y = "im", .apart = study::setting_columns()});
    double left = -1, right = 0;
    for (study::Series& series : plot.series) {
        series.line = false;
        if (plot.series.size() == 1) series.label = "computed";
        for (const auto& [re, im] : series.points) {
            if (std::abs(im) > height) continue;
            left = std::min(left, std::max(re, -height / 4));
            right = std::max(right, std::min(re, height));
        }
    }
    study::Series exact{.label = "exact", .line = false, .open = true, .style = 2, .reference = true};
    for (const rollbem::Contact<double>& contact : study::contacts_of(scenes)) {
        const stability::ExactSpectrum known(contact, {Complex(0, height)});
        for (const Complex& nu : known.upper_half()) {
            exact.points.emplace_back(nu.real(), nu.imag());
            if (nu.imag() > 0) exact.points.emplace_back(nu.real(), -nu.imag());
            left = std::min(left, nu.real());
        }
    }
    plot.series.push_back(exact);
    const double margin = (right - left) / 20;
    plot.x_range = {left - margin, right + margin};
    plot.y_range = {-height, height};
    std::size_t inside = 0;
    for (const study::Series& series : plot.series) {
        if (series.reference) continue;
        inside += std::size_t(std::count_if(series.points.begin(), series.points.end(), [&](const auto& nu) {
            return std::abs(nu.first - (left + right) / 2) <= (right - left) / 2 + margin &&
                   std::abs(nu.second) <= height;
        }));
    }
    if (inside < rows.size()) {
        plot.title +=
            "; " + std::to_string(rows.size() - inside) + " of " + std::to_string(rows.size()) + " are not shown";
    }
    return plot;
}

study::Table spectrum_table(const std::vector<study::Scene>& scenes) {
    study::Table table;
    table.columns = spectrum_columns;
    table.label = [&](std::size_t task) { return scenes[task].label(); };
    for (const study::Scene& scene : scenes) {
        const Eigen::Index count = scene.chebyshev ? scene.n() : rollbem::unknown_count(scene.scheme, *scene.mesh);
        table.rows_of_task.push_back(static_cast<std::size_t>(count));
    }
    table.compute = [&](std::size_t task, study::RowRange range, const study::Emit& emit) {
        emit_spectrum(scenes[task], range, emit);
    };

    table.plot = [&](const std::vector<study::Row>& rows) { return draw_spectrum(scenes, rows); };
    return table;
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options(
        "stability_study",
        "Eigenvalues of the discretised contact in time: how many grow, the smallest unstable alpha_T, or all.");
    options.add_flag("critical",
                     "the smallest unstable alpha_T in [0.3, 1.5], by a scan of step 0.0005 and bisection to 1e-5");
    options.add_flag("spectrum", "every eigenvalue beside the nearest exact one");
    study::offer_chebyshev(options);
    options.footer(R"(Example: the scheme that is best in steady state, on refined meshes, with a plot
  stability_study --n 20,60,160,166 --alpha-T 0.5,0.63,0.8 --output stable.csv --plot stable.svg

Modes grow like e^{nu V t}; all eigenvalues are nu a, dimensionless. unstable_count: real part > 0 as computed;
uncertain_count: those of either sign that rounding errors in G and G' could move across zero, infinite ones
included; unstable_fraction = unstable_count / number of eigenvalues, n (n - 1 with knothe-bc);
spectral_abscissa: the largest real part of the finite ones; cond_G: in the 2-norm, empty if G is singular;
time_us [microseconds]: assembly and eigenvalues, median of at least 5 runs; spectral_radius: the largest |nu a|
(steps of an explicit integrator must stay below 2/spectral_radius); stiffness_ratio: the largest |Re(nu a)| over
the smallest. Both are empty if an eigenvalue is infinite. status: ok; assists_creepage if steady rolling shows that
the scheme does not converge to full adhesion (alpha near or below 0, or above 1), whatever its eigenvalues;
coarse if the steady c11 of fewer than 10 elements is wrong by more than half; not_converged if more Chebyshev
states would change it; ill_conditioned or not_finite, with empty cells, if the eigenvalues were not found or G is
not finite.
--critical: one row per n, lambda and alpha_L; critical_alpha_T is the smallest with an unstable eigenvalue whose
sign rounding cannot change; it is empty, with the status all_stable, if there is none. Above it the scheme can
be stable again. n = 320 takes half a minute.
--spectrum: rows in order of the modulus. exact_re, exact_im is the nearest eigenvalue of the plane model in
closed form, also for the strip kernel, whose model differs by order (a/b)^2. Infinite eigenvalues, which a
singular G has, are rows with empty re and im. exact cells are empty for them, for |nu a| > 3e4, which no mesh
resolves, and for contacts so narrow that the plane model does not decay.
--method chebyshev: columns that apply to elements only are empty. Few states give the first eigenvalues to
rounding; the fastest, of about n^2/10, are artefacts of the method. There is no alpha_T, hence no --critical, as
with --method nodes and knothe-bc.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. One row, or one for each eigenvalue, of each scene.
        const bool critical = given.flag("critical"), spectrum = given.flag("spectrum");
        if (critical && spectrum) throw study::BadInput("--critical and --spectrum must not be given together");
        if (critical) {
            given.ignored("alpha-T", "with --critical, which searches for it");
            given.ignored("alpha", "with --critical, which takes --alpha-L and searches for alpha_T");
            const std::string method = given.text("method");
            if (method == "knothe-bc" || method == "nodes" || method == "chebyshev") {
                throw study::BadInput(given.said("method") +
                                      " must be collocation or galerkin with --critical: it has no alpha_T");
            }
        }
        const std::vector<study::Scene> scenes =
            study::make_non_steady_scenes(given, study::Methods::elements_and_states);
        for (const study::Scene& scene : scenes) {
            if (critical && scene.n() < 2) {
                throw study::BadInput(
                    "--critical needs at least 2 elements, alpha_T and alpha_L differ; given is n = " +
                    std::to_string(scene.n()));
            }
        }
        study::write_table(given, critical   ? critical_table(scenes)
                                  : spectrum ? spectrum_table(scenes)
                                             : count_table(given, scenes));
        return study::exit_ok;
    });
}
