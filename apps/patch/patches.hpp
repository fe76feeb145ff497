// The patches that the options of patch_study ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/scene/patch_contact.hpp>

#include "support/csv.hpp"
#include "support/options.hpp"

namespace patch {

/// One contact patch and its mesh.
struct Patch {
    rollbem::PatchContact<double> contact;  ///< a = G = 1; an outline in its own unit of length
    rollbem::PatchMesh<double> mesh;
    rollbem::Mesh<double> across;  ///< that cuts it into strips
    rollbem::NodeDifference scheme;

    std::string label() const;  ///< for the progress line
    rollbem::HalfSpace<double> kernel() const { return rollbem::HalfSpace<double>(contact.poisson_ratio()); }
};

/// Declares --a-over-b, --outline, --strips, --strip-edges and --strip-grading, and says what the common options mean
/// here.
void add_options(study::Options& options);

/// All patches: n is the outermost loop, then the number of strips, a/b and Poisson's ratio. Throws BadInput.
std::vector<Patch> make_patches(const study::Options& options);

/// The first columns of every table; nodes stands behind them.
inline constexpr const char* identity = "a_over_b, poisson, n, strips";

/// The cell of one of them, or of nodes.
study::Cell scene_cell(const Patch& patch, const std::string& column);

}  // namespace patch
