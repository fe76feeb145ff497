// PatchMesh: a contact patch cut into strips along the rolling direction, each of which has the same mesh along x,
// stretched to end exactly on the outline. Elements are rectangles, numbered from trailing to leading in each strip,
// and strip by strip from small to large y, piece by piece where several patches are one mesh.
#pragma once

#include "../detail/decl.hpp"

#include <type_traits>
#include <vector>

#include "../scene/patch_contact.hpp"
#include "../types.hpp"
#include "mesh.hpp"

namespace rollbem {

/// m strips of n elements, lengths in the unit of the system (a; of an outline c). Element i of strip j covers
/// middles_x[j] + half_lengths[j] e, e between the edges i and i + 1 of `along`, and the strip's width in y.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchMesh<double> mesh = ellipse_mesh(1.5, cosine_mesh(8), uniform_mesh(7));  // a/b = 1.5, b = 1/1.5
///     return mesh.size() == 56 && mesh.is_mirrored() ? 0 : 1;
/// }
/// \endcode
///
/// Invariant: m >= 1, all widths and half-lengths are positive and finite, and so are all places.
template <class Scalar_ = double>
class PatchMesh {
public:
    using Scalar = Scalar_;
    using Array = ArrayX<Scalar>;

    /// An element of a patch [m], x_1 < x_2 and y_1 < y_2.
    struct Rectangle {
        Scalar x_1, x_2, y_1, y_2;
    };

    struct Data {
        Mesh<Scalar> along;  ///< the n elements of each strip, between -1 and 1
        Array edges;         ///< m + 1 edges of the strips, y
        Array middles_y;     ///< m middles of their widths
        Array middles_x;     ///< m middles of their lengths
        Array half_lengths;  ///< m
    };

    /// Throws std::invalid_argument if the data break the invariant.
    explicit PatchMesh(Data data);

    /// Joins pieces of one plane, in one unit and with the same elements along x, to one mesh: the strips of all in
    /// turn, whether they touch or not. Throws std::invalid_argument if there are none, or the elements along x differ.
    static PatchMesh joined(const std::vector<PatchMesh>& pieces);

    Eigen::Index strip_count() const { return widths_.size(); }                 ///< m
    Eigen::Index elements_per_strip() const { return along_.size(); }           ///< n
    Eigen::Index size() const { return strip_count() * elements_per_strip(); }  ///< N = n m
    const Mesh<Scalar>& along() const { return along_; }
    const Array& lower() const { return lower_; }  ///< edges of the strips, y
    const Array& upper() const { return upper_; }
    const Array& widths() const { return widths_; }
    const Array& middles_y() const { return middles_y_; }
    const Array& middles_x() const { return middles_x_; }
    const Array& half_lengths() const { return half_lengths_; }
    Scalar height() const { return upper_.maxCoeff() - lower_.minCoeff(); }  ///< height between the outermost edges

    /// Whether the strips at y and -y are mirror images, exactly: then linear problems split into two.
    bool is_mirrored() const { return mirrored_; }

    /// The elements [m], strip by strip; `unit` is the mesh's unit of length [m], half_length() of the contact.
    std::vector<Rectangle> rectangles(Scalar unit) const;

private:
    void check();

    Mesh<Scalar> along_;
    Array lower_, upper_, middles_y_, middles_x_, half_lengths_, widths_;
    bool mirrored_ = false;
};

/// An ellipse with semi-axes a = 1 in x and b = 1/a_over_b in y. `along` divides each strip, `across` the height, y/b =
/// -1 ... 1. A strip is as long as the ellipse at the middle of its width, which is more accurate than the mean length
/// over the width (docs/measured.md). Throws std::invalid_argument unless a_over_b is positive and finite.
template <class Scalar>
PatchMesh<Scalar> ellipse_mesh(std::type_identity_t<Scalar> a_over_b, Mesh<Scalar> along, const Mesh<Scalar>& across);

/// Any outline, in units of `unit`, e.g. c. `across` divides its height, from -1 at the smallest y to 1 at the largest.
/// A strip lies between the edges of the outline at the middle of its width.
template <class Scalar>
PatchMesh<Scalar> outline_mesh(const PatchContact::Outline& outline, std::type_identity_t<Scalar> unit,
                               Mesh<Scalar> along, const Mesh<Scalar>& across);

/// The mesh of a contact patch in units of a (outlines: c). Cosine meshes in both directions are accurate; n = m serves
/// at every a/b up to 10.
template <class Scalar>
PatchMesh<Scalar> patch_mesh(const PatchContact& contact, Mesh<Scalar> along, const Mesh<Scalar>& across);

/// The mesh of a contact patch from cosine meshes of n elements a strip and m strips.
inline PatchMesh<double> patch_mesh(const PatchContact& contact, Eigen::Index n, Eigen::Index m) {
    return patch_mesh(contact, cosine_mesh<double>(n), cosine_mesh<double>(m));
}

}  // namespace rollbem

#include "impl/patch_mesh.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template class PatchMesh<double>;
extern template PatchMesh<double> patch_mesh<double>(const PatchContact&, Mesh<double>, const Mesh<double>&);
extern template PatchMesh<double> ellipse_mesh<double>(double, Mesh<double>, const Mesh<double>&);
}  // namespace rollbem
#endif
