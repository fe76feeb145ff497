// Whether the cells of a plane are small enough for its pressures.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

#include "../normal_contact.hpp"
#include "patch_shape.hpp"

namespace rollbem::detail {

/// How many times as many cells are needed in both directions: powers of 2.
struct MoreCells {
    Eigen::Index x = 1, s = 1;

    explicit operator bool() const { return x * s > 1; }
};

/// Twice as many cells where a patch that carries more than `negligible` [N] has too few for an outline, in the
/// direction with fewer of them.
inline MoreCells cells_for_outlines(const NormalContact::Cells& grid, const Eigen::ArrayXXd& pressure,
                                    double negligible) {
    for (const Eigen::ArrayXXd& patch : split_into_patches(pressure)) {
        const bool counts = patch.sum() * grid.dx * grid.dy > negligible;
        if (!counts || contact_outline(grid, patch)) continue;
        const Eigen::Index in_x = (patch > 0).rowwise().any().count(), in_s = (patch > 0).colwise().any().count();
        return {in_x <= in_s ? 2 : 1, in_s <= in_x ? 2 : 1};
    }
    return {};
}

/// Gaps and pressures on a line of cells, gaps also at equal parts of the distance of their centres.
struct WavesMissed {
    const Eigen::ArrayXd &h, &pressure;  ///< [m], [Pa]
    Eigen::Index parts;                  ///< a power of 2, at least 4
    double distance;                     ///< of centres [m]
    double compliance;                   ///< 1/E* [1/Pa]

    /// How many times as many cells miss nothing of the gaps that could raise the largest pressure by more than 5 %;
    /// at most parts/2, where a quarter of that is not enough.
    Eigen::Index times() const {
        for (Eigen::Index apart = parts; apart >= 4; apart /= 2) {
            if (!raise_peak(apart)) return parts / apart;
        }
        return parts / 2;
    }

private:
    // Whether centres so many parts apart miss such waves, by quarters of their distance. Waves of height A and length
    // L under full contact have pressures up to pi E* A/L; what gaps differ by from cubics through four centres is
    // taken for waves of twice the distance of centres.
    bool raise_peak(Eigen::Index apart) const {
        constexpr double by_pressure = 0.05;
        constexpr Eigen::Index quarters = 4;
        const double most = (1 + by_pressure) * pressure.maxCoeff(),
                     stiffness = std::numbers::pi / (2 * distance * compliance) * double(parts) / double(apart);
        for (Eigen::Index at = apart; at + 2 * apart < h.size(); at += apart) {
            const double here = pressure_at(at), next = pressure_at(at + apart);
            if (!(here > 0 && next > 0)) continue;
            for (Eigen::Index part = 1; part < quarters; ++part) {
                const double missed = h[at + part * apart / quarters] - cubic(at, apart, double(part) / quarters);
                if ((std::max)(here, next) + std::abs(missed) * stiffness > most) return true;
            }
        }
        return false;
    }

    double pressure_at(Eigen::Index at) const { return pressure[(at + parts / 2) / parts]; }

    // of the gaps at four centres, between the second and the third
    double cubic(Eigen::Index at, Eigen::Index apart, double t) const {
        const double a = h[at - apart], b = h[at], c = h[at + apart], d = h[at + 2 * apart];
        return ((t + 1) * (t - 1) * (t - 2) * b - (t + 1) * t * (t - 2) * c) / 2 + (t + 1) * t * (t - 1) * d / 6 -
               t * (t - 1) * (t - 2) * a / 6;
    }
};

/// Part of the pressures on larger cells whose centres lie on cells of a patch, or beside one.
inline Eigen::ArrayXXd part_below(const Eigen::ArrayXXd& patch, const Eigen::ArrayXXd& larger, Eigen::Index every_x,
                                  Eigen::Index every_s) {
    Eigen::ArrayXXd part = larger;
    for (Eigen::Index j = 0; j < larger.cols(); ++j) {
        for (Eigen::Index i = 0; i < larger.rows(); ++i) {
            const Eigen::Index left = (std::max)(i * every_x - 1, Eigen::Index(0)),
                               low = (std::max)(j * every_s - 1, Eigen::Index(0)),
                               right = (std::min)(i * every_x + 2, patch.rows()),
                               high = (std::min)(j * every_s + 2, patch.cols());
            if (!(patch.block(left, low, right - left, high - low) > 0).any()) part(i, j) = 0;
        }
    }
    return part;
}

/// The change of the pressures on cells `every_x` and `every_s` times as large, with the gaps `h` at their centres and
/// the same approach, over what is allowed: of the load, and of the largest pressures in all patches that carry more
/// than `counted` [N]. As errors fall with the size of cells, that of the load faster than in proportion, a change
/// below 1 means that halves of the present cells change the load by less than 0.5 % and the pressures by less than
/// 5 %.
inline double change_by_larger_cells(NormalContact& larger, const NormalContact::Cells& grid,
                                     const NormalContact::Grid& h, const NormalContact::Solution& solution,
                                     const Eigen::ArrayXXd& pressure, double compliance, double counted,
                                     Eigen::Index every_x, Eigen::Index every_s) {
    constexpr double by_load = 0.015, by_pressure = 0.06, tolerance = 1e-4;
    const NormalContact::Cells of{
        (grid.nx + every_x - 1) / every_x, (grid.ny + every_s - 1) / every_s, grid.x_0, grid.y_0,
        double(every_x) * grid.dx,         double(every_s) * grid.dy};
    NormalContact::Grid gaps(of.nx, of.ny);
    for (Eigen::Index j = 0; j < of.ny; ++j) {
        for (Eigen::Index i = 0; i < of.nx; ++i) gaps(i, j) = h(i * every_x, j * every_s);
    }
    const double load = larger.approach(of, gaps, solution.approach, tolerance).load / compliance;
    double change = std::abs(load / solution.load - 1) / by_load;
    for (const Eigen::ArrayXXd& patch : split_into_patches(pressure)) {
        if (patch.sum() * grid.dx * grid.dy < counted) continue;
        const double peak = peak_pressure(part_below(patch, larger.pressure(), every_x, every_s)) / compliance;
        change = (std::max)(change, std::abs(peak / peak_pressure(patch) - 1) / by_pressure);
    }
    return change;
}

}  // namespace rollbem::detail
