// User-defined schemes, rollbem/discretisation/scheme.hpp and any_scheme.hpp: all that the library asks for is rows(). In every problem,
// the mean over two collocation points, whose matrices are the means of those of each point.
#include <cmath>
#include <stdexcept>
#include <utility>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/compiled/frequency.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/discretisation/any_scheme.hpp>
#include <rollbem/normal/hertz.hpp>

#include "support/catch.hpp"

namespace own_scheme_tests {
namespace {

using namespace rollbem;

// Finite differences at alpha_l - half and alpha_l + half.
struct TwoPoints {
    double alpha_L, alpha_T, half;

    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        SchemeRows<Scalar> rows = rows_about(mesh, alpha_L, alpha_T);
        rows.offsets.resize(2);
        rows.offsets << static_cast<Scalar>(-half), static_cast<Scalar>(half);
        rows.weights.setConstant(2, Scalar(0.5));
        rows.averages = quantity == Quantity::slope ? 1 : 0;
        return rows;
    }
    Collocation behind() const { return {alpha_L - half, alpha_T - half}; }
    Collocation ahead() const { return {alpha_L + half, alpha_T + half}; }
};
// Differences between each centre and the point one width ahead of it: Collocation at alpha = 0.5, put another way.
struct OneWidthAhead {
    template <class Scalar>
    SchemeRows<Scalar> rows(Quantity quantity, const Mesh<Scalar>& mesh) const {
        SchemeRows<Scalar> rows =
            rows_between<Scalar>(ArrayX<Scalar>::Zero(mesh.size()), ArrayX<Scalar>::Ones(mesh.size()));
        rows.averages = quantity == Quantity::slope ? 1 : 0;
        return rows;
    }
};
static_assert(RollingScheme<TwoPoints> && RollingScheme<TwoPoints, float> && RollingScheme<TwoPoints, long double>);

const Contact<double> contact = Contact<double>::dimensionless(100, 0.28);
const StripKernel<double> kernel = StripKernel<double>::longitudinal(contact);
const TwoPoints stable{0.5, 0.5, 0.125}, unstable{0, 1, 0.15};

ElementSystem<double> mean_of_both(const Mesh<double>& mesh, const TwoPoints& scheme) {
    const auto [G, G_prime] = assemble(mesh, scheme.behind(), kernel);
    const auto [other_G, other_G_prime] = assemble(mesh, scheme.ahead(), kernel);
    return {(G + other_G) / 2, (G_prime + other_G_prime) / 2, mesh.widths()};
}

TEST_CASE("A row can be written as a mean about a point or as a difference between two", "[scheme]") {
    for (const Mesh<double>& mesh : {uniform_mesh(20), cosine_mesh(17), geometric_mesh(12, 3.0)}) {
        const auto [G, G_prime] = assemble(mesh, OneWidthAhead{}, kernel);
        const auto [expected_G, expected_G_prime] = assemble(mesh, Collocation{0.5, 0.5}, kernel);
        CHECK(G == expected_G);
        CHECK(G_prime == expected_G_prime);
    }
}

TEST_CASE("The matrices of a scheme with two points are the means of those of each point", "[scheme]") {
    for (const TwoPoints& scheme : {stable, unstable}) {
        for (const Mesh<double>& mesh : {uniform_mesh(20), cosine_mesh(17), geometric_mesh(12, 3.0)}) {
            const ElementSystem<double> own = rolling_system(mesh, scheme, kernel), mean = mean_of_both(mesh, scheme);
            CAPTURE(scheme.alpha_T, mesh.size());
            CHECK((own.G() - mean.G()).cwiseAbs().maxCoeff() < 1e-14 * mean.G().cwiseAbs().maxCoeff());
            CHECK((own.G_prime() - mean.G_prime()).cwiseAbs().maxCoeff() <
                  1e-13 * mean.G_prime().cwiseAbs().maxCoeff());
            CHECK((own.weights() == mesh.widths()).all());
        }
    }
}

TEST_CASE("A scheme with two points solves steady, stability, frequency and time problems", "[scheme]") {
    const Mesh<double> mesh = uniform_mesh(20);
    const ElementSystem<double> own = rolling_system(mesh, stable, kernel), mean = mean_of_both(mesh, stable);

    const Response<double> steady = solve_steady(mesh, stable, kernel);
    CHECK(steady.status == Status::ok);
    CHECK(steady.c11() == Approx(solve_steady<double>(mean.G_prime(), mesh.widths()).c11()).epsilon(1e-12));

    CHECK(count_unstable<double>(own).unstable_count == 0);
    const Eigen::Index grown = count_unstable<double>(mean_of_both(mesh, unstable)).unstable_count;
    CHECK(grown > 0);
    CHECK(count_unstable<double>(rolling_system(mesh, unstable, kernel)).unstable_count == grown);
    CHECK(judge_stability(own).stable());
    CHECK(judge_stability(own).spectral_abscissa == Approx(judge_stability(mean).spectral_abscissa).epsilon(1e-9));
    CHECK(judge_stability(rolling_system(mesh, unstable, kernel)).certainly_unstable());

    const Response<std::complex<double>> harmonic = solve_response(rolling_system(mesh, stable, kernel), {0, 2.0});
    CHECK(harmonic.status == Status::ok);
    CHECK(std::abs(harmonic.c11() - solve_response(mean, {0, 2.0}).c11()) < 1e-12);
    CHECK(std::abs(FrequencySweep<double>(own)(2.0).c11() - solve_response(mean, {0, 2.0}).c11()) < 1e-12);

    const AdhesionModel<> model(contact, own, unchecked), expected(contact, mean, unchecked);
    AdhesionState<> now = model.at_rest(), next = now;
    AdhesionWorkspace<> workspace = model.workspace(), expected_workspace = expected.workspace();
    AdhesionState<> expected_now = expected.at_rest(), expected_next = expected_now;
    for (int step = 0; step < 5; ++step) {
        const AdhesionStep<> made = model.advance(now, 0.2, 1e-3, next, workspace);
        const AdhesionStep<> wanted = expected.advance(expected_now, 0.2, 1e-3, expected_next, expected_workspace);
        REQUIRE(made.status == StepStatus::ok);
        CHECK(made.force == Approx(wanted.force).epsilon(1e-11));
        std::swap(now, next);
        std::swap(expected_now, expected_next);
    }
}

TEST_CASE("A scheme with two points solves friction problems", "[scheme]") {
    const Mesh<double> mesh = uniform_mesh(20);
    const Friction<> friction{0.3, 1e-2 * mean_hertz_pressure(mesh)};
    const FrictionModel<> model(contact, steady_system(mesh, stable, kernel), friction);
    const FrictionModel<> expected(contact, {{}, mean_of_both(mesh, stable).G_prime(), mesh.widths()}, friction);
    const auto force = [](const FrictionModel<>& of) {
        FrictionWorkspace<> workspace = of.workspace();
        FrictionState<> now = of.at_rest(), next = now;
        return of.steady(now, 2e-3, next, workspace).force;
    };
    CHECK(force(model) == Approx(force(expected)).epsilon(1e-11));

    const ElementSystem<double> own = rolling_system(mesh, stable, kernel), mean = mean_of_both(mesh, stable);
    const FrictionModel<> rolling(contact, own, judge_stability(own), friction);
    const FrictionModel<> expected_rolling(contact, mean, judge_stability(mean), friction);
    FrictionWorkspace<> workspace = rolling.workspace(), expected_workspace = expected_rolling.workspace();
    Eigen::Index stick_count = 0;
    FrictionState<> now = rolling.at_rest(), next = now;
    FrictionState<> expected_now = expected_rolling.at_rest(), expected_next = expected_now;
    for (int step = 0; step < 5; ++step) {
        const auto made = rolling.advance(now, 0.2, 1e-2, next, workspace);
        const auto wanted = expected_rolling.advance(expected_now, 0.2, 1e-2, expected_next, expected_workspace);
        REQUIRE(made.status == StepStatus::ok);
        CHECK(made.force == Approx(wanted.force).epsilon(1e-11));
        CHECK(made.stick_count == wanted.stick_count);
        stick_count = made.stick_count;
        std::swap(now, next);
        std::swap(expected_now, expected_next);
    }
    CHECK(stick_count > 0);
    CHECK(stick_count < mesh.size());
}

TEST_CASE("AnyScheme has the matrices of the scheme that it holds", "[scheme]") {
    for (const Mesh<double>& mesh : {uniform_mesh(7), cosine_mesh(9)}) {
        const auto check = [&](const auto& scheme) {
            const AnyScheme any = scheme, copy = any;
            CHECK(assemble_G(mesh, copy, kernel) == assemble_G(mesh, scheme, kernel));
            CHECK(assemble_G_prime(mesh, copy, kernel) == assemble_G_prime(mesh, scheme, kernel));
        };
        check(Collocation{0, 0.63});
        check(Galerkin{.alpha_L = 0, .alpha_T = 0.63, .quadrature = 3});
        check(KnotheBoundary{});
        check(NodeDifference{});
        check(stable);
    }
    const auto alpha = [](const auto& mesh, const AnyScheme& any) { return any.rows(Quantity::slope, mesh).alpha[0]; };
    CHECK(alpha(uniform_mesh<float>(3), Collocation{0, 0.63}) == 0.63F);
    CHECK(alpha(uniform_mesh<double>(3), TwoPoints{0, 0.63, 0.1}) == 0.63);
    CHECK_THROWS_AS(alpha(uniform_mesh<float>(3), TwoPoints{0, 0.63, 0.1}), std::invalid_argument);
    AnyScheme any;
    REQUIRE(any.get_if<Collocation>() != nullptr);
    any = Galerkin{.alpha_T = 0.63};
    CHECK(any.get_if<Collocation>() == nullptr);
    CHECK(any.get_if<Galerkin>()->alpha_T == 0.63);
}

}  // namespace
}  // namespace own_scheme_tests
