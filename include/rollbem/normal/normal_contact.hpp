// Frictionless contact of two elastic half-spaces whose surfaces are a given distance apart: pressures on a grid of
// cells, by conjugate gradients with projection (Polonsky and Keer 1999).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../status.hpp"
#include "../types.hpp"
#include "detail/grid_convolution.hpp"

namespace rollbem {

/// Cells of size dx x dy [m] around centres x_0 + i dx, y_0 + j dy.
struct CellGrid {
    Eigen::Index nx, ny;
    double x_0, y_0, dx, dy;

    double x(Eigen::Index i) const { return x_0 + double(i) * dx; }
    double y(Eigen::Index j) const { return y_0 + double(j) * dy; }
};

/// Pressures p >= 0 and gaps w = h + u(p) - approach >= 0 with p w = 0 in each cell. Its memory is kept from one
/// solution to the next.
class NormalContact {
public:
    using Grid = Eigen::ArrayXXd;

    struct Solution {
        double load = 0;      ///< [N]
        double approach = 0;  ///< of the bodies from where h is the gap [m]
        double residual = 0;  ///< the largest |w| where there is pressure, over the approach from the least h
        int steps = 0;
        Status status = Status::not_finite;
    };

    /// 1/E* = (1-nu_1)/(2 G_1) + (1-nu_2)/(2 G_2) [1/Pa]; of equal bodies (1-nu)/G.
    explicit NormalContact(double compliance) : compliance_(compliance) {}

    /// Carrying `load` [N]. `h` [m] is the gap before deformation in each cell, nx x ny; steps end when no gap where
    /// there is pressure exceeds `tolerance` times the approach from the least h. If `warm` is set, the present pressures, of
    /// whatever grid, are the first guess.
    Solution carry(const CellGrid& grid, const Grid& h, double load, double tolerance = 1e-6, bool warm = false) {
        return solve(grid, h, load, 0, tolerance, warm);
    }
    /// The same at a given approach [m].
    Solution approach(const CellGrid& grid, const Grid& h, double approach, double tolerance = 1e-6,
                      bool warm = false) {
        return solve(grid, h, std::nullopt, approach, tolerance, warm);
    }

    const Grid& pressure() const { return p_; }  ///< of the last solution [Pa], nx x ny
    double compliance() const { return compliance_; }

private:
    Solution solve(const CellGrid& grid, const Grid& h, std::optional<double> load, double approach, double tolerance,
                   bool warm);

    // pressures of another grid, linear between the centres of its cells
    void move_to(const CellGrid& grid) {
        const CellGrid from = std::exchange(grid_, grid);
        if (from.nx == grid.nx && from.ny == grid.ny && from.dx == grid.dx && from.dy == grid.dy) return;
        const Grid old = std::exchange(p_, Grid::Zero(grid.nx, grid.ny));
        for (Eigen::Index j = 0; j < grid.ny; ++j) {
            const double y = (grid.y(j) - from.y_0) / from.dy, v = y - std::floor(y);
            const auto l = static_cast<Eigen::Index>(std::floor(y));
            for (Eigen::Index i = 0; i < grid.nx; ++i) {
                const double x = (grid.x(i) - from.x_0) / from.dx, u = x - std::floor(x);
                const auto k = static_cast<Eigen::Index>(std::floor(x));
                if (k < 0 || k + 1 >= from.nx || l < 0 || l + 1 >= from.ny) continue;
                p_(i, j) = (1 - v) * ((1 - u) * old(k, l) + u * old(k + 1, l)) +
                           v * ((1 - u) * old(k, l + 1) + u * old(k + 1, l + 1));
            }
        }
    }

    // the mean over cells with pressure
    double mean(const Grid& of) const {
        return (p_ > 0).select(of, 0).sum() / double(std::max<Eigen::Index>((p_ > 0).count(), 1));
    }

    double compliance_;
    detail::GridConvolution convolution_;
    CellGrid grid_{};  // of p_
    Grid p_, u_, g_, t_, q_;
};

inline NormalContact::Solution NormalContact::solve(const CellGrid& grid, const Grid& h, std::optional<double> load,
                                                    double approach, double tolerance, bool warm) {
    Solution result;
    if (!h.allFinite() || !detail::is_finite(approach) || (load && !detail::is_finite(*load))) return result;
    const double least = h.minCoeff(), cell = grid.dx * grid.dy;
    result.status = Status::no_contact;
    if (load ? !(*load > 0) : !(approach > least)) {
        p_ = Grid::Zero(grid.nx, grid.ny);
        grid_ = grid;
        result.approach = approach;
        return result;
    }
    convolution_.prepare(grid.nx, grid.ny, grid.dx, grid.dy);
    if (warm && p_.size() > 0) move_to(grid);
    grid_ = grid;
    const double unit = compliance_ / std::numbers::pi;
    const auto displace = [&](const Grid& p, Grid& u) {
        convolution_.apply(p, u);
        u *= unit;
    };
    if (!warm || !(p_ > 0).any()) {
        // where surfaces overlap, like Hertz's pressure; with a load over all cells
        const double level = load ? h.maxCoeff() : approach;
        p_ = (level - h).cwiseMax(0).sqrt();
        if (!load)
            p_ *= std::sqrt(level - least) /
                  (compliance_ * 2 * std::sqrt(double((p_ > 0).count()) * cell / std::numbers::pi));
    }
    u_.resize(grid.nx, grid.ny);
    q_.resize(grid.nx, grid.ny);
    if (load) p_ *= *load / (p_.sum() * cell);
    t_ = Grid::Zero(grid.nx, grid.ny);
    double last = 1;
    bool grown = true, known = false;  // whether u_ is that of p_
    constexpr int most = 300;
    for (result.steps = 1; result.steps <= most; ++result.steps) {
        if (!known) displace(p_, u_);
        known = true;
        g_ = u_ + h;
        if (load) approach = mean(g_);
        g_ -= approach;
        const double square = (p_ > 0).select(g_.square(), 0).sum();
        const double worst = (p_ > 0).select(g_.abs(), 0).maxCoeff();
        const bool outside = ((p_ <= 0) && (g_ < -tolerance * (approach - least))).any();
        if (!detail::is_finite(square)) return {.status = Status::not_finite};
        result.residual = worst / (approach - least);
        if (worst <= tolerance * (approach - least) && !outside) {
            result.status = Status::ok;
            break;
        }
        const double beta = grown ? 0 : square / last;
        last = square;
        t_ = (p_ > 0).select(g_ + beta * t_, 0);
        displace(t_, q_);
        const double level = load ? mean(q_) : 0;
        const double bend = ((q_ - level) * t_).sum();
        const double tau = bend > 0 ? (g_ * t_).sum() / bend : 0;
        if (!(tau > 0)) {  // the direction is used up: from the gradient anew, unless it was that
            if (std::exchange(grown, true)) {
                result.status = Status::not_converged;
                break;
            }
            continue;
        }
        grown = false;
        for (Eigen::Index k = 0; k < p_.size(); ++k) {
            double& p = p_.data()[k];
            if (p > 0) {
                p -= tau * t_.data()[k];
                if (p > 0) continue;
                p = 0;
                known = false;
            } else if (g_.data()[k] < 0) {
                p = -tau * g_.data()[k];
                grown = true;
            }
        }
        known = known && !grown;  // displacements are linear in pressures while the same cells touch
        if (known) u_ -= tau * q_;
        if (load) {
            const double sum = p_.sum() * cell;
            if (!(sum > 0)) return {.status = Status::not_finite};
            p_ *= *load / sum;
            u_ *= *load / sum;
        }
        if (!(p_ > 0).any()) break;
    }
    if (result.status == Status::no_contact && result.steps > most) result.status = Status::not_converged;
    result.load = p_.sum() * cell;
    result.approach = approach;
    return result;
}

}  // namespace rollbem
