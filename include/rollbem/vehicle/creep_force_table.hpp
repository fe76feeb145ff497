// Steady forces of elliptic contacts with friction and spin by look-up: the grid of a table, CreepForceTable, and
// friction that falls with slip.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"

namespace rollbem {

/// Steady creep forces of ellipses under Hertz's pressure, interpolated in log(a/b), xi, eta and phi (see Grid)
/// by cubic splines.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto table = CreepForceTable::read("share/rollbem/steel.creep");
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const auto now = table.look_up(contact, 0.3, 80e3, {1e-3, 5e-4, 0.1});  // mu, N [N], xi, eta [-], spin [1/m]
///     return now.status == Status::ok && now.force.longitudinal < 0 ? 0 : 1;
/// }
/// \endcode
///
/// - Smoothness: forces have two continuous derivatives, and one where creepage and spin vanish and where the bound
///   begins to act and takes over.
/// - Symmetry: exact; without creepage and spin the force is exactly 0.
/// - Range: for unbounded creepages forces tend to full_sliding(), the outermost level of the table. No creepage lies
///   outside.
/// - Bound: forces are at most mu N. Where the interpolation lies above 0.9995 mu N, its size follows a cubic that
///   reaches mu N, with no slope, where the interpolation does.
///
/// Immutable: threads may share it.
class CreepForceTable {
public:
    class Source;  // in make_creep_force_table.hpp

    /// Ellipses of a/b in steps of a constant factor, and for each of them nodes in the space of creepage and spin. X
    /// are the forces of the linear law over the forces that friction allows,
    ///
    ///     X = (c11 xi, c22 eta + c23 phi c, s phi c) G a b/(mu N),   s = sqrt(c11 c22).
    ///
    /// The pole of the spin crosses the edges of a sliding contact, where the moment turns sharply, at y = +-b where
    /// X_3/X_1 = s c/(c11 b), at x = +-a where (X_2 - c23 X_3/s)/X_3 = c22 a/(s c): this s makes both the same, so that
    /// neither edge lies within few nodes on any ellipse. Forces reach full sliding at |X| = 1 to 3; the lateral force
    /// of spin on long ellipses bends sharply at |X| = 1. Nodes lie on a cubic lattice of
    ///
    ///     u = X/(1.4 + |X|),
    ///
    /// where |u| = 1 is full sliding, at infinite creepage. By symmetry xi >= 0 and phi >= 0 suffice: xi and F_x change
    /// sign alone, and so do eta, phi, F_y and M_z together.
    ///
    /// Invariant: 0 <= nu <= 0.5; 0 < smallest a/b < largest a/b < inf; shapes() >= 4; 4 <= levels() <= 64;
    /// c11, c22, c23, -c32, c33 > 0; (levels + 3)^2 (2 levels + 3) (shapes + 2) <= 1e7.
    class Grid {
    public:
        /// The ellipses and creepages that a table covers, and the number of elements of its patches.
        struct Range {
            double poisson_ratio = 0.28;
            double smallest_a_over_b = 0.1, largest_a_over_b = 10;
            Eigen::Index shapes = 13;  ///< ellipses
            int levels = 19;           ///< nodes between no creepage and full sliding
            Eigen::Index n = 17;       ///< patches of some n^2 elements
        };

        static constexpr double saturation_scale = 1.4;  ///< |X| where |u| = 1/2
        /// Upper bound of coefficient_count().
        static constexpr Eigen::Index most_coefficients = 10'000'000;
        /// Number of coefficients of one force's splines.
        static constexpr Eigen::Index coefficient_count(Eigen::Index levels, Eigen::Index shapes) {
            return (levels + 3) * (levels + 3) * (2 * levels + 3) * (shapes + 2);
        }

        /// `coefficients` belong to the ellipses a_over_b_of(i, ...), whose number is their count; `levels` nodes lie
        /// between no creepage and full sliding. Throws std::invalid_argument if the invariant is broken.
        Grid(double poisson_ratio, double smallest_a_over_b, double largest_a_over_b, int levels,
             std::vector<CreepCoefficients<double>> coefficients);

        double poisson_ratio() const { return nu_; }
        double smallest_a_over_b() const { return smallest_; }
        double largest_a_over_b() const { return largest_; }
        int levels() const { return levels_; }
        Eigen::Index shapes() const { return static_cast<Eigen::Index>(coefficients_.size()); }  ///< number of ellipses
        /// Number of nodes of an ellipse.
        Eigen::Index nodes() const { return static_cast<Eigen::Index>(nodes_.size()); }
        const std::vector<CreepCoefficients<double>>& coefficients() const { return coefficients_; }
        /// dX_1/d xi, dX_2/d eta, dX_2/d(phi c), dX_3/d(phi c), over G a b/(mu N), in a column for each ellipse.
        const Eigen::Array4Xd& scales() const { return scales_; }

        /// a/b of ellipse i; the last is the largest.
        double a_over_b(Eigen::Index i) const { return a_over_b_of(i, shapes(), smallest_, largest_); }
        static double a_over_b_of(Eigen::Index i, Eigen::Index shapes, double smallest, double largest) {
            if (i == shapes - 1) return largest;
            return smallest * std::pow(largest / smallest, static_cast<double>(i) / static_cast<double>(shapes - 1));
        }

        /// Creepages times G a b/(mu N) and spin times G a b c/(mu N) at a node of ellipse i. The nodes form lines
        /// along which the spin grows.
        Creepage creepage(Eigen::Index i, Eigen::Index node) const {
            const Place& place = nodes_[static_cast<std::size_t>(node)];
            const double size = std::sqrt(double(place.x * place.x + place.y * place.y + place.spin * place.spin));
            return creepage(i, saturation_scale / (levels_ - size) * Eigen::Array3d(place.x, place.y, place.spin));
        }
        /// Creepages and spin, scaled as above, at X.
        Creepage creepage(Eigen::Index i, const Eigen::Array3d& X) const {
            const double spin = X[2] / scales_(3, i);
            return {X[0] / scales_(0, i), (X[1] - scales_(2, i) * spin) / scales_(1, i), spin};
        }

        /// The map from w = X unit, |w| = size, to u.
        struct Stretch {
            double factor;  ///< u/w
            double radial;  ///< du = factor (dw - radial d|w| w/|w|)
        };
        static Stretch stretch(double unit, double size) {
            const double factor = 1 / (saturation_scale * unit + size);
            return {factor, factor * size};
        }
        /// Whether a node begins a line of growing spin.
        bool begins_line(Eigen::Index node) const {
            if (node == 0) return true;
            const Place &place = nodes_[static_cast<std::size_t>(node)],
                        &last = nodes_[static_cast<std::size_t>(node - 1)];
            return place.x != last.x || place.y != last.y;
        }

        /// Nodes of one ellipse with the same xi, from `first` to before `last`: their forces do not depend on other
        /// nodes.
        struct Slab {
            Eigen::Index shape, first, last;
        };
        /// All slabs, in the order of the nodes.
        std::vector<Slab> slabs() const;

        /// A point in coordinates of the lattice.
        struct Place {
            int x, y, spin;
        };
        const Place& place(Eigen::Index node) const { return nodes_[static_cast<std::size_t>(node)]; }

    private:
        static constexpr const char* name = "CreepForceTable::Grid";

        double nu_, smallest_, largest_;
        int levels_;
        std::vector<CreepCoefficients<double>> coefficients_;
        Eigen::Array4Xd scales_;
        std::vector<Place> nodes_;
    };

    /// Result of a look-up, in the units of the contact.
    struct Force {
        TangentialForce force;  ///< force on body 1 [N], moment about the contact's middle [N m]; NaN unless ok
        /// d force/d creepage: the exact derivative of the interpolation, as are the following.
        TangentialForce::ByCreepage tangent;
        TangentialForce tangent_by_load;                  ///< derivative at constant semi-axes [1], [m]
        TangentialForce tangent_by_friction_coefficient;  ///< [N], [N m]
        TangentialForce tangent_by_half_length;           ///< derivative at constant half-width [N/m], [N]
        TangentialForce tangent_by_half_width;            ///< derivative at constant half-length [N/m], [N]
        /// a/b lies on the table. If not, forces belong to its nearest ellipse with the same area: they are continuous,
        /// but their error is unknown.
        bool a_over_b_on_table = false;
        /// not_finite, invalid_load (mu or N is negative or not finite), or wrong_table
        Status status = Status::not_finite;
    };

    /// |X| mu N, the size of the linear forces that scale the lattice of a table (see Grid), in the units of
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
    CreepForceTable(Grid grid, const Eigen::Ref<const Eigen::Array3Xd>& forces);

    /// Reads the format of write(). The stream must be binary; it is read to the end of the table. Throws
    /// std::invalid_argument if the stream could not be opened, ends too early or holds something else, another
    /// version, or numbers that do not agree with their checksum.
    static CreepForceTable read(std::istream& stream);
    static CreepForceTable read(const std::filesystem::path& path);

    /// Little-endian, version 4: the text "rollbem creep forces", version, levels, number of ellipses (32 bits each),
    /// Poisson's ratio, smallest and largest a/b, c11, c22, c23, c32, c33 of each ellipse (64 bits each), coefficients
    /// of the splines (32 bits each), and the checksum FNV-1a of all bytes before (64 bits).
    void write(std::ostream& stream) const;

    const Grid& grid() const { return grid_; }
    /// Whether the table holds for this Poisson's ratio, to 0.01.
    bool fits(double poisson_ratio) const { return std::abs(poisson_ratio - grid_.poisson_ratio()) <= 0.01 + 1e-12; }

    /// The forces of an ellipse under the load N [N] with the coefficient of friction mu, in SI units. status is
    /// wrong_table if Poisson's ratio differs from the table's by more than 0.01, or for an outline. Without friction
    /// or load, or if mu N is below 1e-308 G a b, there is no force at rest and no tangent. Does not allocate.
    CreepForceTable::Force look_up(const PatchContact& contact, double friction_coefficient, double load,
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

    explicit CreepForceTable(Grid grid);

    Grid grid_;
    Eigen::Index n_;
    double first_log_, per_log_;  ///< log(a/b) of the first ellipse, and 1 over its distance from the last one's
    Eigen::ArrayXXd scales_;      ///< coefficients of splines in log(a/b)
    /// Derivatives of the splines where creepage vanishes (F_x by u_x, F_y by u_y and u_phi, M_z by u_y and u_phi), and
    /// c32 and c33, which correct them; coefficients of splines in log(a/b).
    Eigen::ArrayXXd at_rest_;
    std::vector<float, Eigen::aligned_allocator<float>> coefficients_;
};

/// Friction on wet, dirty or dry rails, after O. Polach, Creep forces in simulations of traction vehicles running on
/// adhesion limit, Wear 258 (2005) 992-1000.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto table = CreepForceTable::read("share/rollbem/steel.creep");
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const ReducedFriction wet({.adhesion_factor = 0.3, .slip_factor = 0.1, .friction_ratio = 0.4, .fall = 0.2});
///     const auto now = wet.look_up(table, contact, 0.3, 80e3, 20, {1e-3, 5e-4, 0.1});  // at 20 m/s
///     return now.status == Status::ok && now.friction_coefficient < 0.3 ? 0 : 1;
/// }
/// \endcode
///
/// His coefficient falls with the magnitude w [m/s] of the slip velocity,
///
///     mu(w) = mu_0 ((1 - A) exp(-B w) + A),    w = V sqrt(xi^2 + eta^2 + phi^2 (a^2 + b^2)/5),
///
/// and is the same all over the contact; here w is the root of the mean square of the rigid slip under Hertz's
/// pressure, which adds spin. His force for a gradient eps [-] of the tangential stress is mu N p(eps; k_A, k_S), with
///
///     p(eps; k_A, k_S) = 2/pi (k_A eps/(1 + (k_A eps)^2) + atan(k_S eps)).
///
/// Clean contacts have k_A = k_S = 1. Their slope at rest, 4/pi mu N, must be the linear law's, so that eps = pi/4 |X|
/// with |X| = saturation_parameter()/(mu N). All forces of the table, at mu(w), are multiplied by
///
///     r(eps) = p(eps; k_A, k_S)/p(eps; 1, 1).
///
/// So r scales the part of mu N by which a result differs from Polach's. At rest r = (k_A + k_S)/2, whatever mu is; in
/// full sliding r = 1 - 2/pi (1/k_S - 1/k_A)/eps, that is, forces rise to mu(w) N as slowly as his. A factor of the
/// creepages could not do this, because the table is in full sliding from a finite |X| on. As r <= 1, forces oppose
/// slip and remain within mu N wherever the table's forces do.
class ReducedFriction {
public:
    struct Parameters {
        double adhesion_factor = 1;  ///< k_A [-], of the area of adhesion
        double slip_factor = 1;      ///< k_S [-], of the area of slip, 0 < k_S <= k_A <= 1
        double friction_ratio = 1;   ///< A [-], mu at infinite slip velocity over mu_0, 0 to 1
        double fall = 0;             ///< B [s/m], not negative; ExponentialFall has v_half = log(2)/B, mu_k = A mu_0
    };

    /// Throws std::invalid_argument if a parameter is out of its bounds.
    explicit ReducedFriction(const Parameters& parameters);

    /// Result of a look-up. Tangents by creepage, load, a and b hold at constant speed and mu_0; the tangent by the
    /// friction coefficient is by mu_0. Status not_finite also if the speed is not finite, invalid_step if it is
    /// negative.
    struct Force : CreepForceTable::Force {
        TangentialForce tangent_by_speed;                                        ///< [N s/m], [N s]
        double friction_coefficient = std::numeric_limits<double>::quiet_NaN();  ///< mu(w) [-]
    };

    const Parameters& parameters() const { return p_; }

    /// Look-up as CreepForceTable::look_up, with mu_0 and the speed V [m/s] at which the wheel rolls. Exact tangents;
    /// allocates nothing.
    Force look_up(const CreepForceTable& table, const PatchContact& contact, double mu_0, double load, double speed,
                  const Creepage& creepage) const noexcept;

private:
    /// pi/2 p and its derivative by eps.
    struct Law {
        double value, slope;
    };
    static Law law(double eps, double k_A, double k_S) noexcept;

    Parameters p_;
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
