// rollbem/elasticity/line_kernel.hpp and any_kernel.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/elasticity/line_kernel.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

template <class Kernel, class Scalar = typename Kernel::Scalar>
Scalar g(const Kernel& kernel, Scalar x) {
    const SmoothSplit<Scalar> split = kernel.smooth_split();
    return split.constant - split.strength * std::log(std::abs(x)) + kernel.smooth_part(x);
}

TEST_CASE("The strip's g is Cerruti's point solution integrated over the width", "[kernel]") {
    const auto rule = detail::gauss_legendre<double>(200);
    for (const double nu : {0.0, 0.25, 0.5}) {
        for (const double b : {0.01, 0.5, 4.0, 100.0}) {
            const Contact contact = Contact::dimensionless(b, nu);
            for (const double x : {1e-3, -0.02, 0.3, 1.0, -2.0}) {
                // Eq. (3): displacement along the force at (x, y); across it for lateral creepage. The peak at y = 0 is
                // |x| wide: y = |x| sinh t
                const auto over_width = [&](double c_along, double c_across) {
                    const double end = std::asinh(b / std::abs(x));
                    double sum = 0;
                    for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
                        const double square = std::pow(std::sinh(end * rule.nodes[k]), 2);
                        sum += rule.weights[k] * end * (c_along + c_across * square) / (1 + square);
                    }
                    return sum / std::numbers::pi;
                };
                CAPTURE(nu, b, x);
                const double along = over_width(1, 1 - nu), across = over_width(1 - nu, 1);
                const double x_over_b = std::max(1.0, std::abs(x) / b);  // the logarithm and the smooth part cancel
                CHECK(std::abs(g(StripKernel<double>::longitudinal(contact), x) / along - 1) < 1e-12 * x_over_b);
                CHECK(std::abs(g(StripKernel<double>::lateral(contact), x) / across - 1) < 1e-12 * x_over_b);
            }
        }
    }
}

TEMPLATE_TEST_CASE("Kernels are accurate to round-off and have the right parity", "[kernel]", SCALARS) {
    using Scalar = TestType;
    const Real eps = static_cast<Real>(std::numeric_limits<Scalar>::epsilon());
    for (const auto& [name, kernel] : brute_force::every_kernel()) {
        const auto check = [&, &name = name, &exact = kernel](const auto& library) {
            const SmoothSplit<Scalar> split = library.smooth_split();
            const Real strength = static_cast<Real>(split.strength);
            for (const Scalar x : {Scalar(1e-12), Scalar(1e-6), Scalar(1e-3), Scalar(0.015625), Scalar(0.1),
                                   Scalar(0.5), Scalar(1), Scalar(1.5), Scalar(2), Scalar(3.75), Scalar(4)}) {
                const Real at = static_cast<Real>(x), log = std::log(at);
                CAPTURE(name, static_cast<double>(at));
                const Real smooth = static_cast<Real>(library.smooth_part(x));
                const Real size = std::abs(static_cast<Real>(split.constant)) + strength * (1 + std::abs(log));
                CHECK(std::abs(static_cast<Real>(split.constant) - strength * log + smooth - exact.g(at)) <
                      4 * eps * size);
                const Real slope = static_cast<Real>(library.smooth_slope(x));
                CHECK(std::abs((slope - strength / at - exact.slope(at)) * at) < 4 * eps * strength);
                CHECK(library.smooth_part(-x) == library.smooth_part(x));
                CHECK(library.smooth_slope(-x) == -library.smooth_slope(x));
            }
            CHECK(library.smooth_part(0) == 0);
            CHECK(library.smooth_slope(0) == 0);
            if (exact.plane) return;
            CHECK(split.distance == static_cast<Scalar>(exact.b));
            CHECK(std::isnan(library.smooth_part(std::numeric_limits<Scalar>::quiet_NaN())));
        };
        brute_force::with_library_kernel<Scalar>(kernel, check);
    }
}

TEST_CASE("The smooth part of a wide strip keeps its digits", "[kernel]") {
    const StripKernel<double> wide(1e6, 0.72, 0.28), infinite(std::numeric_limits<double>::infinity(), 0.72, 0.28);
    CHECK(wide.smooth_part(1) == Approx(2 / std::numbers::pi * (0.72 / 4 - 0.28 / 2) * 1e-12).epsilon(1e-11));
    CHECK(wide.smooth_slope(1) == Approx(2 / std::numbers::pi * (0.72 / 2 - 0.28) * 1e-12).epsilon(1e-11));
    CHECK(infinite.smooth_part(2) == 0);
    CHECK(infinite.smooth_slope(0.5) == 0);
}

TEST_CASE("AnyKernel is the kernel of its model", "[kernel]") {
    const Mesh<double> mesh = cosine_mesh(9);
    const auto check = [&](const AnyKernel<double>& any, const auto& kernel) {
        const auto of_any = rolling_system(mesh, Collocation{}, any),
                   same = rolling_system(mesh, Collocation{}, kernel);
        CHECK(of_any.G() == same.G());
        CHECK(of_any.G_prime() == same.G_prime());
        CHECK(of_any.aspect() == same.aspect());
        CHECK(of_any.log_strength() == same.log_strength());
    };
    const auto any = [](double b, LineModel model) {
        return AnyKernel<double>::longitudinal(model, Contact::dimensionless(b, 0.3));
    };
    for (const double b : {0.1, 4.0, 1000.0}) {  // without a logarithm, and with one
        check(any(b, LineModel::strip), StripKernel<double>(b, 0.7, 0.3));
        if (b > 1) check(any(b, LineModel::plane), PlaneKernel<double>(b, 0.7, 0.3));
    }
    const Contact contact = Contact::dimensionless(5, 0.3);
    check(AnyKernel<double>::lateral(LineModel::strip, contact), StripKernel<double>::lateral(contact));
    CHECK_THROWS_WITH(rolling_system(mesh, Collocation{}, any(0.1, LineModel::plane)),
                      Catch::Matchers::ContainsSubstring("Lambda"));
    CHECK(any(1e300, LineModel::strip).model() == LineModel::strip);
    CHECK(any(std::numeric_limits<double>::infinity(), LineModel::strip).model() == LineModel::plane);
}

}  // namespace
