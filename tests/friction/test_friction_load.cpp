// rollbem/friction/model.hpp under a varying load: against a second discretisation and closed forms, and its limits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/line.hpp>
#include <rollbem/system/detail/along_contact.hpp>

#include "scene.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace friction_tests {
namespace {

constexpr double load_nu = 0.28;

/// Creepage [-] by its ratio to the creepage of full sliding under the load `full_force`.
Creepage load_creepage(double ratio) { return {2 * (1 - load_nu) * peak * ratio}; }

/// Cylinders of E = 1 with a = 1 and p_0 = `peak` under the load `full_force`; mu = 1.
HertzLine unit_line() {
    const double compliance = 2 * (1 - load_nu * load_nu);
    return HertzLine({.load_per_width = full_force,
                      .combined_radius = std::numbers::pi / (4 * full_force * compliance),
                      .body_1 = {1, load_nu},
                      .body_2 = {1, load_nu}});
}

struct LoadScene {
    Contact contact;  // with the half-length that the mesh is made for
    Mesh<double> mesh;
    PlaneKernel<double> kernel;
    HertzLine::Load hertz;
    Collocation scheme = half;
    double mu = 1;

    static LoadScene breathing(Mesh<double> mesh, double half_width = 1000, double half_length = 1) {
        const Contact contact = contact_of(half_length, half_width);
        const HertzLine::Load hertz = HertzLine::Load::breathing(unit_line(), mesh);
        return {contact, std::move(mesh), PlaneKernel<double>::longitudinal(contact), hertz};
    }
    static LoadScene fixed(Mesh<double> mesh, double half_length = 1.25, double half_width = 1000) {
        const Contact contact = contact_of(half_length, half_width);
        const HertzLine::Load hertz = HertzLine::Load::fixed(unit_line(), mesh, half_length);
        return {contact, std::move(mesh), PlaneKernel<double>::longitudinal(contact), hertz};
    }
    static Contact contact_of(double half_length, double half_width) {
        return Contact(
            {.half_length = half_length, .half_width = half_width, .shear_modulus = 1, .poisson_ratio = load_nu});
    }

    ElementSystem<double> system() const { return rolling_system(mesh, scheme, kernel); }
    FrictionModel model(Integrator integrator = Integrator::sdirk2) const {
        return {contact, system(), unchecked, law(), integrator};
    }
    Friction law() const { return {mu, hertz.at(full_force).normal_pressure}; }
};

/// full_force (1 + 0.5 sin(2 pi q/L)).
struct SineLoad {
    double L = 8;

    double operator()(double q) const { return full_force * (1 + 0.5 * std::sin(2 * std::numbers::pi * q / L)); }
};

// -F/(mu N_0) after each of `steps` steps over the distance Q, from steady rolling at half the creepage of full slip.
std::vector<double> roll(const LoadScene& scene, const SineLoad& sine, double Q, int steps, Integrator integrator) {
    const FrictionModel model = scene.model(integrator);
    FrictionModel::Workspace workspace = model.workspace();
    FrictionState now = model.at_rest(), next = now;
    NormalLoad load = scene.hertz.at(sine(0));
    FrictionStep step = model.steady(now, {.motion = load_creepage(0.5), .load = load}, next, workspace);
    std::vector<double> forces{force_ratio(step, scene.contact)};
    bool ok = step.status == Status::ok;
    for (int k = 1; k <= steps; ++k) {
        std::swap(now, next);
        ok = scene.hertz.set(sine(Q * k / steps), load) == Status::ok && ok;
        step = model.advance(now, {Q / steps, load_creepage(0.5), load}, next, workspace);
        ok = ok && step.status == Status::ok && step.complementarity_residual < 1e-11;
        forces.push_back(force_ratio(step, scene.contact));
    }
    CHECK(ok);
    return forces;
}

// Largest difference of two series, the second `factor` times as fine.
double largest_difference(const std::vector<double>& one, const std::vector<double>& fine, std::size_t factor) {
    double largest = 0;
    for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - fine[k * factor]));
    return largest;
}

// Values on which two independent discretisations agree: b/a_0 = 1000, A = 0.5, L = 8, q = 0, 0.4, ... 8, dq -> 0.
const std::vector<double> agreed = {0.7500, 0.7618, 0.7737, 0.7851, 0.7963, 0.8066, 0.8151,
                                    0.8207, 0.8228, 0.8199, 0.8101, 0.7897, 0.7061, 0.5955,
                                    0.5245, 0.4980, 0.4937, 0.5000, 0.5129, 0.5299, 0.5494};

TEST_CASE("What particles carry is linear between the points, with the slope from behind at each", "[friction]") {
    const ArrayX<double> points{{-0.5, 0.25, 0.75}};
    const std::array<double, 3> values{2, 5, 3};
    detail::AlongContact<double> along(points, values.data(), 4);
    const auto check = [&](double x, double value, double slope) {
        const auto [found, found_slope] = along(x);
        CAPTURE(x);
        CHECK(found == Approx(value).epsilon(1e-14));
        CHECK(found_slope == Approx(slope).margin(1e-14));
    };
    check(-0.9, 2, 0);
    check(-0.5, 2, 0);
    check(-0.2, 3.2, 4);
    check(0.25, 5, 4);
    check(0.5, 4, -4);
    check(0.75, 3, -4);
    check(0.875, 3.5, 4);
    check(1, 4, 0);  // the leading edge, in front of which nothing varies
    check(1.5, 4, 0);
}

TEST_CASE("Forces on a breathing mesh converge at second order in the number of elements", "[friction][load]") {
    std::vector<double> sizes, changes;
    std::vector<std::vector<double>> series;
    for (const Eigen::Index n : {20, 40, 80, 160}) {
        series.push_back(roll(LoadScene::breathing(cosine_mesh<double>(n)), {}, 8, 80, Integrator::sdirk2));
        CAPTURE(n);
        const double error = largest_difference(agreed, series.back(), 4);
        CAPTURE(error);
        if (n == 20) CHECK(error < 3e-3);
        if (n == 40) CHECK(error < 1e-3);
        if (n >= 80) CHECK(error < 4e-4);  // dq = 0.1
        if (series.size() < 2) continue;
        sizes.push_back(static_cast<double>(n));
        changes.push_back(largest_difference(series[series.size() - 2], series.back(), 1));
    }
    const double order = support::observed_order(sizes, changes);
    CAPTURE(changes[0], changes[1], changes[2], order);
    CHECK(order > 1.6);
    CHECK(order < 2.3);
}

TEST_CASE("Forces on a fixed mesh converge to the same limit at first order", "[friction][load]") {
    std::vector<double> sizes, errors;
    for (const Eigen::Index n : {50, 100, 200, 400}) {
        const std::vector<double> forces =
            roll(LoadScene::fixed(uniform_mesh<double>(n)), {}, 8, 160, Integrator::sdirk2);
        sizes.push_back(static_cast<double>(n));
        errors.push_back(largest_difference(agreed, forces, 8));
    }
    const double order = support::observed_order(sizes, errors);
    CAPTURE(errors[0], errors[1], errors[2], errors[3], order);
    CHECK(errors[0] < 9e-3);
    CHECK(errors[1] < 4.4e-3);
    CHECK(errors[2] < 2.3e-3);
    CHECK(errors[3] < 1.2e-3);
    CHECK(order > 0.9);
    CHECK(order < 1.1);
}

TEST_CASE("Under a slowly varying load, the force follows Carter's solution", "[friction][load]") {
    std::vector<double> lengths, differences;
    for (const double L : {8.0, 40.0, 200.0, 1000.0}) {
        const SineLoad sine{.L = L};
        const int steps = 160;
        const std::vector<double> forces =
            roll(LoadScene::breathing(cosine_mesh<double>(40)), sine, L, steps, Integrator::sdirk2);
        double largest = 0;
        for (int k = 0; k <= steps; ++k) {
            const double relative = sine(L * k / steps) / full_force;  // a^2
            largest = std::max(largest, std::abs(forces[static_cast<std::size_t>(k)] -
                                                 relative * carter_force_ratio(0.5 / std::sqrt(relative))));
        }
        lengths.push_back(L);
        differences.push_back(largest);
    }
    CAPTURE(differences[0], differences[1], differences[2], differences[3]);
    CHECK(differences[0] == Approx(0.20).margin(0.01));
    CHECK(differences[1] == Approx(0.12).margin(0.01));
    CHECK(differences[2] == Approx(0.031).margin(0.002));
    CHECK(differences[3] < 0.009);
}

TEST_CASE("A contact does not grow to where the plane kernel is unstable", "[friction][load]") {
    const double b = 0.4, along = 4 * b * std::exp(load_nu / (1 - load_nu)), across = 4 * b * std::exp(-load_nu);
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(12), b);
    const ElementSystem<double> lateral =
        rolling_system(scene.mesh, scene.scheme, PlaneKernel<double>::lateral(scene.contact));
    const auto check = [&](const FrictionModel& model, double limit, const Creepage& creepage) {
        auto workspace = model.workspace();
        auto now = model.at_rest(), next = now;
        NormalLoad load = scene.hertz.at(full_force);
        const auto advance = [&](double half_length) {
            load.half_length = half_length;
            return model.advance(now, {0.1, creepage, load}, next, workspace).status;
        };
        while (now.half_length < limit - 0.1) {
            REQUIRE(advance(now.half_length + 0.05) == Status::ok);
            std::swap(now, next);
        }
        CHECK(advance(limit * (1 - 1e-12)) == Status::ok);
        CHECK(advance(limit * (1 + 1e-12)) == Status::needs_fixed_mesh);
    };
    check(FrictionModel(scene.contact, scene.system(), unchecked, scene.law()), along, {1e-4});
    check(FrictionModel(scene.contact, ElementSystem<double, 2>(scene.system(), lateral), unchecked, scene.law()),
          across, {1e-4, 1e-4});
}

}  // namespace
}  // namespace friction_tests
