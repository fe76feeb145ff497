// Section 6.1, dynamic stability: Figs. 18 to 21.
#include <limits>

#include <rollbem/adhesion/stability.hpp>

#include "paper/claims.hpp"

namespace paper {

namespace {

/// Whether an eigenvalue has a positive real part that rounding cannot explain, by the QZ algorithm.
bool certainly_unstable(const Case& c) { return rollbem::judge_stability(system_of(c)).certainly_unstable(); }

/// The x at which a curve becomes unstable; `never` if it does not.
double first_of(const Results& r, const std::string& panel, std::size_t k, double never = 1.5) {
    return first_positive(r.curve(panel, k)).value_or(never);
}

/// The finding holds if judge(first, before) does for every curve of all panels. `first` is where the curve becomes
/// unstable, `never` if it does not; `before` is where the curve of the coarser mesh does.
template <class Each>
Finding onsets_of(const Results& r, const std::vector<std::string>& panels, double never, const Each& judge) {
    bool holds = true;
    std::string text;
    for (const std::string& panel : panels) {
        const std::vector<Points> curves = curves_of(r, panel);
        text += say(text.empty() ? "{}: {}, {}, {}" : "; {}: {}, {}, {}", printed(panel), onset(curves[0]),
                    onset(curves[1]), onset(curves[2]));
        double before = 2;
        for (std::size_t k = 0; k < 3; ++k) {
            const double first = first_of(r, panel, k, never);
            holds = holds && judge(first, before);
            before = first;
        }
    }
    return {holds, "unstable (n = 20, 40, 60) " + text};
}

/// Whether the curves of all n in all panels are stable below `limit` - `reading`.
Finding stable_below(const Results& r, const std::vector<std::string>& panels, double limit, double reading = 0) {
    return onsets_of(r, panels, 2, [=](double first, double) { return first > limit - reading - 1e-9; });
}

/// Whether instability begins at a smaller alpha on each finer mesh.
Finding finer_is_worse(const Results& r, const std::vector<std::string>& panels) {
    return onsets_of(r, panels, 1.5, [](double first, double before) { return first < before; });
}

/// The smallest alpha_T >= 0.5, by 0.01, that is unstable beyond rounding (alpha_L = 0, collocation, fd).
double coarse_onset(Eigen::Index n) {
    for (const double alpha : fractions(50, 100, 100)) {
        const Case c = at({recommended, n}, Vary::alpha_T, alpha);
        if (unstable_count(c) > 0 && certainly_unstable(c)) return alpha;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Whether the unstable alpha_T tend to 0.5 like a power of n.
Finding tends_to_half() {
    const std::vector<Eigen::Index> numbers{20, 40, 80, 160, 240};
    Points excess;
    const Finding falls = for_all_n(numbers, "", [&](std::size_t k) -> Finding {
        const double alpha = coarse_onset(numbers[k]), before = k > 0 ? excess.back().second : 1;
        excess.emplace_back(double(numbers[k]), alpha - 0.5);
        return {alpha - 0.5 < before, number(alpha)};
    });
    const double exponent = power(excess);
    return judged(falls.holds && exponent > -1 && exponent < -0.3,
                  "smallest unstable alpha_T (by 0.01, fd) {}; excess ~ n^{2}", falls.measured, exponent);
}

/// Whether a curve leaves 0 more than once.
Finding has_islands(const Points& curve) {
    std::string text;
    int begins = 0;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        const bool before = curve[i - 1].second > 0, here = curve[i].second > 0;
        if (before == here) continue;
        begins += here;
        text += say("{}{} from {}", text.empty() ? "" : ", ", here ? "unstable" : "stable", curve[i].first);
    }
    return {begins > 1, text};
}

/// Whether the share of unstable eigenvalues does not rise as lambda falls.
Finding split_points_help(const Results& r) {
    bool holds = true;
    std::string text;
    for (const std::string panel : {"21a", "21b", "21c", "21d"}) {
        double before = 1;
        text += (text.empty() ? "" : "; ") + printed(panel);
        for (const double lambda : {1.0, 0.75, 0.5, 0.25}) {
            const double here = value_at(r.curve(panel, 2), lambda);
            holds = holds && here <= before;
            before = here;
            text += say(" {2}", here);
        }
    }
    return {holds, text};
}

/// Number of unstable cases with lambda < 0.5 on a mesh: alphas from {0, 0.25, 0.5, 0.75, 1}, not both 0, whose
/// eigenvalues are all imaginary.
struct Tally {
    int unstable = 0, all = 0;
};
Tally unstable_cases(const std::string& scheme) {
    Tally tally;
    for (const Eigen::Index n : {20, 40}) {
        for (const double alpha_L : fractions(0, 4, 4)) {
            for (const double alpha_T : fractions(0, 4, 4)) {
                for (const double lambda : {0.0, 0.1, 0.2, 0.3, 0.4, 0.49}) {
                    if (alpha_L == 0 && alpha_T == 0) continue;
                    Case c(scheme, n);
                    c.alpha_L = alpha_L;
                    c.alpha_T = alpha_T;
                    c.lambda = lambda;
                    ++tally.all;
                    if (unstable_count(c) > 0) ++tally.unstable;
                }
            }
        }
    }
    return tally;
}

}  // namespace

Claims stability_of_collocation(const Results& r) {
    return {
        {"18", "stable when alpha_L = alpha = alpha_T < 0.5", "Equal alphas below 0.5 are stable, either derivative",
         "", stable_below(r, {"18a", "18b"}, 0.5)},
        {"Sec. 6.1", "give rise to unstable solutions",
         "alpha_L = alpha_T = 1, Knothe and Gross-Thebing's scheme, is unstable", "beyond rounding",
         for_all_n(coarse, "",
                   [&](std::size_t k) -> Finding {
                       const double fraction = value_at(r.curve("18b", k), 1);
                       return judged(fraction > 0 && certainly_unstable({unit_alphas, coarse[k]}),
                                     "{%3} of the eigenvalues", fraction);
                   })},
        {"Sec. 6.1", "cases converge to the exact value", "Yet its steady results converge", "finite differences",
         falls_with_n(
             {40, 80, 160, 320}, "error ", "{%}",
             [](Eigen::Index n) {
                 return c11_ratio({unit_alphas, n}) - 1;
             },
             0.6)},
        {"19", "alpha_T < 0.7 is required", "alpha_L = 0 is stable below alpha_T = 0.7, either derivative",
         "on the curves' grid of 0.005; bisected, the analytic derivative turns unstable at 0.6985 for n = 60",
         stable_below(r, {"19a", "19b"}, 0.7)},
        {"19", "more critical for higher mesh densities", "The unstable alpha_T come down as n grows", "",
         finer_is_worse(r, {"19a", "19b"})},
        {"19", "the stability requirement approaches alpha_T < 0.5", "With many elements the limit tends to 0.5",
         "judged by the excess over 0.5: it must fall at every step of n, like a power of n between -1 and -0.3",
         tends_to_half()},
        {"19", "", "The recommended 0/0.63 is stable on coarse meshes, but not for n = 160",
         "beyond rounding; the smallest unstable alpha_T passes 0.63 there",
         for_all_n({20, 40, 80, 160}, "",
                   [](std::size_t k) -> Finding {
                       const Eigen::Index n = std::array{20, 40, 80, 160}[k];
                       const bool unstable = certainly_unstable({recommended, n});
                       return {unstable == (n == 160), unstable ? "unstable" : "stable"};
                   })},
        {"19B", "", "The unstable alpha_T do not form an interval: there are islands (n = 40, fd)",
         "judged by where the curve leaves 0 and returns to it", has_islands(r.curve("19b", 1))},
    };
}

Claims stability_of_galerkin(const Results& r) {
    const auto later = [&](const std::string& text, const std::string& own, const std::string& other,
                           const auto& judge) {
        return for_all_n(coarse, text, [&](std::size_t k) -> Finding {
            return {judge(k), onset(r.curve(own, k)) + " against " + onset(r.curve(other, k))};
        });
    };
    return {
        {"20", "stable when alpha_T < 0.85", "Galerkin, alpha_L = 0, is stable below alpha_T = 0.85",
         "within 0.02, as a limit read off a plot: at n = 60 the analytic derivative turns unstable a little earlier",
         stable_below(r, {"20a", "20b"}, 0.85, 0.02)},
        {"20", "more stable than the collocation method", "Galerkin turns unstable later than collocation", "",
         later("unstable, fd: ", "20b", "19b",
               [&](std::size_t k) {
                   return first_of(r, "20a", k) > first_of(r, "19a", k) &&
                          first_of(r, "20b", k) > first_of(r, "19b", k);
               })},
        {"20", "also more stable than the analytical calculation",
         "With Galerkin, finite differences turn unstable later than the analytic derivative", "",
         later("unstable ", "20b", "20a",
               [&](std::size_t k) {
                   const double fd = first_of(r, "20b", k), closed = first_of(r, "20a", k);
                   return fd > closed || (fd == 1.5 && closed == 1.5);
               })},
        {"20", "more critical for refined meshes", "With Galerkin, too, the unstable alpha_T come down as n grows", "",
         finer_is_worse(r, {"20a", "20b"})},
        {"20", "all eigenvalues are stable for n = 20", "Galerkin with n = 20 has no unstable alpha_T",
         "alpha_T up to 1",
         judged(!first_positive(r.curve("20a", 0)) && !first_positive(r.curve("20b", 0)), "analytic: {}; fd: {}",
                onset(r.curve("20a", 0)), onset(r.curve("20b", 0)))},
    };
}

Claims split_points(const Results& r) {
    const std::string uniform = "uniform:collocation:0/0", knothe = "knothe-0.4:collocation:0/0";
    const Tally fd = unstable_cases(uniform), closed = unstable_cases(uniform + ":analytic");
    const Tally knothe_fd = unstable_cases(knothe), knothe_closed = unstable_cases(knothe + ":analytic");
    return {
        {"21", "a tendency to stability", "Stability improves as the points of G move behind those of G'",
         "the share of unstable eigenvalues at lambda = 1, 0.75, 0.5, 0.25 must not rise, n = 60",
         split_points_help(r)},
        {"21A, 21B", "the eigenvalues are stable if lambda < 0.5",
         "The worst case, alpha_L = alpha_T = 1, is stable for lambda < 0.5", "either derivative",
         stable_below(r, {"21a", "21b"}, 0.5)},
        {"21", "guarantees stability for any alpha_L and alpha_T", "lambda < 0.5 is stable for all alphas",
         "uniform meshes; alphas 0 to 1 by 0.25 but for 0/0, whose eigenvalues are imaginary and their signs open; "
         "lambda 0 to 0.49, n = 20 and 40, collocation, either derivative",
         judged(fd.unstable + closed.unstable == 0, "{} of {} cases unstable", fd.unstable + closed.unstable,
                fd.all + closed.all)},
        {"21", "", "On Knothe and Gross-Thebing's mesh (epsilon = 0.4) that is so for finite differences alone",
         "small end elements bring their neighbours' edges near the points of the analytic derivative",
         judged(knothe_fd.unstable == 0 && knothe_closed.unstable > 0,
                "unstable cases: finite differences {}, analytic {} of {}", knothe_fd.unstable, knothe_closed.unstable,
                knothe_closed.all)},
    };
}

}  // namespace paper
