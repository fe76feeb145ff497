// rollbem/normal/pressure.hpp
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include <rollbem/normal/pressure.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

TEST_CASE("The means of a tabulated pressure are exact on any mesh", "[pressure]") {
    // whatever the positions of edges and points
    const auto array = [](std::initializer_list<double> values) {
        return ArrayX<double>(Eigen::Map<const ArrayX<double>>(values.begin(), Eigen::Index(values.size())));
    };
    const PressureTable table(array({-0.9, -0.25, -0.25, 0.6}), array({1, 3, 0.5, 0.5}));
    CHECK(table.integral() == Approx(0.65 * 2 + 0.85 * 0.5).epsilon(1e-14));
    const auto antiderivative = [](double x) {
        const double slope = 2 / 0.65, first = std::clamp(x + 0.9, 0.0, 0.65);
        return first + slope * first * first / 2 + 0.5 * std::clamp(x + 0.25, 0.0, 0.85);
    };
    for (const Mesh<double>& mesh : {uniform_mesh<double>(1), uniform_mesh<double>(8), cosine_mesh<double>(37)}) {
        const ArrayX<double> mean = table(mesh);
        for (Eigen::Index i = 0; i < mesh.size(); ++i) {
            const double low = mesh.edges_from_trailing()[i] - 1, high = mesh.edges_from_trailing()[i + 1] - 1;
            CHECK(mean[i] ==
                  Approx((antiderivative(high) - antiderivative(low)) / (high - low)).epsilon(1e-11).margin(1e-14));
        }
    }
    // a constant is accurate to round-off even on the smallest elements
    const Mesh<double> fine = cosine_mesh<double>(100000);
    const ArrayX<double> constant = PressureTable(array({-1, 1}), array({0.7, 0.7}))(fine);
    CHECK((constant / 0.7 - 1).abs().maxCoeff() < 1e-15);
    CHECK_THROWS_WITH((PressureTable(array({-1, 1}), array({0.7}))),
                      "PressureTable: number of pressures = 1 must equal the number of points");
    CHECK_THROWS_WITH((PressureTable(array({-1, 1.5}), array({1, 1}))), "PressureTable: x/a = 1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable(array({-1.5, 1}), array({1, 1}))),
                      "PressureTable: x/a = -1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable(array({0, -0.5}), array({1, 1}))),
                      "PressureTable: x/a = -0.5 must not be less than at the previous point");
    CHECK_THROWS_WITH((PressureTable(array({-1, 1}), array({1, -2}))),
                      "PressureTable: pressure = -2 must be finite and not negative");
    CHECK_THROWS_WITH((PressureTable(array({0, 0}), array({1, 1}))),
                      "PressureTable: load = 0 must be positive and finite");
}

TEST_CASE("A tabulated pressure is linear between its points and zero outside them", "[pressure]") {
    const PressureTable table(Eigen::Array4d(-0.9, -0.25, -0.25, 0.5), Eigen::Array4d(1, 3, 0.5, 0.5));
    CHECK(table(-1.0) == 0);
    CHECK(table(-0.9) == 1);
    CHECK(table(-0.575) == Approx(2).epsilon(1e-14));
    CHECK(table(-0.25) == 0.5);  // ahead of the jump
    CHECK(table(0.4) == 0.5);
    CHECK(table(0.5) == 0.5);
    CHECK(table(0.501) == 0);
    CHECK(table(1.0) == 0);
    CHECK(detail::is_nan(table(NAN)));
}

TEST_CASE("The means of a pressure on a grid are exact on any rectangle", "[pressure]") {
    // a product of functions that are linear between the points, whose antiderivatives are known
    ArrayX<double> x(4), y(3), f(4), g(3);
    x << -3, -1, 0.5, 2;
    y << -1, 0.25, 4;
    f << 0, 2, 1, 3;
    g << 1, 0.5, 2;
    const PressureGrid grid(x, y, (f.matrix() * g.matrix().transpose()).eval());
    const auto antiderivative = [](const ArrayX<double>& knots, const ArrayX<double>& values, double place) {
        double sum = 0;
        for (Eigen::Index k = 1; k < knots.size(); ++k) {
            const double slope = (values[k] - values[k - 1]) / (knots[k] - knots[k - 1]);
            const double part = std::clamp(place, knots[k - 1], knots[k]) - knots[k - 1];
            sum += part * (values[k - 1] + slope * part / 2);
        }
        return sum;
    };
    CHECK(grid.integral() == Approx(antiderivative(x, f, 2) * antiderivative(y, g, 4)).epsilon(1e-14));
    std::vector<PatchMesh<double>::Rectangle> elements;
    for (const double x_1 : {-5.0, -3.0, -2.0, -1.0, 0.0, 1.5}) {
        for (const double width : {0.3, 1.5, 9.0}) {
            for (const double y_1 : {-2.0, -1.0, 0.0, 3.5, 4.0}) {
                elements.push_back({x_1, x_1 + width, y_1, y_1 + width / 2});
            }
        }
    }
    const ArrayX<double> means = grid(elements);
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        const double integral = (antiderivative(x, f, x_2) - antiderivative(x, f, x_1)) *
                                (antiderivative(y, g, y_2) - antiderivative(y, g, y_1));
        CHECK(means[Eigen::Index(i)] == Approx(integral / ((x_2 - x_1) * (y_2 - y_1))).epsilon(1e-13).margin(1e-14));
    }
    const MatrixX<double> ones = MatrixX<double>::Ones(4, 3);
    CHECK_THROWS_WITH((PressureGrid(x, x, ones)),
                      "PressureGrid: number of pressures = 12 must equal the number of points");
    CHECK_THROWS_WITH((PressureGrid(x.head(1), y, ones.topRows(1))),
                      "PressureGrid: number of x = 1 must be at least 2");
    CHECK_THROWS_WITH((PressureGrid(x.reverse(), y, ones)),
                      "PressureGrid: x = 0.5 must be finite and larger than the value before");
    CHECK_THROWS_WITH((PressureGrid(x, y, -ones)), "PressureGrid: pressure = -1 must be finite and not negative");
    CHECK_THROWS_WITH((PressureGrid(x, y, 0 * ones)), "PressureGrid: load = 0 must be positive and finite");
    for (const PatchMesh<double>::Rectangle& none :
         {PatchMesh<double>::Rectangle{0, 0, 0, 1}, {1, 0, 1, 0}, {0, NAN, 0, 1}, {0, 1, 0, INFINITY}}) {
        CHECK_THROWS_AS(grid({none}), std::invalid_argument);
    }
}

}  // namespace
