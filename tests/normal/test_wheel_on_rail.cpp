// rollbem/normal/wheel_on_rail.hpp, vehicle/wheelset_on_track.hpp, vehicle/wheelset_forces.hpp
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/wear.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>
#include <rollbem/vehicle/detail/wheelset_velocity.hpp>

#include "support/catch.hpp"
#include "support/observed_order.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;

const WheelOnRail& standard() {
    static const WheelOnRail wheel(s1002(), rail_uic60());
    return wheel;
}

/// Rows of numbers of a file of bench/manchester; lines that begin otherwise are left out, as is the text `skip`.
std::vector<std::vector<double>> benchmark_rows(const char* file, const std::string& skip = "") {
    std::ifstream in(std::string(ROLLBEM_MANCHESTER "/") + file);
    std::vector<std::vector<double>> rows;
    for (std::string line; std::getline(in, line);) {
        if (line.substr(0, skip.size()) != skip) continue;
        std::istringstream cells(line.substr(skip.size()));
        std::vector<double>& row = rows.emplace_back();
        for (double value; cells >> value; cells.ignore()) row.push_back(value);
        if (row.empty()) rows.pop_back();
    }
    return rows;
}

Profile benchmark_profile(const char* file) {
    const auto rows = benchmark_rows(file);
    Eigen::ArrayXd y(Eigen::Index(rows.size())), z(y);
    for (Eigen::Index i = 0; i < y.size(); ++i) {
        y[i] = 1e-3 * rows[std::size_t(i)][0];
        z[i] = 1e-3 * rows[std::size_t(i)][1];
    }
    return {y, z - (std::string(file) == "rail.csv" ? z.minCoeff() : 0)};
}

/// The contact whose largest patch has the pressures N [N] over its plane: CONTACT's loads are N cos delta.
WheelOnRail::Contact under_normal_force(const WheelOnRail& wheel, const WheelsetPosition& position, double N,
                                        WheelOnRail::Workspace& workspace, const WheelOnRail::Options& options = {}) {
    double load = N;
    WheelOnRail::Contact contact;
    for (int k = 0; k < 8; ++k) {
        contact = wheel.solve_for_load(position, load, workspace, options);
        if (contact.patches.empty() || std::abs(contact.patches[0].load / N - 1) < 1e-5) break;
        load *= N / contact.patches[0].load;
    }
    return contact;
}

TEST_CASE("wheel_on_rail: contacts of the Manchester benchmark, S1002 on 60E1, against CONTACT", "[profiles]") {
    // Reference values of CONTACT v25.2 on its grid of 0.2 mm, with four digits; mm, N, MPa; left wheels are mirrored.
    // Areas consist of whole cells, and largest pressures and penetrations are taken at their centres, as in CONTACT.
    const WheelOnRail wheel(benchmark_profile("wheel.csv"), benchmark_profile("rail.csv"));
    const auto positions = benchmark_rows("positions.csv");
    struct Difference {
        double sum = 0, largest = 0;
        std::string where;
    };
    std::map<std::string, Difference> differences;
    int count = 0;
    WheelOnRail::Workspace workspace;
    for (const double side : {-1.0, 1.0}) {
        const auto references = benchmark_rows("contact.csv", side < 0 ? "left," : "right,");
        REQUIRE(references.size() == 21);
        for (std::size_t k = 0; k < 21; ++k) {
            if (side > 0 && k == 10) continue;  // CONTACT joins two contacts
            const std::vector<double>& ref = references[k];
            const double ref_angle = side * ref[4], ref_load = ref[6];
            WheelsetPosition position{side * positions[k][0], 0, side * positions[k][2], side * positions[k][1]};
            INFO((side < 0 ? "left " : "right ") << k);
            const auto add = [&](const char* quantity, double own, double reference) {
                Difference& of = differences[quantity];
                of.sum += std::abs(own - reference);
                if (std::abs(own - reference) < of.largest) return;
                of.largest = std::abs(own - reference);
                of.where = (side < 0 ? "left " : "right ") + std::to_string(k);
            };
            const auto contact = under_normal_force(wheel, position, ref_load, workspace);
            REQUIRE(has_numbers(contact.status));
            REQUIRE(contact.patches.size() == 1);
            const RailPatch& patch = contact.patches[0];
            add("x", 1e3 * patch.x, ref[1]);
            add("y", 1e3 * side * patch.y, ref[2]);
            add("z", 1e3 * patch.z, ref[3]);
            add("angle", patch.angle, ref_angle);
            add("height", 1e3 * contact.height, ref[5]);
            position.height = contact.height;
            const Creepage creepage = creepage_of(patch, position, {.forward = 2, .pitch_rate = positions[k][3]}, 0.46);
            add("longitudinal creepage", -creepage.longitudinal, ref[10]);
            add("lateral creepage", -side * creepage.lateral, ref[11]);
            add("spin", -side * creepage.spin * 1e-3, ref[12]);

            const auto squares = under_normal_force(wheel, position, ref_load, workspace, {.cell_size = 2e-4});
            REQUIRE(squares.patches.size() == 1);
            const RailPatch& coarse = squares.patches[0];
            add("area", 0.04 * double((coarse.pressure > 0).count()) / ref[9], 1);
            add("peak pressure", 1e-6 * coarse.pressure.maxCoeff() / ref[8], 1);
            add("approach", 1e3 * (coarse.wheel_n - coarse.rail_n).maxCoeff() / ref[7], 1);
            ++count;
        }
    }
    const auto within = [&](const char* quantity, double mean, double largest) {
        const Difference& of = differences[quantity];
        INFO(quantity << " at " << of.where);
        CHECK(of.sum / count < mean);
        CHECK(of.largest < largest);
    };
    REQUIRE(count == 41);
    within("x", 5e-4, 6e-3);
    within("y", 3e-4, 2e-3);
    within("z", 3e-4, 3e-3);
    within("angle", 4e-5, 2e-4);
    within("height", 2e-4, 6e-4);
    within("longitudinal creepage", 2e-6, 8e-6);
    within("lateral creepage", 5e-6, 2.5e-5);
    within("spin", 2e-7, 1e-6);
    within("area", 1e-3, 1e-2);
    within("peak pressure", 8e-4, 3e-3);
    within("approach", 6e-4, 3.2e-3);
}

// 4 s, so hidden
TEST_CASE("wheelset_forces: the largest difference from CONTACT vanishes on CONTACT's cells", "[.][profiles]") {
    const WheelOnRail wheel(benchmark_profile("wheel.csv"), benchmark_profile("rail.csv"));
    const auto position = benchmark_rows("positions.csv")[1];
    const std::vector<double> ref = benchmark_rows("contact.csv", "left,")[1];
    const double load = ref[6], limit = 0.3 * load, nu = wheel.dimensions().poisson_ratio;
    WheelOnRail::Workspace workspace;
    const auto contact = wheel.solve_for_load({-position[0], 0, -position[2], -position[1]}, load * std::cos(ref[4]),
                                              workspace, {.cell_size = 2e-4});
    const RailPatch& patch = contact.patches.at(0);
    // displacements by tractions that are constant in each cell, at the centres, as differences over one cell
    const double unit = std::sqrt(patch.area / std::numbers::pi), d = patch.grid.dx / unit;
    std::vector<std::pair<Eigen::Index, Eigen::Index>> cells;
    for (Eigen::Index j = 0; j < patch.grid.ny; ++j) {
        for (Eigen::Index i = 0; i < patch.grid.nx; ++i) {
            if (patch.pressure(i, j) > 0) cells.emplace_back(i, j);
        }
    }
    const auto n = Eigen::Index(cells.size());
    const HalfSpace<double> space(nu);
    const auto displaced = [&](double x, double y) {
        return space.corner(x + d / 2, y + d / 2) - space.corner(x - d / 2, y + d / 2) -
               space.corner(x + d / 2, y - d / 2) + space.corner(x - d / 2, y - d / 2);
    };
    detail::DirectionBlocks<double> G_prime;
    for (auto& row : G_prime) {
        for (auto& block : row) block.resize(n, n);
    }
    Elements<double> elements;
    Eigen::ArrayXd pressure(n);
    elements.areas = Eigen::ArrayXd::Constant(n, d * d);
    elements.centre_x = elements.centre_y = elements.x = elements.y = pressure;
    elements.half_element_ahead = true;
    for (Eigen::Index a = 0; a < n; ++a) {
        const auto [i, j] = cells[std::size_t(a)];
        pressure[a] = patch.pressure(i, j);
        elements.centre_x[a] = patch.grid.x(i) / unit;
        elements.x[a] = elements.centre_x[a] + d / 2;
        elements.y[a] = elements.centre_y[a] = patch.grid.y(j) / unit;
        elements.behind.push_back(i > 0 && patch.pressure(i - 1, j) > 0 ? a - 1 : -1);
        for (Eigen::Index b = 0; b < n; ++b) {
            const double x = double(i - cells[std::size_t(b)].first) * d,
                         y = double(j - cells[std::size_t(b)].second) * d;
            const RectangleInfluence<double> slope = (1 / d) * (displaced(x + d, y) - displaced(x, y));
            G_prime[0][0](a, b) = slope.xx;
            G_prime[1][1](a, b) = slope.yy;
            G_prime[0][1](a, b) = G_prime[1][0](a, b) = slope.xy;
        }
    }
    const FrictionModel model(PatchContact({unit, unit, wheel.dimensions().shear_modulus, nu}),
                              ElementSystem<double, 2>({}, G_prime, elements), {0.3, pressure});
    auto friction_workspace = model.workspace();
    auto state = model.at_rest();
    const Creepage creepage{-ref[10], ref[11], 1e3 * ref[12]};
    const auto step = model.steady(model.at_rest(), {Travel::at_speed(1), RigidMotion<Creepage>(creepage)}, state,
                                   friction_workspace);
    REQUIRE(step.status == Status::ok);
    CHECK(step.force.longitudinal / limit == Approx(-ref[13] / limit).margin(1.5e-3));
    CHECK(step.force.lateral / limit == Approx(ref[14] / limit).margin(1.5e-3));
}

/// A wheel of 0.46 m without slope on a parabola of radius R at its top.
WheelOnRail cylinder_on_parabola(double R) {
    const Eigen::ArrayXd across = Eigen::ArrayXd::LinSpaced(400, -0.03, 0.03);
    // 14 mm high on the inner side
    const double inner = std::sqrt(2 * R * 0.0145), step = std::min(1e-4, R / 50);
    const Eigen::ArrayXd head = Eigen::ArrayXd::LinSpaced(Eigen::Index((inner + 0.02) / step), -inner, 0.02);
    const Profile rail(head, head.square() / (2 * R), Profile::Use::piece);
    return {Profile(across, Eigen::ArrayXd::Zero(400), Profile::Use::piece),
            rail,
            {.gauge = 10 - 2 * std::sqrt(2 * R * 0.0139), .gauge_depth = 0.0139, .flange_back = 10, .tape_offset = 0}};
}
HertzEllipse hertz_of(double R, double load) {
    const double infinite = std::numeric_limits<double>::infinity();
    const ElasticBody steel{2 * 8.2e10 * 1.28, 0.28};
    return HertzEllipse(
        {.load = load, .radii_1 = {0.46, infinite}, .radii_2 = {infinite, R}, .body_1 = steel, .body_2 = steel});
}

TEST_CASE("wheel_on_rail: Hertz's ellipses from quadratic profiles, to second order in the cells", "[profiles]") {
    // So small a load that the wheel's circle is a parabola. Errors depend on how the border's staircase falls: root of
    // the mean square over radii and numbers of cells.
    std::vector<double> counts;
    std::map<std::string, std::vector<double>> errors;
    std::map<std::string, double> usual;
    WheelOnRail::Workspace workspace;
    const auto compare = [&](double R, double load, Eigen::Index along, Eigen::Index across, const auto& add) {
        CAPTURE(R, load, along, across);
        const auto contact =
            cylinder_on_parabola(R).solve_for_load({}, load, workspace, {.cells_x = along + 4, .cells_s = across + 4});
        REQUIRE(contact.status == Status::ok);
        const RailPatch& patch = contact.patches.at(0);
        CHECK(patch.load == Approx(load).epsilon(1e-6));
        const HertzEllipse hertz = hertz_of(R, load);
        add("approach", patch.approach / hertz.approach() - 1);
        add("peak pressure", patch.peak_pressure / hertz.peak_pressure() - 1);
        add("half length", patch.half_length / hertz.half_length() - 1);
        add("half width", patch.half_width / hertz.half_width() - 1);
        add("area", patch.area / (std::numbers::pi * hertz.half_length() * hertz.half_width()) - 1);
    };
    for (const Eigen::Index n : {16, 24, 36, 54}) {
        std::map<std::string, double> squares;
        for (int k = 0; k < 16; ++k) {
            const Eigen::Index cells = n + n * (k % 4 - 1) / 8;
            compare(0.05 * std::pow(1.15, k), 600, cells, cells,
                    [&](const char* name, double error) { squares[name] += error * error / 16; });
        }
        counts.push_back(double(n));
        for (const auto& [name, square] : squares) errors[name].push_back(std::sqrt(square));
    }
    for (const auto& [name, list] : errors) {
        INFO(name << ": " << list[0] << ", " << list[1] << ", " << list[2] << ", " << list[3]);
        CHECK(support::observed_order(counts, list) == Approx(2.1).margin(0.4));
        CHECK(list[3] < 3e-4);
    }
    for (int k = 0; k < 12; ++k) {  // the usual grid, a/b = 0.4 to 26
        compare(3e-3 * std::pow(2 / 3e-3, k / 11.0), 600, 36, 16,
                [&](const char* name, double error) { usual[name] = std::max(usual[name], std::abs(error)); });
    }
    for (const auto& [name, error] : usual) {
        INFO(name << ": " << error);
        CHECK(error < (name == "area" || name.substr(0, 4) == "half" ? 4e-3 : 1e-3));
    }
    // small and large loads, a/b = 40 and 0.06
    for (const auto& [R, load] : {std::pair{0.3, 100.}, {0.3, 1e6}, {2e-3, 1e4}, {30., 1e3}}) {
        compare(R, load, 36, 36, [](const std::string& name, double error) {
            CHECK(std::abs(error) < (name == "approach" ? 2e-3 : name == "area" ? 8e-3 : 4e-3));
        });
    }
}

TEST_CASE("wheel_on_rail: contacts do not depend on where the search for them starts", "[profiles]") {
    for (const double lateral : {-3e-3, 0.5e-3, 2e-3, 5.088e-3}) {
        const WheelsetPosition position{.lateral = lateral, .yaw = 1e-3};
        WheelOnRail::Workspace fresh, used;
        const auto cold = standard().solve_for_load(position, 1e5, fresh);
        for (const double from : {lateral - 2e-3, lateral + 1e-4, lateral}) {
            const bool same = from == lateral;
            standard().solve_for_load({.lateral = from, .yaw = same ? 1e-3 : 2e-3}, same ? 1e5 : 4e4, used);
            const auto warm = standard().solve_for_load(position, 1e5, used);
            CAPTURE(lateral, from);
            REQUIRE(warm.patches.size() == cold.patches.size());
            const RailPatch &one = warm.patches[0], &other = cold.patches[0];
            CHECK(warm.height == Approx(cold.height).margin(2e-4 * other.approach));
            CHECK(one.load == Approx(other.load).epsilon(1e-4));
            CHECK(one.peak_pressure == Approx(other.peak_pressure).epsilon(4e-3));
            CHECK(one.area == Approx(other.area).epsilon(2e-2));
            CHECK(one.grid.x_0 == Approx(other.grid.x_0).margin(other.grid.dx));
        }
    }
}

TEST_CASE("wheel_on_rail: ends of profiles, two points, positions out of reach, loads and options that cannot be meant",
          "[profiles]") {
    WheelOnRail::Workspace workspace;
    // pressures at the end of the wheel, which is not known beyond
    CHECK(cylinder_on_parabola(0.3).solve_for_load({.lateral = 0.0295}, 1e5, workspace).status ==
          Status::end_of_profile);
    // the flange's face, by a second implementation on 60 x 60 cells
    const RailPatch flange =
        under_normal_force(standard(), {6.5e-3, 0, -4.376e-3, .0156}, 15441, workspace).patches.at(0);
    CHECK(flange.angle == Approx(-1.15908).margin(1e-3));
    CHECK(1e-6 * flange.peak_pressure == Approx(2585.8).epsilon(1e-2));
    CHECK(standard().solve_for_load({.lateral = 1}, 1e5, workspace).status == Status::no_contact);
    CHECK(standard().solve_for_load({.yaw = 0.8}, 1e5, workspace).status == Status::undefined_section);
    CHECK(standard().solve_for_load({.lateral = 0.478, .yaw = 0.8}, 1e4, workspace).status ==
          Status::undefined_section);
    CHECK(standard().solve_for_load({.roll = 3}, 1e5, workspace).status == Status::no_contact);
    CHECK(standard().solve_for_load({}, NAN, workspace).status == Status::not_finite);
    for (const double load : {0.0, -1.0})
        CHECK(standard().solve_for_load({}, load, workspace).status == Status::no_contact);
    for (const double load : {5e-324, 1e-300, 1e300})
        CHECK_FALSE(has_numbers(standard().solve_for_load({}, load, workspace).status));
    using Options = WheelOnRail::Options;
    for (const Options& options : {Options{.cells_x = 4},
                                   {.cells_s = 0},
                                   {.tolerance = 0},
                                   {.tolerance = NAN},
                                   {.cell_size = -1},
                                   {.cell_size = NAN},
                                   {.cell_size = 1e-300}}) {
        CHECK_THAT(refusal([&] { standard().solve_for_load({}, 1e5, workspace, options); }),
                   ContainsSubstring("WheelOnRail: "));
        CHECK_THAT(refusal([&] { standard().solve_at_height({}, workspace, options); }), ContainsSubstring(" must "));
    }
    CHECK_THAT(refusal([] { WheelOnRail(s1002(), rail_uic60(), {.shear_modulus = 1e-310}); }),
               ContainsSubstring("shear_modulus"));

    // right 11 of the benchmark, 10 mm apart; CONTACT's friction carries a part, a second implementation's loads
    const double vertical = 1e4 - 8557 * 2308 / 8161 * std::sin(0.298) - 1045 * 443 / 1476 * std::sin(0.133);
    const auto two = standard().solve_for_load({5e-3, 0, -3.554e-4, 0.012}, vertical, workspace);
    REQUIRE(two.patches.size() == 2);
    CHECK(two.patches[0].load == Approx(8557).epsilon(5e-3));
    CHECK(two.patches[1].load == Approx(1045).epsilon(7e-2));
    CHECK(std::abs(two.patches[0].y - two.patches[1].y) == Approx(0.0102).margin(1e-4));
}

TEST_CASE("wheel_on_rail: curved slip of a cylinder on a round rail", "[profiles]") {
    const double R = 0.3;
    const WheelOnRail wheel = cylinder_on_parabola(R);
    WheelOnRail::Workspace workspace;
    const auto contact = wheel.solve_for_load({}, 8e4, workspace, {.cells_x = 64, .cells_s = 64});
    REQUIRE(contact.status == Status::ok);
    const RailPatch& patch = contact.patches.at(0);
    CHECK(patch.y == Approx(wheel.rail_origin()).margin(2e-6));
    // all of the cylinder is as far from the axle; the surface between it and the head turns by s/(2R) across, which
    // turns the slip of rolling over an edge into a lateral one
    const WheelsetSpeeds speeds{.forward = 10, .pitch_rate = -10 / 0.46};
    const Eigen::ArrayXd x{{-3e-3, 0, 4e-3}}, s{{-2e-3, 1e-3, 3e-3}};
    const Eigen::MatrixX2d rows = curved_slip_of(patch, {.height = contact.height}, speeds, 0.46, x, s);
    CHECK(rows.col(0).cwiseAbs().maxCoeff() < 1e-7);  // the deepest of the cells' centres; 3e-5 on the head
    for (Eigen::Index i = 0; i < 3; ++i)
        CHECK(rows(i, 1) == Approx(x[i] / 0.46 * s[i] / (2 * R)).epsilon(3e-2).margin(1e-9));
}

TEST_CASE("wheelset_on_track: the roll of equal loads is that of the benchmark", "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    const auto one = wheelset.solve({.lateral = 2.5e-3, .yaw = 6e-3}, {1e4, 1e4}, workspace);
    REQUIRE(one.status == Status::ok);
    CHECK(one.position.roll == Approx(-1.457e-4).margin(2e-6));  // of the benchmark
    CHECK(one.wheels[0].height == Approx(one.wheels[1].height).margin(1e-9));
}

TEST_CASE("wheelset_on_track: regions that join between tread and flange", "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    const auto contacts = wheelset.solve({.lateral = 6.3e-3, .yaw = 0.02}, {1e5, 1e5}, workspace);
    REQUIRE(contacts.status == Status::doubtful_plane);
    for (const WheelOnRail::Contact& wheel : contacts.wheels) {
        double vertical = 0;
        for (const RailPatch& patch : wheel.patches) vertical += patch.vertical_load();
        CHECK(vertical == Approx(1e5).epsilon(2e-6));
    }
    // at this height the same loads press the wheels down again
    const auto pressed = wheelset.solve(contacts.position, {0, 0}, workspace, WheelsetOnTrack::Free::nothing);
    for (std::size_t k = 0; k < 2; ++k) {
        REQUIRE(pressed.wheels[k].patches.size() == contacts.wheels[k].patches.size());
        CHECK(pressed.wheels[k].patches[0].load == Approx(contacts.wheels[k].patches[0].load).epsilon(2e-2));
    }
    const auto lifted = wheelset.solve({.height = -1e-3}, {0, 0}, workspace, WheelsetOnTrack::Free::nothing);
    CHECK(lifted.status == Status::no_contact);
}

TEST_CASE("wheelset_forces: a braked wheelset is held back and its axle turned forwards", "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    WheelsetRolling rolling{.position = {.lateral = 4e-3, .yaw = 2e-3}, .speeds = {.forward = 20}};
    const RollingFriction friction{.coefficient = 0.3, .elements = 8, .strips = 9, .curved_slip = false};
    const auto free = rolling_forces(wheelset, rolling, friction, workspace);
    REQUIRE(free.contacts.status == Status::ok);
    for (std::size_t k = 0; k < 2; ++k)
        CHECK(free.patches[k][0].creepage.longitudinal * free.patches[k][0].force.longitudinal < 0);
    CHECK(free.on_wheel[0].force[1] + free.on_wheel[1].force[1] == Approx(free.on_wheelset.force[1]));
    const PatchForce& patch = free.patches[1][0];
    CHECK(patch.strip_work.sum() == Approx(patch.slip_work).epsilon(1e-12));
    // heat is the power of creep forces over the rolling velocity
    CHECK(t_gamma(patch) == Approx(patch.slip_work).epsilon(2e-2));
    // all of it is found on the profile, where the patch lies
    const RailPatch& place = free.contacts.wheels[1].patches[0];
    const Profile& rail = wheelset.wheel().rail();
    ProfileWear wear(rail, 500);
    wear.add(place.rail_s, patch, 3);
    wear.add(place.rail_s, PatchForce{});
    CHECK(wear.work().sum() * wear.width() == Approx(3 * patch.slip_work).epsilon(1e-12));
    const Eigen::ArrayXd s = (Eigen::ArrayXd::LinSpaced(500, 0, 499) + 0.5) * wear.width();
    const double low = place.rail_s + place.outline->low(), high = place.rail_s + place.outline->high();
    CHECK(((wear.work() > 0) == (s > low - wear.width() && s < high + wear.width())).count() >= 498);
    CHECK(rail.at(place.rail_s).y == Approx(place.rail_y));
    // the index vanishes where friction over the load is k/p_max
    const double rubs = std::hypot(patch.force.longitudinal, patch.force.lateral) / place.load;
    CHECK(surface_fatigue_index(place, patch, rubs * place.peak_pressure) == Approx(0).margin(1e-12));
    CHECK(surface_fatigue_index(place, patch, 0) == Approx(rubs));

    rolling.free_pitch = false;
    for (const double share : {0.995, 1.005}) {
        rolling.speeds.pitch_rate = share * free.pitch_rate;
        const auto forced = rolling_forces(wheelset, rolling, friction, workspace);
        const double sign = share < 1 ? 1 : -1;  // braked, driven
        CHECK(sign * forced.on_wheelset.force[0] < -2e4);
        CHECK(sign * forced.patches[0][0].creepage.longitudinal > 3e-3);
    }
    rolling.speeds.pitch_rate = free.pitch_rate / 2;  // slides everywhere
    const auto locked = rolling_forces(wheelset, rolling, friction, workspace);
    for (std::size_t k = 0; k < 2; ++k) {
        const TangentialForce& slides = locked.patches[k][0].force;
        CHECK(std::hypot(slides.longitudinal, slides.lateral) ==
              Approx(0.3 * locked.contacts.wheels[k].patches[0].load).epsilon(1e-5));
    }
}

TEST_CASE("wheelset_forces: normal forces do no work, but for the turn of the rails in a curve", "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    double most_creepage = 0;
    for (const double turn : {0.0, 20 / 300.}) {
        for (const auto& [lateral, yaw] : {std::pair{0.0, 3e-3},
                                           {4e-3, -2e-3},
                                           {4.8e-3, -10e-3},
                                           {5.2e-3, 8e-3},
                                           {6.42e-3, 8e-3},
                                           {6.8e-3, -5e-3},
                                           {8e-3, -10e-3}}) {
            const WheelsetRolling rolling{.position = {.lateral = lateral, .yaw = yaw},
                                          .speeds = {.forward = 20, .yaw_rate = turn}};
            const auto forces = rolling_forces(wheelset, rolling, {.elements = 6, .strips = 7}, workspace);
            CAPTURE(lateral, yaw, turn, name(forces.contacts.status));
            REQUIRE(forces.contacts.status == Status::ok);
            const WheelsetSpeeds speeds{.forward = 20, .pitch_rate = forces.pitch_rate, .yaw_rate = turn};
            const auto velocity = detail::velocity_of(forces.contacts.position, speeds);
            double lost = 0, creep = 0, turned = 0;  // power [W]
            for (std::size_t i = 0; i < 3; ++i) {
                lost -= forces.on_wheelset.force[i] * velocity.middle()[i];
                lost -= forces.on_wheelset.moment[i] * velocity.turn()[i];
            }
            // pressures ahead of the axle, at x, move across the rails with the rate of turn times x
            for (const std::size_t k : {0, 1}) {
                for (std::size_t i = 0; i < forces.patches[k].size(); ++i) {
                    const RailPatch& patch = forces.contacts.wheels[k].patches[i];
                    creep += t_gamma(forces.patches[k][i]) * std::abs(rolling_velocity_of(patch, speeds));
                    turned += (k == 0 ? -1 : 1) * turn * patch.x * pressure_wrench_of(patch, patch.y, patch.z).force[1];
                }
            }
            CHECK(lost == Approx(creep).epsilon(1.5e-3));
            CHECK(lost + turned == Approx(creep).epsilon(1e-3));
            for (const WheelsetForces::Wrench& wheel : forces.on_wheel)
                CHECK(wheel.force[2] == Approx(-1e5).epsilon(1.01e-6));
            // creepages balance, not slips
            const auto& [left, right] = forces.patches;
            if (left.size() != 1 || right.size() != 1) continue;
            CHECK(std::abs(left[0].creepage.longitudinal + right[0].creepage.longitudinal) < 1e-12);
            most_creepage = std::max(most_creepage, std::abs(left[0].creepage.longitudinal));
        }
    }
    CHECK(most_creepage > 1e-3);
}

TEST_CASE("wheelset_forces: a wheel without contact does not stop the other", "[profiles]") {
    // narrow wheels, the left one beside its rail, the right one on its flange
    const Profile whole = s1002();
    const Eigen::Index most = (whole.y() < 0.02).count();
    const WheelsetOnTrack narrow(
        WheelOnRail(Profile(whole.y().head(most), whole.z().head(most), Profile::Use::piece), rail_uic60()));
    WheelsetOnTrack::Workspace workspace;
    const WheelsetRolling rolling{.position = {.lateral = 0.055},
                                  .loads = {1e5, 8e4},
                                  .free = WheelsetOnTrack::Free::height,
                                  .speeds = {.forward = 2}};
    const auto derailed = rolling_forces(narrow, rolling, {.coefficient = 0.3, .elements = 6, .strips = 7}, workspace);
    CHECK(!has_numbers(derailed.contacts.wheels[0].status));
    CHECK(derailed.patches[0].empty());
    REQUIRE(has_numbers(derailed.contacts.wheels[1].status));
    REQUIRE(derailed.patches[1].size() == derailed.contacts.wheels[1].patches.size());
    CHECK(derailed.patches[1][0].creepage.longitudinal == Approx(0).margin(1e-14));
    CHECK(derailed.on_wheelset.force[2] == Approx(-8e4).epsilon(1.01e-6));
}

TEST_CASE("wheelset_forces: creepages of a wheel that rolls backwards, and none at standstill", "[profiles]") {
    WheelOnRail::Workspace wheel;
    const auto contact = standard().solve_for_load({.lateral = 2e-3, .yaw = 2e-3}, 1e4, wheel);
    const Creepage back =
        creepage_of(contact.patches.at(0), {2e-3, contact.height, 0, 2e-3}, {.forward = -2, .pitch_rate = 4.345}, 0.46);
    CHECK(back.longitudinal == Approx(6.55e-4).margin(5e-7));
    CHECK(back.lateral == Approx(2.007e-3).margin(5e-7));
    CHECK(back.spin == Approx(0.173).margin(5e-4));

    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    for (const WheelsetSpeeds& speeds :
         {WheelsetSpeeds{.forward = 0}, {.forward = 0, .lateral = 1e-3}, {.forward = 1e-310}}) {
        const auto stands = rolling_forces(
            wheelset, {.position = {.lateral = 4e-3, .yaw = 3e-3}, .loads = {8e4, 1e5}, .speeds = speeds},
            {.elements = 6, .strips = 7}, workspace, {.cells_x = 20, .cells_s = 16});
        CHECK(stands.contacts.status == Status::unbalanced);
        for (const auto& patches : stands.patches) {
            CHECK(patches.at(0).status == Status::invalid_step);
            CHECK(patches.at(0).force.longitudinal == 0);
        }
        CHECK(stands.on_wheelset.force[0] == 0);
        CHECK(stands.on_wheelset.force[2] == Approx(-1.8e5).epsilon(1e-5));
        for (const double moment : stands.on_wheelset.moment) CHECK(detail::is_finite(moment));
    }
}

TEST_CASE("wheelset_forces: normal forces and friction carry the loads on the flange, where friction lifts the wheel",
          "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    const RollingFriction friction{.coefficient = 0.5, .elements = 6, .strips = 7};
    const WheelOnRail::Options few_cells{.cells_x = 20, .cells_s = 16, .halves_cells = false};
    // contacts of the last two jump with the loads
    for (const auto& [lateral, yaw] :
         {std::pair{4.91297511e-3, 5.43510045e-3}, {6.59e-3, -6.7e-3}, {7.2e-3, -1.17e-2}}) {
        WheelsetOnTrack::Workspace workspace;
        const WheelsetRolling rolling{.position = {.lateral = lateral, .yaw = yaw}, .speeds = {.forward = 20}};
        const auto settled = rolling_forces(wheelset, rolling, friction, workspace, few_cells);
        CAPTURE(lateral, settled.rounds, name(settled.contacts.status));
        CHECK((settled.contacts.status == Status::ok || settled.contacts.status == Status::doubtful_plane));
        for (const auto& wheel : settled.on_wheel) CHECK(wheel.force[2] == Approx(-1e5).epsilon(1.01e-6));
    }
    // friction that jumps with the load does not settle; the other wheel does
    WheelsetOnTrack::Workspace workspace;
    const WheelsetRolling rolling{.position = {.lateral = 7.32e-3, .yaw = -1.14e-2},
                                  .free = WheelsetOnTrack::Free::height,
                                  .speeds = {.forward = 20}};
    const auto jumps =
        rolling_forces(wheelset, rolling, {.coefficient = 0.6, .elements = 6, .strips = 7}, workspace, few_cells);
    CHECK(jumps.contacts.wheels[0].status == Status::ok);
    CHECK(jumps.contacts.wheels[1].status == Status::unbalanced);
    CHECK(jumps.contacts.status == Status::unbalanced);
}

TEST_CASE("wheelset_forces: curved slip where the rail's arcs join, and a patch with a tail", "[profiles]") {
    const WheelsetOnTrack wheelset(standard());
    WheelsetOnTrack::Workspace workspace;
    const WheelsetRolling rolling{.position = {}, .loads = {1e4, 1e4}, .speeds = {.forward = 2}};
    const auto force = [&](bool curved) {
        const RollingFriction friction{.coefficient = 0.3, .elements = 8, .strips = 9, .curved_slip = curved};
        return rolling_forces(wheelset, rolling, friction, workspace).patches[0].at(0).force.longitudinal;
    };
    CHECK(std::abs(force(true) - force(false)) / 3e3 == Approx(3.6e-2).margin(1e-2));

    const auto area = [&](Eigen::Index n) {
        const auto contact = standard().solve_for_load({1e-3, 0, -5.049e-5, .0024}, 1e4, workspace.wheels[1],
                                                       {.cells_x = 2 * n, .cells_s = n});
        return contact.patches.at(0).area;
    };
    CHECK(area(20) == Approx(area(80)).epsilon(4e-2));
}

}  // namespace
