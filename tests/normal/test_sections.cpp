// rollbem/normal/surface.hpp
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/surface.hpp>

#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Interpolation = Sections::Interpolation;

/// An arch 40 mm wide and 2 mm high, scaled in y and moved in z.
Profile arch(double scale, double z) {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(81, -0.02, 0.02);
    return {scale * y, 5 * y.square() + z, Profile::Use::piece};
}

std::vector<Sections::Section> arches(const std::vector<double>& u, double (*scale)(double), double (*z)(double)) {
    std::vector<Sections::Section> sections;
    for (const double at : u) sections.push_back({at, arch(scale(at), z(at))});
    return sections;
}

const std::vector<double> unequal{0, 0.01, 0.025, 0.03, 0.05, 0.06, 0.08, 0.085};
const std::vector<double> equal{0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07};

double one(double) { return 1; }

TEST_CASE("sections: derivatives differentiate the points, which are smooth in u", "[profiles]") {
    const Interpolation how = GENERATE(Interpolation::through, Interpolation::spline);
    std::vector<Sections::Section> list;
    for (const double at : unequal) {
        const Profile turned = rail_60e1().moved(5 * at, at * at, std::sin(60 * at) / 100);
        list.push_back({at, turned, {1e-3 + 0.1 * at, 0.03 + at / 10, 0.08, 0.2}});
    }
    const Sections sections(list, how);
    REQUIRE(sections.parts() == 3);
    const double h = 1e-7;
    for (std::size_t part = 0; part < 3; ++part) {
        for (const double share : {0.05, 0.31, 0.77}) {
            const double s = share * sections.length(part);
            for (const double u : {0.0007, 0.012, 0.0271, 0.055, 0.0849}) {
                CAPTURE(part, share, u);
                const Sections::Point at = sections.at(part, s, u);
                const auto check = [&](const std::array<double, 2>& by, const Sections::Point& to,
                                       const Sections::Point& from) {
                    CHECK(by[0] == Approx((to.y - from.y) / (2 * h)).margin(1e-6));
                    CHECK(by[1] == Approx((to.z - from.z) / (2 * h)).margin(1e-6));
                };
                check(at.by_s, sections.at(part, s + h, u), sections.at(part, s - h, u));
                check(at.by_u, sections.at(part, s, u + h), sections.at(part, s, u - h));
            }
            for (const double u : {0.01, 0.025, 0.03, 0.05, 0.06, 0.08}) {  // C1 at sections
                CAPTURE(part, share, u);
                const Sections::Point before = sections.at(part, s, u - 1e-12), after = sections.at(part, s, u);
                CHECK(after.z == Approx(before.z).margin(1e-11));
                for (const std::size_t k : {0, 1}) CHECK(after.by_u[k] == Approx(before.by_u[k]).margin(1e-8));
            }
        }
    }
}

TEST_CASE("sections: a surface goes through its sections, at equal shares of each part", "[profiles]") {
    std::vector<Sections::Section> list;
    for (const double at : unequal) list.push_back({at, arch(1 + at, at), {0, 0.011 + at / 10, 0.03, 1}});
    const Sections sections(list, Interpolation::through);
    for (const Sections::Section& section : list) {
        for (std::size_t part = 0; part < 3; ++part) {
            const double from = section.features[part],
                         to = std::min(section.features[part + 1], section.profile.length());
            for (const double share : {0.0, 0.4, 1.0}) {
                const Profile::Point exact = section.profile.at(from + share * (to - from));
                const Sections::Point at = sections.at(part, share * sections.length(part), section.u);
                CAPTURE(section.u, part, share);
                CHECK(at.y == Approx(exact.y).margin(1e-14));
                CHECK(at.z == Approx(exact.z).margin(1e-14));
                CHECK(std::hypot(at.by_s[0], at.by_s[1]) == Approx((to - from) / sections.length(part)).epsilon(1e-2));
            }
        }
    }
    CHECK(sections.highest() == Approx(0).margin(1e-12));
    CHECK(sections.lowest() == Approx(2e-3 + 0.085));
}

TEST_CASE("sections: parabolas in u are exact with slopes by parabolas, lines with the B-spline", "[profiles]") {
    const Sections parabola(arches(unequal, one, [](double u) { return 3 * u * u - u / 5; }), Interpolation::through);
    const Sections ramp(arches(equal, one, [](double u) { return 0.1 * u; }), Interpolation::spline);
    const Profile flat = arch(1, 0);
    for (const double s : {0.003, 0.02, 0.037}) {
        for (double u = 0; u <= 0.07; u += 0.0013) {
            CAPTURE(s, u);
            const Sections::Point at = parabola.at(0, s, u), of_ramp = ramp.at(0, s, u);
            CHECK(at.z - flat.at(s).z == Approx(3 * u * u - u / 5).margin(1e-15));
            CHECK(at.by_u[1] == Approx(6 * u - 0.2).margin(1e-12));
            CHECK(of_ramp.z - flat.at(s).z == Approx(0.1 * u).margin(1e-15));
            CHECK(of_ramp.by_u[1] == Approx(0.1).margin(1e-12));
        }
    }
}

TEST_CASE("sections: the B-spline of equal steps agrees with a textbook", "[profiles]") {
    // (1, 4, 1)/6 at knots, (1, 23, 23, 1)/48 between, and (6 P_0)/6 at an end that goes on linearly
    const auto z = [](double u) { return std::cos(80 * u) / 100; };
    const Sections sections(arches(equal, one, z), Interpolation::spline);
    const double flat = arch(1, 0).at(0.01).z;
    const auto at = [&](double u) { return sections.at(0, 0.01, u).z - flat; };
    CHECK(at(0.03) == Approx((z(0.02) + 4 * z(0.03) + z(0.04)) / 6).margin(1e-14));
    CHECK(at(0.035) == Approx((z(0.02) + 23 * z(0.03) + 23 * z(0.04) + z(0.05)) / 48).margin(1e-14));
    CHECK(at(0) == Approx(z(0)).margin(1e-14));
    CHECK(at(0.07) == Approx(z(0.07)).margin(1e-14));
    CHECK(at(0.005) == Approx(((2 * z(0) - z(0.01)) + 23 * z(0) + 23 * z(0.01) + z(0.02)) / 48).margin(1e-14));
}

TEST_CASE("sections: the B-spline's weights add to one and its second derivative is continuous", "[profiles]") {
    const Sections sections(arches(unequal, one, [](double u) { return std::sin(50 * u) / 50; }),
                            Interpolation::spline);
    const Sections constant(arches(unequal, one, [](double) { return 0.01; }), Interpolation::spline);
    const double h = 1e-6;
    for (const double u : {0.01, 0.025, 0.03, 0.05, 0.06, 0.08}) {
        CAPTURE(u);
        const auto slope = [&](double at) { return sections.at(0, 0.01, at).by_u[1]; };
        const double before = (slope(u) - slope(u - h)) / h, after = (slope(u + h) - slope(u)) / h;
        CHECK(before == Approx(after).margin(0.02));
        CHECK(constant.at(0, 0.01, u + 0.002).z == Approx(arch(1, 0.01).at(0.01).z));
    }
}

TEST_CASE("sections: parts are interrupted where a feature is absent", "[profiles]") {
    const Interpolation how = GENERATE(Interpolation::through, Interpolation::spline);
    std::vector<Sections::Section> list;
    const auto z = [](double u) { return u > 0.045 ? 5 * (u - 0.05) * (u - 0.05) : 0.01 - 0.1 * u; };
    for (const double at : equal) {
        list.push_back({at, arch(1, z(at)), {0, at == 0.04 ? -1 : 0.02, 0.03}});
    }
    const Sections sections(list, how);
    REQUIRE(sections.parts() == 2);
    for (const std::size_t part : {0, 1}) {
        CAPTURE(part);
        for (const double u : {0.0, 0.0299, 0.03, 0.05, 0.07}) CHECK(sections.covers(part, u));
        for (const double u : {-1e-9, 0.0301, 0.04, 0.0499, 0.0701}) CHECK_FALSE(sections.covers(part, u));
    }
    // what lies beyond an interruption does not change its other side: a ramp before, a parabola after
    const double s = sections.length(0) / 2, flat = arch(1, 0).at(s).z;
    for (const double u : {0.001, 0.015, 0.0295}) {
        CHECK(sections.at(0, s, u).z - flat == Approx(z(u)).margin(1e-12));
        CHECK(sections.at(0, s, u).by_u[1] == Approx(-0.1).margin(1e-10));
    }
    if (how == Interpolation::through) {
        for (const double u : {0.0501, 0.058, 0.07}) CHECK(sections.at(0, s, u).z - flat == Approx(z(u)).margin(1e-12));
    }
    // not covered: the nearest place that is, without a slope
    CHECK(sections.at(0, s, 0.034).z == Approx(sections.at(0, s, 0.03).z));
    CHECK(sections.at(0, s, 0.034).by_u[1] == 0);
    CHECK(sections.at(0, s, 0.046).z == Approx(sections.at(0, s, 0.05).z));
    CHECK(sections.at(0, s, -1).z == Approx(sections.at(0, s, 0).z));
    CHECK(sections.at(0, s, 1).z == Approx(sections.at(0, s, 0.07).z));
}

TEST_CASE("sections: parts lie one behind the other along s", "[profiles]") {
    std::vector<Sections::Section> list;
    for (const double at : unequal) list.push_back({at, arch(1 + at, at), {0, 0.01, at == 0.03 ? -1 : 0.03, 1}});
    const Sections sections(list, Interpolation::through);
    CHECK(sections.length() == Approx(sections.length(0) + sections.length(1) + sections.length(2)));
    for (const double u : {0.004, 0.0271, 0.07}) {
        double start = 0;
        for (std::size_t part = 0; part < 3; ++part) {
            const double s = 0.3 * sections.length(part);
            CAPTURE(u, part);
            CHECK(sections.at(start + s, u).y == Approx(sections.at(part, s, u).y));
            CHECK(sections.at(start + s, u).by_s[1] == Approx(sections.at(part, s, u).by_s[1]));
            CHECK(sections.reaches(start + s, u) == (part == 0 || u != 0.0271));
            start += sections.length(part);
            if (part < 2 && u != 0.0271) {
                CHECK(sections.at(start - 1e-12, u).z == Approx(sections.at(start + 1e-12, u).z).margin(1e-11));
            }
        }
        CHECK(sections.at(-1e-3, u).y < sections.at(0, u).y);
        CHECK(sections.at(start + 1e-3, u).y > sections.at(start, u).y);
    }
}

TEST_CASE("sections: two are joined by straight lines", "[profiles]") {
    const Interpolation how = GENERATE(Interpolation::through, Interpolation::spline);
    const Sections sections({{0, arch(1, 0)}, {0.1, arch(1.2, 0.01)}}, how);
    const auto from = sections.at(0, 0.01, 0), to = sections.at(0, 0.01, 0.1), between = sections.at(0, 0.01, 0.03);
    CHECK(between.y == Approx(0.7 * from.y + 0.3 * to.y));
    CHECK(between.z == Approx(0.7 * from.z + 0.3 * to.z));
    CHECK(between.by_u[1] == Approx((to.z - from.z) / 0.1));
}

TEST_CASE("sections: the same from the other end", "[profiles]") {
    const Interpolation how = GENERATE(Interpolation::through, Interpolation::spline);
    const bool interrupted = GENERATE(false, true);
    std::vector<Sections::Section> list, reversed;
    for (const double at : unequal) {
        list.push_back({at, arch(1 + at, std::sin(50 * at) / 50), {0, interrupted && at == 0.03 ? -1 : 0.02}});
        reversed.insert(reversed.begin(), {-at, list.back().profile, list.back().features});
    }
    const Sections one(list, how), other(reversed, how);
    for (double u = 0; u < 0.0851; u += 0.0017) {
        CAPTURE(u);
        const Sections::Point at = one.at(0, 0.01, u), same = other.at(0, 0.01, -u);
        CHECK(same.y == Approx(at.y).margin(1e-14));
        CHECK(same.z == Approx(at.z).margin(1e-14));
        CHECK(same.by_u[1] == Approx(-at.by_u[1]).margin(1e-12));
    }
}

TEST_CASE("sections: turned and moved as a whole", "[profiles]") {
    const Sections sections(arches(unequal, one, [](double u) { return u * u; }), Interpolation::through);
    const Sections moved = sections.moved(0.4, 0.01, -0.02);
    const double c = std::cos(0.4), s = std::sin(0.4);
    for (const double u : {0.004, 0.03, 0.07}) {
        const Sections::Point at = sections.at(0, 0.013, u), to = moved.at(0, 0.013, u);
        CHECK(to.y == Approx(c * at.y - s * at.z + 0.01));
        CHECK(to.z == Approx(s * at.y + c * at.z - 0.02));
    }
}

TEST_CASE("sections: what cannot be a surface is refused", "[profiles]") {
    struct Scene {
        const char* what;
        std::vector<double> u;
        std::vector<std::vector<double>> features;
        const char* message;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto scene = GENERATE_COPY(values<Scene>({
        {"one", {0}, {{}}, "number of sections = 1 must be at least 2"},
        {"u falls", {0, 1, 0.5}, {{}, {}, {}}, "u of section 3 = 0.5 must be greater than u of the section before"},
        {"u twice", {0, 0}, {{}, {}}, "u of section 2 = 0"},
        {"no u", {0, nan}, {{}, {}}, "u of section 2 = nan must be finite"},
        {"numbers differ", {0, 1}, {{0, 0.01}, {0, 0.01, 0.02}}, "number of features of section 2 = 3 must equal"},
        {"one feature", {0, 1}, {{0}, {0}}, "number of features of section 1 = 1 must be 0 or at least 2"},
        {"features fall",
         {0, 1},
         {{0, 0.01}, {0.01, 0.005}},
         "length of a feature of section 2 = 0.005 must be greater"},
        {"twice beyond the end", {0, 1}, {{0, 0.01, 0.02}, {0, 1, 2}}, "length of a feature of section 2 = 2"},
        {"no feature", {0, 1}, {{0, nan}, {0, 0.01}}, "length of a feature of section 1 = nan must be finite"},
        {"a part never there", {0, 1, 2}, {{0, 0.01, -1}, {0, 0.01, 0.02}, {0, 0.01, -1}}, "number of the part = 2"},
    }));
    INFO(scene.what);
    std::vector<Sections::Section> list;
    for (std::size_t k = 0; k < scene.u.size(); ++k) list.push_back({scene.u[k], arch(1, 0), scene.features[k]});
    CHECK_THAT(refusal([&] { Sections(list, Interpolation::through); }), ContainsSubstring(scene.message));
}

}  // namespace
