// The results of reproduce_paper for a reader: claims.csv as rows, and index.html, one file that shows everything.
#pragma once

#include <cctype>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "build_info.hpp"
#include "claims.hpp"
#include "results.hpp"
#include "support/csv.hpp"

namespace paper {

struct Judged {
    Claim claim;
    Finding finding;

    bool as_expected() const { return finding.holds == claim.expected; }
    std::string reason() const {
        if (as_expected()) return claim.reason;
        return finding.holds ? "expected not to hold" : "expected to hold";
    }
};

inline const study::Row claim_columns{"claim", "figure", "paper", "measured", "holds", "expected", "reason"};

inline study::Row claim_row(const Judged& judged) {
    const auto word = [](bool yes) { return yes ? "yes" : "no"; };
    return {judged.claim.claim,         judged.claim.figure,         judged.claim.paper, judged.finding.measured,
            word(judged.finding.holds), word(judged.claim.expected), judged.reason()};
}

namespace detail {

inline std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            default: result += c;
        }
    }
    return result;
}

/// Plain text as HTML: Greek letters, alpha_L and c11 with subscripts.
inline std::string html(const std::string& text) {
    std::string result = escaped(with_greek(text));
    for (const auto& [plain, marked] : {std::pair{"α_L", "α<sub>L</sub>"},
                                        {"α_T", "α<sub>T</sub>"},
                                        {"dx_T", "dx<sub>T</sub>"},
                                        {"dx_L", "dx<sub>L</sub>"},
                                        {"c11", "c<sub>11</sub>"},
                                        {"c_{11}", "c<sub>11</sub>"}}) {
        for (std::size_t i = result.find(plain); i != std::string::npos; i = result.find(plain, i)) {
            result.replace(i, std::string(plain).size(), marked);
        }
    }
    return result;
}

/// gnuplot's SVG as part of a page: without prologue, and with identifiers of its own.
inline std::string inlined(std::string svg, const std::string& figure) {
    svg.erase(0, std::min(svg.find("<svg"), svg.size()));
    for (const std::string mark : {"gnuplot_", "gpDot", "gpPt", "textbox", "greybox", "white"}) {
        for (const std::string before : {"id=\"", "id='", "#"}) {
            const std::string from = before + mark, to = before + "fig" + figure + mark;
            for (std::size_t i = svg.find(from); i != std::string::npos; i = svg.find(from, i + to.size())) {
                svg.replace(i, from.size(), to);
            }
        }
    }
    return svg;
}

/// Number of the figure that a claim is about; 0 for equations and sections.
inline int figure_number(const std::string& figure) {
    return std::isdigit(static_cast<unsigned char>(figure.front())) ? std::stoi(figure) : 0;
}

inline std::string claim_table(const std::vector<const Judged*>& rows) {
    std::string text =
        "<table><thead><tr><th>figure</th><th>the paper says</th><th>its value</th><th>measured</th><th>holds</th>"
        "<th>remark</th></tr></thead><tbody>\n";
    for (const Judged* judged : rows) {
        const std::string verdict = std::string(judged->finding.holds ? "yes" : "no") +
                                    (judged->as_expected() ? "" : ", <strong>not as expected</strong>");
        text += std::string("<tr class=\"") + (judged->finding.holds ? "yes" : "no") + "\"><td>" +
                html(judged->claim.figure) + "</td><td>" + html(judged->claim.claim) + "</td><td>" +
                html(judged->claim.paper) + "</td><td>" + html(judged->finding.measured) + "</td><td>" + verdict +
                "</td><td>" + html(judged->reason()) + "</td></tr>\n";
    }
    return text + "</tbody></table>\n";
}

inline const char* page_head() {
    return R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Figures and claims of Giménez, Alonso and Baeza (2018), reproduced</title>
<style>
body { font: 16px/1.45 system-ui, sans-serif; max-width: 1200px; margin: 2em auto;
       padding: 0 1em; color: #111; background: #fff; }
h2 { margin-top: 2.5em; border-bottom: 1px solid #bbb; }
figure { margin: 1.5em 0; }
svg { width: 100%; height: auto; max-width: 900px; display: block; }
figcaption, footer { color: #444; font-size: 0.9em; }
table { border-collapse: collapse; width: 100%; font-size: 0.88em; }
th, td { text-align: left; vertical-align: top; padding: 0.3em 0.5em; border-bottom: 1px solid #ddd; }
tr.no { background: #fdeee2; }
tr.no td:nth-child(5) { font-weight: bold; }
.note { background: #fff4c4; padding: 0.6em 1em; }
</style></head><body>
)";
}

}  // namespace detail

/// `drawings` holds the SVG of each panel that was drawn; `note` is shown at the top if there is one.
inline std::string page(const Results& results, const std::vector<Judged>& claims,
                        const std::map<std::string, std::string>& drawings, const std::string& note) {
    std::size_t holding = 0, unexpected = 0;
    std::vector<const Judged*> all, general;
    std::map<int, std::vector<const Judged*>> of_figure;
    for (const Judged& judged : claims) {
        holding += judged.finding.holds;
        unexpected += !judged.as_expected();
        all.push_back(&judged);
        const int number = detail::figure_number(judged.claim.figure);
        (number > 0 ? of_figure[number] : general).push_back(&judged);
    }
    std::string text = detail::page_head();
    text += "<h1>Figures and claims of Giménez, Alonso and Baeza (2018), reproduced</h1>\n";
    if (!note.empty()) text += "<p class=\"note\">" + detail::html(note) + "</p>\n";
    text += "<p>" + std::to_string(claims.size()) + " claims of sections 5 to 7: " + std::to_string(holding) +
            " hold, " + std::to_string(claims.size() - holding) + " do not hold as printed; " +
            std::to_string(unexpected) +
            " differ from what is expected. The same as a table: <a href=\"claims.csv\">claims.csv</a>.</p>\n";
    text +=
        "<p>Conditions everywhere, since the paper is silent: Poisson's ratio ν = " + number(poisson_ratio) +
        ", b/a = " + number(aspect, 4) +
        ", strip kernel, rectangle 2a × 2b. c<sub>11</sub> = π/(2(1-ν)). The ratio of steady c<sub>11</sub> does not "
        "depend on ν, and on b/a only by (a/b)². Finite differences are central over the element's own width about "
        "the collocation point; with the analytic derivative, points nearer than 0.001 of an element to an edge are "
        "moved to that distance. Optima are judged on a grid: α from 0 to 1 by 0.05 and 0.63, ε from 0.1 to 1 by 0.1, "
        "size ratios in powers of 2; the true optimum stands beside. Stability is judged by the sign of the real "
        "parts as computed. Axes and ranges are chosen here to show what the text says. Elements are counted from "
        "the trailing edge x = -a to the leading edge x = a.</p>\n";
    text += "<h2>All claims</h2>\n" + detail::claim_table(all);

    int current = 0;
    const auto end_figure = [&] {
        if (current > 0 && of_figure.count(current) > 0) text += detail::claim_table(of_figure[current]);
    };
    for (const PanelResult& result : results.panels()) {
        const Panel& panel = result.panel;
        if (const int number = std::stoi(panel.figure); number != current) {
            end_figure();
            current = number;
            text += "<h2>Fig. " + std::to_string(number) + "</h2>\n";
        }
        const auto drawing = drawings.find(panel.figure);
        text += "<figure id=\"panel" + panel.figure + "\">\n";
        if (drawing != drawings.end()) text += detail::inlined(drawing->second, panel.figure);
        text += "<figcaption>" + detail::html(panel.title) + ". Chosen: " + detail::html(panel.choice) +
                ". Data: <a href=\"fig" + panel.figure + ".csv\">fig" + panel.figure +
                ".csv</a></figcaption></figure>\n";
    }
    end_figure();
    text += "<h2>Equations and conclusions</h2>\n" + detail::claim_table(general);
    text += "<footer><p>reproduce_paper " + std::string(build_info::version) + " (" +
            std::string(build_info::git_revision) + "), " + std::string(build_info::compiler) +
            ". J.G. Giménez, A. Alonso, L. Baeza, Vehicle System Dynamics 57(12) (2019) 1822-1846, "
            "doi:10.1080/00423114.2018.1552365.</p></footer>\n</body></html>\n";
    return text;
}

}  // namespace paper
