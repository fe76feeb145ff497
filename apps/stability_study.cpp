// Stability in the time domain: the eigenvalues nu of G' p = nu G p, whose modes grow like e^{nu V t}. Their number,
// and the signs that rounding leaves open; the smallest alpha_T at which a mode grows; or the eigenvalues against the
// exact ones:
//
//     ./stability_study --n 20,40,60 --alpha-T 0.6,0.7,0.8,0.9
//     ./stability_study --critical --n 20,40,80,160
//     ./stability_study --spectrum --n 60 --mesh cosine --alpha 0.5 --plot spectrum.svg
//     ./stability_study --spectrum --method chebyshev --n 16 --kernel plane --aspect 100
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/reference/bessel.hpp>

#include "studies/critical_alpha.hpp"
#include "support/non_steady.hpp"
#include "support/sheet.hpp"
#include "support/timing.hpp"

namespace {

using study::Cell;
using Complex = std::complex<double>;
using Result = rollbem::StabilityResult;

constexpr study::Methods methods{
    .states = true,
    .not_extrapolated = "modes are counted, and eigenvalues of two meshes, not the same number, do not pair up"};

// --- how many modes grow -------------------------------------------------------------------------------------------

struct Count {
    Result of;
    std::string status;
    double cond_G = 0;
    Cell time_us{};

    bool found() const { return of.status == rollbem::Status::ok; }
};

/// A number of a result; none where the eigenvalues were not found.
template <class Number>
auto count_of(const Number& number) {
    return study::where(&Count::found, [=](const Count& c) { return std::invoke(number, c.of); });
}

const study::Sheet<Count> counts{
    "method, derivative, mesh, n, alpha_L, alpha_T, lambda",
    {{"unstable_count", "number of eigenvalues with a real part > 0, as computed", count_of(&Result::unstable_count)},
     {"uncertain_count",
      "number of eigenvalues of either sign that rounding errors in G and G' could move across zero, infinite ones "
      "included",
      count_of(&Result::uncertain_count)},
     {"unstable_fraction", "unstable_count / number of eigenvalues, n (n - 1 with knothe-bc)",
      count_of(&Result::unstable_fraction)},
     {"spectral_abscissa", "largest real part of the finite eigenvalues", count_of(&Result::spectral_abscissa)},
     {"cond_G", "condition of G in the 2-norm; empty if G is singular", study::where(&Count::found, &Count::cond_G)},
     {"time_us", std::string("time of assembly and eigenvalues [microseconds], ") + study::median_of_runs,
      study::where(&Count::found, &Count::time_us)},
     {"spectral_radius",
      "largest |nu a| (steps of an explicit integrator must stay below 2/spectral_radius); empty if an eigenvalue is "
      "infinite",
      count_of(&Result::spectral_radius)},
     {"stiffness_ratio", "largest |Re(nu a)| over the smallest; empty if an eigenvalue is infinite",
      count_of(&Result::stiffness_ratio)},
     {"status",
      "ok; " + study::steady_flaws +
          ", both whatever the eigenvalues; not_converged if more Chebyshev states would change the steady c11; "
          "ill_conditioned or not_finite, with empty cells, if the eigenvalues were not found or G is not finite",
      &Count::status}},
    study::settings};

/// All eigenvalues by QZ, how far rounding can move each, and the condition of G; then the time of the bare count,
/// unless other jobs would disturb it.
Count count(const study::Scene& scene, bool timed) {
    const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
    if (!system) return {Result{}, name(Result{}.status)};
    Count found{rollbem::judge_stability(*system), ""};
    if (found.of.status == rollbem::Status::ok) found.cond_G = rollbem::condition_number(system->G());
    found.status = study::status_of(found.of.status, scene, *system);
    if (timed) {
        found.time_us =
            study::median_time_us([&] { return rollbem::solve_stability(study::system_of(scene)).spectral_abscissa; });
    }
    return found;
}

/// The two quantities of a map: with at least five values each, where nothing else varies.
std::vector<std::string> map_axes(const study::Records& rows) {
    std::vector<std::string> varied;
    for (const std::string& name :
         {std::string("n"), std::string("alpha_L"), std::string("alpha_T"), std::string("lambda"),
          std::string("aspect"), std::string("poisson"), std::string("size_ratio"), std::string("epsilon")}) {
        const std::set<std::string> values = rows.texts(name);
        if (values.size() > 1 && values.size() < 5) return {};
        if (values.size() > 1) varied.push_back(name);
    }
    const bool differ =
        varied.size() == 2 && std::any_of(rows.rows.begin(), rows.rows.end(), [&](const study::Row& row) {
            return rows.cell(row, varied[0]).text() != rows.cell(row, varied[1]).text();
        });
    return differ ? varied : std::vector<std::string>{};
}

/// The share of growing modes over the swept quantity, or as a map over two.
study::Picture draw_counts(const std::vector<study::Scene>& scenes, const study::Records& rows) {
    if (const std::vector<std::string> axes = map_axes(rows); !axes.empty()) {
        study::Plot plot{.title = "Stability",
                         .x = {study::shown_name(axes[1])},
                         .y = {study::shown_name(axes[0])},
                         .colours = "share of unstable eigenvalues"};
        counts.draw(plot, rows, {.x = axes[1], .y = "unstable_fraction"}, {axes[0]});  // for its title
        plot.series = study::map_of(rows, axes[1], axes[0], "unstable_fraction");
        return {plot};
    }
    const study::Axis x = study::most_varied(scenes);
    study::Plot plot{.title = "Stability",
                     .x = {x.label, x.is_n()},
                     .y = {.label = "share of unstable eigenvalues", .range = study::PlotRange{0, 1}}};
    counts.draw(plot, rows, {.x = x.column, .y = "unstable_fraction"}, x.same);
    return {plot};
}

// --- the smallest unstable alpha_T ---------------------------------------------------------------------------------

struct Critical {
    std::optional<double> alpha_T;
    std::string status;
};

const study::Sheet<Critical> criticals{
    "method, derivative, mesh, n, alpha_L",
    {{"critical_alpha_T",
      "smallest alpha_T with an unstable eigenvalue whose sign rounding cannot change; above it the scheme can be "
      "stable again; empty, with the status all_stable, if there is none. n = 320 takes half a minute",
      &Critical::alpha_T},
     {"lambda", "factor on all alphas in G, as in its option"},
     {"status", "ok, all_stable or not_finite", &Critical::status}},
    study::settings};

Critical critical(const study::Scene& scene) {
    if (!study::system_if_finite(scene)) return {std::nullopt, name(rollbem::Status::not_finite)};
    study::Scene changed = scene;
    const auto scheme_of = [&](double alpha_T) {
        changed.alpha_T = alpha_T;
        return changed.equations();
    };
    const std::optional<double> alpha_T = rollbem::studies::critical_alpha_T(*scene.mesh, scheme_of, scene.kernel);
    return {alpha_T, alpha_T ? study::ok : "all_stable"};
}

study::Picture draw_criticals(const study::Records& rows) {
    study::Plot plot{.title = "Smallest unstable α_T", .x = {"number of elements n", true}, .y = {"critical α_T"}};
    criticals.draw(plot, rows, {.x = "n", .y = "critical_alpha_T"});
    return {plot};
}

// --- the eigenvalues -----------------------------------------------------------------------------------------------

struct Eigenvalue {
    Complex nu;  ///< not a number where it is infinite, or not found
    std::optional<Complex> exact;
    std::string status;

    bool finite() const { return std::isfinite(nu.real()); }
};

const study::Sheet<Eigenvalue> spectrum{
    "n",
    {{"re", "real part of nu a, in the order of the modulus; empty if it is infinite, as where G is singular",
      [](const Eigenvalue& e) { return e.nu.real(); }},
     {"im", "imaginary part of nu a",
      study::where(&Eigenvalue::finite, [](const Eigenvalue& e) { return e.nu.imag(); })},
     {"exact_re",
      "real part of the nearest eigenvalue of the plane model in closed form, also for the strip kernel, whose model "
      "differs by order (a/b)^2; empty for infinite eigenvalues, for |nu a| > 3e4, which no mesh resolves, and for "
      "contacts so narrow that the plane model does not decay",
      [](const Eigenvalue& e) { return e.exact ? Cell(e.exact->real()) : Cell(); }},
     {"exact_im", "imaginary part of the same",
      [](const Eigenvalue& e) { return e.exact ? Cell(e.exact->imag()) : Cell(); }},
     {"alpha_L, alpha_T, lambda", "positions of the points of the scheme"},
     {"status", "status as in the table of counts; not_finite of infinite eigenvalues", &Eigenvalue::status}},
    std::string("method, derivative, mesh, ") + study::settings};

constexpr double most_resolved = 3e4;  // |nu a| far beyond what any mesh resolves; keeps the list short

/// The eigenvalues of the plane model in closed form with Im >= 0, by ascending modulus: they are about pi apart, and
/// these reach at least as far as `modulus`. None if the model does not decay.
std::vector<Complex> exact_eigenvalues(const rollbem::Contact& contact, double modulus) {
    if (!study::plane_model_decays(contact)) return {};
    return rollbem::reference::eigenvalues(static_cast<std::size_t>(modulus / std::numbers::pi) + 8,
                                           contact.poisson_ratio(), contact.aspect());
}

std::optional<Complex> nearest(const std::vector<Complex>& exact, Complex nu) {
    if (exact.empty() || !(std::abs(nu) <= most_resolved)) return std::nullopt;
    const Complex above(nu.real(), std::abs(nu.imag()));
    const Complex found = *std::min_element(exact.begin(), exact.end(), [&](Complex left, Complex right) {
        return std::abs(left - above) < std::abs(right - above);
    });
    return nu.imag() < 0 ? std::conj(found) : found;
}

/// The eigenvalues by ascending modulus, infinite ones last, each beside the nearest exact one.
void emit_spectrum(const study::Scene& scene, study::RowRange range, const study::Results<Eigenvalue>& emit) {
    const std::optional<rollbem::RollingSystem<double>> system = study::system_if_finite(scene);
    Result result;
    if (system) result = rollbem::solve_stability(*system);
    const std::string status = system ? study::status_of(result.status, scene, *system) : name(result.status);
    const bool found = result.status == rollbem::Status::ok;
    std::vector<Complex> eigenvalues(range.last, Complex(std::nan("")));
    if (found) {
        const Eigen::VectorXcd computed = result.eigenvalues();
        eigenvalues.assign(computed.begin(), computed.end());
        std::stable_sort(eigenvalues.begin(), eigenvalues.end(),
                         [](const Complex& left, const Complex& right) { return std::abs(left) < std::abs(right); });
    }
    double modulus = 0;
    for (const Complex& nu : eigenvalues) {
        if (std::abs(nu) <= most_resolved) modulus = std::max(modulus, std::abs(nu));
    }
    const std::vector<Complex> exact = exact_eigenvalues(scene.contact, modulus);
    for (std::size_t k = range.first; k < range.last; ++k) {
        Eigenvalue row{eigenvalues[k], nearest(exact, eigenvalues[k]), status};
        if (found && !row.finite()) row.status = name(rollbem::Status::not_finite);
        emit(row);
    }
}

/// The frame holds the complex plane up to the highest wavenumber that the elements resolve, and every mode that grows.
/// Modes that decay faster are left beyond it.
void set_view(study::Plot& plot, double wavenumber) {
    double fastest = 0, right = 0, height = wavenumber;
    for (const study::Series& series : plot.series) {
        for (const auto& [re, im] : series.points) {
            if (re <= 0 && std::abs(im) <= wavenumber) fastest = std::max(fastest, -re);
            if (re > 0) height = std::max(height, std::abs(im));
            right = std::max(right, re);
        }
    }
    const double left = -std::clamp(fastest, 1.0, std::max({3.0, wavenumber / 4, right}));
    constexpr double margin = 1.04;  // for markers
    const double linear_within = std::max(right, height) > 20 * wavenumber ? wavenumber / 4 : 0;
    plot.x = {
        .label = "Re(ν a)", .linear_within = linear_within, .range = study::PlotRange{margin * left, margin * right}};
    plot.y = {.label = "Im(ν a)",
              .linear_within = linear_within,
              .range = study::PlotRange{-margin * height, margin * height}};
}

study::Picture draw_spectrum(const std::vector<study::Scene>& scenes, const study::Records& rows) {
    Eigen::Index n = 0;
    for (const study::Scene& scene : scenes) n = std::max(n, scene.n());
    const double wavenumber = std::numbers::pi / 2 * static_cast<double>(n);
    study::Plot plot;
    spectrum.draw(plot, rows, {.x = "re", .y = "im", .look = study::Look::markers});
    study::Series unstable{"unstable, Re(ν a) > 0", study::Look::crosses};
    std::size_t infinite = 0;
    for (study::Series& series : plot.series) {
        const std::size_t before = unstable.points.size();
        std::copy_if(series.points.begin(), series.points.end(), std::back_inserter(unstable.points),
                     [](const auto& nu) { return nu.first > 0; });
        if (plot.series.size() > 1)
            series.label += ": " + std::to_string(unstable.points.size() - before) + " unstable";
        infinite += std::erase_if(series.points, [](const auto& nu) { return std::isnan(nu.first); });
    }
    const std::string count = unstable.points.empty() ? "none" : std::to_string(unstable.points.size());
    plot.title = "Eigenvalues, " + count + " of " + std::to_string(rows.rows.size()) + " unstable" +
                 (infinite > 0 ? ", " + std::to_string(infinite) + " infinite or not found" : "") + plot.title;
    study::Series exact{"exact", study::Look::exact_markers};
    for (const study::Scene& scene : scenes) {
        for (const Complex& nu : exact_eigenvalues(scene.contact, wavenumber)) {
            exact.points.emplace_back(nu.real(), nu.imag());
            if (nu.imag() > 0) exact.points.emplace_back(nu.real(), -nu.imag());
        }
    }
    plot.series.push_back(std::move(exact));
    plot.series.insert(plot.series.begin(), std::move(unstable));
    set_view(plot, wavenumber);
    return {plot};
}

// --- the modes of the program --------------------------------------------------------------------------------------

struct Job {
    std::vector<study::Scene> scenes;
    bool critical, spectrum, timed;
};

Job read_job(const study::Options& options) {
    Job job{study::make_non_steady_scenes(options, methods), options.flag("critical"), options.flag("spectrum"),
            study::has_times(options)};
    for (const study::Scene& scene : job.scenes) {
        if (!job.critical) break;
        if (!scene.alpha_T) throw study::BadInput("--critical has no effect with schemes without an alpha_T");
        if (scene.n() >= 2) continue;
        throw study::BadInput("--critical needs at least 2 elements, alpha_T and alpha_L differ; given is n = " +
                              std::to_string(scene.n()));
    }
    return job;
}

study::Table table_of(const Job& job) {
    const std::vector<study::Scene>& scenes = job.scenes;
    if (job.critical) {
        study::Table table = criticals.table(scenes, critical);
        table.plot = draw_criticals;
        return table;
    }
    if (job.spectrum) {
        const auto rows = [](const study::Scene& scene) {
            return scene.chebyshev ? scene.n() : rollbem::unknown_count(scene.scheme, *scene.mesh);
        };
        study::Table table = spectrum.table(scenes, rows, emit_spectrum);
        table.plot = [&](const study::Records& drawn) { return draw_spectrum(scenes, drawn); };
        return table;
    }
    study::Table table = counts.table(scenes, [&](const study::Scene& scene) { return count(scene, job.timed); });
    table.plot = [&](const study::Records& rows) { return draw_counts(scenes, rows); };
    return table;
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options(
        "stability_study",
        "Eigenvalues of the discretised contact in time: how many grow, the smallest unstable alpha_T, or all.");
    options
        .add_flag("critical",
                  "table of the smallest unstable alpha_T in [0.3, 1.5], found by a scan of step 0.0005 and bisection "
                  "to 1e-5, in place of counts")
        .only_with({"method=collocation", "method=galerkin"}, ": others have no alpha_T")
        .not_with("spectrum");
    options.add_flag("spectrum", "table of all eigenvalues, each with the nearest exact one, in place of counts");
    options.not_with({"alpha-T"}, "critical", ", which searches for it");
    options.not_with({"alpha"}, "critical", ", which takes --alpha-L and searches for alpha_T");
    study::offer_chebyshev(options);
    study::offer_schemes(options, methods);
    options.footer(
        R"(Example: the scheme that is best in steady state, on refined meshes, with a plot
  stability_study --n 20,60,160,166 --alpha-T 0.5,0.63,0.8 --output stable.csv --plot stable.svg

Modes grow like e^{nu V t}; all eigenvalues are nu a, dimensionless. One row per scheme and n:
)" + counts.help() +
        "With --critical, one row per n, lambda and alpha_L:\n" + criticals.help() +
        "With --spectrum, one row per eigenvalue:\n" + spectrum.help() +
        R"(--method chebyshev: columns that apply to elements only are empty. Few states give the first eigenvalues to
rounding; the fastest, of about n^2/10, are artefacts of the method. There is no alpha_T, hence no --critical, as
with --method nodes and knothe-bc.
)");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const Job job = read_job(given);
        study::write_table(given, table_of(job));
        return study::exit_ok;
    });
}
