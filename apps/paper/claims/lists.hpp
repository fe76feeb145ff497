// The claims in five lists, and what several of them are judged by.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "paper/claims.hpp"
#include "paper/evaluate.hpp"
#include "paper/figures.hpp"
#include "paper/measures.hpp"
#include "paper/results.hpp"

namespace paper {

std::vector<Claim> claims_of_collocation();  ///< Eq. (31), Figs. 3 and 5 to 10
std::vector<Claim> claims_of_galerkin();     ///< Figs. 11 to 13, and their conclusions
std::vector<Claim> claims_of_meshes();       ///< Figs. 14 to 17, and their conclusions
std::vector<Claim> claims_of_stability();    ///< Figs. 18 to 21
std::vector<Claim> claims_of_frequency();    ///< Fig. 22, Eqs. (24) to (26), and the last conclusion

inline const std::vector<Eigen::Index> fine{40, 60, 80}, coarse{20, 40, 60};

/// "n = 40: a; n = 60: b" with text(k) for every number of elements.
template <class Text>
std::string for_each_n(const std::vector<Eigen::Index>& numbers, const Text& text) {
    std::string result;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        result += (k > 0 ? "; n = " : "n = ") + std::to_string(numbers[k]) + ": " + text(k);
    }
    return result;
}

/// How a claim is judged.
using Judge = std::function<Finding(const Results&)>;

/// Holds if judge(r, k) does for every one of the numbers of elements, all of whose texts follow `text`.
template <class Each>
Judge for_all_n(const std::vector<Eigen::Index>& numbers, const std::string& text, const Each& judge) {
    return [=](const Results& r) -> Finding {
        bool holds = true;
        const std::string all = for_each_n(numbers, [&](std::size_t k) {
            const Finding one = judge(r, k);
            holds = holds && one.holds;
            return one.measured;
        });
        return {holds, text + all};
    };
}

/// Holds if |value(n)| falls below `factor` times that before with every step of n; `shown` gives its text.
template <class Value, class Shown>
Judge falls_with_n(const std::vector<Eigen::Index>& numbers, const std::string& text, const Value& value,
                   const Shown& shown, double factor = 1) {
    return [=](const Results&) -> Finding {
        bool holds = true;
        double before = 1;
        const std::string all = for_each_n(numbers, [&](std::size_t k) {
            const double here = value(numbers[k]);
            holds = holds && std::abs(here) < factor * std::abs(before);
            before = here;
            return shown(here);
        });
        return {holds, text + all};
    };
}

/// Holds if `measure` is below `limit`.
template <class Measure, class Shown>
Judge below(double limit, const Measure& measure, const Shown& shown) {
    return [=](const Results& r) -> Finding {
        const double value = measure(r);
        return {value < limit, shown(value)};
    };
}

/// alpha by 0.05, and 0.63: the finest grid that the paper's alphas show.
inline std::vector<double> paper_alphas() {
    std::vector<double> grid = fractions(0, 20, 20);
    grid.push_back(0.63);
    return grid;
}

/// The smallest error that the paper speaks of, 0.01 % of c11: schemes whose errors differ by less are equally good.
inline constexpr double equal_errors = 1e-4;

inline std::function<double(double)> ratio_over(const Case& c, Vary vary) {
    return [=](double x) { return c11_ratio(at({"", c, vary}, x)); };
}

/// Whether, for each number of elements, no x of the grid has a smaller error than `claimed` (by equal_errors).
/// `curves` are those of the numbers; between `search` lies the true optimum, which is told but not judged.
inline Finding optimum(const std::vector<Points>& curves, const std::vector<Eigen::Index>& numbers, double claimed,
                       const Case& scheme, Vary vary, Range search) {
    bool holds = true;
    const std::string text = for_each_n(numbers, [&](std::size_t k) {
        Case c = scheme;
        c.n = numbers[k];
        const auto [x, y] = best(curves[k]);
        const double own = error_at(curves[k], claimed);
        holds = holds && std::abs(own) <= std::abs(y - 1) + equal_errors;
        const double optimum = true_optimum(ratio_over(c, vary), search.low, search.high);
        return "error " + percent(own) +
               (std::abs(x - claimed) < 1e-9 ? ", the least of the grid"
                                             : ", least of the grid " + percent(y - 1) + " at " + number(x)) +
               ", true optimum " + number(optimum, 4);
    });
    return {holds, text};
}

/// The curves of a panel whose x are alphas, on the paper's grid.
inline std::vector<Points> on_paper_alphas(const Results& r, const std::string& panel) {
    return {on_grid(r.curve(panel, 0), paper_alphas()), on_grid(r.curve(panel, 1), paper_alphas()),
            on_grid(r.curve(panel, 2), paper_alphas())};
}

/// The least errors on the grid of a panel's three ways of varying alpha.
inline std::array<double, 3> three_errors(const Results& r, const std::string& panel) {
    const std::vector<Points> curves = on_paper_alphas(r, panel);
    return {least_error(curves[0]), least_error(curves[1]), least_error(curves[2])};
}
inline std::string three_texts(const std::array<double, 3>& errors) {
    return "least error on the grid: alpha_L = alpha_T " + percent(errors[0]) + ", alpha_L = 0 " + percent(errors[1]) +
           ", alpha_T = 0 " + percent(errors[2]);
}

/// Holds if that way of varying alpha has the smallest, or the largest, of the least errors on the grid of a panel.
inline Judge best_of(const std::string& panel, std::size_t way, bool worst = false) {
    return [=](const Results& r) -> Finding {
        const std::array<double, 3> errors = three_errors(r, panel);
        bool holds = true;
        for (std::size_t k = 0; k < 3; ++k) {
            holds = holds && (k == way || (worst ? errors[way] > errors[k] : errors[way] < errors[k]));
        }
        return {holds, three_texts(errors)};
    };
}

/// optimum() of curves `first`, ... of a panel over alpha, one for each of the numbers.
inline Judge best_alpha(const std::string& panel, const std::vector<Eigen::Index>& numbers, double claimed,
                        const Case& scheme, Vary vary, Range search, std::ptrdiff_t first = 0) {
    return [=](const Results& r) {
        const std::vector<Points> curves = on_paper_alphas(r, panel);
        return optimum({curves.begin() + first, curves.end()}, numbers, claimed, scheme, vary, search);
    };
}

/// Largest difference from Carter's traction at centres between two x/a, over the largest traction: what a plot shows.
inline double visible_difference(const Tractions& t, double trailing, double leading) {
    const Eigen::ArrayXd difference = (t.value - t.carter).abs() / t.value.abs().maxCoeff();
    return (t.x > trailing && t.x < leading).select(difference, 0.0).maxCoeff();
}

/// Where a curve over alpha or lambda leaves 0.
inline std::string onset(const Points& points) {
    const std::optional<double> first = first_positive(points);
    return first ? "from " + number(*first) : "none";
}

}  // namespace paper
