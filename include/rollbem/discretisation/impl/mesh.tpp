// Bodies of discretisation/mesh.hpp. Internal.
#pragma once

#include "../mesh.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

template <class Scalar>
Mesh<Scalar>::Mesh(Data data) : data_(std::move(data)) {
    const Eigen::Index n = data_.widths.size();
    detail::require(n >= 1, "Mesh", "number of elements", n, "be at least 1");
    detail::require(data_.edges_from_trailing.size() == n + 1 && data_.edges_from_leading.size() == n + 1, "Mesh",
                    "number of edges", data_.edges_from_trailing.size(), "be one more than the number of elements");
    require_finite(data_.widths, "element width", "be positive and finite");
    require_finite(data_.edges_from_trailing, "1 + x of an edge", "be finite");
    require_finite(data_.edges_from_leading, "1 - x of an edge", "be finite");
    for (Eigen::Index i = 0; i < n; ++i) {
        detail::require(data_.widths[i] > 0, "Mesh", "element width", data_.widths[i], "be positive and finite");
    }
    check_edges(data_.edges_from_trailing, data_.edges_from_leading);
    from_trailing_.resize(n);
    from_leading_.resize(n);
    centres_.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        from_trailing_[i] = (data_.edges_from_trailing[i] + data_.edges_from_trailing[i + 1]) / 2;
        from_leading_[i] = (data_.edges_from_leading[i] + data_.edges_from_leading[i + 1]) / 2;
        centres_[i] = (from_trailing_[i] - from_leading_[i]) / 2;
    }
}

// Tests all values at once, which is fast, and one by one only to name the first that is not finite.
template <class Scalar>
void Mesh<Scalar>::require_finite(const Array& values, const char* quantity, const char* rule) {
    if (detail::all_finite(values)) return;
    for (const Scalar& value : values) detail::require(detail::is_finite(value), "Mesh", quantity, value, rule);
}

// Near one edge of the contact, the distances of neighbours from the other edge may round to the same number.
template <class Scalar>
void Mesh<Scalar>::check_edges(const Array& trailing, const Array& leading) {
    const Eigen::Index n = trailing.size() - 1;
    const char* rule = "be 0 at its own edge of the contact, 2 at the other, and monotonic between";
    detail::require(trailing[0] == 0 && trailing[n] == 2, "Mesh", "1 + x of the edges", trailing[n], rule);
    detail::require(leading[n] == 0 && leading[0] == 2, "Mesh", "1 - x of the edges", leading[0], rule);
    for (Eigen::Index j = 0; j < n; ++j) {
        const bool ordered = trailing[j + 1] >= trailing[j] && leading[j + 1] <= leading[j] &&
                             (trailing[j + 1] > trailing[j] || leading[j + 1] < leading[j]);
        detail::require(ordered, "Mesh", "1 + x of an edge", trailing[j + 1], rule);
        const Scalar excess = trailing[j] + leading[j] - 2;
        detail::require(std::abs(excess) <= 16 * std::numeric_limits<Scalar>::epsilon(), "Mesh",
                        "(1 + x) + (1 - x) - 2 of an edge", excess, "be 0 to rounding");
    }
}

}  // namespace rollbem

namespace rollbem::detail {

inline void require_elements(const char* who, Topology topology, Eigen::Index n) {
    const Eigen::Index least = topology_info(topology).least_n;
    if (n >= least) return;
    const std::string rule = "be at least " + to_text(least);
    require(false, who, "n", n, rule.c_str());
}

}  // namespace rollbem::detail

namespace rollbem {

template <class Scalar>
Mesh<Scalar> uniform_mesh(Eigen::Index n) {
    detail::require_elements("uniform_mesh", Topology::uniform, n);
    const Scalar count = static_cast<Scalar>(n);
    typename Mesh<Scalar>::Data data = detail::mesh_data<Scalar>(
        n, [=](Eigen::Index j) { return Scalar(2 * j) / count; },
        [=](Eigen::Index j) { return Scalar(2 * (n - j)) / count; }, [=](Eigen::Index) { return 2 / count; });
    data.uniform = true;
    return Mesh<Scalar>(std::move(data));
}

template <class Scalar>
Mesh<Scalar> geometric_mesh(Eigen::Index n, Scalar size_ratio) {
    detail::require_elements("geometric_mesh", Topology::geometric, n);
    detail::require_positive("geometric_mesh", "size_ratio", size_ratio);
    // width i is proportional to exp(i * growth); expm1 keeps the sums accurate when growth is small
    const Scalar growth = -std::log(size_ratio) / static_cast<Scalar>(n - 1);
    if (growth == 0) return uniform_mesh<Scalar>(n);
    const Scalar count = static_cast<Scalar>(n);
    const Scalar forward = 2 / std::expm1(count * growth);
    const Scalar backward = 2 / std::expm1(-count * growth);
    return Mesh<Scalar>(detail::mesh_data<Scalar>(
        n, [=](Eigen::Index j) { return j == n ? Scalar(2) : forward * std::expm1(static_cast<Scalar>(j) * growth); },
        [=](Eigen::Index j) { return j == 0 ? Scalar(2) : backward * std::expm1(static_cast<Scalar>(j - n) * growth); },
        [=](Eigen::Index i) { return forward * std::expm1(growth) * std::exp(static_cast<Scalar>(i) * growth); }));
}

template <class Scalar>
Mesh<Scalar> knothe_mesh(Eigen::Index n, Scalar epsilon) {
    detail::require_elements("knothe_mesh", Topology::knothe, n);
    detail::require_positive("knothe_mesh", "epsilon", epsilon);
    const Scalar inner = 2 / (static_cast<Scalar>(n - 2) + 2 * epsilon);
    const auto edge = [=](Eigen::Index j) {
        return j == 0 ? Scalar(0) : j == n ? Scalar(2) : inner * (epsilon + static_cast<Scalar>(j - 1));
    };
    return Mesh<Scalar>(detail::mesh_data<Scalar>(
        n, edge, [=](Eigen::Index j) { return edge(n - j); },
        [=](Eigen::Index i) { return i == 0 || i == n - 1 ? epsilon * inner : inner; }));
}

template <class Scalar>
Mesh<Scalar> modified_knothe_mesh(Eigen::Index n, Scalar epsilon) {
    detail::require_elements("modified_knothe_mesh", Topology::modified_knothe, n);
    detail::require_positive("modified_knothe_mesh", "epsilon", epsilon);
    const Scalar inner = 2 / (static_cast<Scalar>(n - 1) + epsilon);
    return Mesh<Scalar>(detail::mesh_data<Scalar>(
        n,
        [=](Eigen::Index j) {
            return j == 0 ? Scalar(0) : j == n ? Scalar(2) : inner * (epsilon + static_cast<Scalar>(j - 1));
        },
        [=](Eigen::Index j) { return j == 0 ? Scalar(2) : inner * static_cast<Scalar>(n - j); },
        [=](Eigen::Index i) { return i == 0 ? epsilon * inner : inner; }));
}

template <class Scalar>
Mesh<Scalar> cosine_mesh(Eigen::Index n) {
    detail::require_elements("cosine_mesh", Topology::cosine, n);
    const Scalar quarter = std::numbers::pi_v<Scalar> / static_cast<Scalar>(2 * n);
    const auto sine = [=](Eigen::Index k) { return std::sin(static_cast<Scalar>(k) * quarter); };
    // 1 + x_j = 2 sin^2(pi j / 2n), and a width is a product of two sines: no subtraction anywhere. Arguments are kept
    // below pi/2 so that the rounding of pi does not affect the small results at the leading edge.
    const auto edge = [=](Eigen::Index j) { return 2 * sine(j) * sine(j); };
    return Mesh<Scalar>(detail::mesh_data<Scalar>(
        n, edge, [=](Eigen::Index j) { return edge(n - j); },
        [=](Eigen::Index i) { return 2 * sine(2 * i + 1 <= n ? 2 * i + 1 : 2 * (n - i) - 1) * sine(1); }));
}

template <class Scalar>
Mesh<Scalar> make_mesh(Topology topology, Eigen::Index n, double parameter) {
    const Scalar grading = static_cast<Scalar>(parameter);
    switch (topology) {
        case Topology::uniform: break;
        case Topology::geometric: return geometric_mesh<Scalar>(n, grading);
        case Topology::knothe: return knothe_mesh<Scalar>(n, grading);
        case Topology::modified_knothe: return modified_knothe_mesh<Scalar>(n, grading);
        case Topology::cosine: return cosine_mesh<Scalar>(n);
    }
    return uniform_mesh<Scalar>(n);
}

}  // namespace rollbem
