// rollbem/elasticity/subsurface_stress.hpp
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <rollbem/elasticity/subsurface_stress.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace subsurface_stress_tests {
namespace {

using namespace rollbem;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::vector<Yield::LoadedRectangle> loads{{-1, 0.5, -0.7, 0.9, 0.3, -0.8, 1},
                                                {0.5, 1.2, -0.2, 1.1, -1, 0.4, 0.5}};

/// Hertz's pressure of peak 1 on the unit circle.
std::vector<Yield::LoadedRectangle> sphere(int n) {
    std::vector<Yield::LoadedRectangle> cells;
    const double h = 2.0 / n;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double x = -1 + (i + 0.5) * h, y = -1 + (j + 0.5) * h, rest = 1 - x * x - y * y;
            if (rest <= 0) continue;
            cells.push_back({x - h / 2, x + h / 2, y - h / 2, y + h / 2, 0, 0, std::sqrt(rest)});
        }
    }
    return cells;
}

TEST_CASE("Stresses are in equilibrium, and strains fit together", "[subsurface]") {
    const double nu = GENERATE(0.0, 0.28, 0.5), h = 2e-3;
    for (const Vector3d& at : {Vector3d{0.2, 0.1, 0.4}, {-0.9, 1.3, 0.6}, {0.5, 0.9, 0.3}}) {
        const auto stress = [&](const Vector3d& move) { return subsurface_stress(loads, nu, at + h * move); };
        const auto unit = [](int i) -> Vector3d { return Vector3d::Unit(i); };
        const Matrix3d here = stress(Vector3d::Zero());
        Vector3d divergence = Vector3d::Zero();
        Matrix3d laplacian = -6 * here, bend;
        for (int i = 0; i < 3; ++i) {
            const Matrix3d ahead = stress(unit(i)), behind = stress(-unit(i));
            divergence += (ahead - behind).col(i) / (2 * h);
            laplacian += ahead + behind;
            for (int j = 0; j < 3; ++j) {
                bend(i, j) = i == j ? (ahead + behind - 2 * here).trace()
                                    : (stress(unit(i) + unit(j)) - stress(unit(i) - unit(j)) -
                                       stress(unit(j) - unit(i)) + stress(-unit(i) - unit(j)))
                                              .trace() /
                                          4;
            }
        }
        CAPTURE(nu, at[0]);
        CHECK(divergence.cwiseAbs().maxCoeff() < 2e-4);
        CHECK((laplacian + bend / (1 + nu)).cwiseAbs().maxCoeff() / (h * h) < 2e-3);  // Beltrami and Michell
    }
}

TEST_CASE("Stresses are the tractions just below the surface, and the stresses of their sum far below",
          "[subsurface]") {
    const Matrix3d under = subsurface_stress(loads, 0.28, {0.1, 0.2, 1e-9});
    CHECK(under(0, 2) == Approx(-0.3).epsilon(1e-7));
    CHECK(under(1, 2) == Approx(0.8).epsilon(1e-7));
    CHECK(under(2, 2) == Approx(-1).epsilon(1e-7));
    CHECK(subsurface_stress(loads, 0.28, {3, 2, 1e-9}).col(2).norm() < 1e-7);
    // Boussinesq: sigma_zz = -3P/(2 pi z^2) below a force
    const double P = 1.5 * 1.6 + 0.5 * 0.7 * 1.3;
    CHECK(subsurface_stress(loads, 0.28, {0, 0, 300})(2, 2) * 300 * 300 ==
          Approx(-3 * P / (2 * std::numbers::pi)).epsilon(5e-3));
}

TEST_CASE("Hertz's round contact yields where textbooks say", "[subsurface]") {
    const Yield::Peak round = subsurface_peak(sphere(80), 0.3, {0, 0}, 2);
    CHECK(round.tresca == Approx(0.310).margin(1e-3));
    CHECK(round.tresca_depth == Approx(0.481).margin(2e-3));
    CHECK(round.von_mises == Approx(2 * round.tresca).epsilon(1e-6));  // sigma_xx = sigma_yy
    CHECK(subsurface_stress(sphere(80), 0.3, {1e-6, 1e-6, 1e-3})(0, 0) == Approx(-0.8).margin(5e-3));
}

TEST_CASE("Both measures of yield have their largest values at depths of their own", "[subsurface]") {
    const std::vector<Yield::LoadedRectangle> band{{-1, 1, -4, 4, 0, 0, 1}};
    const auto at = [&](double z) { return Yield::of(subsurface_stress(band, 0.3, {0.3, 0, z})); };
    const Yield::Peak peak = subsurface_peak(band, 0.3, {0.3, 0}, 3);
    CHECK(at(peak.tresca_depth).tresca == Approx(peak.tresca).epsilon(1e-9));
    CHECK(at(peak.von_mises_depth).von_mises == Approx(peak.von_mises).epsilon(1e-9));
    for (const double factor : {0.98, 1.02}) {
        CHECK(at(factor * peak.tresca_depth).tresca < peak.tresca);
        CHECK(at(factor * peak.von_mises_depth).von_mises < peak.von_mises);
    }
    CHECK(peak.tresca_depth > 1.03 * peak.von_mises_depth);
    CHECK(Yield::of(Vector3d(1, 2, 4).asDiagonal()).tresca == Approx(1.5));
}

TEST_CASE("Below a loaded square stresses are CONTACT's", "[subsurface]") {
    // its example subsurf, case 2: depth, von Mises, sigma_xx, sigma_xz, sigma_yy, sigma_zz
    const std::vector<Yield::LoadedRectangle> square{{-0.4999, 0.5001, -0.4998, 0.5002, 0.999, 0, 1}};
    for (const auto& [z, von_mises, xx, xz, yy, zz] :
         {std::array{0.1, 1.34868, -0.555944, -0.736402, -0.556100, -0.994287},
          {0.5, 0.676093, -7.6184e-2, -0.149363, -7.6223e-2, -0.700842},
          {1.0, 0.342630, 3.9769e-3, -2.4183e-2, 3.9711e-3, -0.336086},
          {5.0, 2.0110e-2, 1.3245e-3, -6.1810e-5, 1.3245e-3, -1.8785e-2}}) {
        const Matrix3d stress = subsurface_stress(square, 0.28, {1e-5, 1e-5, z});
        CHECK(Yield::of(stress).von_mises == Approx(von_mises).epsilon(1e-5));
        CHECK(stress(0, 0) == Approx(xx).epsilon(1e-4));
        CHECK(stress(0, 2) == Approx(xz).epsilon(1e-4));
        CHECK(stress(1, 1) == Approx(yy).epsilon(1e-4));
        CHECK(stress(2, 2) == Approx(zz).epsilon(1e-4));
    }
}

TEST_CASE("Stresses refuse what they cannot take", "[subsurface]") {
    CHECK(refusal([] {
              subsurface_stress(loads, 0.28, {0, 0, 0});
          }) == "subsurface_stress: z = 0 must be positive and finite");
    CHECK(refusal([] {
              subsurface_stress(loads, 0.6, {0, 0, 1});
          }) == "subsurface_stress: poisson_ratio = 0.6 must lie in [0, 0.5]");
}

}  // namespace
}  // namespace subsurface_stress_tests
