// Brute force in long double: kernels, rows and matrices from their definitions, entry by entry.
// Shares with the library only the description of meshes and schemes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

namespace brute_force {

using Real = long double;
using rollbem::Derivative;

/// g, its derivative and its first two antiderivatives, directly from their formulas.
struct Kernel {
    bool plane;
    Real b, c1, c2;

    Real scale() const { return 2 / std::numbers::pi_v<Real>; }
    Real g(Real x) const {
        if (plane) return scale() * (c1 * std::log(2 * b / std::abs(x)) + c2);
        return scale() * (c1 * std::asinh(b / std::abs(x)) + c2 * b / std::hypot(x, b));
    }
    Real slope(Real x) const {
        if (plane) return -scale() * c1 / x;
        const Real r = std::hypot(x, b);
        return -scale() * b * (c1 / (x * r) + c2 * x / (r * r * r));
    }
    Real H(Real x) const {
        if (x == 0) return 0;
        if (plane) return scale() * x * (c1 * (std::log(2 * b / std::abs(x)) + 1) + c2);
        return scale() * (c1 * x * std::asinh(b / std::abs(x)) + (c1 + c2) * b * std::asinh(x / b));
    }
    Real H_integral(Real x) const {
        if (x == 0) return 0;
        if (plane) return scale() * x * x / 2 * (c1 * (std::log(2 * b / std::abs(x)) + Real(1.5)) + c2);
        const Real r = std::hypot(x, b);
        const Real rise = b * x * x / (r + b);  // b (r - b)
        return scale() *
               (c1 / 2 * (x * x * std::asinh(b / std::abs(x)) + rise) + (c1 + c2) * (b * x * std::asinh(x / b) - rise));
    }
};

/// A position by its distances from both edges of the contact; differences stay accurate near an edge.
struct Place {
    Real from_trailing, from_leading;
};

inline Real operator-(const Place& to, const Place& from) {
    return from.from_trailing < 1 ? to.from_trailing - from.from_trailing : from.from_leading - to.from_leading;
}

/// Mean over `averages` intervals +-delta of the integral of g (slope: of g') over +-h, about distance d.
inline Real entry(const Kernel& kernel, bool slope, int averages, Real d, Real h, Real delta) {
    if (std::abs(d) > 6 * (h + static_cast<Real>(averages) * delta)) {
        // analytic and of one sign: nested eight-point rules are accurate to round-off
        static const rollbem::detail::QuadratureRule<Real> rule = rollbem::detail::gauss_legendre<Real>(8);
        const auto mean = [&](const auto& self, Real x, int level) -> Real {
            if (level < 0) return slope ? kernel.slope(x) : kernel.g(x);
            Real sum = 0;
            for (Eigen::Index k = 0; k < 8; ++k) {
                sum += rule.weights[k] / 2 * self(self, x + rule.nodes[k] * (level == 0 ? h : delta), level - 1);
            }
            return sum;
        };
        return 2 * h * mean(mean, d, averages);
    }
    const int level = averages + (slope ? 0 : 1);
    const auto difference = [&](const auto& self, Real x, int steps) -> Real {
        if (steps == 0) return level == 0 ? kernel.g(x) : level == 1 ? kernel.H(x) : kernel.H_integral(x);
        const Real half = steps == 1 ? h : delta;
        const Real width = steps == 1 ? 1 : 2 * delta;
        return (self(self, x + half, steps - 1) - self(self, x - half, steps - 1)) / width;
    };
    return difference(difference, d, averages + 1);
}

using Mesh = rollbem::Mesh<Real>;

/// A scheme as a list of samples: nodes and weights, how often they are averaged, and whether points must keep clear of
/// the elements' edges. Or differences between the nodes of elements, in place of the alphas.
struct Rows {
    Real alpha_L = 0, alpha_T = 0;
    std::vector<std::pair<Real, Real>> samples{{0, 1}};  // node in half widths, weight
    Real length = 1;                                     // of an average, in widths
    int averages;
    bool guard = false;
    Eigen::Index first = 0, less = 0;
    std::optional<rollbem::Nodes> nodes{};
};

inline Rows rows_of(const rollbem::Collocation& s, bool slope) {
    const Real shift = slope ? 1 : static_cast<Real>(s.lambda);
    const bool fd = s.derivative != Derivative::analytic;
    Rows rows{.alpha_L = shift * static_cast<Real>(s.alpha_L),
              .alpha_T = shift * static_cast<Real>(s.alpha_T),
              .averages = slope && fd ? 1 : 0,
              .guard = slope && !fd};
    if (slope && s.derivative == Derivative::fourth_order) {
        rows.length = Real(1) / 3;
        rows.samples = {{-2 * rows.length, Real(-1) / 24}, {0, Real(26) / 24}, {2 * rows.length, Real(-1) / 24}};
    }
    return rows;
}
inline Rows rows_of(const rollbem::Galerkin& s, bool slope) {
    Rows rows = rows_of(rollbem::Collocation{s.alpha_L, s.alpha_T, s.derivative, s.lambda}, slope);
    if (s.quadrature == 0) {
        ++rows.averages;
        rows.guard = false;
        return rows;
    }
    const auto rule = rollbem::detail::gauss_legendre<Real>(s.quadrature);
    rows.samples.clear();
    for (Eigen::Index k = 0; k < s.quadrature; ++k) rows.samples.push_back({rule.nodes[k], rule.weights[k] / 2});
    return rows;
}
inline Rows rows_of(const rollbem::KnotheBoundary& s, bool slope) {
    Rows rows = rows_of(rollbem::Collocation{0, 0, s.derivative, 1}, slope);
    rows.first = rows.less = 1;
    return rows;
}
inline Rows rows_of(const rollbem::NodeDifference& s, bool slope) {
    return {.averages = slope ? 1 : 0, .nodes = s.nodes};
}

inline Rows rows_of(const rollbem::AnyScheme& scheme, bool slope) {
    if (const auto* s = scheme.get_if<rollbem::Collocation>()) return rows_of(*s, slope);
    if (const auto* s = scheme.get_if<rollbem::Galerkin>()) return rows_of(*s, slope);
    if (const auto* s = scheme.get_if<rollbem::KnotheBoundary>()) return rows_of(*s, slope);
    return rows_of(*scheme.get_if<rollbem::NodeDifference>(), slope);
}

inline Place edge(const Mesh& mesh, Eigen::Index j) {
    return {mesh.edges_from_trailing()[j], mesh.edges_from_leading()[j]};
}
inline Place centre(const Mesh& mesh, Eigen::Index j) { return {mesh.from_trailing()[j], mesh.from_leading()[j]}; }

/// Node `i`; node n is the leading edge.
inline Place node_place(const Mesh& mesh, rollbem::Nodes nodes, Eigen::Index i) {
    const Eigen::Index n = mesh.size();
    if (i == n) return edge(mesh, n);
    if (nodes == rollbem::Nodes::centres) return centre(mesh, i);
    const auto square = [&](Eigen::Index k) {  // 1 - cos(pi k / 2n)
        const Real sine = std::sin(std::numbers::pi_v<Real> * static_cast<Real>(k) / static_cast<Real>(4 * n));
        return 2 * sine * sine;
    };
    return {square(2 * i + 1), square(2 * (n - i) - 1)};
}

/// Moves a point that is closer to an edge than 0.001 of the width of its element to that distance.
inline Real guarded(const Mesh& mesh, Eigen::Index own, Real offset) {
    const Eigen::Index n = mesh.size();
    const Place origin = centre(mesh, own);
    const auto edge_at = [&](Eigen::Index j) { return edge(mesh, j) - origin; };
    const Real tiny = mesh.widths()[own] * std::numeric_limits<Real>::epsilon() * 64;
    Eigen::Index e = 0;
    while (e < n && offset > edge_at(e + 1) + tiny) ++e;
    const bool ahead = e == n, behind = offset <= edge_at(0) + tiny;
    const Eigen::Index in = ahead ? n - 1 : e;
    const Real clearance = mesh.widths()[in] / 1000;
    if (ahead) return std::max(offset, edge_at(n) + clearance);
    if (behind) return std::min(offset, edge_at(0) - clearance);
    return std::min(std::max(offset, edge_at(in) + clearance), edge_at(in + 1) - clearance);
}

/// Row `l` of the scheme's G (slope: G') over all unknown elements.
inline std::vector<Real> row(const Kernel& kernel, const Mesh& mesh, const Rows& rows, bool slope, Eigen::Index l,
                             std::vector<Real>* scales = nullptr) {
    const Eigen::Index n = mesh.size(), own = l + rows.first;
    const Real along = n == 1 ? 0 : (centre(mesh, own) - centre(mesh, 0)) / (centre(mesh, n - 1) - centre(mesh, 0));
    const Real alpha = rows.alpha_T + along * (rows.alpha_L - rows.alpha_T);
    std::vector<Real> result(static_cast<std::size_t>(n - rows.less), 0);
    for (const auto& [node, weight] : rows.samples) {
        Real offset = (alpha + node / 2) * mesh.widths()[own];
        if (rows.guard) offset = guarded(mesh, own, offset);
        Real delta = rows.length * mesh.widths()[own] / 2;
        if (rows.nodes) {
            const Real from = node_place(mesh, *rows.nodes, own) - centre(mesh, own);
            const Real to = node_place(mesh, *rows.nodes, own + 1) - centre(mesh, own);
            offset = (from + to) / 2;
            if (!slope) offset = std::min(offset, edge(mesh, own + 1) - centre(mesh, own));
            delta = (to - from) / 2;
        }
        for (std::size_t m = 0; m < result.size(); ++m) {
            const Eigen::Index element = static_cast<Eigen::Index>(m);
            const Real d = (centre(mesh, own) - centre(mesh, element)) + offset;
            result[m] += weight * entry(kernel, slope, rows.averages, d, mesh.widths()[element] / 2, delta);
        }
    }
    if (scales != nullptr) {  // the typical size of an entry, away from where the slope changes sign
        scales->clear();
        for (std::size_t m = 0; m < result.size(); ++m) {
            const Eigen::Index element = static_cast<Eigen::Index>(m);
            const Real h = mesh.widths()[element] / 2, delta = mesh.widths()[own] / 2;
            const Real d = std::abs(centre(mesh, own) - centre(mesh, element)) + h + delta;
            scales->push_back(
                std::max(std::abs(result[m]), slope ? -2 * h * kernel.slope(d) : 2 * h * kernel.g(d) / 10));
        }
    }
    return result;
}

/// Largest error of an entry of `matrix` against brute force on `mesh`, relative to the entry's size.
template <class Scalar>
Real largest_error(const rollbem::MatrixX<Scalar>& matrix, const Kernel& kernel, const Mesh& mesh,
                   const rollbem::AnyScheme& scheme, bool slope) {
    const Rows rows = rows_of(scheme, slope);
    if (matrix.rows() != mesh.size() - rows.less || matrix.cols() != matrix.rows()) return 1e300L;
    Real largest = 0;
    std::vector<Real> scales;
    for (Eigen::Index l = 0; l < matrix.rows(); ++l) {
        const std::vector<Real> exact = row(kernel, mesh, rows, slope, l, &scales);
        for (std::size_t m = 0; m < exact.size(); ++m) {
            const Real error =
                std::abs(static_cast<Real>(matrix(l, static_cast<Eigen::Index>(m))) - exact[m]) / scales[m];
            if (!(error <= largest)) largest = std::isnan(error) ? 1e300L : error;
        }
    }
    return largest;
}

template <class Scalar>
struct NamedMesh {
    std::string name;
    rollbem::Mesh<Scalar> mesh;
};

/// Gradings are exact in float; `n` >= 3.
template <class Scalar>
std::vector<NamedMesh<Scalar>> mesh_of_every_topology(Eigen::Index n) {
    std::vector<NamedMesh<Scalar>> meshes;
    for (const rollbem::TopologyInfo& known : rollbem::topologies) {
        const double grading = known.grading == "size_ratio" ? 5 : 0.375;
        meshes.push_back({known.name, rollbem::make_mesh<Scalar>(known.topology, n, grading)});
    }
    return meshes;
}

/// One mesh of every kind, and their degenerate members; `n` >= 3.
template <class Scalar>
std::vector<NamedMesh<Scalar>> every_mesh(Eigen::Index n) {
    using namespace rollbem;
    const auto with_edges = [n] {  // irregular, rounding differently in every scalar type
        ArrayX<Scalar> edges(n + 1);
        for (Eigen::Index j = 0; j <= n; ++j) {
            const int t = static_cast<int>(4096 * j / n) - 2048;  // exact in float
            const int bump = j % 2 == 0 || j == n ? 0 : 300 / static_cast<int>(n);
            edges[j] = static_cast<Scalar>(t + bump) / 2048;
        }
        return mesh_from_edges<Scalar>(edges);
    };
    std::vector<NamedMesh<Scalar>> meshes = mesh_of_every_topology<Scalar>(n);
    meshes.push_back({"geometric 1/8", geometric_mesh<Scalar>(n, Scalar(0.125))});
    meshes.push_back({"modified knothe 4", modified_knothe_mesh<Scalar>(n, Scalar(4))});
    meshes.push_back({"edges", with_edges()});
    return meshes;
}

struct NamedScheme {
    std::string name;
    rollbem::AnyScheme scheme;
};

/// Every scheme that takes any mesh, with alphas that are exact in float.
inline std::vector<NamedScheme> every_scheme() {
    using rollbem::Collocation, rollbem::Galerkin, rollbem::KnotheBoundary;
    constexpr auto fd = Derivative::finite_difference, analytic = Derivative::analytic,
                   fourth = Derivative::fourth_order;
    return {{"fd 0.5/0.5", Collocation{0.5, 0.5, fd}},
            {"fd 0/0.625", Collocation{0, 0.625, fd}},
            {"fd 0/0", Collocation{0, 0, fd}},
            {"fd 1/1", Collocation{1, 1, fd, 0.5}},
            {"fd 1/-0.5 lambda 0", Collocation{1, -0.5, fd, 0}},
            {"analytic 0.5/0.5", Collocation{0.5, 0.5, analytic, 0.25}},
            {"analytic 0/0.625", Collocation{0, 0.625, analytic}},
            {"analytic 1/1", Collocation{1, 1, analytic}},
            {"Galerkin exact analytic", Galerkin{0, 0.625, analytic, 0.5}},
            {"Galerkin exact analytic 1/1", Galerkin{1, 1, analytic}},
            {"Galerkin exact fd", Galerkin{0, 0.625, fd}},
            {"Galerkin exact fd 0.5/0.5", Galerkin{0.5, 0.5, fd, 0}},
            {"Galerkin 7 fd", Galerkin{0, 0.625, fd, 1, 7}},
            {"Galerkin 4 analytic", Galerkin{0.25, 0.25, analytic, 0.5, 4}},
            {"Galerkin 3 analytic", Galerkin{0, 1, analytic, 1, 3}},
            {"fourth order 0/0.625", Collocation{0, 0.625, fourth}},
            {"fourth order 0.5/0.5", Collocation{0.5, 0.5, fourth, 0.5}},
            {"Knothe boundary fd", KnotheBoundary{fd}},
            {"Knothe boundary fourth order", KnotheBoundary{fourth}},
            {"Knothe boundary analytic", KnotheBoundary{analytic}},
            {"nodes centres", rollbem::NodeDifference{}}};
}

inline std::vector<std::pair<std::string, Kernel>> every_kernel() {
    return {{"plane 1024", {true, 1024, 0.75L, 0.25L}}, {"strip 1024", {false, 1024, 0.75L, 0.25L}},
            {"strip 10", {false, 10, 0.75L, 0.25L}},    {"strip 4", {false, 4, 0.75L, 0.25L}},
            {"strip 1", {false, 1, 0.75L, 0.25L}},      {"strip 1/64", {false, 0.015625L, 0.75L, 0.25L}},
            {"lateral strip 2", {false, 2, 1, -0.25L}}, {"lateral plane 16", {true, 16, 1, -0.25L}}};
}

/// Calls `function` with the library's kernel that `kernel` describes.
template <class Scalar, class Function>
decltype(auto) with_library_kernel(const Kernel& kernel, Function function) {
    const Scalar b = static_cast<Scalar>(kernel.b), c1 = static_cast<Scalar>(kernel.c1),
                 c2 = static_cast<Scalar>(kernel.c2);
    return kernel.plane ? function(rollbem::PlaneKernel<Scalar>(b, c1, c2))
                        : function(rollbem::StripKernel<Scalar>(b, c1, c2));
}

}  // namespace brute_force
