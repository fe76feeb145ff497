// The exact border of stick at the edges of its domain.
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/stick_border.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/pressure_table.hpp>
#include <rollbem/reference/strip.hpp>

#include "cases.hpp"
#include "friction_scale.hpp"
#include "support/strip_instances.hpp"

namespace extremes {

namespace {

using rollbem::Contact;
using rollbem::HertzPressure;
using rollbem::PlaneKernel;
using rollbem::PressureTable;
using rollbem::StripKernel;
using Border = rollbem::StickBorderSolution<double>;

template <class Pressure>
Border on_plane(const Pressure& pressure, double ratio) {
    const Contact<double> wide = contact(1e4);
    return rollbem::solve_stick_border(wide, PlaneKernel<double>::longitudinal(wide), 1.0, pressure, creepage(ratio));
}

Border on_strip(double aspect, double ratio) {
    const Contact<double> narrow = contact(aspect);
    return rollbem::solve_stick_border(narrow, StripKernel<double>::longitudinal(narrow), 1.0,
                                       HertzPressure<double>{peak}, creepage(ratio));
}

/// The same, but told where elements took the border's place.
Outcome against(const Border& solution, double value, double reference, double bound) {
    Outcome outcome = compare(solution, value, reference, bound);
    if (!solution.exact) outcome.told = "elements took over";
    return outcome;
}

void add_carter(Cases& cases) {
    const HertzPressure<double> hertz{peak};
    for (const double ratio : {1e-12, 1e-6, 0.5, -0.5, 0.99, 0.999999, 1.0, 1e6}) {
        const std::string name = "stick border, delta = " + shown(ratio);
        cases.right(name, "force against Carter", [=] {
            const Border solution = on_plane(hertz, ratio);
            return against(solution, -solution.force_per_width / full_force, rollbem::carter_force_ratio(ratio),
                           32 * rounding);
        });
        // rounding of x/a = -1 + 2 delta
        cases.right(name, "slip zone against Carter", [=] {
            const Border solution = on_plane(hertz, ratio);
            const double reference = 1 + rollbem::carter_stick_border(ratio);
            return against(solution, 1 + solution.border, reference, 16 * rounding * (1 + 2 / reference));
        });
        if (std::abs(ratio) >= 1) continue;
        cases.right(name, "tangent against Carter", [=] {
            const Border solution = on_plane(hertz, ratio);
            const double stick = 1 - std::abs(ratio);
            return against(solution, -solution.tangent_per_width / rollbem::steady_c11(steel), stick,
                           64 * rounding / stick);
        });
    }
}

void add_strips(Cases& cases) {
    const auto named = [](double aspect, double ratio) {
        return "stick border, strip, b/a = " + shown(aspect) + ", delta = " + shown(ratio);
    };
    for (const double aspect : {0.02, 0.05, 0.3, 1.0, 10.0, 1e3}) {
        // Hardly any slip: full adhesion but for a part of order delta, delta/2 on the plane and up to eight times as
        // much on narrow strips. The solution's own estimate, in units of mu N, is added.
        for (const double ratio : {1e-9, 1e-6}) {
            cases.right(named(aspect, ratio), "force against the spectral solution in adhesion", [=] {
                const Border solution = on_strip(aspect, ratio);
                const auto reference = rollbem::reference::strip_c11(0, steel, aspect);
                const double force = -solution.force_per_width;
                const double estimate = solution.force_error + 64 * rounding * full_force;
                return against_estimate(
                    against(solution, force / creepage(ratio), reference.c11.real(), 4 * ratio + estimate / force),
                    reference);
            });
        }
    }
    // In between: elements, whose error is of second order.
    const auto against_elements = [](double aspect, double ratio) {
        const Border solution = on_strip(aspect, ratio);
        const Contact<double> own = contact(aspect);
        const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(320);
        const rollbem::FrictionModel<> model(own, steady_system(mesh, equal, StripKernel<double>::longitudinal(own)),
                                             {1, HertzPressure<double>{peak}(mesh)});
        const auto elements = steady_from_rest(model, creepage(ratio));
        Outcome outcome = against(solution, solution.force_per_width, elements.force / own.width(), 1e-4);
        if (elements.status != rollbem::StepStatus::ok) outcome.told = "the reference has not converged";
        return outcome;
    };
    for (const auto& [aspect, ratio] : {std::pair{0.02, 0.03},
                                        {0.05, 0.05},
                                        {0.05, 0.15},
                                        {0.3, 0.2},
                                        {0.3, 0.45},
                                        {1.0, 0.3},
                                        {1.0, 0.8},
                                        {10.0, 0.3},
                                        {10.0, 0.99},
                                        {1e3, 0.3}}) {
        cases.right(named(aspect, ratio), "force against elements, n = 320",
                    [=, aspect = aspect, ratio = ratio] { return against_elements(aspect, ratio); });
    }
    for (const double ratio : {1e-9, 0.02}) {
        cases.told(named(0.01, ratio), "force", "elements took over", [=] { return against_elements(0.01, ratio); });
    }
    // So wide a strip is the plane.
    for (const double ratio : {1e-6, 0.5, 0.99, 0.999999}) {
        cases.right(named(1e8, ratio), "force against Carter", [=] {
            const Border solution = on_strip(1e8, ratio);
            return against(solution, -solution.force_per_width / full_force, rollbem::carter_force_ratio(ratio), 1e-12);
        });
    }
    cases.right(named(0.05, 1e6), "force against full sliding", [] {
        const Border solution = on_strip(0.05, 1e6);
        return against(solution, -solution.force_per_width, full_force, 16 * rounding);
    });
}

PressureTable<double> table(const std::vector<std::pair<double, double>>& points) {
    rollbem::ArrayX<double> x(static_cast<Eigen::Index>(points.size())), p(x.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        x[static_cast<Eigen::Index>(i)] = points[i].first;
        p[static_cast<Eigen::Index>(i)] = peak * points[i].second;
    }
    return {x, p};
}

/// -F on the plane under a pressure that rises linearly from x = -1 to a kink and stays there, by quadrature: with the
/// border c the creepage is (2 c1/pi) times the integral of p_n/sqrt((c-s)(1-s)) over the slip zone, and the force the
/// same integral with the weight (1+c)/2 - s. s = c - (1-c) sinh^2 t removes both roots; c follows by bisection.
double ramp_force(double kink, double xi) {
    const auto pressure = [=](double s) { return peak * std::min(1.0, (1 + s) / (1 + kink)); };
    const auto integrals = [&](double c) {
        std::array<double, 2> sums{};
        const auto limit = [&](double s) { return s < c ? std::asinh(std::sqrt((c - s) / (1 - c))) : 0.0; };
        const std::array<double, 3> ends{0, limit(kink), limit(-1)};
        for (std::size_t piece = 0; piece < 2; ++piece) {
            constexpr int count = 400;  // of Simpson's rule
            const double step = (ends[piece + 1] - ends[piece]) / count;
            for (int i = 0; i <= count; ++i) {
                const double root = std::sinh(ends[piece] + i * step), s = c - (1 - c) * root * root;
                const double weight = step / 3 * (i == 0 || i == count ? 1 : i % 2 == 1 ? 4 : 2);
                sums[0] += 2 * weight * pressure(s);
                sums[1] += 2 * weight * pressure(s) * ((1 + c) / 2 - s);
            }
        }
        return sums;
    };
    double low = -1, high = 1 - 1e-9;
    for (int i = 0; i < 60; ++i) {
        const double c = (low + high) / 2;
        (2 * (1 - steel) / pi * integrals(c)[0] < xi ? low : high) = c;
    }
    return integrals(low)[1];
}

void add_pressures(Cases& cases) {
    // A uniform pressure, which never slides fully: -F = mu N tanh.
    for (const double ratio : {1e-3, 0.3, 2.0}) {
        cases.right("stick border, uniform pressure, delta = " + shown(ratio), "force against tanh(pi delta/2)", [=] {
            const Border solution = on_plane(table({{-1, 1}, {1, 1}}), ratio);
            return against(solution, -solution.force_per_width / (2 * peak), std::tanh(pi / 2 * ratio), 1e-6);
        });
    }
    // A kink in the slip zone, and in stick, where it has no effect.
    for (const double ratio : {0.1, 0.5, 1.0}) {
        cases.right("stick border, kinked pressure, delta = " + shown(ratio), "force against quadrature", [=] {
            const Border solution = on_plane(table({{-1, 0}, {-0.4, 1}, {1, 1}}), ratio);
            return against(solution, -solution.force_per_width, ramp_force(-0.4, creepage(ratio)), 2e-6);
        });
    }
    // What has no single border, or a jump.
    const auto refused = [&](const std::string& what, const PressureTable<double>& pressure, double ratio) {
        cases.told("stick border, " + what, "force", "elements took over", [=] {
            const Border solution = on_plane(pressure, ratio);
            return against(solution, solution.force_per_width, 1, 0);
        });
    };
    refused("a jump in slip", table({{-1, 1}, {-0.6, 1}, {-0.6, 0.5}, {1, 0.5}}), 0.4);
    refused("a jump in stick", table({{-1, 1}, {0.5, 1}, {0.5, 2}, {1, 2}}), 0.1);
    refused("no pressure in the middle", table({{-1, 2}, {-0.2, 2}, {-0.2, 0}, {0.2, 0}, {0.2, 2}, {1, 2}}), 0.3);
    refused("a line to zero at the leading edge", table({{-1, 0}, {0.3, 1}, {1, 0}}), 0.5);
    refused("two humps", table({{-1, 0}, {-0.5, 1}, {0, 0}, {0.5, 1}, {1, 0}}), 0.3);
    cases.told("stick border, delta = nan", "force", "not_finite", [] {
        const Border solution = on_plane(HertzPressure<double>{peak}, nothing);
        Outcome outcome = against(solution, solution.force_per_width, 1, 0);
        outcome.told = told_by(solution.status);
        return outcome;
    });
}

}  // namespace

void friction_cases(Cases& cases) {
    add_carter(cases);
    add_strips(cases);
    add_pressures(cases);
}

}  // namespace extremes
