// rollbem/normal/normal_contact.hpp and what is made of its pressures
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <rollbem/normal/normal_contact.hpp>
#include <rollbem/normal/detail/grid_convolution.hpp>
#include <rollbem/normal/detail/patch_shape.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"

namespace {

using namespace rollbem;
using support::observed_order;

/// E* = 1 and a gap h(x, y) on nx x ny cells over the rectangle x_1 ... x_2, y_1 ... y_2.
struct Scene {
    NormalContact::Cells grid;
    NormalContact::Grid h;
    NormalContact normal{1.0};
    NormalContact::Solution solution;

    template <class Gap>
    Scene(Eigen::Index nx, Eigen::Index ny, double x_1, double x_2, double y_1, double y_2, const Gap& gap)
        : grid{nx, ny, 0, 0, (x_2 - x_1) / double(nx), (y_2 - y_1) / double(ny)}, h(nx, ny) {
        grid.x_0 = x_1 + grid.dx / 2;
        grid.y_0 = y_1 + grid.dy / 2;
        for (Eigen::Index j = 0; j < ny; ++j) {
            for (Eigen::Index i = 0; i < nx; ++i) h(i, j) = gap(grid.x(i), grid.y(j));
        }
    }
    Scene& carry(double load) {
        solution = normal.carry(grid, h, load);
        return *this;
    }
    /// Of all cells, by a convolution of its own.
    NormalContact::Grid displacement() const {
        detail::GridConvolution convolution;
        convolution.prepare(grid.nx, grid.ny, grid.dx, grid.dy);
        NormalContact::Grid u = h;
        convolution.apply(normal.pressure(), u);
        return u / std::numbers::pi;
    }
    PatchContact::Outline outline() const { return detail::contact_outline(grid, normal.pressure()).value(); }
    double peak() const { return detail::peak_pressure(normal.pressure()); }
};

struct Ellipse {
    double B, a, b, p_0, approach;  // of h = x^2/920 + B y^2 under 0.0878
};
constexpr Ellipse ellipses[] = {{1.0 / 920, 3.117247, 3.117247, .00431413, .02112441},
                                {1.0 / 4000, 2.382467, 6.289725, .00279755, .01605989},
                                {1.0 / 26, 4.697661, .478929, .01863301, .03280901}};

TEST_CASE("normal_contact: Hertz's ellipses, by load and by approach, to second order in the cells", "[normal]") {
    for (const Ellipse& e : ellipses) {
        const auto gap = [&](double x, double y) { return x * x / 920 + e.B * y * y; };
        std::vector<double> counts, approach, peak;
        for (const Eigen::Index n : {20, 30, 44, 64}) {
            Scene scene(n, n, -1.17 * e.a, 1.21 * e.a, -1.23 * e.b, 1.19 * e.b, gap);
            scene.carry(0.0878);
            INFO("B = " << e.B << ", n = " << n << ", steps " << scene.solution.steps);
            REQUIRE(scene.solution.status == Status::ok);
            CHECK(scene.solution.load == Approx(0.0878).epsilon(1e-12));
            CHECK(scene.solution.steps < 60);
            counts.push_back(double(n));
            approach.push_back(scene.solution.approach / e.approach - 1);
            peak.push_back(scene.peak() / e.p_0 - 1);
            const PatchContact::Outline outline = scene.outline();
            CHECK(outline.area() == Approx(std::numbers::pi * e.a * e.b).epsilon(n < 40 ? 2.5e-2 : 4e-3));
            CHECK((outline.high() - outline.low()) / 2 == Approx(e.b).epsilon(n < 40 ? 1e-2 : 5e-3));
            CHECK((outline.leading(0) - outline.trailing(0)) / 2 == Approx(e.a).epsilon(n < 40 ? 5e-3 : 2e-3));
            const double load = scene.solution.load;
            scene.solution = scene.normal.approach(scene.grid, scene.h, scene.solution.approach);
            CHECK(scene.solution.load == Approx(load).epsilon(1e-5));
        }
        INFO("errors of the approach " << approach[0] << " to " << approach[3] << ", of the peak " << peak[0] << " to "
                                       << peak[3]);
        CHECK(observed_order(counts, approach) == Approx(2).margin(0.5));
        CHECK(observed_order(counts, peak) == Approx(2).margin(0.8));
        CHECK(std::abs(approach[3]) < 2e-4);
        CHECK(std::abs(peak[3]) < 2e-4);
    }
}

TEST_CASE("normal_contact: a first solution that is to start from the last one starts anew", "[normal]") {
    Scene fresh(16, 16, -1.6, 1.6, -1.6, 1.6, [](double x, double y) { return x * x + y * y; });
    NormalContact warm(1);
    CHECK(fresh.carry(1).solution.status == Status::ok);
    CHECK(warm.carry(fresh.grid, fresh.h, 1, 1e-6, true).status == Status::ok);
    CHECK((warm.pressure() == fresh.normal.pressure()).all());
}

TEST_CASE("normal_contact: two radii, and a tilted ellipse", "[normal]") {
    Scene radii(64, 64, -4.8, 4.8, -1.2, 3.3,
                [](double x, double y) { return x * x / 920 + y * y / (y > 0 ? 600 : 60); });
    radii.carry(0.0878);
    CHECK(radii.solution.approach == Approx(.025305).epsilon(1e-3));
    CHECK(radii.peak() == Approx(.009276).epsilon(3e-3));
    const PatchContact::Outline outline = radii.outline();
    CHECK(outline.area() == Approx(19.45).epsilon(5e-3));
    CHECK(outline.low() == Approx(-.639).margin(radii.grid.dy / 2));
    CHECK(outline.high() == Approx(2.715).margin(radii.grid.dy / 2));
    double moment = 0;
    for (Eigen::Index j = 0; j < radii.grid.ny; ++j) {
        moment += radii.normal.pressure().col(j).sum() * radii.grid.y(j) * radii.grid.dx * radii.grid.dy;
    }
    CHECK(moment / 0.0878 == Approx(.62248).epsilon(1e-3));

    Scene tilted(64, 64, -7, 7, -3.9, 3.8, [](double x, double y) { return x * x / 920 + y * y / 300 + .003 * x * y; });
    tilted.carry(0.0878);
    CHECK(tilted.solution.approach == Approx(.01998851).epsilon(4e-4));
    CHECK(tilted.peak() == Approx(.00526998).epsilon(1e-3));
    CHECK(tilted.outline().area() == Approx(24.990589).epsilon(1e-2));
    CHECK(tilted.outline().high() == Approx(3.058204).epsilon(5e-3));
}

TEST_CASE("normal_contact: pressures push, gaps are open, and both not in one cell", "[normal]") {
    for (const bool by_load : {true, false}) {
        Scene scene(37, 29, -5, 6, -3, 4, [](double x, double y) {
            return x * x / 900 + y * y / 500 + 0.002 * std::cos(3 * y) * std::cos(2 * x);
        });
        scene.solution = by_load ? scene.normal.carry(scene.grid, scene.h, 0.06, 1e-9)
                                 : scene.normal.approach(scene.grid, scene.h, 0.015, 1e-9);
        REQUIRE(scene.solution.status == Status::ok);
        const auto& p = scene.normal.pressure();
        const NormalContact::Grid w = scene.h + scene.displacement() - scene.solution.approach;
        const double deepest = scene.solution.approach - scene.h.minCoeff();
        CHECK((p >= 0).all());
        CHECK(((p > 0).select(w.abs(), -w) < 2e-9 * deepest).all());
    }
}

TEST_CASE("normal_contact: a plane gap is pressed as by a flat punch, also on a single cell", "[normal]") {
    const double height = GENERATE(0.0, 1e-5, -3.0);
    Scene square(24, 24, -1, 1, -1, 1, [&](double, double) { return height; });
    square.carry(1);
    REQUIRE(square.solution.status == Status::ok);
    const auto& p = square.normal.pressure();
    const double approach = square.solution.approach - height;
    CHECK(p.sum() * square.grid.dx * square.grid.dy == Approx(1).epsilon(1e-12));
    // side a: N = 1.012 * 2/sqrt(pi) E* a d (King 1987)
    CHECK(1 / (2 * approach) == Approx(1.012 * 2 / std::sqrt(std::numbers::pi)).epsilon(1e-2));
    CHECK(((square.displacement() / approach - 1).abs() < 1e-5).all());
    CHECK(p(0, 0) > 5 * p(12, 12));
    for (const bool by_load : {true, false}) {
        Scene cell(1, 1, -1, 1, -0.5, 0.5, [&](double, double) { return height; });
        cell.solution =
            by_load ? cell.normal.carry(cell.grid, cell.h, 3) : cell.normal.approach(cell.grid, cell.h, height + 0.5);
        REQUIRE(cell.solution.status == Status::ok);
        CHECK(cell.displacement()(0, 0) == Approx(cell.solution.approach - height).epsilon(1e-11));
        CHECK(cell.solution.load == Approx(2 * cell.normal.pressure()(0, 0)));
    }
}

TEST_CASE("normal_contact: any load and any gap has numbers with status ok, or none and a status", "[normal]") {
    struct Gap {
        const char* name;
        double (*of)(double, double);
    };
    constexpr Gap gaps[] = {{"plane", [](double, double) { return 1e-5; }},
                            {"constant along x", [](double, double y) { return y * y; }},
                            {"wedge", [](double x, double) { return x; }},
                            {"hollow", [](double x, double y) { return -x * x - y * y; }},
                            {"far away", [](double x, double y) { return 1e6 + x * x + y * y; }},
                            {"flat", [](double x, double y) { return 1e-300 * (x * x + y * y); }},
                            {"masked", [](double x, double y) { return x > 0.3 ? 1e300 * (1 + y) : x * x + y * y; }},
                            {"steep", [](double x, double y) { return 1e300 * (x * x + y * y); }},
                            {"deep", [](double x, double y) { return x > 0.9 ? -1e300 : y; }},
                            {"not a number", [](double x, double y) { return x > 0.9 && y > 0.9 ? NAN : x * x; }},
                            {"infinite", [](double x, double y) { return x > 0.9 && y > 0.9 ? INFINITY : x * x; }}};
    const Gap& gap = gaps[GENERATE(range(0, 11))];
    Scene scene(14, 11, -1, 1, -1, 1, gap.of);
    const NormalContact::Grid round = Scene(14, 11, -1, 1, -1, 1, [](double x, double y) { return x * x + y * y; }).h;
    for (const bool by_load : {true, false}) {
        for (const double value :
             {0.0, -1.0, 5e-324, 1e-300, 1e-20, 1e-3, 1.0, 1e12, 1e150, 1e300, double(NAN), double(INFINITY)}) {
            const auto found = by_load ? scene.normal.carry(scene.grid, scene.h, value)
                                       : scene.normal.approach(scene.grid, scene.h, value);
            const auto& p = scene.normal.pressure();
            CAPTURE(gap.name, by_load, value, name(found.status));
            CHECK((detail::is_finite(found.load) && detail::is_finite(found.residual)));
            CHECK((detail::all_finite(p) && (p >= 0).all()));
            if (found.status == Status::ok) {
                CHECK(found.residual <= 1e-6);
                CHECK((by_load ? found.load == Approx(value).epsilon(1e-12) : found.approach == value));
                CHECK(found.load > 0);
            } else {
                CHECK((found.status == Status::no_contact || found.status == Status::not_finite));
                CHECK((p == 0).all());
            }
            // what it leaves is a first guess
            CHECK(scene.normal.carry(scene.grid, round, 1, 1e-6, true).status == Status::ok);
        }
    }
    CHECK(scene.normal.carry(scene.grid, round, 0).status == Status::no_contact);
    CHECK(scene.normal.carry(scene.grid, round, NAN).status == Status::not_finite);
    CHECK(scene.normal.approach(scene.grid, round + 1, 0.9).status == Status::no_contact);
    const bool solvable = detail::all_finite(scene.h);
    CHECK(scene.normal.carry(scene.grid, scene.h, 1).status == (solvable ? Status::ok : Status::not_finite));
}

TEST_CASE("normal_contact: grids without a size, compliances and numbers of gaps that cannot be meant", "[normal]") {
    Scene scene(8, 8, -1, 1, -1, 1, [](double x, double y) { return x * x + y * y; });
    for (const double size : {0.0, -1.0, double(NAN), double(INFINITY), 5e-324}) {
        NormalContact::Cells grid = scene.grid;
        grid.dx = size;
        const auto found = scene.normal.carry(grid, scene.h, 1);
        CHECK((found.status == Status::not_finite && found.load == 0 && (scene.normal.pressure() == 0).all()));
        CHECK_THROWS_AS(NormalContact(size == 5e-324 ? 0 : size), std::invalid_argument);
    }
    scene.grid.nx = 9;
    CHECK_THROWS_AS(scene.normal.carry(scene.grid, scene.h, 1), std::invalid_argument);
    scene.grid.nx = scene.grid.ny = 0;
    CHECK_THROWS_AS(scene.normal.carry(scene.grid, NormalContact::Grid(0, 0), 1), std::invalid_argument);
}

TEST_CASE("patch_shape: outlines interpolate lines exactly, and keep what grows growing", "[normal]") {
    const detail::MonotoneCubic line({0, 1, 3, 4, 6}, {1, 3, 7, 9, 13}), growing({0, 1, 2, 3, 4}, {0, 0.1, 2, 2.1, 5});
    for (int k = 0; k <= 60; ++k) {
        CHECK(line(0.1 * k) == Approx(1 + 0.2 * k).epsilon(1e-14));
        if (k <= 39) CHECK(growing(0.1 * k + 0.1) > growing(0.1 * k));
    }
}

}  // namespace
