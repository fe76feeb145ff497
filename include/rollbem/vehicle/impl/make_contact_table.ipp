// Bodies of vehicle/make_contact_table.hpp. Internal.
#pragma once

#include "../make_contact_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <Eigen/Core>

#include "../../detail/parallel_for.hpp"
#include "../../detail/require.hpp"
#include "../../normal/detail/mirrored_patch.hpp"
#include "../../scene/detail/mirror.hpp"
#include "../detail/free_pitch_rate.hpp"
#include "../detail/wheel_node.hpp"
#include "../wheelset_forces.hpp"

namespace rollbem {

ROLLBEM_DECL ContactTable::Grid contact_table_grid(double nominal_load, double largest_shift, std::size_t shifts,
                                                   double largest_yaw, std::size_t yaws) {
    ContactTable::Grid grid;
    const auto last_shift = double(shifts) - 1, last_yaw = double(yaws) - 1;
    for (std::size_t i = 0; i < shifts; ++i) grid.shifts.push_back(largest_shift * (2 * double(i) / last_shift - 1));
    for (std::size_t k = 0; k < yaws; ++k) grid.yaws.push_back(largest_yaw * double(k) / last_yaw);
    for (const double share : {0.4, 0.65, 1.0, 1.6}) grid.loads.push_back(share * nominal_load);
    return grid;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Contacts of both wheels along one line of shifts.
class ContactLine {
public:
    ContactLine(const WheelsetOnTrack& track, const ContactTableMaker::Options& options)
        : track_(track), options_(options) {}

    template <class Nodes>
    void solve(std::size_t line, Nodes& nodes) const {
        const ContactTable::Grid& grid = options_.grid;
        const std::size_t count = grid.shifts.size(), load = line / grid.yaws.size(), yaw = line % grid.yaws.size();
        const bool mirrored = track_.is_mirrored();
        WheelsetOnTrack::Workspace workspace;
        WheelsetPosition start;
        start.yaw = grid.yaws[yaw];
        for (std::size_t i = mirrored ? count / 2 : 0; i < count; ++i) {
            start.lateral = grid.shifts[i];
            const double Q = grid.loads[load];
            const auto contacts = track_.solve(start, {Q, Q}, workspace, {}, options_.contacts);
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
                of[line * count + place].wheel = node_of(contacts, side);
            }
        }
    }

private:
    /// The node of a wheel. The left wheel, a right one at the opposite shift and yaw, is mirrored across the track.
    WheelNode node_of(const WheelsetOnTrack::Contacts& contacts, WheelsetSide side) const {
        const bool right = side == WheelsetSide::right;
        WheelNode node;
        node.at = contacts.seen(side);
        if (!right) node.at = mirrored(node.at, Mirror::reversing_x());
        node.at.yaw = std::abs(node.at.yaw);
        node.pitch_per_metre = free_pitch_rate(track_, contacts, {.forward = 1});
        node.support = contacts.position.height + ContactTable::half_base * node.at.roll;
        std::vector<RailPatch> patches = contacts.wheels[std::size_t(side)].patches;
        if (!right) {
            for (RailPatch& patch : patches) patch = mirrored(std::move(patch), Mirror::reversing_x());
        }
        node.patches = patch_creep_matrices(patches, track_.wheel(side).dimensions(), node.at.yaw == 0);
        return node;
    }

    const WheelsetOnTrack& track_;
    const ContactTableMaker::Options& options_;
};

/// A node by which zones are found.
struct JudgedNode {
    const WheelNode* node;
    const std::vector<NodeFriction>* motions;
};

/// Finds cuts between zones, one after the other. Each cut minimises the product of the error of ellipses relative to
/// friction on patches, and of the time of a look-up.
class ZoneFinder {
public:
    ZoneFinder(const std::vector<JudgedNode>& nodes, const WheelOnRail::Dimensions& dimensions,
               const CreepForceTable& creep, std::size_t jobs)
        : dimensions_(dimensions), creep_(creep), jobs_(jobs) {
        for (const auto& [node, motions] : nodes) {
            if (node->patches.empty() || motions->empty()) continue;
            Judged& one = judged_.emplace_back(Judged{node, motions, node->vertical(), {}});
            for (const NodeFriction& motion : *motions) one.friction.push_back(motion.sum());
        }
    }

    ContactTable::Zones find() const {
        ContactTable::Zones best;
        double least = cost(best);
        while (best.count() < ContactTable::Zones::most) {
            const std::vector<ContactTable::Zones> others = candidates(best);
            std::vector<double> costs(others.size());
            parallel_for(others.size(), jobs_, [&](std::size_t i) { costs[i] = cost(others[i]); });
            const auto lowest = std::min_element(costs.begin(), costs.end());
            if (lowest == costs.end() || !(*lowest < least)) break;
            least = *lowest;
            best = others[std::size_t(lowest - costs.begin())];
        }
        return best;
    }

    /// The mean of errors over mu Q, which gives the largest errors most weight, and what a table has besides, times
    /// the time of a look-up in units of a further point's.
    double cost(const ContactTable::Zones& zones) const {
        constexpr double other_errors = 2e-3, time_without_points = 0.5;
        double sum = 0;
        std::size_t points = 0, count = 0;
        for (const Judged& one : judged_) {
            const auto found = zone_rows(*one.node, zones, dimensions_, creep_);
            for (const auto& v : found) points += v[ContactRow::share] > 0;
            for (std::size_t k = 0; k < one.friction.size(); ++k) {
                const RollingForces own =
                    forces_of_zones(found, *one.node, one.vertical, (*one.motions)[k], dimensions_, creep_);
                const double error =
                    (own - one.friction[k]).abs().maxCoeff() / (node_friction_coefficient * one.vertical);
                sum += std::pow(error, 4);
                ++count;
            }
        }
        if (count == 0) return 0;
        return (std::pow(sum / double(count), 0.25) + other_errors) *
               (double(points) / double(judged_.size()) + time_without_points);
    }

private:
    struct Judged {
        const WheelNode* node;
        const std::vector<NodeFriction>* motions;
        double vertical;
        std::vector<RollingForces> friction;
    };

    std::vector<ContactTable::Zones> candidates(const ContactTable::Zones& from) const {
        constexpr double step = 1e-3;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Judged& one : judged_) {
            for (const PatchCreepMatrices& of : one.node->patches) {
                low = (std::min)(low, of.patch.y - of.patch.half_width);
                high = (std::max)(high, of.patch.y + of.patch.half_width);
            }
        }
        std::vector<ContactTable::Zones> found;
        for (double y = step * std::ceil(low / step); y < high; y += step) {
            for (const double half_width : {2e-3, 4e-3}) {
                std::vector<ContactTable::Zones::Cut> cuts = from.cuts();
                const ContactTable::Zones::Cut own{y, half_width};
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

    const WheelOnRail::Dimensions& dimensions_;
    const CreepForceTable& creep_;
    std::size_t jobs_;
    std::vector<Judged> judged_;
};

/// Fills rows that are odd in the yaw and divided by it: at yaw 0 they lie on the line in yaw^2 through the first two
/// other nodes that carry.
inline void fill_odd_rows(const ContactTable::Grid& grid, Eigen::Ref<Eigen::ArrayXXd> points) {
    using enum ContactRow::Of;
    const auto shifts = Eigen::Index(grid.shifts.size());
    const std::size_t yaws = grid.yaws.size();
    for (std::size_t l = 0; l < grid.loads.size(); ++l) {
        for (Eigen::Index i = 0; i < shifts; ++i) {
            const auto node = [&](std::size_t k) { return grid.node(l, k, std::size_t(i)); };
            if (!(points(share, node(0)) > 0)) continue;
            for (Eigen::Index row = 0; row < ContactRow::rows; ++row) {
                if (row != arm_x && correction_by_yaw > row) continue;  // the other way round is a template to clang
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

/// Number of shifts left out at either end, because a node there, or at two neighbouring shifts, is not known.
inline std::size_t left_out(const ContactTable::Grid& grid, const std::vector<ContactTableMaker::Side>& sides) {
    const std::size_t count = grid.shifts.size(), middle = count / 2;
    const auto known = [&](std::size_t i) {
        for (const ContactTableMaker::Side& side : sides) {
            for (std::size_t line = 0; line < side.nodes.size(); line += count) {
                if (!side.nodes[line + i].known || !side.nodes[line + count - 1 - i].known) return false;
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

/// The numbers of one side on a grid without the `out` outermost shifts at either end.
inline ContactTable::Side side_of(const ContactTable::Grid& grid, const ContactTableMaker::Side& from, std::size_t out,
                                  double radius) {
    const std::size_t all = grid.shifts.size() + 2 * out;
    const Eigen::Index count = grid.nodes(), zones = from.zones.count();
    ContactTable::Side side{.radius = radius,
                            .zones = from.zones,
                            .on_rails = Eigen::ArrayXXd::Zero(2, count),
                            .points = Eigen::ArrayXXd::Zero(ContactRow::rows, count * zones)};
    const auto node_at = [&](Eigen::Index at) -> const ContactTableMaker::Node& {
        const auto shifts = Eigen::Index(grid.shifts.size());
        return from.nodes[std::size_t(at / shifts) * all + out + std::size_t(at % shifts)];
    };
    for (Eigen::Index at = 0; at < count; ++at) {
        const ContactTableMaker::Node& node = node_at(at);
        if (!node.known) continue;
        side.on_rails.col(at) << node.support, node.roll;
        for (Eigen::Index zone = 0; zone < zones; ++zone) {
            side.points.col(zone * count + at) = node.zones[std::size_t(zone)];
        }
    }
    for (Eigen::Index at = 0; at < count; ++at) {  // single unknown nodes between known ones
        if (node_at(at).known) continue;
        side.on_rails.col(at) = (side.on_rails.col(at - 1) + side.on_rails.col(at + 1)) / 2;
        for (Eigen::Index zone = 0; zone < zones; ++zone) {
            const Eigen::Index own = zone * count + at;
            const ContactRow::Values before = side.points.col(own - 1), after = side.points.col(own + 1);
            const bool both = before[ContactRow::share] > 0 && after[ContactRow::share] > 0;
            side.points.col(own) = both ? (before + after) / 2 : before[ContactRow::share] > 0 ? before : after;
            side.points(ContactRow::share, own) = (before[ContactRow::share] + after[ContactRow::share]) / 2;
        }
    }
    for (Eigen::Index zone = 0; zone < zones; ++zone) {
        fill_odd_rows(grid, side.points.middleCols(zone * count, count));
    }
    return side;
}

}  // namespace rollbem::detail

namespace rollbem {

struct ContactTableMaker::Nodes {
    struct Node {
        detail::WheelNode wheel;
        std::vector<detail::NodeFriction> friction;  ///< where zones are judged or ellipses fitted
        std::vector<ContactRow::Values> zones;       ///< their rows
    };
    std::array<std::vector<Node>, 2> of;
};

ROLLBEM_DECL ContactTableMaker::ContactTableMaker(const WheelsetOnTrack& track, const CreepForceTable& creep,
                                                  ContactTableMaker::Options options)
    : track_(track), creep_(creep), options_(std::move(options)), is_solved_(options_.lines(), false) {
    for (const WheelsetSide side : WheelsetOnTrack::sides) {
        detail::require(track.wheel(side).geometry().is_plain(), name, "surface", "changes along the way",
                        "be a round wheel or a straight rail of one profile");
    }
    ContactTable::Side none{.radius = dimensions(side_count() - 1).radius};  // checks the grid
    none.on_rails.setZero(2, options_.grid.nodes());
    none.points.setZero(ContactRow::rows, options_.grid.nodes());
    ContactTable(options_.grid, material(), {std::move(none)});
    for (auto& nodes : nodes_.made().of) nodes.resize(std::size_t(options_.grid.nodes()));
}

ROLLBEM_DECL auto ContactTableMaker::judged_lines() const -> std::vector<std::size_t> {
    std::vector<std::size_t> lines;
    const std::size_t yaws = options_.grid.yaws.size();
    bool given = true;
    for (std::size_t side = 0; side < side_count(); ++side) given = given && given_zones(side).has_value();
    for (std::size_t line = 0; line < options_.lines() && !given; ++line) {
        if (line / yaws % 2 == 0 && line % yaws % 2 == 0) lines.push_back(line);
    }
    return lines;
}

ROLLBEM_DECL void ContactTableMaker::solve(std::vector<std::size_t> lines) {
    const std::vector<std::size_t> judged = judged_lines();
    std::vector<std::size_t> contacts = lines;
    contacts.insert(contacts.end(), judged.begin(), judged.end());
    std::sort(contacts.begin(), contacts.end());
    contacts.erase(std::unique(contacts.begin(), contacts.end()), contacts.end());
    std::erase_if(contacts, [&](std::size_t line) { return is_solved_[line]; });
    const detail::ContactLine line(track_, options_);
    detail::parallel_for(
        contacts.size(), options_.jobs, [&](std::size_t k) { line.solve(contacts[k], nodes_.made().of); },
        options_.done);
    for (const std::size_t solved : contacts) is_solved_[solved] = true;
    for (std::size_t side = 0; side < side_count(); ++side) {
        zones_[side] = zones_of(side);
        detail::parallel_for(
            lines.size(), options_.jobs, [&](std::size_t k) { fill_line(side, lines[k]); }, options_.done);
    }
}

ROLLBEM_DECL void ContactTableMaker::solve_friction(std::size_t side, std::size_t place) {
    Nodes::Node& node = nodes_.made().of[side][place];
    if (node.friction.empty()) node.friction = detail::friction_of(node.wheel, dimensions(side));
}

ROLLBEM_DECL void ContactTableMaker::fill_line(std::size_t side, std::size_t line) {
    auto& nodes = nodes_.made().of[side];
    const std::size_t shifts = options_.grid.shifts.size();
    for (std::size_t place = line * shifts; place < (line + 1) * shifts; ++place) {
        const detail::WheelNode& wheel = nodes[place].wheel;
        if (!wheel.patches.empty())
            nodes[place].zones = detail::zone_rows(wheel, zones_[side], dimensions(side), creep_);
    }
    if (!options_.fits_friction) return;
    const std::vector<std::size_t> fitted = fitted_places(side, line);
    for (std::size_t k = 0; k < fitted.size(); ++k) {
        solve_friction(side, fitted[k]);
        Nodes::Node& node = nodes[fitted[k]];
        detail::fit_bends(node.zones, zones_[side], node.wheel, node.friction, dimensions(side), creep_);
        if (k > 0) interpolate_bends(side, fitted[k - 1], fitted[k]);
    }
}

ROLLBEM_DECL std::vector<std::size_t> ContactTableMaker::fitted_places(std::size_t side, std::size_t line) const {
    constexpr double wide = 0.4e-3, narrow = 0.1e-3;  // [m]
    const auto& nodes = nodes_.get().of[side];
    const std::vector<double>& shifts = options_.grid.shifts;
    std::vector<std::size_t> found;
    std::size_t last = 0;
    for (std::size_t i = 0; i < shifts.size(); ++i) {
        const std::size_t place = line * shifts.size() + i;
        const auto carries = [&](std::size_t at) { return !nodes[at].zones.empty(); };
        if (!carries(place)) continue;
        const bool is_steep = std::any_of(nodes[place].zones.begin(), nodes[place].zones.end(), [](const auto& v) {
            constexpr double steep = 0.12;  // [rad]
            return v[ContactRow::share] > 0 && std::abs(v[ContactRow::angle] + v[ContactRow::plane]) > steep;
        });
        const bool ends = i + 1 == shifts.size() || !carries(place + 1) || found.empty() || !carries(place - 1);
        if (!ends && shifts[i] - shifts[last] < (is_steep ? narrow : wide) * (1 - 1e-9)) continue;
        last = i;
        found.push_back(place);
    }
    return found;
}

ROLLBEM_DECL void ContactTableMaker::interpolate_bends(std::size_t side, std::size_t low, std::size_t high) {
    auto& nodes = nodes_.made().of[side];
    const std::vector<double>& shifts = options_.grid.shifts;
    const auto bend = [](ContactRow::Values& of) { return of.segment<9>(ContactRow::bend); };
    for (std::size_t place = low + 1; place < high; ++place) {
        const auto shift = [&](std::size_t at) { return shifts[at % shifts.size()]; };
        const double part = (shift(place) - shift(low)) / (shift(high) - shift(low));
        for (std::size_t zone = 0; zone < nodes[place].zones.size(); ++zone) {
            ContactRow::Values &before = nodes[low].zones[zone], &after = nodes[high].zones[zone];
            // where a zone begins to carry, the end that carries
            const double weight = !(before[ContactRow::share] > 0) ? 1 : !(after[ContactRow::share] > 0) ? 0 : part;
            bend(nodes[place].zones[zone]) = (1 - weight) * bend(before) + weight * bend(after);
        }
    }
}

ROLLBEM_DECL auto ContactTableMaker::node(std::size_t side, std::size_t line, std::size_t shift) const
    -> ContactTableMaker::Node {
    const Nodes::Node& own = nodes_.get().of[side][line * options_.grid.shifts.size() + shift];
    if (own.wheel.patches.empty()) return {};
    return {true, own.wheel.support, own.wheel.at.roll, own.zones};
}

ROLLBEM_DECL auto ContactTableMaker::table(const std::vector<ContactTableMaker::Side>& sides) const
    -> ContactTableMaker::Result {
    ContactTable::Grid grid = options_.grid;
    require_whole(sides);
    std::size_t missing = 0;
    for (const ContactTableMaker::Side& side : sides) {
        missing += std::size_t(std::count_if(side.nodes.begin(), side.nodes.end(),
                                             [](const ContactTableMaker::Node& node) { return !node.known; }));
    }
    const double share = double(missing) / double(grid.nodes() * Eigen::Index(sides.size()));
    const std::size_t out = detail::left_out(grid, sides), all = grid.shifts.size();
    detail::require(all >= 2 * out + 5, name, "number of shifts about 0 at which wheels carry their loads",
                    all - (std::min)(2 * out, all), "be at least 5: does the wheelset fit the track?");
    grid.shifts = {grid.shifts.begin() + std::ptrdiff_t(out), grid.shifts.end() - std::ptrdiff_t(out)};
    std::vector<ContactTable::Side> made;
    for (std::size_t k = 0; k < sides.size(); ++k) {
        made.push_back(detail::side_of(grid, sides[k], out, dimensions(k).radius));
    }
    return {ContactTable(std::move(grid), material(), std::move(made)), share};
}

ROLLBEM_DECL void ContactTableMaker::require_whole(const std::vector<ContactTableMaker::Side>& sides) const {
    detail::require(sides.size() == side_count(), name, "number of sides", sides.size(),
                    "be the number of sides of the wheelset");
    for (const ContactTableMaker::Side& side : sides) {
        detail::require(Eigen::Index(side.nodes.size()) == options_.grid.nodes(), name, "number of nodes",
                        side.nodes.size(), "be the number of nodes of the grid");
        for (const ContactTableMaker::Node& node : side.nodes) {
            detail::require(!node.known || Eigen::Index(node.zones.size()) == side.zones.count(), name,
                            "number of rows of a node", node.zones.size(), "be the number of zones");
        }
    }
}

ROLLBEM_DECL auto ContactTableMaker::material() const -> ContactTable::Material {
    const WheelOnRail::Dimensions& right = dimensions(side_count() - 1);
    return {right.shear_modulus, right.poisson_ratio};
}

ROLLBEM_DECL std::vector<std::size_t> ContactTableMaker::judged_places(std::size_t side) const {
    constexpr double step = 0.2e-3;  // [m]
    std::vector<std::size_t> found;
    if (given_zones(side)) return found;
    const std::vector<double>& shifts = options_.grid.shifts;
    const auto& nodes = nodes_.get().of[side];
    ContactTableMaker::Side known;
    for (const std::size_t line : judged_lines()) {
        for (std::size_t i = 0; i < shifts.size(); ++i) {
            known.nodes.push_back({.known = !nodes[line * shifts.size() + i].wheel.patches.empty()});
        }
    }
    const std::size_t out = detail::left_out(options_.grid, {known});
    for (const std::size_t line : judged_lines()) {
        std::size_t last = out;
        for (std::size_t i = out; i + out < shifts.size(); ++i) {
            if (i > out && shifts[i] - shifts[last] < step * (1 - 1e-9)) continue;
            last = i;
            found.push_back(line * shifts.size() + i);
        }
    }
    return found;
}

ROLLBEM_DECL auto ContactTableMaker::zones_of(std::size_t side) -> ContactTable::Zones {
    if (given_zones(side)) return *given_zones(side);
    const std::vector<std::size_t> places = judged_places(side);
    detail::parallel_for(places.size(), options_.jobs, [&](std::size_t k) { solve_friction(side, places[k]); });
    std::vector<detail::JudgedNode> judged;
    for (const std::size_t place : places) {
        const Nodes::Node& node = nodes_.get().of[side][place];
        judged.push_back({&node.wheel, &node.friction});
    }
    return detail::ZoneFinder(judged, dimensions(side), creep_, options_.jobs).find();
}

ROLLBEM_DECL ContactTableMaker::Result make_contact_table(const WheelsetOnTrack& track, const CreepForceTable& creep,
                                                          const ContactTableMaker::Options& options) {
    ContactTableMaker maker(track, creep, options);
    std::vector<std::size_t> lines(options.lines());
    std::iota(lines.begin(), lines.end(), std::size_t(0));
    maker.solve(lines);
    std::vector<ContactTableMaker::Side> sides;
    const std::size_t shifts = options.grid.shifts.size();
    for (std::size_t k = 0; k < maker.side_count(); ++k) {
        ContactTableMaker::Side& side = sides.emplace_back(ContactTableMaker::Side{maker.zones(k), {}});
        side.nodes.resize(lines.size() * shifts);
        for (std::size_t i = 0; i < side.nodes.size(); ++i) side.nodes[i] = maker.node(k, i / shifts, i % shifts);
    }
    return maker.table(sides);
}

}  // namespace rollbem
