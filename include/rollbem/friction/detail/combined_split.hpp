// Friction in two directions, one direction at a time: a starting point for when Newton's method has failed.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "complementary_path.hpp"

namespace rollbem::detail {

/// Solves each direction separately under its share of the bounds, taken at the angle of the element's constant, by
/// ComplementaryPath, which always terminates. If the constants of all elements point along one of the directions, the
/// result is a solution. All memory is allocated by the constructor.
template <class Scalar>
class CombinedSplit {
public:
    using Index = Eigen::Index;

    explicit CombinedSplit(Index n)
        : path_(n),
          traction_(ElementVectors<Scalar>::Zero(n, 2)),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          share_(VectorX<Scalar>::Zero(n)),
          column_(VectorX<Scalar>::Zero(n)) {}

    const ElementVectors<Scalar>& traction() const { return traction_; }
    const std::vector<Zone>& zones() const { return zones_; }

    /// `margin`: round-off relative to a bound.
    void find(const MatrixX<Scalar>& longitudinal, const MatrixX<Scalar>& lateral,
              const ElementVectors<Scalar>& constant, const VectorX<Scalar>& bound, Scalar margin) {
        for (Index d = 0; d < 2; ++d) {
            for (Index i = 0; i < bound.size(); ++i) {
                const Scalar norm = std::hypot(constant(i, 0), constant(i, 1));
                share_[i] = norm > 0 ? bound[i] * (std::abs(constant(i, d)) / norm) : Scalar(0);
            }
            column_ = constant.col(d);
            path_.follow(d == 0 ? longitudinal : lateral, column_, share_);
            traction_.col(d) = path_.traction();
        }
        for (Index i = 0; i < bound.size(); ++i) {
            const bool at_bound = std::hypot(traction_(i, 0), traction_(i, 1)) >= (1 - margin) * bound[i];
            zones_[static_cast<std::size_t>(i)] = at_bound ? Zone::slip : Zone::stick;
        }
    }

private:
    ComplementaryPath<Scalar> path_;
    ElementVectors<Scalar> traction_;
    std::vector<Zone> zones_;
    VectorX<Scalar> share_, column_;
};

}  // namespace rollbem::detail
