// rollbem/normal/profile.hpp
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include <rollbem/normal/profile.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

const double pi = std::numbers::pi;

Profile through(const std::vector<double>& y, const std::vector<double>& z) {
    return {Eigen::ArrayXd::Map(y.data(), Eigen::Index(y.size())),
            Eigen::ArrayXd::Map(z.data(), Eigen::Index(z.size()))};
}

/// A top 40 mm wide and a side 20 mm high, by points 0.5 mm apart.
Profile right_angle() {
    std::vector<double> y, z;
    for (int i = 0; i <= 80; ++i) {
        y.push_back(0.5e-3 * i);
        z.push_back(0);
    }
    for (int i = 1; i <= 40; ++i) {
        y.push_back(40e-3);
        z.push_back(0.5e-3 * i);
    }
    return through(y, z);
}

/// A straight line along y with a wave in z, of this length and amplitude 1 um, by points as unequal as 1 to 3.
Profile wave(double length, double step) {
    std::vector<double> y, z;
    for (double at = 0; at < 0.2; at += step * (1 + 0.5 * std::sin(400 * at))) {
        y.push_back(at);
        z.push_back(1e-6 * std::sin(2 * pi * at / length));
    }
    return through(y, z);
}

TEST_CASE("profile: the curve goes through its points, smoothly", "[profiles]") {
    const Profile profile = through({0, 1e-3, 2e-3, 4e-3, 5e-3, 5.5e-3}, {0, .5e-3, 0, 1e-3, .8e-3, 1.5e-3});
    REQUIRE(profile.corners().empty());
    for (Eigen::Index i = 0; i < profile.size(); ++i) {
        const double s = profile.s()[i], h = 1e-12;
        CAPTURE(i);
        CHECK(profile.at(s).y == Approx(profile.y()[i]).margin(1e-17));
        CHECK(profile.at(s).z == Approx(profile.z()[i]).margin(1e-17));
        CHECK(profile.at(s + h).slope[1] == Approx(profile.at(s - h).slope[1]).margin(1e-7));
        CHECK(profile.at(s + h).bend[1] == Approx(profile.at(s - h).bend[1]).margin(1e-4));
    }
}

TEST_CASE("profile: a corner parts two curves, each with its own slope", "[profiles]") {
    const Profile profile = right_angle();
    REQUIRE(profile.corners() == std::vector<Eigen::Index>{80});
    const double corner = profile.s()[80];
    CHECK(profile.at(corner - 1e-9).slope[0] == Approx(1).margin(1e-12));
    CHECK(profile.at(corner - 1e-9).slope[1] == Approx(0).margin(1e-12));
    CHECK(profile.at(corner).slope[0] == Approx(0).margin(1e-12));
    CHECK(profile.at(corner).slope[1] == Approx(1).margin(1e-12));
    // so neither side knows of the other
    for (const double s : {0.0371, 0.0396, 0.03999}) CHECK(std::abs(profile.at(s).z) < 1e-15);
    for (const double s : {0.04001, 0.0402, 0.0577}) CHECK(profile.at(s).y == Approx(0.04).margin(1e-15));
    CHECK(profile.moved(0.3, 1, 2).corners() == profile.corners());
    CHECK(profile.mirrored().corners() == std::vector<Eigen::Index>{40});
}

TEST_CASE("profile: splines end at corners without a second derivative", "[profiles]") {
    // a groove of radius 10 mm, 16 mm wide, in a plane
    std::vector<double> y, z;
    const auto plane = [&](double from, double to) {
        for (int i = 0; i <= 20; ++i) {
            y.push_back(1e-3 * (from + (to - from) * i / 20));
            z.push_back(0);
        }
    };
    plane(-20, -8);
    const double edge = std::asin(0.8);
    for (int i = -39; i < 40; ++i) {
        y.push_back(10e-3 * std::sin(edge * i / 40));
        z.push_back(10e-3 * (std::cos(edge * i / 40) - 0.6));
    }
    plane(8, 20);
    const Profile groove = through(y, z);
    REQUIRE(groove.corners() == std::vector<Eigen::Index>{20, 100});
    for (const Eigen::Index corner : groove.corners()) {
        const double s = groove.s()[corner];
        for (const double beside : {s - 1e-12, s + 1e-12}) CHECK(std::abs(groove.at(beside).bend[1]) < 1e-3);
    }
    for (Eigen::Index i = 1; i + 1 < groove.size(); ++i) {
        if (i == 20 || i == 100) continue;
        CAPTURE(i);
        const double s = groove.s()[i];
        CHECK(groove.at(s + 1e-12).slope[1] == Approx(groove.at(s - 1e-12).slope[1]).margin(1e-8));
    }
    // the arc: exact to the error of natural ends, h^2/(12 R), which fades within a few points
    const double start = groove.s()[20], length = groove.s()[100] - start;
    for (const double share : {0.004, 0.03, 0.5, 0.97}) {
        const Profile::Point at = groove.at(start + share * length);
        CAPTURE(share);
        CHECK(std::hypot(at.y, at.z + 6e-3) == Approx(10e-3).margin(share == 0.5 ? 1e-10 : 5e-7));
    }
}

TEST_CASE("profile: a corner turns by more than 30 degrees and is alone within 2 mm", "[profiles]") {
    struct Scene {
        const char* what;
        double turn, other, distance;  // degrees and mm
        std::size_t corners;
    };
    const auto scene = GENERATE(values<Scene>({{"below the threshold", 29, 0, 1, 0},
                                               {"above it", 31, 0, 1, 1},
                                               {"the other way", -31, 0, 1, 1},
                                               {"beside a small turn", 31, 5.9, 1, 1},
                                               {"beside a larger one", 31, 6.1, 1, 0},
                                               {"beside a larger one backwards", 31, -6.1, -1, 0},
                                               {"beside a larger one farther away", 31, 6.1, 2.1, 1},
                                               {"beside a larger one farther away backwards", 31, 6.1, -2.1, 1},
                                               {"nearly folded", 149, 0, 1, 1}}));
    INFO(scene.what);
    std::vector<double> y{-5e-3}, z{0};
    const auto go = [&](double mm, double degrees) {
        y.push_back(y.back() + 1e-3 * mm * std::cos(degrees * pi / 180));
        z.push_back(z.back() + 1e-3 * mm * std::sin(degrees * pi / 180));
    };
    const double distance = std::abs(scene.distance);
    if (scene.distance < 0) {
        go(5, 0);
        go(distance, scene.other);
        go(20, scene.other + scene.turn);
    } else {
        go(15, 0);
        go(distance, scene.turn);
        go(5, scene.turn + scene.other);
    }
    CHECK(through(y, z).corners().size() == scene.corners);
}

TEST_CASE("profile: points must follow a curve", "[profiles]") {
    struct Refused {
        std::vector<double> y, z;
        const char* message;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto scene = GENERATE_COPY(values<Refused>(
        {{{0, 1, 2}, {0, 0, 0}, "number of points = 3 must be at least 4"},
         {{0, 1, 2, 3}, {0, 0, 0}, "number of z = 3 must equal"},
         {{0, 1, 1, 2}, {0, 0, 0, 0}, "point = 3 must be that of a point"},
         {{0, 1, 0.5, 2}, {0, 0, 0, 0}, "point = 2 must be that of a point that must not turn the curve back"},
         {{0, 1, nan, 2}, {0, 0, 0, 0}, "point = 3 must be that of a point that must be finite"},
         {{0, 1, 2, 3}, {0, nan, 0, 0}, "point = 2 must be"},
         {{0, 1, 1, 0}, {0, 0, 1, 1}, "y from one end to the other"}}));
    CHECK_THAT(refusal([&] { through(scene.y, scene.z); }), ContainsSubstring(scene.message));
}

TEST_CASE("profile: the order of the points, motions and mirrors change no shape", "[profiles]") {
    const Profile exact = rail_60e1();
    const Profile reversed(exact.y().reverse(), exact.z().reverse());
    const Profile moved = exact.moved(0.7, 0.01, -0.02), mirrored = exact.mirrored();
    for (const double s : {0.01, 0.0233, 0.04, 0.07}) {
        CAPTURE(s);
        const Profile::Point at = exact.at(s), of_moved = moved.at(s), of_mirror = mirrored.at(exact.length() - s);
        CHECK(reversed.at(s).z == Approx(at.z).margin(1e-15));
        CHECK(of_moved.y == Approx(std::cos(0.7) * at.y - std::sin(0.7) * at.z + 0.01).margin(1e-15));
        CHECK(of_moved.z == Approx(std::sin(0.7) * at.y + std::cos(0.7) * at.z - 0.02).margin(1e-15));
        CHECK(of_moved.slope[1] == Approx(std::sin(0.7) * at.slope[0] + std::cos(0.7) * at.slope[1]));
        CHECK(of_moved.bend[1] == Approx(std::sin(0.7) * at.bend[0] + std::cos(0.7) * at.bend[1]).margin(1e-9));
        CHECK(of_mirror.y == Approx(-at.y).margin(1e-15));
        CHECK(of_mirror.z == Approx(at.z).margin(1e-15));
        CHECK(of_mirror.slope[0] == Approx(at.slope[0]));
        CHECK(of_mirror.slope[1] == Approx(-at.slope[1]).margin(1e-12));
    }
    // a turn by more than 90 degrees keeps the order, too
    CHECK(exact.moved(3, 0, 0).at(0).y == Approx(std::cos(3) * exact.y()[0] - std::sin(3) * exact.z()[0]));
    CHECK_THAT(refusal([&] { exact.moved(NAN, 0, 0); }), ContainsSubstring("angle = nan must be finite"));
}

TEST_CASE("profile: a piece stays one", "[profiles]") {
    const Profile rail = rail_60e1(), piece(rail.y(), rail.z(), Profile::Use::piece);
    CHECK_FALSE(rail.is_piece());
    CHECK(piece.is_piece());
    CHECK(piece.moved(0.1, 0, 0).is_piece());
    CHECK(piece.mirrored().is_piece());
    CHECK(piece.smoothed(5e-3).is_piece());
    CHECK_FALSE(rail.smoothed(5e-3).is_piece());
}

TEST_CASE("profile: smoothing halves waves of its length, however points are spaced", "[profiles]") {
    const double length = GENERATE(5e-3, 10e-3, 20e-3, 40e-3), step = GENERATE(1e-4, 2.5e-4);
    CAPTURE(length, step);
    const Profile rough = wave(length, step), smooth = rough.smoothed(10e-3);
    // the amplitude at the wave's length, away from the ends
    double sine = 0, norm = 0;
    for (Eigen::Index i = 0; i < smooth.size(); ++i) {
        if (rough.y()[i] < 0.06 || rough.y()[i] > 0.14) continue;
        const double phase = std::sin(2 * pi * rough.y()[i] / length);
        sine += smooth.z()[i] * phase;
        norm += 1e-6 * phase * phase;
    }
    CHECK(sine / norm == Approx(1 / (1 + std::pow(10e-3 / length, 4))).margin(4e-3));
}

TEST_CASE("profile: smoothing keeps corners and arcs and takes noise away", "[profiles]") {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0, 3e-6);
    const auto noisy = [&](const Profile& profile) {
        Eigen::ArrayXd y = profile.y(), z = profile.z();
        for (double& value : y) value += normal(random);
        for (double& value : z) value += normal(random);
        return Profile(y, z);
    };
    const auto farthest = [](const Profile& one, const Profile& other) {
        return ((one.y() - other.y()).square() + (one.z() - other.z()).square()).sqrt().maxCoeff();
    };
    const Profile corner = right_angle();
    const Profile smooth = noisy(corner).smoothed(8e-3);
    REQUIRE(smooth.corners() == corner.corners());
    CHECK(farthest(smooth, corner) < 8e-6);

    // where the curvature jumps by k the curve moves by about 0.2 k (8 mm/2 pi)^2, and the arc of 13 mm keeps its
    // radius
    const Profile rail = rail_60e1(0);
    CHECK(farthest(rail.smoothed(8e-3), rail) < 25e-6);
    const auto bend = [](const Profile& of, double s) { return std::hypot(of.at(s).bend[0], of.at(s).bend[1]); };
    const double middle = rail.length() / 2, gauge_corner = middle + 40e-3;
    CHECK(bend(rail, gauge_corner) == Approx(1 / 13e-3).epsilon(1e-3));
    CHECK(bend(rail.smoothed(8e-3), gauge_corner) == Approx(1 / 13e-3).epsilon(0.03));
    CHECK(bend(rail.smoothed(8e-3), middle) == Approx(1 / 0.3).epsilon(0.03));
    CHECK(bend(noisy(rail), middle) > 100);
    CHECK(bend(noisy(rail).smoothed(8e-3), middle) < 8);

    CHECK_THAT(refusal([&] { rail.smoothed(0); }), ContainsSubstring("wave_length = 0 must be positive"));
}

TEST_CASE("standard profiles: rails are as wide as their standards say, and their arcs touch", "[profiles]") {
    struct Rail {
        Profile (*canted)(double cant);
        double depth, width, joint_80, joint_13;  // mm
    };
    const Rail of = GENERATE(values<Rail>({{rail_uic60, 14.3, 72.004, 10.5, 25.988},
                                           {rail_60e1, 14.3, 72, 10.228, 26.0265},
                                           {rail_54e1, 14.1, 70, 10.012, 24.8635}}));
    CAPTURE(of.width);
    const Profile profile = of.canted(0);
    CHECK(profile.corners().empty());
    // both sides at the depth, and the slope and radius about each joint
    const auto length_at = [&](auto&& below) {
        double low = profile.length() / 2, high = profile.length();
        for (int k = 0; k < 60; ++k) {
            const double middle = (low + high) / 2;
            (below(profile.at(middle)) ? low : high) = middle;
        }
        return low;
    };
    const double side = length_at([&](const Profile::Point& at) { return at.z < 1e-3 * of.depth; });
    CHECK(2e3 * profile.at(side).y == Approx(of.width).margin(1.2e-3));
    CHECK(profile.at(side + 1e-3).slope[1] / profile.at(side + 1e-3).slope[0] == Approx(20).epsilon(1e-4));
    for (const double joint : {of.joint_80, of.joint_13}) {
        const double at = length_at([&](const Profile::Point& point) { return point.y < 1e-3 * joint; });
        const auto radius = [&](double s) { return 1e3 / std::hypot(profile.at(s).bend[0], profile.at(s).bend[1]); };
        CHECK(radius(at - 0.7e-3) == Approx(joint == of.joint_80 ? 300 : 80).epsilon(5e-3));
        CHECK(radius(at + 0.7e-3) == Approx(joint == of.joint_80 ? 80 : 13).epsilon(5e-3));
    }
}

TEST_CASE("standard profiles: UIC 60 by the centres of its arcs", "[profiles]") {
    // R 80 about (7.7, 80.1348), R 13 about (23.0162, 14.9090)
    const Profile rail = rail_uic60(0);
    for (Eigen::Index i = 0; i < rail.size(); ++i) {
        const double y = 1e3 * std::abs(rail.y()[i]), z = 1e3 * rail.z()[i];
        CAPTURE(y);
        if (y > 10.6 && y < 25.9) CHECK(std::hypot(y - 7.7, z - 80.1348) == Approx(80).margin(1e-9));
        if (y > 26.1 && y < 35.9) CHECK(std::hypot(y - 23.0162, z - 14.9090) == Approx(13).margin(1e-9));
    }
}

TEST_CASE("standard profiles: a canted rail's highest point is its origin", "[profiles]") {
    const Profile rail = rail_54e1(0.05);
    double highest = 1;
    for (double s = 0; s < rail.length(); s += 1e-5) highest = std::min(highest, rail.at(s).z);
    CHECK(highest == Approx(0).margin(1e-9));
    CHECK(rail.at(rail.length()).z < rail.at(0).z);
}

}  // namespace
