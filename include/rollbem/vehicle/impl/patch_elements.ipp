// Bodies of vehicle/patch_elements.hpp. Internal.
#pragma once

#include "../patch_elements.hpp"

#include <algorithm>
#include <limits>

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

ROLLBEM_DECL PatchElements elements_for(const RailPatch& patch) {
    constexpr Eigen::Index lines = 240, most = 25;
    const Outline& outline = *patch.outline;
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

ROLLBEM_DECL std::vector<std::vector<std::size_t>> patches_by_plane(const std::vector<RailPatch>& patches) {
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

ROLLBEM_DECL Eigen::Index PatchMeshes::first(std::size_t k) const {
    Eigen::Index sum = 0;
    for (std::size_t before = 0; before < k; ++before) sum += patches[before].size();
    return sum;
}

ROLLBEM_DECL PatchMeshes friction_meshes(const std::vector<const RailPatch*>& patches,
                                         const std::vector<PatchElements>& elements, double unit) {
    PatchMeshes meshes{unit, {}};
    for (std::size_t k = 0; k < patches.size(); ++k) {
        meshes.patches.push_back(outline_mesh<double>(*patches[k]->outline, unit, cosine_mesh(elements[0].along),
                                                      uniform_mesh(elements[k].strips)));
    }
    return meshes;
}

ROLLBEM_DECL Eigen::ArrayXd pressures_on(const std::vector<Rectangle<double>>& elements, const RailPatch& patch) {
    Eigen::ArrayXd pressure = pressure_of(patch)(elements);
    double load = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
    }
    return patch.load / load * pressure;
}

}  // namespace rollbem
