// Mesh: a division of the contact -1 <= x/a <= 1 into elements of constant traction, with one function for each
// topology (Eq. (32) is one of them) and one that makes any of them. Elements are numbered from the trailing edge
// (index 0) to the leading edge (index n-1).
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"

namespace rollbem {

/// A mesh of n elements, all lengths in units of the half-length a.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Mesh<double> mesh = cosine_mesh(20);
///     const auto steady = solve_steady(mesh, NodeDifference{Nodes::chebyshev}, PlaneKernel<double>(100, 0.72, 0.28));
///     return steady.status == Status::ok ? 0 : 1;  // p/(G xi) of each element in steady.unknowns, trailing to leading
/// }
/// \endcode
///
/// Invariant: n >= 1, every width > 0, edges strictly increasing from -1 to 1. Distances from the trailing and the
/// leading edge are stored next to the coordinates because 1 + x and 1 - x lose digits near an edge, where a graded
/// mesh has its smallest elements.
template <class Scalar_ = double>
class Mesh {
public:
    using Scalar = Scalar_;
    using Array = Eigen::Array<Scalar, Eigen::Dynamic, 1>;

    /// The data of a mesh, each number in closed form rather than as a difference of others.
    struct Data {
        Array widths;               ///< n element widths dx/a
        Array edges_from_trailing;  ///< n+1 values 1 + x of the edges, increasing from 0 to 2
        Array edges_from_leading;   ///< n+1 values 1 - x of the edges, decreasing from 2 to 0
        bool uniform = false;       ///< all widths equal
    };

    /// Throws std::invalid_argument if the data break the invariant.
    explicit Mesh(Data data);

    Eigen::Index size() const { return data_.widths.size(); }  ///< n
    bool is_uniform() const { return data_.uniform; }
    const Array& widths() const { return data_.widths; }                            ///< n widths
    const Array& centres() const { return centres_; }                               ///< n centres x
    const Array& from_trailing() const { return from_trailing_; }                   ///< n values 1 + x of the centres
    const Array& from_leading() const { return from_leading_; }                     ///< n values 1 - x of the centres
    const Array& edges_from_trailing() const { return data_.edges_from_trailing; }  ///< n+1 values 1 + x
    const Array& edges_from_leading() const { return data_.edges_from_leading; }    ///< n+1 values 1 - x
    Array edges() const { return (data_.edges_from_trailing - data_.edges_from_leading) / 2; }  ///< n+1 edges x

private:
    static void require_finite(const Array& values, const char* quantity, const char* rule);
    static void check_edges(const Array& trailing, const Array& leading);

    Data data_;
    Array from_trailing_, from_leading_, centres_;
};

/// The layout of the elements of a mesh; each has a maker below.
enum class Topology { uniform, geometric, knothe, modified_knothe, cosine };

/// Facts about a topology.
struct TopologyInfo {
    /// A number besides n that determines graded meshes [-].
    struct Grading {
        const char* name;  ///< as in the programs' columns; in their options with a dash
        const char* meaning;
        double usual;  ///< default of the programs
    };

    Topology topology;
    const char* name;          ///< as in the programs' options
    std::string_view grading;  ///< the name of one of the gradings; empty if it takes none
    Eigen::Index least_n;      ///< fewest elements
};

/// All grading numbers.
inline constexpr std::array<TopologyInfo::Grading, 2> gradings{{
    {"size_ratio", "width of the trailing element over the leading one's", 2},
    {"epsilon", "width of an end element over an inner one's", 0.4},
}};

/// All topologies, in the order of the enumeration.
inline constexpr std::array<TopologyInfo, 5> topologies{{
    {Topology::uniform, "uniform", "", 1},
    {Topology::geometric, "geometric", "size_ratio", 2},
    {Topology::knothe, "knothe", "epsilon", 3},
    {Topology::modified_knothe, "modified-knothe", "epsilon", 2},
    {Topology::cosine, "cosine", "", 1},
}};

constexpr const TopologyInfo& topology_info(Topology topology) {
    return topologies[static_cast<std::size_t>(topology)];
}

constexpr const char* name(Topology topology) { return topology_info(topology).name; }

/// The topology of a given name, if there is one.
constexpr std::optional<Topology> topology_named(std::string_view name) {
    for (const TopologyInfo& known : topologies) {
        if (name == known.name) return known.topology;
    }
    return std::nullopt;
}

namespace detail {

/// The data of a mesh from a function edge(j) = distance of edge j from the trailing edge, and its mirror image.
template <class Scalar, class FromTrailing, class FromLeading, class Width>
typename Mesh<Scalar>::Data mesh_data(Eigen::Index n, const FromTrailing& from_trailing,
                                      const FromLeading& from_leading, const Width& width) {
    typename Mesh<Scalar>::Data data;
    data.widths.resize(n);
    data.edges_from_trailing.resize(n + 1);
    data.edges_from_leading.resize(n + 1);
    for (Eigen::Index j = 0; j <= n; ++j) {
        data.edges_from_trailing[j] = from_trailing(j);
        data.edges_from_leading[j] = from_leading(j);
    }
    for (Eigen::Index i = 0; i < n; ++i) data.widths[i] = width(i);
    return data;
}

}  // namespace detail

/// A: n equal elements. Throws std::invalid_argument if n < 1.
template <class Scalar = double>
Mesh<Scalar> uniform_mesh(Eigen::Index n);

/// B: widths in geometric progression, Eq. (32); size_ratio = dx_trailing / dx_leading. Throws std::invalid_argument if
/// n < 2 or the ratio is not positive and finite.
template <class Scalar = double>
Mesh<Scalar> geometric_mesh(Eigen::Index n, Scalar size_ratio);

/// C: Knothe and Gross-Thebing's mesh, both end elements epsilon times as wide as an inner one. Throws
/// std::invalid_argument if n < 3 or epsilon is not positive and finite.
template <class Scalar = double>
Mesh<Scalar> knothe_mesh(Eigen::Index n, Scalar epsilon);

/// D: modified Knothe mesh, the trailing element epsilon times as wide as the others. Throws std::invalid_argument if
/// n < 2 or epsilon is not positive and finite.
template <class Scalar = double>
Mesh<Scalar> modified_knothe_mesh(Eigen::Index n, Scalar epsilon);

/// E: cosine mesh, edges x_j = -cos(pi j / n): small elements at both edges, where the traction is singular or has a
/// vertical tangent. Throws std::invalid_argument if n < 1.
template <class Scalar = double>
Mesh<Scalar> cosine_mesh(Eigen::Index n);

/// A mesh of a topology that is chosen at run time; `parameter` is its topology_info(topology).grading, ignored if
/// there is none. Throws std::invalid_argument if n or the parameter is out of range for the topology.
template <class Scalar = double>
Mesh<Scalar> make_mesh(Topology topology, Eigen::Index n, double parameter = 1);

/// A mesh from its n+1 edges x/a, strictly increasing from -1 to 1. Throws std::invalid_argument naming the first edge
/// that violates this.
template <class Scalar, class Derived>
Mesh<Scalar> mesh_from_edges(const Eigen::DenseBase<Derived>& edges) {
    const Eigen::Index n = edges.size() - 1;
    detail::require(n >= 1, "mesh_from_edges", "number of edges", edges.size(), "be at least 2");
    const auto first = edges(0), last = edges(n);
    detail::require(detail::is_finite(first) && first == Scalar(-1), "mesh_from_edges", "first edge", first, "be -1");
    detail::require(detail::is_finite(last) && last == Scalar(1), "mesh_from_edges", "last edge", last, "be 1");
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto next = edges(j + 1);
        detail::require(detail::is_finite(next) && next > edges(j), "mesh_from_edges", "edge", next,
                        "be larger than the edge before it");
    }
    return Mesh<Scalar>(detail::mesh_data<Scalar>(
        n, [&](Eigen::Index j) { return 1 + edges(j); }, [&](Eigen::Index j) { return 1 - edges(j); },
        [&](Eigen::Index i) { return edges(i + 1) - edges(i); }));
}

/// A mesh in the scalar type of its n+1 edges.
template <class Derived>
Mesh<typename Derived::Scalar> mesh_from_edges(const Eigen::DenseBase<Derived>& edges) {
    return mesh_from_edges<typename Derived::Scalar>(edges);
}

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/mesh.tpp"
#endif
