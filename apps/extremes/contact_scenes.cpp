// Random contacts of wheels on rails: loads are carried, no contact is lost, and what cannot depend on how a scene is
// posed does not, or a status says why.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>

#include "cases.hpp"
#include "deformed_gap.hpp"
#include "drawn.hpp"

namespace extremes {

namespace {

using namespace rollbem;

constexpr std::uint64_t pairs = 10;  // of rough profiles

using Random = drawn::Draw;
using Contact = WheelOnRail::Contact;
double uniform(Random& random) { return random.uniform(-1, 1); }

struct Wave {
    double length, height;  ///< [m]
};

/// The profile under waves of random phases, up to these heights.
Profile waved(const Profile& profile, const std::vector<Wave>& waves, Random& random) {
    Eigen::ArrayXd z = profile.z();
    for (const Wave& wave : waves) {
        const double height = wave.height * uniform(random), phase = pi * uniform(random);
        z += height * (profile.y() * 2 * pi / wave.length + phase).sin();
    }
    return {profile.y(), z};
}

/// Hollows and bumps of half a millimetre, and waves as a measured surface has them.
Profile rough(const Profile& profile, Random& random) {
    Eigen::ArrayXd z = profile.z();
    for (int k = 0; k < 3; ++k) {
        const double depth = 5e-4 * uniform(random), middle = 0.03 * uniform(random),
                     width = 0.008 + 0.004 * uniform(random);
        z += depth * (-((profile.y() - middle) / width).square()).exp();
    }
    const auto wave = [](double length) { return Wave{length, 0.1 * length * length}; };
    return waved({profile.y(), z}, {wave(2e-3), wave(4e-3), wave(8e-3)}, random);
}

/// The rail as a roller of 100 km, whose contacts equal contacts on the rail, but are searched in slices.
WheelOnRail rolled(const WheelOnRail& of) {
    WheelOnRail::Dimensions dimensions = of.dimensions();
    dimensions.rail_origin = of.geometry().rail_origin();
    return {of.wheel(), RailSurface::roller(of.rail(), 1e5), dimensions};
}

struct Pair {
    WheelOnRail wheel;
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
           patch.area > 0 && patch.peak_pressure > 0 && patch.approach > 0;
}

/// A wheel under a load, and the number of its cells over 24 x 16.
struct WheelScene {
    WheelsetPosition at;
    double load;
    WheelOnRail::Options options{.cells_x = 24, .cells_s = 16};
};

WheelScene drawn_scene(Random& random) {
    WheelScene scene;
    scene.at.lateral = 0.012 * uniform(random);
    scene.at.roll = 5e-3 * uniform(random);
    scene.at.yaw = 0.03 * uniform(random);
    scene.load = 1e5 * std::pow(10, uniform(random));
    return scene;
}

Contact solved(const WheelOnRail& wheel, const WheelScene& scene) {
    WheelOnRail::Workspace workspace;
    return wheel.solve_for_load(scene.at, scene.load, workspace, scene.options);
}

/// Whether the pressures of a contact carry the load, and leave no contact out.
Outcome judged(const Pair& pair, const WheelScene& scene, const Contact& contact) {
    const double load = scene.load;
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
    outcome.value = least_gap(pair.wheel, pair.rail, scene.at, contact);
    // cells leave hundredths of the depth between their centres, of the second order in their size
    const double share = contact.status == Status::doubtful_plane ? 0.1 : 0.04;
    const double open = (contact.dropped > 1e-9 * load ? 3e-6 : 1e-6) + share * depth;
    outcome.error =
        std::max({-outcome.value / open, std::abs(vertical / load - 1) / 1.01e-6, contact.dropped / (2e-3 * load)});
    return outcome;
}

/// The verdict on the contact of a scene, searched on an equal wheel and rail. Errors by coarse cells become less on
/// the finer cells that `scene` then has, a contact that was lost stays so.
std::pair<Outcome, Contact> judged(const Pair& pair, const WheelOnRail& searched, WheelScene& scene) {
    const auto now = [&] {
        Contact contact = solved(searched, scene);
        const Outcome outcome = judged(pair, scene, contact);
        return std::pair(outcome, std::move(contact));
    };
    auto found = now();
    if (!(found.first.error > found.first.bound)) return found;
    scene.options = {.cells_x = 48, .cells_s = 32};
    return now();
}

Outcome run_contact(std::uint64_t seed, bool in_slices) {
    const Pair& pair = pair_of(seed);
    const WheelOnRail searched = in_slices ? rolled(pair.wheel) : pair.wheel;
    Random random(seed);
    WheelScene scene = drawn_scene(random);
    return judged(pair, searched, scene).first;
}

/// A standard rail, and what S1002 and it have been through: nothing, wear of up to a millimetre over centimetres, or
/// roughness of 10 um.
struct Surfaces {
    const char* rail;
    Profile (*canted)(double cant);
    double cant;
    const char* state;
    std::vector<Wave> waves;
};
Surfaces drawn_surfaces(Random& random) {
    const std::pair<const char*, Profile (*)(double)> rails[] = {
        {"UIC 60", rail_uic60}, {"60E1", rail_60e1}, {"54E1", rail_54e1}};
    Surfaces drawn{};
    std::tie(drawn.rail, drawn.canted) = rails[random.integer(3)];
    drawn.cant = std::array{0.0, 1.0 / 40, 1.0 / 20}[std::size_t(random.integer(3))];
    const std::pair<const char*, std::vector<Wave>> as_new{"new", {}},
        worn{"worn", {{0.02, 1e-4}, {0.04, 4e-4}, {0.08, 1e-3}}},
        rough{"rough", {{1e-3, 1e-5}, {2.3e-3, 1e-5}, {5e-3, 1e-5}}};
    std::tie(drawn.state, drawn.waves) = random.one_in(10) ? rough : random.one_in(3) ? as_new : worn;
    return drawn;
}

/// Whether the patches of two contacts have as many and as large cells.
bool have_same_cells(const Contact& one, const Contact& other) {
    const auto same = [](const RailPatch& a, const RailPatch& b) {
        return a.grid.nx == b.grid.nx && a.grid.ny == b.grid.ny && std::abs(a.grid.dx / b.grid.dx - 1) < 1e-9 &&
               std::abs(a.grid.dy / b.grid.dy - 1) < 1e-9;
    };
    return std::equal(one.patches.begin(), one.patches.end(), other.patches.begin(), other.patches.end(), same);
}

/// What of a contact differs from its mirror image, the same under the opposite yaw; empty if nothing does. With other
/// cells approaches may differ by half a percent, and patches that carry less than a twentieth of the load may lack.
std::string unlike_its_mirror_image(const WheelOnRail& wheel, WheelScene scene, const Contact& contact) {
    scene.at.yaw = -scene.at.yaw;
    const Contact other = solved(wheel, scene);
    const bool same_cells = have_same_cells(contact, other);
    if (same_cells ? other.status != contact.status : has_numbers(other.status) != has_numbers(contact.status))
        return std::string("mirror image: ") + name(other.status);
    if (!has_numbers(contact.status)) return {};
    const auto heavy = [&](const Contact& of) {
        return std::count_if(of.patches.begin(), of.patches.end(),
                             [&](const RailPatch& patch) { return patch.load > 0.05 * scene.load; });
    };
    if (heavy(other) != heavy(contact)) {
        return "mirror image: " + std::to_string(heavy(other)) + " patches, not " + std::to_string(heavy(contact));
    }
    const double apart = std::abs(other.height - contact.height);
    const double most = same_cells ? 1e-8 : 5e-3 * std::max(contact.patches[0].approach, other.patches[0].approach);
    return apart > most ? "mirror image: height differs by " + shown(apart) + " m" : "";
}

/// Whether the place of the largest pressure of a patch lies under pressure of another patch, too.
bool presses(const RailPatch& patch, const RailPatch& other) {
    Eigen::Index row = 0, column = 0;
    other.pressure.maxCoeff(&row, &column);
    const auto [x, y, z] = other.place(other.grid.x(row), other.grid.y(column), 0);
    const double s = (y - patch.y) * std::cos(patch.angle) + (z - patch.z) * std::sin(patch.angle);
    const auto cell = [](double place, double first, double size) { return std::lround((place - first) / size); };
    const Eigen::Index i = cell(x - patch.x, patch.grid.x(0), patch.grid.dx),
                       j = cell(s, patch.grid.y(0), patch.grid.dy);
    return i >= 0 && j >= 0 && i < patch.grid.nx && j < patch.grid.ny && patch.pressure(i, j) > 0;
}

/// Whether the undeformed surfaces interpenetrate all along the wheel from one patch to another.
bool is_unbroken(const Pair& pair, const WheelsetPosition& at, const RailPatch& from, const RailPatch& to) {
    const WheelSurface::Placed placed = pair.wheel.geometry().placed(at);
    constexpr int parts = 100;
    for (int k = 0; k <= parts; ++k) {
        const double part = double(k) / parts, x = from.x + part * (to.x - from.x);
        const RailSurface::Point p = placed.section(from.wheel_s + part * (to.wheel_s - from.wheel_s), x);
        if (!p.defined || !(pair.rail.above(p.y, p.z + at.height, p.slope[0], p.slope[1]).first < 0)) return false;
    }
    return true;
}

/// What of a contact depends on how it is asked for, by its height in place of its load, or on whether patches displace
/// each other; empty if nothing does that must not.
std::string unlike_at_its_height(const Pair& pair, WheelScene scene, const Contact& contact) {
    scene.at.height = contact.height;
    const auto vertical = [](const Contact& found) {
        double sum = found.dropped;
        for (const RailPatch& patch : found.patches) sum += patch.vertical_load();
        return sum;
    };
    const auto at_height = [&](bool interaction) {
        scene.options.interaction = interaction;
        WheelOnRail::Workspace workspace;
        return pair.wheel.solve_at_height(scene.at, workspace, scene.options);
    };
    const Contact same = at_height(true), alone = at_height(false);
    for (const auto& [found, how] : {std::pair(&same, "at its height: "), {&alone, "without interaction: "}}) {
        if (!has_numbers(found->status)) return std::string(how) + name(found->status);
    }
    const double again = vertical(same) / scene.load, more = vertical(alone) / scene.load;
    constexpr double by_cells = 0.02;
    if (std::abs(again - 1) > by_cells) return "at its height: " + shown(again) + " of the load";
    if (more < again - 1e-6) return "without interaction: " + shown(more / again) + " of the load";
    bool is_one = true;
    for (std::size_t k = 1; k < alone.patches.size(); ++k) {
        is_one = is_one && is_unbroken(pair, scene.at, alone.patches[0], alone.patches[k]);
    }
    if (is_one && more > again + by_cells)
        return "without interaction: " + shown(more / again) + " of one region's load";
    for (const auto& [one, other] : {std::pair(&same, &alone), {&alone, &same}}) {
        for (const RailPatch& patch : one->patches) {
            const auto parts = std::count_if(other->patches.begin(), other->patches.end(),
                                             [&](const RailPatch& part) { return presses(patch, part); });
            if (parts > 1) return "interaction: " + std::to_string(parts) + " patches in place of one";
        }
    }
    return {};
}

Outcome run_position(std::uint64_t seed) {
    Random random(seed);
    const Surfaces surfaces = drawn_surfaces(random);
    const Profile on = waved(s1002(), surfaces.waves, random),
                  below = waved(surfaces.canted(surfaces.cant), surfaces.waves, random);
    const Pair pair{WheelOnRail(on, below)};
    WheelScene scene = drawn_scene(random);
    const auto [outcome, contact] = judged(pair, pair.wheel, scene);
    std::string broken = unlike_its_mirror_image(pair.wheel, scene, contact);
    if (broken.empty() && has_numbers(contact.status)) broken = unlike_at_its_height(pair, scene, contact);
    if (!broken.empty()) return {.value = outcome.value, .told = broken};
    return outcome;
}

}  // namespace

Case contact_scene(std::uint64_t seed, bool in_slices) {
    const std::string pair = seed % 2 == 1 ? "S1002 on UIC 60" : "rough pair " + std::to_string(seed / 2 % pairs + 1),
                      name = pair + ", scene " + std::to_string(seed) + (in_slices ? " in slices" : "");
    return {name, "least gap", [=] { return run_contact(seed, in_slices); }};
}

Case position_scene(std::uint64_t seed) {
    Random random(seed);
    const Surfaces surfaces = drawn_surfaces(random);
    return {std::string("position ") + std::to_string(seed) + " of S1002 on " + surfaces.rail + ' ' + surfaces.state,
            "least gap", [=] { return run_position(seed); }};
}

}  // namespace extremes
