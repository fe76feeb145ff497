// The whole paper in one command: every figure of its sections 4 to 6 as CSV and SVG, every claim measured and judged,
// and a page that shows both. Takes about a minute on two cores:
//
//     ./reproduce_paper results && xdg-open results/index.html
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <set>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "build_info.hpp"
#include "paper/claims.hpp"
#include "support/options.hpp"
#include "support/output.hpp"
#include "support/plot.hpp"
#include "support/progress.hpp"

namespace {

struct Settings {
    std::string directory;
    study::Threads threads{"reproduce_paper", std::max(1u, std::thread::hardware_concurrency()), true};
};

paper::Results compute_figures(const Settings& settings) {
    paper::Results results{paper::panels()};
    std::vector<std::pair<const paper::Panel*, paper::Curve*>> curves;
    for (paper::Panel& panel : results.panels) {
        for (paper::Curve& curve : panel.curves) curves.emplace_back(&panel, &curve);
    }
    in_parallel(settings.threads, curves.size(), "curves",
                [&](std::size_t k) { paper::compute(*curves[k].first, *curves[k].second); });
    return results;
}

paper::Claims judge_claims(const Settings& settings, const paper::Results& results) {
    using paper::Claims, paper::Results;
    constexpr auto timed = paper::costs_of_galerkin;  // while nothing else runs
    Claims (*const chapters[])(const Results&) = {paper::equations,
                                                  paper::kernel_and_alpha,
                                                  paper::convergence,
                                                  paper::analytic_derivative_over_alpha,
                                                  paper::analytic_derivative_over_n,
                                                  paper::tractions_of_collocation,
                                                  paper::galerkin_claims,
                                                  timed,
                                                  paper::gradings,
                                                  paper::tractions_on_meshes,
                                                  paper::conclusions_on_steady_rolling,
                                                  paper::stability_of_collocation,
                                                  paper::stability_of_galerkin,
                                                  paper::split_points,
                                                  paper::claims_on_frequency};
    std::vector<Claims> judged(std::size(chapters));
    in_parallel(settings.threads, judged.size(), "claims", [&](std::size_t k) {
        if (chapters[k] != timed) judged[k] = chapters[k](results);
    });
    Claims all;
    for (std::size_t k = 0; k < judged.size(); ++k) {
        if (chapters[k] == timed) judged[k] = timed(results);
        all.insert(all.end(), judged[k].begin(), judged[k].end());
    }
    return all;
}

int run(const Settings& settings) {
    // 1. The folder, and two of the files, so that a folder that cannot be written to costs no computing time.
    study::OutputFiles files;
    files.make_folder(settings.directory, "DIR");
    const auto path_of = [&](const std::string& name) { return settings.directory + "/" + name; };
    study::OutputFile& claims_file = files.open(path_of("claims.csv"), "DIR");
    study::OutputFile& page_file = files.open(path_of("index.html"), "DIR");

    // 2. All curves of all panels, then the claims, which use the curves and compute what else they need.
    const paper::Results results = compute_figures(settings);
    const paper::Claims claims = judge_claims(settings, results);

    // 3. Each panel as CSV and SVG. Without gnuplot there is no SVG.
    std::set<std::string> drawn;
    std::string note;
    for (const paper::Panel& panel : results.panels) {
        const std::string name = "fig" + panel.figure;
        files.add(path_of(name + ".csv"), "DIR", paper::csv_of(panel));
        if (!note.empty()) continue;
        try {
            const std::string drawing = study::drawing_of(paper::picture(panel), path_of(name + ".svg"));
            files.add(path_of(name + ".svg"), "DIR", drawing);
            drawn.insert(panel.figure);
        } catch (const study::PlotError&) {
            note = "No plots: gnuplot is missing or failed. The data of every panel are there as CSV.";
            drawn.clear();
        }
    }
    if (!note.empty()) std::fprintf(stderr, "reproduce_paper: %s\n", note.c_str());

    // 4. The claims and the page.
    bool as_expected = true;
    for (const paper::Claim& claim : claims) {
        if (claim.as_expected()) continue;
        as_expected = false;
        std::fprintf(stderr, "reproduce_paper: Fig. %s: %s: %s; measured: %s\n", claim.figure.c_str(),
                     claim.claim.c_str(), paper::reason(claim).c_str(), claim.finding.measured.c_str());
    }
    claims_file.write(paper::csv_of(claims));
    page_file.write(paper::page(results, claims, drawn, note));

    // 5. The files take their names when all of them are on the disk. No drawing of an earlier run remains.
    files.commit();
    for (const paper::Panel& panel : results.panels) {
        std::error_code error;
        if (drawn.count(panel.figure) == 0) std::filesystem::remove(path_of("fig" + panel.figure + ".svg"), error);
    }
    study::OutputFile summary = study::OutputFile::standard_output();
    summary.write(paper::summary(claims) + ". See " + path_of("index.html") + "\n");
    summary.commit();
    return as_expected ? study::exit_ok : study::exit_failed;
}

}  // namespace

int main(int argc, char** argv) {
    Settings settings;
    bool quiet = false;
    CLI::App app(
        R"(Every figure and every claim of the paper: writes each panel as figNNx.csv and figNNx.svg, claims.csv
(claim, figure, paper, measured, holds, expected, reason, kind) and index.html, which shows everything.
The column paper quotes a few of its words. Each statement counts once; kind tells statements of the paper
from additions, results that the paper does not have.)",
        "reproduce_paper");
    app.set_help_flag("-h,--help", "print this help and exit");
    app.set_version_flag("--version", "reproduce_paper " + std::string(build_info::version) + " (" +
                                          std::string(build_info::git_revision) + ")");
    app.add_option("DIR", settings.directory, "folder to write to; created if it does not exist")->required();
    app.add_option("--jobs", settings.threads.jobs, "threads, 1 to 1024; default: the number of processors")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--quiet", quiet, "no progress line");
    app.footer(R"(
Example:
  reproduce_paper results

The paper does not give nu and b/a: 0.28 and 1000 are used. Every other choice is stated beside its figure.

Exit codes: 0 every claim holds or fails as expected (without gnuplot the plots are missing); 1 a claim does not;
2 bad input, or DIR cannot be written to; 4 error while writing; 130 interrupted.)");
    return study::run_guarded("reproduce_paper", [&] {
        try {
            app.parse(argc, argv);
            settings.threads.shows = !quiet;
        } catch (const CLI::Success& request) {  // --help, --version
            return app.exit(request);
        } catch (const CLI::ParseError& error) {
            throw study::BadInput(std::string(error.what()) + "; see --help");
        }
        return run(settings);
    });
}
