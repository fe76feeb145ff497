// A patch's mesh at another place.
#pragma once

#include <Eigen/Core>

#include <rollbem/discretisation/patch_mesh.hpp>

namespace support {

/// The strips moved by (x, y); mirrored ones are so no longer.
inline rollbem::PatchMesh<double> moved(const rollbem::PatchMesh<double>& mesh, double x, double y) {
    const Eigen::Index m = mesh.strip_count();
    Eigen::ArrayXd edges(m + 1);
    edges << mesh.lower(), mesh.upper()[m - 1];
    return rollbem::PatchMesh<double>(
        {mesh.along(), edges + y, mesh.middles_y() + y, mesh.middles_x() + x, mesh.half_lengths()});
}

}  // namespace support
