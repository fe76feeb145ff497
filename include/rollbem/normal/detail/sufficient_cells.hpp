// Whether the cells of a plane are small enough for its pressures.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "patch_shape.hpp"
#include "plane_patches.hpp"

namespace rollbem::detail {

/// What cells must resolve: the largest pressure [Pa], the load [N] and the largest depth [m] of a plane.
struct Measures {
    double peak_pressure = 0, load = 0, approach = 0;

    /// Whether finer cells changed the pressure by less than 5 %, the load and the depth by less than 0.5 %.
    bool settled_since(const Measures& before) const {
        const auto near = [](double now, double then, double share) { return std::abs(now - then) < share * then; };
        return near(peak_pressure, before.peak_pressure, 0.05) && near(load, before.load, 0.005) &&
               near(approach, before.approach, 0.005);
    }
};

inline Measures measures_of(const PlanePressures& of) {
    return {peak_pressure(of.pressure), of.pressure.sum() * of.grid.dx * of.grid.dy,
            of.lower + largest_depth(of.gaps.h, of.pressure)};
}

/// Directions in which pressures need smaller cells, and whether a patch has too few for its outline.
struct TooFewCells {
    bool along = false, across = false, for_outline = false;
};

/// Looks for peaks that are no parabolas in the squares of the pressures over the neighbouring cells, and for pressures
/// that bend from cell to cell. The limits are those below which halves of the cells change the measures by less than
/// Measures demands. Patches that carry less than `negligible` [N] may have too few.
inline TooFewCells too_few_cells(const CellGrid& grid, const Eigen::ArrayXXd& p, double negligible) {
    constexpr double sharpest = 0.15, most_bent = 0.0105;
    const auto at = [&](Eigen::Index i, Eigen::Index j) {
        return i < 0 || j < 0 || i >= p.rows() || j >= p.cols() ? 0 : p(i, j);
    };
    TooFewCells few;
    for (const Eigen::ArrayXXd& patch : split_into_patches(p)) {
        const double sum = patch.sum(), load = sum * grid.dx * grid.dy;
        if (load < negligible) continue;
        if (!contact_outline(grid, patch)) few = {true, true, true};
        Eigen::Index i = 0, j = 0;
        const double peak = patch.maxCoeff(&i, &j);
        const auto sharp = [&](double before, double after) {
            return 2 * peak * peak - before * before - after * after > 2 * sharpest * peak * peak;
        };
        double bent_along = 0, bent_across = 0;
        for (Eigen::Index l = 0; l < p.cols(); ++l) {
            for (Eigen::Index k = 0; k < p.rows(); ++k) {
                if (!(patch(k, l) > 0)) continue;
                bent_along += std::abs(at(k - 1, l) - 2 * p(k, l) + at(k + 1, l));
                bent_across += std::abs(at(k, l - 1) - 2 * p(k, l) + at(k, l + 1));
            }
        }
        // 1/24 of the second differences is what the mean over a cell differs from the value at its centre
        few.along = few.along || sharp(at(i - 1, j), at(i + 1, j)) || bent_along > 24 * most_bent * sum;
        few.across = few.across || sharp(at(i, j - 1), at(i, j + 1)) || bent_across > 24 * most_bent * sum;
    }
    return few;
}

}  // namespace rollbem::detail
