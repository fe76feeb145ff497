// One wheel at a node of a contact table: its patches with their creep matrices, friction on them, and the rows of its
// zones, fitted to that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "../../normal/detail/mirrored_patch.hpp"
#include "../../scene/detail/mirror.hpp"
#include "../contact_table.hpp"
#include "../wheelset_forces.hpp"
#include "creep_matrices.hpp"
#include "ellipse_creepages.hpp"
#include "wheelset_velocity.hpp"

namespace rollbem::detail {

/// A right wheel on its rail.
struct WheelNode {
    WheelsetPosition at;                      ///< position as the wheel sees it, with its own height
    double support = 0;                       ///< height of the wheelset, z_ws, plus half_base times the roll [m]
    double pitch_per_metre = 0;               ///< pitch of the wheelset that rolls freely straight on [rad/m]
    std::vector<PatchCreepMatrices> patches;  ///< empty: not found

    double vertical() const { return pressures_of(patches, {}, 0).vertical(); }
};

/// Friction of one wheel in track axes, F_x and F_y [N].
using RollingForces = Eigen::Array2d;

/// Coefficient of friction by which zones are judged and fitted. Rows depend on mu N alone, so that they hold for
/// others.
inline constexpr double node_friction_coefficient = 0.3;

/// Friction on the patches of a node under one motion. At the opposite yaw, where `mirror` is -1, patches are mirror
/// images.
struct NodeFriction {
    /// A strip of elements, in track axes.
    struct Strip {
        double y;             ///< its middle [m]
        RollingForces force;  ///< [N]
    };
    double mirror;
    WheelsetPosition at;
    WheelsetSpeeds speeds;
    std::vector<Strip> strips;

    RollingForces sum() const {
        RollingForces all = RollingForces::Zero();
        for (const Strip& strip : strips) all += strip.force;
        return all;
    }
    RollingForces in_zone(const ContactTable::Zones& zones, Eigen::Index zone) const {
        RollingForces all = RollingForces::Zero();
        for (const Strip& strip : strips) all += zones.weight(zone, strip.y) * strip.force;
        return all;
    }
};

/// Motions whose linear forces are about 0.25, 0.7 and 2 mu Q, in directions all around, straight on; and in curves to
/// both sides, where spin is large.
inline std::vector<WheelsetSpeeds> reference_motions(const WheelNode& node, double yaw, bool curves,
                                                     double shear_modulus) {
    constexpr double speed = 20, curve = 300, area = 3.5e-5, coefficient = 4;  // a b [m^2], and c11 of usual contacts
    const double unit = node_friction_coefficient * node.vertical() / (shear_modulus * area * coefficient);
    std::vector<WheelsetSpeeds> motions;
    const auto add = [&](double size, int count, double turn, double yaw_rate) {
        for (int k = 0; k < count; ++k) {
            const double way = 2 * std::numbers::pi * (k + turn) / count;
            motions.push_back({.forward = speed,
                               .pitch_rate = speed * node.pitch_per_metre * (1 - size * unit * std::cos(way)),
                               .lateral = speed * (yaw + size * unit * std::sin(way)),
                               .yaw_rate = yaw_rate});
        }
    };
    double turn = 0;
    for (const double size : {0.25, 0.7, 2.0}) add(size, 6, std::exchange(turn, turn + 0.33), 0);
    if (!curves) return motions;
    add(0.7, 4, 0, speed / curve);
    add(0.7, 4, 0.5, -speed / curve);
    return motions;
}

/// Strips of all patches; none without a result.
inline std::vector<NodeFriction::Strip> strips_of(const std::vector<RailPatch>& patches,
                                                  const std::vector<PatchForce>& forces) {
    std::vector<NodeFriction::Strip> strips;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const PatchForce& own = forces[k];
        if (own.status != Status::ok) return {};  // as of a patch without an outline
        const double cosine = std::cos(patches[k].angle);
        double last = std::numeric_limits<double>::quiet_NaN();
        for (std::size_t i = own.first_element; i < own.first_element + std::size_t(own.elements); ++i) {
            const Yield::LoadedRectangle& of = own.surface[i];
            const double area = (of.x_2 - of.x_1) * (of.y_2 - of.y_1), s = (of.y_1 + of.y_2) / 2;
            if (s != std::exchange(last, s)) strips.push_back({patches[k].y + s * cosine, RollingForces::Zero()});
            strips.back().force -= area * RollingForces(of.traction_x, of.traction_y * cosine);  // of the rail
        }
    }
    return strips;
}

/// Friction under all reference motions that have a result.
inline std::vector<NodeFriction> friction_of(const WheelNode& node, const WheelOnRail::Dimensions& dimensions) {
    std::vector<NodeFriction> found;
    for (const int mirror : {1, -1}) {
        if (mirror < 0 && !(node.at.yaw > 0)) continue;
        WheelsetPosition at = node.at;
        if (mirror < 0) at = mirrored(at, Mirror::reversing_x());
        std::vector<RailPatch> patches;
        for (const PatchCreepMatrices& of : node.patches) {
            patches.push_back(mirror > 0 ? of.patch : mirrored(of.patch, Mirror::reversing_x()));
        }
        const auto motions = reference_motions(node, at.yaw, mirror > 0, dimensions.shear_modulus);
        const auto forces = patch_forces(patches, at, motions, dimensions, {.coefficient = node_friction_coefficient});
        for (std::size_t m = 0; m < motions.size(); ++m) {
            std::vector<NodeFriction::Strip> strips = strips_of(patches, forces[m]);
            if (!strips.empty()) found.push_back({double(mirror), at, motions[m], std::move(strips)});
        }
    }
    return found;
}

/// Rows of all zones; zones that carry nothing have a share of 0.
inline std::vector<ContactRow::Values> zone_rows(const WheelNode& node, const ContactTable::Zones& zones,
                                                 const WheelOnRail::Dimensions& dimensions,
                                                 const CreepForceTable& creep) {
    using enum ContactRow::Of;
    std::vector<ContactRow::Values> found;
    double carried = 0;
    for (Eigen::Index zone = 0; zone < zones.count(); ++zone) {
        ContactRow::Values& v = found.emplace_back(ContactRow::Values::Zero());
        const ZonePressures pressed = pressures_of(node.patches, zones, zone);
        if (!(pressed.load > 0)) continue;
        v = rows_of(node.patches, zones, zone, pressed, dimensions, creep, node.at.yaw);
        v[share] = pressed.vertical();
        carried += v[share];
        v[arm_x] = node.at.yaw > 0 ? pressed.place[0] / node.at.yaw : 0;
        v[arm_y] = pressed.place[1] - node.at.lateral;
        v[arm_z] = pressed.place[2] - node.at.height + dimensions.radius;
    }
    constexpr double negligible_load_share = 1e-5;  // below it a zone has no meaningful numbers
    for (ContactRow::Values& v : found) {
        v[share] /= carried;
        if (v[share] < negligible_load_share) v.setZero();
    }
    return found;
}

/// An ellipse of a zone under one motion.
struct ZoneMotion {
    std::array<double, 3> creepage;
    double mirror;
};

inline ZoneMotion zone_motion(const ContactRow::Values& v, const NodeFriction& motion) {
    using enum ContactRow::Of;
    const double inclined = v[angle] + v[plane],
                 rolling = (motion.speeds.forward - motion.speeds.pitch_rate * v[radius]) / 2;
    auto slip = velocity_of(motion.at, motion.speeds)
                    .slip(std::array<double, 3>{v[arm_x] * motion.at.yaw, v[arm_y], v[arm_z]}, std::sin(inclined),
                          std::cos(inclined));
    for (double& one : slip) one /= rolling;
    return {slip, motion.mirror};
}

/// Friction on the ellipse of a zone under a vertical load of the wheel; `yaw` is the node's.
inline RollingForces zone_force(const ContactRow::Values& v, double vertical, double yaw, const ZoneMotion& motion,
                                const WheelOnRail::Dimensions& dimensions, const CreepForceTable& creep) {
    using enum ContactRow::Of;
    const double N = v[share] * vertical / std::cos(v[angle]), root = std::cbrt(N), a = v[length] * root,
                 b = v[width] * root;
    const auto [xi, eta, phi] = ellipse_creepages<double>(
        motion.creepage, a, b, dimensions.shear_modulus, node_friction_coefficient * N, [&](Eigen::Index row) {
            const Eigen::Index entry = row - correction;
            return entry >= 0 && entry < 9 ? v[row] + motion.mirror * yaw * v[correction_by_yaw + entry] : v[row];
        });
    const TangentialForce force = creep.force<double>({a, b, dimensions.shear_modulus, dimensions.poisson_ratio},
                                                      node_friction_coefficient, N, {xi, eta, phi});
    return {force.longitudinal, force.lateral * std::cos(v[angle] + v[plane])};
}

/// Forces of friction on the ellipses of the zones.
inline RollingForces forces_of_zones(const std::vector<ContactRow::Values>& points, const WheelNode& node,
                                     double vertical, const NodeFriction& motion,
                                     const WheelOnRail::Dimensions& dimensions, const CreepForceTable& creep) {
    RollingForces sum = RollingForces::Zero();
    for (const ContactRow::Values& v : points) {
        if (v[ContactRow::share] > 0)
            sum += zone_force(v, vertical, node.at.yaw, zone_motion(v, motion), dimensions, creep);
    }
    return sum;
}

/// Fits the row `bend` of the zones of a node to friction on its patches: three steps of Gauss and Newton. Errors of a
/// zone count over its own mu N, the bend over what small shares must not exceed.
inline void fit_bends(std::vector<ContactRow::Values>& points, const ContactTable::Zones& zones, const WheelNode& node,
                      const std::vector<NodeFriction>& motions, const WheelOnRail::Dimensions& dimensions,
                      const CreepForceTable& creep) {
    using enum ContactRow::Of;
    constexpr double fitted_share = 1e-3, prior = 0.1, most_weight = 20, most = 0.5, step = 1e-3;
    constexpr Eigen::Index numbers = 9, rounds = 3, least_motions = 12;
    const double vertical = node.vertical();
    const auto count = Eigen::Index(motions.size());
    for (std::size_t zone = 0; zone < points.size(); ++zone) {
        ContactRow::Values& v = points[zone];
        if (!(v[share] > fitted_share) || count < least_motions) continue;
        const double N = v[share] * vertical / std::cos(v[angle]), bound = node_friction_coefficient * N,
                     weight = prior * (std::min)(most_weight, vertical / N);
        std::vector<ZoneMotion> at;
        std::vector<RollingForces> wanted;
        for (const NodeFriction& motion : motions) {
            at.push_back(zone_motion(v, motion));
            wanted.push_back(motion.in_zone(zones, Eigen::Index(zone)));
        }
        const auto errors = [&](const ContactRow::Values& of) {
            Eigen::VectorXd error(2 * count + numbers);
            for (Eigen::Index m = 0; m < count; ++m) {
                const RollingForces own = zone_force(of, vertical, node.at.yaw, at[std::size_t(m)], dimensions, creep);
                error.segment<2>(2 * m) = (own - wanted[std::size_t(m)]) / bound;
            }
            error.tail<numbers>() = weight * of.segment<numbers>(bend);
            return error;
        };
        for (int round = 0; round < rounds; ++round) {
            const Eigen::VectorXd error = errors(v);
            Eigen::MatrixXd by_bend(error.size(), numbers);
            for (Eigen::Index k = 0; k < numbers; ++k) {
                ContactRow::Values moved = v;
                moved[bend + k] += step;
                by_bend.col(k) = (errors(moved) - error) / step;
            }
            const Eigen::VectorXd change = (by_bend.transpose() * by_bend).ldlt().solve(by_bend.transpose() * error);
            const auto bent = v.segment<numbers>(bend) - change.array();
            v.segment<numbers>(bend) = bent.cwiseMax(-most).cwiseMin(most);
        }
    }
}

}  // namespace rollbem::detail
