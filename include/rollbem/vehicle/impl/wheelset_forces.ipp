// Bodies of vehicle/wheelset_forces.hpp. Internal.
#pragma once

#include "../wheelset_forces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "../../assembly/patch_system.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/linear_between.hpp"
#include "../../detail/require.hpp"
#include "../../detail/rising_root.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../friction/model.hpp"
#include "../../normal/detail/finite_position.hpp"
#include "../../normal/detail/mirrored_patch.hpp"
#include "../../scene/detail/mirror.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../detail/free_pitch_rate.hpp"
#include "../detail/mirrored_forces.hpp"
#include "../detail/patch_elements.hpp"
#include "../detail/slip_velocity.hpp"

namespace rollbem {

ROLLBEM_DECL Eigen::ArrayXd flash_temperature(const Eigen::ArrayXd& edges, const Eigen::ArrayXd& heat,
                                              const Eigen::ArrayXd& at, double speed,
                                              const RollingFriction::Heating& heating) {
    const double factor = std::sqrt(heating.diffusivity() / (std::numbers::pi * speed)) / heating.conductivity;
    const auto root = [](double x) { return std::sqrt((std::max)(x, 0.0)); };
    Eigen::ArrayXd found = Eigen::ArrayXd::Zero(at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
        for (Eigen::Index i = 0; i < heat.size(); ++i) {
            found[k] += heat[i] * (root(edges[i + 1] - at[k]) - root(edges[i] - at[k]));  // 2 of the root, q/2
        }
    }
    return factor * found;
}

ROLLBEM_DECL RollingFriction::OnRail::OnRail(Over over, std::vector<double> nodes, std::vector<double> coefficients)
    : over_(over), nodes_(std::move(nodes)), coefficients_(std::move(coefficients)) {
    constexpr const char* name = "RollingFriction::OnRail";
    detail::require(!nodes_.empty(), name, "number of nodes", nodes_.size(), "be at least 1");
    detail::require(nodes_.size() == coefficients_.size(), name, "number of coefficients", coefficients_.size(),
                    "be the number of nodes");
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        detail::require(detail::is_finite(nodes_[k]) && (k == 0 || nodes_[k] > nodes_[k - 1]), name, "node", nodes_[k],
                        "be finite and above the one before");
        constexpr double quarter = 1.5708;
        detail::require(
            std::abs(nodes_[k]) <= (over == Over::angle ? quarter : 1), name, "node", nodes_[k],
            over == Over::angle ? "lie within a quarter turn: angles are in rad" : "lie within +-1: places are in m");
        detail::require(detail::is_finite(coefficients_[k]) && coefficients_[k] >= 0, name, "coefficient",
                        coefficients_[k], "be finite and not negative");
    }
}

ROLLBEM_DECL double RollingFriction::OnRail::at(double angle, double y) const {
    const double place = over_ == Over::angle ? angle : y;
    return detail::linear_between(nodes_, coefficients_, place);
}

ROLLBEM_DECL WheelsetForces::Wrench WheelsetForces::Wrench::at(const std::array<double, 3>& arm,
                                                               const std::array<double, 3>& force) {
    WheelsetForces::Wrench wrench{.force = force};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        wrench.moment[i] = arm[j] * force[k] - arm[k] * force[j];
    }
    return wrench;
}

ROLLBEM_DECL auto WheelsetForces::Wrench::operator+=(const WheelsetForces::Wrench& other) -> WheelsetForces::Wrench& {
    for (std::size_t i = 0; i < 3; ++i) {
        force[i] += other.force[i];
        moment[i] += other.moment[i];
    }
    return *this;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Patches of one plane that roll forward.
struct RollingPatches {
    std::vector<const RailPatch*> patches;
    const WheelsetPosition& at;
    const WheelsetSpeeds& speeds;
    const WheelOnRail::Dimensions& dimensions;

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
        const Creepage here = rolling.creepage(k);  // of one spin in a plane
        own.col(0).array() += here.longitudinal - first.longitudinal;
        own.col(1).array() += here.lateral - first.lateral;
    }
    return rows;
}

/// Force and moment of the tractions [Pa] on a patch's elements.
inline TangentialForce force_of(const std::vector<PatchMesh<double>::Rectangle>& elements,
                                const ElementVectors& tractions) {
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

inline PatchTemperatures temperatures_of(const std::vector<PatchMesh<double>::Rectangle>& elements, Eigen::Index along,
                                         const Eigen::ArrayXd& work, double speed,
                                         const RollingFriction::Heating& heating) {
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

/// The system of a mesh, and the pressures on its elements.
struct AssembledMesh {
    PatchMeshes meshes;
    ElementSystem<double, 2> system;
    Eigen::ArrayXd pressures;
};

inline AssembledMesh assembled(PatchMeshes meshes, const PatchContact& contact,
                               const std::vector<const RailPatch*>& patches, const RollingFriction& friction) {
    auto system = steady_system(
        meshes.joined(), NodeDifference{Nodes::chebyshev},
        HalfSpace<double>(contact.poisson_ratio(), friction.layer * contact.shear_modulus() / meshes.unit));
    Eigen::ArrayXd pressures(system.size());
    for (std::size_t k = 0; k < patches.size(); ++k) {
        pressures.segment(meshes.first(k), meshes.size(k)) =
            pressures_on(meshes.patches[k].rectangles(meshes.unit), *patches[k]);
    }
    return {std::move(meshes), std::move(system), std::move(pressures)};
}

/// Solves friction on a mesh for given coefficients of its elements.
class MeshSolver {
public:
    MeshSolver(const AssembledMesh& mesh, const PatchContact& contact, const RollingPatches& rolling,
               const RollingFriction& friction)
        : meshes_(mesh.meshes),
          contact_(contact),
          rolling_(rolling),
          friction_(friction),
          system_(mesh.system),
          pressures_(mesh.pressures) {}

    /// Alternates friction and temperature, which depend on each other, in relaxed steps.
    MeshFriction solve() const {
        const Eigen::ArrayXd cold = coefficients_on(meshes_, rolling_, friction_);
        MeshFriction found = with(cold);
        if (!friction_.heating || found.status != Status::ok) return found;
        const std::optional<RollingFriction::Heating::Friction>& hot = friction_.heating->friction;
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
    std::vector<Yield::LoadedRectangle> surface(const ElementVectors& tractions) const {
        std::vector<Yield::LoadedRectangle> found;
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
        const RollingFriction::Heating& heating = *friction_.heating;
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
    const ElementSystem<double, 2>& system_;
    const Eigen::ArrayXd& pressures_;
};

inline std::vector<PatchForce> friction_on(const AssembledMesh& assembled_mesh, const PatchContact& contact,
                                           const RollingPatches& rolling, const RollingFriction& friction) {
    const PatchMeshes& meshes = assembled_mesh.meshes;
    const MeshSolver solver(assembled_mesh, contact, rolling, friction);
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

/// Friction on the patches of one plane under several motions, which may also roll backwards or stand still.
class PlaneFriction {
public:
    PlaneFriction(std::vector<RailPatch> patches, const WheelsetPosition& at, const WheelOnRail::Dimensions& dimensions,
                  const RollingFriction& friction)
        : patches_(std::move(patches)),
          at_(at),
          dimensions_(dimensions),
          friction_(friction),
          contact_(contact_of(patches_[0], dimensions)) {
        for (const RailPatch& patch : patches_) {
            PatchElements& own = elements_.emplace_back(elements_for(patch));
            if (friction.elements > 0) own.along = friction.elements;
            if (friction.strips > 0) own.strips = friction.strips;
        }
    }

    std::vector<PatchForce> forces(const WheelsetSpeeds& speeds) {
        const double rolls = rolling_velocity_of(patches_[0], speeds);
        if (rolls < 0) {
            constexpr Mirror mirror = Mirror::reversing_x();
            std::vector<RailPatch> images;
            for (const RailPatch& patch : patches_) images.push_back(mirrored(patch, mirror));
            std::vector<PatchForce> found =
                PlaneFriction(std::move(images), mirrored(at_, mirror), dimensions_, friction_)
                    .forces(mirrored(speeds, mirror));
            for (PatchForce& patch : found) patch = mirrored(std::move(patch), mirror);
            return found;
        }
        RollingPatches rolling{{}, at_, speeds, dimensions_};
        for (const RailPatch& patch : patches_) rolling.patches.push_back(&patch);
        const bool known = rolls >= (std::numeric_limits<double>::min)() && is_finite(rolling.creepage(0));
        if (is_finite(speeds) && !known) {
            return std::vector<PatchForce>(patches_.size(),
                                           {.force = {0, 0, 0}, .slip_work = 0, .status = Status::invalid_step});
        }
        std::vector<PatchForce> found;
        with_fewer_strips(elements_, [&](const std::vector<PatchElements>& fewer) {
            const Eigen::Index strips = std::accumulate(fewer.begin(), fewer.end(), Eigen::Index(0),
                                                        [](auto sum, const auto& of) { return sum + of.strips; });
            if (!mesh_ || strips_ != strips) {
                mesh_ = assembled(friction_meshes(rolling.patches, fewer, contact_.half_length()), contact_,
                                  rolling.patches, friction_);
                strips_ = strips;
            }
            found = friction_on(*mesh_, contact_, rolling, friction_);
            return found[0].status != Status::assists_creepage;
        });
        return found;
    }

private:
    const std::vector<RailPatch> patches_;
    const WheelsetPosition at_;
    const WheelOnRail::Dimensions& dimensions_;
    const RollingFriction& friction_;
    PatchContact contact_;
    std::vector<PatchElements> elements_;
    std::optional<AssembledMesh> mesh_;  // of the last motion
    Eigen::Index strips_ = 0;            // of all its patches
};

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

ROLLBEM_DECL std::vector<std::vector<PatchForce>> patch_forces(const std::vector<RailPatch>& patches,
                                                               const WheelsetPosition& at,
                                                               const std::vector<WheelsetSpeeds>& motions,
                                                               const WheelOnRail::Dimensions& dimensions,
                                                               const RollingFriction& friction) {
    detail::require_valid(friction);
    std::vector<std::vector<PatchForce>> found(motions.size(), std::vector<PatchForce>(patches.size()));
    for (const std::vector<std::size_t>& plane : patches_by_plane(patches)) {
        std::vector<RailPatch> coplanar;
        for (const std::size_t k : plane) coplanar.push_back(patches[k]);
        detail::PlaneFriction solver(std::move(coplanar), at, dimensions, friction);
        for (std::size_t m = 0; m < motions.size(); ++m) {
            std::vector<PatchForce> own = solver.forces(motions[m]);
            for (std::size_t i = 0; i < plane.size(); ++i) found[m][plane[i]] = std::move(own[i]);
        }
    }
    return found;
}

ROLLBEM_DECL std::vector<PatchForce> patch_forces(const std::vector<RailPatch>& patches, const WheelsetPosition& at,
                                                  const WheelsetSpeeds& speeds,
                                                  const WheelOnRail::Dimensions& dimensions,
                                                  const RollingFriction& friction) {
    return patch_forces(patches, at, std::vector{speeds}, dimensions, friction)[0];
}

ROLLBEM_DECL WheelsetForces::Wrench pressure_wrench_of(const RailPatch& patch, double y, double z) {
    const NormalContact::Cells& grid = patch.grid;
    const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1));
    WheelsetForces::Wrench wrench;
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const double sum = patch.pressure.col(j).sum(), load = sum * grid.dx * grid.dy;
        if (!(sum > 0)) continue;
        const auto place = patch.place((patch.pressure.col(j) * x).sum() / sum, grid.y(j), patch.rail_n[j]);
        wrench += WheelsetForces::Wrench::at({place[0], place[1] - y, place[2] - z},
                                             patch.in_track(0, load * patch.rail_slope[j], -load));
    }
    return wrench;
}

ROLLBEM_DECL WheelsetForces::Wrench wrench_of(const RailPatch& patch, const PatchForce& friction, double y, double z) {
    const auto [force_x, force_s, moment] = friction.force;
    const std::array<double, 3> place = creepage_place(patch);
    WheelsetForces::Wrench wrench =
        WheelsetForces::Wrench::at({place[0], place[1] - y, place[2] - z}, patch.in_track(force_x, force_s, 0));
    wrench += {.force = {}, .moment = patch.in_track(0, 0, moment)};
    wrench += pressure_wrench_of(patch, y, z);
    return wrench;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Multiplies all forces of a wheel by a factor.
inline void scale(WheelOnRail::Contact& wheel, std::vector<PatchForce>& forces, double factor) {
    for (RailPatch& patch : wheel.patches) {
        for (double* of : {&patch.load, &patch.peak_pressure}) *of *= factor;
        patch.pressure *= factor;
    }
    for (PatchForce& patch : forces) {
        patch.force = factor * patch.force;
        patch.slip_work *= factor;
        patch.strip_work *= factor;
        patch.work *= factor;
        for (Yield::LoadedRectangle& element : patch.surface) {
            for (double* of : {&element.traction_x, &element.traction_y, &element.pressure}) *of *= factor;
        }
    }
}

/// Searches for the vertical load of a wheel's normal forces with which normal forces and friction carry the wanted
/// load. `log_load_factor` is the logarithm of the former over the latter.
class CarriedLoad {
public:
    double log_load_factor = 0;

    /// Whether normal forces and friction carry the wanted load to 1e-6, or the wheel does not touch; otherwise sets
    /// another load. Contacts jump a little where grids change: there all forces are scaled.
    bool settled(WheelOnRail::Contact& wheel, std::vector<PatchForce>& forces, double wanted) {
        double carried = 0;
        for (std::size_t i = 0; i < forces.size(); ++i)
            carried -= wrench_of(wheel.patches[i], forces[i], 0, 0).force[2];
        const double excess = std::log((std::max)(carried / wanted, 1e-2));
        if (!is_finite(carried) || std::abs(excess) < 1e-6) return true;
        before_ = std::exchange(log_load_factor, root_.next(log_load_factor, excess));
        constexpr double jump = 1e-2;
        if (root_.width() > 1e-6) return false;
        if (std::abs(excess) > jump) {
            root_ = RisingRoot(1, largest);  // the bounds belonged to another state of the other wheel
            return false;
        }
        scale(wheel, forces, wanted / carried);
        return true;
    }
    /// Returns halfway to the previous load.
    void halve_step() { log_load_factor = (log_load_factor + before_) / 2; }

private:
    static constexpr double largest = 1.4;  // largest step
    double before_ = 0;
    RisingRoot root_{1, largest};
};

/// Contacts and friction in turn, until they carry the loads.
class RollingBalance {
public:
    RollingBalance(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling, const RollingFriction& friction)
        : wheelset_(wheelset),
          rolling_(rolling),
          friction_(friction),
          position_(rolling.position),
          speeds_(rolling.speeds) {}

    WheelsetForces solve(WheelsetOnTrack::Workspace& workspace, const WheelOnRail::Options& options) {
        for (bool settled = false; !settled;) {
            ++result_.rounds;
            find_contacts(workspace, options);
            if (halves_steps()) continue;
            if (rolling_.free_pitch) speeds_.pitch_rate = free_pitch_rate(wheelset_, result_.contacts, speeds_);
            settled = true;
            for (const Side side : WheelsetOnTrack::sides) {
                find_friction(side);
                settled = is_balanced(side) && settled;
            }
        }
        judge();
        for (const Side side : WheelsetOnTrack::sides) add_forces(side);
        return std::move(result_);
    }

private:
    using Side = WheelsetOnTrack::Side;
    using Free = WheelsetOnTrack::Free;

    WheelOnRail::Contact& wheel(Side side) { return result_.contacts.wheels[std::size_t(side)]; }

    void find_contacts(WheelsetOnTrack::Workspace& workspace, const WheelOnRail::Options& options) {
        std::array<double, 2> loads = rolling_.loads;
        for (std::size_t k = 0; k < 2; ++k) loads[k] *= std::exp(carried_[k].log_load_factor);
        result_.contacts = wheelset_.solve(position_, loads, workspace, rolling_.free, options);
        // the roll changes little from one round to the next
        if (has_numbers(result_.contacts.status)) position_.roll = result_.contacts.position.roll;
    }

    /// Whether a wheel has lost the numbers that it had under the previous loads; then loads return towards these.
    bool halves_steps() {
        constexpr int most = 4;
        bool lost = false;
        for (std::size_t k = 0; k < 2 && failures_ < most; ++k) {
            if (has_numbers(result_.contacts.wheels[k].status) || result_.patches[k].empty()) continue;
            carried_[k].halve_step();
            lost = true;
        }
        failures_ += lost;
        return lost;
    }

    void find_friction(Side side) {
        std::vector<PatchForce>& found = result_.patches[std::size_t(side)];
        found.clear();
        if (!has_numbers(wheel(side).status)) return;
        result_.pitch_rate = speeds_.pitch_rate;
        found = patch_forces(wheel(side).patches, result_.contacts.seen(side),
                             WheelsetOnTrack::seen_from(side, speeds_), wheelset_.wheel(side).dimensions(), friction_);
    }

    /// Whether a wheel needs no further round: it carries its load, it has none, or its search has ended with another
    /// status.
    bool is_balanced(Side side) {
        constexpr int most = 40;
        constexpr double out_of_reach = 5;  // a load of 150 times the one wanted
        const auto k = static_cast<std::size_t>(side);
        Status& status = wheel(side).status;
        if (!has_numbers(status) || rolling_.free == Free::nothing || !rolling_.loads_include_friction) return true;
        if (carried_[k].settled(wheel(side), result_.patches[k], rolling_.loads[k])) return true;
        const bool last = result_.rounds >= most, lifted = carried_[k].log_load_factor > out_of_reach;
        if (lifted) status = Status::load_not_reached;
        if (lifted && rolling_.free == Free::height_and_roll) {
            for (const Side both : WheelsetOnTrack::sides) wheel(both).status = Status::load_not_reached;
        }
        if (last) status = (std::max)(status, Status::unbalanced);
        return last || lifted;
    }

    /// Sets statuses of wheels by the statuses of their patches, and the status of the contacts.
    void judge() {
        for (const Side side : WheelsetOnTrack::sides) {
            Status& status = wheel(side).status;
            for (const PatchForce& patch : result_.patches[std::size_t(side)]) {
                if (patch.status == Status::invalid_step) status = (std::max)(status, Status::unbalanced);
            }
        }
        result_.contacts.status = (std::max)(wheel(Side::left).status, wheel(Side::right).status);
    }

    void add_forces(Side side) {
        const auto k = static_cast<std::size_t>(side);
        std::vector<PatchForce>& friction = result_.patches[k];
        if (!has_numbers(wheel(side).status)) friction.clear();
        const WheelsetPosition at = result_.contacts.seen(side);
        const double axle = at.height - wheelset_.wheel(side).dimensions().radius;
        WheelsetForces::Wrench sum;
        for (std::size_t i = 0; i < friction.size(); ++i) {
            sum += wrench_of(wheel(side).patches[i], friction[i], at.lateral, axle);
        }
        result_.on_wheel[k] = mirrored(sum, Mirror::of(side));
        result_.on_wheelset += result_.on_wheel[k];
    }

    const WheelsetOnTrack& wheelset_;
    const WheelsetRolling& rolling_;
    const RollingFriction& friction_;
    WheelsetPosition position_;
    WheelsetSpeeds speeds_;
    std::array<CarriedLoad, 2> carried_;
    int failures_ = 0;
    WheelsetForces result_;
};

/// Whether a wheel has friction, and each of the others is lifted.
inline bool has_friction_result(const WheelsetForces& forces) {
    const auto& [left, right] = forces.contacts.wheels;
    const auto known = [](Status status) { return has_numbers(status) || status == Status::no_contact; };
    return known(left.status) && known(right.status) && (has_numbers(left.status) || has_numbers(right.status));
}

/// Makes the status of wheels with numbers, and of the wheelset, no better than this one.
inline void set_at_least(WheelsetForces& forces, Status status) {
    for (WheelOnRail::Contact& wheel : forces.contacts.wheels) {
        if (has_numbers(wheel.status)) wheel.status = (std::max)(wheel.status, status);
        forces.contacts.status = (std::max)(forces.contacts.status, wheel.status);
    }
}

/// Leaves contacts.
inline void take_friction_out(WheelsetForces& forces) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::vector<PatchForce>& patches : forces.patches) {
        for (PatchForce& patch : patches) {
            patch = {.creepage = {nan, nan, nan},
                     .force = {nan, nan, nan},
                     .elements = patch.elements,
                     .status = patch.status == Status::ok ? Status::no_solution : patch.status};
        }
    }
    const WheelsetForces::Wrench unknown{{nan, nan, nan}, {nan, nan, nan}};
    forces.on_wheel = {unknown, unknown};
    forces.on_wheelset = unknown;
    forces.pitch_rate = nan;
}

/// The pitch rate at which friction has the wanted longitudinal force, between -20 and 20 % of creepage.
inline WheelsetForces roll_at_force(const WheelsetOnTrack& wheelset, WheelsetRolling rolling,
                                    const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                                    const WheelOnRail::Options& options) {
    constexpr double steepest = 100, largest_step = 0.02, most = 0.2, enough = 1e-6, jumps = 1e-9;
    const double wanted = *std::exchange(rolling.force, std::nullopt), forward = rolling.speeds.forward < 0 ? -1 : 1;
    rolling.free_pitch = true;
    WheelsetForces result = RollingBalance(wheelset, rolling, friction).solve(workspace, options);
    rolling.free_pitch = false;
    const double free = result.pitch_rate;
    RisingRoot root(steepest, largest_step);
    double creepage = 0;
    for (int k = 0; k < 80 && has_friction_result(result); ++k) {
        double load = 0;
        for (const WheelOnRail::Contact& wheel : result.contacts.wheels) {
            for (const RailPatch& patch : wheel.patches) load += patch.load;
        }
        const double excess = forward * (result.on_wheelset.force[0] - wanted) / load;
        if (std::abs(excess) < enough) return result;
        creepage = root.next(creepage, excess);
        if (!(std::abs(creepage) < most)) break;
        if (root.width() < jumps) {  // forces jump here with the grids of the contacts
            set_at_least(result, Status::unbalanced);
            return result;
        }
        rolling.speeds.pitch_rate = free * (1 + creepage);
        result = RollingBalance(wheelset, rolling, friction).solve(workspace, options);
    }
    take_friction_out(result);
    return result;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelsetForces rolling_forces(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling,
                                           const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                                           const WheelOnRail::Options& options) {
    if (!detail::is_finite(rolling.speeds)) return {};
    if (rolling.force) return detail::roll_at_force(wheelset, rolling, friction, workspace, options);
    return detail::RollingBalance(wheelset, rolling, friction).solve(workspace, options);
}

ROLLBEM_DECL Status WheelsetForces::status() const {
    if (contacts.status != Status::ok) return contacts.status;
    for (const std::vector<PatchForce>& wheel : patches) {
        for (const PatchForce& patch : wheel) {
            if (patch.status != Status::ok) return patch.status;
        }
    }
    return Status::ok;
}

ROLLBEM_DECL double WheelsetForces::slip_work() const {
    double sum = 0;
    for (const std::vector<PatchForce>& wheel : patches) {
        for (const PatchForce& patch : wheel) sum += patch.slip_work;
    }
    return sum;
}

ROLLBEM_DECL double WheelsetForces::peak_pressure() const {
    double largest = 0;
    for (const auto& wheel : contacts.wheels) {
        for (const RailPatch& patch : wheel.patches) largest = (std::max)(largest, patch.peak_pressure);
    }
    return largest;
}

}  // namespace rollbem
