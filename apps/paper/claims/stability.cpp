// Section 6.1, dynamic stability: Figs. 18 to 21.
#include <limits>

#include "lists.hpp"

namespace paper {

namespace {

/// Whether the curves of all n in all panels are stable below `limit` - `reading`.
std::function<Finding(const Results&)> stable_below(const std::vector<std::string>& panels, double limit,
                                                    double reading = 0) {
    return [=](const Results& r) -> Finding {
        bool holds = true;
        std::string text;
        for (const std::string& panel : panels) {
            text += (text.empty() ? "" : "; ") + printed(panel) + ":";
            for (std::size_t k = 0; k < 3; ++k) {
                const Points& curve = r.curve(panel, k);
                holds = holds && first_positive(curve).value_or(2) > limit - reading - 1e-9;
                text += (k > 0 ? ", " : " ") + onset(curve);
            }
        }
        return {holds, "unstable (n = 20, 40, 60) " + text};
    };
}

/// Whether instability begins at a smaller alpha on each finer mesh.
std::function<Finding(const Results&)> finer_is_worse(const std::vector<std::string>& panels) {
    return [panels](const Results& r) -> Finding {
        bool holds = true;
        std::string text;
        for (const std::string& panel : panels) {
            double before = 2;
            text += (text.empty() ? "" : "; ") + printed(panel) + ":";
            for (std::size_t k = 0; k < 3; ++k) {
                const double here = first_positive(r.curve(panel, k)).value_or(1.5);
                holds = holds && here < before;
                before = here;
                text += (k > 0 ? ", " : " ") + onset(r.curve(panel, k));
            }
        }
        return {holds, "unstable (n = 20, 40, 60) " + text};
    };
}

/// The smallest alpha_T >= 0.5, by 0.01, that is unstable beyond rounding (alpha_L = 0, collocation, fd).
double coarse_onset(Eigen::Index n) {
    for (const double alpha : fractions(50, 100, 100)) {
        const Case c{.n = n, .alpha_T = alpha};
        if (unstable_count(c) > 0 && certainly_unstable(c)) return alpha;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Number of unstable cases with lambda < 0.5 on a mesh: alphas from {0, 0.25, 0.5, 0.75, 1}, not both 0.
struct Tally {
    int unstable = 0, all = 0;
};
Tally unstable_cases(const Case& on, const std::vector<Derivative>& derivatives) {
    Tally tally;
    for (const Derivative derivative : derivatives) {
        for (const Eigen::Index n : {20, 40}) {
            for (const double alpha_L : fractions(0, 4, 4)) {
                for (const double alpha_T : fractions(0, 4, 4)) {
                    for (const double lambda : {0.0, 0.1, 0.2, 0.3, 0.4, 0.49}) {
                        if (alpha_L == 0 && alpha_T == 0) continue;  // marginal: all eigenvalues are imaginary
                        Case c = on;
                        c.n = n;
                        c.derivative = derivative;
                        c.alpha_L = alpha_L;
                        c.alpha_T = alpha_T;
                        c.lambda = lambda;
                        ++tally.all;
                        if (unstable_count(c) > 0) ++tally.unstable;
                    }
                }
            }
        }
    }
    return tally;
}

std::vector<Claim> positions() {
    return {
        {"18", "stable when alpha_L = alpha = alpha_T < 0.5", "Equal alphas below 0.5 are stable, either derivative",
         true, "", stable_below({"18a", "18b"}, 0.5)},
        {"Sec. 6.1", "give rise to unstable solutions",
         "alpha_L = alpha_T = 1, Knothe and Gross-Thebing's scheme, is unstable", true, "beyond rounding",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 const double fraction = value_at(r.curve("18b", k), 1);
                 holds = holds && fraction > 0 && certainly_unstable({.n = coarse[k], .alpha_L = 1, .alpha_T = 1});
                 return percent(fraction, 3) + " of the eigenvalues";
             });
             return {holds, text};
         }},
        {"Sec. 6.1", "cases converge to the exact value", "Yet its steady results converge", true, "finite differences",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{40, 80, 160, 320};
             double before = 1;
             bool holds = true;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 const double error = c11_ratio({.n = numbers[k], .alpha_L = 1, .alpha_T = 1}) - 1;
                 holds = holds && std::abs(error) < 0.6 * std::abs(before);
                 before = error;
                 return percent(error);
             });
             return {holds, "error " + text};
         }},
        {"19", "alpha_T < 0.7 is required", "alpha_L = 0 is stable below alpha_T = 0.7, either derivative", true,
         "on the curves' grid of 0.005; bisected, the analytic derivative turns unstable at 0.6985 for n = 60",
         stable_below({"19a", "19b"}, 0.7)},
        {"19", "more critical for higher mesh densities", "The unstable alpha_T come down as n grows", true, "",
         finer_is_worse({"19a", "19b"})},
        {"19", "the stability requirement approaches alpha_T < 0.5", "With many elements the limit tends to 0.5", true,
         "judged by the excess over 0.5: it must fall at every step of n, like a power of n between -1 and -0.3",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{20, 40, 80, 160, 240};
             Points excess;
             bool holds = true;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 const double alpha = coarse_onset(numbers[k]);
                 if (k > 0 && !(alpha - 0.5 < excess.back().second)) holds = false;
                 excess.emplace_back(double(numbers[k]), alpha - 0.5);
                 return number(alpha);
             });
             const double exponent = power(excess);
             return {holds && exponent > -1 && exponent < -0.3,
                     "smallest unstable alpha_T (by 0.01, fd) " + text + "; excess ~ n^" + number(exponent, 2)};
         }},
        {"19", "", "The recommended 0/0.63 is stable on coarse meshes, but not for n = 160", true,
         "beyond rounding; the smallest unstable alpha_T passes 0.63 there",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{20, 40, 80, 160};
             bool holds = true;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 const bool unstable = certainly_unstable({.n = numbers[k]});
                 holds = holds && unstable == (numbers[k] == 160);
                 return std::string(unstable ? "unstable" : "stable");
             });
             return {holds, text};
         }},
        {"19B", "", "The unstable alpha_T do not form an interval: there are islands (n = 40, fd)", true,
         "judged by where the curve leaves 0 and returns to it",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("19b", 1);
             std::string text;
             int begins = 0;
             for (std::size_t i = 1; i < curve.size(); ++i) {
                 const bool before = curve[i - 1].second > 0, here = curve[i].second > 0;
                 if (before == here) continue;
                 begins += here;
                 text += (text.empty() ? "" : ", ") + std::string(here ? "unstable" : "stable") + " from " +
                         number(curve[i].first);
             }
             return {begins > 1, text};
         }},
    };
}

std::vector<Claim> galerkin_and_split_points() {
    return {
        {"20", "stable when alpha_T < 0.85", "Galerkin, alpha_L = 0, is stable below alpha_T = 0.85", true,
         "within 0.02, as a limit read off a plot: at n = 60 the analytic derivative turns unstable a little earlier",
         stable_below({"20a", "20b"}, 0.85, 0.02)},
        {"20", "more stable than the collocation method", "Galerkin turns unstable later than collocation", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 for (const char derivative : {'a', 'b'}) {
                     const std::string letter(1, derivative);
                     holds = holds && first_positive(r.curve("20" + letter, k)).value_or(1.5) >
                                          first_positive(r.curve("19" + letter, k)).value_or(1.5);
                 }
                 return onset(r.curve("20b", k)) + " against " + onset(r.curve("19b", k));
             });
             return {holds, "unstable, fd: " + text};
         }},
        {"20", "also more stable than the analytical calculation",
         "With Galerkin, finite differences turn unstable later than the analytic derivative", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 const double fd = first_positive(r.curve("20b", k)).value_or(1.5);
                 const double closed = first_positive(r.curve("20a", k)).value_or(1.5);
                 holds = holds && (fd > closed || (fd == 1.5 && closed == 1.5));
                 return onset(r.curve("20b", k)) + " against " + onset(r.curve("20a", k));
             });
             return {holds, "unstable " + text};
         }},
        {"20", "more critical for refined meshes", "With Galerkin, too, the unstable alpha_T come down as n grows",
         true, "", finer_is_worse({"20a", "20b"})},
        {"20", "all eigenvalues are stable for n = 20", "Galerkin with n = 20 has no unstable alpha_T", true,
         "alpha_T up to 1",
         [](const Results& r) -> Finding {
             const bool holds = !first_positive(r.curve("20a", 0)) && !first_positive(r.curve("20b", 0));
             return {holds, "analytic: " + onset(r.curve("20a", 0)) + "; fd: " + onset(r.curve("20b", 0))};
         }},
        {"21", "a tendency to stability", "Stability improves as the points of G move behind those of G'", true,
         "the share of unstable eigenvalues at lambda = 1, 0.75, 0.5, 0.25 must not rise, n = 60",
         [](const Results& r) -> Finding {
             bool holds = true;
             std::string text;
             for (const std::string panel : {"21a", "21b", "21c", "21d"}) {
                 double before = 1;
                 text += (text.empty() ? "" : "; ") + printed(panel);
                 for (const double lambda : {1.0, 0.75, 0.5, 0.25}) {
                     const double here = value_at(r.curve(panel, 2), lambda);
                     holds = holds && here <= before;
                     before = here;
                     text += ' ';
                     text += number(here, 2);
                 }
             }
             return {holds, text};
         }},
        {"21A, 21B", "the eigenvalues are stable if lambda < 0.5",
         "The worst case, alpha_L = alpha_T = 1, is stable for lambda < 0.5", true, "either derivative",
         stable_below({"21a", "21b"}, 0.5)},
        {"21", "guarantees stability for any alpha_L and alpha_T", "lambda < 0.5 is stable for all alphas", true,
         "uniform meshes; alphas 0 to 1 by 0.25 but for 0/0, whose eigenvalues are imaginary and their signs open; "
         "lambda 0 to 0.49, n = 20 and 40, collocation, either derivative",
         [](const Results&) -> Finding {
             const Tally tally = unstable_cases({}, {Derivative::finite_difference, Derivative::analytic});
             return {tally.unstable == 0,
                     std::to_string(tally.unstable) + " of " + std::to_string(tally.all) + " cases unstable"};
         }},
        {"21", "", "On Knothe and Gross-Thebing's mesh (epsilon = 0.4) that is so for finite differences alone", true,
         "small end elements bring their neighbours' edges near the points of the analytic derivative",
         [](const Results&) -> Finding {
             const Case knothe{.mesh = Topology::knothe, .grading = 0.4};
             const Tally closed = unstable_cases(knothe, {Derivative::analytic});
             const Tally fd = unstable_cases(knothe, {Derivative::finite_difference});
             return {fd.unstable == 0 && closed.unstable > 0,
                     "unstable cases: finite differences " + std::to_string(fd.unstable) + ", analytic " +
                         std::to_string(closed.unstable) + " of " + std::to_string(closed.all)};
         }},
    };
}

}  // namespace

std::vector<Claim> claims_of_stability() { return all_of({positions, galerkin_and_split_points}); }

}  // namespace paper
