// One wheel at a node of a contact table: its patches with their creep matrices, friction on them, and the rows of its
// zones.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

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

/// Friction of one wheel in track axes: F_x, F_y [N], and M_z over half_base [N] about the middle of the axle.
using RollingForces = Eigen::Array3d;

/// Three motions by which zones are assessed: straight on, in a curve, and with small creepages.
inline std::array<WheelsetSpeeds, 3> reference_motions(const WheelNode& node) {
    constexpr double speed = 20, curve = 300, slight = 2e-4;
    const double rolling = speed * node.pitch_per_metre, yaw = node.at.yaw;
    return {WheelsetSpeeds{.forward = speed, .pitch_rate = rolling},
            {.forward = speed, .pitch_rate = rolling, .yaw_rate = speed / curve},
            {.forward = speed, .pitch_rate = rolling * (1 + slight), .lateral = speed * (yaw + slight)}};
}

/// Forces of friction on the patches; not finite without a result.
inline RollingForces forces_of_patches(const WheelNode& node, const WheelsetSpeeds& speeds,
                                       const TrackDimensions& dimensions, double mu) {
    RollingForces sum = RollingForces::Zero();
    std::vector<RailPatch> patches;
    for (const PatchCreepMatrices& of : node.patches) patches.push_back(of.patch);
    const std::vector<PatchForce> forces = patch_forces(patches, node.at, speeds, dimensions, {.coefficient = mu});
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const PatchForce& own = forces[k];  // no force of its own for a patch without an outline
        if (own.status != Status::ok) return RollingForces::Constant(std::nan(""));
        const std::array<double, 3> place = creepage_place(patches[k]);
        const double across = own.force.lateral * std::cos(patches[k].angle);
        sum += RollingForces(own.force.longitudinal, across,
                             (place[0] * across - (place[1] - node.at.lateral) * own.force.longitudinal +
                              own.force.moment * std::cos(patches[k].angle)) /
                                 ContactTable::half_base);
    }
    return sum;
}

/// Rows of all zones; zones that carry nothing have a share of 0.
inline std::vector<ContactRow::Values> zone_rows(const WheelNode& node, const ContactTable::Zones& zones,
                                                 const TrackDimensions& dimensions, const CreepForceTable& creep) {
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

/// Forces of friction on the ellipses of the zones.
inline RollingForces forces_of_zones(const std::vector<ContactRow::Values>& points, const WheelNode& node,
                                     double vertical, const WheelsetSpeeds& speeds, const TrackDimensions& dimensions,
                                     const CreepForceTable& creep, double mu) {
    using enum ContactRow::Of;
    const WheelsetVelocity<double> velocity = velocity_of(node.at, speeds);
    RollingForces sum = RollingForces::Zero();
    for (const ContactRow::Values& v : points) {
        if (!(v[share] > 0)) continue;
        const double sine = std::sin(v[angle]), cosine = std::cos(v[angle]), N = v[share] * vertical / cosine,
                     root = std::cbrt(N), yaw = node.at.yaw;
        const std::array<double, 3> arm{v[arm_x] * yaw, v[arm_y], v[arm_z]};
        const std::array<double, 3> slip = velocity.slip(arm, sine, cosine);
        const double reference = (speeds.forward - speeds.pitch_rate * v[radius]) / 2;
        const double a = v[length] * root, b = v[width] * root;
        const auto [xi, eta, phi] =
            ellipse_creepages<double>({slip[0] / reference, slip[1] / reference, slip[2] / reference}, a, b,
                                      dimensions.shear_modulus, mu * N, [&](Eigen::Index row) {
                                          const Eigen::Index entry = row - correction;
                                          return entry >= 0 && entry < 9 ? v[row] + yaw * v[row + 9] : v[row];
                                      });
        const auto force = creep
                               .look_up(PatchContact({a, b, dimensions.shear_modulus, dimensions.poisson_ratio}), mu, N,
                                        {xi, eta, phi})
                               .force;
        const double across = force.lateral * cosine;
        sum += RollingForces(
            force.longitudinal, across,
            (arm[0] * across - arm[1] * force.longitudinal + force.moment * cosine) / ContactTable::half_base);
    }
    return sum;
}

}  // namespace rollbem::detail
