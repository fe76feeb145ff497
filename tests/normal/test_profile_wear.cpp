// rollbem/normal/profile_wear.hpp
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/profile_wear.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace profile_wear_tests {
namespace {

using namespace rollbem;
using Use = Profile::Use;

const std::vector<std::pair<Profile, Use>>& bodies() {
    static const std::vector<std::pair<Profile, Use>> both{{s1002(), Use::wheel}, {rail_60e1(), Use::rail}};
    return both;
}

/// An arc of a circle about (0, z), from -angle to angle, as a hill or as a hollow.
Profile arc(double radius, double angle, bool hill, Eigen::Index n) {
    const Eigen::ArrayXd at = Eigen::ArrayXd::LinSpaced(n, -angle, angle);
    return {radius * at.sin(), (hill ? -radius : radius) * at.cos(), Use::piece};
}

TEST_CASE("Uniform depth gives the parallel curve", "[profile]") {
    for (const auto& [profile, body] : bodies()) {
        for (const double depth : {1e-5, 1e-3}) {
            const Profile after = worn(profile, Eigen::ArrayXd::Constant(profile.size(), depth), body);
            CHECK((depth_between(profile, after, body) - depth).abs().maxCoeff() < 1e-9);
            CHECK(after.size() == profile.size());
            // shares of the length stay, so that points do not crowd
            const Eigen::ArrayXd shares = after.s() / after.length() - profile.s() / profile.length();
            CHECK(shares.abs().maxCoeff() < 1e-4);
        }
    }
    // a rail's hill and a wheel's lose radius, hollows gain it; between the points, too
    for (const bool hill : {true, false}) {
        const Profile before = arc(0.02, 1, hill, 120);
        const Eigen::ArrayXd depth = Eigen::ArrayXd::Constant(before.size(), 2e-3);
        const Profile after = worn(before, depth, hill ? Use::rail : Use::wheel),
                      other = worn(before, depth, hill ? Use::wheel : Use::rail);
        for (double s = 0; s < after.length(); s += 1e-4) {
            const Profile::Point p = after.at(s), q = other.at(s / after.length() * other.length());
            CHECK(std::abs(std::hypot(p.y, p.z) - 0.018) < 1e-9);
            CHECK(std::abs(std::hypot(q.y, q.z) - 0.022) < 1e-9);
        }
    }
}

TEST_CASE("Corners stay where both sides meet", "[profile]") {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(61, -0.03, 0.03);
    const Profile roof(y, y.abs());  // whose ridge points up, as a rail's
    REQUIRE(roof.corners() == std::vector<Eigen::Index>{30});
    const Profile after = worn(roof, Eigen::ArrayXd::Constant(61, 1e-3), Use::rail);
    CHECK(after.corners() == roof.corners());
    CHECK((after.z() - after.y().abs() - std::sqrt(2) * 1e-3).abs().maxCoeff() < 1e-12);
    CHECK(std::abs(after.y()[30]) < 1e-15);
}

TEST_CASE("The worn area is the sum of the areas", "[profile]") {
    for (const auto& [profile, body] : bodies()) {
        for (const double y : {-0.03, -0.01, 0.01}) {
            for (const double most : {1e-6, 1e-4, 5e-4}) {
                const Eigen::ArrayXd area = most * (-((profile.y() - y) / 5e-3).square()).exp();
                const Profile after = worn_by_area(profile, area, body);
                const double sum = (area * lengths_at_points(profile)).sum();
                CAPTURE(y, most, int(body));
                CHECK(area_between(profile, after, body) == Approx(sum).epsilon(1e-9));
                // half of it twice: the depth differs by the curvature that it adds
                const Profile half = worn_by_area(profile, area / 2, body);
                CHECK((depth_between(profile, half, body).maxCoeff() * 2) ==
                      Approx(depth_between(profile, after, body).maxCoeff()).epsilon(2e-2));
            }
        }
        CHECK(area_between(profile, profile, body) == 0);
    }
    // in each place by its own radius: a head's corner of 13 mm, and its top of 300 mm
    const Profile head = rail_60e1(0);
    const Eigen::ArrayXd even =
        depth_between(head, worn_by_area(head, Eigen::ArrayXd::Constant(head.size(), 2e-4), Use::rail), Use::rail);
    for (const auto& [y, radius] : {std::pair{-31e-3, 13e-3}, {0.0, 0.3}}) {
        Eigen::Index i = 0;
        (head.y() - y).abs().minCoeff(&i);
        CHECK(even[i] == Approx(radius - std::sqrt(radius * radius - 2 * radius * 2e-4)).epsilon(1e-4));
    }
    // a ring: the depth of its area per length
    const Profile hill = arc(0.02, 1, true, 200);
    const Profile after = worn_by_area(hill, Eigen::ArrayXd::Constant(200, 1e-3), Use::rail);
    CHECK(std::hypot(after.y()[100], after.z()[100]) == Approx(std::sqrt(4e-4 - 4e-5)).epsilon(1e-6));
}

TEST_CASE("What cannot be worn is refused", "[profile]") {
    const Profile hill = arc(0.005, 1, true, 60);
    const auto depth = [](double value) { return Eigen::ArrayXd::Constant(60, value); };
    CHECK(refusal([&] { worn(hill, depth(6e-3), Use::rail); }).starts_with("worn: depth = 0.006 m at y = "));
    CHECK(refusal([&] { worn(hill, depth(4e-3), Use::rail); }).empty());
    CHECK(refusal([&] { worn(hill, depth(1e-3), Use::piece); }) ==
          "worn: body = piece must be a wheel or a rail, which says where it wears");
    CHECK(refusal([&] { worn(hill, depth(-1e-3), Use::rail); }) ==
          "worn: depth = -0.001 must be finite and not negative");
    CHECK(refusal([&] { worn(hill, depth(1e-3).head(59), Use::rail); }) ==
          "worn: number of depths = 59 must be the number of points");
    CHECK(refusal([&] { refined(hill, 0); }) == "refined: spacing = 0 must be finite and at least 1e-6 m");
}

TEST_CASE("Further points lie on the curve", "[profile]") {
    for (const auto& [profile, body] : bodies()) {
        const Profile fine = refined(profile, 3e-5);
        CHECK((fine.s().tail(fine.size() - 1) - fine.s().head(fine.size() - 1)).maxCoeff() < 3.01e-5);
        CHECK(depth_between(profile, fine, body).abs().maxCoeff() < 1e-15);
        CHECK(std::abs(area_between(profile, fine, body)) < 1e-12);
    }
}

TEST_CASE("Sizes of flanges and heads", "[profile]") {
    const Profile::FlangeSizes sizes = flange_sizes(s1002());
    CHECK(sizes.height == Approx(28e-3).margin(1e-6));
    CHECK(sizes.thickness == Approx(32.5e-3).margin(1e-5));
    CHECK(sizes.qr == Approx(10.79e-3).margin(1e-5));
    const Profile::FlangeSizes from_back = flange_sizes(s1002().moved(0, 0.07, 0), 0);
    CHECK(from_back.thickness == Approx(sizes.thickness).epsilon(1e-12));
    // a tread that loses 1 mm has a higher flange, measured where it is thicker
    const Profile tread = worn(s1002(), (1e-3 / (1 + ((-20e-3 - s1002().y()) / 1e-3).exp())).eval(), Use::wheel);
    const Profile::FlangeSizes hollow = flange_sizes(tread);
    CHECK(hollow.height == Approx(29e-3).margin(2e-6));
    CHECK(hollow.thickness > sizes.thickness);
    CHECK(std::isnan(flange_sizes(arc(0.02, 1, false, 50), 0.07 - 0.05).height));

    const Profile rail = rail_60e1();
    const Profile::RailWear wear = rail_wear(rail, rail.moved(0, 3e-4, 2e-4), 0.014);
    CHECK(wear.vertical == Approx(2e-4).margin(1e-6));
    // 2e-4 deeper on a side that leans by 1:20 and 1:40
    CHECK(wear.side == Approx(3e-4 - 2e-4 * std::tan(std::atan(0.05) + std::atan(0.025) - 0.1)).margin(3e-5));
    CHECK(std::isnan(rail_wear(rail, rail, 0.1).side));
}

/// Checks that a worn S1002, moved by these, comes back within `most` [m], and returns the motion that is found.
Profile::Alignment check_return(const Profile& hollow, double angle, double dy, double dz, double most) {
    const Profile moved = hollow.moved(angle, dy, dz);
    const Profile::Alignment found = align(moved, s1002(), unworn_parts(s1002(), Use::wheel), angle != 0);
    const Profile back = moved.moved(found.angle, found.dy, found.dz);
    CAPTURE(angle, dy, found.angle, found.dy, found.dz, found.residual, found.share);
    CHECK((back.y() - hollow.y()).abs().maxCoeff() < most);
    CHECK((back.z() - hollow.z()).abs().maxCoeff() < most);
    return found;
}

TEST_CASE("A worn wheel comes back to where it was", "[profile]") {
    const Profile wheel = s1002();
    const Eigen::ArrayXd &y = wheel.y(),
                         tread = (-(y / 14e-3).pow(8)).exp() + (-((y - 48e-3) / 4e-3).pow(8)).exp();  // and beside it
    const Profile hollow = worn(wheel, 2e-3 * tread, Use::wheel);
    for (const auto& [angle, dy, dz] :
         {std::array{0.0, 0.0, 0.0}, {0.0, 3e-3, -1e-3}, {0.0, 0.07, 0.0}, {5e-3, -2e-3, 1e-3}}) {
        const Profile::Alignment found = check_return(hollow, angle, dy, dz, 2e-6);
        CHECK(found.residual < 2e-6);
        CHECK(found.share < 0.9);
    }
}

TEST_CASE("More than half of a tread may be worn unevenly", "[profile]") {
    const Profile wheel = s1002();
    const auto [from, to] = unworn_parts(wheel, Use::wheel)[1];
    const double middle = from + 0.3 * (to - from);  // of wear over three fifths of the part
    const Eigen::ArrayXd tread = (-((wheel.y() - middle) / (0.26 * (to - from))).square()).exp();
    const Profile hollow = worn(wheel, 2e-3 * tread, Use::wheel);
    for (const double angle : {0.0, 4e-3}) check_return(hollow, angle, 2e-3, -1e-3, 2e-5);
}

TEST_CASE("A worn rail comes back, and what does not fix it is refused", "[profile]") {
    const Profile rail = extended(rail_60e1(0), 15e-3);
    const Profile head = worn(rail, (5e-3 * (-(rail.z() / 14e-3).pow(8)).exp()).eval(), Use::rail);
    const auto parts = unworn_parts(rail, Use::rail);
    const Profile::Alignment found = align(head.moved(0, 2e-3, -1e-3), rail, parts);
    CHECK(found.dy == Approx(-2e-3).margin(1e-7));
    CHECK(found.dz == Approx(1e-3).margin(2e-6));
    const auto refused = [&](const std::vector<std::array<double, 2>>& fixed) {
        return refusal([&] { align(rail, rail, fixed); });
    };
    CHECK(refused({{-0.005, 0.005}}).starts_with("align: least share of the parts' normals"));
    CHECK(refused({{-0.05, -0.04}, {0, 0.01}}).starts_with("align: part y = -0.05 to -0.04"));
    CHECK(refused({{0.01, -0.01}}) == "align: end of a part = -0.01 must lie above its begin");
    CHECK(
        refusal([&] { unworn_parts(rail_60e1(0), Use::rail); }).starts_with("align: reference = without sides 20 mm"));
}

}  // namespace
}  // namespace profile_wear_tests
