// rollbem/problem/hertz.hpp
#include <algorithm>
#include <cmath>
#include <numbers>

#include "rollbem/detail/gauss_legendre.hpp"
#include "rollbem/problem/hertz.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;

// Mean of sqrt(1 - x^2) between two edges: the integral of sin^2 theta, x = -cos theta, by quadrature in long double.
long double exact_mean(const Mesh<long double>& mesh, Eigen::Index i) {
    static const detail::QuadratureRule<long double> rule = detail::gauss_legendre<long double>(20);
    const auto angle = [&](Eigen::Index j) {
        return 2 * std::atan2(std::sqrt(mesh.edges_from_trailing()[j]), std::sqrt(mesh.edges_from_leading()[j]));
    };
    const long double half = (angle(i + 1) - angle(i)) / 2, middle = (angle(i + 1) + angle(i)) / 2;
    long double sum = 0;
    for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
        const long double sine = std::sin(middle + half * rule.nodes[k]);
        sum += rule.weights[k] * sine * sine;
    }
    return sum * half / mesh.widths()[i];
}

TEST_CASE("Hertz's mean pressure of every element to rounding", "[hertz]") {
    // the angle an element takes up goes from all of the half-circle to little: with and without the series
    double largest = 0;
    for (Eigen::Index n = 1; n < 200; ++n) {
        const ArrayX<double> cosine = mean_hertz_pressure(cosine_mesh<double>(n));
        const ArrayX<double> uniform = mean_hertz_pressure(uniform_mesh<double>(n));
        const Mesh<long double> exact_cosine = cosine_mesh<long double>(n),
                                exact_uniform = uniform_mesh<long double>(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const long double error = std::max(std::abs(cosine[i] / exact_mean(exact_cosine, i) - 1),
                                               std::abs(uniform[i] / exact_mean(exact_uniform, i) - 1));
            if (!(error <= static_cast<long double>(largest))) largest = static_cast<double>(error);
        }
    }
    CAPTURE(largest);
    CHECK(largest < 3e-15);
}

TEST_CASE("Hertz's contact of bodies at both ends of Poisson's ratio", "[hertz]") {
    const ElasticBody<double> rubber{1e6, 0.5}, cork{1e6, 0};
    const HertzLine<double> hertz({.load_per_width = 1e3, .combined_radius = 0.1, .body_1 = rubber, .body_2 = cork});
    // 1/E* = (0.75 + 1)/E
    CHECK(hertz.half_length() == Approx(std::sqrt(4e2 / std::numbers::pi * 1.75e-6)).epsilon(1e-14));
    CHECK(hertz.contact(1).poisson_ratio() == Approx(0.5 * 1.5 / 2.5).epsilon(1e-14));
}

}  // namespace
