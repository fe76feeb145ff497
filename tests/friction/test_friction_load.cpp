// rollbem/friction/model.hpp under a varying load: against a second discretisation and closed forms, and its limits.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

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
    HertzLine::Load hertz;
    PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(contact);

    static LoadScene breathing(Mesh<double> mesh, double half_width = 1000) {
        return {contact_of(1, half_width), mesh, HertzLine::Load::breathing(unit_line(), mesh)};
    }
    static LoadScene fixed(Mesh<double> mesh) {
        return {contact_of(1.25, 1000), mesh, HertzLine::Load::fixed(unit_line(), mesh, 1.25)};
    }
    static Contact contact_of(double half_length, double half_width) {
        return Contact(
            {.half_length = half_length, .half_width = half_width, .shear_modulus = 1, .poisson_ratio = load_nu});
    }

    ElementSystem<double> system() const { return rolling_system(mesh, half, kernel); }
    Friction law() const { return {1, hertz.at(full_force).normal_pressure}; }
};

// -F/(mu N_0) at 21 places of a way of 8 in so many steps, from steady rolling at half the creepage of full slip, under
// the load N_0 (1 + 0.5 sin(2 pi q/8)).
std::vector<double> roll(const LoadScene& scene, int steps) {
    const auto load_after = [&](int k) { return full_force * (1 + 0.5 * std::sin(2 * std::numbers::pi * k / steps)); };
    const FrictionModel model(scene.contact, scene.system(), unchecked, scene.law());
    Run run(model);
    NormalLoad load = scene.hertz.at(full_force);
    FrictionStep step = run.steady({.motion = load_creepage(0.5), .load = load});
    std::vector<double> forces{force_ratio(step, scene.contact)};
    bool ok = step.status == Status::ok;
    for (int k = 1; k <= steps; ++k) {
        ok = scene.hertz.set(load_after(k), load) == Status::ok && ok;
        step = run.advance({8.0 / steps, load_creepage(0.5), load});
        ok = ok && step.status == Status::ok && step.complementarity_residual < 1e-11;
        if (k % (steps / 20) == 0) forces.push_back(force_ratio(step, scene.contact));
    }
    CHECK(ok);
    return forces;
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
    double largest = 0;
    for (std::size_t k = 0; k < one.size(); ++k) largest = std::max(largest, std::abs(one[k] - other[k]));
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
        series.push_back(roll(LoadScene::breathing(cosine_mesh<double>(n)), 80));
        const double error = largest_difference(agreed, series.back());
        CAPTURE(n, error);
        if (n == 20) CHECK(error < 3e-3);
        if (n == 40) CHECK(error < 1e-3);
        if (n >= 80) CHECK(error < 4e-4);  // dq = 0.1
        if (series.size() < 2) continue;
        sizes.push_back(static_cast<double>(n));
        changes.push_back(largest_difference(series[series.size() - 2], series.back()));
    }
    const double order = support::observed_order(sizes, changes);
    CAPTURE(changes[0], changes[1], changes[2], order);
    CHECK(order > 1.6);
    CHECK(order < 2.3);
}

TEST_CASE("Forces on a fixed mesh converge to the same limit at first order", "[friction][load]") {
    std::vector<double> sizes, errors;
    for (const double largest : {9e-3, 4.4e-3, 2.3e-3}) {
        sizes.push_back(static_cast<double>(50 << sizes.size()));
        const Mesh<double> mesh = uniform_mesh<double>(Eigen::Index(sizes.back()));
        errors.push_back(largest_difference(agreed, roll(LoadScene::fixed(mesh), 160)));
        CHECK(errors.back() < largest);
    }
    CAPTURE(errors);
    CHECK(std::abs(support::observed_order(sizes, errors) - 1) < 0.1);
}

TEST_CASE("A contact does not grow to where the plane kernel is unstable", "[friction][load]") {
    const double b = 0.4, along = 4 * b * std::exp(load_nu / (1 - load_nu)), across = 4 * b * std::exp(-load_nu);
    const LoadScene scene = LoadScene::breathing(cosine_mesh<double>(12), b);
    const ElementSystem<double> lateral = rolling_system(scene.mesh, half, PlaneKernel<double>::lateral(scene.contact));
    const auto check = [&](const FrictionModel& model, double limit, const Creepage& creepage) {
        Run run(model);
        NormalLoad load = scene.hertz.at(full_force);
        const auto advance = [&](double half_length) {
            load.half_length = half_length;
            return run.try_advance({0.1, creepage, load}).status;
        };
        while (run.now().half_length < limit - 0.1) {
            REQUIRE(advance(run.now().half_length + 0.05) == Status::ok);
            run.accept();
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
