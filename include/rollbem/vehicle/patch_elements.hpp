// The elements on which friction on wheel-rail patches is solved, and the pressures on them.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
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

/// Number of elements for a patch: 12 x 13. If its outline or its pressures have several lobes across the rolling
/// direction, strips are narrower than a third of the narrowest lobe, at most 25. The patch must have numbers.
PatchElements elements_for(const RailPatch& patch);

/// Indices of a wheel's patches, grouped by plane: pieces of one contact, each of which displaces the surface below the
/// others. Patches without an outline are left out.
std::vector<std::vector<std::size_t>> pieces_of_planes(const std::vector<RailPatch>& patches);

/// The pieces of one plane as one mesh for friction with NodeDifference{Nodes::chebyshev}.
struct PieceMeshes {
    double unit;                            ///< unit of length [m]: half_length() of the first piece's contact
    std::vector<PatchMesh<double>> pieces;  ///< meshes in the order of the patches

    /// Index of the first element of piece k in joined(), and number of its elements.
    Eigen::Index first(std::size_t k) const;
    Eigen::Index size(std::size_t k) const { return pieces[k].size(); }
    PatchMesh<double> joined() const { return PatchMesh<double>::joined(pieces); }
};

/// Calls solve(elements) with the elements of each piece until it returns true, each time with two strips less in
/// pieces with more than 6: on some flanges rolling would gain energy on many strips. Returns whether a call returned
/// true.
template <class Solve>
bool with_fewer_strips(std::vector<PatchElements> elements, const Solve& solve) {
    constexpr Eigen::Index least = 5;
    while (true) {
        if (solve(elements)) return true;
        bool fewer = false;
        for (PatchElements& piece : elements) {
            if (piece.strips - 2 < least) continue;
            piece.strips -= 2;
            fewer = true;
        }
        if (!fewer) return false;
    }
}

/// Meshes of outlines in one plane. All have the same number of elements along x as the first one.
PieceMeshes friction_meshes(const std::vector<const RailPatch*>& pieces, const std::vector<PatchElements>& elements,
                            double unit);

/// Mean pressures of a patch on elements [Pa], which together carry its load.
Eigen::ArrayXd pressures_on(const std::vector<Rectangle<double>>& elements, const RailPatch& patch);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/patch_elements.ipp"
#endif
