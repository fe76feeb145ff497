// The creep matrices of a wheel's patches, forces per creepage in full adhesion, and the numbers of the ellipses that
// have the same.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "../../detail/require.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../../discretisation/scheme.hpp"
#include "../../elasticity/patch_kernel.hpp"
#include "../../normal/detail/mirrored_patch.hpp"
#include "../../scene/detail/mirror.hpp"
#include "../../scene/wheelset.hpp"
#include "../../steady/creep_coefficients.hpp"
#include "../contact_table.hpp"
#include "../creep_force_table.hpp"
#include "../wheelset_on_track.hpp"
#include "contact_row.hpp"
#include "patch_elements.hpp"

namespace rollbem::detail {

/// Linear forces of each strip in full adhesion, reversed [N, N m]: F_x, F_y and M_z about the reference point, per xi,
/// eta and phi at that point.
struct StripCreepMatrices {
    std::vector<double> s;  ///< middles of the strips [m]
    std::vector<Eigen::Matrix3d> creep_matrix;
};

/// Creep matrices of the strips of one patch. The responses p/G cover all elements in its plane, for unit xi,
/// eta and phi.
inline StripCreepMatrices strip_creep_matrices_of(const PatchMeshes& meshes, std::size_t patch,
                                                  const MatrixX<double>& unknowns, double shear_modulus) {
    const PatchMesh<double>& mesh = meshes.patches[patch];
    const std::vector<PatchMesh<double>::Rectangle> elements = mesh.rectangles(meshes.unit);
    const Eigen::Index n = mesh.elements_per_strip(), first = meshes.first(patch), count = unknowns.rows() / 2;
    StripCreepMatrices found;
    for (Eigen::Index j = 0; j < mesh.strip_count(); ++j) {
        Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
        for (Eigen::Index i = j * n; i < (j + 1) * n; ++i) {
            const auto& [x_1, x_2, y_1, y_2] = elements[std::size_t(i)];
            const double area = -shear_modulus * (x_2 - x_1) * (y_2 - y_1);
            const Eigen::RowVector3d x = area * unknowns.row(first + i), y = area * unknowns.row(count + first + i);
            matrix.row(0) += x;
            matrix.row(1) += y;
            matrix.row(2) += (x_1 + x_2) / 2 * y - (y_1 + y_2) / 2 * x;
        }
        matrix.col(2) *= meshes.unit;
        found.creep_matrix.push_back(matrix);
        found.s.push_back(meshes.unit * mesh.middles_y()[j]);
    }
    return found;
}

/// Creep matrices of the strips of all patches of a wheel: patches of one plane stick together. A patch has
/// none if it has no outline, or if rolling would gain energy on all meshes.
inline std::vector<StripCreepMatrices> strip_creep_matrices(const std::vector<RailPatch>& patches,
                                                            const WheelOnRail::Dimensions& dimensions) {
    std::vector<StripCreepMatrices> found(patches.size());
    const HalfSpace<double> half_space(dimensions.poisson_ratio);
    for (const std::vector<std::size_t>& plane : patches_by_plane(patches)) {
        std::vector<const RailPatch*> coplanar;
        std::vector<PatchElements> elements;
        for (const std::size_t k : plane) {
            coplanar.push_back(&patches[k]);
            elements.push_back(elements_for(patches[k]));
        }
        const double unit = contact_of(*coplanar[0], dimensions).half_length();
        with_fewer_strips(elements, [&](const std::vector<PatchElements>& fewer) {
            const PatchMeshes meshes = friction_meshes(coplanar, fewer, unit);
            const Response<double> own = solve_steady(meshes.joined(), NodeDifference{Nodes::chebyshev}, half_space);
            if (own.status != Status::ok) return false;
            for (std::size_t i = 0; i < plane.size(); ++i) {
                found[plane[i]] = strip_creep_matrices_of(meshes, i, own.unknowns, dimensions.shear_modulus);
            }
            return true;
        });
    }
    return found;
}

/// A patch with its creep matrices and those of its mirror image across the track, which the wheel has at the opposite
/// yaw. Zones take shares of both.
struct PatchCreepMatrices {
    RailPatch patch;
    StripCreepMatrices own, mirrored;
};

/// Creep matrices of all patches of a wheel; `symmetric` patches are their own mirror images.
inline std::vector<PatchCreepMatrices> patch_creep_matrices(const std::vector<RailPatch>& patches,
                                                            const WheelOnRail::Dimensions& dimensions, bool symmetric) {
    const std::vector<StripCreepMatrices> own = strip_creep_matrices(patches, dimensions);
    std::vector<StripCreepMatrices> other = own;
    if (!symmetric) {
        std::vector<RailPatch> images;
        for (const RailPatch& patch : patches) images.push_back(mirrored(patch, Mirror::reversing_x()));
        other = strip_creep_matrices(images, dimensions);
    }
    std::vector<PatchCreepMatrices> found;
    for (std::size_t k = 0; k < patches.size(); ++k) found.push_back({patches[k], own[k], other[k]});
    return found;
}

/// The pressures of a zone: their resultant, and the numbers that determine an ellipse.
struct ZonePressures {
    double load = 0;                    ///< size of the resultant [N]
    Eigen::Vector3d place;              ///< point of the resultant in track axes, as deep as the wheel's undeformed
                                        ///< surface [m]
    double angle = 0;                   ///< angle of the mean normal [rad]
    double square_x = 0, square_s = 0;  ///< second moments about the place over the load [m^2]
    double radius = 0, rail_y = 0, wheel_y = 0, peak = 0;
    double plane = 0;  ///< mean angle of the planes of the patches [rad]

    double vertical() const { return load * std::cos(angle); }
    Eigen::Vector3d along_s() const { return {0, std::cos(angle), std::sin(angle)}; }
    /// Distance of the place from the reference point of a patch, in the patch's plane (x, s).
    Eigen::Vector2d from(const RailPatch& patch) const {
        return {place[0] - patch.x,
                (place[1] - patch.y) * std::cos(patch.angle) + (place[2] - patch.z) * std::sin(patch.angle)};
    }
};

/// Calls visit(patch, pressure times weight, x, s, slope) for each cell of a zone with pressure.
template <class Visit>
void for_cells(const std::vector<PatchCreepMatrices>& patches, const ContactTable::Zones& zones, Eigen::Index zone,
               const Visit& visit) {
    for (const PatchCreepMatrices& of : patches) {
        const RailPatch& patch = of.patch;
        const NormalContact::Cells& grid = patch.grid;
        for (Eigen::Index j = 0; j < grid.ny; ++j) {
            const double s = grid.y(j), weight = zones.weight(zone, patch.y + s * std::cos(patch.angle));
            if (!(weight > 0)) continue;
            for (Eigen::Index i = 0; i < grid.nx; ++i) {
                if (patch.pressure(i, j) > 0)
                    visit(patch, weight * patch.pressure(i, j), grid.x(i), s, patch.rail_slope[j]);
            }
        }
    }
}

inline ZonePressures pressures_of(const std::vector<PatchCreepMatrices>& patches, const ContactTable::Zones& zones,
                                  Eigen::Index zone) {
    ZonePressures found;
    double sum = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for_cells(patches, zones, zone, [&](const RailPatch& patch, double pressure, double x, double s, double slope) {
        const double sine = std::sin(patch.angle), cosine = std::cos(patch.angle);
        const double force = pressure * patch.grid.dx * patch.grid.dy;
        sum += force;
        place += force * Eigen::Map<const Eigen::Vector3d>(patch.place(x, s, patch.approach).data());
        normal += force * Eigen::Map<const Eigen::Vector3d>(patch.in_track(0, -slope, 1).data());
        found.radius += force * (patch.rolling_radius + s * sine);
        found.rail_y += force * (patch.rail_y + s * cosine);
        found.wheel_y += force * (patch.wheel_y + s * cosine);
        found.plane += force * patch.angle;
        found.peak = (std::max)(found.peak, pressure);
    });
    if (!(sum > 0)) return found;
    found.load = normal.norm();
    found.angle = std::atan2(-normal[1], normal[2]);
    found.place = place / sum;
    for (double* mean : {&found.radius, &found.rail_y, &found.wheel_y, &found.plane}) *mean /= sum;
    const Eigen::Vector3d across = found.along_s();
    for_cells(patches, zones, zone, [&](const RailPatch& patch, double pressure, double x, double s, double) {
        const double force = pressure * patch.grid.dx * patch.grid.dy / sum;
        const Eigen::Vector3d apart =
            Eigen::Map<const Eigen::Vector3d>(patch.place(x, s, patch.approach).data()) - found.place;
        const double along = apart[0], beside = across.dot(apart);
        // a cell's own second moment counts where the patch is a cell wide
        found.square_x += force * (along * along + patch.grid.dx * patch.grid.dx / 12);
        found.square_s += force * (beside * beside + patch.grid.dy * patch.grid.dy / 12);
    });
    return found;
}

/// The creep matrix of a zone at its place, per (xi, eta, phi), with the moment about the place: reversed forces [N, N
/// m]. Small patches without one are taken to have that of the others; zero if the others carry less than nine
/// tenths.
inline Eigen::Matrix3d creep_matrix_of(const std::vector<PatchCreepMatrices>& patches, const ContactTable::Zones& zones,
                                       Eigen::Index zone, const ZonePressures& pressed, bool mirrored) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double carried = 0, known = 0;
    for (const PatchCreepMatrices& of : patches) {
        const StripCreepMatrices& strips = mirrored ? of.mirrored : of.own;
        carried += of.patch.load;
        if (strips.s.empty()) continue;
        known += of.patch.load;
        Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
        for (std::size_t j = 0; j < strips.s.size(); ++j) {
            own += zones.weight(zone, of.patch.y + strips.s[j] * std::cos(of.patch.angle)) * strips.creep_matrix[j];
        }
        const Eigen::Vector2d from = pressed.from(of.patch);
        Eigen::Matrix3d to_place;  // maps creepages at the reference point to creepages at the place
        to_place << 1, 0, from[1], 0, 1, mirrored ? from[0] : -from[0], 0, 0, 1;
        sum += to_place.transpose() * own * to_place;
    }
    constexpr double most = 0.9;
    if (!(known > most * carried)) return Eigen::Matrix3d::Zero();
    return carried / known * sum;
}

/// An ellipse's rows of c11, c22, c23, and its creep matrix in the form of creep_matrix_of.
inline Eigen::Matrix3d creep_matrix_of_ellipse(const PatchContact& contact, double load, const CreepForceTable& creep) {
    const CreepForceTable::Force rest = creep.look_up(contact, 1, load, {0, 0, 0});
    require(rest.status == Status::ok, "creep_ellipse", "status of the table of creep forces", name(rest.status),
            "be ok");
    Eigen::Matrix3d matrix;
    const TangentialForce::ByCreepage& t = rest.tangent;
    for (const auto& [column, by] : {std::pair(0, t.by_longitudinal), {1, t.by_lateral}, {2, t.by_spin}}) {
        matrix.col(column) = -Eigen::Vector3d(by.longitudinal, by.lateral, by.moment);
    }
    return matrix;
}

/// The creep matrix nearest to this one that dissipates under all creepages. A zone that a cut leaves of a patch may
/// gain energy from its other zones.
inline Eigen::Matrix3d dissipating(const Eigen::Matrix3d& matrix) {
    constexpr double least = 1e-2;  // of the largest dissipation, as rows are interpolated
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect((matrix + matrix.transpose()) / 2);
    const Eigen::Vector3d own = solver.eigenvalues(), raised = own.cwiseMax(least * own.maxCoeff());
    return matrix + solver.eigenvectors() * (raised - own).asDiagonal() * solver.eigenvectors().transpose();
}

/// Rows of a zone from its pressures and creep matrices, without share and arm; `yaw` is the position's yaw, 0 or
/// positive.
inline ContactRow::Values rows_of(const std::vector<PatchCreepMatrices>& patches, const ContactTable::Zones& zones,
                                  Eigen::Index zone, const ZonePressures& pressed,
                                  const WheelOnRail::Dimensions& dimensions, const CreepForceTable& creep, double yaw) {
    using enum ContactRow::Of;
    ContactRow::Values v = ContactRow::Values::Zero();
    double a = std::sqrt(5 * pressed.square_x), b = std::sqrt(5 * pressed.square_s);
    const double most = creep.grid().largest_a_over_b(), least = creep.grid().smallest_a_over_b();
    if (a > most * b || a < least * b) {
        v[full_sliding_share] = 1;
        (a > most * b ? b : a) = a > most * b ? a / most : least * b;
    }
    const PatchContact contact({a, b, dimensions.shear_modulus, dimensions.poisson_ratio});
    const double c = contact.c(), root = std::cbrt(pressed.load);
    v[length] = a / root;
    v[width] = b / root;
    v[angle] = pressed.angle;
    v[plane] = pressed.plane - pressed.angle;
    v[radius] = pressed.radius;
    v[peak] = pressed.peak / root;
    v[rail_y] = pressed.rail_y;
    v[wheel_y] = pressed.wheel_y;
    const Eigen::Vector3d units(1, 1, c);
    const auto dimensionless = [&](const Eigen::Matrix3d& matrix) -> Eigen::Matrix3d {
        return units.cwiseInverse().asDiagonal() * matrix * units.cwiseInverse().asDiagonal() /
               (dimensions.shear_modulus * c * c);
    };
    const Eigen::Matrix3d ellipse = dimensionless(creep_matrix_of_ellipse(contact, pressed.load, creep));
    v[c11] = ellipse(0, 0);
    v[c22] = ellipse(1, 1);
    v[c23] = ellipse(1, 2);
    v[creepage_scale] = 1;
    const Eigen::Matrix3d own = dissipating(dimensionless(creep_matrix_of(patches, zones, zone, pressed, false))),
                          other = dissipating(dimensionless(creep_matrix_of(patches, zones, zone, pressed, true)));
    const Eigen::Matrix3d inverse = ellipse.inverse(), even = inverse * (own + other) / 2;
    if (!(even(0, 0) > 0 && even(1, 1) > 0)) return v;  // too few cells
    v[creepage_scale] = std::sqrt(even(0, 0) * even(1, 1));
    using Rows = Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;
    Rows(v.data() + correction) = even / v[creepage_scale] - Eigen::Matrix3d::Identity();
    if (yaw > 0) Rows(v.data() + correction_by_yaw) = inverse * (own - other) / (2 * yaw * v[creepage_scale]);
    return v;
}

}  // namespace rollbem::detail
