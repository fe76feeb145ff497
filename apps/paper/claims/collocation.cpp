// Section 5.1, collocation in steady rolling: Eq. (31), Figs. 3 and 5 to 10.
#include <algorithm>
#include <limits>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "paper/claims.hpp"

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

/// Order of convergence from n = 160 to 640.
double order_of(const std::string& scheme) {
    Points errors;
    for (const Eigen::Index n : {160, 320, 640}) errors.emplace_back(double(n), c11_ratio({scheme, n}) - 1);
    return -power(errors);
}

/// Oscillation of a steady traction; Carter's is monotone. Anything above rounding counts.
constexpr double oscillation_threshold = 1e-9;
constexpr const char* analytic = ":analytic";  // in place of finite differences

double oscillation_of(const Case& c) { return oscillation(tractions(c).value); }

/// Largest difference between the tractions by Knothe and Gross-Thebing's boundary conditions on 41 elements and by
/// collocation with alpha = 1 on 40, over the largest traction (plane kernel, which has no length scale).
double knothe_boundary_difference(const std::string& derivative) {
    const auto unknowns = [](const Case& c) {
        const study::Scene scene = scene_of(c, rollbem::LineModel::plane);
        return rollbem::solve_steady(*scene.mesh, scene.scheme, scene.kernel).unknowns;
    };
    return relative_difference(unknowns({"uniform:knothe-bc" + derivative, 41}), unknowns({unit_alphas + derivative}));
}

/// The smallest alpha_L = alpha_T >= 0.5, by 0.01, whose traction is not monotone; infinite if there is none.
double oscillation_onset(const std::string& derivative) {
    for (const double alpha : fractions(50, 100, 100)) {
        if (oscillation_of(at(half_alphas + derivative, Vary::both_alphas, alpha)) > oscillation_threshold)
            return alpha;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

Claims kernel_and_alpha(const Results& r) {
    const double of_ellipse =
        c11_ratio({recommended, 160}) * rollbem::steady_c11(poisson_ratio) / rollbem::ellipse_limit_c11(poisson_ratio);
    const auto slope = [](double distance) { return std::abs(element_field(0.5 + distance).slope); };
    const double far = slope(1e-3), near = slope(1e-6), nearer = slope(1e-9);
    return {
        {"Eq. 31", "closed form solution for the 2D problem", "c11 = pi^2/(4(1-nu)) belongs to Eq. (30)",
         "pi^2/(4(1-nu)) is Kalker's limit for a long ellipse. Eq. (30) for a rectangle gives pi/(2(1-nu)), to which "
         "all ratios here refer",
         judged(std::abs(of_ellipse - 1) < 0.01, "c11* at n = 160 is {5} of it (2/pi = 0.63662)", of_ellipse), false},
        {"3", "tends to infinity at the element border", "du/dx of one element is singular at its edges",
         "logarithmic: the same increase for each factor of distance",
         judged(near > far && std::abs((nearer - near) / (near - far) - 1) < 0.01,
                "|du/dx| G/p at 1e-3, 1e-6, 1e-9 dx from it: {}, {}, {}", far, near, nearer)},
        {"5A", "maximal accuracy for alpha = 0.5", "alpha_L = alpha_T is most accurate at 0.5 (n = 40)",
         "Kalker's choice in CONTACT", best_alpha(r, "05a", {40}, 0.5, {}, Vary::both_alphas, {0.4, 0.6})},
        {"5A", "the less accurate strategy", "alpha_T = 0 is the least accurate of the three ways", "",
         best_of(r, "05a", 2, true)},
        {"5A", "the more precise", "alpha_L = 0 is the most accurate of the three ways", "", best_of(r, "05a", 1)},
        {"5A", "an optimal result when alpha_T = 0.63", "alpha_L = 0 is most accurate at alpha_T = 0.63 (n = 40)", "",
         best_alpha(r, "05b", {40}, 0.63, {}, Vary::alpha_T, {0.5, 0.7})},
        {"5B", "independently of the number of elements",
         "alpha_L = 0, alpha_T = 0.63 is optimal for n = 40, 60 and 80",
         "optimal: the least error of the grid (by 0.05, and 0.63), or within 0.02 of the true optimum. The smallest "
         "error that the paper speaks of, 0.01 %, cannot decide: at n = 80 the errors of both 0.6 and 0.63 are below "
         "it",
         best_alpha(r, "05b", fine, 0.63, {}, Vary::alpha_T, {0.5, 0.7})},
        {"5B", "alpha_L = alpha and alpha_T = 0", "The scheme of the caption is optimal at alpha = 0.63",
         "the indices are swapped: the text says alpha_L = 0",
         errs_least_at(0.63, paper_alphas(),
                       [](Eigen::Index n, double x) {
                           return ratio_at({"uniform:collocation:0/0", n}, Vary::alpha_L, x);
                       }),
         false},
        {"5B", "", "The alpha_T without error falls as n grows",
         "it is a zero crossing of the error; from n = 60 on it is nearer to 0.6 than to 0.63",
         falls_with_n({20, 40, 60, 80, 160, 320}, "", "{4}",
                      [](Eigen::Index n) {
                          return optimum_of({}, n, Vary::alpha_T, {0.5, 0.7});
                      })},
    };
}

Claims convergence(const Results& r) {
    const std::vector<Points> fd = curves_of(r, "06a"), closed = curves_of(r, "06b");
    bool converges = true, worse = true;
    std::string errors;
    double least = 1, largest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double before = std::abs(error_at(fd[k], 80)), after = std::abs(error_at(fd[k], 160));
        converges = converges && after < before && after < 2e-3;
        errors += say(k > 0 ? "; {%} to {%}" : "{%} to {%}", before, after);
        least = std::min(least, std::abs(error_at(closed[k], 40)));
        largest = std::max(largest, std::abs(error_at(fd[k], 40)));
        for (const Points& other : closed) worse = worse && smaller_everywhere(fd[k], other);
    }
    const double own = elements_needed(fd[2]), other = elements_needed(fd[0]);
    const double order = order_of(recommended), equal_order = order_of(half_alphas);
    const auto error_of = [&](double n) { return error_at(fd[2], n); };
    return {
        {"6A", "all the cases converge to the exact solution", "The errors of the three schemes tend to 0", "",
         judged(converges, "from n = 80 to 160: {}", errors)},
        {"6A", "the rate of convergence is bigger",
         "alpha_L = 0, alpha_T = 0.63 comes close to the exact value with fewer elements than 0.5/0.5",
         "judged by the n from which on the error stays below 0.1 %",
         judged(own < other, "n = {} against {}; at n = 40 the error is {%} against {%}", own, other, error_of(40),
                error_at(fd[0], 40))},
        {"6A", "", "Its order of convergence is no larger: both schemes are of first order",
         "the error of 0/0.63 passes zero near n = 20 and grows up to n = 40 before it decays",
         judged(order < equal_order + 0.05, "order from n = 160 to 640: {2} against {2}", order, equal_order)},
        {"6A", "Errors smaller than 0.01%", "0/0.63 has an error below 0.01 % at n = 20", "",
         judged(std::abs(error_of(20)) < 1e-4, "{%} (n = 40: {%}, n = 80: {%})", error_of(20), error_of(40),
                error_of(80))},
        {"6B", "less precise than the ones presented in Fig. 6.A",
         "The analytic derivative (0/0.4, 0.4/0, 0.4/0.4) is less accurate than finite differences in Fig. 6A",
         "every scheme against every scheme, at every n",
         judged(worse, "n = 40: at least {%} against at most {%}", least, largest)},
    };
}

namespace {

/// Whether [0.4, 0.6] has the smallest mean errors of the curves with an alpha of zero.
Finding best_in_the_middle(const Results& r) {
    bool holds = true;
    std::string text;
    for (const std::size_t k : {std::size_t(1), std::size_t(2)}) {
        const Points grid = on_paper_alphas(r, "07a")[k];
        const double inside = mean_error(within(grid, 0.4, 0.6));
        const double below = mean_error(within(grid, 0.05, 0.35)), above = mean_error(within(grid, 0.65, 1));
        holds = holds && inside < below && inside < above;
        text += say("{}: {%} ({%} below, {%} above)", k == 1 ? "alpha_L = 0" : "; alpha_T = 0", inside, below, above);
    }
    return {holds, text};
}

/// Whether the curve alpha_L = 0 meets 1 twice where the status accepts the tractions as full adhesion.
Finding meets_one_twice(const Results& r) {
    std::string consistent, other;
    int count = 0;
    for (const double alpha : crossings(r.curve("07a", 1))) {
        const bool counts =
            steady(at(std::string(recommended) + analytic, Vary::alpha_T, alpha)).status == rollbem::Status::ok;
        count += counts;
        (counts ? consistent : other) += " " + number(alpha);
    }
    return {count == 2, "at alpha_T =" + consistent + (other.empty() ? "" : "; not counted:" + other)};
}

}  // namespace

Claims analytic_derivative_over_alpha(const Results& r) {
    const Points& over_alpha = r.curve("07a", 0);
    const double at_half = std::abs(error_at(over_alpha, 0.5)), before = std::abs(error_at(over_alpha, 0.45)),
                 after = std::abs(error_at(over_alpha, 0.55));
    std::vector<Points> high;
    Points densities;
    for (std::size_t k = 0; k < 3; ++k) {
        high.push_back(within(r.curve("07a", k), 0.705, 1));
        densities.emplace_back(double(fine[k]), value_at(r.curve("07b", k), 0.5));
    }
    return {
        {"7A", "a minimum of precision at alpha = 0.5", "alpha_L = alpha_T is at its worst at 0.5", "",
         judged(at_half > before && at_half > after, "error {%} at 0.5, {%} at 0.45, {%} at 0.55", at_half, before,
                after)},
        {"7A", "more accurate in the range", "With alpha_L or alpha_T zero, [0.4, 0.6] is the best part of alpha",
         "judged by the mean error inside, below and above", best_in_the_middle(r)},
        {"7A", "When alpha > 0.7 the results are more accurate", "Above alpha = 0.7 alpha_L = 0 is the most accurate",
         "",
         judged(smaller_everywhere(high[1], high[0]) && smaller_everywhere(high[1], high[2]),
                "at 0.85: alpha_L = 0 {%}, equal {%}, alpha_T = 0 {%}", error_at(high[1], 0.85),
                error_at(high[0], 0.85), error_at(high[2], 0.85))},
        {"7A", "fits the theoretical one c11 in two points", "The curve alpha_L = 0 meets 1 twice (n = 40)",
         "counted where tractions are consistent with full adhesion; near alpha_T = 0, where they zigzag, c11* rises "
         "from 0 through 1",
         meets_one_twice(r)},
        {"7B", "approximately alpha_T = 0.6", "One of the two stays there whatever n", "approximately: within 0.02",
         for_all_n(fine, "",
                   [&](std::size_t k) -> Finding {
                       const std::vector<double> found = crossings(r.curve("07b", k));
                       if (found.empty()) return {false, "none"};
                       return {std::abs(found.back() - 0.6) <= 0.02, number(found.back())};
                   })},
        {"7B", "not very sensitive to the mesh density", "Near alpha_T = 0.5 the error hardly depends on n",
         "judged by the spread over n = 40, 60, 80 against the error itself: less than half",
         judged(spread(densities) < largest_error(densities) / 2, "error {}",
                for_each_n(fine, [&](std::size_t k) { return percent(densities[k].second - 1); }))},
    };
}

Claims analytic_derivative_over_n(const Results& r) {
    const Points &half_fd = r.curve("08a", 0), &half = r.curve("08a", 1);
    const Points &fd = r.curve("08b", 0), &slow = r.curve("08b", 1), &other = r.curve("08b", 2);
    const double own = elements_needed(slow), needed = elements_needed(other), needed_fd = elements_needed(fd);
    std::vector<double> errors;
    const std::string far = for_each_n({80, 160, 200, 240, 320, 640}, [&](std::size_t k) {
        const Eigen::Index n = std::array{80, 160, 200, 240, 320, 640}[k];
        errors.push_back(c11_ratio({"uniform:collocation:0/0.47:analytic", n}) - 1);
        return percent(errors.back());
    });
    return {
        {"8A", "gives better results than the exact calculation",
         "At alpha_L = alpha_T = 0.5 finite differences are better than the analytic derivative", "at every n",
         judged(smaller_everywhere(half_fd, half), "n = 40: {%} against {%}", error_at(half_fd, 40),
                error_at(half, 40))},
        {"8B", "better than the results in Fig. 8.A",
         "The analytic derivative with alpha_L = 0 is more accurate than with 0.5/0.5", "at every n",
         judged(smaller_everywhere(slow, half) && smaller_everywhere(other, half),
                "n = 40: {%} (alpha_T = 0.47) and {%} (0.6) against {%}", error_at(slow, 40), error_at(other, 40),
                error_at(half, 40))},
        {"8B", "the best precision is also obtained", "Of the three, finite differences with 0.63 are the best",
         "best: none is better by more than 0.01 % of c11 at any n. At n = 35 and 40, where its error changes sign, "
         "the analytic derivative with 0.6 is better by less",
         judged(smaller_everywhere(fd, slow, equal_errors) && smaller_everywhere(fd, other, equal_errors), "{}",
                for_each_n({20, 40, 80},
                           [&](std::size_t k) {
                               const double n = std::array{20, 40, 80}[k];
                               return say("{%} against {%} (analytic, 0.47) and {%} (analytic, 0.6)", error_at(fd, n),
                                          error_at(slow, n), error_at(other, n));
                           }))},
        {"8B", "and alpha_T = 0.6 is acceptable", "The analytic derivative with 0.6 is acceptable above n = 30",
         "acceptable: below 0.1 %", below(1e-3, largest_error(within(other, 31, 160)), "largest error {%}")},
        {"8B", "convergence speed is, however, smaller",
         "The analytic derivative with 0.47 needs more elements than the other two",
         "judged by the n from which on the error stays below 0.1 %",
         judged(own > needed_fd && own > needed, "n = {} against {} (analytic, 0.6) and {} (fd, 0.63)", own, needed,
                needed_fd)},
        {"8B", "", "No order of convergence can be read from it: its error passes zero and grows again",
         "zero near n = 215", judged(errors[2] > 0 && errors[3] < 0 && errors[5] < errors[4], "error {}", far)},
    };
}

Claims tractions_of_collocation(const Results&) {
    const double closed = oscillation_of(unit_alphas + analytic), fd = oscillation_of(unit_alphas);
    const double half = oscillation_of(half_alphas), best_case = oscillation_of({});
    const double from_fd = oscillation_onset(""), from = oscillation_onset(analytic);
    const double leading = oscillation_of({"uniform:collocation:0/1"});
    const double leading_closed = oscillation_of({"uniform:collocation:0/1:analytic"});
    const double knothe = knothe_boundary_difference(""), knothe_closed = knothe_boundary_difference(analytic);
    const Tractions t = tractions({});
    const auto excess = [&](Eigen::Index i) { return t.value[i] / t.carter[i] - 1; };
    const double visible = from_carter(t, -0.8, 1).visible, local = from_carter(t, -0.8, 0.8).local;
    return {
        {"9", "oscillates when alpha_L = alpha_T = 1", "1/1 oscillates with either derivative, 0.5/0.5 and 0/0.63 not",
         "oscillation: total variation over range, less 1, which is 0 for a monotone traction such as Carter's; any "
         "excess above rounding (1e-9) counts",
         judged(std::min(closed, fd) > oscillation_threshold && std::max(half, best_case) < oscillation_threshold,
                "analytic 1/1 {%}, fd 1/1 {%}, fd 0.5/0.5 {%1}, fd 0/0.63 {%1}", closed, fd, std::abs(half),
                std::abs(best_case))},
        {"9", "values of parameter alpha greater than 0.9", "Oscillation sets in near alpha = 0.9 (alpha_L = alpha_T)",
         "near: within 0.05, for either derivative; the first alpha, by 0.01, whose traction is not monotone",
         judged(std::abs(from_fd - 0.9) < 0.05 && std::abs(from - 0.9) < 0.05, "from {} (fd) and {} (analytic) on",
                from_fd, from)},
        {"9", "requires using coefficients alpha_L and alpha_T smaller than 0.9",
         "A smooth traction needs both alphas below 0.9",
         "true of equal alphas. With alpha_L = 0, alpha decreases along the contact, and even alpha_T = 1 is smooth",
         judged(std::min(leading, leading_closed) > oscillation_threshold,
                "oscillation of alpha_L = 0, alpha_T = 1: {%1} (fd), {%1} (analytic)", std::abs(leading),
                std::abs(leading_closed)),
         false},
        {"9", "equivalent to the one used by Knothe",
         "1/1 gives the tractions of Knothe and Gross-Thebing's boundary conditions",
         "of the elements that carry traction: n with alpha = 1 against n + 1 with the boundary conditions",
         judged(std::max(knothe, knothe_closed) < 1e-9,
                "largest relative difference of tractions {1} (fd), {1} (analytic)", knothe, knothe_closed)},
        {"10", "practically indistinguishable",
         "Except near the trailing edge, Carter and collocation (fd, 0/0.63) coincide",
         "near: the trailing tenth; indistinguishable: within 1 % of the largest traction, a line's width in the plot, "
         "and within 5 % of the local one for |x| < 0.8 a. On the leading element a line's width is nearly the whole "
         "traction and hides the difference",
         judged(
             visible < 0.01 && local < 0.05,
             "{%} of the largest traction, {%} of the local one for |x| < 0.8 a; {%} in the middle, {%} on the leading "
             "element, {%} on the trailing one",
             visible, local, excess(20), excess(39), excess(0))},
    };
}

}  // namespace paper
