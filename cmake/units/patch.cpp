// Templates of patches: systems and steady rolling between half-spaces.
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/elasticity/impl/subsurface_stress.ipp>
#include <rollbem/steady/creep_coefficients.hpp>

namespace rollbem {
template class PatchMesh<double>;
template PatchMesh<double> patch_mesh<double>(const PatchContact&, Mesh<double>, const Mesh<double>&);
template PatchMesh<double> ellipse_mesh<double>(double, Mesh<double>, const Mesh<double>&);
template detail::InfluenceRows<double> detail::patch_rows<double, HalfSpace<double>>(const PatchMesh<double>&,
                                                                                     const detail::StripRows<double>&,
                                                                                     const HalfSpace<double>&, Quantity,
                                                                                     bool);
template Elements<double> patch_elements<double, NodeDifference>(const PatchMesh<double>&, const NodeDifference&);
template ElementSystem<double, 2>::Blocks assemble_G_prime<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
template ElementSystem<double, 2> rolling_system<double, NodeDifference, HalfSpace<double>>(const PatchMesh<double>&,
                                                                                            const NodeDifference&,
                                                                                            const HalfSpace<double>&);
template std::vector<RollingSystem<double>> patch_subsystems<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&);
template detail::ShapeNode<double> detail::shape_node<double, NodeDifference, HalfSpace<double>>(
    const PatchMesh<double>&, const NodeDifference&, const HalfSpace<double>&, double, bool);
template ElementSystem<double, 2> breathing_system<double, NodeDifference, HalfSpace<double>>(const PatchContact&,
                                                                                              const PatchMesh<double>&,
                                                                                              const NodeDifference&,
                                                                                              const HalfSpace<double>&);
template ElementSystem<double, 2> detail::system_of<double>(std::shared_ptr<const detail::ShapeSet<double>>,
                                                            Elements<double>, double);
template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchMesh<double>&,
                                                                                  const NodeDifference&,
                                                                                  const HalfSpace<double>&);
template Response<double> solve_steady<double, NodeDifference, HalfSpace<double>>(const PatchContact&,
                                                                                  const PatchMesh<double>&,
                                                                                  const NodeDifference&,
                                                                                  const HalfSpace<double>&);
}  // namespace rollbem
