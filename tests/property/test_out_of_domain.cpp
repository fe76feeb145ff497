// rollbem/rollbem.hpp: every value outside the domain of a public argument is rejected by name, in every scalar type.
#include <complex>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <rollbem/elasticity/detail/plane_model.hpp>
#include <rollbem/line.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"
#include "support/scalars.hpp"

namespace out_of_domain_tests {
namespace {

using namespace rollbem;

/// The given values, and those that no argument accepts.
template <class Scalar>
std::vector<Scalar> bad(std::vector<Scalar> values = {}) {
    using Limits = std::numeric_limits<Scalar>;
    for (const Scalar value : {Limits::quiet_NaN(), -Limits::infinity()}) values.push_back(value);
    return values;
}

/// Each value is rejected by one line with the quantity, the value and the condition.
template <class Scalar>
void refuses(const std::string& quantity, const std::vector<Scalar>& values, const std::function<void(Scalar)>& call) {
    for (const Scalar value : values) {
        const std::string message = refusal([&] { call(value); });
        CAPTURE(quantity, static_cast<double>(value), message);
        CHECK(message.find(": " + quantity + " = ") != std::string::npos);
        CHECK(message.find(" must ") != std::string::npos);
        CHECK(message.find('\n') == std::string::npos);
        const std::string shown = detail::to_text(value);
        const bool derived = quantity.find_first_of("(/|") != std::string::npos;  // shows a value computed from it
        CHECK((derived || message.find("= " + shown + " must") != std::string::npos));
    }
}

TEST_CASE("Contacts reject every parameter out of its domain", "[domain]") {
    const double infinity = std::numeric_limits<double>::infinity(), tiny = std::numeric_limits<double>::denorm_min();
    refuses<double>("half_length",
                    bad<double>({0, -1, infinity, tiny, 1e-310, 1e-121, 1e61, std::numeric_limits<double>::max()}),
                    [](double a) {
                        Contact({a, 1, 1, 0.25});
                    });
    refuses<double>("half_width", bad<double>({0, -1, -tiny}), [](double b) { Contact({1, b, 1, 0.25}); });
    refuses<double>("shear_modulus", bad<double>({0, -1, infinity, tiny}), [](double G) { Contact({1, 1, G, 0.25}); });
    refuses<double>("poisson_ratio", bad<double>({-tiny, 0.5 + std::numeric_limits<double>::epsilon(), 1}),
                    [](double nu) {
                        Contact({1, 1, 1, nu});
                    });
    refuses<double>("aspect", bad<double>({0, -1}), [](double b) { Contact::dimensionless(b, 0); });
    CHECK(Contact({.half_length = 2, .shear_modulus = 1, .poisson_ratio = 0}).aspect() == infinity);  // if not given
    // a quotient that underflows
    CHECK(refusal([&] {
              Contact({.half_length = 1e12, .half_width = tiny, .shear_modulus = 1, .poisson_ratio = 0});
          }).find("half_width / half_length = 0 must be positive") != std::string::npos);
}

TEMPLATE_TEST_CASE("Meshes reject every parameter out of its domain", "[domain]", SCALARS) {
    using Scalar = TestType;
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const std::vector<Scalar> not_positive = bad<Scalar>({0, -1, infinity});
    refuses<Scalar>("size_ratio", not_positive, [](Scalar ratio) { geometric_mesh<Scalar>(5, ratio); });
    refuses<Scalar>("epsilon", not_positive, [](Scalar epsilon) { knothe_mesh<Scalar>(5, epsilon); });
    refuses<Scalar>("epsilon", not_positive, [](Scalar epsilon) { modified_knothe_mesh<Scalar>(5, epsilon); });
    const std::vector<Eigen::Index> none{0, -1, std::numeric_limits<Eigen::Index>::min()};
    refuses<Eigen::Index>("n", none, [](Eigen::Index n) { uniform_mesh<Scalar>(n); });
    refuses<Eigen::Index>("n", none, [](Eigen::Index n) { cosine_mesh<Scalar>(n); });
    refuses<Eigen::Index>("n", {1, 0, -1}, [](Eigen::Index n) { geometric_mesh<Scalar>(n, 2); });
    refuses<Eigen::Index>("n", {2, 1, 0, -1}, [](Eigen::Index n) { knothe_mesh<Scalar>(n, Scalar(0.4)); });
    refuses<Eigen::Index>("n", {1, 0, -1}, [](Eigen::Index n) { modified_knothe_mesh<Scalar>(n, Scalar(0.4)); });
    const auto edges = [](std::vector<Scalar> values) {
        mesh_from_edges<Scalar>(Eigen::Map<ArrayX<Scalar>>(values.data(), static_cast<Eigen::Index>(values.size())));
    };
    refuses<Scalar>("first edge", bad<Scalar>({0, Scalar(-1.5)}), [&](Scalar x) { edges({x, 0, 1}); });
    refuses<Scalar>("last edge", bad<Scalar>({0, Scalar(1.5)}), [&](Scalar x) { edges({-1, 0, x}); });
    refuses<Scalar>("edge", bad<Scalar>({-1, -2}), [&](Scalar x) { edges({-1, x, 1}); });
    CHECK(refusal([&] { edges({-1, 1, 1}); }).find("must be larger than the edge before it") != std::string::npos);
    CHECK(refusal([&] { edges({-1, infinity, 1}); }).find("must be larger") != std::string::npos);
    CHECK(refusal([&] { edges({-1}); }).find("number of edges = 1 must be at least 2") != std::string::npos);
    CHECK(refusal([&] { edges({}); }).find("number of edges = 0 must be at least 2") != std::string::npos);
    // a ratio that leaves elements without width
    const Scalar huge = std::numeric_limits<Scalar>::max();
    CHECK(refusal([&] { geometric_mesh<Scalar>(3, huge); }).find(" must ") != std::string::npos);
}

TEST_CASE("Schemes reject every parameter out of its domain", "[domain]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto alphas = bad<double>({2.0000001, -2.0000001, infinity});
    const auto lambdas = bad<double>({-1e-300, 1.0000001, infinity});
    refuses<double>("alpha_L", alphas, [](double x) { check_scheme(Collocation{.alpha_L = x}, uniform_mesh(5)); });
    refuses<double>("alpha_T", alphas, [](double x) { check_scheme(Collocation{.alpha_T = x}, uniform_mesh(5)); });
    refuses<double>("lambda", lambdas, [](double x) { check_scheme(Collocation{.lambda = x}, uniform_mesh(5)); });
    refuses<double>("alpha_L", alphas, [](double x) { check_scheme(Galerkin{.alpha_L = x}, uniform_mesh(5)); });
    refuses<double>("alpha_T", alphas, [](double x) { check_scheme(Galerkin{.alpha_T = x}, uniform_mesh(5)); });
    refuses<double>("lambda", lambdas, [](double x) { check_scheme(Galerkin{.lambda = x}, uniform_mesh(5)); });
    refuses<int>("quadrature", {-1, 1001, std::numeric_limits<int>::min()},
                 [](int points) { check_scheme(Galerkin{.quadrature = points}, uniform_mesh(5)); });
    refuses<Eigen::Index>("n", {1}, [](Eigen::Index n) { check_scheme(Collocation{0, 0.63}, uniform_mesh(n)); });
    refuses<Eigen::Index>("n", {1}, [](Eigen::Index n) { check_scheme(Galerkin{0, 0.63}, uniform_mesh(n)); });
    refuses<Eigen::Index>("n", {1}, [](Eigen::Index n) { check_scheme(KnotheBoundary{}, uniform_mesh(n)); });
}

TEMPLATE_TEST_CASE("Kernels reject every parameter out of its domain", "[domain]", SCALARS) {
    using Scalar = TestType;
    const Scalar infinity = std::numeric_limits<Scalar>::infinity();
    const std::vector<Scalar> widths = bad<Scalar>({0, -1}), constants = bad<Scalar>({infinity});
    refuses<Scalar>("half_width", widths, [](Scalar b) { PlaneKernel<Scalar>(b, 1, 0); });
    refuses<Scalar>("half_width", widths, [](Scalar b) { StripKernel<Scalar>(b, 1, 0); });
    refuses<Scalar>("c1", constants, [](Scalar c) { PlaneKernel<Scalar>(1, c, 0); });
    refuses<Scalar>("c2", constants, [](Scalar c) { PlaneKernel<Scalar>(1, 1, c); });
    refuses<Scalar>("c1", constants, [](Scalar c) { StripKernel<Scalar>(1, c, 0); });
    refuses<Scalar>("c2", constants, [](Scalar c) { StripKernel<Scalar>(1, 1, c); });
    refuses<Scalar>("compliance", bad<Scalar>({Scalar(-0.5), infinity}),
                    [](Scalar L) { LayeredKernel(PlaneKernel<Scalar>(1, 1, 0), L); });
    refuses<Scalar>("Lambda = ln(4b/a) + c2/c1", {Scalar(0.01), Scalar(0.25)},
                    [](Scalar b) { detail::require_stable_model(PlaneKernel<Scalar>(b, 1, 0)); });
}

TEMPLATE_TEST_CASE("Closed forms reject every argument out of its domain", "[domain]", SCALARS) {
    using Scalar = TestType;
    const Scalar infinity = std::numeric_limits<Scalar>::infinity(), quarter = Scalar(0.25);
    const std::vector<Scalar> ratios = bad<Scalar>({Scalar(-0.1), Scalar(0.6), infinity});
    refuses<Scalar>("poisson_ratio", ratios, [](Scalar nu) { steady_c11(nu); });
    refuses<Scalar>("poisson_ratio", ratios, [](Scalar nu) { ellipse_limit_c11(nu); });
    refuses<Scalar>("poisson_ratio", ratios, [](Scalar nu) { plane_lambda(nu, Scalar(1)); });
    refuses<Scalar>("poisson_ratio", ratios, [](Scalar nu) { carter_traction(Scalar(0), nu); });
    const auto middle = EdgeDistances<Scalar>::at(0), end = EdgeDistances<Scalar>::at(1);
    refuses<Scalar>("poisson_ratio", ratios, [&](Scalar nu) { carter_mean_traction(middle, Scalar(1), end, nu); });
    refuses<Scalar>("width", bad<Scalar>({0, -1, infinity}),
                    [&](Scalar width) { carter_mean_traction(middle, width, end, quarter); });
    refuses<Scalar>("aspect", bad<Scalar>({0, -1, infinity}), [=](Scalar b) { plane_lambda(quarter, b); });
    refuses<Scalar>("x/a", bad<Scalar>({Scalar(1.01), Scalar(-1.01), infinity}),
                    [=](Scalar x) { carter_traction(x, quarter); });
    refuses<Scalar>("trailing", bad<Scalar>({-1}), [=](Scalar d) {
        carter_traction(EdgeDistances<Scalar>{d, 1}, quarter);
    });
    refuses<Scalar>("leading", bad<Scalar>({-1}), [=](Scalar d) {
        carter_traction(EdgeDistances<Scalar>{1, d}, quarter);
    });
}

TEMPLATE_TEST_CASE("The polynomial approach rejects every argument out of its domain", "[domain]", SCALARS) {
    using Scalar = TestType;
    using Complex = std::complex<Scalar>;
    const Scalar infinity = std::numeric_limits<Scalar>::infinity(), nan = std::numeric_limits<Scalar>::quiet_NaN();
    const Scalar quarter = Scalar(0.25);
    const Complex i(0, 1);
    refuses<Scalar>("poisson_ratio", bad<Scalar>({Scalar(-0.1), Scalar(0.6)}),
                    [=](Scalar nu) { polynomial_c11<Scalar>(i, nu, 100, 20); });
    refuses<Scalar>("aspect", bad<Scalar>({0, -1, infinity}),
                    [=](Scalar b) { polynomial_c11<Scalar>(i, quarter, b, 20); });
    refuses<Eigen::Index>("order", {0, -1}, [=](Eigen::Index m) { polynomial_c11<Scalar>(i, quarter, 100, m); });
    refuses<Scalar>("Lambda = ln(4b/a) + nu/(1-nu)", {Scalar(0.01)},
                    [=](Scalar b) { polynomial_c11<Scalar>(i, quarter, b, 20); });
    for (const Complex s : {Complex(nan, 0), Complex(0, nan), Complex(infinity, 0), Complex(0, -infinity)}) {
        CHECK_THROWS_AS(polynomial_c11<Scalar>(s, quarter, 100, 20), std::invalid_argument);
        CHECK_THROWS_AS(polynomial_c11<Scalar>(s, quarter, 100), std::invalid_argument);
    }
    CHECK_THROWS_AS(default_polynomial_order(Complex(0, Scalar(2e8))), std::invalid_argument);
}

TEST_CASE("Hertz's contact rejects every parameter out of its domain", "[domain]") {
    const std::vector<double> not_positive = bad<double>({0, -1, std::numeric_limits<double>::infinity()});
    const ElasticBody steel{2e11, 0.25};
    refuses<double>("load_per_width", not_positive, [&](double P) { HertzLine({P, 1, steel, steel}); });
    refuses<double>("combined_radius", not_positive, [&](double R) { HertzLine({1, R, steel, steel}); });
    refuses<double>("young_modulus", not_positive, [&](double E) { HertzLine({1, 1, {E, 0.25}, steel}); });
    refuses<double>("young_modulus", not_positive, [&](double E) { HertzLine({1, 1, steel, {E, 0.25}}); });
    refuses<double>("poisson_ratio", bad<double>({-0.1, 0.6}), [&](double nu) {
        HertzLine({1, 1, steel, {2e11, nu}});
    });
}

TEST_CASE("Models reject every argument out of its domain", "[domain]") {
    const double infinity = std::numeric_limits<double>::infinity();
    const Contact contact = Contact::dimensionless(100, 0.28);
    const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
    const Mesh<double> mesh = cosine_mesh(4);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    const ElementSystem<double> system = rolling_system(mesh, scheme, kernel);

    const AdhesionModel<> rolling(contact, system, unchecked);
    refuses<double>("creepage", bad<double>({infinity}), [&](double creepage) { rolling.steady(creepage); });

    const FrequencySweep sweep(system);
    refuses<double>("omega a/V", bad<double>({infinity}), [&](double z) { sweep(z); });
    refuses<double>("Re(s)", bad<double>({infinity}), [&](double re) { sweep.at({re, 0}); });
    refuses<double>("Im(s)", bad<double>({infinity}), [&](double im) { sweep.at({0, im}); });

    const std::vector<double> tolerances = bad<double>({0, -1e-3, 1});
    for (const Purpose::Adhesion purpose : {Purpose::steady, Purpose::frequency, Purpose::time_loop}) {
        refuses<double>("tolerance", tolerances, [&](double x) { recommended_scheme(x, purpose); });
        refuses<double>("tolerance", tolerances, [&](double x) { recommended_elements(x, purpose); });
        refuses<double>("aspect", {0, -1, 9.9e-3, std::numeric_limits<double>::quiet_NaN()},
                        [&](double aspect) { recommended_scheme(0.1, purpose, aspect); });
    }
    refuses<double>("tolerance", tolerances, [](double x) { recommended_scheme(x, Purpose::friction); });
}

}  // namespace
}  // namespace out_of_domain_tests
