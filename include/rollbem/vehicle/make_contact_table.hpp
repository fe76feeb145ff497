// make_contact_table: the contact table of a wheelset from its profiles, with zones that fit them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../detail/parallel_for.hpp"
#include "../detail/require.hpp"
#include "contact_table.hpp"
#include "creep_force_table.hpp"
#include "detail/wheel_node.hpp"
#include "wheelset_forces.hpp"

namespace rollbem {

/// Equal steps of shift from minus the largest to the largest, and of yaw from 0; loads are 0.4, 0.65, 1 and 1.6 of the
/// nominal one.
inline ContactTable::Grid contact_table_grid(double nominal_load = 1e5, double largest_shift = 9e-3,
                                             std::size_t shifts = 361, double largest_yaw = 15e-3,
                                             std::size_t yaws = 4) {
    ContactTable::Grid grid;
    const auto last_shift = double(shifts) - 1, last_yaw = double(yaws) - 1;
    for (std::size_t i = 0; i < shifts; ++i) grid.shifts.push_back(largest_shift * (2 * double(i) / last_shift - 1));
    for (std::size_t k = 0; k < yaws; ++k) grid.yaws.push_back(largest_yaw * double(k) / last_yaw);
    for (const double share : {0.4, 0.65, 1.0, 1.6}) grid.loads.push_back(share * nominal_load);
    return grid;
}

/// What a contact table is made with.
struct ContactTableMaking {
    ContactTable::Grid grid = contact_table_grid();
    WheelOnRail::Options contacts{};
    /// Of the left and of the right wheel; empty: found.
    std::array<std::optional<ContactZones>, 2> zones{};
    std::size_t jobs = 1;
    std::function<void()> done = [] {};  ///< called after each of lines() lines of positions; must not throw
    std::size_t lines() const { return grid.yaws.size() * grid.loads.size(); }
};

/// A table, and what is to be known of its making.
struct MadeContactTable {
    ContactTable table;
    /// Share of the positions of the grid that wheels do not take under their loads: shifts beyond the first of them on
    /// either side are not on the table, single ones are filled by those beside them.
    double missing = 0;
};

namespace detail {

/// Nodes of a side, by ContactTable::Grid::node.
using WheelNodes = std::vector<WheelNode>;

/// Contacts of both wheels along one line of shifts.
class ContactLine {
public:
    ContactLine(const WheelsetOnTrack& track, const ContactTableMaking& making) : track_(track), making_(making) {}

    void solve(std::size_t load, std::size_t yaw, std::array<WheelNodes, 2>& nodes) const {
        const ContactTable::Grid& grid = making_.grid;
        const std::size_t count = grid.shifts.size();
        const bool mirrored = track_.is_mirrored();
        WheelsetOnTrack::Workspace workspace;
        WheelsetPosition start;
        start.yaw = grid.yaws[yaw];
        for (std::size_t i = mirrored ? count / 2 : 0; i < count; ++i) {
            start.lateral = grid.shifts[i];
            const double Q = grid.loads[load];
            const auto contacts = track_.solve(start, {Q, Q}, workspace, {}, making_.contacts);
            const bool carry = std::all_of(contacts.wheels.begin(), contacts.wheels.end(), [](const auto& wheel) {
                return !wheel.patches.empty() && (has_numbers(wheel.status) || wheel.status == Status::few_cells);
            });
            if (!carry) {
                workspace = {};
                start.roll = 0;
                continue;
            }
            start.roll = contacts.position.roll;
            for (const WheelsetSide side : WheelsetOnTrack::sides) {
                const bool right = side == WheelsetSide::right;
                const std::size_t place = right ? i : count - 1 - i;
                if (!right && mirrored && place == i) continue;
                auto& of = nodes[mirrored ? 0 : std::size_t(side)];
                of[std::size_t(grid.node(load, yaw, place))] = node_of(contacts, side);
            }
        }
    }

private:
    /// The left wheel, a right one at the opposite shift and yaw, is mirrored across the track.
    WheelNode node_of(const WheelsetOnTrack::Contacts& contacts, WheelsetSide side) const {
        const bool right = side == WheelsetSide::right;
        WheelNode node;
        node.at = contacts.seen(side);
        if (!right) node.at = mirrored(node.at, Mirror::along_track());
        node.at.yaw = std::abs(node.at.yaw);
        node.pitch_per_metre = free_pitch_rate(track_, contacts, {.forward = 1});
        node.support = contacts.position.height + ContactTable::support_y * node.at.roll;
        std::vector<RailPatch> patches = contacts.wheels[std::size_t(side)].patches;
        if (!right) {
            for (RailPatch& patch : patches) patch = mirrored(std::move(patch), Mirror::along_track());
        }
        node.patches = patch_laws(patches, track_.wheel(side).dimensions(), node.at.yaw == 0);
        return node;
    }

    const WheelsetOnTrack& track_;
    const ContactTableMaking& making_;
};

/// Cuts between zones, one after the other: each as lowers most the error of ellipses beside friction on patches and
/// the price of more points a wheel.
class ZoneFinder {
public:
    ZoneFinder(const std::vector<const WheelNode*>& nodes, const TrackDimensions& dimensions,
               const CreepForceTable& creep, std::size_t jobs)
        : dimensions_(dimensions), creep_(creep), jobs_(jobs) {
        for (const WheelNode* node : nodes) {
            if (!node->patches.empty()) judged_.push_back({node, node->vertical(), {}});
        }
        parallel_for(judged_.size(), jobs_, [&](std::size_t i) {
            Judged& one = judged_[i];
            const auto motions = judged_motions(*one.node);
            for (std::size_t k = 0; k < motions.size(); ++k) {
                one.friction[k] = forces_of_patches(*one.node, motions[k], dimensions_, mu);
            }
        });
    }

    ContactZones find() const {
        ContactZones best;
        double least = cost(best);
        while (best.count() < ContactZones::most) {
            const std::vector<ContactZones> others = candidates(best);
            std::vector<double> costs(others.size());
            parallel_for(others.size(), jobs_, [&](std::size_t i) { costs[i] = cost(others[i]); });
            const auto lowest = std::min_element(costs.begin(), costs.end());
            constexpr double gain = 2e-4;
            if (lowest == costs.end() || !(*lowest < least - gain)) break;
            least = *lowest;
            best = others[std::size_t(lowest - costs.begin())];
        }
        return best;
    }

    /// The mean of errors over mu Q, which weighs the largest most, and the price.
    double cost(const ContactZones& zones) const {
        constexpr double price = 0.005;
        double sum = 0;
        std::size_t points = 0, count = 0;
        for (const Judged& one : judged_) {
            const auto rows = zone_rows(*one.node, zones, dimensions_, creep_);
            for (const auto& v : rows) points += v[ContactRow::share] > 0;
            const auto motions = judged_motions(*one.node);
            for (std::size_t k = 0; k < motions.size(); ++k) {
                if (!one.friction[k].isFinite().all()) continue;
                const RollingForces own =
                    forces_of_zones(rows, *one.node, one.vertical, motions[k], dimensions_, creep_, mu);
                const double error = (own - one.friction[k]).abs().maxCoeff() / (mu * one.vertical);
                sum += std::pow(error, 4);
                ++count;
            }
        }
        if (count == 0) return 0;
        return std::pow(sum / double(count), 0.25) + price * (double(points) / double(judged_.size()) - 1);
    }

private:
    static constexpr double mu = 0.3;
    struct Judged {
        const WheelNode* node;
        double vertical;
        std::array<RollingForces, 3> friction;
    };

    std::vector<ContactZones> candidates(const ContactZones& from) const {
        constexpr double step = 2e-3;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Judged& one : judged_) {
            for (const PatchLaws& of : one.node->patches) {
                low = (std::min)(low, of.patch.y - of.patch.half_width);
                high = (std::max)(high, of.patch.y + of.patch.half_width);
            }
        }
        std::vector<ContactZones> found;
        for (double y = step * std::ceil(low / step); y < high; y += step) {
            for (const double half_width : {2e-3, 4e-3}) {
                std::vector<ContactZones::Cut> cuts = from.cuts();
                const ContactZones::Cut own{y, half_width};
                const auto place = std::find_if(cuts.begin(), cuts.end(), [&](const auto& cut) { return cut.y > y; });
                const auto apart = [&](const auto& cut) {
                    return std::abs(cut.y - y) >= (cut.half_width + half_width) * (1 + 1e-9);
                };
                if (!std::all_of(cuts.begin(), cuts.end(), apart)) continue;
                cuts.insert(place, own);
                found.emplace_back(std::move(cuts));
            }
        }
        return found;
    }

    const TrackDimensions& dimensions_;
    const CreepForceTable& creep_;
    std::size_t jobs_;
    std::vector<Judged> judged_;
};

/// Odd rows are over the yaw: at yaw 0 they lie on the line in yaw^2 through the first two others that carry.
inline void fill_odd_rows(const ContactTable::Grid& grid, Eigen::Ref<Eigen::ArrayXXd> points) {
    using enum ContactRow::Of;
    const auto shifts = Eigen::Index(grid.shifts.size());
    const std::size_t yaws = grid.yaws.size();
    for (std::size_t l = 0; l < grid.loads.size(); ++l) {
        for (Eigen::Index i = 0; i < shifts; ++i) {
            const auto node = [&](std::size_t k) { return grid.node(l, k, std::size_t(i)); };
            if (!(points(share, node(0)) > 0)) continue;
            for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
                const Eigen::Index entry = row - correction_by_yaw;
                if (row != arm_x && (entry < 0 || entry >= 9)) continue;
                std::vector<std::size_t> with;
                for (std::size_t k = 1; k < yaws && with.size() < 2; ++k) {
                    if (points(share, node(k)) > 0) with.push_back(k);
                }
                double value = with.empty() ? 0 : points(row, node(with[0]));
                if (with.size() == 2) {
                    const double one = std::pow(grid.yaws[with[0]], 2), two = std::pow(grid.yaws[with[1]], 2);
                    value -= one * (points(row, node(with[1])) - value) / (two - one);
                }
                points(row, node(0)) = value;
            }
        }
    }
}

/// How many shifts from either end are left out, as at them, or at two in a row, some node is not known.
inline std::size_t left_out(const ContactTable::Grid& grid, const std::vector<WheelNodes>& sides) {
    const std::size_t count = grid.shifts.size(), middle = count / 2;
    const auto known = [&](std::size_t i) {
        for (const WheelNodes& nodes : sides) {
            for (std::size_t line = 0; line < nodes.size(); line += count) {
                if (nodes[line + i].patches.empty() || nodes[line + count - 1 - i].patches.empty()) return false;
            }
        }
        return true;
    };
    std::size_t last = middle;
    for (std::size_t i = middle; i < count; ++i) {
        if (known(i)) last = i;
        if (i > last + 1) break;
    }
    return count - 1 - last;
}

/// The rows of one side, and heights and rolls; `out` shifts at either end are left out.
inline ContactTable::Side side_of(const ContactTable::Grid& grid, const WheelNodes& nodes, std::size_t out,
                                  const ContactZones& zones, const TrackDimensions& dimensions,
                                  const CreepForceTable& creep, std::size_t jobs) {
    const std::size_t all = grid.shifts.size() + 2 * out, lines = nodes.size() / all;
    const Eigen::Index count = grid.nodes();
    ContactTable::Side side{.radius = dimensions.radius,
                            .zones = zones,
                            .on_rails = Eigen::ArrayXXd::Zero(2, count),
                            .points = Eigen::ArrayXXd::Zero(ContactRow::rows, count * zones.count())};
    const auto take = [&](std::size_t line, std::size_t i) {
        const WheelNode& node = nodes[line * all + out + i];
        const auto at = Eigen::Index(line * grid.shifts.size() + i);
        if (node.patches.empty()) return;
        side.on_rails.col(at) << node.support, node.at.roll;
        const auto rows = zone_rows(node, zones, dimensions, creep);
        for (Eigen::Index zone = 0; zone < zones.count(); ++zone) {
            side.points.col(zone * count + at) = rows[std::size_t(zone)];
        }
    };
    parallel_for(lines, jobs, [&](std::size_t line) {
        for (std::size_t i = 0; i < grid.shifts.size(); ++i) take(line, i);
    });
    for (std::size_t node = 0; node < std::size_t(count); ++node) {  // single ones between known ones
        const std::size_t line = node / grid.shifts.size(), i = node % grid.shifts.size();
        if (!nodes[line * all + out + i].patches.empty()) continue;
        const auto at = Eigen::Index(node);
        side.on_rails.col(at) = (side.on_rails.col(at - 1) + side.on_rails.col(at + 1)) / 2;
        for (Eigen::Index zone = 0; zone < zones.count(); ++zone) {
            const Eigen::Index own = zone * count + at;
            const ContactRow::Values before = side.points.col(own - 1), after = side.points.col(own + 1);
            const bool both = before[ContactRow::share] > 0 && after[ContactRow::share] > 0;
            side.points.col(own) = both ? (before + after) / 2 : before[ContactRow::share] > 0 ? before : after;
            side.points(ContactRow::share, own) = (before[ContactRow::share] + after[ContactRow::share]) / 2;
        }
    }
    for (Eigen::Index zone = 0; zone < zones.count(); ++zone) {
        fill_odd_rows(grid, side.points.middleCols(zone * count, count));
    }
    return side;
}

}  // namespace detail

/// The table of a wheelset whose wheels carry equal loads; `creep` is the table that it will be used with. One side
/// stands for both where they are mirror images. Throws std::invalid_argument if the grid breaks its invariant, the
/// wheels do not carry the loads at five shifts about 0, or a wheel is not round or a rail changes along the way.
inline MadeContactTable make_contact_table(const WheelsetOnTrack& track, const CreepForceTable& creep,
                                           const ContactTableMaking& making = {}) {
    constexpr const char* name = "make_contact_table";
    const bool mirrored = track.is_mirrored();
    for (const WheelsetSide side : WheelsetOnTrack::sides) {
        detail::require(track.wheel(side).geometry().is_plain(), name, "surface", "changes along the way",
                        "be a round wheel or a straight rail of one profile");
    }
    ContactTable::Grid grid = making.grid;
    const std::size_t sides = mirrored ? 1 : 2;
    const auto dimensions_of = [&](std::size_t k) -> const TrackDimensions& {
        return track.wheel(mirrored || k == 1 ? WheelsetSide::right : WheelsetSide::left).dimensions();
    };
    const TrackDimensions& dimensions = dimensions_of(1);
    const ContactTable::Material material{dimensions.shear_modulus, dimensions.poisson_ratio};
    {  // checks the grid
        ContactTable::Side none{.radius = dimensions.radius};
        none.on_rails.setZero(2, grid.nodes());
        none.points.setZero(ContactRow::rows, grid.nodes());
        ContactTable(grid, material, {std::move(none)});
    }
    // 1. Contacts at all nodes
    std::array<detail::WheelNodes, 2> found;
    for (auto& nodes : found) nodes.resize(std::size_t(grid.nodes()));
    const detail::ContactLine line(track, making);
    const std::size_t loads = grid.loads.size();
    detail::parallel_for(
        making.lines(), making.jobs, [&](std::size_t k) { line.solve(k % loads, k / loads, found); }, making.done);
    // 2. The shifts that are on the table
    std::vector<detail::WheelNodes> nodes;
    for (std::size_t k = 0; k < sides; ++k) nodes.push_back(std::move(found[k]));
    std::size_t missing = 0;
    for (const auto& of : nodes) {
        missing +=
            std::size_t(std::count_if(of.begin(), of.end(), [](const auto& node) { return node.patches.empty(); }));
    }
    const double share = double(missing) / double(grid.nodes() * Eigen::Index(sides));
    const std::size_t out = detail::left_out(grid, nodes), all = grid.shifts.size();
    detail::require(all >= 2 * out + 5, name, "number of shifts about 0 at which wheels carry their loads",
                    all - (std::min)(2 * out, all), "be at least 5: does the wheelset fit the track?");
    grid.shifts = {grid.shifts.begin() + std::ptrdiff_t(out), grid.shifts.end() - std::ptrdiff_t(out)};
    // 3. Zones and their rows
    std::vector<ContactTable::Side> made;
    for (std::size_t k = 0; k < sides; ++k) {
        const TrackDimensions& own = dimensions_of(k);
        const auto& given = making.zones[mirrored ? 1 : k];
        ContactZones zones;
        if (given) {
            zones = *given;
        } else {
            std::vector<const detail::WheelNode*> judged;  // every second one along all coordinates
            for (std::size_t load = 0; load < loads; load += 2) {
                for (std::size_t yaw = 0; yaw < grid.yaws.size(); yaw += 2) {
                    for (std::size_t i = out; i + out < all; i += 2) {
                        judged.push_back(&nodes[k][std::size_t(making.grid.node(load, yaw, i))]);
                    }
                }
            }
            zones = detail::ZoneFinder(judged, own, creep, making.jobs).find();
        }
        made.push_back(detail::side_of(grid, nodes[k], out, zones, own, creep, making.jobs));
    }
    return {ContactTable(std::move(grid), material, std::move(made)), share};
}

}  // namespace rollbem
