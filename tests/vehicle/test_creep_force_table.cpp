// rollbem/vehicle/creep_force_table.hpp, creep_force_grid.hpp, closed_form/carter.hpp: symmetries, limits, the
// order of interpolation, tangents, and what a file must hold.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>
#include <rollbem/vehicle/make_creep_force_table.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"
#include "vehicle/creep_force_scene.hpp"
#include "vehicle/made_tables.hpp"

namespace creep_force_table_tests {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using creep_forces::array, creep_forces::contact, creep_forces::numbers, support::observed_order;
using testing::steel;

namespace {

constexpr double mu = 0.3, load = 8e4, modulus = 8e10;

/// Creepages of a level near saturation: in units of mu N/(G a b), the spin over c besides.
Creepage creepage(const PatchContact& patch, double x, double y, double spin) {
    const double unit = mu * load / (modulus * patch.c() * patch.c());
    return {unit * x, unit * y, unit * spin / patch.c()};
}

/// -F_x, -F_y over mu N, -M_z over mu N c.
Eigen::Array3d ratios(const PatchContact& patch, const CreepForceTable::Force& at) {
    return -array(at.force) / (mu * load) / Eigen::Array3d(1, 1, patch.c());
}

const CreepForceTable& small_table() {
    static const CreepForceTable table = creep_forces::table(6, 5);
    return table;
}

std::string bytes(const CreepForceTable& table) {
    std::ostringstream stream;
    table.write(stream);
    return stream.str();
}

std::string refused(const std::string& text) {
    return refusal([&] {
        std::istringstream stream(text);
        CreepForceTable::read(stream);
    });
}

}  // namespace

TEST_CASE("creep_force_table: full sliding against the sum over a fine mesh, and what is known of it") {
    CHECK_THAT(full_sliding(1.0, 0.0, 0.0, 2.0).moment, WithinRel(3 * std::numbers::pi / 16, 1e-12));
    const auto straight = full_sliding(3.0, 3.0, -4.0, 0.0);
    CHECK_THAT(straight.longitudinal, WithinRel(0.6, 1e-14));
    CHECK_THAT(straight.lateral, WithinRel(-0.8, 1e-14));
    CHECK_THAT(straight.moment, WithinAbs(0, 1e-14));
    CHECK(full_sliding(2.0, 0.0, 0.0, 0.0).moment == 0);
    for (const double a_over_b : {0.2, 1.0, 4.0}) {
        const double a = std::sqrt(a_over_b), b = 1 / a;
        // the pole of the spin inside, near the edge, outside; the last with the spin reversed
        for (const double place : {0.0, 0.6, 0.99, 1.01, 3.0, -0.7}) {
            const double xi = place * b * 0.6, eta = -place * a * 0.8, phi = place < 0 ? -1 : 1;
            Eigen::Array3d sum = Eigen::Array3d::Zero();
            double all = 0;
            const int n = 300;
            for (int i = 0; i < n; ++i) {
                const double angle = (i + 0.5) * std::numbers::pi / n, y = -b * std::cos(angle);
                for (int k = 0; k < n; ++k) {
                    const double turn = (k + 0.5) * std::numbers::pi / n, x = -a * std::sin(angle) * std::cos(turn);
                    const double weight = std::pow(std::sin(angle), 3) * std::pow(std::sin(turn), 2);
                    const double s_x = xi - phi * y, s_y = eta + phi * x, size = std::hypot(s_x, s_y);
                    sum += weight / size * Eigen::Array3d(s_x, s_y, x * s_y - y * s_x);
                    all += weight;
                }
            }
            const auto full = full_sliding(a_over_b, xi, eta, phi);
            INFO("a/b = " << a_over_b << ", place of the pole " << place);
            CHECK_THAT(full.longitudinal, WithinAbs(sum[0] / all, 1e-4));
            CHECK_THAT(full.lateral, WithinAbs(sum[1] / all, 1e-4));
            CHECK_THAT(full.moment, WithinAbs(sum[2] / all, 1e-4));
        }
    }
}

TEST_CASE("full_sliding: extreme ellipses and creepages have numbers") {
    // of spin, the mean distance from the middle of a pressure along a line: 3/8 of its half-length
    for (const double a_over_b : {1e-310, 1e-300, 1e-100, 1e100, 1e300}) {
        const double longer = std::max(1 / std::sqrt(a_over_b), std::sqrt(a_over_b));
        CAPTURE(a_over_b);
        CHECK_THAT(full_sliding(a_over_b, 0.0, 0.0, 1.0).moment / longer, WithinRel(0.375, 1e-4));
        const auto exact = full_sliding(a_over_b, 1, 1, 1);
        for (const double size : {1e-300, 1.0, 1e300}) {
            const auto full = full_sliding(a_over_b, size, size, size);
            CHECK_THAT(full.longitudinal, WithinAbs(double(exact.longitudinal), 1e-15));
            CHECK_THAT(full.lateral, WithinAbs(double(exact.lateral), 1e-15));
            CHECK_THAT(full.moment, WithinRel(double(exact.moment), 1e-12));
        }
    }
}

TEST_CASE("creep_force_table: no creepage, no force, and tangents of the linear law") {
    const CreepForceTable& table = small_table();
    for (const double a_over_b : {0.5, std::sqrt(0.5), 1.0, 2.0}) {  // ellipses of the table
        const PatchContact patch = contact(a_over_b);
        const CreepForceTable::Force rest = table.look_up(patch, mu, load, {});
        REQUIRE(rest.status == Status::ok);
        CHECK((array(rest.force) == 0).all());
        const auto c = creep_forces::coefficients(a_over_b);
        const double length = patch.c();
        Eigen::Array33d expected;
        expected << c.c11, 0, 0, 0, c.c22, length * c.c23, 0, length * c.c32, length * length * c.c33;
        expected *= -modulus * length * length;
        CHECK(((numbers(rest).middleCols<3>(1) - expected).abs() <= 1e-6 * expected.abs()).all());
        const Creepage v = creepage(patch, 1e-6, -2e-6, 3e-6);
        const Eigen::Array3d linear = expected.matrix() * Eigen::Vector3d(v.longitudinal, v.lateral, v.spin);
        CHECK((array(table.look_up(patch, mu, load, v).force) - linear).abs().maxCoeff() <
              1e-4 * linear.abs().maxCoeff());
    }
}

TEST_CASE("creep_force_table: forces stay within mu N, also where the bound acts") {
    drawn::Draw draw(76);
    int acts = 0;
    for (int i = 0; i < 3000; ++i) {
        const PatchContact patch = contact(draw.decades(-1, 1));
        const double size = draw.uniform(0.3, 3), way = draw.uniform(0, 2 * std::numbers::pi);
        const Creepage v =
            creepage(patch, size * std::cos(way), size * std::sin(way), 0.2 * size * draw.uniform(-1, 1));
        const CreepForceTable::Force at = steel().look_up(patch, mu, load, v);
        const auto part = [&](const TangentialForce& of) {
            return std::hypot(of.longitudinal, of.lateral) / (mu * load);
        };
        CAPTURE(i, part(at.force));
        REQUIRE(part(at.force) <= 1 + 1e-14);
        REQUIRE(part(steel().force<double>({patch.half_length(), patch.half_width(), modulus, 0.28}, mu, load, v)) <=
                1 + 1e-14);
        if (part(at.force) > 0.9995) ++acts;
    }
    REQUIRE(acts > 200);
}

TEST_CASE("creep_force_table: forces alone are those with tangents, in single precision to its digits") {
    const CreepForceTable& table = small_table();
    for (const double a_over_b : {0.7, 1.3, 30.0}) {
        const PatchContact patch = contact(a_over_b);
        const PatchContact::Parameters axes{patch.half_length(), patch.half_width(), patch.shear_modulus(),
                                            patch.poisson_ratio()};
        for (const auto& v :
             {creepage(patch, 0, 0, 0), creepage(patch, 1e-3, 2e-3, -1e-3), creepage(patch, -0.02, 0.01, 0),
              creepage(patch, -0.3, -0.2, 0.4), creepage(patch, 2, 1, -3), creepage(patch, 1e3, -1e2, 5e2)}) {
            const Eigen::Array3d scale = Eigen::Array3d(1, 1, patch.c()) * mu * load,
                                 both = array(table.look_up(patch, mu, load, v).force) / scale,
                                 alone = array(table.force(axes, mu, load, v)) / scale,
                                 rough = array(table.force<float>(axes, mu, load, v)) / scale;
            CAPTURE(a_over_b, both.transpose(), alone.transpose(), rough.transpose());
            CHECK((alone - both).abs().maxCoeff() < 1e-14);
            CHECK((rough - both).abs().maxCoeff() < 1e-6);
        }
        CHECK(array(table.force(axes, 0, load, {0, 0, 0})).abs().maxCoeff() == 0);
        CHECK(array(table.force(axes, mu, 0, {1e-3, 0, 0})).abs().maxCoeff() == 0);
    }
}

TEST_CASE("creep_force_table: the order of the interpolation, and full sliding as its limit") {
    std::vector<double> counts, errors, outside;
    for (const int levels : {6, 10, 16}) {
        const CreepForceTable table = creep_forces::table(levels, levels);
        drawn::Draw draw(3);
        double sum = 0, beyond = 0;
        const int count = 300;
        for (int i = 0; i < count; ++i) {
            const PatchContact patch = contact(0.5 * std::pow(4.0, draw.uniform(0, 1)));
            const Eigen::Array3d d = Eigen::Array3d(draw.normal(), draw.normal(), draw.normal());
            const double level = std::pow(10.0, 1.5 * draw.uniform(0, 1) - 0.5) / d.matrix().norm();
            const Creepage v{level * d[0], level * d[1], level * d[2]};
            const Creepage given = creepage(patch, v.longitudinal, v.lateral, v.spin);
            const Eigen::Array3d error =
                ratios(patch, table.look_up(patch, mu, load, given)) - creep_forces::forces(patch.a_over_b(), v);
            sum += error.square().sum();
            const auto full = full_sliding(patch.a_over_b(), d[0], d[1], d[2]);
            const Creepage large = creepage(patch, 1e9 * d[0], 1e9 * d[1], 1e9 * d[2]);
            const Eigen::Array3d difference = ratios(patch, table.look_up(patch, mu, load, large)) -
                                              Eigen::Array3d(full.longitudinal, full.lateral, full.moment);
            beyond += difference.square().sum();
        }
        counts.push_back(levels);
        errors.push_back(std::sqrt(sum / count));
        outside.push_back(std::sqrt(beyond / count));
        CAPTURE(levels);
        CHECK(errors.back() < 0.05);
    }
    CAPTURE(errors, outside);
    // no third derivative where the pole of the spin crosses the edge: order 2.5 in the cells there, 3 in the mean
    CHECK_THAT(observed_order(counts, errors), WithinAbs(3, 0.5));
    // the second derivative by |u| changes its sign where forces are mirrored
    CHECK_THAT(observed_order(counts, outside), WithinAbs(2, 0.5));
}

TEST_CASE("creep_force_table: tangents without friction and at rest, and continuous across cells") {
    const CreepForceTable& table = small_table();
    // from no friction on, by the force in full sliding
    {
        const PatchContact patch = contact(1.2);
        const Creepage v = creepage(patch, 0.4, 0.2, 0.3);
        const CreepForceTable::Force at = table.look_up(patch, 0, load, v), next = table.look_up(patch, 1e-6, load, v);
        CHECK(array(at.force).isZero());
        const Eigen::Array3d by_mu = array(at.tangent_by_friction_coefficient);
        CHECK(((array(next.force) / 1e-6 - by_mu) / (Eigen::Array3d(1, 1, patch.c()) * load)).abs().maxCoeff() < 1e-4);
        CHECK(array(table.look_up(patch, 0, load, {0, 0, 0}).tangent_by_load).isZero());
    }
    // where creepages vanish one by one, by steps that leave the plane of symmetry
    const PatchContact round = contact(1.3);
    for (const auto& v : {creepage(round, 0, 0.3, -0.2), creepage(round, 0.3, 0, 0), creepage(round, 0, 0, 0.4),
                          creepage(round, 0, -0.2, 0), creepage(round, 0, 0, 0)}) {
        const CreepForceTable::Force at = table.look_up(round, mu, load, v);
        const Creepage unit = creepage(round, 1, 1, 1);
        for (const auto& [which, tangent] :
             {std::pair(&Creepage::longitudinal, at.tangent.by_longitudinal),
              std::pair(&Creepage::lateral, at.tangent.by_lateral), std::pair(&Creepage::spin, at.tangent.by_spin)}) {
            for (const double step : {1e-6, -1e-6}) {
                Creepage beside = v;
                beside.*which += step * (unit.*which);
                const Eigen::Array3d difference = array(table.look_up(round, mu, load, beside).force) - array(at.force);
                const Eigen::Array3d slope = array(tangent) * (unit.*which);
                const Eigen::Array3d scale = Eigen::Array3d(1, 1, round.c()) * mu * load;
                CAPTURE(step, difference.transpose() / step, slope.transpose());
                CHECK((((difference / step - slope) / scale).abs() < 1e-4).all());
            }
        }
    }
    // along a line through many cells, past the point of rest: the tangent changes in proportion to the step
    const PatchContact patch = contact(1.1);
    for (const double step : {1e-4, 1e-5}) {
        double jump = 0, last = std::numeric_limits<double>::quiet_NaN();
        for (double t = -0.3; t < 0.3; t += step) {
            const CreepForceTable::Force at = table.look_up(patch, mu, load, creepage(patch, t, 0.7 * t, 0.4 * t));
            const double now = at.tangent.by_lateral.lateral / (modulus * patch.c() * patch.c());
            if (last == last) jump = std::max(jump, std::abs(now - last));
            last = now;
        }
        CHECK(jump < 60 * step);
    }
    // and so does its own derivative, past the first level, where the correction at rest ends
    const double n = table.grid().levels(),
                 at_level = CreepForceTable::Grid::saturation_scale / (n - 1) / creep_forces::coefficients(1).c22;
    const PatchContact circle = contact(1);
    const auto change = [&](double from, double to) {
        const auto tangent = [&](double part) {
            return table.look_up(circle, mu, load, creepage(circle, 0, part * at_level, 0)).tangent.by_lateral.lateral;
        };
        return (tangent(to) - tangent(from)) / (to - from);
    };
    CHECK_THAT(change(1, 1.0001), WithinRel(change(0.9999, 1), 1e-2));
}

TEST_CASE("creep_force_table: far below saturation, between its ellipses") {
    const CreepForceTable& table = small_table();
    for (const double a_over_b : {0.55, 0.8, 1.3, 1.85}) {
        const PatchContact patch = contact(a_over_b);
        const auto c = creep_forces::coefficients(a_over_b);
        const double stiffness = -modulus * patch.c() * patch.c();
        const Creepage v{1e-6, -2e-6, 3e-5 / patch.c()};
        // the larger mu, the fewer digits the splines have
        for (const double ratio : {1e3, 1e9, 1e15}) {
            const CreepForceTable::Force at = table.look_up(patch, ratio, load, v);
            INFO("a/b = " << a_over_b << ", mu = " << ratio);
            CHECK_THAT(at.force.longitudinal, WithinRel(stiffness * c.c11 * 1e-6, 2e-3));
            CHECK_THAT(at.force.lateral, WithinRel(stiffness * (-2e-6 * c.c22 + 3e-5 * c.c23), 2e-3));
            CHECK_THAT(at.force.moment, WithinRel(stiffness * patch.c() * (-2e-6 * c.c32 + 3e-5 * c.c33), 2e-3));
        }
    }
    // loads too small to divide by
    CHECK((array(table.look_up(contact(1), mu, 1e-303, {}).force) == 0).all());
    CHECK(table.look_up(contact(1), mu, 1e-303, {}).status == Status::ok);
}

TEST_CASE("creep_force_table: what it refuses, and what it says of a/b beyond it") {
    const CreepForceTable& table = small_table();

    const PatchContact patch = contact(1);
    static_assert(noexcept(table.look_up(patch, mu, load, Creepage{})));
    const auto status = [&](const PatchContact& where, double friction, double pressing, const Creepage& v) {
        return table.look_up(where, friction, pressing, v).status;
    };
    CHECK(status(contact(1, 0.2899), mu, load, {}) == Status::ok);
    CHECK(status(contact(1, 0.2901), mu, load, {}) == Status::wrong_table);
    CHECK(status(contact(1, 0.25), mu, load, {}) == Status::wrong_table);
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(3, -1, 1), trailing = Eigen::ArrayXd::Constant(3, -1);
    const PatchContact square(PatchContact::Outline(y, trailing, -trailing), modulus, 0.28);
    CHECK(status(square, mu, load, {}) == Status::wrong_table);

    for (const double none : {0.0, 1.0}) {  // no friction, no load
        const CreepForceTable::Force nothing = table.look_up(patch, none * mu, (1 - none) * load, {1e-3, 0, 0});
        CHECK(nothing.status == Status::ok);
        CHECK((array(nothing.force) == 0).all());
    }
    const CreepForceTable::Force tiny =
        table.look_up(patch, mu, 1e-300, {1e-3, 1e-3, 0});  // full sliding under hardly any load
    CHECK(tiny.status == Status::ok);
    CHECK_THAT(tiny.force.lateral, WithinRel(-mu * 1e-300 * std::sqrt(0.5), 0.02));
    CHECK(table.look_up(patch, mu, load, {1e300, 1e300, 1e300}).status == Status::ok);

    const auto beyond = [&](double a_over_b) { return table.look_up(contact(a_over_b), mu, load, {1e-3, 1e-3, 0.1}); };
    CHECK(beyond(2).a_over_b_on_table);
    CHECK_FALSE(beyond(2.1).a_over_b_on_table);
    CHECK_FALSE(beyond(0.4).a_over_b_on_table);
    CHECK(((array(beyond(2.001).force) - array(beyond(1.999).force)).abs() < 1e-3 * mu * load).all());
}

TEST_CASE("creep_force_table: a file gives the same table, and nothing else is taken for one") {
    const CreepForceTable& table = small_table();
    const std::string good = bytes(table);
    std::istringstream stream(good);
    const CreepForceTable again = CreepForceTable::read(stream);
    CHECK(bytes(again) == good);
    const PatchContact patch = contact(0.8);
    for (const auto& v : {creepage(patch, 0.3, 0.1, -0.2), creepage(patch, 0.01, 0.02, 0), creepage(patch, 9, 5, 7)}) {
        CHECK((array(table.look_up(patch, mu, load, v).force) == array(again.look_up(patch, mu, load, v).force)).all());
    }
    std::ifstream missing("no such file", std::ios::binary);
    CHECK_THAT(refusal([&] { CreepForceTable::read(missing); }), ContainsSubstring("must be readable"));
    CHECK_THAT(refusal([] { CreepForceTable::read("no such file"); }),
               ContainsSubstring("CreepForceTable: no such file must be a file that can be read"));
    CHECK_THAT(refusal([] { CreepForceTable::read("."); }),  // a folder
               ContainsSubstring("CreepForceTable: . must be a file that can be read"));
    CHECK_THAT(refused("a_over_b,poisson,n,strips,longitudinal"), ContainsSubstring("must begin with"));
    for (const std::size_t length :
         {std::size_t(0), std::size_t(7), std::size_t(25), good.size() / 2, good.size() - 1}) {
        CHECK_THAT(refused(good.substr(0, length)), ContainsSubstring("must not end"));
    }
    const auto changed = [&](std::size_t place, char by) {
        std::string text = good;
        text[place] = static_cast<char>(text[place] ^ by);
        return refused(text);
    };
    CHECK_THAT(changed(20, 1), ContainsSubstring("version = 5 must be 4"));
    CHECK_THAT(changed(27, 1), ContainsSubstring("levels"));
    CHECK_THAT(changed(31, 1), ContainsSubstring("number of ellipses"));
    CHECK_THAT(changed(good.size() / 2, 1), ContainsSubstring("checksum"));
    CHECK_THAT(changed(good.size() - 1, 1), ContainsSubstring("checksum"));

    const CreepForceTable::Grid grid = creep_forces::grid(6, 5);
    Eigen::Array3Xd forces = Eigen::Array3Xd::Zero(3, grid.nodes() * grid.shapes());
    CHECK(refusal([&] { CreepForceTable(grid, forces); }).empty());
    CHECK_THAT(refusal([&] { CreepForceTable(grid, forces.leftCols(7)); }), ContainsSubstring("number of forces = 7"));
    forces(1, 3) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THAT(refusal([&] { CreepForceTable(grid, forces); }), ContainsSubstring("force over mu N = nan"));
    const auto grid_refused = [](double nu, double low, double high, int levels, int shapes) {
        return refusal([&] {
            CreepForceTable::Grid(nu, low, high, levels,
                                  std::vector<CreepCoefficients<double>>(static_cast<std::size_t>(shapes),
                                                                         creep_forces::coefficients(1)));
        });
    };
    CHECK(grid_refused(0.28, 0.5, 2, 6, 4).empty());
    CHECK_THAT(grid_refused(0.6, 0.5, 2, 6, 4), ContainsSubstring("poisson_ratio = 0.6"));
    CHECK_THAT(grid_refused(0.28, 0, 2, 6, 4), ContainsSubstring("smallest_a_over_b = 0"));
    CHECK_THAT(grid_refused(0.28, 2, 2, 6, 4), ContainsSubstring("largest_a_over_b = 2"));
    CHECK_THAT(grid_refused(0.28, 0.5, 2, 3, 4), ContainsSubstring("levels = 3"));
    CHECK_THAT(grid_refused(0.28, 0.5, 2, 6, 3), ContainsSubstring("number of ellipses = 3"));
}

TEST_CASE("creep_force_table: the table of steel holds the forces of its patches") {
    const CreepForceTable::Grid& grid = steel().grid();
    const CreepForceTable::Grid::Range range;
    CHECK(grid.poisson_ratio() == range.poisson_ratio);
    CHECK(grid.shapes() == range.shapes);
    CHECK(grid.levels() == range.levels);
    CHECK(grid.smallest_a_over_b() == range.smallest_a_over_b);
    CHECK(grid.largest_a_over_b() == range.largest_a_over_b);
    drawn::Draw draw(1);
    for (const Eigen::Index shape : {0, 4, 7, 12}) {
        CreepForceTable::Source source(grid.a_over_b(shape), grid.poisson_ratio(), range.n);
        for (int k = 0; k < 6; ++k) {
            const auto node = static_cast<Eigen::Index>(draw.uniform(0, static_cast<double>(grid.nodes())));
            const Creepage v = grid.creepage(shape, node);
            const auto solution = source.solve(v, true);
            REQUIRE(solution.step.status == Status::ok);
            const PatchContact& patch = source.contact();
            const double limit = patch.half_width();  // mu N = G a b
            const auto found = steel().look_up(patch, 1, limit, {v.longitudinal, v.lateral, v.spin / patch.c()});
            const Eigen::Array3d force = -array(found.force) / limit / Eigen::Array3d(1, 1, patch.c());
            CAPTURE(shape, node, v.longitudinal, v.lateral, v.spin, force, solution.force);
            const bool is_bounded = solution.force.head<2>().matrix().norm() > 0.9995;
            CHECK((force - solution.force).abs().maxCoeff() < (is_bounded ? 8e-5 : 2e-6));
        }
    }
}

}  // namespace creep_force_table_tests
