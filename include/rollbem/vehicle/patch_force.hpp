// Friction on one patch of a wheel that rolls on a rail, and what the patch does to its wheel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../assembly/patch_system.hpp"
#include "../detail/finite.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/rectangle_kernel.hpp"
#include "../friction/model.hpp"
#include "../scene/force.hpp"
#include "../scene/mirror.hpp"
#include "../scene/rigid_motion.hpp"
#include "../status.hpp"
#include "patch_elements.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Friction parameters for steady rolling.
struct RollingFriction {
    double coefficient = 0.3;   ///< mu [-]
    Eigen::Index elements = 0;  ///< of each strip along x; 0: by elements_for
    Eigen::Index strips = 0;    ///< of a patch; 0: by elements_for; fewer where the scheme would gain energy on these
    /// Whether slip is that of the curved surfaces (curved_slip_of), or that of three creepages, as in CONTACT's
    /// planes.
    bool curved_slip = false;
};

/// Friction on one patch of a right wheel, in the axes (x, s, n) of its plane.
struct PatchForce {
    Creepage<double> creepage{};      ///< wheel minus rail, see creepage_of
    TangentialForce<double> force{};  ///< on the wheel [N], and its moment about n [N m], at creepage_place
    double slip_work = std::numeric_limits<double>::quiet_NaN();  ///< heat per distance rolled [J/m]
    Eigen::ArrayXd edges{}, strip_work{};  ///< of the strips along s [m], and the part of each in slip_work [J/m]
    Eigen::Index elements = 0;
    StepStatus status = StepStatus::not_finite;
};

inline PatchForce mirrored(PatchForce friction, const Mirror& mirror) {
    friction.creepage = mirrored(friction.creepage, mirror);
    friction.force = mirrored(friction.force, mirror);
    if (mirror.of_vector()[1] < 0) {
        friction.edges = -friction.edges.reverse().eval();
        friction.strip_work = friction.strip_work.reverse().eval();
    }
    return friction;
}

/// A force [N] and its moment [N m] in track axes (x, y, z).
struct Wrench {
    std::array<double, 3> force{}, moment{};

    /// Of a force that acts at the end of an arm [m].
    static Wrench at(const std::array<double, 3>& arm, const std::array<double, 3>& force) {
        Wrench wrench{.force = force};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            wrench.moment[i] = arm[j] * force[k] - arm[k] * force[j];
        }
        return wrench;
    }
    Wrench& operator+=(const Wrench& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            force[i] += other.force[i];
            moment[i] += other.moment[i];
        }
        return *this;
    }
};

inline Wrench mirrored(Wrench wrench, const Mirror& mirror) {
    for (std::size_t i = 0; i < 3; ++i) {
        wrench.force[i] *= mirror.of_vector()[i];
        wrench.moment[i] *= mirror.of_turn()[i];
    }
    return wrench;
}

namespace detail {

/// A patch that rolls forward with known creepages.
struct RollingPatch {
    const RailPatch& patch;
    const WheelsetPosition& at;
    const WheelsetSpeeds& speeds;
    const TrackDimensions& dimensions;
    Creepage<double> creepage;
};

/// Steady rolling on one mesh of the patch's outline.
inline PatchForce friction_on(const PatchMesh<double>& mesh, const PatchContact<double>& contact,
                              const RollingPatch& rolling, const RollingFriction& friction) {
    const double unit = contact.half_length();
    const ElementSystem<double, 2> system =
        steady_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(contact.poisson_ratio()));
    ElementVectors<double> rows = ElementVectors<double>::Zero(system.elements().size(), 2);
    if (friction.curved_slip) {
        rows = curved_slip_of(rolling.patch, rolling.at, rolling.speeds, rolling.dimensions.radius,
                              unit * system.elements().x, unit * system.elements().y);
    }
    const FrictionModel model(contact, system,
                              {friction.coefficient, pressures_on(mesh.rectangles(unit), rolling.patch)});
    auto workspace = model.workspace();
    auto state = model.at_rest();
    const RigidMotion<Creepage<double>> motion(rolling.creepage);
    const FrictionStep<2> step = model.steady(model.at_rest(), motion.with_rows(rows), 1, state, workspace);
    PatchForce result{.creepage = rolling.creepage,
                      .force = step.force,
                      .slip_work = step.slip_work,
                      .elements = mesh.size(),
                      .status = step.status};
    if (step.status == StepStatus::assists_creepage) return result;
    result.edges = unit * mesh.edges();
    result.strip_work =
        workspace.slip_work().reshaped(mesh.elements_per_strip(), mesh.strip_count()).colwise().sum().transpose();
    return result;
}

}  // namespace detail

/// Steady rolling on the patch's own outline, under its own pressures, with the slip of both surfaces; backwards as the
/// mirror image of rolling forward. A patch that does not roll, V = 0, has the status invalid_step, no creepage and no
/// force. The patch must have numbers; position and speeds are those that the right wheel sees.
inline PatchForce patch_force(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                              const TrackDimensions& dimensions, const RollingFriction& friction) {
    const double rolling = rolling_velocity_of(patch, speeds);
    if (rolling < 0) {
        constexpr Mirror mirror = Mirror::along_track();
        return mirrored(
            patch_force(mirrored(patch, mirror), mirrored(at, mirror), mirrored(speeds, mirror), dimensions, friction),
            mirror);
    }
    const Creepage<double> creepage = creepage_of(patch, at, speeds, dimensions.radius);
    const bool rolls = rolling >= (std::numeric_limits<double>::min)() && detail::is_finite(creepage);
    if (detail::is_finite(speeds) && !rolls) {
        return {.force = {0, 0, 0}, .slip_work = 0, .status = StepStatus::invalid_step};
    }
    const PatchContact<double> contact = contact_of(patch, dimensions);
    PatchElements elements = elements_for(patch);
    if (friction.elements > 0) elements.along = friction.elements;
    if (friction.strips > 0) elements.strips = friction.strips;
    PatchForce result;
    with_fewer_strips(contact, elements, [&](const PatchMesh<double>& mesh) {
        result = detail::friction_on(mesh, contact, {patch, at, speeds, dimensions, creepage}, friction);
        return result.status != StepStatus::assists_creepage;
    });
    return result;
}

/// What the pressures of a patch do to its wheel, as on the right; the moment is about (0, y, z). They act along the
/// normals of the rail's surface in each row of cells: where a wheel rolls steadily, they do no work. Normals of the
/// plane itself would work on the slip across it.
inline Wrench pressure_wrench_of(const RailPatch& patch, double y, double z) {
    const CellGrid& grid = patch.grid;
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1));
    Wrench wrench;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const double sum = patch.pressure.col(j).sum(), load = sum * grid.dx * grid.dy;
        if (!(sum > 0)) continue;
        const auto place = patch.place((patch.pressure.col(j) * x).sum() / sum, grid.y(j), patch.rail_n[j]);
        wrench +=
            Wrench::at({place[0], place[1] - y, place[2] - z}, patch.in_track(0, load * patch.rail_slope[j], -load));
    }
    return wrench;
}

/// What pressures and friction of a patch do to its wheel, as on the right; the moment is about (0, y, z). Their power,
/// in steady rolling, is that of the creep forces on the creepages.
inline Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z) {
    const auto [force_x, force_s, moment] = friction.force;
    const std::array<double, 3> place = creepage_place(patch);
    Wrench wrench = Wrench::at({place[0], place[1] - y, place[2] - z}, patch.in_track(force_x, force_s, 0));
    wrench += {.force = {}, .moment = patch.in_track(0, 0, moment)};
    wrench += pressure_wrench_of(patch, y, z);
    return wrench;
}

}  // namespace rollbem
