// Frictionless contact of two elastic half-spaces whose surfaces are a given distance apart: pressures on a grid of
// cells, by conjugate gradients with projection (Polonsky and Keer 1999).
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <optional>

#include <Eigen/Core>

#include "../detail/hidden.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

namespace detail {
class GridConvolution;
}  // namespace detail

/// Pressures p >= 0 and gaps w = h + u(p) - approach >= 0 with p w = 0 in each cell. Its memory is kept from one
/// solution to the next.
///
/// \code
/// #include <rollbem/profiles.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const NormalContact::Cells grid{.nx = 21, .ny = 21, .x_0 = -1e-2, .y_0 = -1e-2, .dx = 1e-3, .dy = 1e-3};
///     Eigen::ArrayXXd h(21, 21);  // a sphere of radius 0.5 m on a plane
///     for (Eigen::Index j = 0; j < 21; ++j) {
///         for (Eigen::Index i = 0; i < 21; ++i) h(i, j) = (std::pow(grid.x(i), 2) + std::pow(grid.y(j), 2)) / 2 / 0.5;
///     }
///     NormalContact contact(0.72 / 8.2e10);  // (1 - nu)/G
///     return contact.carry(grid, h, 80e3).status == Status::ok ? 0 : 1;
/// }
/// \endcode
class NormalContact {
public:
    /// Cells of size dx x dy [m] around centres x_0 + i dx, y_0 + j dy. Invariant: nx, ny >= 1; 0 < dx, dy < inf.
    struct Cells {
        Eigen::Index nx, ny;
        double x_0, y_0, dx, dy;

        double x(Eigen::Index i) const { return x_0 + double(i) * dx; }
        double y(Eigen::Index j) const { return y_0 + double(j) * dy; }
    };

    using Grid = Eigen::ArrayXXd;

    struct Solution {
        double load = 0;      ///< [N]
        double approach = 0;  ///< approach of the bodies from the position where h is the gap [m]
        double residual = 0;  ///< the largest |w| where there is pressure, over the approach from the least h
        int steps = 0;
        Status status = Status::not_finite;
    };

    /// 1/E* = (1-nu_1)/(2 G_1) + (1-nu_2)/(2 G_2) [1/Pa]; of equal bodies (1-nu)/G. Throws std::invalid_argument unless
    /// it is positive and finite.
    explicit NormalContact(double compliance);

    /// Solves for a load [N]. `h` [m] is the gap before deformation in each cell, nx x ny. Steps end when no gap under
    /// pressure exceeds `tolerance` times the approach from the least h. If `warm` is set, the present pressures, on
    /// any grid, are the first guess. Statuses other than ok:
    ///
    /// - not_converged;
    /// - no_contact, with all pressures 0: no load, or a load without a displacement in double precision;
    /// - not_finite, with all pressures 0: inputs are not finite, or results would not be.
    ///
    /// Throws std::invalid_argument unless h has the size of the grid, with at least one cell.
    Solution carry(const Cells& grid, const Grid& h, double load, double tolerance = 1e-6, bool warm = false) {
        return solve(grid, h, load, 0, tolerance, warm);
    }
    /// Solves for a given approach [m].
    Solution approach(const Cells& grid, const Grid& h, double approach, double tolerance = 1e-6, bool warm = false) {
        return solve(grid, h, std::nullopt, approach, tolerance, warm);
    }

    const Grid& pressure() const { return p_; }  ///< pressures of the last solution [Pa], nx x ny
    double compliance() const { return compliance_; }

private:
    Solution solve(const Cells& grid, const Grid& h, std::optional<double> load, double approach, double tolerance,
                   bool warm);
    void begin(const Cells& grid, bool by_load, bool warm, double unit);
    Solution iterate(bool by_load, double tolerance);

    const Solution& without(const Solution& none, const Cells& grid);

    // moves pressures from another grid, linear between the centres of its cells
    void move_to(const Cells& grid);

    // the mean over cells with pressure
    double mean(const Grid& of) const {
        return (p_ > 0).select(of, 0).sum() / double(std::max<Eigen::Index>((p_ > 0).count(), 1));
    }

    struct Step {
        bool grown = false, shrunk = false;  // changes of the set of cells in contact
    };
    // Pressures change by -tau t; cells under tension open, and cells that overlap come into contact.
    Step project(double tau);

    double compliance_;
    detail::Hidden<detail::GridConvolution> convolution_;
    Cells grid_{};  // grid of p_
    Grid p_, h_, u_, g_, t_, q_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/normal_contact.ipp"
#endif
