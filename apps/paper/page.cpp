#include "page.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "build_info.hpp"

namespace paper {

namespace {

std::string escaped(const std::string& text) {
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
std::string html(const std::string& text) {
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
std::string inlined(std::string svg, const std::string& figure) {
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
int figure_number(const std::string& figure) {
    return std::isdigit(static_cast<unsigned char>(figure.front())) ? std::stoi(figure) : 0;
}

using Rows = std::vector<const Judged*>;

std::string verdict(const Judged& judged) {
    std::string text = judged.finding.holds ? "yes" : judged.claim.is_addition() ? "no" : "not as printed";
    return judged.as_expected() ? text : "<strong>" + text + "</strong>";
}

std::string claim_table(const Rows& rows) {
    if (rows.empty()) return "";
    std::string text =
        "<table><thead><tr><th>figure</th><th>the paper's words</th><th>what is judged</th><th>measured</th>"
        "<th>holds</th><th>remark</th></tr></thead><tbody>\n";
    for (const Judged* judged : rows) {
        const Claim& claim = judged->claim;
        const char* const kind = claim.is_addition() ? "addition" : judged->finding.holds ? "yes" : "no";
        std::string quote = claim.is_addition() ? "(our addition)" : "“";
        if (!claim.is_addition()) quote.append(html(claim.quote)).append("”");
        text += "<tr class=\"" + std::string(kind) + "\"><td>" + html(claim.figure) + "</td><td>" + quote +
                "</td><td>" + html(claim.claim) + "</td><td>" + html(judged->finding.measured) + "</td><td>" +
                verdict(*judged) + "</td><td>" + html(judged->reason()) + "</td></tr>\n";
    }
    return text + "</tbody></table>\n";
}

constexpr std::string_view head = R"(<!DOCTYPE html>
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
tr.addition { background: #eef3fa; }
nav ul { columns: 22em; padding-left: 1.2em; }
.note { background: #fff4c4; padding: 0.6em 1em; }
</style></head><body>
)";

std::string conditions() {
    return "<p>Conditions everywhere, as the paper does not give them: Poisson's ratio ν = " + number(poisson_ratio) +
           ", b/a = " + number(aspect, 4) +
           ", strip kernel, rectangle 2a × 2b. c<sub>11</sub> = π/(2(1-ν)). The ratio of steady c<sub>11</sub> does "
           "not depend on ν, and on b/a only by (a/b)². Finite differences are central over the element's own width "
           "about the collocation point; with the analytic derivative, points nearer than 0.001 of an element to an "
           "edge are moved to that distance. Optima are judged on a grid: α from 0 to 1 by 0.05 and 0.63, ε from 0.1 "
           "to 1 by 0.1, size ratios in powers of 2; the true optimum is given as well, and errors that differ by less "
           "than 0.01 % of c<sub>11</sub> count as equal. Stability is judged by the sign of the real parts as "
           "computed. Axes and ranges are chosen here to show what the text says. Elements are counted from the "
           "trailing edge x = -a to the leading edge x = a.</p>\n"
           "<p>A statement that the paper makes more than once counts once. Additions are "
           "results that the paper does not have; they are not counted among its statements.</p>\n";
}

/// A section with a link to it in the contents.
struct Section {
    std::string id, title, note, body;
};

/// "3 hold, 1 does not"
std::string counts(const Rows& rows) {
    std::size_t holding = 0, statements = 0;
    for (const Judged* judged : rows) {
        statements += !judged->claim.is_addition();
        holding += !judged->claim.is_addition() && judged->finding.holds;
    }
    const std::size_t failing = statements - holding;
    if (statements == 0) return "";
    return std::to_string(holding) + (holding == 1 ? " holds" : " hold") +
           (failing == 0 ? "" : ", " + std::to_string(failing) + (failing == 1 ? " does not" : " do not"));
}

std::string panel_figure(const Panel& panel, const std::map<std::string, std::string>& drawings) {
    std::string text = "<figure id=\"panel" + panel.figure + "\">\n";
    const auto drawing = drawings.find(panel.figure);
    if (drawing != drawings.end()) text += inlined(drawing->second, panel.figure);
    return text + "<figcaption>" + html(panel.title) + ". Chosen: " + html(panel.choice) + ". Data: <a href=\"fig" +
           panel.figure + ".csv\">fig" + panel.figure + ".csv</a></figcaption></figure>\n";
}

}  // namespace

std::string Judged::reason() const {
    if (as_expected()) return claim.remark;
    return finding.holds ? "expected not to hold" : "expected to hold";
}

Tallies tallies(const std::vector<Judged>& claims) {
    Tallies result;
    for (const Judged& judged : claims) {
        const bool addition = judged.claim.is_addition();
        ++(addition ? result.additions : result.statements);
        if (judged.finding.holds) ++(addition ? result.additions_holding : result.holding);
        if (!judged.as_expected()) ++result.unexpected;
    }
    return result;
}

std::string summary(const Tallies& counted) {
    return std::to_string(counted.statements) + " statements of the paper: " + std::to_string(counted.holding) +
           " hold, " + std::to_string(counted.statements - counted.holding) + " do not hold as printed; " +
           std::to_string(counted.additions) + " additions: " +
           (counted.additions_holding == counted.additions ? "all" : std::to_string(counted.additions_holding)) +
           " hold";
}

study::Row claim_row(const Judged& judged) {
    const auto word = [](bool yes) { return yes ? "yes" : "no"; };
    return {judged.claim.claim,
            judged.claim.figure,
            judged.claim.quote,
            judged.finding.measured,
            word(judged.finding.holds),
            word(judged.claim.expected),
            judged.reason(),
            judged.claim.is_addition() ? "addition" : "statement"};
}

std::string page(const Results& results, const std::vector<Judged>& claims,
                 const std::map<std::string, std::string>& drawings, const std::string& note) {
    // 1. The claims by subject.
    Rows failing, additions, general;
    std::map<int, Rows> of_figure;
    for (const Judged& judged : claims) {
        if (judged.claim.is_addition()) {
            additions.push_back(&judged);
        } else if (!judged.finding.holds) {
            failing.push_back(&judged);
        }
        const int number = figure_number(judged.claim.figure);
        (number > 0 ? of_figure[number] : general).push_back(&judged);
    }

    // 2. The sections: what does not hold, additions, each figure with its claims, the rest.
    std::vector<Section> sections;
    sections.push_back({"not-as-printed", "Statements that do not hold as printed", std::to_string(failing.size()),
                        claim_table(failing)});
    sections.push_back({"additions", "Our additions", std::to_string(additions.size()), claim_table(additions)});
    const std::size_t first_figure = sections.size();
    for (const PanelResult& result : results.panels()) {
        const int number = std::stoi(result.panel.figure);
        const std::string id = "fig" + std::to_string(number);
        if (sections.back().id != id) {
            sections.push_back({id, "Fig. " + std::to_string(number) + ": " + html(result.panel.title),
                                counts(of_figure[number]), ""});
        }
        sections.back().body += panel_figure(result.panel, drawings);
    }
    for (std::size_t i = first_figure; i < sections.size(); ++i) {
        sections[i].body += claim_table(of_figure[std::stoi(sections[i].id.substr(3))]);
    }
    sections.push_back({"general", "Equations and conclusions", counts(general), claim_table(general)});

    // 3. The page.
    const Tallies counted = tallies(claims);
    std::string text(head);
    text += "<h1>Figures and claims of Giménez, Alonso and Baeza (2018), reproduced</h1>\n";
    if (!note.empty()) text += "<p class=\"note\">" + html(note) + "</p>\n";
    text += "<p>" + summary(counted) + "; " + std::to_string(counted.unexpected) +
            " differ from what is expected. All as a table: <a href=\"claims.csv\">claims.csv</a>.</p>\n";
    text += "<nav><h2>Contents</h2>\n<ul>\n";
    for (const Section& section : sections) {
        text += "<li><a href=\"#" + section.id + "\">" + section.title + "</a>" +
                (section.note.empty() ? "" : " (" + section.note + ")") + "</li>\n";
    }
    text += "</ul></nav>\n" + conditions();
    for (const Section& section : sections) {
        text += "<h2 id=\"" + section.id + "\">" + section.title + "</h2>\n" + section.body;
    }
    text += "<footer><p>reproduce_paper " + std::string(build_info::version) + " (" +
            std::string(build_info::git_revision) + "), " + std::string(build_info::compiler) +
            ". J.G. Giménez, A. Alonso, L. Baeza, Vehicle System Dynamics 57(12) (2019) 1822-1846, "
            "doi:10.1080/00423114.2018.1552365.</p></footer>\n</body></html>\n";
    return text;
}

}  // namespace paper
