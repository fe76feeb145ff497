// The grid of a table of steady creep forces: the ellipses, creepages and spins at which forces must be known.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "../scene/creep_coefficients.hpp"
#include "../scene/creepage.hpp"

namespace rollbem {

/// Ellipses of a/b in steps of a constant factor, and for each of them nodes in the space of creepage and spin. X are
/// the forces of the linear law over the forces that friction allows,
///
///     X = (c11 xi, c22 eta + c23 phi c, s phi c) G a b/(mu N),   s = sqrt(c11 c22).
///
/// The pole of the spin crosses the edges of a sliding contact, where the moment turns sharply, at y = +-b where
/// X_3/X_1 = s c/(c11 b), at x = +-a where (X_2 - c23 X_3/s)/X_3 = c22 a/(s c): this s makes both the same, so that
/// neither edge lies within few nodes on any ellipse. Forces reach full sliding at |X| = 1 to 3; the lateral force of
/// spin on long ellipses bends sharply at |X| = 1. Nodes lie on a cubic lattice of
///
///     u = X/(1.4 + |X|),
///
/// where |u| = 1 is full sliding, at infinite creepage. By symmetry xi >= 0 and phi >= 0 suffice: xi and F_x change
/// sign alone, and so do eta, phi, F_y and M_z together.
///
/// Invariant: 0 <= nu <= 0.5; 0 < smallest a/b < largest a/b < inf; shapes() >= 4; 4 <= levels() <= 64;
/// c11, c22, c23, -c32, c33 > 0; (levels + 3)^2 (2 levels + 3) (shapes + 2) <= 1e7.
class CreepForceGrid {
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
    CreepForceGrid(double poisson_ratio, double smallest_a_over_b, double largest_a_over_b, int levels,
                   std::vector<CreepCoefficients<double>> coefficients);

    double poisson_ratio() const { return nu_; }
    double smallest_a_over_b() const { return smallest_; }
    double largest_a_over_b() const { return largest_; }
    int levels() const { return levels_; }
    Eigen::Index shapes() const { return static_cast<Eigen::Index>(coefficients_.size()); }  ///< number of ellipses
    Eigen::Index nodes() const { return static_cast<Eigen::Index>(nodes_.size()); }  ///< number of nodes of an ellipse
    const std::vector<CreepCoefficients<double>>& coefficients() const { return coefficients_; }
    /// dX_1/d xi, dX_2/d eta, dX_2/d(phi c), dX_3/d(phi c), over G a b/(mu N), in a column for each ellipse.
    const Eigen::Array4Xd& scales() const { return scales_; }

    /// a/b of ellipse i; the last is the largest.
    double a_over_b(Eigen::Index i) const { return a_over_b_of(i, shapes(), smallest_, largest_); }
    static double a_over_b_of(Eigen::Index i, Eigen::Index shapes, double smallest, double largest) {
        if (i == shapes - 1) return largest;
        return smallest * std::pow(largest / smallest, static_cast<double>(i) / static_cast<double>(shapes - 1));
    }

    /// Creepages times G a b/(mu N) and spin times G a b c/(mu N) at a node of ellipse i. The nodes form lines along
    /// which the spin grows.
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
        const Place &place = nodes_[static_cast<std::size_t>(node)], &last = nodes_[static_cast<std::size_t>(node - 1)];
        return place.x != last.x || place.y != last.y;
    }

    /// Nodes of one ellipse with the same xi, from `first` to before `last`: their forces do not depend on other nodes.
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
    static constexpr const char* name = "CreepForceGrid";

    double nu_, smallest_, largest_;
    int levels_;
    std::vector<CreepCoefficients<double>> coefficients_;
    Eigen::Array4Xd scales_;
    std::vector<Place> nodes_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/creep_force_grid.ipp"
#endif
