// Section 5.1, collocation in steady rolling: Eq. (31), Figs. 3 and 5 to 10.
#include <algorithm>
#include <limits>

#include <rollbem/closed_form/carter.hpp>

#include "lists.hpp"

namespace paper {

namespace {

/// Whether at every x the error of `better` is smaller, or larger by at most `tolerance`. Both curves must have all
/// their points.
bool smaller_everywhere(const Points& better, const Points& worse, double tolerance = 0) {
    if (better.size() != worse.size()) return false;
    for (std::size_t i = 0; i < better.size(); ++i) {
        if (!(std::abs(better[i].second - 1) < std::abs(worse[i].second - 1) + tolerance)) return false;
    }
    return true;
}

/// The smallest n of a curve from which the error stays below 0.1 %; not a number if there is none.
double elements_needed(const Points& curve) {
    double needed = curve.front().first;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (std::abs(curve[i].second - 1) < 1e-3) continue;
        needed = i + 1 < curve.size() ? curve[i + 1].first : std::numeric_limits<double>::quiet_NaN();
    }
    return needed;
}

/// Oscillation of a steady traction; Carter's is monotone. Anything above rounding counts.
constexpr double oscillation_threshold = 1e-9;
double oscillation_of(const Case& c) { return oscillation(tractions(c).value); }

/// The smallest alpha_L = alpha_T >= 0.5, by 0.01, whose traction is not monotone; infinite if there is none.
double oscillation_onset(Derivative derivative) {
    for (const double alpha : fractions(50, 100, 100)) {
        const Case c{.derivative = derivative, .alpha_L = alpha, .alpha_T = alpha};
        if (oscillation_of(c) > oscillation_threshold) return alpha;
    }
    return std::numeric_limits<double>::infinity();
}

std::vector<Claim> kernel_and_alpha() {
    return {
        {"Eq. 31", "closed form solution for the 2D problem", "c11 = pi^2/(4(1-nu)) belongs to Eq. (30)", false,
         "pi^2/(4(1-nu)) is Kalker's limit for a long ellipse. Eq. (30) for a rectangle gives pi/(2(1-nu)), to which "
         "all ratios here refer",
         [](const Results&) -> Finding {
             const double ratio =
                 c11_ratio({.n = 160}) * rollbem::steady_c11(poisson_ratio) / rollbem::ellipse_limit_c11(poisson_ratio);
             return {std::abs(ratio - 1) < 0.01, "c11* at n = 160 is " + number(ratio, 5) + " of it (2/pi = 0.63662)"};
         }},
        {"3", "tends to infinity at the element border", "du/dx of one element is singular at its edges", true,
         "logarithmic: the same increase for each factor of distance",
         [](const Results&) -> Finding {
             const double far = std::abs(element_field(0.5 + 1e-3).slope);
             const double near = std::abs(element_field(0.5 + 1e-6).slope);
             const double nearer = std::abs(element_field(0.5 + 1e-9).slope);
             const bool grows = near > far && std::abs((nearer - near) / (near - far) - 1) < 0.01;
             return {grows, "|du/dx| G/p at 1e-3, 1e-6, 1e-9 dx from it: " + number(far) + ", " + number(near) + ", " +
                                number(nearer)};
         }},
        {"5A", "maximal accuracy for alpha = 0.5", "alpha_L = alpha_T is most accurate at 0.5 (n = 40)", true,
         "Kalker's choice in CONTACT", best_alpha("05a", {40}, 0.5, {}, Vary::both_alphas, {0.4, 0.6})},
        {"5A", "the less accurate strategy", "alpha_T = 0 is the least accurate of the three ways", true, "",
         best_of("05a", 2, true)},
        {"5A", "the more precise", "alpha_L = 0 is the most accurate of the three ways", true, "", best_of("05a", 1)},
        {"5A", "an optimal result when alpha_T = 0.63", "alpha_L = 0 is most accurate at alpha_T = 0.63 (n = 40)", true,
         "", best_alpha("05b", {40}, 0.63, {}, Vary::alpha_T, {0.5, 0.7})},
        {"5B", "independently of the number of elements",
         "alpha_L = 0, alpha_T = 0.63 is optimal for n = 40, 60 and 80", true,
         "optimal: no alpha_T of the grid (by 0.05, and 0.63) is better by more than 0.01 % of c11",
         best_alpha("05b", fine, 0.63, {}, Vary::alpha_T, {0.5, 0.7})},
        {"5B", "", "The alpha_T without error falls as n grows", true,
         "it is a zero crossing of the error; from n = 60 on it is nearer to 0.6 than to 0.63",
         falls_with_n(
             {20, 40, 60, 80, 160, 320}, "",
             [](Eigen::Index n) { return true_optimum(ratio_over({.n = n}, Vary::alpha_T), 0.5, 0.7); },
             [](double alpha) { return number(alpha, 4); })},
    };
}

std::vector<Claim> convergence() {
    return {
        {"6A", "all the cases converge to the exact solution", "The errors of the three schemes tend to 0", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             std::string text;
             for (std::size_t k = 0; k < 3; ++k) {
                 const Points& curve = r.curve("06a", k);
                 const double before = std::abs(error_at(curve, 80)), after = std::abs(error_at(curve, 160));
                 holds = holds && after < before && after < 2e-3;
                 text += (k > 0 ? "; " : "") + percent(before) + " to " + percent(after);
             }
             return {holds, "from n = 80 to 160: " + text};
         }},
        {"6A", "the rate of convergence is bigger",
         "alpha_L = 0, alpha_T = 0.63 comes close to the exact value with fewer elements than 0.5/0.5", true,
         "judged by the n from which on the error stays below 0.1 %",
         [](const Results& r) -> Finding {
             const double own = elements_needed(r.curve("06a", 2)), other = elements_needed(r.curve("06a", 0));
             return {own < other, "n = " + number(own) + " against " + number(other) + "; at n = 40 the error is " +
                                      percent(error_at(r.curve("06a", 2), 40)) + " against " +
                                      percent(error_at(r.curve("06a", 0), 40))};
         }},
        {"6A", "", "Its order of convergence is no larger: both schemes are of first order", true,
         "the error of 0/0.63 passes zero near n = 20 and grows up to n = 40 before it decays",
         [](const Results&) -> Finding {
             const auto order = [](Case c) {
                 Points errors;
                 for (const Eigen::Index n : {160, 320, 640}) {
                     c.n = n;
                     errors.emplace_back(double(n), c11_ratio(c) - 1);
                 }
                 return -power(errors);
             };
             const double own = order({}), other = order({.alpha_L = 0.5, .alpha_T = 0.5});
             return {own < other + 0.05,
                     "order from n = 160 to 640: " + number(own, 2) + " against " + number(other, 2)};
         }},
        {"6A", "Errors smaller than 0.01%", "0/0.63 has an error below 0.01 % at n = 20", true, "",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("06a", 2);
             return {std::abs(error_at(curve, 20)) < 1e-4, percent(error_at(curve, 20)) +
                                                               " (n = 40: " + percent(error_at(curve, 40)) +
                                                               ", n = 80: " + percent(error_at(curve, 80)) + ")"};
         }},
        {"6B", "less precise than the ones presented in Fig. 6.A",
         "The analytic derivative (0/0.4, 0.4/0, 0.4/0.4) is less accurate than finite differences in Fig. 6A", true,
         "every scheme against every scheme, at every n",
         [](const Results& r) -> Finding {
             bool holds = true;
             double least = 1, largest = 0;
             for (std::size_t i = 0; i < 3; ++i) {
                 least = std::min(least, std::abs(error_at(r.curve("06b", i), 40)));
                 largest = std::max(largest, std::abs(error_at(r.curve("06a", i), 40)));
                 for (std::size_t k = 0; k < 3; ++k) {
                     holds = holds && smaller_everywhere(r.curve("06a", i), r.curve("06b", k));
                 }
             }
             return {holds, "n = 40: at least " + percent(least) + " against at most " + percent(largest)};
         }},
    };
}

std::vector<Claim> analytic_derivative_over_alpha() {
    return {
        {"7A", "a minimum of precision at alpha = 0.5", "alpha_L = alpha_T is at its worst at 0.5", true, "",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("07a", 0);
             const double here = std::abs(error_at(curve, 0.5));
             const double below = std::abs(error_at(curve, 0.45)), above = std::abs(error_at(curve, 0.55));
             return {here > below && here > above, "error " + percent(here) + " at 0.5, " + percent(below) +
                                                       " at 0.45, " + percent(above) + " at 0.55"};
         }},
        {"7A", "more accurate in the range", "With alpha_L or alpha_T zero, [0.4, 0.6] is the best part of alpha", true,
         "judged by the mean error inside, below and above",
         [](const Results& r) -> Finding {
             bool holds = true;
             std::string text;
             for (const std::size_t k : {std::size_t(1), std::size_t(2)}) {
                 const Points grid = on_grid(r.curve("07a", k), paper_alphas());
                 const double inside = mean_error(within(grid, 0.4, 0.6));
                 const double below = mean_error(within(grid, 0.05, 0.35)), above = mean_error(within(grid, 0.65, 1));
                 holds = holds && inside < below && inside < above;
                 text += std::string(k == 1 ? "alpha_L = 0: " : "; alpha_T = 0: ") + percent(inside) + " (" +
                         percent(below) + " below, " + percent(above) + " above)";
             }
             return {holds, text};
         }},
        {"7A", "When alpha > 0.7 the results are more accurate", "Above alpha = 0.7 alpha_L = 0 is the most accurate",
         true, "",
         [](const Results& r) -> Finding {
             const auto part = [&](std::size_t k) { return within(r.curve("07a", k), 0.705, 1); };
             const bool holds = smaller_everywhere(part(1), part(0)) && smaller_everywhere(part(1), part(2));
             return {holds, "at 0.85: alpha_L = 0 " + percent(error_at(part(1), 0.85)) + ", equal " +
                                percent(error_at(part(0), 0.85)) + ", alpha_T = 0 " + percent(error_at(part(2), 0.85))};
         }},
        {"7A", "fits the theoretical one c11 in two points", "The curve alpha_L = 0 meets 1 twice (n = 40)", true,
         "counted where tractions are consistent with full adhesion; near alpha_T = 0, where they zigzag, c11* rises "
         "from 0 through 1",
         [](const Results& r) -> Finding {
             std::string consistent, other;
             int count = 0;
             for (const double alpha : crossings(r.curve("07a", 1))) {
                 const Case c{.derivative = analytic, .alpha_T = alpha};
                 const bool counts = steady_ratio(c).status == rollbem::Status::ok;
                 count += counts;
                 (counts ? consistent : other) += " " + number(alpha);
             }
             return {count == 2, "at alpha_T =" + consistent + (other.empty() ? "" : "; not counted:" + other)};
         }},
        {"7B", "approximately alpha_T = 0.6", "One of the two stays there whatever n", true,
         "approximately: within 0.02",
         for_all_n(fine, "",
                   [](const Results& r, std::size_t k) -> Finding {
                       const std::vector<double> found = crossings(r.curve("07b", k));
                       if (found.empty()) return {false, "none"};
                       return {std::abs(found.back() - 0.6) <= 0.02, number(found.back())};
                   })},
        {"7B", "not very sensitive to the mesh density", "Near alpha_T = 0.5 the error hardly depends on n", true,
         "judged by the spread over n = 40, 60, 80 against the error itself: less than half",
         [](const Results& r) -> Finding {
             Points at_half;
             for (std::size_t k = 0; k < 3; ++k) {
                 at_half.emplace_back(double(fine[k]), value_at(r.curve("07b", k), 0.5));
             }
             return {spread(at_half) < largest_error(at_half) / 2,
                     "error " + for_each_n(fine, [&](std::size_t k) { return percent(at_half[k].second - 1); })};
         }},
    };
}

std::vector<Claim> analytic_derivative_over_n() {
    return {
        {"8A", "gives better results than the exact calculation",
         "At alpha_L = alpha_T = 0.5 finite differences are better than the analytic derivative", true, "at every n",
         [](const Results& r) -> Finding {
             const Points &fd = r.curve("08a", 0), &closed = r.curve("08a", 1);
             return {smaller_everywhere(fd, closed),
                     "n = 40: " + percent(error_at(fd, 40)) + " against " + percent(error_at(closed, 40))};
         }},
        {"8B", "better than the results in Fig. 8.A",
         "The analytic derivative with alpha_L = 0 is more accurate than with 0.5/0.5", true, "at every n",
         [](const Results& r) -> Finding {
             const Points& half = r.curve("08a", 1);
             return {smaller_everywhere(r.curve("08b", 1), half) && smaller_everywhere(r.curve("08b", 2), half),
                     "n = 40: " + percent(error_at(r.curve("08b", 1), 40)) + " (alpha_T = 0.47) and " +
                         percent(error_at(r.curve("08b", 2), 40)) + " (0.6) against " + percent(error_at(half, 40))};
         }},
        {"8B", "the best precision is also obtained", "Of the three, finite differences with 0.63 are the best", true,
         "best: none is better by more than 0.01 % of c11 at any n. At n = 35 and 40, where its error changes sign, "
         "the "
         "analytic derivative with 0.6 is better by less",
         [](const Results& r) -> Finding {
             const Points &fd = r.curve("08b", 0), &slow = r.curve("08b", 1), &other = r.curve("08b", 2);
             return {smaller_everywhere(fd, slow, equal_errors) && smaller_everywhere(fd, other, equal_errors),
                     for_each_n({20, 40, 80}, [&](std::size_t k) {
                         const double n = std::array{20, 40, 80}[k];
                         return percent(error_at(fd, n)) + " against " + percent(error_at(slow, n)) +
                                " (analytic, 0.47) and " + percent(error_at(other, n)) + " (analytic, 0.6)";
                     })};
         }},
        {"8B", "and alpha_T = 0.6 is acceptable", "The analytic derivative with 0.6 is acceptable above n = 30", true,
         "acceptable: below 0.1 %",
         below(
             1e-3, [](const Results& r) { return largest_error(within(r.curve("08b", 2), 31, 160)); },
             [](double largest) { return "largest error " + percent(largest); })},
        {"8B", "convergence speed is, however, smaller",
         "The analytic derivative with 0.47 needs more elements than the other two", true,
         "judged by the n from which on the error stays below 0.1 %",
         [](const Results& r) -> Finding {
             const auto needed = [&](std::size_t k) { return elements_needed(r.curve("08b", k)); };
             return {needed(1) > needed(0) && needed(1) > needed(2), "n = " + number(needed(1)) + " against " +
                                                                         number(needed(2)) + " (analytic, 0.6) and " +
                                                                         number(needed(0)) + " (fd, 0.63)"};
         }},
        {"8B", "", "No order of convergence can be read from it: its error passes zero and grows again", true,
         "zero near n = 215",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{80, 160, 200, 240, 320, 640};
             std::vector<double> errors;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 errors.push_back(c11_ratio({.n = numbers[k], .derivative = analytic, .alpha_T = 0.47}) - 1);
                 return percent(errors.back());
             });
             return {errors[2] > 0 && errors[3] < 0 && errors[5] < errors[4], "error " + text};
         }},
    };
}

std::vector<Claim> tractions_of_collocation() {
    return {
        {"9", "oscillates when alpha_L = alpha_T = 1", "1/1 oscillates with either derivative, 0.5/0.5 and 0/0.63 not",
         true,
         "oscillation: total variation over range, less 1, which is 0 for a monotone traction such as Carter's; any "
         "excess above rounding (1e-9) counts",
         [](const Results&) -> Finding {
             const double closed = oscillation_of({.derivative = analytic, .alpha_L = 1, .alpha_T = 1});
             const double fd = oscillation_of({.alpha_L = 1, .alpha_T = 1});
             const double half = oscillation_of({.alpha_L = 0.5, .alpha_T = 0.5}), best_case = oscillation_of({});
             const bool holds = closed > oscillation_threshold && fd > oscillation_threshold &&
                                half < oscillation_threshold && best_case < oscillation_threshold;
             return {holds, "analytic 1/1 " + percent(closed) + ", fd 1/1 " + percent(fd) + ", fd 0.5/0.5 " +
                                percent(std::abs(half), 1) + ", fd 0/0.63 " + percent(std::abs(best_case), 1)};
         }},
        {"9", "values of parameter alpha greater than 0.9", "Oscillation sets in near alpha = 0.9 (alpha_L = alpha_T)",
         true, "near: within 0.05, for either derivative; the first alpha, by 0.01, whose traction is not monotone",
         [](const Results&) -> Finding {
             const double fd = oscillation_onset(Derivative::finite_difference), closed = oscillation_onset(analytic);
             return {std::abs(fd - 0.9) < 0.05 && std::abs(closed - 0.9) < 0.05,
                     "from " + number(fd) + " (fd) and " + number(closed) + " (analytic) on"};
         }},
        {"9", "requires using coefficients alpha_L and alpha_T smaller than 0.9",
         "A smooth traction needs both alphas below 0.9", false,
         "true of equal alphas. With alpha_L = 0, alpha decreases along the contact, and even alpha_T = 1 is smooth",
         [](const Results&) -> Finding {
             const double fd = oscillation_of({.alpha_T = 1});
             const double closed = oscillation_of({.derivative = analytic, .alpha_T = 1});
             return {std::min(fd, closed) > oscillation_threshold,
                     "oscillation of alpha_L = 0, alpha_T = 1: " + percent(std::abs(fd), 1) + " (fd), " +
                         percent(std::abs(closed), 1) + " (analytic)"};
         }},
        {"9", "equivalent to the one used by Knothe",
         "1/1 gives the tractions of Knothe and Gross-Thebing's boundary conditions", true,
         "of the elements that carry traction: n with alpha = 1 against n + 1 with the boundary conditions",
         [](const Results&) -> Finding {
             const double fd = knothe_boundary_difference(40, Derivative::finite_difference);
             const double closed = knothe_boundary_difference(40, analytic);
             return {std::max(fd, closed) < 1e-9, "largest relative difference of tractions " + number(fd, 1) +
                                                      " (fd), " + number(closed, 1) + " (analytic)"};
         }},
        {"10", "practically indistinguishable",
         "Except near the trailing edge, Carter and collocation (fd, 0/0.63) coincide", true,
         "near: the trailing tenth; indistinguishable: within 1 % of the largest traction, a line's width in the plot",
         [](const Results&) -> Finding {
             const Tractions t = tractions({});
             const double visible = visible_difference(t, -0.8, 1);
             return {visible < 0.01, percent(visible) + " of the largest traction; of the local one " +
                                         percent(t.value[20] / t.carter[20] - 1) + " in the middle, " +
                                         percent(t.value[39] / t.carter[39] - 1) + " on the leading element, " +
                                         percent(t.value[0] / t.carter[0] - 1) + " on the trailing one"};
         }},
    };
}

}  // namespace

std::vector<Claim> claims_of_collocation() {
    return all_of({kernel_and_alpha, convergence, analytic_derivative_over_alpha, analytic_derivative_over_n,
                   tractions_of_collocation});
}

}  // namespace paper
