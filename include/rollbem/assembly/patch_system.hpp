// The system of a contact patch: G and G' between all its elements, its uncoupled subsystems where strips at y and -y
// are mirror images, and patches that change their size and shape in time.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "../discretisation/patch_mesh.hpp"
#include "../discretisation/scheme.hpp"
#include "../elasticity/patch_kernel.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/detail/shape_set.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"
#include "detail/patch_blocks.hpp"
#include "rolling_system.hpp"

namespace rollbem {

/// The coordinates of the elements of a patch and of their equations. Each strip has the scheme, stretched to the
/// strip's length. Throws std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme>
Elements<Scalar> patch_elements(const PatchMesh<Scalar>& mesh, const Scheme& scheme);

/// The blocks of G' in units of 1/G. Throws std::invalid_argument unless the scheme takes differences of u and fits the
/// strips' mesh.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
typename ElementSystem<Scalar, 2>::Blocks assemble_G_prime(const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                                           const Kernel& kernel) {
    return detail::patch_blocks(mesh, scheme, kernel, Quantity::slope);
}

/// G' alone, for steady friction. Throws std::invalid_argument as rolling_system.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> steady_system(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel) {
    return detail::system_of<Scalar>(mesh, scheme, {}, assemble_G_prime(mesh, scheme, kernel));
}

/// Assembles both matrices, in the units of the mesh. Throws std::invalid_argument unless the scheme takes
/// differences of u and fits the strips' mesh, and all entries are finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> rolling_system(const PatchMesh<Scalar>& mesh, const Scheme& scheme, const Kernel& kernel);

/// A patch as uncoupled subsystems for linear problems. If the strips are mirrored, there are two, xi; eta and phi,
/// each with N = n m unknowns (the tractions p_x, then p_y, of the strips at y <= 0); otherwise one. Throws
/// std::invalid_argument unless the scheme takes differences of u and fits the strips' mesh, and all entries are
/// finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
std::vector<RollingSystem<Scalar>> patch_subsystems(const PatchMesh<Scalar>& mesh, const Scheme& scheme,
                                                    const Kernel& kernel);

/// The system of a patch that may change its size but not its shape: a(t)/b(t) remains the contact's a/b (ellipses), or
/// the outline grows evenly about its origin. Its mesh follows. Throws std::invalid_argument unless the scheme takes
/// differences of u and fits the strips' mesh, and all entries are finite.
template <class Scalar, RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
ElementSystem<Scalar, 2> breathing_system(const PatchContact& contact, const PatchMesh<Scalar>& mesh,
                                          const Scheme& scheme, const Kernel& kernel);

/// Ellipses of every a/b in a range, for steps in which an ellipse changes its size and its shape, and for steady
/// rolling of any of them. Systems at nodes a constant factor in a/b apart are made once; between the nodes entries are
/// interpolated over ln(a/b) by cubics. Copies share the systems. Immutable: threads may share it.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const PatchMesh<double> mesh = patch_mesh(contact, 6, 6);
///     const PatchShapes<double> shapes(6, 6, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(0.28));
///     const FrictionModel model(contact, shapes.system(contact.a_over_b()), unchecked,
///                               {0.3, hertz_pressures(contact, mesh, 80e3)});
///     Run run(model);
///     NormalLoad load;  // at the end of a step, with any semi-axes
///     load.normal_pressure = hertz_pressures(contact, mesh, 80e3);
///     load.half_length = 6.1e-3;
///     load.half_width = 4.05e-3;
///     return run.advance({1e-3, Creepage{1e-3}, load}).status == Status::ok ? 0 : 1;
/// }
/// \endcode
template <class Scalar_ = double>
class PatchShapes {
public:
    using Scalar = Scalar_;

    struct Range {
        Scalar least = Scalar(0.1), largest = 10;  ///< a/b
        /// Largest factor from node to node; a smaller one interpolates creep coefficients more exactly
        /// (docs/measured.md).
        Scalar factor = Scalar(1.25);
    };

    /// Cosine meshes of n elements a strip and m strips. Throws std::invalid_argument unless
    /// 0 < least < largest < inf and 1 < factor <= 2, the scheme takes differences of u and fits the strips' mesh, and
    /// all entries are finite.
    template <RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
    PatchShapes(Eigen::Index n, Eigen::Index m, const Scheme& scheme, const Kernel& kernel, const Range& range = {})
        : PatchShapes(cosine_mesh<Scalar>(n), cosine_mesh<Scalar>(m), scheme, kernel, range) {}

    /// Takes any mesh along each strip, and across them.
    template <RollingScheme<Scalar> Scheme, RectangleKernel Kernel>
    PatchShapes(const Mesh<Scalar>& along, const Mesh<Scalar>& across, const Scheme& scheme, const Kernel& kernel,
                const Range& range = {});

    Eigen::Index size() const { return circle_.size(); }  ///< number of elements
    std::size_t node_count() const { return set_->nodes.size(); }
    /// Memory of the matrices [bytes].
    std::size_t memory() const { return node_count() * 9 * static_cast<std::size_t>(size() * size()) * sizeof(Scalar); }
    bool covers(Scalar a_over_b) const noexcept { return set_->covers(a_over_b); }

    /// The system of one a/b, which may change to any other in the range. Throws std::invalid_argument unless the range
    /// covers it.
    ElementSystem<Scalar, 2> system(std::type_identity_t<Scalar> a_over_b) const;

    /// The system at a node as uncoupled subsystems, see patch_subsystems.
    std::vector<RollingSystem<Scalar>> subsystems(std::size_t node) const;

private:
    // Elements at semi-axes 1 and 1/a_over_b.
    Elements<Scalar> elements(Scalar a_over_b) const {
        Elements<Scalar> elements = circle_;
        for (ArrayX<Scalar>* along_y : {&elements.y, &elements.centre_y, &elements.areas}) *along_y /= a_over_b;
        return elements;
    }

    std::shared_ptr<const detail::ShapeSet<Scalar>> set_;
    Elements<Scalar> circle_;  // elements for a = b = 1
    bool mirrored_;
    Eigen::Index strips_;
};

}  // namespace rollbem

#include "impl/patch_system.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template Elements<double> patch_elements<double, NodeDifference>(const PatchMesh<double>&,
                                                                        const NodeDifference&);
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
}  // namespace rollbem
#endif
