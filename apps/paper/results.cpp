// The panels computed; all numbers come from evaluate.hpp.
#include "results.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/monomial.hpp>
#include <rollbem/reference/bessel.hpp>

#include "evaluate.hpp"

namespace paper {

std::string with_greek(std::string text) {
    const auto is_letter = [&](std::size_t i) {
        return i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0;
    };
    for (const auto& [word, letter] :
         {std::pair{"alpha", "α"}, {"epsilon", "ε"}, {"lambda", "λ"}, {"omega", "ω"}, {"xi", "ξ"}}) {
        const std::size_t size = std::string(word).size();
        for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) {
            const bool plural = i + size < text.size() && text[i + size] == 's' && !is_letter(i + size + 1);
            const bool apart = (i == 0 || !is_letter(i - 1)) && (plural || !is_letter(i + size));
            if (apart) text.replace(i, size, letter);
        }
    }
    return text;
}

std::complex<double> polynomial_c11(double z, Eigen::Index order) {
    return rollbem::solve_monomial<double>(std::complex<double>(0, z), poisson_ratio, aspect, order).c11;
}

namespace {

bool has_case(Quantity quantity) { return quantity != Quantity::displacement && quantity != Quantity::slope; }

std::string y_label(Quantity quantity) {
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

CurveResult compute_field(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .markers = false}}};
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

CurveResult compute_over_grid(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .markers = panel.axes.markers}}};
    for (const double x : panel.grid) {
        const Case c = at(curve, x);
        if (panel.quantity == Quantity::c11_ratio) {
            const SteadyRatio ratio = steady_ratio(c);
            add_row(result, curve, c, ratio.value, ratio.value - 1, rollbem::name(ratio.status));
            if (std::isfinite(ratio.value)) result.series[0].points.emplace_back(x, ratio.value);
        } else {
            const Eigen::Index count = unstable_count(c);
            const double share = static_cast<double>(count) / static_cast<double>(c.n);
            // stable eigenvalues do not make a scheme converge to full adhesion
            const bool converges = steady_ratio(c).status != rollbem::Status::assists_creepage;
            add_row(result, curve, c, count, share,
                    rollbem::name(converges ? rollbem::Status::ok : rollbem::Status::assists_creepage));
            result.series[0].points.emplace_back(x, share);
        }
    }
    return result;
}

CurveResult compute_traction(const Panel& panel, const Curve& curve) {
    CurveResult result{{}, {{.label = with_greek(curve.label), .markers = panel.axes.markers}}};
    const Tractions traction = tractions(curve.at);
    for (Eigen::Index i = 0; i < traction.x.size(); ++i) {
        add_row(result, curve, curve.at, traction.x[i], traction.value[i], traction.carter[i], traction.carter_mean[i],
                rollbem::name(traction.status));
        result.series[0].points.emplace_back(traction.x[i], traction.value[i]);
    }
    return result;
}

CurveResult compute_response(const Panel& panel, const Curve& curve) {
    CurveResult result;
    const bool argand = panel.quantity == Quantity::argand;
    const auto points_only = [](const std::string& label) {
        return study::Series{.label = label, .markers = true, .line = false};
    };
    result.series.push_back(points_only(argand ? curve.label : "Re, " + curve.label));
    if (!argand) result.series.push_back(points_only("Im, " + curve.label));
    const std::vector<HarmonicResponse> responses = harmonic_responses(curve.at, panel.grid);
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const double z = panel.grid[i];
        const std::complex<double> c11 = responses[i].c11;
        const std::complex<double> polynomial = polynomial_c11(z);
        const std::complex<double> exact = rollbem::reference::plane_c11({0, z}, poisson_ratio, aspect);
        add_row(result, curve, curve.at, z, c11.real(), c11.imag(), polynomial.real(), polynomial.imag(), exact.real(),
                exact.imag(), std::abs(c11 - exact) / std::abs(exact), rollbem::name(responses[i].status));
        if (argand) {
            result.series[0].points.emplace_back(c11.real(), c11.imag());
        } else {
            result.series[0].points.emplace_back(z, c11.real());
            result.series[1].points.emplace_back(z, c11.imag());
        }
    }
    return result;
}

/// Carter's traction as far as it does not exceed the computed ones.
study::Series carter_line(const PanelResult& result) {
    double largest = 0;
    for (const CurveResult& curve : result.curves) {
        for (const auto& point : curve.series[0].points) largest = std::max(largest, std::abs(point.second));
    }
    study::Series line{.label = "Carter", .markers = false, .reference = true};
    constexpr int count = 2000;
    for (int k = 1; k < count; ++k) {  // dense at both edges
        const double angle = std::numbers::pi * k / count;
        const double traction = rollbem::carter_traction(-std::cos(angle), poisson_ratio);
        if (std::abs(traction) <= 1.1 * largest) line.points.emplace_back(-std::cos(angle), traction);
    }
    return line;
}

void add_polynomial(study::Plot& plot, const Panel& panel) {
    const bool argand = panel.quantity == Quantity::argand;
    const std::string label = "polynomial, order " + std::to_string(polynomial_order);
    study::Series first{.label = argand ? label : "Re, " + label, .markers = false, .reference = true};
    study::Series second{.label = "Im, " + label, .markers = false, .reference = true};
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

}  // namespace

std::vector<std::string> columns(Quantity quantity) {
    std::vector<std::string> result;
    if (has_case(quantity)) {
        result = {"curve", "method", "derivative", "mesh", "grading", "n", "alpha_L", "alpha_T", "lambda"};
    }
    const auto append = [&](const std::vector<std::string>& names) {
        result.insert(result.end(), names.begin(), names.end());
    };
    switch (quantity) {
        case Quantity::displacement: append({"x_over_width", "displacement"}); break;
        case Quantity::slope: append({"x_over_width", "slope"}); break;
        case Quantity::c11_ratio: append({"c11_ratio", "relative_error", "status"}); break;
        case Quantity::traction: append({"x_over_a", "traction", "carter", "carter_mean", "status"}); break;
        case Quantity::unstable_fraction: append({"unstable_count", "unstable_fraction", "status"}); break;
        case Quantity::argand:
        case Quantity::response:
            append({"omega", "c11_re", "c11_im", "polynomial_re", "polynomial_im", "exact_re", "exact_im",
                    "relative_error", "status"});
            break;
    }
    return result;
}

CurveResult compute(const Panel& panel, const Curve& curve) {
    switch (panel.quantity) {
        case Quantity::displacement:
        case Quantity::slope: return compute_field(panel, curve);
        case Quantity::c11_ratio:
        case Quantity::unstable_fraction: break;
        case Quantity::traction: return compute_traction(panel, curve);
        case Quantity::argand:
        case Quantity::response: return compute_response(panel, curve);
    }
    return compute_over_grid(panel, curve);
}

study::Plot plot(const PanelResult& result) {
    const Panel& panel = result.panel;
    study::Plot plot{.title = "Fig. " + printed(panel.figure) + "  " + with_greek(panel.title),
                     .x_label = with_greek(panel.x_label),
                     .y_label = y_label(panel.quantity),
                     .log_x = panel.axes.log_base > 0};
    if (plot.log_x) plot.log_base = panel.axes.log_base;
    if (panel.axes.x) plot.x_range = study::PlotRange{panel.axes.x->low, panel.axes.x->high};
    if (panel.axes.y) plot.y_range = study::PlotRange{panel.axes.y->low, panel.axes.y->high};
    for (const CurveResult& curve : result.curves) {
        plot.series.insert(plot.series.end(), curve.series.begin(), curve.series.end());
    }
    if (panel.quantity == Quantity::traction) plot.series.push_back(carter_line(result));
    if (panel.quantity == Quantity::argand || panel.quantity == Quantity::response) {
        // Open markers, since the points of all n nearly coincide.
        for (study::Series& series : plot.series) series.open = true;
        add_polynomial(plot, panel);
    }
    return plot;
}

}  // namespace paper
