// The library calls behind the figures and claims of the paper, and the panels computed by them.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <regex>
#include <stdexcept>
#include <utility>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

#include "figures.hpp"
#include "studies/monomial.hpp"

namespace paper {

study::Scene scene_of(const Case& c, rollbem::LineModel model) {
    return study::make_scene(c, c.n, rollbem::Contact::dimensionless(aspect, poisson_ratio), model);
}

rollbem::ElementSystem<double> system_of(const Case& c) {
    const study::Scene scene = scene_of(c);
    return rollbem::rolling_system(*scene.mesh, scene.scheme, scene.kernel);
}

ElementField element_field(double x_over_width) {
    const double width = 2.0 / 40, ahead = width * (x_over_width + 0.5), behind = width * (x_over_width - 0.5);
    const double c1 = 1 - poisson_ratio, c2 = poisson_ratio, b = aspect, scale = 2 / std::numbers::pi;
    const auto g = [&](double x) { return scale * (c1 * std::asinh(b / std::abs(x)) + c2 * b / std::hypot(x, b)); };
    const auto integral = [&](double x) {
        return x == 0 ? 0 : scale * (c1 * x * std::asinh(b / std::abs(x)) + (c1 + c2) * b * std::asinh(x / b));
    };
    return {integral(ahead) - integral(behind), g(ahead) - g(behind)};
}

// Whether the equations are solved. The paper shows schemes that do not converge to full adhesion, too, such as all
// with alpha_T = 0: their trailing traction has the wrong sign, but their force may be close.
static bool is_solved(rollbem::Status status) {
    return status == rollbem::Status::ok || status == rollbem::Status::assists_creepage;
}

rollbem::Response<double> steady(const Case& c) {
    const study::Scene scene = scene_of(c);
    return rollbem::solve_steady(*scene.mesh, scene.scheme, scene.kernel);
}

double c11_ratio(const Case& c) {
    const rollbem::Response<double> solution = steady(c);
    return is_solved(solution.status) ? solution.c11() / rollbem::steady_c11(poisson_ratio)
                                      : std::numeric_limits<double>::quiet_NaN();
}

Tractions tractions(const Case& c) {
    const rollbem::Mesh<double> mesh = *scene_of(c).mesh;
    const rollbem::Response<double> solution = steady(c);
    Tractions result{mesh.centres(), solution.unknowns.col(0), Eigen::ArrayXd(c.n),
                     rollbem::carter_mean_tractions(mesh, poisson_ratio), solution.status};
    if (!is_solved(solution.status)) result.value.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < c.n; ++i) {
        result.carter[i] = rollbem::carter_traction(
            rollbem::EdgeDistances<double>{mesh.from_trailing()[i], mesh.from_leading()[i]}, poisson_ratio);
    }
    return result;
}

Eigen::Index unstable_count(const Case& c) {
    const rollbem::ElementSystem<double> system = system_of(c);
    const rollbem::StabilityResult::Count fast = rollbem::count_unstable(system);
    if (fast.status == rollbem::Status::ok) return fast.unstable_count;
    const rollbem::StabilityResult slow = rollbem::solve_stability(system);
    if (slow.status != rollbem::Status::ok) throw std::runtime_error("the eigenvalues of Eq. (33) were not found");
    return slow.unstable_count;
}

std::vector<HarmonicResponse> harmonic_responses(const Case& c, const std::vector<double>& z) {
    const rollbem::FrequencySweep sweep(system_of(c));
    std::vector<HarmonicResponse> result;
    for (const double frequency : z) {
        const rollbem::Response<std::complex<double>> point = sweep(frequency);
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        result.push_back({is_solved(point.status) ? point.c11() : std::complex(nothing, nothing), point.status});
    }
    return result;
}

std::string with_greek(std::string text) {
    for (const auto& [word, letter] :
         {std::pair{"alpha", "α"}, {"epsilon", "ε"}, {"lambda", "λ"}, {"omega", "ω"}, {"xi", "ξ"}}) {
        const std::regex apart("(^|[^A-Za-z])" + std::string(word) + "(?=s?([^A-Za-z]|$))");  // also in the plural
        text = std::regex_replace(text, apart, std::string("$1") + letter);
    }
    return text;
}

std::complex<double> polynomial_c11(double z, Eigen::Index order) {
    return rollbem::studies::solve_monomial<double>(std::complex<double>(0, z), poisson_ratio, aspect, order).c11;
}

namespace {

/// A row of a panel's CSV file behind the cells of its case, and the points that it adds to each series.
struct Sample {
    Case at;
    study::Row cells;
    std::vector<std::pair<double, double>> points;
};
using Samples = std::vector<Sample>;

Samples element_samples(const Panel& panel, const Curve&) {
    Samples samples;
    for (double x : panel.grid) {
        const bool displacement = panel.quantity == Quantity::displacement;
        if (!displacement && std::abs(std::abs(x) - 0.5) < 1e-9) x += x > 0 ? -1e-9 : 1e-9;
        const ElementField field = element_field(x);
        const double value = displacement ? field.displacement : field.slope;
        samples.push_back({{}, {x, value}, {{x, value}}});
    }
    return samples;
}

Samples ratio_samples(const Panel& panel, const Curve& curve) {
    Samples samples;
    for (const double x : panel.grid) {
        const Case c = at(curve.at, curve.vary, x);
        const rollbem::Response<double> solution = steady(c);
        const double ratio = solution.c11() / rollbem::steady_c11(poisson_ratio);
        samples.push_back({c, {ratio, ratio - 1, rollbem::name(solution.status)}, {{x, ratio}}});
    }
    return samples;
}

Samples stability_samples(const Panel& panel, const Curve& curve) {
    Samples samples;
    for (const double x : panel.grid) {
        const Case c = at(curve.at, curve.vary, x);
        const Eigen::Index count = unstable_count(c);
        const double share = static_cast<double>(count) / static_cast<double>(c.n);
        // stable eigenvalues do not make a scheme converge to full adhesion
        const bool converges = steady(c).status != rollbem::Status::assists_creepage;
        const auto status = converges ? rollbem::Status::ok : rollbem::Status::assists_creepage;
        samples.push_back({c, {count, share, rollbem::name(status)}, {{x, share}}});
    }
    return samples;
}

Samples traction_samples(const Panel&, const Curve& curve) {
    const Tractions t = tractions(curve.at);
    Samples samples;
    for (Eigen::Index i = 0; i < t.x.size(); ++i) {
        samples.push_back({curve.at,
                           {t.x[i], t.value[i], t.carter[i], t.carter_mean[i], rollbem::name(t.status)},
                           {{t.x[i], t.value[i]}}});
    }
    return samples;
}

/// The point of c11(z) in the complex plane, or the points of its real and imaginary part over frequency.
Points places(Quantity quantity, double z, const std::complex<double>& c11) {
    if (quantity == Quantity::argand) return {{c11.real(), c11.imag()}};
    return {{z, c11.real()}, {z, c11.imag()}};
}

Samples response_samples(const Panel& panel, const Curve& curve) {
    const std::vector<HarmonicResponse> responses = harmonic_responses(curve.at, panel.grid);
    Samples samples;
    for (std::size_t i = 0; i < responses.size(); ++i) {
        const double z = panel.grid[i];
        const std::complex<double> c11 = responses[i].c11, polynomial = polynomial_c11(z);
        const std::complex<double> exact = rollbem::reference::plane_c11({0, z}, poisson_ratio, aspect);
        samples.push_back({curve.at,
                           {z, c11.real(), c11.imag(), polynomial.real(), polynomial.imag(), exact.real(), exact.imag(),
                            std::abs(c11 - exact) / std::abs(exact), rollbem::name(responses[i].status)},
                           places(panel.quantity, z, c11)});
    }
    return samples;
}

/// The quantity of a panel: the label of its axis, its columns behind the columns of the case, and the function that
/// computes a curve.
struct Kind {
    std::string y_label, columns;
    Samples (*compute)(const Panel&, const Curve&);
    bool has_case = true;
};

const Kind& kind_of(Quantity quantity) {
    static const std::string response =
        "omega,c11_re,c11_im,polynomial_re,polynomial_im,exact_re,exact_im,relative_error,status";
    static const std::map<Quantity, Kind> kinds{
        {Quantity::displacement, {"u G / (p a)", "x_over_width,displacement", element_samples, false}},
        {Quantity::slope, {"(du/dx) G / p", "x_over_width,slope", element_samples, false}},
        {Quantity::c11_ratio, {"c_{11}^* / c_{11}", "c11_ratio,relative_error,status", ratio_samples}},
        {Quantity::traction, {"p / (G ξ)", "x_over_a,traction,carter,carter_mean,status", traction_samples}},
        {Quantity::unstable_fraction,
         {"proportion of unstable eigenvalues", "unstable_count,unstable_fraction,status", stability_samples}},
        {Quantity::argand, {"Im c_{11}", response, response_samples}},
        {Quantity::response, {"Re c_{11}, Im c_{11}", response, response_samples}}};
    return kinds.at(quantity);
}

bool over_frequency(Quantity quantity) { return quantity == Quantity::argand || quantity == Quantity::response; }

/// A curve without points, or two for real and imaginary part over frequency.
std::vector<study::Series> empty_series(Quantity quantity, study::Series form) {
    if (quantity != Quantity::response) return {form};
    std::vector<study::Series> both{form, form};
    both[0].label = "Re, " + form.label;
    both[1].label = "Im, " + form.label;
    return both;
}

void add(std::vector<study::Series>& series, const Points& points) {
    for (std::size_t k = 0; k < series.size(); ++k) series[k].points.push_back(points[k]);
}

/// Carter's traction as far as it does not exceed the computed ones.
study::Series carter_line(const Panel& panel) {
    double largest = 0;
    for (const Curve& curve : panel.curves) {
        for (const auto& point : curve.series[0].points) largest = std::max(largest, std::abs(point.second));
    }
    study::Series line{"Carter", study::Look::exact};
    constexpr int count = 2000;
    for (int k = 1; k < count; ++k) {  // dense at both edges
        const double angle = std::numbers::pi * k / count;
        const double traction = rollbem::carter_traction(-std::cos(angle), poisson_ratio);
        if (std::abs(traction) <= 1.1 * largest) line.points.emplace_back(-std::cos(angle), traction);
    }
    return line;
}

}  // namespace

std::string csv_of(const Panel& panel) {
    const Kind& kind = kind_of(panel.quantity);
    std::string text =
        (kind.has_case ? "curve,method,derivative,mesh,grading,n,alpha_L,alpha_T,lambda," : "") + kind.columns + "\n";
    for (const Curve& curve : panel.curves) {
        for (const study::Row& row : curve.rows) text += study::csv_line(row);
    }
    return text;
}

void compute(const Panel& panel, Curve& curve) {
    const Kind& kind = kind_of(panel.quantity);
    // over frequency the points of all n nearly coincide
    const study::Look look = over_frequency(panel.quantity) ? study::Look::markers : study::Look::curve;
    curve.series = empty_series(panel.quantity, {with_greek(curve.label), look});
    for (const Sample& sample : kind.compute(panel, curve)) {
        const Case& c = sample.at;
        const std::string method = c.method + (c.quadrature.empty() ? "" : "-" + c.quadrature);
        const study::Row scheme{curve.label, method,    c.derivative, c.mesh_name, c.grading,
                                c.n,         c.alpha_L, c.alpha_T,    c.lambda};
        curve.rows.push_back(kind.has_case ? study::joined(scheme, sample.cells) : sample.cells);
        add(curve.series, sample.points);
    }
}

study::Picture picture(const Panel& panel) {
    study::Plot plot{.title = "Fig. " + printed(panel.figure) + "  " + with_greek(panel.title),
                     .x = {.label = with_greek(panel.x_label), .logarithmic = panel.logarithmic, .range = panel.x},
                     .y = {.label = kind_of(panel.quantity).y_label, .range = panel.y}};
    for (const Curve& curve : panel.curves) {
        plot.series.insert(plot.series.end(), curve.series.begin(), curve.series.end());
    }
    if (panel.quantity == Quantity::traction) plot.series.push_back(carter_line(panel));
    if (over_frequency(panel.quantity)) {
        std::vector<study::Series> polynomial =
            empty_series(panel.quantity, {"polynomial, order " + std::to_string(polynomial_order), study::Look::exact});
        for (const double z : logarithmic(panel.grid.front(), panel.grid.back(), 301)) {
            add(polynomial, places(panel.quantity, z, polynomial_c11(z)));
        }
        plot.series.insert(plot.series.end(), polynomial.begin(), polynomial.end());
    }
    return {plot};
}

}  // namespace paper
