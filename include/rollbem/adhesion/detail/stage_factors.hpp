// The factors of a stage's matrix, kept as long as model and stage stay the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../rolling/stage.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

template <class Scalar>
class StageFactors {
public:
    explicit StageFactors(Eigen::Index n)
        : factors_(MatrixX<Scalar>::Zero(n, n)), swaps_(static_cast<std::size_t>(n)) {}

    Eigen::Index size() const { return factors_.rows(); }

    void prepare(std::uint64_t model, const Influence<Scalar>& influence, const RollingStage<Scalar>& stage) {
        prepare(model, stage, [&](MatrixX<Scalar>& M) { influence.fill_stage_matrix(stage, M); });
    }
    /// Factorises a matrix that `fill` fills.
    template <class Fill>
    void prepare(std::uint64_t model, const RollingStage<Scalar>& stage, const Fill& fill) {
        if (model == model_ && stage == stage_) return;
        fill(factors_);
        factorise_in_place<Scalar>(factors_, swaps_.data());
        model_ = model;
        stage_ = stage;
    }

    void solve(VectorRef<Scalar> x) { solve_in_place<Scalar>(factors_, swaps_.data(), x); }

private:
    MatrixX<Scalar> factors_;
    std::vector<Eigen::Index> swaps_;
    std::uint64_t model_ = 0;
    std::optional<RollingStage<Scalar>> stage_;
};

}  // namespace rollbem::detail
