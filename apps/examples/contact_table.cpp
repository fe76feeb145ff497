// Where a wheelset touches its rails over shift and yaw, as a table for look-up, and how far forces by tables are from
// those of patches, in random scenes. Profiles of one's own go into wheelset().
//
//     ./examples/contact_table make s1002_60e1.contact 181 13    # shifts, yaw angles
//     ./examples/contact_table check s1002_60e1.contact 1000     # scenes
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/vehicle/make_contact_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

namespace {

using namespace rollbem;

WheelsetOnTrack wheelset() { return WheelsetOnTrack(WheelOnRail(s1002(), rail_uic60())); }

void print(const char* what, std::vector<double>& differences) {
    std::sort(differences.begin(), differences.end());
    double sum = 0;
    for (const double one : differences) sum += one;
    const auto at = [&](double share) { return differences[std::size_t(share * double(differences.size() - 1))]; };
    std::printf("%-36s mean %.4f  median %.4f  95 %% below %.4f  largest %.3f\n", what,
                sum / double(differences.size()), at(0.5), at(0.95), at(1));
}

/// Random scenes: shift to 0.9 of the largest, yaw to two thirds, loads by half; creepages that friction would need
/// 0.05 to 5 mu N for in the linear law, in a random direction, with the spin of rolling.
bool check(const ContactTable& table, const CreepForceTable& creep, const WheelsetOnTrack& track, std::size_t scenes) {
    constexpr double mu = 0.3, speed = 30;
    const TrackDimensions& dimensions = track.wheel().dimensions();
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    std::vector<double> rule, rule_moments, friction, lateral;
    WheelsetOnTrack::Workspace workspace;
    while (rule.size() < scenes) {
        WheelsetRolling rolling;
        rolling.position.lateral = 0.9 * table.grid().largest_shift * (2 * uniform(random) - 1);
        rolling.position.yaw = table.grid().largest_yaw * (2 * uniform(random) - 1) * 2 / 3;
        const double load = table.nominal_load() * (0.5 + uniform(random));
        rolling.loads = {load, load};
        const double size = 0.05 * std::pow(100, uniform(random)), direction = 2 * std::numbers::pi * uniform(random);
        const double unit = size * mu * load / (dimensions.shear_modulus * 3.5e-5 * 4);  // c11, c22 are about 4
        rolling.free_pitch = false;
        rolling.speeds = {.forward = speed,
                          .pitch_rate = -speed / dimensions.radius * (1 - unit * std::cos(direction)),
                          .lateral = speed * (rolling.position.yaw + unit * std::sin(direction))};
        const ContactTable::OnRails rails = table.on_rails(rolling.position.lateral, rolling.position.yaw);
        rolling.speeds.vertical = rails.height_by_lateral * rolling.speeds.lateral;
        rolling.speeds.roll_rate = rails.roll_by_lateral * rolling.speeds.lateral;
        const WheelsetForces forces = rolling_forces(track, rolling, {.coefficient = mu}, workspace);
        const WheelForces now = table.look_up(creep, WheelsetSide::right, rolling.position, rolling.speeds, load, mu);
        if (!has_numbers(forces.contacts.status) || now.status != StepStatus::ok) continue;
        const auto& patches = forces.contacts.wheels[1].patches;
        double bound = 0;
        std::array<double, 2> sum{};  // of friction in the planes
        bool solved = true;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const PatchForce& one = forces.patches[1][i];
            solved = solved && one.status == StepStatus::ok;
            if (!solved) break;
            const double own = mu * patches[i].load, c = contact_of(patches[i], dimensions).c();
            const auto by_rule = creep_ellipse(patches[i], dimensions, creep)
                                     .forces(creep, dimensions, mu, patches[i].load, one.creepage);
            bound += own;
            sum[0] += one.force.longitudinal;
            sum[1] += one.force.lateral;
            if (i > 0) continue;  // the largest patch
            rule.push_back(std::max(std::abs(by_rule.longitudinal - one.force.longitudinal),
                                    std::abs(by_rule.lateral - one.force.lateral)) /
                           own);
            rule_moments.push_back(std::abs(by_rule.moment - one.force.moment) / (own * c));
        }
        if (!solved) continue;
        for (const WheelForces::Point& point : now.points) {
            if (point.load_share == 0) continue;
            sum[0] -= point.force.longitudinal;
            sum[1] -= point.force.lateral;
        }
        friction.push_back(std::max(std::abs(sum[0]), std::abs(sum[1])) / bound);
        lateral.push_back(std::abs(forces.on_wheel[1].force[1] - now.force[1]) / load);
    }
    print("rule: F_x, F_s over mu N", rule);
    print("rule: moment over mu N c", rule_moments);
    print("table: F_x, F_s over mu N", friction);
    print("table: F_y of the wheel over its load", lateral);
    return rule[rule.size() / 2] < 0.01 && friction[friction.size() / 2] < 0.02;
}

}  // namespace

int main(int argc, char** argv) try {
    const std::string task = argc > 3 ? argv[1] : "";
    const auto creep = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    if (task == "make" && argc == 5) {
        const ContactTable::Grid grid{.shifts = std::atoi(argv[3]), .yaws = std::atoi(argv[4])};
        double missing = 0;
        const ContactTable table = make_contact_table(wheelset(), 1e5, creep, grid, 2, {}, &missing);
        std::printf("%.2g of the positions were filled by those beside them\n", missing);
        std::ofstream file(argv[2], std::ios::binary);
        table.write(file);
        return file.flush() ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (task == "check" && argc == 4 && std::atoi(argv[3]) > 0) {
        return check(ContactTable::read(argv[2]), creep, wheelset(), std::size_t(std::atoi(argv[3]))) ? EXIT_SUCCESS
                                                                                                      : EXIT_FAILURE;
    }
    std::fprintf(stderr, "usage: contact_table make FILE SHIFTS YAWS | check FILE SCENES\n");
    return 2;
} catch (const std::exception& error) {
    std::fprintf(stderr, "contact_table: %s\n", error.what());
    return 2;
}
