// Bodies of discretisation/patch_mesh.hpp. Internal.
#pragma once

#include "../patch_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../detail/require.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../types.hpp"
#include "../mesh.hpp"

namespace rollbem {

template <class Scalar_>
PatchMesh<Scalar_>::PatchMesh(Data data)
    : along_(std::move(data.along)),
      middles_y_(std::move(data.middles_y)),
      middles_x_(std::move(data.middles_x)),
      half_lengths_(std::move(data.half_lengths)) {
    const Eigen::Index m = half_lengths_.size();
    detail::require(m >= 1, "PatchMesh", "number of strips", m, "be at least 1");
    detail::require(data.edges.size() == m + 1, "PatchMesh", "number of edges of strips", data.edges.size(),
                    "be one more than the number of strips");
    lower_ = data.edges.head(m);
    upper_ = data.edges.tail(m);
    check();
}

template <class Scalar_>
auto PatchMesh<Scalar_>::rectangles(Scalar unit) const -> std::vector<Rectangle> {
    std::vector<Rectangle> elements;
    const Array edges = along().edges();
    for (Eigen::Index j = 0; j < strip_count(); ++j) {
        const auto x = [&](Eigen::Index i) { return unit * (middles_x()[j] + half_lengths()[j] * edges[i]); };
        for (Eigen::Index i = 0; i < elements_per_strip(); ++i) {
            elements.push_back({x(i), x(i + 1), unit * lower_[j], unit * upper_[j]});
        }
    }
    return elements;
}

template <class Scalar_>
void PatchMesh<Scalar_>::check() {
    const Eigen::Index m = half_lengths_.size();
    detail::require(middles_y_.size() == m && middles_x_.size() == m, "PatchMesh", "number of middles of strips",
                    middles_x_.size(), "equal the number of strips");
    widths_ = upper_ - lower_;
    mirrored_ = true;
    for (Eigen::Index j = 0; j < m; ++j) {
        detail::require_positive("PatchMesh", "width of a strip", widths_[j]);
        detail::require_positive("PatchMesh", "half-length of a strip", half_lengths_[j]);
        detail::require(middles_y_[j] > lower_[j] && middles_y_[j] < upper_[j], "PatchMesh",
                        "y of the middle of a strip", middles_y_[j], "lie between its edges");
        detail::require_finite("PatchMesh", "x of the middle of a strip", middles_x_[j]);
        const Eigen::Index k = m - 1 - j;
        mirrored_ = mirrored_ && lower_[j] == -upper_[k] && middles_y_[j] == -middles_y_[k] &&
                    middles_x_[j] == middles_x_[k] && half_lengths_[j] == half_lengths_[k];
    }
}

namespace detail {

/// About m strips across an outline, as dense as in a cosine mesh by half, and where its edges change along y by half.
/// Up to m/2 lines of the outline are edges of strips.
inline Mesh<double> outline_strips(const PatchContact::Outline& outline, Eigen::Index m) {
    const ArrayX<double>& y = outline.y();
    const Eigen::Index lines = y.size();
    const auto place = [&](double at) {
        return (2 * at - outline.low() - outline.high()) / (outline.high() - outline.low());
    };
    ArrayX<double> run = ArrayX<double>::Zero(lines);  // of both edges along x, up to each line
    for (Eigen::Index i = 1; i < lines; ++i) {
        run[i] = run[i - 1] + std::abs(outline.leading(y[i]) - outline.leading(y[i - 1])) +
                 std::abs(outline.trailing(y[i]) - outline.trailing(y[i - 1]));
    }
    const double whole = run[lines - 1];
    const auto share = [&](double at) {  // of the strips that lie below
        const double by_height = std::acos(std::clamp(-place(at), -1.0, 1.0)) / std::numbers::pi;
        if (!(whole > 0)) return by_height;
        const Eigen::Index j = std::upper_bound(y.data() + 1, y.data() + lines - 1, at) - y.data();
        const double part = (at - y[j - 1]) / (y[j] - y[j - 1]);
        return (by_height + (run[j - 1] + part * (run[j] - run[j - 1])) / whole) / 2;
    };
    std::vector<double> edges{-1};
    const auto add_up_to = [&](double from, double to) {
        const double low = share(from), high = share(to);
        const auto count = (std::max)(Eigen::Index(1), static_cast<Eigen::Index>(std::round(double(m) * (high - low))));
        for (Eigen::Index j = 1; j < count; ++j) {
            double below = from, above = to;
            for (int k = 0; k < 60; ++k) {
                const double middle = (below + above) / 2;
                (share(middle) < low + (high - low) * double(j) / double(count) ? below : above) = middle;
            }
            edges.push_back(place(below));
        }
        edges.push_back(place(to));
    };
    double from = outline.low();
    const double least = (outline.high() - from) / 1000;
    if (lines - 2 <= m / 2) {
        for (Eigen::Index i = 1; i + 1 < lines; ++i) {
            if (y[i] - from < least || outline.high() - y[i] < least) continue;
            add_up_to(from, y[i]);
            from = y[i];
        }
    }
    add_up_to(from, outline.high());
    edges.back() = 1;
    // strips that are mirror images to the last bit make two problems of half the size
    for (std::size_t j = 0, k = edges.size() - 1; j <= k && k > 0; ++j, --k) {
        const double half = (edges[k] - edges[j]) / 2;
        if (!(std::abs(edges[j] + edges[k]) <= 1e-6)) continue;
        edges[k] = half;
        edges[j] = -half;
    }
    return mesh_from_edges<double>(Eigen::Map<const ArrayX<double>>(edges.data(), Eigen::Index(edges.size())));
}

}  // namespace detail

template <class Scalar>
PatchMesh<Scalar> PatchMesh<Scalar>::joined(const std::vector<PatchMesh>& pieces) {
    detail::require(!pieces.empty(), "PatchMesh", "number of pieces", pieces.size(), "be at least 1");
    PatchMesh whole = pieces.front();
    for (std::size_t k = 1; k < pieces.size(); ++k) {
        const PatchMesh& piece = pieces[k];
        detail::require(
            piece.along().size() == whole.along().size() && (piece.along().edges() == whole.along().edges()).all(),
            "PatchMesh", "number of elements of a piece's strips", piece.elements_per_strip(),
            "be the number of the other strips, with the same edges");
        for (const auto part : {&PatchMesh::lower_, &PatchMesh::upper_, &PatchMesh::middles_y_, &PatchMesh::middles_x_,
                                &PatchMesh::half_lengths_}) {
            Array both((whole.*part).size() + (piece.*part).size());
            both << whole.*part, piece.*part;
            whole.*part = std::move(both);
        }
    }
    whole.check();
    return whole;
}

template <class Scalar>
PatchMesh<Scalar> ellipse_mesh(std::type_identity_t<Scalar> a_over_b, Mesh<Scalar> along, const Mesh<Scalar>& across) {
    detail::require_positive("ellipse_mesh", "a_over_b", a_over_b);
    // sqrt(1 - (y/b)^2) by the distances from both ends, without cancellation
    return PatchMesh<Scalar>({.along = std::move(along),
                              .edges = across.edges() / a_over_b,
                              .middles_y = across.centres() / a_over_b,
                              .middles_x = ArrayX<Scalar>::Zero(across.size()),
                              .half_lengths = (across.from_trailing() * across.from_leading()).sqrt()});
}

template <class Scalar>
PatchMesh<Scalar> outline_mesh(const PatchContact::Outline& outline, std::type_identity_t<Scalar> unit,
                               Mesh<Scalar> along, const Mesh<Scalar>& across) {
    const double middle = (outline.low() + outline.high()) / 2, half_height = (outline.high() - outline.low()) / 2;
    const Eigen::Index m = across.size();
    const auto place = [&](Scalar t) { return static_cast<Scalar>(middle + half_height * t); };
    ArrayX<Scalar> edges = across.edges(), middles = across.centres(), middles_x(m), half_lengths(m);
    for (Scalar& y : edges) y = place(y) / unit;
    for (Eigen::Index j = 0; j < m; ++j) {
        const auto y = static_cast<double>(place(middles[j]));
        const double trailing = outline.trailing(y), leading = outline.leading(y);
        middles[j] = place(middles[j]) / unit;
        middles_x[j] = static_cast<Scalar>((trailing + leading) / 2 / unit);
        half_lengths[j] = static_cast<Scalar>((leading - trailing) / 2 / unit);
    }
    return PatchMesh<Scalar>({std::move(along), edges, middles, middles_x, half_lengths});
}

template <class Scalar>
PatchMesh<Scalar> patch_mesh(const PatchContact& contact, Mesh<Scalar> along, const Mesh<Scalar>& across) {
    if (contact.outline()) {
        return outline_mesh<Scalar>(*contact.outline(), static_cast<Scalar>(contact.half_length()), std::move(along),
                                    across);
    }
    return ellipse_mesh<Scalar>(static_cast<Scalar>(contact.a_over_b()), std::move(along), across);
}

}  // namespace rollbem
