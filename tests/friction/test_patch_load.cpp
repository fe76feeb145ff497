// Contact patches whose load, size and shape vary in the time domain: on a fixed mesh
// (rollbem/normal/hertz.hpp), and on a mesh that follows the ellipse (rollbem/assembly/patch_system.hpp),
// with friction and in full adhesion.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>

#include "friction/same_bits.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace patch_load_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr NodeDifference chebyshev{Nodes::chebyshev};
constexpr double mu = 0.3, nu = 0.28, G = 8e10, a_0 = 5e-3, N_0 = 8e4;
const HalfSpace<double> kernel(nu);
using Forces = Eigen::ArrayX3d;  // -F_x, -F_y over mu N_0 and -M_z over mu N_0 c, a row for each place
using Model = FrictionModel;
using State = FrictionState;

const PatchShapes<double>& shapes() {
    static const PatchShapes<double> made(6, 6, chebyshev, kernel, {.least = 0.4, .largest = 2.5, .factor = 1.25});
    return made;
}

double mean_difference(const Forces& one, const Forces& other) { return std::sqrt((one - other).square().mean()); }
double largest_difference(const Forces& one, const Forces& other) { return (one - other).abs().maxCoeff(); }

/// An ellipse with a = a_0 under N_0 that breathes, N = N_0 (1 + 0.5 sin(2 pi q/8)), q in a_0; creepages that mu N_0
/// would cause without slip.
struct Scene {
    PatchContact contact;
    PatchMesh<double> mesh;
    double c;
    Creepage creepage;

    Scene(double a_over_b, Eigen::Index n)
        : contact({.half_length = a_0, .half_width = a_0 / a_over_b, .shear_modulus = G, .poisson_ratio = nu}),
          mesh(patch_mesh(contact, n, n)),
          c(contact.c()) {
        const double unit = mu * N_0 / (G * c * c);
        creepage = {0.1422475 * unit, 0.1081081 * unit, 0.2022927 * unit / c};
    }

    ArrayX<double> pressure() const { return hertz_pressures(contact, mesh, N_0); }
    Model model(const ElementSystem<double, 2>& system, Integrator integrator, double coefficient = mu) const {
        return {contact, system, unchecked, {coefficient, pressure()}, integrator};
    }
    ElementSystem<double, 2> breathing() const { return breathing_system(contact, mesh, chebyshev, kernel); }
    static double load(double q) { return N_0 * (1 + 0.5 * std::sin(std::numbers::pi / 4 * q)); }

    Forces ratios(const TangentialForce& force) const {
        const double unit = -mu * N_0;
        return Forces{{force.longitudinal / unit, force.lateral / unit, force.moment / unit / c}};
    }

    /// Forces at q = `every`, 2 `every`, ... 8, from rest in steps of dq, under load_at(a/a_0).
    /// `alone`: slip is turned by the angles of each step alone.
    template <class OfModel, class LoadAt>
    Forces roll(const OfModel& model, const LoadAt& load_at, double dq, double every, bool alone = false) const {
        Run run(model);
        Forces result(std::lround(8 / every), 3);
        for (int k = 1; k <= std::lround(8 / dq); ++k) {
            if constexpr (requires { run.now().unrotated_traction; }) {
                if (alone) run.now().unrotated_traction.resize(0, 2);
            }
            const auto load = load_at(std::cbrt(Scene::load(k * dq) / N_0));
            const auto step = run.advance({dq * a_0, creepage, load});
            REQUIRE(step.status == Status::ok);
            if (k % std::lround(every / dq) == 0) result.row(k / std::lround(every / dq) - 1) = ratios(step.force);
        }
        return result;
    }
    Forces friction(const Model& model, double dq, double every = 0.4, bool alone = false) const {
        const auto load_at = [&](double size) {
            return NormalLoad{size * model.at_rest().normal_pressure, size * a_0, {}, size * contact.half_width()};
        };
        return roll(model, load_at, dq, every, alone);
    }
    Forces adhesion(const AdhesionModel<2>& model, double dq) const {
        const auto load_at = [&](double size) { return SemiAxes{size * a_0, size * contact.half_width()}; };
        return roll(model, load_at, dq, 0.4);
    }
};

HertzEllipse ellipse(double load, double lateral = 0.3) {
    const ElasticBody steel{.young_modulus = 2 * G * (1 + nu), .poisson_ratio = nu};
    return HertzEllipse({.load = load,
                         .radii_1 = {.rolling = 0.46, .lateral = INFINITY},
                         .radii_2 = {.rolling = INFINITY, .lateral = lateral},
                         .body_1 = steel,
                         .body_2 = steel});
}

}  // namespace

TEST_CASE("Creepages stand in braces in every step, with a load and without", "[friction][load]") {
    const Scene scene(1, 3);
    const auto [xi, eta, phi] = scene.creepage;
    const Model model = scene.model(rolling_system(scene.mesh, chebyshev, kernel), Integrator::sdirk2);
    const NormalLoad load{model.at_rest().normal_pressure, scene.contact.half_length(), {}, 0};
    const double dq = 0.1 * a_0;
    Run named(model), braced(model), tried(model);
    const Model::Step step = named.advance({dq, scene.creepage, load});
    REQUIRE(step.status == Status::ok);
    const auto same = [&](const TangentialForce& force) { CHECK(force.lateral == step.force.lateral); };
    same(braced.advance({dq, {{xi, eta, phi}}, load}).force);
    same(tried.try_advance({dq, {{.longitudinal = xi, .lateral = eta, .spin = phi}}, load}).force);
    same(Run(model, model.at_rest()).advance({dq, {{xi, eta, phi}}}).force);
    auto workspace = model.workspace();
    auto to = model.at_rest();
    same(model.advance(model.at_rest(), {dq, {{xi, eta, phi}}}, to, workspace).force);
    same(model.advance(model.at_rest(), {dq, {xi, eta, phi}, load}, to, workspace).force);
    same(Run(model).advance({{dq, 1}, {xi, eta, phi}, load}).force);
    CHECK(Run(model).steady({Travel::at_speed(1.0), {xi, eta, phi}}).force.lateral ==
          Run(model).steady({.motion = {xi, eta, phi}}).force.lateral);
    const AdhesionModel<2> adhesion(scene.contact, rolling_system(scene.mesh, chebyshev, kernel), unchecked);
    CHECK(Run(adhesion).advance({dq, {{xi, eta, phi}}}).force.lateral ==
          Run(adhesion).advance({dq, scene.creepage}).force.lateral);
}

TEST_CASE("patch_load: forces of an ellipse that breathes") {
    // of another program, at q = 2, 4, 6, 8, by implicit Euler with dq = 0.05
    const auto error = [](double a_over_b, Eigen::Index n, const Forces& expected) {
        const Scene scene(a_over_b, n);
        const Model model = scene.model(scene.breathing(), Integrator::implicit_euler);
        return largest_difference(scene.friction(model, 0.05, 2, true), expected);
    };
    CHECK(error(1, 8, {{.4409, .6107, .2570}, {.4400, .6564, .1077}, {.2678, .3474, .0293}, {.3758, .4605, .0869}}) <
          1.6e-4);
    CHECK(error(0.5, 12, {{.3438, .4011, .4070}, {.3692, .4798, .2228}, {.2443, .2887, .0611}, {.3232, .3445, .1714}}) <
          1.6e-4);
}

TEST_CASE("patch_load: breathing is of second order in dq by sdirk2, of first by implicit Euler") {
    const Scene scene(1, 6);
    const auto system = scene.breathing();
    const auto order = [&](const auto& run, std::vector<double> steps) {
        std::vector<double> errors;
        const auto fine = run(0.0125);
        for (const double dq : steps) errors.push_back(mean_difference(run(dq), fine));
        UNSCOPED_INFO("errors " << Catch::StringMaker<std::vector<double>>::convert(errors));
        for (double& dq : steps) dq = 1 / dq;
        return support::observed_order(steps, errors);
    };
    for (const bool second : {false, true}) {
        const Integrator integrator = second ? Integrator::sdirk2 : Integrator::implicit_euler;
        const Model rolling = scene.model(system, integrator);
        const AdhesionModel<2> sticking(scene.contact, system, unchecked, integrator);
        const std::vector<double> steps = second ? std::vector{0.4, 0.2, 0.1, 0.05} : std::vector{0.2, 0.1, 0.05};
        const double with_friction = order([&](double dq) { return scene.friction(rolling, dq); }, steps);
        const double without = order([&](double dq) { return scene.adhesion(sticking, dq); }, steps);
        CAPTURE(second, with_friction, without);
        // irregular, as on a line: 36 elements change between stick and slip one by one
        CHECK(with_friction > (second ? 1.3 : 0.9));
        CHECK(with_friction < (second ? 2.6 : 1.3));
        CHECK(without > (second ? 1.8 : 0.9));
        CHECK(without < (second ? 2.3 : 1.3));
    }
}

TEST_CASE("patch_load: without slip friction is full adhesion, while size and shape vary, with all tangents") {
    const Scene scene(1, 6);
    for (const bool single : {true, false}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            CAPTURE(single, name(integrator));
            const auto system = single ? scene.breathing() : shapes().system(1);
            const Model rolling = scene.model(system, integrator, 1e6);
            const AdhesionModel<2> sticking(scene.contact, system, unchecked, integrator);
            Run run(rolling);
            Run unbound(sticking);
            const ArrayX<double> pressure = run.now().normal_pressure;
            NormalLoad load{pressure, a_0, pressure, a_0};
            double a = a_0, b = a_0;
            for (int k = 0; k < 5; ++k) {
                a += 0.07 * a_0;
                b = single ? a : b - 0.03 * a_0;
                load.half_length = a;
                load.half_width = b;
                const double dq = (0.1 + 0.05 * k) * a_0;
                const auto motion = RigidMotion<Creepage>::linear(scene.creepage, {1e-4, -2e-4, 0.5});
                const auto step = run.advance({dq, motion, load});
                const auto expected = unbound.advance({dq, motion, SemiAxes{a, b}});
                REQUIRE(step.status == Status::ok);
                REQUIRE(expected.status == Status::ok);
                REQUIRE(step.stick_count == rolling.size());
                const auto same = [&](const TangentialForce& one, const TangentialForce& two) {
                    const double scale =
                        std::abs(two.longitudinal) + std::abs(two.lateral) + std::abs(two.moment) / a_0;
                    CHECK(one.longitudinal == Approx(two.longitudinal).margin(1e-10 * scale));
                    CHECK(one.lateral == Approx(two.lateral).margin(1e-10 * scale));
                    CHECK(one.moment == Approx(two.moment).margin(1e-10 * scale * a_0));
                };
                same(step.force, expected.force);
                same(rolling.force(run.now()), step.force);
                same(sticking.force(unbound.now()), step.force);
                same(step.tangent.by_longitudinal, expected.tangent.by_longitudinal);
                same(step.tangent.by_lateral, expected.tangent.by_lateral);
                same(step.tangent.by_spin, expected.tangent.by_spin);
                same(step.tangent_by_half_length, expected.tangent_by_half_length);
                same(step.tangent_by_half_width, expected.tangent_by_half_width);
            }
        }
    }
}

TEST_CASE("patch_load: what rests under a load of another shape rolls as under that load") {
    const Scene scene(1, 6);
    const Model model = scene.model(shapes().system(1), Integrator::sdirk2);
    const State under_own = model.at_rest();
    const NormalLoad load{0.8 * under_own.normal_pressure, 1.2 * a_0, {}, 0.7 * a_0};
    const State rest = model.at_rest(load);
    CHECK(rest.half_length == load.half_length);
    CHECK(rest.half_width == load.half_width);
    auto workspace = model.workspace();
    State to = rest, expected = rest;
    const auto steady = model.steady(rest, {.motion = scene.creepage}, to, workspace);
    REQUIRE(steady.status == Status::ok);
    CHECK(same_bits::same(steady,
                          model.steady(under_own, {.motion = scene.creepage, .load = load}, expected, workspace)));
    CHECK(same_bits::same(to, expected));
    // of another half-length the half-width must be given
    CHECK_THROWS_WITH(model.at_rest({load.normal_pressure, load.half_length, {}, 0}),
                      ContainsSubstring("invalid_load"));
}

TEST_CASE("patch_load: work becomes heat or elastic energy while size and shape vary") {
    for (const Eigen::Index n : {6, 9}) {
        const Scene scene(1, n);
        const PatchShapes<double> made(n, n, chebyshev, kernel, {.least = 0.4, .largest = 2.5, .factor = 1.4});
        const Model model = scene.model(made.system(1), Integrator::sdirk2);
        Run run(model);
        NormalLoad load{run.now().normal_pressure, a_0, {}, a_0};
        double work = 0, heat = 0;
        TangentialForce before{0, 0, 0};
        constexpr double dq = 0.1;
        for (int k = 1; k <= 30; ++k) {
            load.half_length = a_0 * (1 + 0.4 * std::sin(0.9 * dq * k));
            load.half_width = a_0 * (1 - 0.3 * std::sin(0.7 * dq * k));
            const auto step = run.advance({dq * a_0, scene.creepage, load});
            REQUIRE(step.status == Status::ok);
            heat += step.slip_work;
            const auto power = [&](const TangentialForce& force) {
                return -(scene.creepage.longitudinal * force.longitudinal + scene.creepage.lateral * force.lateral +
                         scene.creepage.spin * force.moment);
            };
            work += dq * a_0 * (power(before) + power(step.force)) / 2;
            before = step.force;
        }
        const double elastic = model.elastic_energy(run.now());
        CHECK(elastic > 0.05 * work);
        // of either sign, by the elements
        CHECK(std::abs(heat + elastic - work) < 4e-3 * work);
    }
}

TEST_CASE("patch_load: shapes between the nodes") {
    const double a_over_b = 1.37;  // between two nodes
    const Scene scene(a_over_b, 6);
    const auto direct = rolling_system(scene.mesh, chebyshev, kernel), between = shapes().system(a_over_b);
    for (const auto& [d, e] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
        CAPTURE(d, e);
        const auto i = static_cast<std::size_t>(d), j = static_cast<std::size_t>(e);
        CHECK((direct.G(i, j) - between.G(i, j)).norm() < 6e-6 * direct.G(0, 0).norm());
        CHECK((direct.G_prime(i, j) - between.G_prime(i, j)).norm() < 6e-6 * direct.G_prime(0, 0).norm());
    }
    CHECK((direct.elements().areas - between.elements().areas).abs().maxCoeff() < 1e-15);

    // creep coefficients of any shape from the model of one
    const Scene circle(1, 6);
    const AdhesionModel<2> model(circle.contact, shapes().system(1), judge_stability(shapes()));
    Run run(model);
    run.now().half_length = 0.9 * a_0;
    run.now().half_width = 0.9 * a_0 / a_over_b;
    const auto step = run.steady({.motion = {1e-3, 0, 0}});
    REQUIRE(step.status == Status::ok);
    const auto expected = creep_coefficients(scene.contact, solve_steady(scene.contact, scene.mesh, chebyshev, kernel));
    const double c = 0.9 * scene.c, unit = -G * c * c;
    CHECK(step.tangent.by_longitudinal.longitudinal / unit == Approx(expected.c11).epsilon(2e-5));
    CHECK(step.tangent.by_lateral.lateral / unit == Approx(expected.c22).epsilon(2e-5));
    CHECK(step.tangent.by_spin.lateral / unit / c == Approx(expected.c23).epsilon(2e-5));
    CHECK(step.tangent.by_spin.moment / unit / c / c == Approx(expected.c33).epsilon(2e-5));
    CHECK(step.force.longitudinal == Approx(1e-3 * step.tangent.by_longitudinal.longitudinal));

    // and steady friction, of another size too
    const Model rolling = circle.model(shapes().system(1), Integrator::sdirk2);
    const PatchContact small({.half_length = 0.9 * a_0,
                              .half_width = 0.9 * scene.contact.half_width(),
                              .shear_modulus = G,
                              .poisson_ratio = nu});
    const FrictionModel own(small, steady_system(scene.mesh, chebyshev, kernel), {mu, scene.pressure()});
    const NormalLoad load{scene.pressure(), small.half_length(), {}, small.half_width()};
    const auto given = Run(rolling).steady({.motion = scene.creepage, .load = load});
    REQUIRE(given.status == Status::ok);
    CHECK(largest_difference(scene.ratios(given.force),
                             scene.ratios(Run(own).steady({.motion = scene.creepage}).force)) < 3e-5);

    // a system of many shapes that keeps its shape equals a system of one
    const auto shaped = circle.friction(rolling, 0.4);
    CHECK(largest_difference(shaped, circle.friction(circle.model(circle.breathing(), Integrator::sdirk2), 0.4)) <
          1e-4);
    CHECK_THROWS_WITH(shapes().system(3), ContainsSubstring("a_over_b = 3 must lie in the range"));
    CHECK_THROWS_WITH(PatchShapes<double>(4, 4, chebyshev, kernel, {.least = 1, .largest = 1}),
                      ContainsSubstring("largest a/b"));
}

TEST_CASE("patch_load: what a mesh cannot follow has a status") {
    const Scene scene(1, 6);
    const Model fixed = scene.model(rolling_system(scene.mesh, chebyshev, kernel), Integrator::sdirk2),
                single = scene.model(scene.breathing(), Integrator::sdirk2),
                many = scene.model(shapes().system(1), Integrator::sdirk2);
    const AdhesionModel<2> adhesion(scene.contact, shapes().system(1), unchecked);
    const auto status = [&](const Model& model, double a, double b, double dq = 0.1, double start_b = 1) {
        auto workspace = model.workspace();
        auto from = model.at_rest(), to = from;
        from.half_width *= start_b;
        const NormalLoad load{from.normal_pressure, a * a_0, {}, b * a_0};
        const Status result = model.advance(from, {dq * a_0, scene.creepage, load}, to, workspace).status;
        if (&model == &many && b > 0 && start_b > 0) {
            auto other = adhesion.workspace();
            auto begin = adhesion.at_rest(), end = begin;
            begin.half_width *= start_b;
            CHECK(adhesion.advance(begin, {dq * a_0, scene.creepage, SemiAxes{a * a_0, b * a_0}}, end, other).status ==
                  result);
        }
        return result;
    };
    for (const Model* model : {&fixed, &single, &many}) {
        CHECK(status(*model, 1, 1) == Status::ok);
        CHECK(status(*model, 1, 0) == Status::ok);               // b stays the state's
        CHECK(status(*model, 1.05, 0) == Status::invalid_load);  // either of b and a/b might stay
        CHECK(status(*model, 1, 1, 0.1, NAN) == Status::invalid_load);
        CHECK(status(*model, 1, 1, 0.1, 0) == Status::invalid_load);
    }
    CHECK(status(fixed, 1.05, 1.05) == Status::needs_fixed_mesh);
    CHECK(status(fixed, 1, 1.05) == Status::needs_fixed_mesh);
    CHECK(status(single, 1.05, 1.05) == Status::ok);
    CHECK(status(single, 1, 1.05) == Status::needs_fixed_mesh);
    CHECK(status(single, 1.1, 1.1, 0.099) == Status::needs_fixed_mesh);
    CHECK(status(single, 0.9, 0.9, 0.099) == Status::needs_fixed_mesh);
    CHECK(status(many, 1, 1.05) == Status::ok);
    CHECK(status(many, 1, 2.4) == Status::ok);
    CHECK(status(many, 1, 2.6) == Status::needs_fixed_mesh);
    CHECK(status(many, 1, 1, 0.1, 3) == Status::needs_fixed_mesh);

    // a line has the half-width of the contact
    const Contact contact({.half_length = a_0, .half_width = 2e-3, .shear_modulus = G, .poisson_ratio = nu});
    const FrictionModel line(
        contact, rolling_system(cosine_mesh<double>(4), chebyshev, StripKernel<double>::longitudinal(contact)),
        unchecked, {mu, ArrayX<double>::Ones(4)});
    Run run(line);
    run.now().half_width = 0;  // not read
    for (const double b : {0.0, 2e-3, 3e-3}) {
        const NormalLoad load{run.now().normal_pressure, a_0, {}, b};
        CHECK(run.advance({1e-4, Creepage{1e-3}, load}).status == (b == 3e-3 ? Status::needs_fixed_mesh : Status::ok));
    }
    CHECK(run.now().half_width == 2e-3);
}

TEST_CASE("patch_load: Hertz's load on a mesh that follows it and on a fixed one") {
    const HertzEllipse largest = ellipse(1.5 * N_0);
    const PatchContact contact = largest.contact();
    const PatchMesh<double> mesh = patch_mesh(contact, 7, 8);
    const ArrayX<double> areas = patch_elements(mesh, chebyshev).areas;  // in a^2
    using Hertz = HertzEllipse::Load;
    for (const Hertz& hertz : {Hertz::breathing(largest, contact, mesh), Hertz::fixed(largest, contact, mesh)}) {
        CAPTURE(hertz.breathes());
        NormalLoad load = hertz.at(N_0);
        for (const double N : {1e-3 * N_0, 0.7 * N_0, 1.5 * N_0}) {
            CAPTURE(N / N_0);
            const bool resolved = hertz.breathes() || N > 0.1 * N_0;
            REQUIRE(hertz.set(N, load) == (resolved ? Status::ok : Status::unresolved));
            const double area =
                hertz.breathes() ? load.half_length * load.half_width / contact.half_width() : contact.half_length();
            CHECK((areas * load.normal_pressure).sum() * area * contact.half_length() == Approx(N).epsilon(1e-13));
        }
        CHECK(load.half_length == largest.half_length());
        CHECK(load.half_width == largest.half_width());
        if (!hertz.breathes()) {
            CHECK(hertz.set(0, load) == Status::ok);
            CHECK(load.normal_pressure.maxCoeff() == 0);
            CHECK((load.pressure_rate * areas).sum() * contact.half_length() * contact.half_length() ==
                  Approx(1).epsilon(1e-12));
            CHECK((load.pressure_rate > 0).count() == 2);  // the middle lies on an edge between two elements
        }
        // other radii: the ellipse of the moment
        const HertzEllipse other = ellipse(0.5 * N_0, 0.2);
        REQUIRE(hertz.set(other, load) == Status::ok);
        CHECK(load.half_length == (hertz.breathes() ? other : largest).half_length());
        CHECK(load.half_width == (hertz.breathes() ? other : largest).half_width());
        const double area = load.half_length * load.half_width / contact.half_width() * contact.half_length();
        CHECK((areas * load.normal_pressure).sum() * area == Approx(0.5 * N_0).epsilon(1e-13));
    }
    CHECK_THROWS_WITH(Hertz::fixed(largest, contact, mesh).at(1.6 * N_0),
                      ContainsSubstring("a contact that the mesh covers"));
}

TEST_CASE("patch_load: a fixed mesh resolves no ellipse shorter than three elements or narrower than three strips") {
    const HertzEllipse largest = ellipse(N_0);
    const PatchContact contact = largest.contact();
    for (const auto& [along, across] : {std::pair(5, 1), {9, 4}, {4, 7}, {20, 3}}) {
        CAPTURE(along, across);
        const PatchMesh<double> mesh = patch_mesh(contact, uniform_mesh(along), uniform_mesh(across));
        const double part = std::min(3.0 / std::min(along, std::max(across, 3)), 1.0);  // both axes shrink alike
        const auto hertz = HertzEllipse::Load::fixed(largest, contact, mesh);
        NormalLoad load = hertz.at(N_0);
        CHECK(hertz.set(N_0, load) == Status::ok);
        CHECK(hertz.set(0, load) == Status::ok);
        CHECK(load.check(mesh.size()) == Status::ok);
        CHECK(hertz.set(1.001 * part * part * part * N_0, load) == (part < 1 ? Status::ok : Status::invalid_load));
        CHECK(hertz.set(0.999 * part * part * part * N_0, load) == Status::unresolved);
        CHECK(load.check(mesh.size()) == Status::ok);
    }
}

}  // namespace patch_load_tests
