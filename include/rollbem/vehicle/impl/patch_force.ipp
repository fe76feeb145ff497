// Bodies of vehicle/patch_force.hpp. Internal.
#pragma once

#include "../patch_force.hpp"

#include <algorithm>
#include <cmath>

#include "../../assembly/patch_system.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/rectangle_kernel.hpp"
#include "../../friction/model.hpp"
#include "../../normal/detail/finite_position.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../detail/slip_velocity.hpp"
#include "../patch_elements.hpp"

namespace rollbem {

ROLLBEM_DECL PatchForce mirrored(PatchForce friction, const Mirror& mirror) {
    friction.creepage = mirrored(friction.creepage, mirror);
    friction.force = mirrored(friction.force, mirror);
    const auto [x, y, z] = mirror.of_vector();
    if (y < 0) {
        friction.edges = -friction.edges.reverse().eval();
        friction.strip_work = friction.strip_work.reverse().eval();
    }
    for (LoadedRectangle& element : friction.surface) {
        if (x < 0)
            element = {-element.x_2,        -element.x_1,       element.y_1,     element.y_2,
                       -element.traction_x, element.traction_y, element.pressure};
        if (y < 0)
            element = {element.x_1,        element.x_2,         -element.y_2,    -element.y_1,
                       element.traction_x, -element.traction_y, element.pressure};
    }
    return friction;
}

ROLLBEM_DECL Wrench Wrench::at(const std::array<double, 3>& arm, const std::array<double, 3>& force) {
    Wrench wrench{.force = force};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        wrench.moment[i] = arm[j] * force[k] - arm[k] * force[j];
    }
    return wrench;
}

ROLLBEM_DECL auto Wrench::operator+=(const Wrench& other) -> Wrench& {
    for (std::size_t i = 0; i < 3; ++i) {
        force[i] += other.force[i];
        moment[i] += other.moment[i];
    }
    return *this;
}

ROLLBEM_DECL Wrench mirrored(Wrench wrench, const Mirror& mirror) {
    for (std::size_t i = 0; i < 3; ++i) {
        wrench.force[i] *= mirror.of_vector()[i];
        wrench.moment[i] *= mirror.of_turn()[i];
    }
    return wrench;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Patches of one plane that roll forward.
struct RollingPatches {
    std::vector<const RailPatch*> patches;
    const WheelsetPosition& at;
    const WheelsetSpeeds& speeds;
    const TrackDimensions& dimensions;

    Creepage creepage(std::size_t k) const { return creepage_of(*patches[k], at, speeds, dimensions.radius); }
};

/// Rigid slip of the elements of all patches in addition to the slip by the first patch's creepages: creepages of other
/// patches differ a little, as the patches lie at other depths.
inline ElementVectors slip_besides(const PatchMeshes& meshes, const Elements<double>& elements,
                                   const RollingPatches& rolling, const RollingFriction& friction) {
    ElementVectors rows = ElementVectors::Zero(elements.size(), 2);
    const Creepage first = rolling.creepage(0);
    for (std::size_t k = 0; k < meshes.patches.size(); ++k) {
        const Eigen::ArrayXd x = meshes.unit * elements.x.segment(meshes.first(k), meshes.size(k)),
                             s = meshes.unit * elements.y.segment(meshes.first(k), meshes.size(k));
        auto own = rows.middleRows(meshes.first(k), meshes.size(k));
        if (friction.curved_slip) {
            own = curved_slip_of(*rolling.patches[k], rolling.at, rolling.speeds, rolling.dimensions.radius, x, s);
        }
        const Creepage here = rolling.creepage(k);
        const double spin = here.spin - first.spin;
        own.col(0).array() += here.longitudinal - first.longitudinal - spin * s;
        own.col(1).array() += here.lateral - first.lateral + spin * x;
    }
    return rows;
}

/// Force and moment of the tractions [Pa] on a patch's elements.
inline TangentialForce force_of(const std::vector<Rectangle<double>>& elements, const ElementVectors& tractions) {
    TangentialForce force{0, 0, 0};
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        const double area = (x_2 - x_1) * (y_2 - y_1), f_x = area * tractions(Eigen::Index(i), 0),
                     f_y = area * tractions(Eigen::Index(i), 1);
        force.longitudinal += f_x;
        force.lateral += f_y;
        force.moment += (x_1 + x_2) / 2 * f_y - (y_1 + y_2) / 2 * f_x;
    }
    return force;
}

/// mu of each element, cold.
inline Eigen::ArrayXd coefficients_on(const PatchMeshes& meshes, const RollingPatches& rolling,
                                      const RollingFriction& friction) {
    std::vector<double> found;
    for (std::size_t k = 0; k < meshes.patches.size(); ++k) {
        const PatchMesh<double>& mesh = meshes.patches[k];
        const RailPatch& patch = *rolling.patches[k];
        for (Eigen::Index j = 0; j < mesh.strip_count(); ++j) {
            const double s = meshes.unit * mesh.middles_y()[j];
            const double mu =
                friction.rail ? friction.rail->at(patch.surface_angle(s), patch.surface_y(s)) : friction.coefficient;
            found.insert(found.end(), std::size_t(mesh.elements_per_strip()), mu);
        }
    }
    return Eigen::Map<const Eigen::ArrayXd>(found.data(), Eigen::Index(found.size()));
}

/// Temperatures above ambient [K] in the middles of a patch's elements, and the largest temperature at their trailing
/// edges, from the heat of each element per distance rolled [J/m].
struct PatchTemperatures {
    Eigen::ArrayXd middles;
    double peak = 0;
};

inline PatchTemperatures temperatures_of(const std::vector<Rectangle<double>>& elements, Eigen::Index along,
                                         const Eigen::ArrayXd& work, double speed, const Heating& heating) {
    PatchTemperatures found{Eigen::ArrayXd(work.size()), 0};
    for (Eigen::Index first = 0; first < work.size(); first += along) {
        Eigen::ArrayXd edges(along + 1), heat(along);
        for (Eigen::Index i = 0; i < along; ++i) {
            const auto& [x_1, x_2, y_1, y_2] = elements[std::size_t(first + i)];
            edges[i] = x_1;
            edges[i + 1] = x_2;
            heat[i] = speed * work[first + i] / ((x_2 - x_1) * (y_2 - y_1));
        }
        const Eigen::ArrayXd middles = (edges.head(along) + edges.tail(along)) / 2;
        found.middles.segment(first, along) = flash_temperature(edges, heat, middles, speed, heating);
        found.peak =
            (std::max)(found.peak, flash_temperature(edges, heat, edges.head(along), speed, heating).maxCoeff());
    }
    return found;
}

/// Steady rolling on one mesh of all outlines, with tractions [Pa] and heat [J/m] of its elements.
struct MeshFriction {
    Status status = Status::not_finite;
    TangentialForce force;
    ElementVectors tractions;
    Eigen::ArrayXd work, slip;
    std::vector<double> peaks{};  ///< largest temperature of each patch [K]; empty: not known
};

/// Solves friction on a mesh for given coefficients of its elements.
class MeshSolver {
public:
    MeshSolver(const PatchMeshes& meshes, const PatchContact& contact, const RollingPatches& rolling,
               const RollingFriction& friction)
        : meshes_(meshes),
          contact_(contact),
          rolling_(rolling),
          friction_(friction),
          system_(steady_system(
              meshes.joined(), NodeDifference{Nodes::chebyshev},
              HalfSpace<double>(contact.poisson_ratio(), friction.layer * contact.shear_modulus() / meshes.unit))),
          pressures_(system_.size()) {
        for (std::size_t k = 0; k < meshes.patches.size(); ++k) {
            pressures_.segment(meshes.first(k), meshes.size(k)) =
                pressures_on(meshes.patches[k].rectangles(meshes.unit), *rolling.patches[k]);
        }
    }

    /// Alternates friction and temperature, which depend on each other, in relaxed steps.
    MeshFriction solve() const {
        const Eigen::ArrayXd cold = coefficients_on(meshes_, rolling_, friction_);
        MeshFriction found = with(cold);
        if (!friction_.heating || found.status != Status::ok) return found;
        const std::optional<HotFriction>& hot = friction_.heating->friction;
        constexpr double settled = 1e-7;
        Eigen::ArrayXd mu = cold;
        for (int round = 0; round < 100; ++round) {
            const std::optional<Eigen::ArrayXd> temperature = heat(found);
            if (!hot) return found;
            if (!temperature) break;
            const Eigen::ArrayXd next =
                cold.binaryExpr(*temperature, [&](double own, double kelvin) { return hot->at(own, kelvin); });
            if ((next - mu).abs().maxCoeff() <= settled) return found;
            mu += (next - mu) / 2;
            found = with(mu);
            if (found.status != Status::ok) return found;
        }
        found.status = Status::not_converged;
        constexpr double nan = std::numeric_limits<double>::quiet_NaN();
        found.force = {nan, nan, nan};  // no result
        return found;
    }

    /// Loads of the rail's surface under tractions of the wheel.
    std::vector<LoadedRectangle> surface(const ElementVectors& tractions) const {
        std::vector<LoadedRectangle> found;
        for (const PatchMesh<double>& mesh : meshes_.patches) {
            for (const auto& [x_1, x_2, y_1, y_2] : mesh.rectangles(meshes_.unit)) {
                const auto i = Eigen::Index(found.size());
                found.push_back({x_1, x_2, y_1, y_2, -tractions(i, 0), -tractions(i, 1), pressures_[i]});
            }
        }
        return found;
    }

private:
    MeshFriction with(const Eigen::ArrayXd& mu) const {
        const double most = mu.maxCoeff();
        Eigen::ArrayXd bounds = pressures_;  // over `most`
        if (most > 0) bounds *= mu / most;
        const FrictionModel model(contact_, system_, {most, std::move(bounds)});
        auto workspace = model.workspace();
        auto state = model.at_rest();
        const ElementVectors rows = slip_besides(meshes_, system_.elements(), rolling_, friction_);
        const RigidMotion<Creepage> motion(rolling_.creepage(0));
        const FrictionStep step =
            model.steady(model.at_rest(), {Travel::at_speed(1), motion.with_rows(rows)}, state, workspace);
        return {step.status, step.force, state.traction, workspace.slip_work(), workspace.slip().rowwise().norm()};
    }

    /// The temperatures of all elements, and peaks; none where the contact passes slowly.
    std::optional<Eigen::ArrayXd> heat(MeshFriction& of) const {
        const Heating& heating = *friction_.heating;
        Eigen::ArrayXd found(of.work.size());
        std::vector<double> peaks;
        for (std::size_t k = 0; k < meshes_.patches.size(); ++k) {
            const RailPatch& patch = *rolling_.patches[k];
            const double speed = rolling_velocity_of(patch, rolling_.speeds);
            const Creepage creepage = rolling_.creepage(k);
            const bool both_pass = std::hypot(creepage.longitudinal, creepage.lateral) <= 0.2;
            if (!both_pass || !heating.passes_fast(speed, patch.half_length)) return std::nullopt;
            const Eigen::Index first = meshes_.first(k), count = meshes_.size(k);
            const PatchTemperatures own =
                temperatures_of(meshes_.patches[k].rectangles(meshes_.unit), meshes_.patches[k].elements_per_strip(),
                                of.work.segment(first, count), speed, heating);
            found.segment(first, count) = own.middles;
            peaks.push_back(own.peak);
        }
        of.peaks = std::move(peaks);
        return found;
    }

    const PatchMeshes& meshes_;
    const PatchContact& contact_;
    const RollingPatches& rolling_;
    const RollingFriction& friction_;
    ElementSystem<double, 2> system_;
    Eigen::ArrayXd pressures_;
};

inline std::vector<PatchForce> friction_on(const PatchMeshes& meshes, const PatchContact& contact,
                                           const RollingPatches& rolling, const RollingFriction& friction) {
    const MeshSolver solver(meshes, contact, rolling, friction);
    const MeshFriction solved = solver.solve();
    std::vector<PatchForce> found;
    for (std::size_t k = 0; k < meshes.patches.size(); ++k) {
        const PatchMesh<double>& mesh = meshes.patches[k];
        PatchForce& patch = found.emplace_back();
        patch.creepage = rolling.creepage(k);
        patch.elements = mesh.size();
        patch.status = solved.status;
        patch.force = solved.force;  // not finite without a result
        if (solved.status == Status::assists_creepage || !is_finite(solved.force)) continue;
        patch.force = force_of(mesh.rectangles(meshes.unit), solved.tractions.middleRows(meshes.first(k), mesh.size()));
        patch.edges.resize(mesh.strip_count() + 1);
        patch.edges << meshes.unit * mesh.lower(), meshes.unit * mesh.upper().tail(1);
        patch.first_element = std::size_t(meshes.first(k));
        patch.slip = solved.slip.segment(meshes.first(k), mesh.size());
        patch.work = solved.work.segment(meshes.first(k), mesh.size());
        patch.strip_work =
            patch.work.reshaped(mesh.elements_per_strip(), mesh.strip_count()).colwise().sum().transpose();
        patch.slip_work = patch.strip_work.sum();
        patch.surface = solver.surface(solved.tractions);
        if (!solved.peaks.empty()) patch.peak_temperature = solved.peaks[k];
    }
    return found;
}

/// Friction on the patches of one plane, which may also roll backwards or stand still.
inline std::vector<PatchForce> plane_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                            const WheelsetSpeeds& speeds, const TrackDimensions& dimensions,
                                            const RollingFriction& friction) {
    const double rolls = rolling_velocity_of(patches[0], speeds);
    if (rolls < 0) {
        constexpr Mirror mirror = Mirror::reversing_x();
        std::vector<RailPatch> images;
        for (const RailPatch& patch : patches) images.push_back(mirrored(patch, mirror));
        std::vector<PatchForce> found =
            plane_forces(images, mirrored(at, mirror), mirrored(speeds, mirror), dimensions, friction);
        for (PatchForce& patch : found) patch = mirrored(std::move(patch), mirror);
        return found;
    }
    RollingPatches rolling{{}, at, speeds, dimensions};
    std::vector<PatchElements> elements;
    for (const RailPatch& patch : patches) {
        rolling.patches.push_back(&patch);
        PatchElements& own = elements.emplace_back(elements_for(patch));
        if (friction.elements > 0) own.along = friction.elements;
        if (friction.strips > 0) own.strips = friction.strips;
    }
    const bool known = rolls >= (std::numeric_limits<double>::min)() && is_finite(rolling.creepage(0));
    if (is_finite(speeds) && !known) {
        return std::vector<PatchForce>(patches.size(),
                                       {.force = {0, 0, 0}, .slip_work = 0, .status = Status::invalid_step});
    }
    const PatchContact contact = contact_of(patches[0], dimensions);
    std::vector<PatchForce> found;
    with_fewer_strips(elements, [&](const std::vector<PatchElements>& fewer) {
        found = friction_on(friction_meshes(rolling.patches, fewer, contact.half_length()), contact, rolling, friction);
        return found[0].status != Status::assists_creepage;
    });
    return found;
}

/// Throws std::invalid_argument naming a parameter that cannot be meant.
inline void require_valid(const RollingFriction& friction) {
    constexpr const char* name = "RollingFriction";
    require(is_finite(friction.coefficient) && friction.coefficient >= 0, name, "coefficient", friction.coefficient,
            "be finite and not negative");
    require(is_finite(friction.layer) && friction.layer >= 0, name, "layer", friction.layer,
            "be finite and not negative");
    if (!friction.heating) return;
    require_positive(name, "conductivity", friction.heating->conductivity);
    require_positive(name, "heat_capacity", friction.heating->heat_capacity);
    if (!friction.heating->friction) return;
    const auto& [coefficient, begin, end] = *friction.heating->friction;
    require(is_finite(coefficient) && coefficient >= 0, name, "hot coefficient", coefficient,
            "be finite and not negative");
    require(is_finite(begin) && begin >= 0, name, "begin of hot friction", begin, "be finite and not negative");
    require(is_finite(end) && end > begin, name, "end of hot friction", end, "lie above its begin");
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL std::vector<PatchForce> patch_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                                  const WheelsetSpeeds& speeds, const TrackDimensions& dimensions,
                                                  const RollingFriction& friction) {
    detail::require_valid(friction);
    std::vector<PatchForce> found(patches.size());
    for (const std::vector<std::size_t>& plane : patches_by_plane(patches)) {
        std::vector<RailPatch> coplanar;
        for (const std::size_t k : plane) coplanar.push_back(patches[k]);
        std::vector<PatchForce> own = detail::plane_forces(coplanar, at, speeds, dimensions, friction);
        for (std::size_t i = 0; i < plane.size(); ++i) found[plane[i]] = std::move(own[i]);
    }
    return found;
}

ROLLBEM_DECL Wrench pressure_wrench_of(const RailPatch& patch, double y, double z) {
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

ROLLBEM_DECL Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z) {
    const auto [force_x, force_s, moment] = friction.force;
    const std::array<double, 3> place = creepage_place(patch);
    Wrench wrench = Wrench::at({place[0], place[1] - y, place[2] - z}, patch.in_track(force_x, force_s, 0));
    wrench += {.force = {}, .moment = patch.in_track(0, 0, moment)};
    wrench += pressure_wrench_of(patch, y, z);
    return wrench;
}

}  // namespace rollbem
