// Random contacts of wheels on rails: loads are carried and no contact is lost, or a status says why.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <rollbem/normal/standard_profiles.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>

#include "cases.hpp"
#include "deformed_gap.hpp"
#include "drawn.hpp"

namespace extremes {

namespace {

using namespace rollbem;

constexpr std::uint64_t pairs = 10;  // of rough profiles

using Random = drawn::Draw;
double uniform(Random& random) { return random.uniform(-1, 1); }

/// Hollows and bumps of half a millimetre, and waves as a measured surface has them.
Profile rough(const Profile& profile, Random& random) {
    Eigen::ArrayXd z = profile.z();
    for (int k = 0; k < 3; ++k) {
        const double depth = 5e-4 * uniform(random), middle = 0.03 * uniform(random),
                     width = 0.008 + 0.004 * uniform(random);
        z += depth * (-((profile.y() - middle) / width).square()).exp();
    }
    for (const double length : {2e-3, 4e-3, 8e-3}) {
        const double height = 0.1 * length * length * uniform(random), phase = pi * uniform(random);
        z += height * (profile.y() * 2 * pi / length + phase).sin();
    }
    return {profile.y(), z};
}

/// The rail as a roller of 100 km, whose contacts equal contacts on the rail, but are searched in slices.
WheelOnRail rolled(const WheelOnRail& of) {
    TrackDimensions dimensions = of.dimensions();
    dimensions.rail_origin = of.geometry().rail_origin();
    return {of.wheel(), RailSurface::roller(of.rail(), 1e5), dimensions};
}

struct Pair {
    WheelOnRail wheel;
    WheelOnRail in_slices{rolled(wheel)};
    RailPoints rail{wheel};
};

/// S1002 on UIC 60, or a pair of rough profiles.
const Pair& pair_of(std::uint64_t seed) {
    static const Pair smooth{WheelOnRail(s1002(), rail_uic60())};
    static const auto made = [] {
        Random random(41);
        std::vector<Pair> all;
        while (all.size() < pairs) {
            const Profile wheel = rough(s1002(), random), rail = rough(rail_uic60(), random);
            all.push_back({WheelOnRail(wheel, rail)});
        }
        return all;
    }();
    return seed % 2 == 1 ? smooth : made[seed / 2 % pairs];
}

bool is_sound(const RailPatch& patch) {
    for (const double number : {patch.x, patch.y, patch.z, patch.angle}) {
        if (!detail::is_finite(number)) return false;
    }
    return (patch.pressure >= 0).all() && patch.pressure.allFinite() && patch.outline && patch.residual <= 1e-6 &&
           patch.area > 0 && patch.peak_pressure > 0;
}

/// The outcome on 24 x 16 cells, times a factor.
Outcome judged(const Pair& pair, bool in_slices, const WheelsetPosition& at, double load, Eigen::Index times) {
    WheelOnRail::Workspace workspace;
    const WheelOnRail& wheel = in_slices ? pair.in_slices : pair.wheel;
    const auto contact = wheel.solve_for_load(at, load, workspace, {.cells_x = 24 * times, .cells_s = 16 * times});
    Outcome outcome{.reference = 0, .error = 0, .bound = 1, .told = told_by(contact.status)};
    outcome.may_be_told = contact.status != Status::not_finite && contact.status != Status::not_converged;
    if (!has_numbers(contact.status)) return outcome;
    const auto heavier = [](const RailPatch& one, const RailPatch& other) { return one.load > other.load; };
    if (!std::is_sorted(contact.patches.begin(), contact.patches.end(), heavier)) {
        return {.told = "patches are not by decreasing load"};
    }
    double vertical = contact.dropped, depth = 0;
    for (const RailPatch& patch : contact.patches) {
        if (!is_sound(patch)) return {.told = "a patch without pressures or an outline"};
        vertical += patch.vertical_load();
        depth = std::max(depth, patch.approach);
        outcome.residual = std::max(std::isnan(outcome.residual) ? 0 : outcome.residual, patch.residual);
    }
    outcome.value = least_gap(pair.wheel, pair.rail, at, contact);
    // cells leave hundredths of the depth between their centres, of the second order in their size
    const double share = contact.status == Status::doubtful_plane ? 0.1 : 0.04;
    const double open = (contact.dropped > 1e-9 * load ? 3e-6 : 1e-6) + share * depth;
    outcome.error =
        std::max({-outcome.value / open, std::abs(vertical / load - 1) / 1.01e-6, contact.dropped / (2e-3 * load)});
    return outcome;
}

Outcome run(std::uint64_t seed, bool in_slices) {
    const Pair& pair = pair_of(seed);
    Random random(seed);
    WheelsetPosition at;
    at.lateral = 0.012 * uniform(random);
    at.roll = 5e-3 * uniform(random);
    at.yaw = 0.03 * uniform(random);
    const double load = 1e5 * std::pow(10, uniform(random));
    const Outcome outcome = judged(pair, in_slices, at, load, 1);
    // errors by coarse cells become less on finer ones, a contact that was lost stays so
    return outcome.error > outcome.bound ? judged(pair, in_slices, at, load, 2) : outcome;
}

}  // namespace

Case contact_scene(std::uint64_t seed, bool in_slices) {
    const std::string pair = seed % 2 == 1 ? "S1002 on UIC 60" : "rough pair " + std::to_string(seed / 2 % pairs + 1),
                      name = pair + ", scene " + std::to_string(seed) + (in_slices ? " in slices" : "");
    return {name, "least gap", [=] { return run(seed, in_slices); }};
}

}  // namespace extremes
