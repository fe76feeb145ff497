// The factors of a stage's matrix, kept as long as model and stage stay the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../rolling/detail/stage.hpp"
#include "../../types.hpp"

namespace rollbem::detail {

class StageFactors {
public:
    explicit StageFactors(Eigen::Index n)
        : factors_(MatrixX<double>::Zero(n, n)), swaps_(static_cast<std::size_t>(n)) {}

    Eigen::Index size() const { return factors_.rows(); }

    void prepare(std::uint64_t model, const Influence& influence, const RollingStage& stage) {
        prepare(model, stage, [&](MatrixX<double>& M) { influence.fill_stage_matrix(stage, M); });
    }
    /// Factorises a matrix that `fill` fills.
    template <class Fill>
    void prepare(std::uint64_t model, const RollingStage& stage, const Fill& fill) {
        if (model == model_ && stage == stage_) return;
        fill(factors_);
        factorise_in_place<double>(factors_, swaps_.data());
        model_ = model;
        stage_ = stage;
    }

    void solve(VectorRef<double> x) { solve_in_place<double>(factors_, swaps_.data(), x); }

private:
    MatrixX<double> factors_;
    std::vector<Eigen::Index> swaps_;
    std::uint64_t model_ = 0;
    std::optional<RollingStage> stage_;
};

}  // namespace rollbem::detail
