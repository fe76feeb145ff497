// The elements on which friction on wheel-rail patches is solved, and the pressures on them. Internal.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../discretisation/mesh.hpp"
#include "../../discretisation/patch_mesh.hpp"
#include "../wheelset_on_track.hpp"

namespace rollbem {

/// Elements along x of each strip, and strips of a patch.
struct PatchElements {
    Eigen::Index along = 12, strips = 13;
};

/// Number of elements for a patch: 12 x 13. If its outline or its pressures have several lobes across the rolling
/// direction, strips are narrower than a third of the narrowest lobe, at most 25. The patch must have numbers.
inline PatchElements elements_for(const RailPatch& patch);

/// Indices of a wheel's patches, grouped by plane: those of one contact, each of which displaces the surface below the
/// others. Patches without an outline are left out.
inline std::vector<std::vector<std::size_t>> patches_by_plane(const std::vector<RailPatch>& patches);

/// The patches of one plane as one mesh for friction with NodeDifference{Nodes::chebyshev}.
struct PatchMeshes {
    double unit;                             ///< unit of length [m]: half_length() of the first patch's contact
    std::vector<PatchMesh<double>> patches;  ///< meshes in the order of the patches

    /// Index of the first element of patch k in joined(), and number of its elements.
    Eigen::Index first(std::size_t k) const;
    Eigen::Index size(std::size_t k) const { return patches[k].size(); }
    PatchMesh<double> joined() const { return PatchMesh<double>::joined(patches); }
};

/// Calls solve(elements) with the elements of each patch until it returns true, each time with two strips less in
/// patches with more than 6: on some flanges rolling would gain energy on many strips. Returns whether a call returned
/// true.
template <class Solve>
bool with_fewer_strips(std::vector<PatchElements> elements, const Solve& solve) {
    constexpr Eigen::Index least = 5;
    while (true) {
        if (solve(elements)) return true;
        bool fewer = false;
        for (PatchElements& patch : elements) {
            if (patch.strips - 2 < least) continue;
            patch.strips -= 2;
            fewer = true;
        }
        if (!fewer) return false;
    }
}

/// Meshes of outlines in one plane. All have the same number of elements along x as the first one.
inline PatchMeshes friction_meshes(const std::vector<const RailPatch*>& patches,
                                   const std::vector<PatchElements>& elements, double unit);

/// Mean pressures of a patch on elements [Pa], which together carry its load.
inline Eigen::ArrayXd pressures_on(const std::vector<PatchMesh<double>::Rectangle>& elements, const RailPatch& patch);

}  // namespace rollbem

namespace rollbem::detail {

/// The width of the narrowest lobe of a function over equal steps, in steps: the width of a parabola with the lobe's
/// integral and maximum. Lobes are separated by minima between two maxima; waves smaller than a twentieth of the
/// largest value are not lobes. Infinite if there is only one lobe.
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

}  // namespace rollbem::detail

namespace rollbem {

inline PatchElements elements_for(const RailPatch& patch) {
    constexpr Eigen::Index lines = 240, most = 25;
    const PatchContact::Outline& outline = *patch.outline;
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

inline std::vector<std::vector<std::size_t>> patches_by_plane(const std::vector<RailPatch>& patches) {
    std::vector<std::vector<std::size_t>> planes;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const RailPatch& patch = patches[k];
        if (!patch.outline) continue;
        const auto place = std::find_if(planes.begin(), planes.end(), [&](const auto& plane) {
            const RailPatch& other = patches[plane[0]];
            return other.x == patch.x && other.y == patch.y && other.z == patch.z && other.angle == patch.angle;
        });
        if (place == planes.end()) {
            planes.push_back({k});
        } else {
            place->push_back(k);
        }
    }
    return planes;
}

inline Eigen::Index PatchMeshes::first(std::size_t k) const {
    Eigen::Index sum = 0;
    for (std::size_t before = 0; before < k; ++before) sum += patches[before].size();
    return sum;
}

inline PatchMeshes friction_meshes(const std::vector<const RailPatch*>& patches,
                                   const std::vector<PatchElements>& elements, double unit) {
    PatchMeshes meshes{unit, {}};
    for (std::size_t k = 0; k < patches.size(); ++k) {
        meshes.patches.push_back(outline_mesh<double>(*patches[k]->outline, unit, cosine_mesh(elements[0].along),
                                                      uniform_mesh(elements[k].strips)));
    }
    return meshes;
}

inline Eigen::ArrayXd pressures_on(const std::vector<PatchMesh<double>::Rectangle>& elements, const RailPatch& patch) {
    Eigen::ArrayXd pressure = pressure_of(patch)(elements);
    double load = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
    }
    return patch.load / load * pressure;
}

}  // namespace rollbem
