// The figures of the paper as one table: what each panel shows, over what, for which discretisations; and the panels
// computed: rows for the CSV file and curves for the plot. Axes and ranges are chosen to show what the text says.
#pragma once

#include <cmath>
#include <complex>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "evaluate.hpp"
#include "measures.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace paper {

enum class Quantity { displacement, slope, c11_ratio, traction, unstable_fraction, argand, response };

/// The variable that a curve's x values stand for.
enum class Vary { nothing, both_alphas, alpha_L, alpha_T, n, grading, lambda };

struct Curve {
    std::string label;
    Case at{};
    Vary vary = Vary::nothing;
    // computed
    std::vector<study::Row> rows{};
    std::vector<study::Series> series{};  ///< what is drawn; claims use the points of the first
};

using Range = study::PlotRange;

/// The properties that panels have in common.
struct Family {
    Quantity quantity;
    std::vector<double> grid;     ///< x values; empty where the elements are the x values
    std::string x_label, choice;  ///< choice: what was chosen where the paper is silent
    bool logarithmic = false;     ///< of x
};

struct Panel : Family {
    std::string figure;  ///< number of two digits and letter
    std::string title;
    std::vector<Curve> curves;
    std::optional<Range> x{}, y{};  ///< the range drawn; the data may exceed it
};

/// "05a" in the paper's form, "5A".
inline std::string printed(const std::string& figure) {
    return std::to_string(std::stoi(figure)) + char(figure.back() - 'a' + 'A');
}

/// The case with its variable set to x.
inline Case at(Case c, Vary vary, double x) {
    switch (vary) {
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

/// All panels computed, and access to their curves for the claims.
struct Results {
    std::vector<Panel> panels;

    /// Points of curve `index`, counted from 0, of a panel such as "05a".
    const Points& curve(const std::string& figure, std::size_t index) const {
        for (const Panel& panel : panels) {
            if (panel.figure == figure) return panel.curves.at(index).series.at(0).points;
        }
        throw std::logic_error("no panel " + figure);
    }
};

void compute(const Panel& panel, Curve& curve);

std::string csv_of(const Panel& panel);
study::Picture picture(const Panel& panel);

/// Labels are ASCII in the CSV files; where they are shown they get Greek letters.
std::string with_greek(std::string text);

inline constexpr Eigen::Index polynomial_order = 20;  ///< of the reference in Fig. 22

/// The polynomial approach with the factor of d(x/a)^l/dx, which Eqs. (24) to (26) lack; z = omega a/V.
std::complex<double> polynomial_c11(double z, Eigen::Index order = polynomial_order);

}  // namespace paper
