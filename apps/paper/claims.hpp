// The statements of the paper's sections 3 to 7: a few of its words, how they are measured here, and whether they hold.
// Each statement counts once, where it is first made. Results that the paper does not have are marked as additions.
// Thresholds are fixed in claims/ and given in the remarks; none depends on the result.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

#include "figures.hpp"

namespace paper {

struct Finding {
    bool holds;
    std::string measured;
};

struct Claim {
    std::string figure;
    std::string quote;   ///< the paper's words; empty for an addition
    std::string claim;   ///< what is judged
    std::string remark;  ///< how it is judged, or why it does not hold
    Finding finding;
    bool expected = true;  ///< to hold

    bool is_addition() const { return quote.empty(); }
    bool as_expected() const { return finding.holds == expected; }
};
using Claims = std::vector<Claim>;

// Claims that are judged together, by the curves of the figures and by what else they compute.
Claims equations(const Results& r);                       ///< Eqs. (8) to (16) and (29)
Claims kernel_and_alpha(const Results& r);                ///< Eq. (31), Figs. 3 and 5
Claims convergence(const Results& r);                     ///< Fig. 6
Claims analytic_derivative_over_alpha(const Results& r);  ///< Fig. 7
Claims analytic_derivative_over_n(const Results& r);      ///< Fig. 8
Claims tractions_of_collocation(const Results& r);        ///< Figs. 9 and 10
Claims galerkin_claims(const Results& r);                 ///< Figs. 11 to 13, and conclusions
Claims costs_of_galerkin(const Results& r);               ///< conclusions, timed
Claims gradings(const Results& r);                        ///< Figs. 14 to 16
Claims tractions_on_meshes(const Results& r);             ///< Fig. 17
Claims conclusions_on_steady_rolling(const Results& r);
Claims stability_of_collocation(const Results& r);  ///< Figs. 18 and 19
Claims stability_of_galerkin(const Results& r);     ///< Fig. 20
Claims split_points(const Results& r);              ///< Fig. 21
Claims claims_on_frequency(const Results& r);       ///< Fig. 22, Eqs. (24) to (26), and the last conclusion

// --- what is shown of them (page.cpp)

/// "60 statements of the paper: 53 hold, 7 do not hold as printed; 10 additions: all hold; 0 differ from what is
/// expected"
std::string summary(const Claims& claims);

/// The remark, or a note that the finding differs from what is expected.
std::string reason(const Claim& claim);

/// claims.csv.
std::string csv_of(const Claims& claims);

/// index.html. `drawn` are the panels that have an SVG file beside it; `note` is shown at the top if there is one.
std::string page(const Results& results, const Claims& claims, const std::set<std::string>& drawn,
                 const std::string& note);

// --- texts

inline std::string number(double value, int digits = 3) {
    std::array<char, 64> text;
    return {text.data(),
            std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}
inline std::string percent(double value, int digits = 2) { return number(100 * value, digits) + " %"; }

/// `text` with the values in place of its braces: numbers with three digits or, for {1}, one; {%} in percent, with two
/// digits or, for {%1}, one; counts and texts as they are.
template <class... Values>
std::string say(const std::string& text, const Values&... values) {
    std::string result;
    std::size_t done = 0;
    const auto add = [&](const auto& value) {
        const std::size_t first = text.find('{', done), last = text.find('}', first);
        result += text.substr(done, first - done);
        done = last + 1;
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_floating_point_v<Value>) {
            const bool share = text[first + 1] == '%';
            const std::string digits = text.substr(first + 1 + share, last - first - 1 - share);
            const int count = digits.empty() ? (share ? 2 : 3) : std::stoi(digits);
            result += share ? percent(value, count) : number(value, count);
        } else if constexpr (std::is_arithmetic_v<Value>) {
            result += std::to_string(value);
        } else {
            result += value;
        }
    };
    (add(values), ...);
    return result + text.substr(done);
}

// --- what several claims are judged by

/// A finding whose text say() makes of the values.
template <class... Values>
Finding judged(bool holds, const std::string& text, const Values&... values) {
    return {holds, say(text, values...)};
}

/// A finding that holds if the value is below the limit.
inline Finding below(double limit, double value, const std::string& text) { return judged(value < limit, text, value); }

/// "n = 40: a; n = 60: b" with text(k) for every number of elements.
template <class Text>
std::string for_each_n(const std::vector<Eigen::Index>& numbers, const Text& text) {
    std::string result;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        result += say(k > 0 ? "; n = {}: " : "n = {}: ", numbers[k]) + text(k);
    }
    return result;
}

/// A finding that holds if judge(k) does for every one of the numbers of elements, all of whose texts follow `text`.
template <class Each>
Finding for_all_n(const std::vector<Eigen::Index>& numbers, const std::string& text, const Each& judge) {
    bool holds = true;
    const std::string all = for_each_n(numbers, [&](std::size_t k) {
        const Finding one = judge(k);
        holds = holds && one.holds;
        return one.measured;
    });
    return {holds, text + all};
}

/// A finding that holds if |value(n)| falls below `factor` times its predecessor with every step of n; `shown` is the
/// form of its text.
template <class Value>
Finding falls_with_n(const std::vector<Eigen::Index>& numbers, const std::string& text, const std::string& shown,
                     const Value& value, double factor = 1) {
    double before = 1;
    return for_all_n(numbers, text, [&](std::size_t k) -> Finding {
        const double here = value(numbers[k]);
        const bool falls = std::abs(here) < factor * std::abs(before);
        before = here;
        return judged(falls, shown, here);
    });
}

/// alpha by 0.05, and 0.63: the finest grid that the paper's alphas show.
inline std::vector<double> paper_alphas() {
    std::vector<double> grid = fractions(0, 20, 20);
    grid.push_back(0.63);
    return grid;
}

/// The smallest error that the paper speaks of, 0.01 % of c11: schemes whose errors differ by less are equally good.
inline constexpr double equal_errors = 1e-4;

/// The error that a reading of an optimum off the paper's plots may have. Errors nearby say nothing on it where all are
/// below equal_errors.
inline constexpr double near_optimum = 0.02;

inline double ratio_at(const Case& c, Vary vary, double x) { return c11_ratio(at(c, vary, x)); }

/// The x between the ends of `search` at which c11 is nearest to its exact value.
inline double optimum_of(Case c, Eigen::Index n, Vary vary, Range search) {
    c.n = n;
    return true_optimum([&](double x) { return ratio_at(c, vary, x); }, search.low, search.high);
}

/// Whether, for each number of elements, no x of the grid has a smaller error than `claimed`, or the true optimum is
/// nearer than near_optimum. `curves` belong to `numbers`; the true optimum lies between the ends of `search`.
inline Finding optimum(const std::vector<Points>& curves, const std::vector<Eigen::Index>& numbers, double claimed,
                       const Case& scheme, Vary vary, Range search) {
    return for_all_n(numbers, "", [&](std::size_t k) -> Finding {
        const auto [x, y] = best(curves[k]);
        const double own = error_at(curves[k], claimed), truth = optimum_of(scheme, numbers[k], vary, search);
        const bool is_least = std::abs(x - claimed) < 1e-9;
        const std::string least = is_least ? ", the least of the grid" : say(", least of the grid {%} at {}", y - 1, x);
        return judged(is_least || std::abs(truth - claimed) < near_optimum, "error {%}{}, true optimum {4}", own, least,
                      truth);
    });
}

/// The three curves of a panel; if their x are alphas, on the paper's grid.
inline std::vector<Points> curves_of(const Results& r, const std::string& panel) {
    return {r.curve(panel, 0), r.curve(panel, 1), r.curve(panel, 2)};
}
inline std::vector<Points> on_paper_alphas(const Results& r, const std::string& panel) {
    std::vector<Points> curves = curves_of(r, panel);
    for (Points& curve : curves) curve = on_grid(curve, paper_alphas());
    return curves;
}

/// A finding that holds if a way of varying alpha has the smallest, or the largest, of the least errors on the grid of
/// a panel.
inline Finding best_of(const Results& r, const std::string& panel, std::size_t way, bool worst = false) {
    std::array<double, 3> errors;
    for (std::size_t k = 0; k < 3; ++k) errors[k] = least_error(on_paper_alphas(r, panel)[k]);
    bool holds = true;
    for (std::size_t k = 0; k < 3; ++k) {
        holds = holds && (k == way || (worst ? errors[way] > errors[k] : errors[way] < errors[k]));
    }
    return judged(holds, "least error on the grid: alpha_L = alpha_T {%}, alpha_L = 0 {%}, alpha_T = 0 {%}", errors[0],
                  errors[1], errors[2]);
}

/// Whether, for each number of elements n, ratio(n, x) errs least at `claimed` among the x of a grid: for what is read
/// otherwise here than it is printed.
template <class Ratio>
Finding errs_least_at(double claimed, const std::vector<double>& grid, const Ratio& ratio) {
    return for_all_n(fine, "", [&](std::size_t k) -> Finding {
        Points curve;
        for (const double x : grid) curve.emplace_back(x, ratio(fine[k], x));
        const auto [x, y] = best(curve);
        return judged(std::abs(x - claimed) < 1e-9, "error {%} at {}, least of the grid {%} at {}",
                      error_at(curve, claimed), claimed, y - 1, x);
    });
}

/// optimum() of curves `first`, ... of a panel over alpha, one for each of the numbers.
inline Finding best_alpha(const Results& r, const std::string& panel, const std::vector<Eigen::Index>& numbers,
                          double claimed, const Case& scheme, Vary vary, Range search, std::ptrdiff_t first = 0) {
    const std::vector<Points> curves = on_paper_alphas(r, panel);
    return optimum({curves.begin() + first, curves.end()}, numbers, claimed, scheme, vary, search);
}

/// Largest differences from Carter's traction at centres between two x/a: over the largest traction, which is what a
/// plot shows, and over his own there.
struct Difference {
    double visible, local;
};
inline Difference from_carter(const Tractions& t, double trailing, double leading) {
    const auto largest = [&](const Eigen::ArrayXd& unit) {
        const Eigen::ArrayXd difference = ((t.value - t.carter) / unit).abs();
        return (t.x > trailing && t.x < leading).select(difference, 0.0).maxCoeff();
    };
    return {largest(Eigen::ArrayXd::Constant(t.x.size(), t.value.abs().maxCoeff())), largest(t.carter)};
}

/// The text on the alpha or lambda at which a curve leaves 0.
inline std::string onset(const Points& points) {
    const std::optional<double> first = first_positive(points);
    return first ? "from " + number(*first) : "none";
}

}  // namespace paper
