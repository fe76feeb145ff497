// A panel of the table computed: its rows as CSV and its curves as a plot.
// Everything numerical is asked of the library through evaluate.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/polynomial.hpp>
#include <rollbem/reference/bessel.hpp>

#include "evaluate.hpp"
#include "figures.hpp"
#include "measures.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace paper {

inline constexpr Eigen::Index polynomial_order = 20;  ///< of the reference in Fig. 22

struct CurveResult {
    std::vector<study::Row> rows;
    std::vector<study::Series> series;  ///< what is drawn; of the first one, claims use the points
};

struct PanelResult {
    Panel panel;
    std::vector<CurveResult> curves;
};

/// All panels, and access to their curves for the claims.
class Results {
public:
    explicit Results(const std::vector<Panel>& panels) {
        for (const Panel& panel : panels) panels_.push_back({panel, std::vector<CurveResult>(panel.curves.size())});
    }

    std::vector<PanelResult>& panels() { return panels_; }
    const std::vector<PanelResult>& panels() const { return panels_; }

    /// Points of curve `index`, counted from 0, of a panel such as "05a".
    const Points& curve(const std::string& figure, std::size_t index) const {
        for (const PanelResult& result : panels_) {
            if (result.panel.figure == figure) return result.curves.at(index).series.at(0).points;
        }
        throw std::logic_error("no panel " + figure);
    }

private:
    std::vector<PanelResult> panels_;
};

namespace detail {

/// Labels are written in ASCII for the CSV; drawn, they get Greek letters.
inline std::string with_greek(std::string text) {
    for (const auto& [word, letter] :
         {std::pair{"alpha", "α"}, {"epsilon", "ε"}, {"lambda", "λ"}, {"omega", "ω"}, {"xi", "ξ"}}) {
        for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i)) {
            text.replace(i, std::string(word).size(), letter);
        }
    }
    return text;
}

inline bool has_case(Quantity quantity) { return quantity != Quantity::displacement && quantity != Quantity::slope; }

inline std::string y_label(Quantity quantity) {
    switch (quantity) {
        case Quantity::displacement: return "u G / (p a)";
        case Quantity::slope: return "(du/dx) G / p";
        case Quantity::c11_ratio: return "c_{11}^* / c_{11}";
        case Quantity::traction: return "p / (G ξ)";
        case Quantity::unstable_fraction: return "proportion of unstable eigenvalues";
        case Quantity::argand: return "Im c_{11}";
        case Quantity::response: return "Re c_{11}, Im c_{11}";
    }
    return "";
}

template <class... Values>
void append(study::Row& row, const Values&... values) {
    (row.emplace_back(values), ...);
}

/// A row of `result`: the curve, its case and the values computed.
template <class... Values>
void add_row(CurveResult& result, const Curve& curve, const Case& c, const Values&... values) {
    study::Row row;
    append(row, curve.label, name(c.method), name(c.derivative), name(c.mesh));
    c.mesh == Topology::uniform ? append(row, "") : append(row, c.grading);
    append(row, c.n, c.alpha_L, c.alpha_T, c.lambda, values...);
    result.rows.push_back(std::move(row));
}

/// The polynomial approach of order 20 with the factor of d(x/a)^l/dx, which Eqs. (24) to (26) lack.
inline std::complex<double> polynomial_c11(double z, Eigen::Index order = polynomial_order) {
    return rollbem::solve_monomial<double>(std::complex<double>(0, z), poisson_ratio, aspect, order).c11;
}

inline CurveResult compute_field(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .points = {}, .markers = false}}};
    for (double x : panel.grid) {
        const bool displacement = panel.quantity == Quantity::displacement;
        if (!displacement && std::abs(std::abs(x) - 0.5) < 1e-9) x += x > 0 ? -1e-9 : 1e-9;
        const ElementField field = element_field(x);
        const double value = displacement ? field.displacement : field.slope;
        append(result.rows.emplace_back(), x, value);
        result.series[0].points.emplace_back(x, value);
    }
    return result;
}

inline CurveResult compute_over_grid(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .points = {}, .markers = panel.axes.markers}}};
    for (const double x : panel.grid) {
        const Case c = at(curve, x);
        double value = 0;
        if (panel.quantity == Quantity::c11_ratio) {
            value = c11_ratio(c);
            add_row(result, curve, c, value, value - 1);
        } else {
            const Eigen::Index count = unstable_count(c);
            value = static_cast<double>(count) / static_cast<double>(c.n);
            add_row(result, curve, c, count, value);
        }
        if (std::isfinite(value)) result.series[0].points.emplace_back(x, value);
    }
    return result;
}

inline CurveResult compute_traction(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .points = {}, .markers = panel.axes.markers}}};
    const Tractions traction = tractions(curve.at);
    for (Eigen::Index i = 0; i < traction.x.size(); ++i) {
        add_row(result, curve, curve.at, traction.x[i], traction.value[i], traction.carter[i], traction.carter_mean[i]);
        result.series[0].points.emplace_back(traction.x[i], traction.value[i]);
    }
    return result;
}

inline CurveResult compute_response(const Panel& panel, const Curve& curve) {
    CurveResult result;
    const bool argand = panel.quantity == Quantity::argand;
    const auto points_only = [](const std::string& label) {
        return study::Series{.label = label, .points = {}, .markers = true, .line = false};
    };
    result.series.push_back(points_only(argand ? curve.label : "Re, " + curve.label));
    if (!argand) result.series.push_back(points_only("Im, " + curve.label));
    const std::vector<std::complex<double>> c11 = harmonic_c11(curve.at, panel.grid);
    for (std::size_t i = 0; i < c11.size(); ++i) {
        const double z = panel.grid[i];
        const std::complex<double> polynomial = polynomial_c11(z);
        const std::complex<double> exact = rollbem::reference::harmonic_c11(z, poisson_ratio, aspect);
        add_row(result, curve, curve.at, z, c11[i].real(), c11[i].imag(), polynomial.real(), polynomial.imag(),
                exact.real(), exact.imag(), std::abs(c11[i] - exact) / std::abs(exact));
        if (argand) {
            result.series[0].points.emplace_back(c11[i].real(), c11[i].imag());
        } else {
            result.series[0].points.emplace_back(z, c11[i].real());
            result.series[1].points.emplace_back(z, c11[i].imag());
        }
    }
    return result;
}

/// Carter's traction as far as it is no larger than the computed ones.
inline study::Series carter_line(const PanelResult& result) {
    double largest = 0;
    for (const CurveResult& curve : result.curves) {
        for (const auto& point : curve.series[0].points) largest = std::max(largest, std::abs(point.second));
    }
    study::Series line{.label = "Carter", .points = {}, .markers = false};
    constexpr int count = 2000;
    for (int k = 1; k < count; ++k) {  // dense at both edges
        const double angle = std::numbers::pi * k / count;
        const double traction = rollbem::carter_traction(-std::cos(angle), poisson_ratio);
        if (std::abs(traction) <= 1.1 * largest) line.points.emplace_back(-std::cos(angle), traction);
    }
    return line;
}

inline void add_polynomial(study::Plot& plot, const Panel& panel) {
    const bool argand = panel.quantity == Quantity::argand;
    const std::string label = "polynomial, order " + std::to_string(polynomial_order);
    study::Series first{.label = argand ? label : "Re, " + label, .points = {}, .markers = false};
    study::Series second{.label = "Im, " + label, .points = {}, .markers = false};
    for (const double z : logarithmic(panel.grid.front(), panel.grid.back(), 301)) {
        const std::complex<double> c11 = polynomial_c11(z);
        if (argand) {
            first.points.emplace_back(c11.real(), c11.imag());
        } else {
            first.points.emplace_back(z, c11.real());
            second.points.emplace_back(z, c11.imag());
        }
    }
    plot.series.push_back(first);
    if (!argand) plot.series.push_back(second);
}

}  // namespace detail

/// The columns of a panel's CSV file.
inline std::vector<std::string> columns(Quantity quantity) {
    std::vector<std::string> result;
    if (detail::has_case(quantity)) {
        result = {"curve", "method", "derivative", "mesh", "grading", "n", "alpha_L", "alpha_T", "lambda"};
    }
    const auto append = [&](const std::vector<std::string>& names) {
        result.insert(result.end(), names.begin(), names.end());
    };
    switch (quantity) {
        case Quantity::displacement: append({"x_over_width", "displacement"}); break;
        case Quantity::slope: append({"x_over_width", "slope"}); break;
        case Quantity::c11_ratio: append({"c11_ratio", "relative_error"}); break;
        case Quantity::traction: append({"x_over_a", "traction", "carter", "carter_mean"}); break;
        case Quantity::unstable_fraction: append({"unstable_count", "unstable_fraction"}); break;
        case Quantity::argand:
        case Quantity::response:
            append({"omega", "c11_re", "c11_im", "polynomial_re", "polynomial_im", "exact_re", "exact_im",
                    "relative_error"});
            break;
    }
    return result;
}

inline CurveResult compute(const Panel& panel, const Curve& curve) {
    switch (panel.quantity) {
        case Quantity::displacement:
        case Quantity::slope: return detail::compute_field(panel, curve);
        case Quantity::c11_ratio:
        case Quantity::unstable_fraction: break;
        case Quantity::traction: return detail::compute_traction(panel, curve);
        case Quantity::argand:
        case Quantity::response: return detail::compute_response(panel, curve);
    }
    return detail::compute_over_grid(panel, curve);
}

inline study::Plot plot(const PanelResult& result) {
    const Panel& panel = result.panel;
    study::Plot plot{.title = "Fig. " + printed(panel.figure) + "  " + detail::with_greek(panel.title),
                     .x_label = detail::with_greek(panel.x_label),
                     .y_label = detail::y_label(panel.quantity),
                     .log_x = panel.axes.log_base > 0,
                     .series = {}};
    if (plot.log_x) plot.log_base = panel.axes.log_base;
    if (panel.axes.x) plot.x_range = study::PlotRange{panel.axes.x->low, panel.axes.x->high};
    if (panel.axes.y) plot.y_range = study::PlotRange{panel.axes.y->low, panel.axes.y->high};
    for (const CurveResult& curve : result.curves) {
        plot.series.insert(plot.series.end(), curve.series.begin(), curve.series.end());
    }
    if (panel.quantity == Quantity::traction) plot.series.push_back(detail::carter_line(result));
    if (panel.quantity == Quantity::argand || panel.quantity == Quantity::response) detail::add_polynomial(plot, panel);
    return plot;
}

}  // namespace paper
