// Forces of a wheelset that rolls on real rails: friction on each patch, the pitch rate of free rolling, and the
// balance of the vertical loads, which normal forces and friction carry together.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../assembly/patch_system.hpp"
#include "../detail/finite.hpp"
#include "../detail/rising_root.hpp"
#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../friction/model.hpp"
#include "../normal/hertz_ellipse.hpp"
#include "../scene/force.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// How patches rub in steady rolling.
struct RollingFriction {
    double coefficient = 0.3;    ///< mu [-]
    Eigen::Index elements = 12;  ///< of each strip along x
    Eigen::Index strips = 13;    ///< of a patch; fewer where the scheme would gain energy on these, as on some flanges
    /// Whether slip is that of the curved surfaces (curved_slip_of), or that of three creepages, as in CONTACT's
    /// planes.
    bool curved_slip = false;
};

/// Friction on one patch of a right wheel, in the axes (x, s, n) of its plane.
struct PatchForce {
    Creepage<double> creepage{};      ///< wheel minus rail, see creepage_of
    TangentialForce<double> force{};  ///< on the wheel [N]; its moment about the normal at the reference point [N m]
    double slip_work = std::numeric_limits<double>::quiet_NaN();  ///< heat per distance rolled [J/m]
    Eigen::ArrayXd edges{}, strip_work{};  ///< of the strips along s [m], and the part of each in slip_work [J/m]
    Eigen::Index elements = 0;
    StepStatus status = StepStatus::not_finite;
};

/// A force [N] and its moment [N m] in track axes (x, y, z).
struct Wrench {
    std::array<double, 3> force{}, moment{};

    Wrench& operator+=(const Wrench& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            force[i] += other.force[i];
            moment[i] += other.moment[i];
        }
        return *this;
    }
};

namespace detail {

// Mirror images in the plane x = 0, across the track.
inline WheelsetPosition mirrored_along(WheelsetPosition position) {
    position.yaw = -position.yaw;
    return position;
}
inline WheelsetSpeeds mirrored_along(const WheelsetSpeeds& speeds) {
    return {-speeds.forward, -speeds.pitch_rate, speeds.lateral, speeds.vertical, speeds.roll_rate, -speeds.yaw_rate};
}
inline RailPatch mirrored_along(RailPatch patch) {
    patch.x = -patch.x;
    patch.grid.x_0 = -patch.grid.x(patch.grid.nx - 1);
    patch.pressure = patch.pressure.colwise().reverse().eval();
    if (patch.outline) {
        const Eigen::ArrayXd y = patch.outline->y();
        Eigen::ArrayXd trailing = y, leading = y;
        for (Eigen::Index i = 0; i < y.size(); ++i) {
            trailing[i] = -patch.outline->leading(y[i]);
            leading[i] = -patch.outline->trailing(y[i]);
        }
        patch.outline.emplace(y, trailing, leading);
    }
    return patch;
}

}  // namespace detail

/// Steady rolling on the patch's own outline, under its own pressures, with the slip of both surfaces; backwards as the
/// mirror image of rolling forward. A patch that does not roll, V = 0, has the status invalid_step, no creepage and no
/// force. The patch must have numbers; position and speeds are those that the right wheel sees.
inline PatchForce patch_force(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                              const TrackDimensions& dimensions, const RollingFriction& friction) {
    const double rolling = rolling_velocity_of(patch, speeds);
    if (rolling < 0) {
        PatchForce image = patch_force(detail::mirrored_along(patch), detail::mirrored_along(at),
                                       detail::mirrored_along(speeds), dimensions, friction);
        for (double* of :
             {&image.creepage.longitudinal, &image.creepage.spin, &image.force.longitudinal, &image.force.moment}) {
            *of = -*of;
        }
        return image;
    }
    const Creepage<double> creepage = creepage_of(patch, at, speeds, dimensions.radius);
    const bool rolls = rolling >= (std::numeric_limits<double>::min)() && detail::is_finite(creepage);
    if (detail::is_finite(speeds) && !rolls) {
        return {.force = {0, 0, 0}, .slip_work = 0, .status = StepStatus::invalid_step};
    }
    const PatchContact<double> contact = contact_of(patch, dimensions);
    const PressureGrid<double> pressures = pressure_of(patch);
    PatchForce result{.creepage = creepage};
    for (Eigen::Index strips = friction.strips; strips >= 5 || strips == friction.strips; strips -= 2) {
        const PatchMesh<double> mesh = patch_mesh(contact, cosine_mesh(friction.elements), uniform_mesh(strips));
        const std::vector<Rectangle<double>> elements = mesh.rectangles(contact.half_length());
        Eigen::ArrayXd pressure = pressures(elements);
        double load = 0;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto& [x_1, x_2, y_1, y_2] = elements[i];
            load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
        }
        pressure *= patch.load / load;
        const ElementSystem<double, 2> system =
            steady_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(contact.poisson_ratio()));
        const double unit = contact.half_length();
        ElementVectors<double> rows = ElementVectors<double>::Zero(system.elements().size(), 2);
        if (friction.curved_slip) {
            rows = curved_slip_of(patch, at, speeds, dimensions.radius, unit * system.elements().x,
                                  unit * system.elements().y);
        }
        const FrictionModel model(contact, system, {friction.coefficient, pressure});
        auto workspace = model.workspace();
        auto state = model.at_rest();
        const FrictionStep<2> step =
            model.steady(model.at_rest(), RigidMotion<Creepage<double>>(creepage).with_rows(rows), 1, state, workspace);
        result.force = step.force;
        result.slip_work = step.slip_work;
        result.elements = mesh.size();
        result.status = step.status;
        if (step.status == StepStatus::assists_creepage) continue;
        result.edges = contact.half_length() * mesh.edges();
        result.strip_work = workspace.slip_work().reshaped(friction.elements, strips).colwise().sum().transpose();
        break;
    }
    return result;
}

/// What pressures and friction of a patch do to its wheel, as on the right; the moment is about (0, y, z).
inline Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z) {
    const CellGrid& grid = patch.grid;
    double along = 0, across = 0;  // moments of the pressures
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            along += patch.pressure(i, j) * grid.x(i) * grid.dx * grid.dy;
            across += patch.pressure(i, j) * grid.y(j) * grid.dx * grid.dy;
        }
    }
    const double sine = std::sin(patch.angle), cosine = std::cos(patch.angle);
    const auto track = [&](double x, double s, double n) {
        return std::array{x, s * cosine - n * sine, s * sine + n * cosine};
    };
    Wrench wrench{.force = track(friction.force.longitudinal, friction.force.lateral, -patch.load),
                  .moment = track(-across, along, friction.force.moment)};
    const std::array<double, 3> r{patch.x, patch.y - y, patch.z - z}, f = wrench.force;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        wrench.moment[i] += r[j] * f[k] - r[k] * f[j];
    }
    return wrench;
}

/// What is known of a wheelset's motion and loads.
struct WheelsetRolling {
    WheelsetPosition position;
    std::array<double, 2> loads{1e5, 1e5};  ///< vertical, left and right [N]
    WheelsetOnTrack::Free free = WheelsetOnTrack::Free::height_and_roll;
    WheelsetSpeeds speeds{};
    /// Whether the pitch rate is that at which the longitudinal creepages of both wheels' largest patches add up to
    /// zero, or that of the only wheel that touches is zero; otherwise that of the speeds.
    bool free_pitch = true;
};

struct WheelsetForces {
    WheelsetOnTrack::Contacts contacts;
    double pitch_rate = std::numeric_limits<double>::quiet_NaN();  ///< [rad/s]; NaN if no wheel touches
    std::array<std::vector<PatchForce>, 2> patches;                ///< those of the contacts
    /// Of the rails on each wheel and on both, in track axes; moments are about the middle of the axle. Zero where
    /// there is no contact; NaN if friction has no result.
    std::array<Wrench, 2> on_wheel;
    Wrench on_wheelset;
    int rounds = 0;  ///< of contacts and friction in turn
};

namespace detail {

/// At which the longitudinal creepages of the largest patches of all wheels that touch add up to zero [rad/s]: slip is
/// linear in the rate, and the velocity of rolling by which it is divided changes little from one round to the next.
inline double free_pitch_rate(const WheelsetOnTrack& wheelset, const WheelsetOnTrack::Contacts& contacts,
                              WheelsetSpeeds speeds) {
    speeds.pitch_rate = 0;
    for (int round = 0; round < 20; ++round) {
        double sum = 0, growth = 0;  // of creepages, and its derivative at constant velocities of rolling
        for (const WheelsetOnTrack::Side side : WheelsetOnTrack::sides) {
            const WheelOnRail::Contact& wheel = contacts.wheels[std::size_t(side)];
            if (!has_numbers(wheel.status)) continue;
            const RailPatch& patch = wheel.patches[0];
            const WheelsetPosition at = contacts.seen(side);
            const double radius = wheelset.wheel(side).dimensions().radius;
            const auto slip = [&](const WheelsetSpeeds& of) {
                const WheelsetSpeeds seen = WheelsetOnTrack::seen_from(side, of);
                return SlipVelocity(patch, at, seen, radius).at_reference().longitudinal;
            };
            const double rolling = round > 0 ? std::abs(rolling_velocity_of(patch, speeds)) : 1;
            sum += slip(speeds) / rolling;
            growth += slip({.forward = 0, .pitch_rate = 1}) / rolling;
        }
        const double next = speeds.pitch_rate - sum / growth;
        if (!is_finite(next) || next == speeds.pitch_rate) break;
        speeds.pitch_rate = next;
    }
    return speeds.pitch_rate;
}

/// The vertical load of a wheel's normal forces with which it carries, with friction, the load wanted. Logarithms of
/// loads over the one wanted.
class CarriedLoad {
public:
    double at = 0;

    /// Whether normal forces and friction carry the one wanted to 1e-6, or the wheel does not touch; else another
    /// load. Contacts jump a little where grids change: there all forces are scaled.
    bool settled(WheelOnRail::Contact& wheel, std::vector<PatchForce>& forces, double wanted) {
        double carried = 0;
        for (std::size_t i = 0; i < forces.size(); ++i) {
            const double angle = wheel.patches[i].angle;
            carried += wheel.patches[i].load * std::cos(angle) - forces[i].force.lateral * std::sin(angle);
        }
        const double excess = std::log((std::max)(carried / wanted, 1e-2));
        if (!is_finite(carried) || std::abs(excess) < 1e-6) return true;
        before_ = std::exchange(at, root_.next(at, excess));
        constexpr double jump = 1e-2;
        if (root_.width() > 1e-6) return false;
        if (std::abs(excess) > jump) {
            root_ = RisingRoot(1, largest);  // the bounds were those of another state of the other wheel
            return false;
        }
        for (std::size_t i = 0; i < forces.size(); ++i) {
            for (double* of : {&wheel.patches[i].load, &wheel.patches[i].peak_pressure, &forces[i].force.longitudinal,
                               &forces[i].force.lateral, &forces[i].force.moment, &forces[i].slip_work}) {
                *of *= wanted / carried;
            }
            wheel.patches[i].pressure *= wanted / carried;
            forces[i].strip_work *= wanted / carried;
        }
        return true;
    }
    /// A load nearer to the last one.
    void retreat() { at = (at + before_) / 2; }

private:
    static constexpr double largest = 1.4;  // of a step
    double before_ = 0;
    RisingRoot root_{1, largest};
};

}  // namespace detail

/// The forces of a rolling wheelset. Loads are vertical, carried by normal forces and friction together: contacts and
/// friction are found in turn until they carry the loads to 1e-6; if they do not in 40 rounds, the wheel's status is
/// `unbalanced`, and `load_not_reached` where friction holds the wheel up. A wheel that does not roll (patch_force) has
/// the forces of its pressures alone and is `unbalanced`, too. Statuses say what failed; allocates.
template <std::same_as<double> Scalar = double>  // for rollbem::compiled
WheelsetForces rolling_forces(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling,
                              const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                              const WheelOnRail::Options& options = {}) {
    using Free = WheelsetOnTrack::Free;
    WheelsetForces result;
    WheelsetPosition position = rolling.position;
    WheelsetSpeeds speeds = rolling.speeds;
    if (!detail::is_finite(speeds)) return result;
    std::array<detail::CarriedLoad, 2> carried;
    constexpr int most = 40;
    int failures = 0;
    constexpr double out_of_reach = 5;  // a load of 150 times the one wanted
    for (bool settled = false; !settled;) {
        const bool last = ++result.rounds >= most;
        const std::array loads{rolling.loads[0] * std::exp(carried[0].at), rolling.loads[1] * std::exp(carried[1].at)};
        result.contacts = wheelset.solve(position, loads, workspace, rolling.free, options);
        // the roll changes little from one round to the next
        if (has_numbers(result.contacts.status)) position.roll = result.contacts.position.roll;
        bool lost = false;  // a wheel that the loads before had numbers for
        for (std::size_t k = 0; k < 2 && failures < 4; ++k) {
            if (has_numbers(result.contacts.wheels[k].status) || result.patches[k].empty()) continue;
            carried[k].retreat();
            lost = true;
        }
        if (lost) {
            ++failures;
            continue;
        }
        if (rolling.free_pitch) speeds.pitch_rate = detail::free_pitch_rate(wheelset, result.contacts, speeds);
        settled = true;
        for (const WheelsetOnTrack::Side side : WheelsetOnTrack::sides) {
            const auto k = static_cast<std::size_t>(side);
            WheelOnRail::Contact& wheel = result.contacts.wheels[k];
            result.patches[k].clear();
            if (!has_numbers(wheel.status)) continue;
            result.pitch_rate = speeds.pitch_rate;
            for (const RailPatch& patch : wheel.patches) {
                result.patches[k].push_back(patch_force(patch, result.contacts.seen(side),
                                                        WheelsetOnTrack::seen_from(side, speeds),
                                                        wheelset.wheel(side).dimensions(), friction));
            }
            if (rolling.free == Free::nothing || carried[k].settled(wheel, result.patches[k], rolling.loads[k])) {
                continue;
            }
            const bool lifted = carried[k].at > out_of_reach;
            settled = settled && (last || lifted);
            if (lifted) wheel.status = Status::load_not_reached;
            if (lifted && rolling.free == Free::height_and_roll) {
                for (WheelOnRail::Contact& both : result.contacts.wheels) both.status = wheel.status;
            }
            if (last) wheel.status = (std::max)(wheel.status, Status::unbalanced);
        }
    }
    for (std::size_t k = 0; k < 2; ++k) {
        Status& status = result.contacts.wheels[k].status;
        for (const PatchForce& patch : result.patches[k]) {
            if (patch.status == StepStatus::invalid_step) status = (std::max)(status, Status::unbalanced);
        }
    }
    auto& [left, right] = result.contacts.wheels;
    result.contacts.status = (std::max)(left.status, right.status);
    for (const WheelsetOnTrack::Side side : WheelsetOnTrack::sides) {
        const auto k = static_cast<std::size_t>(side);
        if (!has_numbers(result.contacts.wheels[k].status)) result.patches[k].clear();
        const WheelsetPosition at = result.contacts.seen(side);
        for (std::size_t i = 0; i < result.patches[k].size(); ++i) {
            result.on_wheel[k] += wrench_of(result.contacts.wheels[k].patches[i], result.patches[k][i], at.lateral,
                                            at.height - wheelset.wheel(side).dimensions().radius);
        }
        if (side == WheelsetOnTrack::Side::left) {
            for (double* of :
                 {&result.on_wheel[k].force[1], &result.on_wheel[k].moment[0], &result.on_wheel[k].moment[2]}) {
                *of = -*of;
            }
        }
        result.on_wheelset += result.on_wheel[k];
    }
    return result;
}

}  // namespace rollbem
