// Matrix factors and scratch memory of full adhesion in the time domain. They make steps fast and never change a
// result.
#pragma once

#include <Eigen/Core>

#include "detail/stages.hpp"
#include "detail/step_map.hpp"

namespace rollbem {

/// A workspace is made by a model and fits any model with the same number of unknowns and directions. The matrices for
/// steps of one distance are kept as long as model and distance stay the same, so contacts that are stepped in turn
/// should each have their own workspace, of 4 n^2 numbers. Two threads must not use one workspace at the same time.
template <int directions = 1>
class AdhesionWorkspace {
public:
    /// A workspace for n unknowns.
    explicit AdhesionWorkspace(Eigen::Index n) : factors_(n), stages_(n), map_(n) {}

    Eigen::Index size() const { return factors_.size(); }

    detail::StageFactors& factors() { return factors_; }              ///< for the models
    detail::AdhesionStages<directions>& stages() { return stages_; }  ///< for the models
    detail::StepMap<directions>& map() { return map_; }               ///< for the models

private:
    detail::StageFactors factors_;
    detail::AdhesionStages<directions> stages_;
    detail::StepMap<directions> map_;
};

}  // namespace rollbem
