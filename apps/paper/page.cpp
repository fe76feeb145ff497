#include <algorithm>
#include <cctype>
#include <functional>
#include <initializer_list>
#include <map>
#include <string_view>
#include <utility>

#include "build_info.hpp"
#include "claims.hpp"

namespace paper {

namespace {

/// Each of the texts replaced by what stands beside it.
std::string replaced(std::string text, std::initializer_list<std::pair<std::string_view, std::string_view>> pairs) {
    for (const auto& [plain, marked] : pairs) {
        for (std::size_t i = text.find(plain); i != std::string::npos; i = text.find(plain, i + marked.size())) {
            text.replace(i, plain.size(), marked);
        }
    }
    return text;
}

/// The value of an attribute: Greek letters, no markup.
std::string attribute(const std::string& text) {
    return replaced(with_greek(text), {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}});
}

/// Plain text as HTML: Greek letters, alpha_L and c11 with subscripts.
std::string html(const std::string& text) {
    return replaced(attribute(text), {{"α_L", "α<sub>L</sub>"},
                                      {"α_T", "α<sub>T</sub>"},
                                      {"dx_T", "dx<sub>T</sub>"},
                                      {"dx_L", "dx<sub>L</sub>"},
                                      {"c11", "c<sub>11</sub>"},
                                      {"c_{11}", "c<sub>11</sub>"}});
}

/// The condition on the claims that are asked for.
using Filter = std::function<bool(const Claim&)>;
long count(const Claims& claims, const Filter& wanted) { return std::count_if(claims.begin(), claims.end(), wanted); }
bool holds(const Claim& claim) { return claim.finding.holds; }
bool is_statement(const Claim& claim) { return !claim.is_addition(); }
bool fails(const Claim& claim) { return is_statement(claim) && !holds(claim); }

std::string claim_table(const Claims& claims, const Filter& wanted) {
    std::string rows;
    for (const Claim& claim : claims) {
        if (!wanted(claim)) continue;
        const bool addition = claim.is_addition();
        const std::string verdict = holds(claim) ? "yes" : addition ? "no" : "not as printed";
        rows += say("<tr class=\"{}\"><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                    addition       ? "addition"
                    : holds(claim) ? "yes"
                                   : "no",
                    html(claim.figure), addition ? "(our addition)" : "“" + html(claim.quote) + "”", html(claim.claim),
                    html(claim.finding.measured), claim.as_expected() ? verdict : "<strong>" + verdict + "</strong>",
                    html(reason(claim)));
    }
    return rows.empty() ? ""
                        : "<table><thead><tr><th>figure</th><th>the paper's words</th><th>what is judged</th>"
                          "<th>measured</th><th>holds</th><th>remark</th></tr></thead><tbody>\n" +
                              rows + "</tbody></table>\n";
}

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>Figures and claims of Giménez, Alonso and Baeza (2018), reproduced</title>
<style>
body { font: 16px/1.45 system-ui, sans-serif; max-width: 1200px; margin: 2em auto;
       padding: 0 1em; color: #111; background: #fff; }
h2 { margin-top: 2.5em; border-bottom: 1px solid #bbb; }
figure { margin: 1.5em 0; }
img { width: 100%; height: auto; max-width: 900px; display: block; }
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
           "to 1 by 0.1, size ratios in powers of 2; an optimum that is not the best of its grid counts if the true "
           "one, which is given as well, is nearer than 0.02. Stability is judged by the sign of the real parts as "
           "computed. Axes and ranges are chosen here to show what the text says. Elements are counted from the "
           "trailing edge x = -a to the leading edge x = a.</p>\n"
           "<p>A statement that the paper makes more than once counts once. Additions are "
           "results that the paper does not have; they are not counted among its statements.</p>\n";
}

/// "3 hold, 1 does not"
std::string counts(const Claims& claims, const Filter& wanted) {
    const long statements = count(claims, [&](const Claim& claim) { return wanted(claim) && is_statement(claim); });
    const long failing = count(claims, [&](const Claim& claim) { return wanted(claim) && fails(claim); });
    if (statements == 0) return "";
    return say("{}{}", statements - failing, statements - failing == 1 ? " holds" : " hold") +
           (failing == 0 ? "" : say(", {}{}", failing, failing == 1 ? " does not" : " do not"));
}

/// The page under its heading, and the list of its contents.
struct Body {
    std::string contents, sections;

    void add(const std::string& id, const std::string& title, const std::string& note, const std::string& body) {
        contents += say("<li><a href=\"#{}\">{}</a>{}</li>\n", id, title, note.empty() ? "" : " (" + note + ")");
        sections += say("<h2 id=\"{}\">{}</h2>\n", id, title) + body;
    }
};

}  // namespace

std::string reason(const Claim& claim) {
    if (claim.as_expected()) return claim.remark;
    return holds(claim) ? "expected not to hold" : "expected to hold";
}

std::string summary(const Claims& claims) {
    const long statements = count(claims, is_statement), failing = count(claims, fails);
    const long additions = std::ssize(claims) - statements;
    const long holding = count(claims, [](const Claim& claim) { return claim.is_addition() && holds(claim); });
    return say(
        "{} statements of the paper: {} hold, {} do not hold as printed; {} additions: {} hold; {} differ from "
        "what is expected",
        statements, statements - failing, failing, additions, holding == additions ? "all" : std::to_string(holding),
        count(claims, [](const Claim& claim) { return !claim.as_expected(); }));
}

std::string csv_of(const Claims& claims) {
    const auto word = [](bool yes) { return yes ? "yes" : "no"; };
    std::string text = "claim,figure,paper,measured,holds,expected,reason,kind\n";
    for (const Claim& claim : claims) {
        text += study::csv_line({claim.claim, claim.figure, claim.quote, claim.finding.measured, word(holds(claim)),
                                 word(claim.expected), reason(claim), claim.is_addition() ? "addition" : "statement"});
    }
    return text;
}

std::string page(const Results& results, const Claims& claims, const std::set<std::string>& drawn,
                 const std::string& note) {
    const auto add = [&](Body& body, const std::string& id, const std::string& title, const Filter& wanted) {
        body.add(id, title, std::to_string(count(claims, wanted)), claim_table(claims, wanted));
    };
    // the parts are statements that do not hold, additions, each figure with its claims, and the rest
    Body body;
    add(body, "not-as-printed", "Statements that do not hold as printed", fails);
    add(body, "additions", "Our additions", std::mem_fn(&Claim::is_addition));
    std::map<int, std::string> panels, titles;
    for (const Panel& panel : results.panels) {
        const int number = std::stoi(panel.figure);
        titles.try_emplace(number, say("Fig. {}: ", number) + html(panel.title));
        panels[number] += "<figure id=\"panel" + panel.figure + "\">\n";
        if (drawn.count(panel.figure) > 0) {
            panels[number] += say("<img src=\"fig{}.svg\" alt=\"{}\">\n", panel.figure, attribute(panel.title));
        }
        panels[number] +=
            say("<figcaption>{}. Chosen: {}. Data: <a href=\"fig{}.csv\">fig{}.csv</a></figcaption></figure>\n",
                html(panel.title), html(panel.choice), panel.figure, panel.figure);
    }
    const auto number_of = [](const Claim& claim) {  // of its figure; 0 for equations and sections
        return std::isdigit(static_cast<unsigned char>(claim.figure.front())) ? std::stoi(claim.figure) : 0;
    };
    for (const auto& [number, figures] : panels) {
        const Filter of_figure = [&, own = number](const Claim& claim) { return number_of(claim) == own; };
        body.add(say("fig{}", number), titles[number], counts(claims, of_figure),
                 figures + claim_table(claims, of_figure));
    }
    const Filter general = [&](const Claim& claim) { return number_of(claim) == 0; };
    body.add("general", "Equations and conclusions", counts(claims, general), claim_table(claims, general));

    return std::string(head) + "<h1>Figures and claims of Giménez, Alonso and Baeza (2018), reproduced</h1>\n" +
           (note.empty() ? "" : "<p class=\"note\">" + html(note) + "</p>\n") + "<p>" + summary(claims) +
           ". All as a table: <a href=\"claims.csv\">claims.csv</a>.</p>\n<nav><h2>Contents</h2>\n<ul>\n" +
           body.contents + "</ul></nav>\n" + conditions() + body.sections + "<footer><p>reproduce_paper " +
           std::string(build_info::version) + " (" + std::string(build_info::git_revision) + "), " +
           std::string(build_info::compiler) +
           ". J.G. Giménez, A. Alonso, L. Baeza, Vehicle System Dynamics 57(12) (2019) 1822-1846, "
           "doi:10.1080/00423114.2018.1552365.</p></footer>\n</body></html>\n";
}

}  // namespace paper
