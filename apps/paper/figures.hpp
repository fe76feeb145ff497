// The figures of the paper as one table: what each panel shows, over what, for which discretisations. Axes and ranges
// are chosen to show what the text says.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "evaluate.hpp"
#include "support/plot.hpp"

namespace paper {

enum class Quantity { displacement, slope, c11_ratio, traction, unstable_fraction, argand, response };

/// The variable that a curve's x values stand for.
enum class Vary { nothing, both_alphas, alpha_L, alpha_T, n, grading, lambda };

struct Curve {
    std::string label;
    Case at{};
    Vary vary = Vary::nothing;
};

using Range = study::PlotRange;

struct Axes {
    int log_base = 0;  ///< of a logarithmic x axis; 0 for a linear one
    bool markers = false;
    std::optional<Range> x{}, y{};  ///< the range drawn; the data may exceed it
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

/// "05a" in the paper's form, "5A".
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

/// The numbers of elements that the paper compares.
inline const std::vector<Eigen::Index> fine{40, 60, 80}, coarse{20, 40, 60};

/// Figs. 3, 5 to 9 and 10 to 22, in the paper's order.
std::vector<Panel> panels();

}  // namespace paper
