// The panels computed; all numbers come from evaluate.hpp.
#include "results.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/studies.hpp>
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
    return rollbem::studies::solve_monomial<double>(std::complex<double>(0, z), poisson_ratio, aspect, order).c11;
}

namespace {

/// A row of `result`: the curve, its case and the values computed.
void add_row(CurveResult& result, const Curve& curve, const Case& c, const study::Row& values) {
    const bool graded = !rollbem::topology_info(c.mesh).grading.empty();
    const study::Cell grading = graded ? study::Cell(c.grading) : study::Cell("");
    result.rows.push_back(study::joined<study::Cell>(
        {curve.label, name(c.method), name(c.derivative), name(c.mesh), grading, c.n, c.alpha_L, c.alpha_T, c.lambda},
        values));
}

CurveResult line(const Panel& panel, const Curve& curve) {
    return {{}, {{.label = with_greek(curve.label), .markers = panel.axes.markers}}};
}

CurveResult compute_field(const Panel& panel, const Curve& curve) {
    CurveResult result = line(panel, curve);
    for (double x : panel.grid) {
        const bool displacement = panel.quantity == Quantity::displacement;
        if (!displacement && std::abs(std::abs(x) - 0.5) < 1e-9) x += x > 0 ? -1e-9 : 1e-9;
        const ElementField field = element_field(x);
        const double value = displacement ? field.displacement : field.slope;
        result.rows.push_back({x, value});
        result.series[0].points.emplace_back(x, value);
    }
    return result;
}

CurveResult compute_ratio(const Panel& panel, const Curve& curve) {
    CurveResult result = line(panel, curve);
    for (const double x : panel.grid) {
        const Case c = at(curve, x);
        const rollbem::Response<double> solution = steady(c);
        const double ratio = solution.c11() / rollbem::steady_c11(poisson_ratio);
        add_row(result, curve, c, {ratio, ratio - 1, rollbem::name(solution.status)});
        result.series[0].points.emplace_back(x, ratio);
    }
    return result;
}

CurveResult compute_stability(const Panel& panel, const Curve& curve) {
    CurveResult result = line(panel, curve);
    for (const double x : panel.grid) {
        const Case c = at(curve, x);
        const Eigen::Index count = unstable_count(c);
        const double share = static_cast<double>(count) / static_cast<double>(c.n);
        // stable eigenvalues do not make a scheme converge to full adhesion
        const bool converges = steady(c).status != rollbem::Status::assists_creepage;
        const auto status = converges ? rollbem::Status::ok : rollbem::Status::assists_creepage;
        add_row(result, curve, c, {count, share, rollbem::name(status)});
        result.series[0].points.emplace_back(x, share);
    }
    return result;
}

CurveResult compute_traction(const Panel& panel, const Curve& curve) {
    CurveResult result = line(panel, curve);
    const Tractions traction = tractions(curve.at);
    for (Eigen::Index i = 0; i < traction.x.size(); ++i) {
        add_row(result, curve, curve.at,
                {traction.x[i], traction.value[i], traction.carter[i], traction.carter_mean[i],
                 rollbem::name(traction.status)});
        result.series[0].points.emplace_back(traction.x[i], traction.value[i]);
    }
    return result;
}

/// Adds c11 at z to its curve in the complex plane, or to those of real and imaginary part over frequency.
void add_response(std::vector<study::Series>& series, double z, const std::complex<double>& c11) {
    if (series.size() == 1) {
        series[0].points.emplace_back(c11.real(), c11.imag());
    } else {
        series[0].points.emplace_back(z, c11.real());
        series[1].points.emplace_back(z, c11.imag());
    }
}

/// Those curves, empty.
std::vector<study::Series> response_series(Quantity quantity, const std::string& label, const study::Series& form) {
    std::vector<study::Series> series(quantity == Quantity::argand ? 1 : 2, form);
    series[0].label = quantity == Quantity::argand ? label : "Re, " + label;
    if (series.size() > 1) series[1].label = "Im, " + label;
    return series;
}

CurveResult compute_response(const Panel& panel, const Curve& curve) {
    // open markers, since the points of all n nearly coincide
    CurveResult result{
        {}, response_series(panel.quantity, curve.label, {.label = {}, .markers = true, .line = false, .open = true})};
    const std::vector<HarmonicResponse> responses = harmonic_responses(curve.at, panel.grid);
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const double z = panel.grid[i];
        const std::complex<double> c11 = responses[i].c11, polynomial = polynomial_c11(z);
        const std::complex<double> exact = rollbem::reference::plane_c11({0, z}, poisson_ratio, aspect);
        add_row(result, curve, curve.at,
                {z, c11.real(), c11.imag(), polynomial.real(), polynomial.imag(), exact.real(), exact.imag(),
                 std::abs(c11 - exact) / std::abs(exact), rollbem::name(responses[i].status)});
        add_response(result.series, z, c11);
    }
    return result;
}

/// What a panel shows: the label of its axis, its columns behind those of the case, and how a curve is computed.
struct Kind {
    std::string y_label;
    std::vector<std::string> columns;
    CurveResult (*compute)(const Panel&, const Curve&);
    bool has_case = true;
};

const Kind& kind_of(Quantity quantity) {
    static const std::vector<std::string> response{"omega",         "c11_re",         "c11_im",
                                                   "polynomial_re", "polynomial_im",  "exact_re",
                                                   "exact_im",      "relative_error", "status"};
    static const std::map<Quantity, Kind> kinds{
        {Quantity::displacement, {"u G / (p a)", {"x_over_width", "displacement"}, compute_field, false}},
        {Quantity::slope, {"(du/dx) G / p", {"x_over_width", "slope"}, compute_field, false}},
        {Quantity::c11_ratio, {"c_{11}^* / c_{11}", {"c11_ratio", "relative_error", "status"}, compute_ratio}},
        {Quantity::traction,
         {"p / (G ξ)", {"x_over_a", "traction", "carter", "carter_mean", "status"}, compute_traction}},
        {Quantity::unstable_fraction,
         {"proportion of unstable eigenvalues", {"unstable_count", "unstable_fraction", "status"}, compute_stability}},
        {Quantity::argand, {"Im c_{11}", response, compute_response}},
        {Quantity::response, {"Re c_{11}, Im c_{11}", response, compute_response}}};
    return kinds.at(quantity);
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

}  // namespace

std::vector<std::string> columns(Quantity quantity) {
    std::vector<std::string> result;
    if (kind_of(quantity).has_case) {
        result = {"curve", "method", "derivative", "mesh", "grading", "n", "alpha_L", "alpha_T", "lambda"};
    }
    const std::vector<std::string>& own = kind_of(quantity).columns;
    result.insert(result.end(), own.begin(), own.end());
    return result;
}

CurveResult compute(const Panel& panel, const Curve& curve) { return kind_of(panel.quantity).compute(panel, curve); }

study::Plot plot(const PanelResult& result) {
    const Panel& panel = result.panel;
    study::Plot plot{.title = "Fig. " + printed(panel.figure) + "  " + with_greek(panel.title),
                     .x_label = with_greek(panel.x_label),
                     .y_label = kind_of(panel.quantity).y_label,
                     .log_x = panel.axes.log_base > 0,
                     .x_range = panel.axes.x,
                     .y_range = panel.axes.y,
                     .x_is_part = true};
    if (plot.log_x) plot.log_base = panel.axes.log_base;
    for (const CurveResult& curve : result.curves) {
        plot.series.insert(plot.series.end(), curve.series.begin(), curve.series.end());
    }
    if (panel.quantity == Quantity::traction) plot.series.push_back(carter_line(result));
    if (panel.quantity == Quantity::argand || panel.quantity == Quantity::response) {
        std::vector<study::Series> polynomial =
            response_series(panel.quantity, "polynomial, order " + std::to_string(polynomial_order),
                            {.label = {}, .markers = false, .open = true, .reference = true});
        for (const double z : logarithmic(panel.grid.front(), panel.grid.back(), 301)) {
            add_response(polynomial, z, polynomial_c11(z));
        }
        plot.series.insert(plot.series.end(), polynomial.begin(), polynomial.end());
    }
    return plot;
}

}  // namespace paper
