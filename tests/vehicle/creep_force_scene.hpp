// Creep forces in closed form, with the symmetries, the linear law and the limit of a patch's forces: a source of
// tables for tests.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace creep_forces {

using namespace rollbem;

inline CreepCoefficients<double> coefficients(double a_over_b) {
    const double r = std::sqrt(a_over_b);
    return {3 + r, 2.5 + 1.2 * r, 0.3 + 1.2 * r, -0.3 - 1.2 * r, 0.5 + 0.7 / r};
}

/// At creepages times G a b/(mu N) and spin times G a b c/(mu N).
inline Eigen::Array3d forces(double a_over_b, const Creepage& v) {
    const CreepCoefficients<double> c = coefficients(a_over_b);
    const double x = c.c11 * v.longitudinal, y = c.c22 * v.lateral, spin = (c.c23 + c.c33) * v.spin;
    const double size = std::sqrt(x * x + y * y + spin * spin), rest = 1 / ((1 + size) * (1 + size));
    const auto full = full_sliding(a_over_b, v.longitudinal, v.lateral, v.spin);
    const Eigen::Array3d linear(x, y + c.c23 * v.spin, c.c32 * v.lateral + c.c33 * v.spin);
    return size * size * rest * Eigen::Array3d(full.longitudinal, full.lateral, full.moment) + rest * linear;
}

inline CreepForceTable::Grid grid(int levels, int shapes, double smallest = 0.5, double largest = 2) {
    std::vector<CreepCoefficients<double>> all;
    for (int i = 0; i < shapes; ++i) {
        all.push_back(coefficients(CreepForceTable::Grid::a_over_b_of(i, shapes, smallest, largest)));
    }
    return {0.28, smallest, largest, levels, std::move(all)};
}

inline CreepForceTable table(int levels, int shapes) {
    const CreepForceTable::Grid nodes = grid(levels, shapes);
    Eigen::Array3Xd values(3, nodes.nodes() * nodes.shapes());
    for (Eigen::Index i = 0; i < nodes.shapes(); ++i) {
        for (Eigen::Index k = 0; k < nodes.nodes(); ++k) {
            values.col(i * nodes.nodes() + k) = forces(nodes.a_over_b(i), nodes.creepage(i, k));
        }
    }
    return {nodes, values};
}

/// An ellipse of steel with c = 5 mm.
inline PatchContact contact(double a_over_b, double nu = 0.28) {
    return PatchContact({5e-3 * std::sqrt(a_over_b), 5e-3 / std::sqrt(a_over_b), 8e10, nu});
}

inline Eigen::Array3d array(const TangentialForce& force) { return {force.longitudinal, force.lateral, force.moment}; }

/// The force, then its derivatives by creepages, N, mu, a and b.
inline Eigen::Array<double, 3, 8> numbers(const CreepForceTable::Force& at) {
    Eigen::Array<double, 3, 8> all;
    all << array(at.force), array(at.tangent.by_longitudinal), array(at.tangent.by_lateral), array(at.tangent.by_spin),
        array(at.tangent_by_load), array(at.tangent_by_friction_coefficient), array(at.tangent_by_half_length),
        array(at.tangent_by_half_width);
    return all;
}

}  // namespace creep_forces
