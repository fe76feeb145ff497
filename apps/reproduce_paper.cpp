// The whole paper in one command: every figure of its sections 4 to 6 as CSV and SVG, every claim measured and judged,
// and a page that shows both. Takes about a minute on two cores:
//
//     ./reproduce_paper results && xdg-open results/index.html
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <gsl/gsl_errno.h>

#include "build_info.hpp"
#include "paper/claims.hpp"
#include "paper/figures.hpp"
#include "paper/page.hpp"
#include "paper/results.hpp"
#include "support/csv.hpp"
#include "support/errors.hpp"
#include "support/parallel.hpp"
#include "support/plot.hpp"
#include "support/progress.hpp"

namespace {

struct Settings {
    std::string directory;
    std::size_t jobs = std::max(1u, std::thread::hardware_concurrency());
    bool quiet = false;
};

/// compute(k) for all k < count on several threads, with a progress line.
void in_parallel(const std::string& what, std::size_t count, const Settings& settings,
                 const std::function<void(std::size_t)>& compute) {
    study::Progress progress("reproduce_paper", count, !settings.quiet, what);
    std::size_t done = 0;
    progress.update(0);
    study::parallel_for(count, settings.jobs, compute, [&] { progress.update(++done); });
}

paper::Results compute_figures(const Settings& settings) {
    paper::Results results(paper::panels());
    std::vector<std::pair<paper::PanelResult*, std::size_t>> curves;
    for (paper::PanelResult& result : results.panels()) {
        for (std::size_t k = 0; k < result.curves.size(); ++k) curves.emplace_back(&result, k);
    }
    in_parallel("curves", curves.size(), settings, [&](std::size_t task) {
        const auto& [result, k] = curves[task];
        result->curves[k] = paper::compute(result->panel, result->panel.curves[k]);
    });
    return results;
}

std::vector<paper::Judged> judge_claims(const Settings& settings, const paper::Results& results) {
    std::vector<paper::Judged> judged;
    for (paper::Claim& claim : paper::claims()) judged.push_back({std::move(claim), {}});
    in_parallel("claims", judged.size(), settings, [&](std::size_t k) {
        if (!judged[k].claim.timed) judged[k].finding = judged[k].claim.judge(results);
    });
    for (paper::Judged& each : judged) {
        if (each.claim.timed) each.finding = each.claim.judge(results);
    }
    return judged;
}

void write(study::OutputFile&& file, const std::string& text) {
    file.write(text);
    file.commit();
}

std::string contents(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

int run(const Settings& settings) {
    // 1. The folder, and the files that are written last: what cannot be written costs no computing time.
    namespace fs = std::filesystem;
    const fs::path directory(settings.directory);
    std::error_code error;
    fs::create_directories(directory, error);
    if (!fs::is_directory(directory)) {
        throw study::BadInput("DIR = " + settings.directory + " must be a folder that can be written" +
                              (error ? ": " + error.message() : ""));
    }
    const auto file = [&](const std::string& name) { return study::OutputFile((directory / name).string(), "DIR"); };
    study::OutputFile claims_file = file("claims.csv"), page_file = file("index.html");

    // 2. All curves of all panels, then the claims, which look at the curves and compute what else they need.
    const paper::Results results = compute_figures(settings);
    const std::vector<paper::Judged> claims = judge_claims(settings, results);

    // 3. Each panel as CSV and SVG. Without gnuplot there is no SVG, and none of an earlier run may stay.
    std::map<std::string, std::string> drawings;
    std::string note;
    for (const paper::PanelResult& result : results.panels()) {
        const std::string name = "fig" + result.panel.figure;
        const std::vector<std::string> columns = paper::columns(result.panel.quantity);
        std::string rows = study::csv_line({columns.begin(), columns.end()});
        for (const paper::CurveResult& curve : result.curves) {
            for (const study::Row& row : curve.rows) rows += study::csv_line(row);
        }
        write(file(name + ".csv"), rows);
        try {
            if (note.empty()) {
                study::OutputFile drawing = file(name + ".svg");
                study::draw(paper::plot(result), drawing, false);
                drawings[result.panel.figure] = contents(directory / (name + ".svg"));
            }
        } catch (const study::PlotError&) {
            note = "No plots: gnuplot is missing or failed. The data of every panel are there as CSV.";
        }
        if (!note.empty()) fs::remove(directory / (name + ".svg"), error);
    }
    if (!note.empty()) std::fprintf(stderr, "reproduce_paper: %s\n", note.c_str());

    // 4. The claims and the page.
    std::string rows = study::csv_line(paper::claim_columns);
    for (const paper::Judged& judged : claims) {
        rows += study::csv_line(paper::claim_row(judged));
        if (judged.as_expected()) continue;
        std::fprintf(stderr, "reproduce_paper: Fig. %s: %s: %s; measured: %s\n", judged.claim.figure.c_str(),
                     judged.claim.claim.c_str(), judged.reason().c_str(), judged.finding.measured.c_str());
    }
    write(std::move(claims_file), rows);
    write(std::move(page_file), paper::page(results, claims, drawings, note));
    const paper::Tallies counted = paper::tallies(claims);
    std::printf("%s; %zu differ from what is expected. See %s\n", paper::summary(counted).c_str(), counted.unexpected,
                (directory / "index.html").c_str());
    return counted.unexpected == 0 ? study::exit_ok : study::exit_failed;
}

int fail(const char* message, study::ExitCode code) {
    std::fprintf(stderr, "reproduce_paper: %s\n", message);
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    gsl_set_error_handler_off();  // the default handler aborts the program
    study::handle_signals();
    Settings settings;
    CLI::App app(
        "Every figure and every claim of the paper: writes each panel as figNNx.csv and figNNx.svg, claims.csv\n"
        "(claim, figure, paper, measured, holds, expected, reason, kind) and index.html, which shows everything.\n"
        "The column paper quotes a few of its words. Each statement counts once; kind tells a statement of the paper\n"
        "from an addition, which is what was found beside it.",
        "reproduce_paper");
    app.set_help_flag("-h,--help", "print this help and exit");
    app.set_version_flag("--version", "reproduce_paper " + std::string(build_info::version) + " (" +
                                          std::string(build_info::git_revision) + ")");
    app.add_option("DIR", settings.directory, "folder to write to; made if it is not there")->required();
    app.add_option("--jobs", settings.jobs, "threads, 1 to 1024; default: as many as the machine has")
        ->check(CLI::Range(1, 1024));
    app.add_flag("--quiet", settings.quiet, "no progress line");
    app.footer(
        "\nExample:\n  reproduce_paper results\n"
        "\nThe paper is silent on nu and b/a: 0.28 and 1000 are used, and every other choice stands beside its "
        "figure.\n"
        "\nExit codes: 0 every claim holds or fails as expected (without gnuplot the plots are missing); 1 a claim\n"
        "differs from what is expected; 2 bad input or DIR cannot be written; 4 error while writing; 130 interrupted.");
    try {
        app.parse(argc, argv);
        return run(settings);
    } catch (const CLI::Success& request) {  // --help, --version
        return app.exit(request);
    } catch (const CLI::ParseError& parse_error) {
        return fail((std::string(parse_error.what()) + "; see --help").c_str(), study::exit_bad_input);
    } catch (const study::WriteError& write_error) {
        return fail(write_error.what(), study::exit_write_error);
    } catch (const study::BadInput& bad_input) {
        return fail(bad_input.what(), study::exit_bad_input);
    } catch (const std::exception& other) {
        return fail(other.what(), study::exit_failed);
    }
}
