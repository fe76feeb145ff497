// Tractions of the elements in steady rolling against Carter's exact solution, which is singular at the trailing
// edge. Away from the edges they converge; the element at the trailing edge keeps its relative error. Chebyshev states
// include the singularity:
//
//     ./traction_study --n 20
//     ./traction_study --n 20,80 --mesh cosine --alpha 0.5 --output traction.csv --plot traction.svg
//     ./traction_study --method chebyshev --n 12 --kernel plane
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "support/sheet.hpp"

namespace {

constexpr study::Methods methods{.states = true};

/// The traction at a point and Carter's; elements are compared with his mean over the element.
struct Traction {
    double x, traction, carter;
    std::string status;
    std::optional<double> carter_mean{};
};

const study::Sheet<Traction> sheet{
    "n",
    {{"x_over_a",
      "position x/a, -1 at the trailing edge: centres of the elements; with chebyshev the n points cos((2k-1) pi/(2n))",
      &Traction::x},
     {"traction", "traction p/(G xi), negative; with knothe-bc 0 on the leading element", &Traction::traction},
     {"carter", "Carter's exact traction there", &Traction::carter},
     {"carter_mean", "mean of Carter's traction over the element; empty with chebyshev", &Traction::carter_mean},
     {"relative_error", "traction/carter_mean - 1, or traction/carter - 1 with chebyshev",
      [](const Traction& t) { return t.traction / t.carter_mean.value_or(t.carter) - 1; }},
     {"alpha_L, alpha_T", "positions of the points of the scheme"},
     {"status",
      "ok, or why traction and relative_error are empty: ill_conditioned or not_finite if G' is singular to working "
      "precision; " +
          study::steady_flaws +
          "; not_converged if more Chebyshev states would change c11 by more than 1e-2, as in narrow strips",
      &Traction::status}},
    std::string("method, derivative, mesh, ") + study::settings};

/// The tractions of all elements for unit creepage; not numbers unless the status is ok.
struct Elements {
    Eigen::ArrayXd tractions;
    std::string status;
};

/// The tractions on one mesh. The leading element has none with Knothe and Gross-Thebing's boundary conditions.
Elements solve_once(const study::Scene& scene) {
    const rollbem::Response<double> solution = solve_steady(*scene.mesh, scene.scheme, scene.kernel);
    Elements found{Eigen::ArrayXd::Zero(scene.n()), study::steady_status(scene, solution.status, solution.c11())};
    found.tractions.head(solution.unknowns.rows()) = solution.unknowns.col(0);
    if (found.status != study::ok) found.tractions.setConstant(std::nan(""));
    return found;
}

/// The mesh whose elements have rows: the coarse one where there are two.
const rollbem::Mesh<double>& mesh_of(const study::Scene& scene) { return scene.coarse ? *scene.coarse : *scene.mesh; }

void by_elements(const study::Scene& scene, study::RowRange elements, const study::Results<Traction>& emit) {
    const rollbem::Mesh<double>& mesh = mesh_of(scene);
    const std::vector<study::Scene> meshes = scene.meshes();
    auto [traction, status] = solve_once(meshes.front());
    if (scene.coarse) {
        const Elements coarse = solve_once(meshes.back());
        traction = study::extrapolate_tractions(scene, traction, coarse.tractions);
        if (status == study::ok) status = coarse.status;
    }
    const double nu = scene.contact.poisson_ratio();
    const Eigen::ArrayXd means = rollbem::carter_mean_tractions(mesh, nu);
    for (Eigen::Index i = Eigen::Index(elements.first); i < Eigen::Index(elements.last); ++i) {
        const rollbem::EdgeDistances<double> centre{mesh.from_trailing()[i], mesh.from_leading()[i]};
        emit({mesh.centres()[i], traction[i], rollbem::carter_traction(centre, nu), status, means[i]});
    }
}

/// Emits the tractions by Chebyshev states, at the points x/a = cos((2k - 1) pi/(2n)), so that there is no mean.
void by_states(const study::Scene& scene, study::RowRange points, const study::Results<Traction>& emit) {
    const auto solution = solve_steady(*scene.chebyshev, scene.kernel);
    const rollbem::Chebyshev::Traction<double> traction_at{solution.unknowns.col(0)};
    const bool trusted = solution.status == rollbem::Status::ok;
    const Eigen::Index n = scene.n();
    for (Eigen::Index i = Eigen::Index(points.first); i < Eigen::Index(points.last); ++i) {
        const double half_angle = double(2 * (n - i) - 1) * std::numbers::pi / double(4 * n);
        const rollbem::EdgeDistances<double> point{2 * std::pow(std::cos(half_angle), 2),
                                                   2 * std::pow(std::sin(half_angle), 2)};
        emit({std::sin(double(2 * i + 1 - n) * std::numbers::pi / double(2 * n)),
              trusted ? traction_at(point) : std::nan(""),
              rollbem::carter_traction(point, scene.contact.poisson_ratio()), name(solution.status)});
    }
}

/// Carter's traction as far as its absolute value is at most `largest`.
study::Series carter_line(double nu, bool several, double largest) {
    study::Series line{several ? "Carter, ν = " + study::Cell(nu).text(6) : "Carter", study::Look::exact};
    constexpr int points = 400;
    for (int i = 1; i <= points; ++i) {  // dense near the trailing edge
        const double x = 2 * std::pow(double(i) / points, 3) - 1;
        const double traction = rollbem::carter_traction(x, nu);
        if (std::abs(traction) <= largest) line.points.emplace_back(x, traction);
    }
    return line;
}

/// Traction along the contact with Carter's line.
study::Picture draw_tractions(const std::vector<study::Scene>& scenes, const study::Records& rows) {
    study::Plot plot{.title = "Traction in steady rolling",
                     .x = {.label = "x / a (leading edge at 1)", .range = study::PlotRange{-1, 1}},
                     .y = {"p / (G ξ)"}};
    sheet.draw(plot, rows, {.x = "x_over_a", .y = "traction", .look = study::Look::markers});
    double largest = 0;
    for (const study::Series& series : plot.series) {
        for (const auto& point : series.points) largest = std::max(largest, std::abs(point.second));
    }
    std::set<double> poisson_ratios;
    for (const study::Scene& scene : scenes) poisson_ratios.insert(scene.contact.poisson_ratio());
    // on a fine mesh the singularity at the trailing edge exceeds all else by far
    const double shown = 2 * std::abs(rollbem::carter_traction(-0.98, *poisson_ratios.rbegin()));
    if (largest > shown) {
        plot.title += "; down to -" + study::Cell(largest).text(3) + " at the trailing edge";
        plot.y.range = study::PlotRange{-shown, 0};
    }
    for (const double nu : poisson_ratios) {
        plot.series.push_back(carter_line(nu, poisson_ratios.size() > 1, 1.2 * largest));
    }
    return {plot};
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("traction_study", "Traction of every element in steady rolling against Carter's solution.");
    options.refuse("lambda", study::no_lambda);
    study::offer_chebyshev(options);
    study::offer_schemes(options, methods);
    options.footer(R"(Example: 20 and 80 elements of a cosine mesh, with a plot of the traction along the contact
  traction_study --n 20,80 --mesh cosine --alpha 0.5 --output traction.csv --plot traction.svg

One row per element, or per state; with richardson: per element of n/2:
)" + sheet.help());

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        const auto scenes = study::make_scenes(given, study::Problem::steady, methods);
        for (const study::Scene& scene : scenes) {
            if (!scene.coarse || scene.mesh_name == "uniform" || scene.mesh_name == "cosine") continue;
            throw study::BadInput(
                "--scheme = " + scene.word() +
                " must be on a uniform or cosine mesh, of which pairs of elements make the coarse one");
        }
        study::Table table = sheet.table(
            scenes, [](const study::Scene& scene) { return scene.chebyshev ? scene.n() : mesh_of(scene).size(); },
            [](const study::Scene& scene, study::RowRange rows, const study::Results<Traction>& emit) {
                scene.chebyshev ? by_states(scene, rows, emit) : by_elements(scene, rows, emit);
            });
        table.plot = [&](const study::Records& rows) { return draw_tractions(scenes, rows); };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
