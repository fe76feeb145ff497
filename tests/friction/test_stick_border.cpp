// apps/studies/stick_border.hpp
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/detail/gauss_legendre.hpp>

#include "scene.hpp"
#include "studies/stick_border.hpp"
#include "support/catch.hpp"
#include "support/strip_instances.hpp"

namespace friction_tests {
namespace {

using namespace studies;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double pi = std::numbers::pi;

/// The pressure peak sqrt(1 - x^2) shape(x), with means over elements by an eight-point rule.
struct Shaped {
    std::function<double(double)> shape;

    double operator()(double x) const { return peak * std::sqrt((1 - x) * (1 + x)) * shape(x); }
    ArrayX<double> operator()(const Mesh<double>& mesh) const {
        const auto rule = detail::gauss_legendre<double>(8);
        ArrayX<double> mean = ArrayX<double>::Zero(mesh.size());
        for (Eigen::Index i = 0; i < mesh.size(); ++i) {
            for (Eigen::Index k = 0; k < 8; ++k) {
                mean[i] += rule.weights[k] / 2 * (*this)(mesh.centres()[i] + mesh.widths()[i] / 2 * rule.nodes[k]);
            }
        }
        return mean;
    }
};

/// Any pressure as one type, so that the solver is compiled once for each kernel.
struct AnyPressure {
    template <class Pressure>
    explicit AnyPressure(const Pressure& pressure)
        : at([pressure](double x) { return pressure(x); }),
          mean([pressure](const Mesh<double>& mesh) -> ArrayX<double> { return pressure(mesh); }) {}

    double operator()(double x) const { return at(x); }
    ArrayX<double> operator()(const Mesh<double>& mesh) const { return mean(mesh); }

    std::function<double(double)> at;
    std::function<ArrayX<double>(const Mesh<double>&)> mean;
};

static_assert(PressureLaw<PressureTable, double>);

const HertzLine::Pressure hertz{peak};
const AnyPressure any_hertz(hertz);

struct Plane {
    Contact contact = Contact::dimensionless(1e4, nu);
    PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(contact);

    template <class Pressure>
    StickBorderSolution<double> solve(const Pressure& pressure, double ratio, Eigen::Index n = 40) const {
        return solve_stick_border(contact, kernel, 1.0, AnyPressure(pressure), creepage(ratio), n);
    }
};

FrictionStep plain_step(const Contact& contact, const auto& kernel, const Mesh<double>& mesh, const auto& pressure,
                        double xi) {
    return from_scratch(FrictionModel(contact, steady_system(mesh, half, kernel), {1, pressure(mesh)}), xi);
}
double plain_force(const Contact& contact, const auto& kernel, const Mesh<double>& mesh, const auto& pressure,
                   double xi) {
    return plain_step(contact, kernel, mesh, pressure, xi).force.longitudinal / contact.width();
}

TEST_CASE("The exact border gives Carter's solution", "[friction]") {
    const Plane plane;
    for (int percent = 1; percent <= 99; ++percent) {
        for (const double ratio : {percent / 100.0, -percent / 100.0}) {
            const auto solution = plane.solve(hertz, ratio);
            CAPTURE(ratio, solution.force_per_width, solution.complementarity_residual, solution.evaluations);
            REQUIRE(solution.exact);
            CHECK(solution.status == Status::ok);
            CHECK_FALSE(solution.elements);
            CHECK(std::abs(-solution.force_per_width / full_force - carter_force_ratio(ratio)) < 1e-13);
            CHECK(solution.force_error < 1e-13 * full_force);
            CHECK(std::abs(solution.border - carter_stick_border(ratio)) < 1e-13);
            CHECK(solution.tangent_per_width * creepage(1) / -full_force ==
                  Approx(2 * (1 - std::abs(ratio))).epsilon(1e-12));
            CHECK(solution.slip_work_per_width == -solution.force_per_width * creepage(ratio));
            CHECK(solution.slip_work_per_width > 0);
            CHECK(solution.complementarity_residual < 1e-12);
            CHECK(solution.coefficients == 32);
            CHECK(solution.unknowns == 0);
            CHECK(solution.evaluations <= 6);
            double worst_traction = 0, worst_slip = 0;
            for (int i = 0; i <= 40; ++i) {
                const double x = -std::cos(pi * i / 40), t = (x - std::abs(ratio)) / (1 - std::abs(ratio));
                worst_traction = std::max(worst_traction,
                                          std::abs(solution.traction(x) / peak - carter_friction_traction(x, ratio)));
                const double slip =
                    x < solution.border ? creepage(1) * (1 - std::abs(ratio)) * std::sqrt(std::max(t * t - 1, 0.0)) : 0;
                worst_slip = std::max(worst_slip, std::abs(solution.slip(x) - std::copysign(slip, ratio)) / peak);
            }
            CHECK(worst_traction < 1e-7);  // worst at the border, where the slope is infinite
            CHECK(worst_slip < 1e-7);
        }
    }
}

TEST_CASE("The exact border covers both ends of the creep curve", "[friction]") {
    const Plane plane;
    // full sliding, xi >= 2 c1 sum g_k
    for (const double ratio : {1.0 + 1e-12, 1.1, -1.1, 1e6}) {
        const auto sliding = plane.solve(hertz, ratio);
        CAPTURE(ratio);
        CHECK(sliding.exact);
        CHECK(-sliding.force_per_width == Approx(std::copysign(full_force, ratio)).epsilon(1e-13));
        CHECK(sliding.border == 1);
        CHECK(sliding.tangent_per_width == 0);
        CHECK(sliding.traction(0.3) == Approx(-std::copysign(peak * std::sqrt(0.91), ratio)).epsilon(1e-14));
        // Hertz's tractions cause a displacement with linear slope
        CHECK(sliding.slip(0.3) ==
              Approx(std::copysign(creepage(std::abs(ratio)) - creepage(0.3), ratio)).epsilon(1e-11));
    }
    const auto nearly = plane.solve(hertz, 1 - 1e-9);
    CHECK(nearly.exact);
    CHECK(nearly.border < 1);
    CHECK(1 - nearly.border == Approx(2e-9).epsilon(1e-5));
    const Shaped leaning{[](double x) { return 1 + 0.3 * x - 0.1 * (4 * x * x - 1); }};
    const double from = 1.05;  // sum of g = (1, 0.15, -0.1)
    CHECK(plane.solve(leaning, from * (1 - 1e-6)).border < 1);
    CHECK(plane.solve(leaning, from * (1 + 1e-6)).border == 1);
    // tiny creepage: full adhesion
    for (const double ratio : {1e-3, 1e-6, -1e-9, 1e-14, 1e-30}) {
        const auto linear = plane.solve(hertz, ratio);
        CAPTURE(ratio, linear.border);
        CHECK(linear.exact);
        CHECK(linear.force_per_width / (-steady_c11(nu) * creepage(ratio)) - 1 ==
              Approx(-std::abs(ratio) / 2).margin(1e-9 * std::abs(ratio) + 1e-12));
    }
    const auto still = plane.solve(hertz, 0);
    CHECK(still.exact);
    CHECK(still.status == Status::ok);
    CHECK(still.force_per_width == 0);
    CHECK(still.border == -1);
    CHECK(still.traction(0.2) == 0);
    CHECK(still.slip(-1) == 0);
    CHECK(still.tangent_per_width == Approx(-steady_c11(nu)).epsilon(1e-13));
    for (const double bad : {nan, std::numeric_limits<double>::infinity()}) {
        const auto unknown = plane.solve(hertz, bad);
        CHECK(unknown.status == Status::not_finite);
        CHECK(std::isnan(unknown.force_per_width));
        CHECK(std::isnan(unknown.traction(0)));
    }
    // without friction nothing sticks
    const auto slippery = solve_stick_border(plane.contact, plane.kernel, 0.0, hertz, creepage(0.5));
    CHECK(slippery.exact);
    CHECK(slippery.force_per_width == 0);
    CHECK(slippery.border == 1);
    CHECK(std::isnan(plane.solve(hertz, 0.5).traction(1.1)));
    CHECK_THROWS_AS(plane.solve(hertz, 0.5, 0), std::invalid_argument);
    CHECK_THROWS_AS(plane.solve(HertzLine::Pressure{-1}, 0.5), std::invalid_argument);
    CHECK_THROWS_AS(plane.solve(HertzLine::Pressure{0}, 0.5), std::invalid_argument);
    CHECK_THROWS_AS(plane.solve(HertzLine::Pressure{nan}, 0.5), std::invalid_argument);
    CHECK_THROWS_AS(solve_stick_border(plane.contact, plane.kernel, -0.1, hertz, 0.1), std::invalid_argument);
}

/// Two cosine meshes that meet at the border.
Mesh<double> mesh_about(double border, Eigen::Index n) {
    ArrayX<double> edges(2 * n + 1);
    for (Eigen::Index j = 0; j <= n; ++j) {
        const double part = (1 - std::cos(pi * static_cast<double>(j) / static_cast<double>(n))) / 2;
        edges[j] = -1 + (border + 1) * part;
        edges[n + j] = border + (1 - border) * part;
    }
    edges[2 * n] = 1;
    return mesh_from_edges(edges);
}

TEST_CASE("The exact border on a strip agrees with fitted meshes", "[friction]") {
    for (const double aspect : {0.3, 1.0, 10.0}) {
        const Contact contact = Contact::dimensionless(aspect, nu);
        const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
        const auto solve = [&](double ratio) {
            return solve_stick_border(contact, kernel, 1.0, any_hertz, creepage(ratio));
        };
        for (const double ratio : {0.1, 0.3, -0.45}) {
            const auto solution = solve(ratio);
            CAPTURE(aspect, ratio, solution.border, solution.unknowns, solution.coefficients);
            REQUIRE(solution.exact);
            CHECK(solution.border < 1);
            CHECK(solution.force_error < 1e-11 * full_force);
            CHECK(solution.complementarity_residual < 1e-9);
            std::vector<double> forces, residuals;
            for (const Eigen::Index n : {40, 80, 160}) {
                const Mesh<double> mesh = mesh_about(solution.border, n);
                forces.push_back(plain_force(contact, kernel, mesh, hertz, creepage(ratio)));
                // G' times the tractions at the centres, compared with the slip at the leading edges
                const MatrixX<double> G_prime = assemble_G_prime(mesh, half, kernel);
                VectorX<double> traction(2 * n);
                for (Eigen::Index i = 0; i < 2 * n; ++i) traction[i] = solution.traction(mesh.centres()[i]);
                const VectorX<double> slope = G_prime * traction;
                double residual = 0;
                for (Eigen::Index i = n / 4; i < 2 * n - n / 4; ++i) {
                    if (std::abs(i - n) < n / 4) continue;
                    const double edge = mesh.edges_from_trailing()[i + 1] - 1;
                    residual =
                        std::max(residual, std::abs(creepage(ratio) - slope[i] - solution.slip(edge)) / creepage(1));
                }
                residuals.push_back(residual);
            }
            CAPTURE(forces, residuals, solution.force_per_width);
            const double extrapolated = forces[2] + (forces[2] - forces[1]) / 3;
            CHECK(std::abs(extrapolated / solution.force_per_width - 1) < 5e-5);
            CHECK(residuals[2] < 1e-3);
            CHECK(residuals[2] < residuals[0] / 3);
            const double step = 1e-4;
            const double difference =
                (solve(ratio + step).force_per_width - solve(ratio - step).force_per_width) / (2 * creepage(step));
            CHECK(solution.tangent_per_width == Approx(difference).epsilon(1e-6));
            CHECK(solve(-ratio).force_per_width == -solution.force_per_width);
            CHECK(solution.slip_work_per_width == -solution.force_per_width * creepage(ratio));
        }
        // no creepage: the steady creep coefficient, by another spectral method
        const double c11 = reference::strip_c11(0, nu, aspect).c11.real();
        CHECK(solve(0).tangent_per_width == Approx(-c11).epsilon(1e-10));
        CHECK(solve(1e-7).force_per_width == Approx(-c11 * creepage(1e-7)).epsilon(1e-6));
        // full sliding begins where stick ends
        const auto sliding = solve(1.2);
        CHECK(sliding.exact);
        CHECK(sliding.border == 1);
        CHECK(-sliding.force_per_width == Approx(full_force).epsilon(1e-13));
    }
    const Contact wide = Contact::dimensionless(1e6, nu);
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(wide);
    for (const double ratio : {0.01, 0.5, 0.99}) {
        const auto solution = solve_stick_border(wide, kernel, 1.0, any_hertz, creepage(ratio));
        CHECK(solution.exact);
        CHECK(std::abs(-solution.force_per_width / full_force - carter_force_ratio(ratio)) < 2e-12);
    }
}

/// A table of the pressure at -cos of equidistant angles, zero at both ends.
PressureTable table_of(const Shaped& pressure, int count) {
    ArrayX<double> x(count + 1), value(count + 1);
    for (int i = 0; i <= count; ++i) {
        x[i] = i == count ? 1 : -std::cos(pi * i / count);
        value[i] = i % count == 0 ? 0 : pressure(x[i]);
    }
    return {x, value};
}

TEST_CASE("The exact border under a tabulated pressure satisfies Carter's integrals", "[friction]") {
    const Plane plane;
    const Shaped shape{[](double x) { return 1 + 0.3 * x; }};
    const PressureTable table = table_of(shape, 200);
    const auto rule = detail::gauss_legendre<double>(12);
    for (const double ratio : {0.1, 0.3, 0.6}) {
        const auto solution = plane.solve(table, ratio);
        CAPTURE(ratio, solution.force_error / full_force, solution.coefficients, solution.complementarity_residual);
        REQUIRE(solution.exact);
        CHECK(solution.coefficients > 32);
        CHECK(solution.coefficients <= 4096);
        CHECK(solution.force_error < 1e-6 * full_force);
        // creepage = (2 c1/pi) int p_n / sqrt((c-s)(1-s)) ds over the slip zone, and a similar integral for the force,
        // segment by segment with s = c - v^2
        const double c = solution.border;
        double xi = 0, force = 0;
        for (int i = 0; i < 200; ++i) {
            const double from = -std::cos(pi * i / 200), to = std::min(-std::cos(pi * (i + 1) / 200), c);
            if (from >= c) break;
            const double low = std::sqrt(c - to), high = std::sqrt(c - from);
            for (Eigen::Index k = 0; k < 12; ++k) {
                const double v = low + (high - low) * (1 + rule.nodes[k]) / 2, s = c - v * v;
                const double term = rule.weights[k] * (high - low) * table(s) / std::sqrt(1 - s);
                xi += 2 * (1 - nu) / pi * term;
                force += term * ((1 + c) / 2 - s);
            }
        }
        CHECK(std::abs(xi / creepage(ratio) - 1) < 1e-6);
        CHECK(std::abs(-solution.force_per_width - force) < 1e-6 * full_force);
        CHECK(-solution.traction(-0.9) == Approx(table(-0.9)));
        if (ratio != 0.3) continue;
        const double elements =
            plain_force(plane.contact, plane.kernel, cosine_mesh<double>(640), table, creepage(ratio));
        CHECK(std::abs(elements / solution.force_per_width - 1) < 2e-4);
    }
    // on a strip, where the unknowns are not adapted to the kinks
    const Contact contact = Contact::dimensionless(1, nu);
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    const auto strip = solve_stick_border(contact, kernel, 1.0, AnyPressure(table), creepage(0.3));
    CHECK(strip.exact);
    CHECK(strip.unknowns <= 120);
    CHECK(strip.force_error < 1e-6 * full_force);
    const auto smooth = solve_stick_border(contact, kernel, 1.0, AnyPressure(shape), creepage(0.3));
    CHECK(strip.force_per_width == Approx(smooth.force_per_width).epsilon(1e-4));
}

TEST_CASE("The exact border under a uniform pressure has its closed form", "[friction]") {
    // (1+c)/2 = tanh^2(pi xi/(4 c1 mu p_n)), -F = mu N tanh(...), and there is never full sliding
    const Plane plane;
    const PressureTable uniform(Eigen::Array2d(-1, 1), Eigen::Array2d(peak, peak));
    for (const double ratio : {0.05, 0.3, -0.7, 1.0, 2.0}) {
        const auto solution = plane.solve(uniform, ratio);
        const double force = std::tanh(pi / 2 * ratio);
        CAPTURE(ratio, solution.force_error, solution.coefficients);
        CHECK(solution.exact);
        CHECK(std::abs(-solution.force_per_width / (2 * peak) - force) < 1e-7);
        CHECK(std::abs((1 + solution.border) / 2 - force * force) < 1e-6);
        CHECK(solution.tangent_per_width * creepage(1) / (-2 * peak) ==
              Approx(pi / 2 * (1 - force * force)).epsilon(1e-4));
    }
}

TEST_CASE("A contact without a single border is solved by elements", "[friction]") {
    const Plane plane;
    const auto by_elements = [&](const auto& pressure, double ratio) {
        const auto solution = plane.solve(pressure, ratio);
        CAPTURE(ratio, solution.complementarity_residual);
        CHECK_FALSE(solution.exact);
        CHECK(solution.status == Status::ok);
        CHECK(std::isnan(solution.border));
        CHECK(std::isnan(solution.force_error));
        CHECK(solution.coefficients == 0);
        CHECK(solution.complementarity_residual < 1e-10);
        const Mesh<double> mesh = cosine_mesh<double>(40);
        CHECK(solution.force_per_width ==
              Approx(plain_force(plane.contact, plane.kernel, mesh, pressure, creepage(ratio))).epsilon(1e-12));
        REQUIRE(solution.elements);
        CHECK(solution.elements->mesh.size() == 40);
        const double work = plain_step(plane.contact, plane.kernel, mesh, pressure, creepage(ratio)).slip_work;
        CHECK(solution.slip_work_per_width == Approx(work / plane.contact.width()).epsilon(1e-12));
        for (Eigen::Index i = 0; i < 40; ++i) {
            CHECK(solution.traction(mesh.centres()[i]) == solution.elements->traction[i]);
            CHECK(solution.slip(mesh.centres()[i]) == solution.elements->slip[i]);
        }
        CHECK(solution.traction(-1) == solution.elements->traction[0]);
        CHECK(solution.traction(1) == solution.elements->traction[39]);
    };
    const auto table = [](std::vector<double> x, std::vector<double> p) {
        return PressureTable(Eigen::Map<ArrayX<double>>(x.data(), Eigen::Index(x.size())),
                             peak * Eigen::Map<ArrayX<double>>(p.data(), Eigen::Index(p.size())));
    };
    // two humps with a slip zone each
    by_elements(Shaped{[](double x) { return 0.02 + x * x; }}, 0.1);
    // |p| would exceed a bound that falls linearly to zero at the leading edge: stick ends before it
    by_elements(table({-1, 0.3, 1}, {0, 1, 0}), 0.5);
    by_elements(table({-1, 0.1, 0.8, 1}, {0, 1, 0, 0}), 0.3);
    // so much pressure at the trailing edge that slip would assist the traction
    by_elements(Shaped{[](double x) { return 1 - x; }}, 0.5);
    // a jump, in slip and in stick
    by_elements(table({-1, -0.6, -0.6, 1}, {1, 1, 0.5, 0.5}), 0.4);
    by_elements(table({-1, 0.5, 0.5, 1}, {1, 1, 2, 2}), 0.1);
    by_elements(table({-1, -0.2, -0.2, 0.2, 0.2, 1}, {2, 2, 0, 0, 2, 2}), 0.3);
}

}  // namespace
}  // namespace friction_tests
