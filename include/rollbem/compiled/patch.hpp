// Contact patches of the half-space by node differences, compiled for double. Replaces steady/creep_coefficients.hpp,
// assembly/patch_shapes.hpp and assembly/patch_system.hpp; link rollbem::compiled.
#pragma once

#include <memory>
#include <vector>

#include "../assembly/patch_shapes.hpp"
#include "../steady/creep_coefficients.hpp"
#include "steady.hpp"

namespace rollbem {

extern template class PatchMesh<double>;
extern template PatchMesh<double> patch_mesh<double>(const PatchContact&, Mesh<double>, const Mesh<double>&);
extern template PatchMesh<double> ellipse_mesh<double>(double, Mesh<double>, const Mesh<double>&);
extern template Elements<double> patch_elements<double, NodeDifference>(const PatchMesh<double>&,
                                                                        const NodeDifference&);
extern template detail::InfluenceRows<double> detail::patch_rows<double, HalfSpace<double>>(
    const PatchMesh<double>&, const detail::StripRows<double>&, const HalfSpace<double>&, Quantity, bool);
extern template ElementSystem<double, 2>::Blocks assemble_G_prime<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
extern template ElementSystem<double, 2> rolling_system<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
extern template std::vector<RollingSystem<double>> patch_subsystems<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
extern template detail::ShapeNode<double> detail::shape_node<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&, double, bool);
extern template ElementSystem<double, 2> breathing_system<double, NodeDifference, HalfSpace<double>>(
    const PatchContact&, const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
extern template ElementSystem<double, 2> detail::system_of<double>(std::shared_ptr<const detail::ShapeSet<double>>,
                                                                   Elements<double>, double);
extern template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchMesh<double>&,
                                                                                         const NodeDifference&,
                                                                                         const HalfSpace<double>&);
extern template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchContact&,
                                                                                         const PatchMesh<double>&,
                                                                                         const NodeDifference&,
                                                                                         const HalfSpace<double>&);

}  // namespace rollbem
