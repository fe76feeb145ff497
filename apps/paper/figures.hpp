// The figures of the paper as one table: what each panel shows, over what, for which discretisations.
// The figures themselves are not printed with the text, so axes and ranges are chosen to show what the text says.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluate.hpp"

namespace paper {

enum class Quantity { displacement, slope, c11_ratio, traction, unstable_fraction, argand, response };

/// What a curve takes its x values for.
enum class Vary { nothing, both_alphas, alpha_L, alpha_T, n, grading, lambda };

struct Curve {
    std::string label;
    Case at{};
    Vary vary = Vary::nothing;
};

struct Range {
    double low, high;
};

struct Axes {
    int log_base = 0;  ///< of a logarithmic x axis; 0 for a linear one
    bool markers = false;
    std::optional<Range> x{}, y{};  ///< drawn; the data go on
};

struct Panel {
    std::string figure;  ///< number of two digits and letter
    std::string title;
    Quantity quantity;
    std::vector<double> grid;  ///< x values; empty where the elements are the x values
    std::vector<Curve> curves;
    std::string x_label, choice;  ///< choice: what was chosen where the paper is silent
    Axes axes{};
};

/// "05a" as the paper prints it, "5A".
inline std::string printed(const std::string& figure) {
    return std::to_string(std::stoi(figure)) + char(figure.back() - 'a' + 'A');
}

/// The curve's case with its variable set to x.
inline Case at(const Curve& curve, double x) {
    Case c = curve.at;
    switch (curve.vary) {
        case Vary::nothing: break;
        case Vary::both_alphas: c.alpha_L = c.alpha_T = x; break;
        case Vary::alpha_L: c.alpha_L = x; break;
        case Vary::alpha_T: c.alpha_T = x; break;
        case Vary::n: c.n = static_cast<Eigen::Index>(std::lround(x)); break;
        case Vary::grading: c.grading = x; break;
        case Vary::lambda: c.lambda = x; break;
    }
    return c;
}

/// k / denominator for first <= k <= last.
inline std::vector<double> fractions(int first, int last, int denominator) {
    std::vector<double> grid;
    for (int k = first; k <= last; ++k) grid.push_back(double(k) / denominator);
    return grid;
}

inline std::vector<double> logarithmic(double low, double high, int count) {
    std::vector<double> grid;
    for (int k = 0; k < count; ++k) grid.push_back(low * std::pow(high / low, double(k) / (count - 1)));
    return grid;
}

namespace detail {

/// The three ways of varying alpha that most panels compare.
inline std::vector<Curve> three_ways(Case c) {
    Case trailing = c, leading = c;
    trailing.alpha_L = 0;
    leading.alpha_T = 0;
    return {{"alpha_L = alpha_T = alpha", c, Vary::both_alphas},
            {"alpha_L = 0, alpha_T = alpha", trailing, Vary::alpha_T},
            {"alpha_T = 0, alpha_L = alpha", leading, Vary::alpha_L}};
}

/// One curve for each number of elements.
inline std::vector<Curve> densities(const std::vector<Eigen::Index>& numbers, Case c, Vary vary) {
    std::vector<Curve> curves;
    for (const Eigen::Index n : numbers) {
        c.n = n;
        curves.push_back({"n = " + std::to_string(n), c, vary});
    }
    return curves;
}

}  // namespace detail

/// Figs. 3, 5 to 9 and 10 to 22.
inline std::vector<Panel> panels() {
    using detail::densities, detail::three_ways;
    using enum Vary;
    constexpr Derivative analytic = Derivative::analytic;
    constexpr Method galerkin_7 = Method::galerkin_7, galerkin_exact = Method::galerkin_exact;
    using Q = Quantity;

    const std::vector<double> alphas = fractions(0, 200, 200);  // holds the multiples of 0.05, and 0.63
    const std::vector<double> open_alphas = fractions(1, 200, 200);
    const std::vector<double> numbers{10, 15, 20, 25, 30, 35, 40, 50, 60, 70, 80, 100, 120, 140, 160};
    const std::vector<double> ratios{0.125, 0.25, 0.5, 1, 2, 4, 8};
    const std::vector<double> epsilons = fractions(1, 10, 10);
    const std::vector<double> lambdas = fractions(0, 100, 100);
    const std::vector<double> frequencies = logarithmic(1e-3, 5, 31);
    const std::vector<Eigen::Index> fine{40, 60, 80}, coarse{20, 40, 60};

    const Case equal{.alpha_L = 0.5, .alpha_T = 0.5};
    const Case recommended{.alpha_L = 0, .alpha_T = 0.63};
    const Case exact_galerkin{.method = galerkin_exact, .derivative = analytic};
    const Case ahead{.alpha_L = 1, .alpha_T = 1};
    const Case ahead_analytic{.derivative = analytic, .alpha_L = 1, .alpha_T = 1};
    const std::vector<Curve> of_fig_9{{"analytic, alpha_L = alpha_T = 1", ahead_analytic},
                                      {"fd, alpha_L = alpha_T = 0.5", equal},
                                      {"fd, alpha_L = 0, alpha_T = 0.63", recommended},
                                      {"fd, alpha_L = alpha_T = 1", ahead}};
    const Case geometric{.mesh = Topology::geometric}, knothe{.mesh = Topology::knothe};
    const Case modified{.mesh = Topology::modified_knothe};
    const auto equal_on = [](Case c) {
        c.alpha_L = c.alpha_T = 0.5;
        return c;
    };

    Case small_ends = equal_on(knothe), small_end = equal_on(modified);
    small_ends.grading = small_end.grading = 0.4;
    const std::vector<Curve> of_fig_17{
        {"uniform", equal}, {"Knothe and Gross-Thebing", small_ends}, {"modified Knothe", small_end}};

    const std::string over_alpha = "alpha", over_n = "number of elements n", over_x = "x / a (leading edge at 1)";
    const std::string no_n = "n: the paper's 40, 60, 80 of the other figures";
    const std::string axis = "alpha by 0.005";
    const std::string fig_17 =
        "n = 40, fd, alpha_L = alpha_T = 0.5 and epsilon = 0.4, the optimum of Fig. 15B; width of the views";

    return {
        {"03a",
         "Displacement due to one element of width dx",
         Q::displacement,
         fractions(-400, 400, 200),
         {{"u"}},
         "x / dx",
         "dx = 2a/40, b/a = 1000"},
        {"03b",
         "Its derivative, singular at the edges",
         Q::slope,
         fractions(-400, 400, 200),
         {{"du/dx"}},
         "x / dx",
         "points within 1e-9 dx of an edge are taken at that distance"},

        {"05a",
         "Collocation, finite differences, n = 40",
         Q::c11_ratio,
         alphas,
         three_ways({}),
         over_alpha,
         axis,
         {.y = Range{0.97, 1.03}}},
        {"05b",
         "Collocation, finite differences, alpha_L = 0",
         Q::c11_ratio,
         alphas,
         densities(fine, {}, alpha_T),
         over_alpha,
         axis,
         {.x = Range{0.4, 0.8}, .y = Range{0.998, 1.003}}},

        {"06a",
         "Collocation, finite differences",
         Q::c11_ratio,
         numbers,
         {{"alpha_L = alpha_T = 0.5", equal, n},
          {"alpha_L = 0, alpha_T = 0.5", {.alpha_T = 0.5}, n},
          {"alpha_L = 0, alpha_T = 0.63", recommended, n}},
         over_n,
         "n from 10 to 160",
         {.markers = true}},
        {"06b",
         "Collocation, analytic derivative",
         Q::c11_ratio,
         numbers,
         {{"alpha_L = 0, alpha_T = 0.4", {.derivative = analytic, .alpha_L = 0, .alpha_T = 0.4}, n},
          {"alpha_L = 0.4, alpha_T = 0", {.derivative = analytic, .alpha_L = 0.4, .alpha_T = 0}, n},
          {"alpha_L = alpha_T = 0.4", {.derivative = analytic, .alpha_L = 0.4, .alpha_T = 0.4}, n}},
         over_n,
         "n from 10 to 160",
         {.markers = true}},

        {"07a",
         "Collocation, analytic derivative, n = 40",
         Q::c11_ratio,
         alphas,
         three_ways({.derivative = analytic}),
         over_alpha,
         axis,
         {.y = Range{0.94, 1.06}}},
        {"07b",
         "Collocation, analytic derivative, alpha_L = 0",
         Q::c11_ratio,
         alphas,
         densities(fine, {.derivative = analytic}, alpha_T),
         over_alpha,
         axis,
         {.x = Range{0.4, 0.8}, .y = Range{0.99, 1.01}}},

        {"08a",
         "Finite differences and analytic derivative, alpha_L = alpha_T = 0.5",
         Q::c11_ratio,
         numbers,
         {{"finite differences", equal, n},
          {"analytic (alpha = 0.499)", {.derivative = analytic, .alpha_L = 0.5, .alpha_T = 0.5}, n}},
         over_n,
         "n from 10 to 160",
         {.markers = true}},
        {"08b",
         "Finite differences and analytic derivative, alpha_L = 0",
         Q::c11_ratio,
         numbers,
         {{"finite differences, alpha_T = 0.63", recommended, n},
          {"analytic, alpha_T = 0.47", {.derivative = analytic, .alpha_T = 0.47}, n},
          {"analytic, alpha_T = 0.6", {.derivative = analytic, .alpha_T = 0.6}, n}},
         over_n,
         "n from 10 to 160",
         {.markers = true}},

        {"09a",
         "Traction in the whole contact, n = 40",
         Q::traction,
         {},
         of_fig_9,
         over_x,
         "divided by G xi: the paper's xi = 0.0001 is a factor; Carter's line added"},
        {"09b",
         "Traction in the leading half, n = 40",
         Q::traction,
         {},
         of_fig_9,
         over_x,
         "the view: the leading half, where the oscillation shows best",
         {.markers = true, .x = Range{0, 1}}},
        {"10a",
         "Traction: Carter and collocation, fd, alpha_L = 0, alpha_T = 0.63",
         Q::traction,
         {},
         {{"collocation", recommended}},
         over_x,
         "n = 40 as in Fig. 9",
         {.markers = true}},

        {"11a",
         "Galerkin, 7 Gauss points, finite differences, n = 40",
         Q::c11_ratio,
         alphas,
         three_ways({.method = galerkin_7}),
         over_alpha,
         axis,
         {.y = Range{0.97, 1.03}}},
        {"11b",
         "Galerkin, 7 Gauss points, finite differences, alpha_L = 0",
         Q::c11_ratio,
         alphas,
         densities(fine, {.method = galerkin_7}, alpha_T),
         over_alpha,
         axis,
         {.x = Range{0.5, 1}, .y = Range{0.998, 1.004}}},
        {"12a",
         "Galerkin, 7 Gauss points, analytic derivative, n = 40",
         Q::c11_ratio,
         alphas,
         three_ways({.method = galerkin_7, .derivative = analytic}),
         over_alpha,
         axis,
         {.y = Range{0.97, 1.035}}},
        {"12b",
         "Galerkin in closed form, analytic derivative, n = 40",
         Q::c11_ratio,
         alphas,
         three_ways(exact_galerkin),
         over_alpha,
         axis,
         {.y = Range{0.97, 1.03}}},
        {"13a",
         "Galerkin in closed form, analytic derivative, alpha_L = 0",
         Q::c11_ratio,
         alphas,
         densities(fine, exact_galerkin, alpha_T),
         over_alpha,
         axis,
         {.x = Range{0.4, 0.8}, .y = Range{0.998, 1.003}}},
        {"13b",
         "Collocation (fd) and Galerkin (closed form, analytic), alpha_L = 0, alpha_T = 0.63",
         Q::c11_ratio,
         numbers,
         {{"collocation", recommended, n}, {"Galerkin", exact_galerkin, n}},
         over_n,
         "n from 10 to 160",
         {.markers = true}},

        {"14a",
         "Geometric mesh, fd, alpha_L = 0, alpha_T = 0.63",
         Q::c11_ratio,
         ratios,
         densities(fine, geometric, grading),
         "dx_T / dx_L",
         no_n,
         {.log_base = 2, .markers = true}},
        {"14b",
         "Geometric mesh, fd, alpha_L = alpha_T = 0.5",
         Q::c11_ratio,
         ratios,
         densities(fine, equal_on(geometric), grading),
         "dx_T / dx_L",
         no_n,
         {.log_base = 2, .markers = true}},
        {"15a",
         "Knothe and Gross-Thebing's mesh, fd, alpha_L = 0, alpha_T = 0.63",
         Q::c11_ratio,
         epsilons,
         densities(fine, knothe, grading),
         "epsilon",
         no_n,
         {.markers = true}},
        {"15b",
         "Knothe and Gross-Thebing's mesh, fd, alpha_L = alpha_T = 0.5",
         Q::c11_ratio,
         epsilons,
         densities(fine, equal_on(knothe), grading),
         "epsilon",
         no_n,
         {.markers = true}},
        {"16a",
         "Modified Knothe mesh, fd, alpha_L = 0, alpha_T = 0.63",
         Q::c11_ratio,
         epsilons,
         densities(fine, modified, grading),
         "epsilon",
         no_n + "; the caption's 0.63/0 is read as alpha_L = 0",
         {.markers = true}},
        {"16b",
         "Modified Knothe mesh, fd, alpha_L = alpha_T = 0.5",
         Q::c11_ratio,
         epsilons,
         densities(fine, equal_on(modified), grading),
         "epsilon",
         no_n,
         {.markers = true}},

        {"17a",
         "Traction at the trailing edge on three meshes",
         Q::traction,
         {},
         of_fig_17,
         over_x,
         fig_17,
         {.markers = true, .x = Range{-1, -0.8}}},
        {"17b",
         "Traction at the leading edge on three meshes",
         Q::traction,
         {},
         of_fig_17,
         over_x,
         fig_17,
         {.markers = true, .x = Range{0.8, 1}}},

        {"18a", "Collocation, analytic derivative, alpha_L = alpha_T = alpha", Q::unstable_fraction, open_alphas,
         densities(coarse, {.derivative = analytic}, both_alphas), over_alpha, "alpha from 0.005 by 0.005"},
        {"18b", "Collocation, finite differences, alpha_L = alpha_T = alpha", Q::unstable_fraction, open_alphas,
         densities(coarse, {}, both_alphas), over_alpha, "alpha from 0.005 by 0.005"},
        {"19a", "Collocation, analytic derivative, alpha_L = 0", Q::unstable_fraction, open_alphas,
         densities(coarse, {.derivative = analytic}, alpha_T), "alpha_T", "alpha_T from 0.005 by 0.005"},
        {"19b", "Collocation, finite differences, alpha_L = 0", Q::unstable_fraction, open_alphas,
         densities(coarse, {}, alpha_T), "alpha_T", "alpha_T from 0.005 by 0.005"},
        {"20a", "Galerkin, 7 Gauss points, analytic derivative, alpha_L = 0", Q::unstable_fraction, open_alphas,
         densities(coarse, {.method = galerkin_7, .derivative = analytic}, alpha_T), "alpha_T",
         "alpha_T from 0.005 by 0.005"},
        {"20b", "Galerkin, 7 Gauss points, finite differences, alpha_L = 0", Q::unstable_fraction, open_alphas,
         densities(coarse, {.method = galerkin_7}, alpha_T), "alpha_T", "alpha_T from 0.005 by 0.005"},
        {"21a", "G' at alpha, G at lambda alpha; analytic, alpha_L = alpha_T = 1", Q::unstable_fraction, lambdas,
         densities(coarse, ahead_analytic, lambda), "lambda", "n as in Figs. 18 to 20; lambda by 0.01"},
        {"21b", "G' at alpha, G at lambda alpha; fd, alpha_L = alpha_T = 1", Q::unstable_fraction, lambdas,
         densities(coarse, ahead, lambda), "lambda", "n as in Figs. 18 to 20; lambda by 0.01"},
        {"21c", "G' at alpha, G at lambda alpha; analytic, alpha_L = 0, alpha_T = 1", Q::unstable_fraction, lambdas,
         densities(coarse, {.derivative = analytic, .alpha_T = 1}, lambda), "lambda",
         "n as in Figs. 18 to 20; lambda by 0.01"},
        {"21d", "G' at alpha, G at lambda alpha; fd, alpha_L = 0, alpha_T = 1", Q::unstable_fraction, lambdas,
         densities(coarse, {.alpha_T = 1}, lambda), "lambda", "n as in Figs. 18 to 20; lambda by 0.01"},

        {"22a",
         "Creep coefficient under harmonic creepage, Argand diagram",
         Q::argand,
         frequencies,
         densities(coarse, recommended, nothing),
         "Re c_{11}",
         "alpha_L = 0, alpha_T = 0.63 instead of the caption's 1/0; omega a/V from 0.001 to 5",
         {.x = Range{0, 2.2}}},
        {"22b",
         "Creep coefficient over frequency, n = 60",
         Q::response,
         frequencies,
         densities({60}, recommended, nothing),
         "omega a / V",
         "as Fig. 22A",
         {.log_base = 10}},
    };
}

}  // namespace paper
