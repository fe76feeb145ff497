// rollbem/elasticity/line_kernel.hpp and any_kernel.hpp
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/elasticity/line_kernel.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

template <class Function>
double integrate(Function f, double lower, double upper, double relative = 1e-13) {
    gsl_set_error_handler_off();
    const std::unique_ptr<gsl_integration_workspace, decltype(&gsl_integration_workspace_free)> workspace(
        gsl_integration_workspace_alloc(1000), &gsl_integration_workspace_free);
    gsl_function integrand;
    integrand.function = [](double x, void* data) { return (*static_cast<Function*>(data))(x); };
    integrand.params = &f;
    double result = 0, error = 0;
    gsl_integration_qags(&integrand, lower, upper, 0, relative, 1000, workspace.get(), &result, &error);
    return result;
}

template <class Scalar>
ArrayX<Scalar> one(Scalar x) {
    return ArrayX<Scalar>::Constant(1, x);
}

TEST_CASE("The strip's g is Cerruti's point solution integrated over the width", "[kernel]") {
    for (const double nu : {0.0, 0.25, 0.5}) {
        for (const double b : {0.01, 0.5, 4.0, 100.0}) {
            const Contact<double> contact = Contact<double>::dimensionless(b, nu);
            for (const double x : {1e-3, -0.02, 0.3, 1.0, -2.0}) {
                // Eq. (3): displacement along the force at (x, y); across it for lateral creepage
                const auto point = [x](double c_along, double c_across) {
                    return [=](double y) {
                        const double r2 = x * x + y * y;
                        return (c_along * x * x + c_across * y * y) / (std::numbers::pi * r2 * std::sqrt(r2));
                    };
                };
                // the peak at y = 0 is |x| wide: substitute y = |x| sinh t
                const auto over_width = [&](const auto& f) {
                    const auto substituted = [&](double t) {
                        return f(std::abs(x) * std::sinh(t)) * std::abs(x) * std::cosh(t);
                    };
                    return 2 * integrate(substituted, 0, std::asinh(b / std::abs(x)));
                };
                CAPTURE(nu, b, x);
                const double along = over_width(point(1, 1 - nu)), across = over_width(point(1 - nu, 1));
                CHECK(std::abs(StripKernel<double>::longitudinal(contact).g(one(x))[0] / along - 1) < 1e-12);
                CHECK(std::abs(StripKernel<double>::lateral(contact).g(one(x))[0] / across - 1) < 1e-12);
            }
        }
    }
}

TEMPLATE_TEST_CASE("Kernels are accurate to round-off and have the right parity", "[kernel]", SCALARS) {
    using Scalar = TestType;
    const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    ArrayX<Scalar> x(12);
    x << Scalar(1e-30), Scalar(1e-12), Scalar(1e-6), Scalar(1e-3), Scalar(0.015625), Scalar(0.1), Scalar(0.5), 1,
        Scalar(1.5), 2, Scalar(3.75), 4;
    for (const auto& [name, kernel] : brute_force::every_kernel()) {
        const auto check = [&, &name = name, &exact = kernel](const auto& library) {
            const ArrayX<Scalar> g = library.g(x), H = library.H(x), P = library.H_integral(x);
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                const Real at = static_cast<Real>(x[i]);
                CAPTURE(name, static_cast<double>(at));
                CHECK(std::abs(static_cast<double>(static_cast<Real>(g[i]) / exact.g(at) - 1)) < 30 * eps);
                CHECK(std::abs(static_cast<double>(static_cast<Real>(H[i]) / exact.H(at) - 1)) < 30 * eps);
                if (at > 1e-15L) {
                    CHECK(std::abs(static_cast<double>(static_cast<Real>(P[i]) / exact.H_integral(at) - 1)) < 60 * eps);
                }
            }
            CHECK((library.g(-x) == g).all());
            CHECK((library.H(-x) == -H).all());
            CHECK((library.H_integral(-x) == P).all());
            for (const Scalar zero : {Scalar(0), -Scalar(0)}) {
                CAPTURE(name);
                CHECK(library.H(one(zero))[0] == 0);
                CHECK(library.H_integral(one(zero))[0] == 0);
                CHECK_FALSE(std::isnan(library.g(one(zero))[0]));
            }
            CHECK(std::isnan(library.H(one(std::numeric_limits<Scalar>::quiet_NaN()))[0]));
        };
        brute_force::with_library_kernel<Scalar>(kernel, check);
    }
}

TEST_CASE("H is the integral of g, and H_integral that of H", "[kernel]") {
    for (const auto& [name, kernel] : brute_force::every_kernel()) {
        brute_force::with_library_kernel<double>(kernel, [&, &name = name](const auto& library) {
            for (const double x : {1e-3, 0.02, 0.4, 1.0, 2.0}) {
                const double H = integrate([&](double t) { return library.g(one(t))[0]; }, 0, x);
                const double P = integrate([&](double t) { return library.H(one(t))[0]; }, 0, x);
                CAPTURE(name, x, H, P);
                CHECK(std::abs(library.H(one(x))[0] / H - 1) < 1e-11);
                CHECK(std::abs(library.H_integral(one(x))[0] / P - 1) < 1e-11);
            }
        });
    }
    for (const auto& [name, kernel] : brute_force::every_kernel()) {  // and brute_force::Kernel::slope is g'
        for (const Real x : {0.01L, 0.3L, 1.7L}) {
            const Real step = x * 1e-4L;
            const Real slope =
                (8 * (kernel.g(x + step) - kernel.g(x - step)) - kernel.g(x + 2 * step) + kernel.g(x - 2 * step)) /
                (12 * step);
            CAPTURE(name);
            CHECK(std::abs(static_cast<double>(slope / kernel.slope(x) - 1)) < 1e-12);
        }
    }
}

TEST_CASE("The strip tends to the plane as (a/b)^2", "[kernel][convergence]") {
    for (const double nu : {0.0, 0.25, 0.5}) {
        std::vector<double> sizes, errors;
        for (const double b : {8.0, 16.0, 32.0, 64.0, 128.0}) {
            const StripKernel<long double> strip(b, 1 - nu, nu);
            const PlaneKernel<long double> plane(b, 1 - nu, nu);
            double largest = 0;
            for (const long double x : {0.1L, 0.5L, 1.0L, 2.0L}) {
                for (const long double d :
                     {strip.g(one(x))[0] - plane.g(one(x))[0], strip.H(one(x))[0] - plane.H(one(x))[0],
                      strip.H_integral(one(x))[0] - plane.H_integral(one(x))[0]}) {
                    largest = std::max(largest, static_cast<double>(std::abs(d)));
                }
            }
            sizes.push_back(b);
            errors.push_back(largest);
        }
        const double order = support::observed_order(sizes, errors);
        CAPTURE(nu, order);
        CHECK(order > 1.97);
        CHECK(order < 2.03);
    }
}

TEMPLATE_TEST_CASE("The split of a wide strip equals g to round-off", "[kernel]", SCALARS) {
    using Scalar = TestType;
    const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    for (const Scalar nu : {Scalar(0), Scalar(0.25), Scalar(0.5)}) {
        for (const bool lateral : {false, true}) {
            for (const Scalar b : {Scalar(8), Scalar(10), Scalar(64), Scalar(1000), Scalar(1e6)}) {
                const Scalar c1 = lateral ? Scalar(1) : 1 - nu, c2 = lateral ? -nu : nu;
                const StripKernel<Scalar> strip(b, c1, c2);
                const brute_force::Kernel exact{false, static_cast<Real>(b), static_cast<Real>(c1),
                                                static_cast<Real>(c2)};
                for (const Scalar reach : {Scalar(0.01), Scalar(1), Scalar(2)}) {
                    const auto split = strip.log_split(reach);
                    REQUIRE(split.has_value());
                    for (const Scalar part : {Scalar(1e-6), Scalar(0.1), Scalar(0.7), Scalar(1)}) {
                        const Real x = static_cast<Real>(part * reach);
                        Real g = static_cast<Real>(split->constant) - static_cast<Real>(split->strength) * std::log(x);
                        Real slope = -static_cast<Real>(split->strength) / x;
                        for (Eigen::Index k = 1; k <= split->even.size(); ++k) {
                            const Real coefficient = static_cast<Real>(split->even[k - 1]);
                            g += coefficient * std::pow(x, static_cast<Real>(2 * k));
                            slope += static_cast<Real>(2 * k) * coefficient * std::pow(x, static_cast<Real>(2 * k - 1));
                        }
                        CAPTURE(nu, lateral, b, reach, static_cast<double>(x), split->even.size());
                        CHECK(std::abs(static_cast<double>(g / exact.g(x) - 1)) < 8 * eps);
                        CHECK(std::abs(static_cast<double>(slope / exact.slope(x) - 1)) < 8 * eps);
                    }
                }
                CHECK_FALSE(strip.log_split(b * Scalar(0.2501)).has_value());
            }
        }
    }
    const auto plane = PlaneKernel<Scalar>(Scalar(10), Scalar(0.75), Scalar(0.25)).log_split(Scalar(1e9));
    REQUIRE(plane.has_value());
    CHECK(plane->even.size() == 0);
}

TEST_CASE("The split has enough terms where the logarithm is weak", "[kernel]") {
    // the truncation is judged relative to the logarithm, c1, but the terms come mostly from c2
    const double b = 8, reach = 2, c1 = 0.01, c2 = 1;
    const brute_force::Kernel exact{false, b, static_cast<Real>(c1), c2};
    const auto split = StripKernel<double>(b, c1, c2).log_split(reach);
    REQUIRE(split.has_value());
    for (const Real x : {Real(0.5), Real(1), Real(1.5), Real(2)}) {
        Real rest = 0, size = static_cast<Real>(split->strength) / x;  // of the slope
        for (Eigen::Index k = 1; k <= split->even.size(); ++k) {
            rest += static_cast<Real>(2 * k) * static_cast<Real>(split->even[k - 1]) *
                    std::pow(x, static_cast<Real>(2 * k - 1));
        }
        const Real error = rest - size - exact.slope(x);
        CAPTURE(static_cast<double>(x), split->even.size());
        CHECK(static_cast<double>(std::abs(error) / size) < 8 * std::numeric_limits<double>::epsilon());
    }
}

TEST_CASE("Taylor coefficients of the strip reproduce g about any point", "[kernel]") {
    for (const double b : {0.01, 0.3, 1.0, 4.0, 1000.0}) {
        for (const auto& [c1, c2] : {std::pair{0.75, 0.25}, {1.0, -0.25}, {0.5, 0.5}}) {
            const StripKernel<double> strip(b, c1, c2);
            const brute_force::Kernel exact{false, b, c1, c2};
            for (const double x : {0.003, 0.2, -0.9, 2.0}) {
                const Eigen::Index order = 24;
                const Eigen::ArrayXXd series = strip.taylor(one(x), order);
                REQUIRE(series.cols() == order + 1);
                for (Eigen::Index k = 0; k <= order; ++k) {
                    // Cauchy's integral of g over a circle of half the radius of convergence, by the trapezoidal rule
                    std::complex<Real> sum = 0;
                    const int count = 128;
                    for (int j = 0; j < count; ++j) {
                        const Real angle = 2 * std::numbers::pi_v<Real> * j / count;
                        const std::complex<Real> turn(std::cos(angle), std::sin(angle));
                        const std::complex<Real> z = std::abs(static_cast<Real>(x)) * (Real(1) + turn / Real(2));
                        const std::complex<Real> r = std::sqrt(z * z + exact.b * exact.b);
                        const std::complex<Real> g =
                            exact.scale() * (exact.c1 * std::log((exact.b + r) / z) + exact.c2 * exact.b / r);
                        sum += g * std::pow(turn, static_cast<Real>(-k));
                    }
                    const Real coefficient = sum.real() / count * std::pow(Real(2), static_cast<Real>(k));
                    const Real size = k == 0 ? std::abs(coefficient)
                                             : exact.scale() * exact.b / std::hypot(exact.b, static_cast<Real>(x));
                    CAPTURE(b, c1, x, k, series(0, k), static_cast<double>(coefficient));
                    // round-off of the circle's mean grows like 2^k; a coefficient is at most about `size`
                    const double error =
                        std::abs(static_cast<double>((static_cast<Real>(series(0, k)) - coefficient) / size));
                    CHECK(error < 1e-13 + 1e-17 * std::pow(2.0, static_cast<double>(k)));
                }
            }
        }
    }
}

TEST_CASE("Kernels reject a half-width that is not positive", "[kernel]") {
    CHECK_THROWS_WITH(PlaneKernel<double>(0, 0.75, 0.25), "PlaneKernel: half_width = 0 must be positive");
    CHECK_THROWS_WITH(StripKernel<double>(-1, 0.75, 0.25), "StripKernel: half_width = -1 must be positive");
    CHECK_THROWS_AS(StripKernel<double>(std::numeric_limits<double>::quiet_NaN(), 0.75, 0.25), std::invalid_argument);
}

TEST_CASE("The contact sets the coefficients of both directions", "[kernel]") {
    const Contact<double> contact = Contact<double>::dimensionless(5, 0.3);
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(5, 0.1, 2);
    CHECK((PlaneKernel<double>::longitudinal(contact).g(x) == PlaneKernel<double>(5, 0.7, 0.3).g(x)).all());
    CHECK((PlaneKernel<double>::lateral(contact).g(x) == PlaneKernel<double>(5, 1, -0.3).g(x)).all());
    CHECK((StripKernel<double>::longitudinal(contact).g(x) == StripKernel<double>(5, 0.7, 0.3).g(x)).all());
    CHECK((StripKernel<double>::lateral(contact).g(x) == StripKernel<double>(5, 1, -0.3).g(x)).all());
}

TEST_CASE("AnyKernel is the kernel of its model", "[kernel]") {
    const Mesh<double> mesh = cosine_mesh(9);
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(5, -0.1, 2);
    const auto check = [&](const AnyKernel<double>& any, const auto& kernel) {
        CHECK((any.smooth_part(x) == kernel.smooth_part(x)).all());
        CHECK(any.smooth_slope(0.3) == kernel.smooth_slope(0.3));
        const auto of_any = rolling_system(mesh, Collocation{}, any),
                   same = rolling_system(mesh, Collocation{}, kernel);
        CHECK(of_any.G() == same.G());
        CHECK(of_any.G_prime() == same.G_prime());
        CHECK(of_any.aspect() == same.aspect());
        CHECK(of_any.log_strength() == same.log_strength());
    };
    const auto any = [](double b, LineModel model) {
        return AnyKernel<double>::longitudinal(model, Contact<double>::dimensionless(b, 0.3));
    };
    for (const double b : {0.1, 4.0, 1000.0}) {  // without a logarithm, and with one
        check(any(b, LineModel::strip), StripKernel<double>(b, 0.7, 0.3));
        if (b > 1) check(any(b, LineModel::plane), PlaneKernel<double>(b, 0.7, 0.3));
    }
    const Contact<double> contact = Contact<double>::dimensionless(5, 0.3);
    check(AnyKernel<double>::lateral(LineModel::strip, contact), StripKernel<double>::lateral(contact));
    CHECK_THROWS_WITH(rolling_system(mesh, Collocation{}, any(0.1, LineModel::plane)),
                      Catch::Matchers::ContainsSubstring("Lambda"));
    CHECK(any(1e300, LineModel::strip).model() == LineModel::strip);
    CHECK(any(std::numeric_limits<double>::infinity(), LineModel::strip).model() == LineModel::plane);
}

TEST_CASE("The slope of a kernel splits into a singular and a smooth part", "[kernel]") {
    for (const double b : {0.1, 1.0, 1e3}) {
        const StripKernel<double> strip(b, 0.72, 0.28);
        for (const double x : {-1.9, -0.3, 0.02, 0.7, 2.0}) {
            const Eigen::ArrayXd at = Eigen::ArrayXd::Constant(1, x);
            const double slope = strip.taylor(at, 1)(0, 1) / x;
            CAPTURE(b, x);
            CHECK(strip.smooth_slope(x) - strip.smooth_split().strength / x == Approx(slope).epsilon(1e-13));
            CHECK(strip.smooth_slope(-x) == -strip.smooth_slope(x));
        }
        CHECK(strip.smooth_slope(0) == 0);
        CHECK(strip.smooth_split().distance == b);
        const PlaneKernel<double> plane(b, 0.72, 0.28);
        CHECK(plane.smooth_split().strength == Approx(strip.smooth_split().strength).epsilon(1e-15));
        CHECK(plane.smooth_slope(0.3) == 0);
    }
    const StripKernel<double> infinite(std::numeric_limits<double>::infinity(), 0.72, 0.28);
    CHECK(infinite.smooth_slope(0.5) == 0);
}

}  // namespace
