// A study to copy: the centre of the tractions in steady rolling, over the number of elements.
//
//     ./examples/own_study --n 20,40,80
#include <cmath>
#include <string>

#include <Eigen/Core>

#include <rollbem/steady/steady.hpp>

#include "support/sheet.hpp"

namespace {

/// The result of one case.
struct Centre {
    double x;  ///< not a number where there is none
    std::string status;
};

// the columns: of the case, of the result with their meanings for --help, and of the case again
const study::Sheet<Centre> sheet{"mesh, n, alpha_L, alpha_T",
                                 {{"centre", "centre of the tractions x/a, negative behind the middle", &Centre::x},
                                  {"status", "ok, or why centre is empty: " + study::steady_flaws, &Centre::status}},
                                 "method, derivative, " + study::settings};

Centre solve(const study::Scene& scene) {
    const rollbem::Response<double> rolling = solve_steady(*scene.mesh, scene.scheme, scene.kernel);
    const std::string status = study::steady_status(scene, rolling.status, rolling.c11());
    if (status != study::ok) return {std::nan(""), status};
    const Eigen::Index count = rolling.unknowns.rows();  // with knothe-bc the leading element has no traction
    const Eigen::ArrayXd forces = rolling.unknowns.col(0).array() * scene.mesh->widths().head(count);
    return {(scene.mesh->centres().head(count) * forces).sum() / forces.sum(), status};
}

}  // namespace

int main(int argc, char** argv) {
    constexpr study::Methods methods{.not_extrapolated = "the centre of few elements is not extrapolated"};
    study::Options options("own_study", "Centre of the tractions in steady rolling.");
    options.refuse("lambda", study::no_lambda);
    study::offer_schemes(options, methods);
    options.footer(
        "Example:\n  own_study --n 20,40,80 --output centre.csv --plot centre.svg\n\nOne row for each case:\n" +
        sheet.help());
    return study::run_program(options, argc, argv, [&](const study::Options& given) {
        const auto scenes = study::make_scenes(given, study::Problem::steady, methods);
        study::Table table = sheet.table(scenes, solve);
        table.plot = [&](const study::Records& rows) {
            study::Plot plot{.title = "Centre of the tractions", .x = {"n", true}, .y = {"x / a"}};
            sheet.draw(plot, rows, {.x = "n", .y = "centre"});
            return study::Picture{plot};
        };
        study::write_table(given, table);
        return study::exit_ok;
    });
}
