// The panels of the paper's figures, section by section.
#include "figures.hpp"

namespace paper {

namespace {

using enum Vary;
constexpr Method galerkin_7 = Method::galerkin_7;

// The schemes of several figures.
constexpr Case equal{.alpha_L = 0.5, .alpha_T = 0.5};
constexpr Case recommended{.alpha_L = 0, .alpha_T = 0.63};
constexpr Case ahead{.alpha_L = 1, .alpha_T = 1};
constexpr Case ahead_analytic{.derivative = analytic, .alpha_L = 1, .alpha_T = 1};

/// The three ways of varying alpha that most panels compare.
std::vector<Curve> three_ways(const Case& scheme) {
    Case trailing = scheme, leading = scheme;
    trailing.alpha_L = 0;
    leading.alpha_T = 0;
    return {{"alpha_L = alpha_T = alpha", scheme, both_alphas},
            {"alpha_L = 0, alpha_T = alpha", trailing, alpha_T},
            {"alpha_T = 0, alpha_L = alpha", leading, alpha_L}};
}

/// One curve for each number of elements.
std::vector<Curve> densities(const std::vector<Eigen::Index>& numbers, Case scheme, Vary vary) {
    std::vector<Curve> curves;
    for (const Eigen::Index n : numbers) {
        scheme.n = n;
        curves.push_back({"n = " + std::to_string(n), scheme, vary});
    }
    return curves;
}

// Panels of one kind: the arguments say what differs.

Panel ratio_over_alpha(const std::string& figure, const std::string& title, std::vector<Curve> curves, Axes axes) {
    return {figure,
            title,
            Quantity::c11_ratio,
            fractions(0, 200, 200),  // contains the multiples of 0.05, and 0.63
            std::move(curves),
            "alpha",
            "alpha by 0.005; the data say where tractions assist the creepage, as near alpha = 0",
            axes};
}

Panel ratio_over_n(const std::string& figure, const std::string& title, std::vector<Curve> curves) {
    const std::vector<double> numbers{10, 15, 20, 25, 30, 35, 40, 50, 60, 70, 80, 100, 120, 140, 160};
    return {figure,
            title,
            Quantity::c11_ratio,
            numbers,
            std::move(curves),
            "number of elements n",
            "n from 10 to 160",
            {.markers = true}};
}

Panel ratio_over_grading(const std::string& figure, const std::string& title, const Case& scheme,
                         const std::string& remark = "") {
    const bool geometric = scheme.mesh == Topology::geometric;
    return {figure,
            title,
            Quantity::c11_ratio,
            geometric ? std::vector<double>{0.125, 0.25, 0.5, 1, 2, 4, 8} : fractions(1, 10, 10),
            densities(fine, scheme, grading),
            geometric ? "dx_T / dx_L" : "epsilon",
            "n: the paper's 40, 60, 80 of the other figures" + remark,
            {.log_base = geometric ? 2 : 0, .markers = true}};
}

Panel tractions_of(const std::string& figure, const std::string& title, std::vector<Curve> curves,
                   const std::string& choice, Axes axes) {
    return {figure, title, Quantity::traction, {}, std::move(curves), "x / a (leading edge at 1)", choice, axes};
}

Panel unstable_over_alpha(const std::string& figure, const std::string& title, const Case& scheme, Vary vary) {
    const std::string alpha = vary == alpha_T ? "alpha_T" : "alpha";
    return {figure,
            title,
            Quantity::unstable_fraction,
            fractions(1, 200, 200),
            densities(coarse, scheme, vary),
            alpha,
            alpha + " from 0.005 by 0.005"};
}

Panel unstable_over_lambda(const std::string& figure, const std::string& scheme_text, const Case& scheme) {
    return {figure,
            "G' at alpha, G at lambda alpha; " + scheme_text,
            Quantity::unstable_fraction,
            fractions(0, 100, 100),
            densities(coarse, scheme, lambda),
            "lambda",
            "n as in Figs. 18 to 20; lambda by 0.01"};
}

/// Fig. 3.
std::vector<Panel> one_element() {
    return {{"03a",
             "Displacement due to one element of width dx",
             Quantity::displacement,
             fractions(-400, 400, 200),
             {{"u"}},
             "x / dx",
             "dx = 2a/40, b/a = 1000"},
            {"03b",
             "Its derivative, singular at the edges",
             Quantity::slope,
             fractions(-400, 400, 200),
             {{"du/dx"}},
             "x / dx",
             "points within 1e-9 dx of an edge are taken at that distance; the peaks are infinite",
             {.y = Range{-3.5, 3.5}}}};
}

/// Section 5.1: Figs. 5 to 10.
std::vector<Panel> collocation() {
    constexpr Case closed{.derivative = analytic};
    const std::vector<Curve> of_fig_9{{"analytic, alpha_L = alpha_T = 1", ahead_analytic},
                                      {"fd, alpha_L = alpha_T = 0.5", equal},
                                      {"fd, alpha_L = 0, alpha_T = 0.63", recommended},
                                      {"fd, alpha_L = alpha_T = 1", ahead}};
    return {
        ratio_over_alpha("05a", "Collocation, finite differences, n = 40", three_ways({}), {.y = Range{0.99, 1.03}}),
        ratio_over_alpha("05b", "Collocation, finite differences, alpha_L = 0", densities(fine, {}, alpha_T),
                         {.x = Range{0.4, 0.8}, .y = Range{0.998, 1.003}}),
        ratio_over_n("06a", "Collocation, finite differences",
                     {{"alpha_L = alpha_T = 0.5", equal, n},
                      {"alpha_L = 0, alpha_T = 0.5", {.alpha_T = 0.5}, n},
                      {"alpha_L = 0, alpha_T = 0.63", recommended, n}}),
        ratio_over_n("06b", "Collocation, analytic derivative",
                     {{"alpha_L = 0, alpha_T = 0.4", {.derivative = analytic, .alpha_L = 0, .alpha_T = 0.4}, n},
                      {"alpha_L = 0.4, alpha_T = 0", {.derivative = analytic, .alpha_L = 0.4, .alpha_T = 0}, n},
                      {"alpha_L = alpha_T = 0.4", {.derivative = analytic, .alpha_L = 0.4, .alpha_T = 0.4}, n}}),
        ratio_over_alpha("07a", "Collocation, analytic derivative, n = 40", three_ways(closed),
                         {.y = Range{0.86, 1.06}}),
        ratio_over_alpha("07b", "Collocation, analytic derivative, alpha_L = 0", densities(fine, closed, alpha_T),
                         {.x = Range{0.4, 0.8}, .y = Range{0.99, 1.01}}),
        ratio_over_n("08a", "Finite differences and analytic derivative, alpha_L = alpha_T = 0.5",
                     {{"finite differences", equal, n},
                      {"analytic (alpha = 0.499)", {.derivative = analytic, .alpha_L = 0.5, .alpha_T = 0.5}, n}}),
        ratio_over_n("08b", "Finite differences and analytic derivative, alpha_L = 0",
                     {{"finite differences, alpha_T = 0.63", recommended, n},
                      {"analytic, alpha_T = 0.47", {.derivative = analytic, .alpha_T = 0.47}, n},
                      {"analytic, alpha_T = 0.6", {.derivative = analytic, .alpha_T = 0.6}, n}}),
        tractions_of("09a", "Traction in the whole contact, n = 40", of_fig_9,
                     "divided by G xi: the paper's xi = 0.0001 is a factor; Carter's line added", {}),
        tractions_of("09b", "Traction in the leading half, n = 40", of_fig_9,
                     "the view: the leading half, where the oscillation shows best",
                     {.markers = true, .x = Range{0, 1}}),
        tractions_of("10a", "Traction: Carter and collocation, fd, alpha_L = 0, alpha_T = 0.63",
                     {{"collocation", recommended}}, "n = 40 as in Fig. 9", {.markers = true}),
    };
}

/// Section 5.2: Figs. 11 to 13.
std::vector<Panel> galerkin() {
    constexpr Case fd{.method = galerkin_7}, closed{.method = galerkin_7, .derivative = analytic};
    return {
        ratio_over_alpha("11a", "Galerkin, 7 Gauss points, finite differences, n = 40", three_ways(fd),
                         {.y = Range{0.99, 1.03}}),
        ratio_over_alpha("11b", "Galerkin, 7 Gauss points, finite differences, alpha_L = 0",
                         densities(fine, fd, alpha_T), {.x = Range{0.5, 1}, .y = Range{0.998, 1.004}}),
        ratio_over_alpha("12a", "Galerkin, 7 Gauss points, analytic derivative, n = 40", three_ways(closed),
                         {.y = Range{0.975, 1.035}}),
        ratio_over_alpha("12b", "Galerkin in closed form, analytic derivative, n = 40", three_ways(exact_galerkin),
                         {.y = Range{0.99, 1.03}}),
        ratio_over_alpha("13a", "Galerkin in closed form, analytic derivative, alpha_L = 0",
                         densities(fine, exact_galerkin, alpha_T), {.x = Range{0.4, 0.8}, .y = Range{0.998, 1.003}}),
        ratio_over_n("13b", "Collocation (fd) and Galerkin (closed form, analytic), alpha_L = 0, alpha_T = 0.63",
                     {{"collocation", recommended, n}, {"Galerkin (on top of collocation)", exact_galerkin, n}}),
    };
}

/// Section 5.3: Figs. 14 to 17.
std::vector<Panel> meshes() {
    constexpr Case geometric{.mesh = Topology::geometric}, knothe{.mesh = Topology::knothe};
    constexpr Case modified{.mesh = Topology::modified_knothe};
    const auto equal_on = [](Case c) {
        c.alpha_L = c.alpha_T = 0.5;
        return c;
    };
    Case small_ends = equal_on(knothe), small_end = equal_on(modified);
    small_ends.grading = small_end.grading = 0.4;
    const std::vector<Curve> of_fig_17{
        {"uniform", equal}, {"Knothe and Gross-Thebing", small_ends}, {"modified Knothe", small_end}};
    const std::string choice =
        "n = 40, fd, alpha_L = alpha_T = 0.5 and epsilon = 0.4, the optimum of Fig. 15B; width of the views";
    return {
        ratio_over_grading("14a", "Geometric mesh, fd, alpha_L = 0, alpha_T = 0.63", geometric),
        ratio_over_grading("14b", "Geometric mesh, fd, alpha_L = alpha_T = 0.5", equal_on(geometric)),
        ratio_over_grading("15a", "Knothe and Gross-Thebing's mesh, fd, alpha_L = 0, alpha_T = 0.63", knothe),
        ratio_over_grading("15b", "Knothe and Gross-Thebing's mesh, fd, alpha_L = alpha_T = 0.5", equal_on(knothe)),
        ratio_over_grading("16a", "Modified Knothe mesh, fd, alpha_L = 0, alpha_T = 0.63", modified,
                           "; the caption's 0.63/0 is read as alpha_L = 0"),
        ratio_over_grading("16b", "Modified Knothe mesh, fd, alpha_L = alpha_T = 0.5", equal_on(modified)),
        tractions_of("17a", "Traction at the trailing edge on three meshes", of_fig_17, choice,
                     {.markers = true, .x = Range{-1, -0.8}}),
        tractions_of("17b", "Traction at the leading edge on three meshes", of_fig_17, choice,
                     {.markers = true, .x = Range{0.8, 1}}),
    };
}

/// Section 6.1: Figs. 18 to 21.
std::vector<Panel> stability() {
    constexpr Case closed{.derivative = analytic};
    return {
        unstable_over_alpha("18a", "Collocation, analytic derivative, alpha_L = alpha_T = alpha", closed, both_alphas),
        unstable_over_alpha("18b", "Collocation, finite differences, alpha_L = alpha_T = alpha", {}, both_alphas),
        unstable_over_alpha("19a", "Collocation, analytic derivative, alpha_L = 0", closed, alpha_T),
        unstable_over_alpha("19b", "Collocation, finite differences, alpha_L = 0", {}, alpha_T),
        unstable_over_alpha("20a", "Galerkin, 7 Gauss points, analytic derivative, alpha_L = 0",
                            {.method = galerkin_7, .derivative = analytic}, alpha_T),
        unstable_over_alpha("20b", "Galerkin, 7 Gauss points, finite differences, alpha_L = 0", {.method = galerkin_7},
                            alpha_T),
        unstable_over_lambda("21a", "analytic, alpha_L = alpha_T = 1", ahead_analytic),
        unstable_over_lambda("21b", "fd, alpha_L = alpha_T = 1", ahead),
        unstable_over_lambda("21c", "analytic, alpha_L = 0, alpha_T = 1", {.derivative = analytic, .alpha_T = 1}),
        unstable_over_lambda("21d", "fd, alpha_L = 0, alpha_T = 1", {.alpha_T = 1}),
    };
}

/// Section 6.2: Fig. 22.
std::vector<Panel> frequency() {
    const std::vector<double> frequencies = logarithmic(1e-3, 5, 31);
    return {{"22a",
             "Creep coefficient under harmonic creepage, Argand diagram",
             Quantity::argand,
             frequencies,
             densities(coarse, recommended, nothing),
             "Re c_{11}",
             "alpha_L = 0, alpha_T = 0.63 instead of the caption's 1/0; omega a/V from 0.001 to 5",
             {.x = Range{-0.1, 2.3}}},
            {"22b",
             "Creep coefficient over frequency, n = 60",
             Quantity::response,
             frequencies,
             densities({60}, recommended, nothing),
             "omega a / V",
             "as Fig. 22A",
             {.log_base = 10}}};
}

}  // namespace

std::vector<Panel> panels() {
    std::vector<Panel> all;
    for (const auto& section : {one_element, collocation, galerkin, meshes, stability, frequency}) {
        for (Panel& panel : section()) all.push_back(std::move(panel));
    }
    return all;
}

}  // namespace paper
