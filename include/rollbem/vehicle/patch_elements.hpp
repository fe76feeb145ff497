// The elements on which the patches of wheels on rails rub, and the pressures on them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../discretisation/mesh.hpp"
#include "../discretisation/patch_mesh.hpp"
#include "wheelset_on_track.hpp"

namespace rollbem {

/// Elements along x of each strip, and strips of a patch.
struct PatchElements {
    Eigen::Index along = 12, strips = 13;
};

namespace detail {

/// The width, in steps, of the narrowest lobe of a function over equal steps: of a parabola with the lobe's integral
/// and maximum. Lobes are parted by minima between two maxima; waves of less than a twentieth of the largest value are
/// no lobes. Infinite if there is only one.
inline double narrowest_lobe(const Eigen::ArrayXd& values) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const double wave = values.maxCoeff() / 20;
    double narrowest = infinite;
    Eigen::Index begin = 0, least = 0;
    double top = 0;
    bool falls = false;
    const auto width = [&](Eigen::Index end) { return 1.5 * values.segment(begin, end - begin).sum() / top; };
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        if (falls && values[k] > values[least] + wave) {
            narrowest = (std::min)(narrowest, width(least));
            begin = least;
            top = 0;
            falls = false;
        }
        if (!falls || values[k] < values[least]) least = k;
        top = (std::max)(top, values[k]);
        falls = falls || values[k] < top - wave;
    }
    return begin > 0 ? (std::min)(narrowest, width(values.size())) : infinite;
}

}  // namespace detail

/// The elements that a patch wants: 12 x 13, and where its outline or its pressures have several lobes across the
/// rolling direction, strips of less than a third of the narrowest, at most 25. The patch must have numbers.
inline PatchElements elements_for(const RailPatch& patch) {
    constexpr Eigen::Index lines = 240, most = 25;
    const Outline<double>& outline = *patch.outline;
    const double height = outline.high() - outline.low(), step = height / lines;
    Eigen::ArrayXd lengths(lines);
    for (Eigen::Index k = 0; k < lines; ++k) {
        const double s = outline.low() + (double(k) + 0.5) * step;
        lengths[k] = outline.leading(s) - outline.trailing(s);
    }
    const double lobe = (std::min)(detail::narrowest_lobe(lengths) * step,
                                   detail::narrowest_lobe(patch.pressure.colwise().sum()) * patch.grid.dy);
    PatchElements elements;
    // odd, so that a strip lies in the middle
    while (elements.strips < most && 3 * height >= double(elements.strips) * lobe) elements.strips += 2;
    return elements;
}

/// The outline's mesh for friction with NodeDifference{Nodes::chebyshev}.
inline PatchMesh<double> friction_mesh(const PatchContact<double>& contact, const PatchElements& elements) {
    return patch_mesh(contact, cosine_mesh(elements.along), uniform_mesh(elements.strips));
}

/// Calls solve(mesh) on the outline's mesh, then with two strips less each time, down to 5, until it returns true: on
/// some flanges rolling would gain energy on many strips. Returns whether it did.
template <class Solve>
bool with_fewer_strips(const PatchContact<double>& contact, PatchElements elements, const Solve& solve) {
    constexpr Eigen::Index least = 5;
    for (;; elements.strips -= 2) {
        if (solve(friction_mesh(contact, elements))) return true;
        if (elements.strips - 2 < least) return false;
    }
}

/// Mean pressures of a patch on elements [Pa], which together carry its load.
inline Eigen::ArrayXd pressures_on(const std::vector<Rectangle<double>>& elements, const RailPatch& patch) {
    Eigen::ArrayXd pressure = pressure_of(patch)(elements);
    double load = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
    }
    return patch.load / load * pressure;
}

}  // namespace rollbem
