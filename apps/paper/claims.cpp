// The claims of the paper's sections 5 to 7, in its order.
#include "claims.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>
#include <gsl/gsl_integration.h>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/polynomial.hpp>
#include <rollbem/reference/bessel.hpp>

#include "evaluate.hpp"
#include "figures.hpp"
#include "measures.hpp"

namespace paper {

namespace {

/// "n = 40: a; n = 60: b" with text(k) for every number of elements.
template <class Text>
std::string for_each_n(const std::vector<Eigen::Index>& numbers, const Text& text) {
    std::string result;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        result += (k > 0 ? "; n = " : "n = ") + std::to_string(numbers[k]) + ": " + text(k);
    }
    return result;
}

std::vector<double> paper_alphas() {
    std::vector<double> grid = fractions(0, 20, 20);
    grid.push_back(0.63);
    return grid;
}

const std::vector<Eigen::Index> fine{40, 60, 80}, coarse{20, 40, 60};

/// Least |c11*/c11 - 1| of a curve on the paper's kind of grid.
double least_error_on_grid(const Points& points) { return least_error(on_grid(points, paper_alphas())); }

std::string onset(const Points& points) {
    const std::optional<double> first = first_positive(points);
    return first ? "from " + number(*first) : "none";
}

/// Whether nothing is unstable below `limit`.
bool stable_below(const Points& points, double limit) {
    const std::optional<double> first = first_positive(points);
    return !first || *first > limit - 1e-9;
}

Finding optimum(const Points& points, double claimed, const std::function<double(double)>& ratio, double low,
                double high) {
    const auto [x, y] = best(points);
    const double optimum = true_optimum(ratio, low, high), error = ratio(optimum) - 1;
    return {std::abs(x - claimed) < 1e-9, "best of the grid " + number(x) + " (error " + percent(y - 1) +
                                              "); true optimum " + number(optimum, 4) +
                                              (std::abs(error) < 1e-8 ? " (no error)" : " (" + percent(error) + ")")};
}

std::function<double(double)> ratio_over(Case c, Vary vary) {
    return [=](double x) { return c11_ratio(at({"", c, vary}, x)); };
}

/// "best error a, b, c" of three curves of a panel on the paper's grid.
std::array<double, 3> three_errors(const Results& r, const std::string& figure) {
    return {least_error_on_grid(r.curve(figure, 0)), least_error_on_grid(r.curve(figure, 1)),
            least_error_on_grid(r.curve(figure, 2))};
}
std::string three_texts(const std::array<double, 3>& errors) {
    return "least error on the grid: alpha_L = alpha_T " + percent(errors[0]) + ", alpha_L = 0 " + percent(errors[1]) +
           ", alpha_T = 0 " + percent(errors[2]);
}

/// The errors of a curve over n from `least` on, as points (n, error).
Points errors_from(const Points& points, double least) {
    Points result;
    for (const auto& [n, ratio] : points) {
        if (n > least - 0.5) result.emplace_back(n, ratio - 1);
    }
    return result;
}

/// Whether the error of `better` is the smaller one at every x >= least.
bool smaller_everywhere(const Points& better, const Points& worse, double least = 0) {
    for (std::size_t i = 0; i < better.size(); ++i) {
        const bool smaller = std::abs(better[i].second - 1) < std::abs(worse[i].second - 1);
        if (better[i].first > least && !smaller) return false;
    }
    return true;
}

/// Oscillation of a steady traction: how far it is from monotone, which Carter's is. Anything above rounding counts.
constexpr double oscillation_threshold = 1e-9;
double oscillation_of(const Case& c) { return oscillation(tractions(c).value); }

/// Whether, on the grid of 0.05, tractions with alpha_L = alpha_T oscillate above 0.9 and nowhere from 0.5 up to it.
Finding oscillation_onset(Derivative derivative) {
    const auto measure = [&](double alpha) {
        return oscillation_of({.derivative = derivative, .alpha_L = alpha, .alpha_T = alpha});
    };
    bool holds = true;
    for (const double alpha : fractions(10, 20, 20)) {
        holds = holds && (measure(alpha) > oscillation_threshold) == (alpha > 0.901);
    }
    std::string onset = "nowhere";
    for (const double alpha : fractions(50, 100, 100)) {
        if (measure(alpha) <= oscillation_threshold) continue;
        onset = "from " + number(alpha) + " on";
        break;
    }
    return {holds, "not monotone " + onset + " (by 0.01); total variation exceeds the range by " +
                       percent(measure(0.9)) + " at 0.9, " + percent(measure(0.95)) + " at 0.95, " +
                       percent(measure(1)) + " at 1"};
}

/// Largest difference from Carter's traction at centres between two x/a, over the largest traction: what a plot shows.
double visible_difference(const Tractions& t, double trailing, double leading) {
    const Eigen::ArrayXd difference = (t.value - t.carter).abs() / t.value.abs().maxCoeff();
    return (t.x > trailing && t.x < leading).select(difference, 0.0).maxCoeff();
}

/// Largest relative difference of the harmonic c11 from the polynomial approach of order 20.
double harmonic_error(const Case& c, const std::vector<double>& z) {
    const std::vector<std::complex<double>> c11 = harmonic_c11(c, z);
    double result = 0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const std::complex<double> reference = detail::polynomial_c11(z[i]);
        result = std::max(result, std::abs(c11[i] - reference) / std::abs(reference));
    }
    return result;
}

/// Largest relative error of a function of frequency against the closed form in Bessel functions.
template <class Function>
double largest_c11_error(const Function& c11, const std::vector<double>& z) {
    double result = 0;
    for (const double frequency : z) {
        const std::complex<double> exact = rollbem::reference::harmonic_c11(frequency, poisson_ratio, aspect);
        result = std::max(result, std::abs(c11(frequency) - exact) / std::abs(exact));
    }
    return result;
}

/// c11 from Eqs. (25) to (27) exactly as printed, that is without the factor l of d(x/a)^l/dx.
std::complex<double> c11_as_printed(double z, Eigen::Index order) {
    const Eigen::MatrixXcd B = rollbem::displacement_matrix(order, poisson_ratio, aspect).cast<std::complex<double>>();
    Eigen::MatrixXcd equations(order + 1, order + 1);
    for (Eigen::Index l = 0; l < order; ++l) {
        equations.row(l) = (B.col(l + 1) - std::complex<double>(0, z) * B.col(l)).transpose();
    }
    equations.row(order).setOnes();
    const Eigen::VectorXcd right = Eigen::VectorXcd::Unit(order + 1, 0);
    const Eigen::VectorXcd coefficients = Eigen::PartialPivLU<Eigen::MatrixXcd>(equations).solve(right);
    const Eigen::VectorXd moments = rollbem::monomial_moments<double>(order);
    return -std::numbers::pi * (moments.cast<std::complex<double>>().array() * coefficients.array()).sum();
}

std::vector<double> frequencies_of_fig_22() { return logarithmic(1e-3, 5, 75); }

/// The smallest alpha_T >= 0.5, by 0.01, that is unstable beyond rounding (alpha_L = 0, collocation, fd).
double coarse_onset(Eigen::Index n) {
    for (const double alpha : fractions(50, 100, 100)) {
        const Case c{.n = n, .alpha_T = alpha};
        if (unstable_count(c) > 0 && certainly_unstable(c)) return alpha;
    }
    return std::numeric_limits<double>::quiet_NaN();
}

/// Number of unstable cases of all with lambda < 0.5 on a mesh: alphas from {0, 0.25, 0.5, 0.75, 1} but not both 0.
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

double cost_ratio(const Case& c) {
    double own = std::numeric_limits<double>::infinity(), collocation = own;
    for (int run = 0; run < 5; ++run) {  // alternating, the shortest of each: calm on a busy machine
        collocation = std::min(collocation, steady_time_us({.n = c.n}));
        own = std::min(own, steady_time_us(c));
    }
    return own / collocation;
}

std::string times(double ratio) { return number(ratio, 2) + " times the time of collocation"; }

/// The cases of Fig. 17.
Case traction_case(Topology mesh) { return {.alpha_L = 0.5, .alpha_T = 0.5, .mesh = mesh, .grading = 0.4}; }

/// Difference of the leading element's traction from Carter's at its centre, over the latter.
double leading_excess(const Case& c) {
    const Tractions t = tractions(c);
    return t.value[c.n - 1] / t.carter[c.n - 1] - 1;
}

std::vector<Claim> claims_of_steady_collocation() {
    constexpr Derivative analytic = Derivative::analytic;
    std::vector<Claim> claims{
        {"Eq. 31", "c11 of the two-dimensional problem has the closed form pi^2/(4(1-nu))", "pi^2/(4(1-nu))", false,
         "this is Kalker's limit for an ellipse; Eq. (30) for a rectangle gives pi/(2(1-nu)), to which all ratios "
         "refer",
         [](const Results&) -> Finding {
             const double ratio =
                 c11_ratio({.n = 160}) * rollbem::steady_c11(poisson_ratio) / rollbem::ellipse_limit_c11(poisson_ratio);
             return {std::abs(ratio - 1) < 0.01, "c11* at n = 160 is " + number(ratio, 5) + " of it (2/pi = 0.63662)"};
         }},
        {"3", "The derivative of the displacement tends to infinity at the element's border", "singular at dx/2", true,
         "logarithmic: the same increase for each factor of distance",
         [](const Results&) -> Finding {
             const double far = std::abs(element_field(0.5 + 1e-3).slope);
             const double near = std::abs(element_field(0.5 + 1e-6).slope);
             const double nearer = std::abs(element_field(0.5 + 1e-9).slope);
             const bool grows = near > far && std::abs((nearer - near) / (near - far) - 1) < 0.01;
             return {grows, "|du/dx| G/p at 1e-3, 1e-6, 1e-9 dx from it: " + number(far) + ", " + number(near) + ", " +
                                number(nearer)};
         }},
        {"5A", "alpha_L = alpha_T is most accurate at 0.5 (n = 40)", "0.5", true, "Kalker's choice in CONTACT",
         [](const Results& r) {
             return optimum(on_grid(r.curve("05a", 0), paper_alphas()), 0.5, ratio_over({}, Vary::both_alphas), 0.4,
                            0.6);
         }},
        {"5A", "alpha_T = 0 is the least accurate of the three strategies", "least accurate", true, "",
         [](const Results& r) -> Finding {
             const auto errors = three_errors(r, "05a");
             return {errors[2] > errors[0] && errors[2] > errors[1], three_texts(errors)};
         }},
        {"5A", "alpha_L = 0 is the most precise of the three strategies", "most precise", true, "",
         [](const Results& r) -> Finding {
             const auto errors = three_errors(r, "05a");
             return {errors[1] < errors[0] && errors[1] < errors[2], three_texts(errors)};
         }},
    };
    for (std::size_t k = 0; k < fine.size(); ++k) {
        const std::string n = std::to_string(fine[k]);
        claims.push_back({k == 0 ? "5A" : "5B", "alpha_L = 0 has its optimum at alpha_T = 0.63 (n = " + n + ")", "0.63",
                          k == 0,
                          k == 0 ? "the optimum is a zero crossing of the error, not a minimum of its size"
                                 : "the zero of the error has drifted below 0.615: 0.6 is nearer to it than 0.63",
                          [k](const Results& r) {
                              return optimum(on_grid(r.curve("05b", k), paper_alphas()), 0.63,
                                             ratio_over({.n = fine[k]}, Vary::alpha_T), 0.5, 0.7);
                          }});
    }
    const std::vector<Claim> more{
        {"5B", "The optimum alpha_T = 0.63 does not depend on the number of elements", "0.63 for every n", false,
         "the zero of the error drifts towards smaller alpha_T as n grows",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{20, 40, 60, 80, 160};
             bool holds = true;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 const double alpha = true_optimum(ratio_over({.n = numbers[k]}, Vary::alpha_T), 0.5, 0.7);
                 holds = holds && std::abs(alpha - 0.63) < 0.005;
                 return number(alpha, 4);
             });
             return {holds, "true optimum " + text};
         }},
        {"6A", "All three cases converge to the exact solution", "convergence", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             std::string text;
             for (std::size_t k = 0; k < 3; ++k) {
                 const Points& curve = r.curve("06a", k);
                 const double before = std::abs(error_at(curve, 80)), after = std::abs(error_at(curve, 160));
                 holds = holds && after < before && after < 2e-3;
                 text += (k > 0 ? "; " : "") + percent(before) + " to " + percent(after);
             }
             return {holds, "error from n = 80 to 160: " + text};
         }},
        {"6A", "alpha_L = 0, alpha_T = 0.63 is more accurate than the other two at every n", "best of three", true, "",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("06a", 2);
             const bool holds =
                 smaller_everywhere(curve, r.curve("06a", 0)) && smaller_everywhere(curve, r.curve("06a", 1));
             return {holds, "n = 40: " + percent(error_at(curve, 40)) + " against " +
                                percent(error_at(r.curve("06a", 0), 40)) + " (0.5/0.5) and " +
                                percent(error_at(r.curve("06a", 1), 40)) + " (0/0.5)"};
         }},
        {"6A", "The rate of convergence is larger for alpha_L = 0, alpha_T = 0.63 than for alpha_L = alpha_T = 0.5",
         "larger rate", false,
         "the error is smaller, its rate is not: it crosses zero near n = 20, grows and then decays slowly",
         [](const Results& r) -> Finding {
             const double own = -power(errors_from(r.curve("06a", 2), 40)),
                          other = -power(errors_from(r.curve("06a", 0), 40));
             return {own > other, "order from n = 40 to 160: " + number(own, 2) + " against " + number(other, 2)};
         }},
        {"6A", "alpha_L = 0, alpha_T = 0.63 has errors below 0.01 % at n = 20", "< 0.01 %", true,
         "a zero crossing: the error grows again behind it",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("06a", 2);
             return {std::abs(error_at(curve, 20)) < 1e-4, percent(error_at(curve, 20)) +
                                                               " (n = 40: " + percent(error_at(curve, 40)) +
                                                               ", n = 80: " + percent(error_at(curve, 80)) + ")"};
         }},
        {"6B", "The analytic derivative (0/0.4, 0.4/0, 0.4/0.4) is less precise than finite differences in Fig. 6A",
         "less precise", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             double least = 1, largest = 0;
             for (std::size_t i = 0; i < 3; ++i) {
                 least = std::min(least, std::abs(error_at(r.curve("06b", i), 40)));
                 largest = std::max(largest, std::abs(error_at(r.curve("06a", i), 40)));
                 for (std::size_t k = 0; k < 3; ++k)
                     holds = holds && smaller_everywhere(r.curve("06a", i), r.curve("06b", k));
             }
             return {holds, "n = 40: at least " + percent(least) + " against at most " + percent(largest)};
         }},
        {"7A", "alpha_L = alpha_T has a minimum of precision at 0.5, due to the singularity", "worst at 0.5", true, "",
         [](const Results& r) -> Finding {
             const Points& curve = r.curve("07a", 0);
             const double here = std::abs(error_at(curve, 0.5));
             const double below = std::abs(error_at(curve, 0.45)), above = std::abs(error_at(curve, 0.55));
             return {here > below && here > above, "error " + percent(here) + " at 0.5, " + percent(below) +
                                                       " at 0.45, " + percent(above) + " at 0.55"};
         }},
        {"7A", "With alpha_L or alpha_T zero, results are more accurate for alpha in [0.4, 0.6] than outside",
         "[0.4, 0.6]", true, "",
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
             return {holds, "mean error " + text};
         }},
        {"7A", "Above alpha = 0.7 the curve alpha_L = 0 is the most accurate", "alpha_L = 0", true, "",
         [](const Results& r) -> Finding {
             const auto part = [&](std::size_t k) { return within(r.curve("07a", k), 0.705, 1); };
             const bool holds = smaller_everywhere(part(1), part(0)) && smaller_everywhere(part(1), part(2));
             return {holds, "at 0.85: alpha_L = 0 " + percent(error_at(part(1), 0.85)) + ", equal " +
                                percent(error_at(part(0), 0.85)) + ", alpha_T = 0 " + percent(error_at(part(2), 0.85))};
         }},
        {"7A", "The curve alpha_L = 0 meets the theoretical value at two points (n = 40)", "two", false,
         "a third lies near 0.04, where c11* rises from 0 at alpha_T = 0; the two others are the paper's",
         [](const Results& r) -> Finding {
             const std::vector<double> found = crossings(r.curve("07a", 1));
             std::string text = std::to_string(found.size()) + " crossings:";
             for (const double alpha : found) text += " " + number(alpha);
             return {found.size() == 2, text};
         }},
        {"7B", "One of them stays at about alpha_T = 0.6 whatever the density of the mesh", "about 0.6", true,
         "about: within 0.02",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(fine, [&](std::size_t k) {
                 const std::vector<double> found = crossings(r.curve("07b", k));
                 if (found.empty() || std::abs(found.back() - 0.6) > 0.02) holds = false;
                 return found.empty() ? std::string("none") : number(found.back());
             });
             return {holds, text};
         }},
        {"7B", "Near alpha_T = 0.5 the error hardly depends on the density of the mesh", "not very sensitive", true,
         "judged by the spread over n = 40, 60, 80 against the error itself: less than half",
         [](const Results& r) -> Finding {
             const Points at_half{{40, value_at(r.curve("07b", 0), 0.5)},
                                  {60, value_at(r.curve("07b", 1), 0.5)},
                                  {80, value_at(r.curve("07b", 2), 0.5)}};
             return {spread(at_half) < largest_error(at_half) / 2,
                     "error " + for_each_n(fine, [&](std::size_t k) { return percent(at_half[k].second - 1); })};
         }},
        {"8A", "At alpha_L = alpha_T = 0.5 finite differences are better than the analytic derivative", "better", true,
         "",
         [](const Results& r) -> Finding {
             const Points &fd = r.curve("08a", 0), &closed = r.curve("08a", 1);
             return {smaller_everywhere(fd, closed),
                     "n = 40: " + percent(error_at(fd, 40)) + " against " + percent(error_at(closed, 40))};
         }},
        {"8B", "The best precision is that of finite differences with alpha_T = 0.63", "best of three", false,
         "so at every other n; the error of the analytic derivative with alpha_T = 0.6 changes its sign near n = 38",
         [](const Results& r) -> Finding {
             const Points &fd = r.curve("08b", 0), &slow = r.curve("08b", 1), &other = r.curve("08b", 2);
             std::string lost;
             for (std::size_t i = 0; i < fd.size(); ++i) {
                 const double own = std::abs(fd[i].second - 1);
                 if (own < std::abs(slow[i].second - 1) && own < std::abs(other[i].second - 1)) continue;
                 lost += (lost.empty() ? "" : ", ") + number(fd[i].first);
             }
             return {lost.empty(), lost.empty()
                                       ? "best at every n"
                                       : "best at every n but " + lost + "; n = 40: " + percent(error_at(fd, 40)) +
                                             " against " + percent(error_at(slow, 40)) + " (analytic, 0.47) and " +
                                             percent(error_at(other, 40)) + " (analytic, 0.6)"};
         }},
        {"8B", "Above n = 30 the analytic derivative with alpha_T = 0.6 is acceptable", "acceptable", true,
         "acceptable: below 0.1 %",
         [](const Results& r) -> Finding {
             const Points errors = errors_from(r.curve("08b", 2), 31);
             double largest = 0;
             for (const auto& point : errors) largest = std::max(largest, std::abs(point.second));
             return {largest < 1e-3, "largest error " + percent(largest)};
         }},
        {"8B", "The analytic derivative with alpha_T = 0.47 needs more elements for the same accuracy", "slower", true,
         "the least n from which on the error stays below 0.1 %",
         [](const Results& r) -> Finding {
             const auto needed = [&](std::size_t k) {
                 double n = 0;
                 const Points& curve = r.curve("08b", k);
                 for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
                     if (std::abs(curve[i].second - 1) > 1e-3) n = curve[i + 1].first;
                 }
                 return n > 0 ? n : curve.front().first;
             };
             return {needed(1) > needed(0) && needed(1) > needed(2), "n = " + number(needed(1)) + " against " +
                                                                         number(needed(2)) + " (analytic, 0.6) and " +
                                                                         number(needed(0)) + " (fd, 0.63)"};
         }},
        {"8B", "Its order of convergence is smaller", "slower", false,
         "its error falls faster, from a larger value: beyond n = 140 it is the smaller one of the analytic two",
         [](const Results& r) -> Finding {
             const auto order = [&](std::size_t k) { return -power(errors_from(r.curve("08b", k), 50)); };
             return {order(1) < order(0) && order(1) < order(2),
                     "order from n = 50 to 160: " + number(order(1), 2) + " against " + number(order(2), 2) +
                         " (analytic, 0.6) and " + number(order(0), 2) + " (fd, 0.63)"};
         }},
        {"9", "The traction oscillates for alpha_L = alpha_T = 1 with either derivative, not for 0.5/0.5 and 0/0.63",
         "oscillates", true,
         "oscillation: total variation over range, less 1, which is 0 for a monotone traction such as Carter's; any "
         "excess above rounding (1e-9) counts",
         [](const Results&) -> Finding {
             const double closed = oscillation_of({.derivative = analytic, .alpha_L = 1, .alpha_T = 1});
             const double fd = oscillation_of({.alpha_L = 1, .alpha_T = 1});
             const double half = oscillation_of({.alpha_L = 0.5, .alpha_T = 0.5});
             const double best_case = oscillation_of({});
             const bool holds = closed > oscillation_threshold && fd > oscillation_threshold &&
                                half < oscillation_threshold && best_case < oscillation_threshold;
             return {holds, "analytic 1/1 " + percent(closed) + ", fd 1/1 " + percent(fd) + ", fd 0.5/0.5 " +
                                percent(half) + ", fd 0/0.63 " + percent(best_case)};
         }},
        {"9", "Tractions oscillate above alpha = 0.9, finite differences, alpha_L = alpha_T", "0.9", true,
         "judged on the grid of 0.05: none up to 0.9, oscillation at 0.95 and 1",
         [](const Results&) { return oscillation_onset(Derivative::finite_difference); }},
        {"9", "The same, analytic derivative", "0.9", false, "the analytic derivative oscillates a little earlier",
         [](const Results&) { return oscillation_onset(Derivative::analytic); }},
        {"9", "A smooth distribution needs alpha_L and alpha_T below 0.9", "both below 0.9", false,
         "with alpha_L = 0 even alpha_T = 1 is smooth: alpha decreases along the contact",
         [](const Results&) -> Finding {
             const double fd = oscillation_of({.alpha_T = 1});
             const double closed = oscillation_of({.derivative = analytic, .alpha_T = 1});
             return {std::min(fd, closed) > oscillation_threshold,
                     "alpha_L = 0, alpha_T = 1: " + percent(fd) + " (fd), " + percent(closed) + " (analytic)"};
         }},
        {"9", "alpha_L = alpha_T = 1 is equivalent to Knothe and Gross-Thebing's boundary conditions", "equivalent",
         true,
         "exactly so for the elements that carry traction: n with alpha = 1 against n + 1 with the boundary conditions",
         [](const Results&) -> Finding {
             const double fd = knothe_boundary_difference(40, Derivative::finite_difference);
             const double closed = knothe_boundary_difference(40, analytic);
             return {std::max(fd, closed) < 1e-9, "largest relative difference of tractions " + number(fd, 1) +
                                                      " (fd), " + number(closed, 1) + " (analytic)"};
         }},
        {"10", "Except near the trailing edge, Carter and collocation (fd, 0/0.63) are indistinguishable",
         "indistinguishable", true,
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
    claims.insert(claims.end(), more.begin(), more.end());
    return claims;
}

std::vector<Claim> claims_of_galerkin() {
    constexpr Derivative analytic = Derivative::analytic;
    std::vector<Claim> claims{
        {"11A", "With Galerkin (7 points, fd) the curve alpha_L = 0 gives the best results", "alpha_L = 0", true, "",
         [](const Results& r) -> Finding {
             const auto errors = three_errors(r, "11a");
             return {errors[1] < errors[0] && errors[1] < errors[2], three_texts(errors)};
         }},
    };
    for (std::size_t k = 0; k < fine.size(); ++k) {
        claims.push_back(
            {k == 0 ? "11A" : "11B",
             "Galerkin (7 points, fd), alpha_L = 0: least error at alpha_T = 1 (n = " + std::to_string(fine[k]) + ")",
             "1", true, "", [k](const Results& r) {
                 const Case c{.n = fine[k], .method = Method::galerkin_7};
                 return optimum(on_grid(r.curve("11b", k), paper_alphas()), 1, ratio_over(c, Vary::alpha_T), 0.8, 1.2);
             }});
    }
    const std::vector<Claim> more{
        {"12A", "Gauss points that meet element borders cause dips", "dips", true,
         "a dip: the error at the coincidence differs by more than twice the change expected from both sides",
         [](const Results&) -> Finding {
             int dips = 0, all = 0;
             double largest = 0;
             for (std::size_t i = 0; i < 7; ++i) {
                 double node = 0, weight = 0;
                 gsl_integration_glfixed_table* const table = gsl_integration_glfixed_table_alloc(7);
                 gsl_integration_glfixed_point(-1, 1, i, &node, &weight, table);
                 gsl_integration_glfixed_table_free(table);
                 const double alpha = 0.5 + node / 2;  // this point meets the leading edge of its element
                 const auto ratio =
                     ratio_over({.method = Method::galerkin_7, .derivative = Derivative::analytic}, Vary::both_alphas);
                 const double left = ratio(alpha - 0.01), here = ratio(alpha), right = ratio(alpha + 0.01);
                 const double dip = std::abs(here - (left + right) / 2);
                 ++all;
                 if (dip > std::abs(right - left)) ++dips;
                 largest = std::max(largest, dip);
             }
             return {dips == all, std::to_string(dips) + " dips at " + std::to_string(all) +
                                      " coincidences (alpha_L = alpha_T), up to " + percent(largest) + " of c11"};
         }},
        {"12A", "Galerkin (7 points, analytic): the curve alpha_T = 0 is the more precise", "alpha_T = 0", false,
         "the indices are swapped, as in several captions: alpha_L = 0 is the more precise",
         [](const Results& r) -> Finding {
             const auto errors = three_errors(r, "12a");
             return {errors[2] < errors[0] && errors[2] < errors[1], three_texts(errors)};
         }},
        {"12B", "Galerkin in closed form: alpha_L = 0 has the best precision", "alpha_L = 0", true, "",
         [](const Results& r) -> Finding {
             const auto errors = three_errors(r, "12b");
             return {errors[1] < errors[0] && errors[1] < errors[2], three_texts(errors)};
         }},
        {"12B", "Galerkin in closed form, alpha_L = 0: most accurate at alpha_T = 0.63 (n = 40)", "0.63", true, "",
         [](const Results& r) {
             return optimum(
                 on_grid(r.curve("12b", 1), paper_alphas()), 0.63,
                 ratio_over({.method = Method::galerkin_exact, .derivative = Derivative::analytic}, Vary::alpha_T), 0.5,
                 0.7);
         }},
        {"12B", "Fig. 12B (Galerkin, closed form, analytic) coincides with Fig. 5A (collocation, fd)", "coincident",
         true,
         "the mean of the derivative over an element is the central difference: one formula gives both, and quadrature "
         "with 1000 points confirms it",
         [](const Results& r) -> Finding {
             double largest = 0;
             for (std::size_t k = 0; k < 3; ++k) {
                 largest = std::max(
                     largest, largest_difference(within(r.curve("05a", k), 0.1, 1), within(r.curve("12b", k), 0.1, 1)));
             }
             const double quadrature = gauss_galerkin_difference(1000);
             return {largest < 1e-9 && quadrature < 1e-4, "largest difference of c11*/c11 " + number(largest, 1) +
                                                              " for alpha from 0.1 to 1; " + number(quadrature, 1) +
                                                              " with 1000 Gauss points (0/0.63)"};
         }},
        {"13A", "The curves of n = 40, 60 and 80 reach 1 at alpha_T = 0.63", "0.63", false,
         "as in Fig. 5B, the crossing drifts with n",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(fine, [&](std::size_t k) {
                 const std::vector<double> found = crossings(within(r.curve("13a", k), 0.5, 0.8));
                 if (found.size() != 1 || std::abs(found[0] - 0.63) > 0.005) holds = false;
                 return found.empty() ? std::string("none") : number(found[0], 4);
             });
             return {holds, "crossing at " + text};
         }},
        {"13A", "Fig. 13A looks like Fig. 5B", "very similar", true, "similar: within 0.001 %",
         [](const Results& r) -> Finding {
             double largest = 0;
             for (std::size_t k = 0; k < 3; ++k) {
                 largest = std::max(
                     largest, largest_difference(within(r.curve("05b", k), 0.1, 1), within(r.curve("13a", k), 0.1, 1)));
             }
             return {largest < 1e-5,
                     "largest difference of c11*/c11 " + number(largest, 1) + " for alpha_T from 0.1 to 1"};
         }},
        {"13B", "Galerkin and collocation give almost identical curves over n at 0/0.63", "almost identical", true, "",
         [](const Results& r) -> Finding {
             const double largest = largest_difference(r.curve("13b", 0), r.curve("13b", 1));
             return {largest < 1e-5, "largest difference of c11*/c11 " + number(largest, 1)};
         }},
        {"Sec. 7", "Collocation with fd is equivalent to Galerkin with exact integrals and derivatives", "equivalent",
         true, "in G' and hence in steady problems; G differs, hence stability and response in time do",
         [](const Results&) -> Finding {
             const Case galerkin{.method = Method::galerkin_exact, .derivative = Derivative::analytic};
             const double G_prime = G_prime_difference(galerkin, {});
             return {G_prime < 1e-12, "largest difference of G' " + number(G_prime, 1) + ", of G " +
                                          percent(G_difference(galerkin, {})) + " of the largest entry"};
         }},
        {"Sec. 7", "Galerkin is much more expensive (7 Gauss points, n = 40)", "much more", true,
         "much more: 3 times or above, assembly and solution of a steady problem",
         [](const Results&) -> Finding {
             const double ratio = cost_ratio({.method = Method::galerkin_7});
             return {ratio >= 3, times(ratio)};
         },
         true},
        {"Sec. 7", "Galerkin is much more expensive (integrals in closed form, n = 40)", "much more", false,
         "in closed form the integrals cost what collocation costs",
         [](const Results&) -> Finding {
             const double ratio = cost_ratio({.method = Method::galerkin_exact, .derivative = analytic});
             return {ratio >= 3, times(ratio)};
         },
         true},
    };
    claims.insert(claims.end(), more.begin(), more.end());
    return claims;
}

std::vector<Claim> claims_of_meshes() {
    std::vector<Claim> claims;
    struct Optimum {
        std::string figure, text, panel;
        double claimed;
        Case c;
        double low, high;
        std::vector<bool> expected;  // n = 40, 60, 80
        std::string reason;
    };
    const Case geometric{.mesh = Topology::geometric}, knothe{.mesh = Topology::knothe};
    const Case modified{.mesh = Topology::modified_knothe};
    const auto equal_on = [](Case c) {
        c.alpha_L = c.alpha_T = 0.5;
        return c;
    };
    const std::vector<Optimum> optima{
        {"14A", "Geometric mesh, 0/0.63: best with dx_T/dx_L = 1", "14a", 1, geometric, 0.5, 2, {true, true, true}, ""},
        {"14B",
         "Geometric mesh, 0.5/0.5: best with dx_T/dx_L = 2",
         "14b",
         2,
         equal_on(geometric),
         1,
         4,
         {true, true, true},
         "the paper's 0.5 is its inverse"},
        {"15A",
         "Knothe and Gross-Thebing's mesh, 0/0.63: best with epsilon = 1",
         "15a",
         1,
         knothe,
         0.1,
         1.5,
         {true, true, true},
         ""},
        {"15B",
         "Knothe and Gross-Thebing's mesh, 0.5/0.5: best with epsilon = 0.4",
         "15b",
         0.4,
         equal_on(knothe),
         0.1,
         1,
         {true, true, true},
         ""},
        {"16A",
         "Modified Knothe mesh, 0/0.63: best with epsilon close to 1",
         "16a",
         1,
         modified,
         0.1,
         1.5,
         {true, true, true},
         ""},
        {"16B",
         "Modified Knothe mesh, 0.5/0.5: best with epsilon = 1",
         "16b",
         1,
         equal_on(modified),
         0.1,
         1,
         {true, true, true},
         ""},
    };
    for (const Optimum& o : optima) {
        for (std::size_t k = 0; k < fine.size(); ++k) {
            claims.push_back({o.figure, o.text + " (n = " + std::to_string(fine[k]) + ")", number(o.claimed),
                              bool(o.expected[k]), o.reason, [o, k](const Results& r) {
                                  Case c = o.c;
                                  c.n = fine[k];
                                  return optimum(r.curve(o.panel, k), o.claimed, ratio_over(c, Vary::grading), o.low,
                                                 o.high);
                              }});
        }
    }
    const auto small_influence = [](const std::string& panel) {
        return [panel](const Results& r) -> Finding {
            double largest = 0;
            for (std::size_t k = 0; k < 3; ++k) largest = std::max(largest, spread(r.curve(panel, k)));
            return {largest < 0.01, "c11*/c11 varies by " + percent(largest) + " at most"};
        };
    };
    const std::vector<Claim> more{
        {"14", "The best size ratio hardly depends on the density of the mesh", "independent of n", true,
         "hardly: within 10 % from n = 40 to 80 (0.5/0.5)",
         [](const Results&) -> Finding {
             std::vector<double> found;
             const std::string text = for_each_n(fine, [&](std::size_t k) {
                 const Case c{.n = fine[k], .alpha_L = 0.5, .alpha_T = 0.5, .mesh = Topology::geometric};
                 found.push_back(true_optimum(ratio_over(c, Vary::grading), 1, 4));
                 return number(found.back(), 4);
             });
             const auto [low, high] = std::minmax_element(found.begin(), found.end());
             return {*high / *low < 1.1, "true optimum " + text};
         }},
        {"15A", "The influence of epsilon is small, 0/0.63", "small", true, "small: below 1 % of c11",
         small_influence("15a")},
        {"15B", "The influence of epsilon is small, 0.5/0.5", "small", true, "small: below 1 % of c11",
         small_influence("15b")},
        {"16B", "Modified Knothe mesh, 0.5/0.5: no epsilon gives a result without error", "none", true, "",
         [](const Results& r) -> Finding {
             std::size_t found = 0;
             for (std::size_t k = 0; k < 3; ++k) found += crossings(r.curve("16b", k)).size();
             return {found == 0,
                     std::to_string(found) + " zeros of the error; least error " +
                         for_each_n(fine, [&](std::size_t k) { return percent(least_error(r.curve("16b", k))); })};
         }},
        {"16B", "The influence of epsilon is small, 0.5/0.5", "small", true, "small: below 1 % of c11",
         small_influence("16b")},
        {"17", "Away from the edges the tractions on the three meshes coincide with Carter's", "very coincident", true,
         "away: |x| < 0.8 a; coincide: within 1 % of the largest traction, as in Fig. 10",
         [](const Results&) -> Finding {
             double largest = 0;
             for (const Topology mesh : {Topology::uniform, Topology::knothe, Topology::modified_knothe}) {
                 largest = std::max(largest, visible_difference(tractions(traction_case(mesh)), -0.8, 0.8));
             }
             return {largest < 0.01, "at most " + percent(largest) + " of the largest traction"};
         }},
        {"17A", "At the trailing edge Knothe/Gross-Thebing and modified Knothe give very similar tractions",
         "very similar", true, "similar: within 2 %, trailing five elements",
         [](const Results&) -> Finding {
             const Tractions first = tractions(traction_case(Topology::knothe));
             const Tractions second = tractions(traction_case(Topology::modified_knothe));
             const double largest = (first.value.head(5) / second.value.head(5) - 1).abs().maxCoeff();
             return {largest < 0.02, "within " + percent(largest)};
         }},
        {"17A", "There both overestimate Carter's traction", "overestimate", true,
         "at the centre of the trailing element, whose mean of Carter's traction is larger than his value there",
         [](const Results&) -> Finding {
             const Tractions first = tractions(traction_case(Topology::knothe));
             const Tractions second = tractions(traction_case(Topology::modified_knothe));
             const double own = first.value[0] / first.carter[0] - 1, other = second.value[0] / second.carter[0] - 1;
             return {own > 0 && other > 0, percent(own) + " and " + percent(other) + " (against his mean: " +
                                               percent(first.value[0] / first.carter_mean[0] - 1) + " and " +
                                               percent(second.value[0] / second.carter_mean[0] - 1) + ")"};
         }},
        {"17A", "The uniform mesh matches Carter most closely at the trailing edge", "uniform", true, "",
         [](const Results&) -> Finding {
             const auto error = [](Topology mesh) {
                 const Tractions t = tractions(traction_case(mesh));
                 return std::abs(t.value[0] - t.carter[0]);
             };
             const double uniform = error(Topology::uniform), both = error(Topology::knothe);
             const double trailing = error(Topology::modified_knothe);
             return {uniform < both && uniform < trailing, "|p - Carter|/(G xi) on the trailing element: uniform " +
                                                               number(uniform) + ", Knothe " + number(both) +
                                                               ", modified " + number(trailing)};
         }},
        {"17B", "At the leading edge modified Knothe and uniform meshes agree, slightly above Carter",
         "slightly higher", true,
         "agree: within 2 %; slightly: on the leading element, by less than 5 % of the mean traction",
         [](const Results&) -> Finding {
             const double uniform = leading_excess(traction_case(Topology::uniform));
             const double modified_excess = leading_excess(traction_case(Topology::modified_knothe));
             const Tractions t = tractions(traction_case(Topology::uniform));
             const double share = std::abs(t.value[39] - t.carter[39]) / t.value.abs().mean();
             return {uniform > 0 && modified_excess > 0 && std::abs(uniform - modified_excess) < 0.02 && share < 0.05,
                     "above Carter by " + percent(uniform) + " (uniform) and " + percent(modified_excess) +
                         " (modified), " + percent(share) + " of the mean traction"};
         }},
        {"17B", "Knothe and Gross-Thebing's mesh overestimates Carter at the leading edge", "overestimates", true,
         "with 0.5/0.5; with 0/0.63 it underestimates",
         [](const Results&) -> Finding {
             const double own = leading_excess(traction_case(Topology::knothe));
             const double other = leading_excess({.mesh = Topology::knothe, .grading = 0.4});
             return {own > 0, percent(own) + " (" + percent(other) + " with 0/0.63)"};
         }},
        {"17B", "Also there the meshes whose points lie farthest from the edge err least", "uniform", false,
         "with 0.5/0.5 the small leading element is nearer to Carter than the uniform one; with 0/0.63 it is not",
         [](const Results&) -> Finding {
             const auto error = [](const Case& c) {
                 const Tractions t = tractions(c);
                 return std::abs(t.value[39] - t.carter[39]);
             };
             const double uniform = error(traction_case(Topology::uniform)),
                          both = error(traction_case(Topology::knothe));
             return {uniform < both, "|p - Carter|/(G xi) on the leading element: uniform " + number(uniform) +
                                         ", Knothe " + number(both) + "; with 0/0.63 " + number(error({})) + " and " +
                                         number(error({.mesh = Topology::knothe, .grading = 0.4}))};
         }},
        {"Sec. 7", "Meshes other than the uniform one can be even more accurate with other alphas", "even better", true,
         "n = 40, all meshes and alphas of the grids",
         [](const Results&) -> Finding {
             Case found;
             double least = std::abs(c11_ratio(found) - 1);
             const double uniform = least;
             const auto visit = [&](Topology mesh, const std::vector<double>& gradings) {
                 for (const double grading : gradings) {
                     for (const double alpha : paper_alphas()) {
                         for (const Vary vary : {Vary::both_alphas, Vary::alpha_T}) {
                             const Case c = at({"", {.mesh = mesh, .grading = grading}, vary}, alpha);
                             const double error = std::abs(c11_ratio(c) - 1);
                             if (!(error < least)) continue;
                             least = error;
                             found = c;
                         }
                     }
                 }
             };
             visit(Topology::geometric, {0.125, 0.25, 0.5, 2, 4, 8});
             visit(Topology::knothe, fractions(1, 9, 10));
             visit(Topology::modified_knothe, fractions(1, 9, 10));
             return {least < uniform, percent(least) + " (" + name(found.mesh) + " " + number(found.grading) +
                                          ", alpha " + number(found.alpha_L) + "/" + number(found.alpha_T) +
                                          ") against " + percent(uniform) + " (uniform 0/0.63)"};
         }},
        {"Sec. 7", "Finite differences are more robust than the analytic derivative", "in general", true,
         "judged by the largest jump of c11*/c11 from one alpha to the next (0.005) in [0.3, 0.7], alpha_L = alpha_T",
         [](const Results& r) -> Finding {
             const auto jump = [](const Points& points) {
                 double result = 0;
                 for (std::size_t i = 1; i < points.size(); ++i) {
                     result = std::max(result, std::abs(points[i].second - points[i - 1].second));
                 }
                 return result;
             };
             const Points fd = within(r.curve("05a", 0), 0.3, 0.7), closed = within(r.curve("07a", 0), 0.3, 0.7);
             int better = 0, all = 0;
             for (const double alpha : fractions(1, 20, 20)) {
                 const double own = error_at(r.curve("05a", 0), alpha), other = error_at(r.curve("07a", 0), alpha);
                 ++all;
                 if (std::abs(own) < std::abs(other)) ++better;
             }
             return {jump(fd) < jump(closed), percent(jump(fd)) + " against " + percent(jump(closed)) +
                                                  "; more accurate at " + std::to_string(better) + " of " +
                                                  std::to_string(all) + " equal alphas of the grid"};
         }},
    };
    claims.insert(claims.end(), more.begin(), more.end());
    return claims;
}

std::vector<Claim> claims_of_stability() {
    const auto stable_claim = [](const std::string& panel, double limit) {
        return [panel, limit](const Results& r) -> Finding {
            bool holds = true;
            const std::string text = for_each_n(coarse, [&](std::size_t k) {
                holds = holds && stable_below(r.curve(panel, k), limit);
                return onset(r.curve(panel, k));
            });
            return {holds, "unstable " + text};
        };
    };
    const auto critical = [](const Case& scheme) {
        return for_each_n(coarse, [&](std::size_t k) {
            Case c = scheme;
            c.n = coarse[k];
            const std::optional<double> found = critical_alpha_T(c);
            return found ? number(*found, 4) : std::string("none");
        });
    };
    const auto finer_is_worse = [](const std::vector<std::string>& panels) {
        return [panels](const Results& r) -> Finding {
            bool holds = true;
            std::string text;
            for (const std::string& panel : panels) {
                double before = 2;
                text += (text.empty() ? "" : "; ") + printed(panel) + " ";
                for (std::size_t k = 0; k < 3; ++k) {
                    const double here = first_positive(r.curve(panel, k)).value_or(1.5);
                    holds = holds && here < before;
                    before = here;
                    text += (k > 0 ? ", " : "") + onset(r.curve(panel, k));
                }
            }
            return {holds, "unstable (n = 20, 40, 60) " + text};
        };
    };
    return {
        {"18A", "alpha_L = alpha_T < 0.5 is stable, analytic derivative", "0.5", true, "", stable_claim("18a", 0.5)},
        {"18B", "alpha_L = alpha_T < 0.5 is stable, finite differences", "0.5", true, "", stable_claim("18b", 0.5)},
        {"Sec. 6.1", "alpha_L = alpha_T = 1, the scheme of Knothe and Gross-Thebing, is unstable", "unstable", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 const double fraction = value_at(r.curve("18b", k), 1);
                 holds = holds && fraction > 0 && certainly_unstable({.n = coarse[k], .alpha_L = 1, .alpha_T = 1});
                 return percent(fraction, 3) + " of the eigenvalues";
             });
             return {holds, text};
         }},
        {"Sec. 6.1", "Yet its steady results converge to the exact value", "converge", true, "finite differences",
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
        {"19A", "alpha_L = 0: alpha_T < 0.7 is stable, analytic derivative", "0.7", true,
         "judged on the curves' grid of 0.005; bisected, n = 60 turns unstable at 0.6985", stable_claim("19a", 0.7)},
        {"19B", "alpha_L = 0: alpha_T < 0.7 is stable, finite differences", "0.7", true, "", stable_claim("19b", 0.7)},
        {"19B", "alpha_L = 0: alpha_T < 0.7 is required for stability, whatever n", "0.7", false,
         "the critical alpha_T depends on n: a coarse mesh allows more; the unstable set need not be an interval "
         "either",
         [critical](const Results&) -> Finding {
             bool holds = true;
             for (const Eigen::Index n : coarse) {
                 const std::optional<double> found = critical_alpha_T({.n = n});
                 holds = holds && found && std::abs(*found - 0.7) < 0.05;
             }
             return {holds, "critical alpha_T " + critical({})};
         }},
        {"19", "Stability is more critical for higher mesh densities", "more critical", true, "",
         finer_is_worse({"19a", "19b"})},
        {"19", "With very many elements the requirement approaches alpha_T < 0.5", "towards 0.5", true,
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
                     "smallest unstable alpha_T (by 0.01) " + text + "; excess ~ n^" + number(exponent, 2)};
         }},
        {"19", "The recommended alpha_L = 0, alpha_T = 0.63 is stable, as 0.63 < 0.7", "stable", false,
         "the critical alpha_T falls with n and has passed 0.63 at n = 160",
         [](const Results&) -> Finding {
             const std::vector<Eigen::Index> numbers{20, 40, 80, 160};
             bool holds = true;
             const std::string text = for_each_n(numbers, [&](std::size_t k) {
                 const bool unstable = certainly_unstable({.n = numbers[k]});
                 holds = holds && !unstable;
                 return std::string(unstable ? "unstable" : "stable");
             });
             return {holds, text};
         }},
        {"20A", "Galerkin (7 points, analytic), alpha_L = 0: alpha_T < 0.85 is stable", "0.85", false,
         "the threshold lies a little lower at n = 60; on a grid of 0.05 it would show as 0.85",
         stable_claim("20a", 0.85)},
        {"20B", "Galerkin (7 points, fd), alpha_L = 0: alpha_T < 0.85 is stable", "0.85", true, "",
         stable_claim("20b", 0.85)},
        {"20", "Galerkin is more stable than collocation", "more stable", true, "",
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
        {"20", "With Galerkin, finite differences are more stable than the analytic derivative", "fd", true, "",
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
        {"20", "With Galerkin all eigenvalues are stable for n = 20", "none", true, "alpha_T up to 1",
         [](const Results& r) -> Finding {
             const bool holds = !first_positive(r.curve("20a", 0)) && !first_positive(r.curve("20b", 0));
             return {holds, "analytic: " + onset(r.curve("20a", 0)) + "; fd: " + onset(r.curve("20b", 0))};
         }},
        {"20", "With Galerkin stability is more critical for refined meshes", "more critical", true, "",
         finer_is_worse({"20a", "20b"})},
        {"21A", "alpha_L = alpha_T = 1 is stable for lambda < 0.5, analytic derivative", "0.5", true, "",
         stable_claim("21a", 0.5)},
        {"21B", "alpha_L = alpha_T = 1 is stable for lambda < 0.5, finite differences", "0.5", true, "",
         stable_claim("21b", 0.5)},
        {"21C, 21D", "alpha_L = 0, alpha_T = 1 is stable for lambda < 0.5, either derivative", "0.5", true, "",
         [](const Results& r) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 holds = holds && stable_below(r.curve("21c", k), 0.5) && stable_below(r.curve("21d", k), 0.5);
                 return onset(r.curve("21c", k)) + " (analytic), " + onset(r.curve("21d", k)) + " (fd)";
             });
             return {holds, "unstable " + text};
         }},
        {"21", "Stability improves as the points of G move behind those of G'", "tendency", true,
         "the proportion at lambda = 1, 0.75, 0.5, 0.25 must not rise, n = 60",
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
        {"21", "lambda < 0.5 is stable for any alpha_L and alpha_T (uniform mesh)", "any alpha", true,
         "alphas 0 to 1 by 0.25 but for 0/0, whose eigenvalues are imaginary and their signs open; lambda 0 to 0.49, n "
         "= 20 "
         "and 40, collocation, both derivatives",
         [](const Results&) -> Finding {
             const Tally tally = unstable_cases({}, {Derivative::finite_difference, Derivative::analytic});
             return {tally.unstable == 0,
                     std::to_string(tally.unstable) + " of " + std::to_string(tally.all) + " cases unstable"};
         }},
        {"21", "The same on Knothe and Gross-Thebing's mesh (epsilon = 0.4), analytic derivative", "any alpha", false,
         "the paper's figure is for uniform meshes; small end elements bring neighbours' edges near the analytic "
         "points",
         [](const Results&) -> Finding {
             const Case knothe{.mesh = Topology::knothe, .grading = 0.4};
             const Tally closed = unstable_cases(knothe, {Derivative::analytic});
             const Tally fd = unstable_cases(knothe, {Derivative::finite_difference});
             return {closed.unstable == 0, std::to_string(closed.unstable) + " of " + std::to_string(closed.all) +
                                               " cases unstable (finite differences: " + std::to_string(fd.unstable) +
                                               ")"};
         }},
    };
}

std::vector<Claim> claims_of_frequency() {
    return {
        {"22A", "Collocation (fd, 0/0.63) agrees with the polynomial approach for n = 20, 40 and 60", "good agreement",
         true, "good: within 1 % of |c11| at every frequency",
         [](const Results&) -> Finding {
             bool holds = true;
             const std::string text = for_each_n(coarse, [&](std::size_t k) {
                 const double error = harmonic_error({.n = coarse[k]}, frequencies_of_fig_22());
                 holds = holds && error < 0.01;
                 return percent(error);
             });
             return {holds, "largest difference " + text};
         }},
        {"22B", "Real and imaginary part agree over the whole range of frequency (n = 60)", "good agreement", true,
         "good: within 1 % of |c11|, each part",
         [](const Results&) -> Finding {
             const std::vector<double> z = frequencies_of_fig_22();
             const std::vector<std::complex<double>> c11 = harmonic_c11({.n = 60}, z);
             double real = 0, imaginary = 0;
             for (std::size_t i = 0; i < z.size(); ++i) {
                 const std::complex<double> reference = detail::polynomial_c11(z[i]);
                 real = std::max(real, std::abs(c11[i].real() - reference.real()) / std::abs(reference));
                 imaginary = std::max(imaginary, std::abs(c11[i].imag() - reference.imag()) / std::abs(reference));
             }
             return {std::max(real, imaginary) < 0.01, "Re " + percent(real) + ", Im " + percent(imaginary)};
         }},
        {"22", "The caption's alpha_L = 1, alpha_T = 0 gives these results", "1/0", false,
         "the indices are swapped: 0/0.63 is meant, as elsewhere",
         [](const Results&) -> Finding {
             const double error = harmonic_error({.n = 60, .alpha_L = 1, .alpha_T = 0}, frequencies_of_fig_22());
             const double slow = harmonic_error({.n = 60, .alpha_L = 1, .alpha_T = 0}, {1e-3});
             return {error < 0.01,
                     "largest difference " + percent(error) + "; " + percent(slow) + " at omega a/V = 0.001"};
         }},
        {"22", "A polynomial of first order is accurate in this range", "accurate", false,
         "only at low frequency; accurate: within 1 %",
         [](const Results&) -> Finding {
             const auto first = [](double z) { return detail::polynomial_c11(z, 1); };
             double limit = 0;
             for (const double z : frequencies_of_fig_22()) {
                 if (largest_c11_error(first, {z}) > 0.01) break;
                 limit = z;
             }
             const double error = largest_c11_error(first, frequencies_of_fig_22());
             return {error < 0.01,
                     "largest error " + percent(error) + "; within 1 % up to omega a/V = " + number(limit, 2)};
         }},
        {"Eqs. 24-26", "The polynomial approach as printed, order 20, gives c11 at omega a/V = 1", "reference", false,
         "the factor l of d(x/a)^l/dx is missing; with it the order 20 meets the closed form",
         [](const Results&) -> Finding {
             const double printed =
                 largest_c11_error([](double z) { return c11_as_printed(z, polynomial_order); }, {1.0});
             const double corrected = largest_c11_error([](double z) { return detail::polynomial_c11(z); }, {1.0});
             return {printed < 0.01,
                     "error " + percent(printed) + " as printed, " + number(corrected, 1) + " with the factor"};
         }},
        {"22", "The polynomial approach of order 20 (with the factor) can serve as reference in this range",
         "reference", true, "against the closed form in Bessel functions",
         [](const Results&) -> Finding {
             const double error =
                 largest_c11_error([](double z) { return detail::polynomial_c11(z); }, frequencies_of_fig_22());
             return {error < 1e-5, "largest error " + number(error, 1)};
         }},
        {"Sec. 7", "Correlation in the dynamic case is similar to that in the static case", "similar", true,
         "similar: the largest error over frequency is below 3 times the static one (n = 60)",
         [](const Results&) -> Finding {
             bool holds = true;
             std::string text;
             for (const double alpha_L : {0.0, 0.5}) {
                 const Case c{.n = 60, .alpha_L = alpha_L, .alpha_T = alpha_L == 0 ? 0.63 : 0.5};
                 const double moving = harmonic_error(c, frequencies_of_fig_22()), still = std::abs(c11_ratio(c) - 1);
                 holds = holds && moving < 3 * still;
                 text += (text.empty() ? "0/0.63: " : "; 0.5/0.5: ") + percent(moving) + " against " + percent(still);
             }
             return {holds, text};
         }},
    };
}

}  // namespace

std::vector<Claim> claims() {
    std::vector<Claim> all;
    for (const std::vector<Claim>& part : {claims_of_steady_collocation(), claims_of_galerkin(), claims_of_meshes(),
                                           claims_of_stability(), claims_of_frequency()}) {
        all.insert(all.end(), part.begin(), part.end());
    }
    return all;
}

}  // namespace paper
