// The panels of the paper's figures, section by section.
#include "figures.hpp"

namespace paper {

namespace {

using enum Vary;

const std::string fd = "uniform:collocation:", recommended_analytic = fd + "0/0.63:analytic",
                  seven_points_analytic = "uniform:galerkin:0/0.63:q7:analytic";

/// The three ways of varying alpha that most panels compare.
std::vector<Curve> three_ways(const std::string& scheme) {
    return {{"alpha_L = alpha_T = alpha", scheme, both_alphas},
            {"alpha_L = 0, alpha_T = alpha", at(scheme, alpha_L, 0), alpha_T},
            {"alpha_T = 0, alpha_L = alpha", at(scheme, alpha_T, 0), alpha_L}};
}

/// One curve for each number of elements.
std::vector<Curve> densities(const std::vector<Eigen::Index>& numbers, const std::string& scheme, Vary vary) {
    std::vector<Curve> curves;
    for (const Eigen::Index n : numbers) curves.push_back({"n = " + std::to_string(n), {scheme, n}, vary});
    return curves;
}

// The families of panels.

Family with(Family family, const std::string& choice) {
    family.choice = choice;
    return family;
}

const Family over_alpha{Quantity::c11_ratio, fractions(0, 200, 200),  // contains the multiples of 0.05, and 0.63
                        "alpha", "alpha by 0.005; the data say where tractions assist the creepage, as near alpha = 0"};
const Family over_n{Quantity::c11_ratio,
                    {10, 15, 20, 25, 30, 35, 40, 50, 60, 70, 80, 100, 120, 140, 160},
                    "number of elements n",
                    "n from 10 to 160"};
const Family over_epsilon{Quantity::c11_ratio, fractions(1, 10, 10), "epsilon",
                          "n: the paper's 40, 60, 80 of the other figures"};
const Family over_size_ratio{
    Quantity::c11_ratio, {0.125, 0.25, 0.5, 1, 2, 4, 8}, "dx_T / dx_L", over_epsilon.choice, true};
const Family over_x{Quantity::traction, {}, "x / a (leading edge at 1)", ""};
const Family unstable_over_alpha{Quantity::unstable_fraction, fractions(1, 200, 200), "alpha",
                                 "alpha from 0.005 by 0.005"};
const Family unstable_over_alpha_T{Quantity::unstable_fraction, fractions(1, 200, 200), "alpha_T",
                                   "alpha_T from 0.005 by 0.005"};
const Family over_lambda{Quantity::unstable_fraction, fractions(0, 100, 100), "lambda",
                         "n as in Figs. 18 to 20; lambda by 0.01"};

/// Section 5.1: Figs. 5 to 10.
std::vector<Panel> collocation() {
    const std::vector<Curve> of_fig_9{{"analytic, alpha_L = alpha_T = 1", {fd + "1/1:analytic"}},
                                      {"fd, alpha_L = alpha_T = 0.5", {half_alphas}},
                                      {"fd, alpha_L = 0, alpha_T = 0.63", {}},
                                      {"fd, alpha_L = alpha_T = 1", {unit_alphas}}};
    return {
        {over_alpha, "05a", "Collocation, finite differences, n = 40", three_ways(recommended), {}, Range{0.99, 1.03}},
        {over_alpha, "05b", "Collocation, finite differences, alpha_L = 0", densities(fine, recommended, alpha_T),
         Range{0.4, 0.8}, Range{0.998, 1.003}},
        {over_n,
         "06a",
         "Collocation, finite differences",
         {{"alpha_L = alpha_T = 0.5", {half_alphas}, n},
          {"alpha_L = 0, alpha_T = 0.5", {fd + "0/0.5"}, n},
          {"alpha_L = 0, alpha_T = 0.63", {}, n}}},
        {over_n,
         "06b",
         "Collocation, analytic derivative",
         {{"alpha_L = 0, alpha_T = 0.4", {fd + "0/0.4:analytic"}, n},
          {"alpha_L = 0.4, alpha_T = 0", {fd + "0.4/0:analytic"}, n},
          {"alpha_L = alpha_T = 0.4", {fd + "0.4/0.4:analytic"}, n}}},
        {over_alpha,
         "07a",
         "Collocation, analytic derivative, n = 40",
         three_ways(recommended_analytic),
         {},
         Range{0.86, 1.06}},
        {over_alpha, "07b", "Collocation, analytic derivative, alpha_L = 0",
         densities(fine, recommended_analytic, alpha_T), Range{0.4, 0.8}, Range{0.99, 1.01}},
        {over_n,
         "08a",
         "Finite differences and analytic derivative, alpha_L = alpha_T = 0.5",
         {{"finite differences", {half_alphas}, n}, {"analytic (alpha = 0.499)", {fd + "0.5/0.5:analytic"}, n}}},
        {over_n,
         "08b",
         "Finite differences and analytic derivative, alpha_L = 0",
         {{"finite differences, alpha_T = 0.63", {}, n},
          {"analytic, alpha_T = 0.47", {fd + "0/0.47:analytic"}, n},
          {"analytic, alpha_T = 0.6", {fd + "0/0.6:analytic"}, n}}},
        {with(over_x, "divided by G xi: the paper's xi = 0.0001 is a factor; Carter's line added"), "09a",
         "Traction in the whole contact, n = 40", of_fig_9},
        {with(over_x, "the view: the leading half, where the oscillation shows best"), "09b",
         "Traction in the leading half, n = 40", of_fig_9, Range{0, 1}},
        {with(over_x, "n = 40 as in Fig. 9"),
         "10a",
         "Traction: Carter and collocation, fd, alpha_L = 0, alpha_T = 0.63",
         {{"collocation", {}}}},
    };
}

/// Section 5.2: Figs. 11 to 13.
std::vector<Panel> galerkin() {
    return {
        {over_alpha,
         "11a",
         "Galerkin, 7 Gauss points, finite differences, n = 40",
         three_ways(seven_points),
         {},
         Range{0.99, 1.03}},
        {over_alpha, "11b", "Galerkin, 7 Gauss points, finite differences, alpha_L = 0",
         densities(fine, seven_points, alpha_T), Range{0.5, 1}, Range{0.998, 1.004}},
        {over_alpha,
         "12a",
         "Galerkin, 7 Gauss points, analytic derivative, n = 40",
         three_ways(seven_points_analytic),
         {},
         Range{0.975, 1.035}},
        {over_alpha,
         "12b",
         "Galerkin in closed form, analytic derivative, n = 40",
         three_ways(exact_galerkin),
         {},
         Range{0.99, 1.03}},
        {over_alpha, "13a", "Galerkin in closed form, analytic derivative, alpha_L = 0",
         densities(fine, exact_galerkin, alpha_T), Range{0.4, 0.8}, Range{0.998, 1.003}},
        {over_n,
         "13b",
         "Collocation (fd) and Galerkin (closed form, analytic), alpha_L = 0, alpha_T = 0.63",
         {{"collocation", {}, n}, {"Galerkin (on top of collocation)", {exact_galerkin}, n}}},
    };
}

/// Section 5.3: Figs. 14 to 17.
std::vector<Panel> meshes() {
    const auto gradings = [](const std::string& scheme) { return densities(fine, scheme, grading); };
    const std::string best = "-1:collocation:0/0.63", half = "-1:collocation:0.5/0.5";
    const std::vector<Curve> of_fig_17{{"uniform", {half_alphas}},
                                       {"Knothe and Gross-Thebing", {"knothe-0.4:collocation:0.5/0.5"}},
                                       {"modified Knothe", {"modified-knothe-0.4:collocation:0.5/0.5"}}};
    const Family close = with(
        over_x, "n = 40, fd, alpha_L = alpha_T = 0.5 and epsilon = 0.4, the optimum of Fig. 15B; width of the views");
    return {
        {over_size_ratio, "14a", "Geometric mesh, fd, alpha_L = 0, alpha_T = 0.63", gradings("geometric" + best)},
        {over_size_ratio, "14b", "Geometric mesh, fd, alpha_L = alpha_T = 0.5", gradings("geometric" + half)},
        {over_epsilon, "15a", "Knothe and Gross-Thebing's mesh, fd, alpha_L = 0, alpha_T = 0.63",
         gradings("knothe" + best)},
        {over_epsilon, "15b", "Knothe and Gross-Thebing's mesh, fd, alpha_L = alpha_T = 0.5",
         gradings("knothe" + half)},
        {with(over_epsilon, over_epsilon.choice + "; the caption's 0.63/0 is read as alpha_L = 0"), "16a",
         "Modified Knothe mesh, fd, alpha_L = 0, alpha_T = 0.63", gradings("modified-knothe" + best)},
        {over_epsilon, "16b", "Modified Knothe mesh, fd, alpha_L = alpha_T = 0.5", gradings("modified-knothe" + half)},
        {close, "17a", "Traction at the trailing edge on three meshes", of_fig_17, Range{-1.01, -0.8}},
        {close, "17b", "Traction at the leading edge on three meshes", of_fig_17, Range{0.8, 1.01}},
    };
}

/// Section 6.1: Figs. 18 to 21.
std::vector<Panel> stability() {
    const auto of = [](const std::string& scheme, Vary vary) { return densities(coarse, scheme, vary); };
    const std::string split = "G' at alpha, G at lambda alpha; ";
    return {
        {unstable_over_alpha, "18a", "Collocation, analytic derivative, alpha_L = alpha_T = alpha",
         of(recommended_analytic, both_alphas)},
        {unstable_over_alpha, "18b", "Collocation, finite differences, alpha_L = alpha_T = alpha",
         of(recommended, both_alphas)},
        {unstable_over_alpha_T, "19a", "Collocation, analytic derivative, alpha_L = 0",
         of(recommended_analytic, alpha_T)},
        {unstable_over_alpha_T, "19b", "Collocation, finite differences, alpha_L = 0", of(recommended, alpha_T)},
        {unstable_over_alpha_T, "20a", "Galerkin, 7 Gauss points, analytic derivative, alpha_L = 0",
         of(seven_points_analytic, alpha_T)},
        {unstable_over_alpha_T, "20b", "Galerkin, 7 Gauss points, finite differences, alpha_L = 0",
         of(seven_points, alpha_T)},
        {over_lambda, "21a", split + "analytic, alpha_L = alpha_T = 1", of(fd + "1/1:analytic", lambda)},
        {over_lambda, "21b", split + "fd, alpha_L = alpha_T = 1", of(fd + "1/1", lambda)},
        {over_lambda, "21c", split + "analytic, alpha_L = 0, alpha_T = 1", of(fd + "0/1:analytic", lambda)},
        {over_lambda, "21d", split + "fd, alpha_L = 0, alpha_T = 1", of(fd + "0/1", lambda)},
    };
}

}  // namespace

std::vector<Panel> panels() {
    const std::vector<double> widths = fractions(-400, 400, 200), frequencies = logarithmic(1e-3, 5, 31);
    std::vector<Panel> all{{{Quantity::displacement, widths, "x / dx", "dx = 2a/40, b/a = 1000"},
                            "03a",
                            "Displacement due to one element of width dx",
                            {{"u"}}},
                           {{Quantity::slope, widths, "x / dx",
                             "points within 1e-9 dx of an edge are taken at that distance; the peaks are infinite"},
                            "03b",
                            "Its derivative, singular at the edges",
                            {{"du/dx"}},
                            {},
                            Range{-3.5, 3.5}}};
    for (const auto& section : {collocation, galerkin, meshes, stability}) {
        for (Panel& panel : section()) all.push_back(std::move(panel));
    }
    all.push_back({{Quantity::argand, frequencies, "Re c_{11}",
                    "alpha_L = 0, alpha_T = 0.63 instead of the caption's 1/0; omega a/V from 0.001 to 5"},
                   "22a",
                   "Creep coefficient under harmonic creepage, Argand diagram",
                   densities(coarse, recommended, nothing),
                   Range{-0.1, 2.3}});
    all.push_back({{Quantity::response, frequencies, "omega a / V", "as Fig. 22A", true},
                   "22b",
                   "Creep coefficient over frequency, n = 60",
                   densities({60}, recommended, nothing)});
    return all;
}

}  // namespace paper
