// rollbem/rollbem.hpp: numbers that are none (denormal, next to nothing, beyond all sizes, infinite, NaN) in all
// entries of the time domain and of tables: a status, a refusal, or the right number.
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace negligible_tests {
namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring, Catch::Matchers::WithinRel;

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
constexpr double least = std::numeric_limits<double>::denorm_min();

/// What an entry is called with: one of them is replaced in turn.
struct Input {
    double a = 6e-3, b = 5e-3, G = 8e10, xi = 1e-3, eta = 5e-4, phi = 0.2, dq = 1e-3, mu = 0.3, N = 8e4, V = 20,
           fall = 0.2;

    Creepage creepage() const { return {xi, eta, phi}; }
};
struct Name {
    const char* name;
    double Input::*of;
};
constexpr Name inputs[] = {{"a", &Input::a},     {"b", &Input::b},     {"G", &Input::G},      {"xi", &Input::xi},
                           {"eta", &Input::eta}, {"phi", &Input::phi}, {"dq", &Input::dq},    {"mu", &Input::mu},
                           {"N", &Input::N},     {"V", &Input::V},     {"fall", &Input::fall}};

struct Outcome {
    std::string status;
    std::vector<double> numbers;

    void add(double number) { numbers.push_back(number); }
    void add(const TangentialForce& of) {
        for (const double number : {of.longitudinal, of.lateral, of.moment}) add(number);
    }
    void add(const TangentialForce::ByCreepage& of) {
        for (const auto& by : {of.by_longitudinal, of.by_lateral, of.by_spin}) add(by);
    }
};
template <class Step>
Outcome outcome(const Step& step) {
    Outcome result{name(step.status), {}};
    result.add(step.force);
    result.add(step.tangent);
    return result;
}
// Of a model of one direction the numbers that it has.
Outcome along(Outcome both) { return {both.status, {both.numbers[0], both.numbers[3]}}; }

const Mesh<double> mesh = cosine_mesh(6);

Contact line(const Input& in) { return Contact({in.a, in.b, in.G, 0.28}); }
PatchContact patch(const Input& in) { return PatchContact({in.a, in.b, in.G, 0.28}); }
ElementSystem<double> line_system(const Input& in) {
    return rolling_system(mesh, Collocation{}, StripKernel<double>::longitudinal(line(in)));
}

AdhesionModel<> adhesion(const Input& in) { return {line(in), line_system(in), unchecked}; }
FrictionModel friction(const Input& in) {
    return {line(in), line_system(in), unchecked, {in.mu, in.N / (in.a * in.b) * mean_hertz_pressure(mesh)}};
}
using PatchModel = FrictionModel;
PatchModel patch_friction(const Input& in) {
    const PatchContact contact = patch(in);
    const PatchMesh<double> strips = patch_mesh(contact, 3, 3);
    return {contact,
            rolling_system(strips, Collocation{}, HalfSpace<double>(0.28)),
            unchecked,
            {in.mu, hertz_pressures(contact, strips, in.N)}};
}

template <class Model, class Value>
Outcome two_steps(const Model& model, double dq, const Value& creepage) {
    Run run(model);
    run.advance({dq, creepage});
    return outcome(run.advance({dq, creepage}));
}
template <class Model, class Value>
Outcome settled(const Model& model, const Value& creepage) {
    Run run(model);
    return outcome(run.steady({.motion = creepage}));
}

const CreepForceTable& steel() {
    static const CreepForceTable table = CreepForceTable::read(ROLLBEM_STEEL_CREEP);
    return table;
}
ReducedFriction::Force reduced(const Input& in) {
    const ReducedFriction friction(
        {.adhesion_factor = 0.3, .slip_factor = 0.1, .friction_ratio = 0.4, .fall = in.fall});
    return friction.look_up(steel(), patch(in), in.mu, in.N, in.V, in.creepage());
}

struct Entry {
    std::string name;
    std::function<Outcome(const Input&)> call;
};
const std::vector<Entry> entries{
    {"steps in adhesion", [](const Input& in) { return two_steps(adhesion(in), in.dq, in.xi); }},
    {"steady adhesion", [](const Input& in) { return settled(adhesion(in), in.xi); }},
    {"steps with friction", [](const Input& in) { return along(two_steps(friction(in), in.dq, Creepage{in.xi})); }},
    {"steady friction", [](const Input& in) { return along(settled(friction(in), Creepage{in.xi})); }},
    {"steps of a patch", [](const Input& in) { return two_steps(patch_friction(in), in.dq, in.creepage()); }},
    {"a patch", [](const Input& in) { return settled(patch_friction(in), in.creepage()); }},
    {"a table", [](const Input& in) { return outcome(steel().look_up(patch(in), in.mu, in.N, in.creepage())); }},
    {"reduced friction", [](const Input& in) {
         const ReducedFriction::Force now = reduced(in);
         Outcome result = outcome(now);
         for (const auto& of : {now.tangent_by_load, now.tangent_by_friction_coefficient, now.tangent_by_half_length,
                                now.tangent_by_half_width, now.tangent_by_speed}) {
             result.add(of);
         }
         return result;
     }}};

}  // namespace

TEST_CASE("No entry calls numbers ok that are not finite", "[negligible]") {
    constexpr double largest = std::numeric_limits<double>::max();
    for (const Entry& entry : entries) {
        for (const Input& base : {Input{}, Input{.xi = 0, .eta = 0, .phi = 0}}) {
            REQUIRE(entry.call(base).status == "ok");
            for (const auto& [input, of] : inputs) {
                for (const double value : {least, 1e-310, 1e-305, 1e-160, 1e160, 1e300, largest, infinite, nan}) {
                    Input in = base;
                    in.*of = value;
                    Outcome found;
                    if (!refusal([&] { found = entry.call(in); }).empty() || found.status != "ok") continue;
                    INFO(entry.name << ": " << input << " = " << value);
                    CHECK(Eigen::Map<const Eigen::ArrayXd>(found.numbers.data(), Eigen::Index(found.numbers.size()))
                              .isFinite()
                              .all());
                }
            }
        }
    }
}

TEST_CASE("Creepages next to nothing have the tangent of rest", "[negligible]") {
    const Input rest{.xi = 0, .eta = 0, .phi = 0};
    for (const Entry& entry : entries) {
        const std::vector<double> expected = entry.call(rest).numbers;
        for (const double size : {least, 1e-320, 1e-310, 1e-305, 1e-295, 1e-200}) {
            for (double Input::*of : {&Input::xi, &Input::eta, &Input::phi}) {
                Input in = rest;
                in.*of = size;
                const Outcome found = entry.call(in);
                INFO(entry.name << ", " << size);
                REQUIRE(found.status == "ok");
                double error = 0;
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    const double scale = std::abs(expected[i]) + 1e-100;
                    error = std::max(error, std::abs(found.numbers[i] - expected[i]) / scale);
                }
                CHECK(error < 1e-9);
            }
        }
    }
}

TEST_CASE("A distance next to nothing is no step", "[negligible]") {
    for (const double dq : {least, 1e-320, 1e-310, 1e-295}) {
        for (const Entry& entry : entries) {
            if (entry.name.find("steps") == std::string::npos) continue;
            INFO(entry.name << ", " << dq);
            CHECK(entry.call({.dq = dq}).status == "invalid_step");
        }
        // a rigid shift is that without rolling
        const PatchModel model = patch_friction({});
        const Creepage moved{1e-6, 5e-7, 1e-4};
        Run rolling(model), resting(model);
        const FrictionStep step = rolling.advance({dq, PatchModel::Motion::shift(moved)});
        CHECK(step.status == Status::ok);
        CHECK_THAT(step.force.lateral,
                   WithinRel(resting.advance({0, decltype(resting)::Model::Motion::shift(moved)}).force.lateral, 1e-9));
    }
}

TEST_CASE("A patch rolls on without creepage until nothing is left", "[negligible]") {
    const PatchModel model = patch_friction({});
    Run run(model);
    REQUIRE(run.advance({1e-3, Input{}.creepage()}).status == Status::ok);
    int steps = 0;
    while (steps < 5000 && !run.now().traction.isZero(0)) {
        const FrictionStep step = run.advance({6e-3, Creepage{}});
        ++steps;
        REQUIRE(step.status == Status::ok);
        REQUIRE(std::isfinite(step.tangent.by_longitudinal.longitudinal));
    }
    CHECK(steps > 100);
    CHECK(steps < 5000);
}

TEST_CASE("Friction next to nothing is none", "[negligible]") {
    for (const double mu : {1e-320, 1e-305, 1e-200, 1e-160}) {
        for (const double creepage : {1e-3, 3e-3 * mu}) {
            const Outcome found = settled(patch_friction({.mu = mu}), Creepage{creepage, creepage / 2, 0});
            INFO(mu << ", " << creepage);
            CHECK(found.status == "ok");
            CHECK(found.numbers == std::vector<double>(12, 0.0));
        }
    }
}

TEST_CASE("A wheel under a load next to nothing is lifted, and one beyond all sizes is refused", "[negligible]") {
    const ContactTable wheel = ContactTable::read(ROLLBEM_S1002_CONTACT);
    for (const double lateral : {0.0, 4.5e-3}) {  // one point, and two that share the load
        const auto under = [&](double load) {
            return wheel.look_up(steel(), WheelsetSide::right, {.lateral = lateral},
                                 {.forward = 20, .pitch_rate = -20 / 0.46}, load, 0.3);
        };
        REQUIRE(under(1e5).status == Status::ok);
        for (const double load : {0.0, least, 1e-310, 1e-290, 1e-101}) {
            INFO(lateral << ", " << load);
            CHECK(under(load).status == Status::ok);
            CHECK(under(load).force.isZero(0));
        }
        for (const double load : {1e151, 1e300}) CHECK(under(load).status == Status::invalid_load);
    }
}

TEST_CASE("Elastic energy is proportional to the modulus at any size", "[negligible]") {
    const auto energy = [](double unit) {
        const FrictionModel model = friction({.G = 8e10 * unit, .N = 8e4 * unit});
        Run run(model);
        run.steady({.motion = Creepage{1e-3}});
        return model.elastic_energy(run.now());
    };
    const double expected = energy(1);
    for (const double unit : {1e-250, 1e-30, 1e30, 1e150}) CHECK_THAT(energy(unit) / unit, WithinRel(expected, 1e-12));
}

TEST_CASE("Sizes next to nothing or beyond all are refused", "[negligible]") {
    for (const double a : {1e-120, 1e60}) CHECK(refusal([&] { line({.a = a, .b = 10 * a}); }).empty());
    for (const double a : {least, 1e-121, 1e61, 1e300}) {
        CHECK_THAT(refusal([&] { patch({.a = a}); }), ContainsSubstring("PatchContact: half_length = "));
    }
    for (const double tiny : {least, 1e-310, 1e-293}) {
        CHECK_THAT(refusal([&] { patch({.b = tiny}); }), ContainsSubstring("must be positive and finite, and not"));
        CHECK_THAT(refusal([&] { line({.G = tiny}); }), ContainsSubstring("must be positive and finite, and not"));
        CHECK_THAT(refusal([&] {
                       HertzEllipse({tiny, {0.46, infinite}, {infinite, 0.3}, 0, {2e11, 0.28}, {2e11, 0.28}});
                   }),
                   ContainsSubstring("HertzEllipse: load = "));
    }
}

TEST_CASE("Eigenvalues next to nothing end the search for a proof", "[negligible][stability]") {
    // beside -1 rounding hides the sign of -1e-40, and the trapezoidal rule turns both into -1 and 1
    for (const double slow : {1e-40, 1e-30, 1e-17}) {
        MatrixX<double> G = MatrixX<double>::Identity(2, 2), G_prime = -G;
        G_prime(1, 1) = -slow;
        const StabilityVerdict verdict = judge_stability(RollingSystem<double>(G, G_prime, ArrayX<double>::Ones(2)));
        CHECK(verdict.status == Status::ok);
        CHECK(verdict.uncertain_count == 1);
        CHECK_FALSE(verdict.stable());
        CHECK(judge_stability(RollingSystem<double>(G, 1e-300 * G_prime, ArrayX<double>::Ones(2))).status ==
              Status::ill_conditioned);
    }
}

}  // namespace negligible_tests
