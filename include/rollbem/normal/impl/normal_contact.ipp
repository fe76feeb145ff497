// Bodies of normal/normal_contact.hpp. Internal.
#pragma once

#include "../normal_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/grid_convolution.hpp"

namespace rollbem {

ROLLBEM_DECL NormalContact::NormalContact(double compliance) : compliance_(compliance) {
    detail::require_positive("NormalContact", "compliance", compliance);
}

ROLLBEM_DECL auto NormalContact::without(const Solution& none, const NormalContact::Cells& grid) -> const Solution& {
    p_ = Grid::Zero(grid.nx, grid.ny);
    grid_ = grid;
    return none;
}

ROLLBEM_DECL void NormalContact::move_to(const NormalContact::Cells& grid) {
    const NormalContact::Cells from = std::exchange(grid_, grid);
    if (from.nx == grid.nx && from.ny == grid.ny && from.dx == grid.dx && from.dy == grid.dy) return;
    const Grid old = std::exchange(p_, Grid::Zero(grid.nx, grid.ny));
    const auto inside = [](double at, Eigen::Index count) { return at >= 0 && at < double(count - 1); };
    for (Eigen::Index j = 0; j < grid.ny; ++j) {
        const double y = (grid.y(j) - from.y_0) / from.dy, v = y - std::floor(y);
        if (!inside(y, from.ny)) continue;
        const auto l = static_cast<Eigen::Index>(y);
        for (Eigen::Index i = 0; i < grid.nx; ++i) {
            const double x = (grid.x(i) - from.x_0) / from.dx, u = x - std::floor(x);
            if (!inside(x, from.nx)) continue;
            const auto k = static_cast<Eigen::Index>(x);
            p_(i, j) = (1 - v) * ((1 - u) * old(k, l) + u * old(k + 1, l)) +
                       v * ((1 - u) * old(k, l + 1) + u * old(k + 1, l + 1));
        }
    }
}

ROLLBEM_DECL auto NormalContact::project(double tau) -> Step {
    Step step;
    for (Eigen::Index k = 0; k < p_.size(); ++k) {
        double& p = p_.data()[k];
        if (p > 0) {
            p -= tau * t_.data()[k];
            if (p > 0) continue;
            p = 0;
            step.shrunk = true;
        } else if (g_.data()[k] < 0) {
            p = -tau * g_.data()[k];
            step.grown = true;
        }
    }
    return step;
}

ROLLBEM_DECL NormalContact::Solution NormalContact::solve(const NormalContact::Cells& grid, const Grid& h,
                                                          std::optional<double> load, double approach, double tolerance,
                                                          bool warm) {
    detail::require(h.rows() == grid.nx && h.cols() == grid.ny && h.size() > 0, "NormalContact", "number of gaps",
                    h.size(), "be the number of the grid's cells, and positive");
    const bool finite = detail::all_finite(h) && detail::is_finite(load.value_or(approach)) &&
                        detail::is_finite(grid.x_0) && detail::is_finite(grid.y_0);
    if (!finite || !(grid.dx > 0 && grid.dy > 0)) return without({}, grid);
    const double least = h.minCoeff(), cell = grid.dx * grid.dy;
    const auto vanishes = [](double x) { return !(x >= (std::numeric_limits<double>::min)()); };
    Solution none;
    none.approach = approach;
    none.status = Status::no_contact;
    if (vanishes(load ? *load : approach - least)) return without(none, grid);
    // Units in which one cell that carries the load, or reaches the approach, has a pressure and a displacement of 1:
    // the contact has no larger approach, so that gaps above it do not close.
    convolution_.made().prepare(grid.nx, grid.ny, 1, grid.dy / grid.dx);
    const double softness = compliance_ / std::numbers::pi * grid.dx * convolution_.made().own();
    const double pressure = load ? *load / cell : (approach - least) / softness;
    const double length = load ? softness * pressure : approach - least;
    if (!detail::is_finite(pressure) || !detail::is_finite(length)) return without({}, grid);
    if (vanishes(pressure) || vanishes(length)) return without(none, grid);
    h_ = ((h - least) / length).cwiseMin(2);
    begin(grid, load.has_value(), warm, pressure);
    Solution result = iterate(load.has_value(), tolerance);
    p_ *= pressure;
    result.load = p_.sum() * cell;
    result.approach = load ? least + result.approach * length : approach;
    const bool numbers = detail::is_finite(result.load) && detail::is_finite(result.approach);
    if (result.status == Status::not_finite || !numbers) return without({}, grid);
    return vanishes(result.load) ? without(none, grid) : result;
}

// The first guess, in units of `unit`.
ROLLBEM_DECL void NormalContact::begin(const NormalContact::Cells& grid, bool by_load, bool warm, double unit) {
    if (warm && p_.size() > 0) {
        move_to(grid);
        p_ /= by_load ? p_.maxCoeff() : unit;
    }
    grid_ = grid;
    if (!warm || p_.size() == 0 || !detail::all_finite(p_) || !(p_ > 0).any()) {
        // like Hertz's pressure where surfaces overlap; with a load, over all cells, and uniform on a plane gap
        const double most = h_.maxCoeff(), level = by_load && most > 0 ? (std::min)(most, 1.0) : 1;
        p_ = (level - h_).cwiseMax(0).sqrt();
        const double area = double((p_ > 0).count()) * grid.dy / grid.dx;
        if (!by_load) p_ *= convolution_.made().own() / (2 * std::sqrt(std::numbers::pi * area));
    }
    if (by_load) p_ /= p_.sum();
}

// Conjugate gradients with projection from the first guess. Units: the load of a cell, or the approach, is 1; the
// approach of the result is in the unit of length.
ROLLBEM_DECL NormalContact::Solution NormalContact::iterate(bool by_load, double tolerance) {
    Solution result;
    const auto displace = [&](const Grid& p, Grid& u) {
        u.resize(p.rows(), p.cols());
        convolution_.made().apply(p, u);
        u *= 1 / convolution_.made().own();
    };
    t_ = Grid::Zero(p_.rows(), p_.cols());
    double last = 1;
    bool grown = true, known = false;  // known: whether u_ belongs to p_
    constexpr int most = 300;
    result.status = Status::not_converged;
    for (result.steps = 1; result.steps <= most; ++result.steps) {
        if (!known) displace(p_, u_);
        known = true;
        g_ = u_ + h_;
        result.approach = by_load ? mean(g_) : 1;
        g_ -= result.approach;
        const double square = (p_ > 0).select(g_.square(), 0).sum();
        const double least = tolerance * result.approach;
        const bool outside = ((p_ <= 0) && (g_ < -least)).any();
        if (!detail::is_finite(square)) return {.status = Status::not_finite};
        result.residual = (p_ > 0).select(g_.abs(), 0).maxCoeff() / result.approach;
        if (result.residual <= tolerance && !outside) {
            result.status = Status::ok;
            break;
        }
        const double beta = grown ? 0 : square / last;
        last = square;
        t_ = (p_ > 0).select(g_ + beta * t_, 0);
        displace(t_, q_);
        const double level = by_load ? mean(q_) : 0;
        const double bend = ((q_ - level) * t_).sum();
        double tau = bend > 0 ? (g_ * t_).sum() / bend : 0;
        if (!(tau > 0)) {
            // the direction is used up: restart from the gradient, then correct each overlapping cell by itself
            if (!std::exchange(grown, true)) continue;
            if (!outside) break;
            t_.setZero();
            tau = 1;
        }
        const Step step = project(tau);
        grown = step.grown;
        known = !step.grown && !step.shrunk;  // displacements are linear in pressures while the set of cells in contact
                                              // does not change
        if (known) u_ -= tau * q_;
        if (by_load) {
            const double sum = p_.sum();
            if (!(sum > 0)) return {.status = Status::not_finite};
            p_ /= sum;
            u_ /= sum;
        }
        if (!(p_ > 0).any()) break;
    }
    return result;
}

}  // namespace rollbem
