// CreepForceTable: steady forces of elliptic contacts with friction and spin by look-up, for programs that need them at
// every step. A table is made once from any source of forces, or read from a file written by creep_table.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <concepts>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include <Eigen/Core>

#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"
#include "creep_force_grid.hpp"

namespace rollbem {

/// Result of a look-up, in the units of the contact.
struct TabulatedForce {
    TangentialForce force;            ///< force on body 1 [N], moment about the contact's middle [N m]; NaN unless ok
    CreepageTangent tangent;          ///< d force/d creepage: the exact derivative of the interpolation, as are the
                                      ///< following
    TangentialForce tangent_by_load;  ///< derivative at constant semi-axes [1], [m]
    TangentialForce tangent_by_friction_coefficient;  ///< [N], [N m]
    TangentialForce tangent_by_half_length;           ///< derivative at constant half-width [N/m], [N]
    TangentialForce tangent_by_half_width;            ///< derivative at constant half-length [N/m], [N]
    /// a/b lies on the table. If not, forces belong to its nearest ellipse with the same area: they are continuous, but
    /// their error is unknown.
    bool a_over_b_on_table = false;
    /// not_finite, invalid_load (mu or N is negative or not finite), or wrong_table
    Status status = Status::not_finite;
};

/// Steady creep forces of ellipses under Hertz's pressure, interpolated in log(a/b), xi, eta and phi (see
/// CreepForceGrid) by cubic splines.
///
/// - Smoothness: forces have two continuous derivatives, and one where creepage and spin vanish.
/// - Symmetry: exact; without creepage and spin the force is exactly 0.
/// - Range: for unbounded creepages forces tend to full_sliding(), the outermost level of the table. No creepage lies
///   outside.
/// - Bound: the interpolation may exceed mu N by its error.
///
/// Immutable: threads may share it.
///
///     const CreepForceTable table = CreepForceTable::read("share/rollbem/steel.creep");
///     const PatchContact contact({a, b, G, nu});
///     const TabulatedForce now = table.look_up(contact, mu, load, {xi, eta, phi});
///     if (now.status != Status::ok) ...
class CreepForceTable {
public:
    /// |X| mu N, the size of the linear forces that scale the lattice of a table (see CreepForceGrid), in the units of
    /// the contact.
    struct LinearForce {
        double value;           ///< [N]
        Creepage by_creepage;   ///< its derivatives [N], by spin [N m]; 0 where creepage and spin vanish
        double by_half_length;  ///< derivative at constant half-width [N/m]
        double by_half_width;   ///< derivative at constant half-length [N/m]
    };

    /// `forces`: -F_x/(mu N), -F_y/(mu N) and -M_z/(mu N c) in a column for every node of the first ellipse of the
    /// grid, then of the next one. Throws std::invalid_argument if their number differs or one of them is not finite or
    /// above 100.
    CreepForceTable(CreepForceGrid grid, const Eigen::Ref<const Eigen::Array3Xd>& forces);

    /// Reads the format of write(). The stream must be binary; it is read to the end of the table. Throws
    /// std::invalid_argument if the stream could not be opened, ends too early or holds something else, another
    /// version, or numbers that do not agree with their checksum.
    static CreepForceTable read(std::istream& stream);
    static CreepForceTable read(const std::filesystem::path& path);

    /// Little-endian, version 4: the text "rollbem creep forces", version, levels, number of ellipses (32 bits each),
    /// Poisson's ratio, smallest and largest a/b, c11, c22, c23, c32, c33 of each ellipse (64 bits each), coefficients
    /// of the splines (32 bits each), and the checksum FNV-1a of all bytes before (64 bits).
    void write(std::ostream& stream) const;

    const CreepForceGrid& grid() const { return grid_; }
    /// Whether the table holds for this Poisson's ratio, to 0.01.
    bool fits(double poisson_ratio) const { return std::abs(poisson_ratio - grid_.poisson_ratio()) <= 0.01 + 1e-12; }

    /// The forces of an ellipse under the load N [N] with the coefficient of friction mu, in SI units. status is
    /// wrong_table if Poisson's ratio differs from the table's by more than 0.01, or for an outline. Without friction
    /// or load, or if mu N is below 1e-308 G a b, there is no force at rest and no tangent. Does not allocate.
    TabulatedForce look_up(const PatchContact& contact, double friction_coefficient, double load,
                           const Creepage& creepage) const noexcept;

    /// The force of look_up() alone, to the rounding of Digits, float or double, in less time; not finite where
    /// creepages are not. Unchecked: semi-axes and G must satisfy the rules of PatchContact, and Poisson's ratio must
    /// fit.
    template <std::floating_point Digits = double>
    TangentialForce force(const PatchContact::Parameters& contact, double friction_coefficient, double load,
                          const Creepage& creepage) const noexcept;

    /// The distance of a contact from rest, in forces: full sliding begins at 1 to 3 mu N. The contact must satisfy the
    /// rules of look_up(). Does not allocate.
    LinearForce saturation_parameter(const PatchContact& contact, const Creepage& creepage) const noexcept;

private:
    struct Splines;  // internal

    explicit CreepForceTable(CreepForceGrid grid);

    CreepForceGrid grid_;
    Eigen::Index n_;
    double first_log_, per_log_;  ///< log(a/b) of the first ellipse, and 1 over its distance from the last one's
    Eigen::ArrayXXd scales_;      ///< coefficients of splines in log(a/b)
    /// Derivatives of the splines where creepage vanishes (F_x by u_x, F_y by u_y and u_phi, M_z by u_y and u_phi), and
    /// c32 and c33, which correct them; coefficients of splines in log(a/b).
    Eigen::ArrayXXd at_rest_;
    std::vector<float, Eigen::aligned_allocator<float>> coefficients_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/creep_force_table.ipp"
#else
namespace rollbem {
extern template TangentialForce CreepForceTable::force<double>(const PatchContact::Parameters&, double, double,
                                                               const Creepage&) const noexcept;
extern template TangentialForce CreepForceTable::force<float>(const PatchContact::Parameters&, double, double,
                                                              const Creepage&) const noexcept;
}  // namespace rollbem
#endif
