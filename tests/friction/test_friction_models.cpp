// rollbem/friction/model.hpp: what holds for every law and both numbers of directions. One list of cases, one property a
// test.
#include <cmath>
#include <type_traits>
#include <utility>

#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/adhesion/transient.hpp>
#include <rollbem/compiled/friction.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

constexpr double peak = 1e-3;
constexpr Travel<double> travel{0.1, 0.1};  // at the speed 1
using Falling = ExponentialFall<>;

/// Hertz's contact with a = G = 1 and a law whose coefficient at rest is 1, at the collocation `alpha`.
template <class Law_, int directions_>
struct Case {
    using Law = Law_;
    static constexpr int directions = directions_;
    using Model = FrictionModel<Law, directions>;

    explicit Case(double alpha = 0.5) : scheme{.alpha_L = alpha, .alpha_T = alpha} {}

    static Law law() {
        if constexpr (std::is_same_v<Law, Falling>) {
            return {1, 0.6, peak};
        } else {
            return 1;
        }
    }
    static auto creepage(double ratio) {
        const double size = 2 * 0.72 * peak * ratio;
        if constexpr (directions == 1) {
            return size;
        } else {
            return Creepage<double>{0.8 * size, 0.6 * size};
        }
    }
    Friction<Law> friction() const { return {law(), peak * mean_hertz_pressure(mesh), {2e-4, 1e-5}}; }
    auto kernel(bool lateral, const Contact<double>& of) const {
        return lateral ? PlaneKernel<double>::lateral(of) : PlaneKernel<double>::longitudinal(of);
    }
    Model steady(Checks checks = {}) const {
        const auto system = [&](bool lateral) { return steady_system(mesh, scheme, kernel(lateral, contact)); };
        if constexpr (directions == 1) {
            return {contact, system(false), checks, friction()};
        } else {
            return {contact, {system(false), system(true)}, checks, friction()};
        }
    }
    /// `stiffer`: with other G, but the same G'.
    Model model(double stiffer = 1) const {
        const auto system = [&](bool lateral) {
            const ElementSystem<double> own = rolling_system(mesh, scheme, kernel(lateral, contact));
            return stiffer == 1 ? own : ElementSystem<double>(stiffer * own.G(), own.G_prime(), own.weights());
        };
        Friction<Law> law_of = friction();
        if (stiffer != 1) law_of.memory = {};
        if constexpr (directions == 1) {
            return {contact, system(false), unchecked, law_of};
        } else {
            return {contact, {system(false), system(true)}, unchecked, law_of};
        }
    }

    Contact<double> contact = Contact<double>::dimensionless(100, 0.28);
    Mesh<double> mesh = cosine_mesh<double>(20);
    Collocation scheme;
};

double sum(double force) { return force; }
double sum(const TangentialForce<double>& force) { return force.longitudinal + force.lateral; }

#define ALL_CASES (Case<ConstantFriction<>, 1>), (Case<ConstantFriction<>, 2>), (Case<Falling, 1>), (Case<Falling, 2>)

TEMPLATE_TEST_CASE("A steady state starts a run in time", "[friction]", ALL_CASES) {
    const TestType scene;
    const auto steady = scene.steady();
    const auto model = scene.model();
    CHECK(steady.fingerprint() == model.fingerprint());
    auto now = steady.at_rest(), next = now;
    auto workspace = steady.workspace();
    const auto creepage = TestType::creepage(0.5);
    const auto point = steady.steady(model.at_rest(), creepage, 1, now, workspace);
    REQUIRE(point.status == StepStatus::ok);
    // the same workspace serves both, and rolling on changes nothing but the effect of finite steps on the memory
    auto in_time = model.steady(model.at_rest(), creepage, 1, next, workspace);
    CHECK(sum(in_time.force) == sum(point.force));
    in_time = model.advance(now, travel, creepage, next, workspace);
    REQUIRE(in_time.status == StepStatus::ok);
    // the angles by which slip turns are those of each step's own plain solution
    const double turn = TestType::directions == 2 ? 1e-5 : 1e-12;
    const double margin = detail::is_constant<typename TestType::Law> ? turn : 0.02;
    CHECK(sum(in_time.force) == Approx(sum(point.force)).epsilon(margin));
}

TEMPLATE_TEST_CASE("Steady forces of a scheme that does not converge are not given", "[friction]", ALL_CASES) {
    for (const double alpha : {-0.3, 1.3}) {
        const TestType scene(alpha);
        const auto steady = scene.steady(), asked_for = scene.steady(unchecked);
        auto to = steady.at_rest();
        auto workspace = steady.workspace();
        const auto refused = steady.steady(steady.at_rest(), TestType::creepage(0.5), 1, to, workspace);
        CAPTURE(alpha, name(refused.status));
        CHECK_FALSE(steady.converges());
        CHECK(refused.status == StepStatus::assists_creepage);
        CHECK(std::isnan(sum(refused.force)));
        CHECK(std::isnan(refused.slip_work));
        const auto given = asked_for.steady(steady.at_rest(), TestType::creepage(0.5), 1, to, workspace);
        CHECK(given.status != StepStatus::assists_creepage);
        CHECK(given.stick_count == refused.stick_count);
    }
    CHECK(TestType().steady().converges());
}

TEMPLATE_TEST_CASE("A model without G refuses to roll in time", "[friction]", ALL_CASES) {
    const TestType scene;
    const auto steady = scene.steady();
    auto workspace = steady.workspace();
    auto now = steady.at_rest(), next = now;
    const auto creepage = TestType::creepage(0.5);
    REQUIRE(steady.steady(now, creepage, 1, next, workspace).status == StepStatus::ok);
    now = next;
    CHECK(steady.advance(now, travel, creepage, next, workspace).status == StepStatus::invalid_step);
    CHECK(steady.shift(now, creepage, 0.1, next, workspace).status == StepStatus::invalid_step);
    CHECK(next.traction == now.traction);
    CHECK(std::isnan(steady.elastic_energy(now)));
    // under other pressures, but not on another half-length
    const ArrayX<double> half = now.normal_pressure / 2;
    auto step = steady.steady(now, creepage, 1, NormalLoad<double>{half, 1, {}}, next, workspace);
    CHECK(step.status == StepStatus::ok);
    CHECK(std::abs(sum(step.force)) < std::abs(sum(steady.force(now))));
    CHECK((next.normal_pressure == half).all());
    step = steady.steady(now, creepage, 1, NormalLoad<double>{half, 1.1, {}}, next, workspace);
    CHECK(step.status == StepStatus::needs_fixed_mesh);
}

TEST_CASE("What needs G refuses a system without it", "[friction]") {
    const Case<ConstantFriction<>, 2> scene;
    const auto along = steady_system(scene.mesh, scene.scheme, scene.kernel(false, scene.contact)),
               across = steady_system(scene.mesh, scene.scheme, scene.kernel(true, scene.contact));
    const ElementSystem both(along, across);
    using Catch::Matchers::ContainsSubstring;
    CHECK_THROWS_WITH(judge_stability(along), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(judge_stability(both), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(
        AdhesionModel<>(scene.contact, along, unchecked),
        "AdhesionModel: number of rows of G = 0 must be that of G_prime: a system without G is for steady "
        "friction alone");
    CHECK_THROWS_WITH(AdhesionModel<3>(scene.contact, both, unchecked), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(FrequencySweep<double>(along), ContainsSubstring("number of rows of G = 0"));
    CHECK_THROWS_WITH(both_directions<double>(along, across), ContainsSubstring("number of rows of G = 0"));
}

TEMPLATE_TEST_CASE("Models with the same G' share states, but no factors", "[friction]", ALL_CASES) {
    const TestType scene;
    const auto soft = scene.model(1.5), stiff = scene.model(0.5);
    REQUIRE(soft.fingerprint() == stiff.fingerprint());
    const auto creepage = TestType::creepage(0.3);
    auto used = soft.workspace(), fresh = soft.workspace();
    auto one = soft.at_rest(), other = one, again = one;
    REQUIRE(soft.advance(soft.at_rest(), travel, creepage, one, used).status == StepStatus::ok);
    const auto step = stiff.advance(one, travel, creepage, other, used);
    const auto expected = stiff.advance(one, travel, creepage, again, fresh);
    CHECK(sum(step.force) == sum(expected.force));
    CHECK(sum(step.force) != sum(soft.advance(one, travel, creepage, again, fresh).force));
}

TEMPLATE_TEST_CASE("A reset record of the solver forces a full check", "[friction]", ALL_CASES) {
    const TestType scene;
    const auto model = scene.model();
    auto workspace = model.workspace();
    auto now = model.at_rest(), next = now;
    for (int k = 0; k < 60; ++k) {
        REQUIRE(model.advance(now, travel, TestType::creepage(0.5), next, workspace).status == StepStatus::ok);
        std::swap(now, next);
    }
    const auto step = model.advance(now, travel, TestType::creepage(0.5), next, workspace);
    now.solver = {};
    auto checked_next = next;
    const auto checked = model.advance(now, travel, TestType::creepage(0.5), checked_next, workspace);
    CHECK(checked.status == StepStatus::ok);
    CHECK(checked.complementarity_residual > 0);
    CHECK(sum(checked.force) == Approx(sum(step.force)).epsilon(1e-9));
    CHECK((checked_next.traction - next.traction).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("A state of a constant coefficient is not one of a coefficient that depends on slip", "[friction]") {
    const Case<ConstantFriction<>, 1> constant;
    const Case<Falling, 1> falling;
    const auto one = constant.model();
    const auto other = falling.model();
    auto one_to = one.at_rest(), other_to = other.at_rest();
    auto one_workspace = one.workspace(), other_workspace = other.workspace();
    CHECK(one.advance(other.at_rest(), 0.1, 1e-3, one_to, one_workspace).status == StepStatus::wrong_state);
    CHECK(other.advance(one.at_rest(), travel, 1e-3, other_to, other_workspace).status == StepStatus::wrong_state);
    CHECK(one.advance(one.at_rest(), 0.1, 1e-3, one_to, other_workspace).status == StepStatus::wrong_state);
    CHECK(other.advance(other.at_rest(), travel, 1e-3, other_to, one_workspace).status == StepStatus::wrong_state);
}

}  // namespace
