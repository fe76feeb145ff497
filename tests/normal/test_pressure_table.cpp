// rollbem/normal/pressure_table.hpp
#include <algorithm>
#include <initializer_list>

#include <rollbem/normal/pressure_table.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

TEST_CASE("The means of a tabulated pressure are exact on any mesh", "[pressure]") {
    // whatever the positions of edges and points
    const auto array = [](std::initializer_list<double> values) {
        return ArrayX<double>(Eigen::Map<const ArrayX<double>>(values.begin(), Eigen::Index(values.size())));
    };
    const PressureTable<double> table(array({-0.9, -0.25, -0.25, 0.6}), array({1, 3, 0.5, 0.5}));
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
    const ArrayX<double> constant = PressureTable<double>(array({-1, 1}), array({0.7, 0.7}))(fine);
    CHECK((constant / 0.7 - 1).abs().maxCoeff() < 1e-15);
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1}), array({0.7}))),
                      "PressureTable: number of pressures = 1 must equal that of points");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1.5}), array({1, 1}))),
                      "PressureTable: x/a = 1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1.5, 1}), array({1, 1}))),
                      "PressureTable: x/a = -1.5 must lie in [-1, 1]");
    CHECK_THROWS_WITH((PressureTable<double>(array({0, -0.5}), array({1, 1}))),
                      "PressureTable: x/a = -0.5 must not be less than at the previous point");
    CHECK_THROWS_WITH((PressureTable<double>(array({-1, 1}), array({1, -2}))),
                      "PressureTable: pressure = -2 must be finite and not negative");
    CHECK_THROWS_WITH((PressureTable<double>(array({0, 0}), array({1, 1}))),
                      "PressureTable: load = 0 must be positive and finite");
}

TEST_CASE("A tabulated pressure is linear between its points and zero outside them", "[pressure]") {
    const PressureTable<double> table(Eigen::Array4d(-0.9, -0.25, -0.25, 0.5), Eigen::Array4d(1, 3, 0.5, 0.5));
    CHECK(table(-1.0) == 0);
    CHECK(table(-0.9) == 1);
    CHECK(table(-0.575) == Approx(2).epsilon(1e-14));
    CHECK(table(-0.25) == 0.5);  // ahead of the jump
    CHECK(table(0.4) == 0.5);
    CHECK(table(0.5) == 0.5);
    CHECK(table(0.501) == 0);
    CHECK(table(1.0) == 0);
}

}  // namespace
