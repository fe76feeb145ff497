// The memory behind a workspace of combined friction.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../combined_state.hpp"
#include "combined_solver.hpp"
#include "jump_work.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// Dimensionless: tractions in G, lengths in a_0, the contact's half-length. Everything is allocated by the
/// constructor.
template <class Scalar>
struct CombinedMemory {
    using Vectors = ElementVectors<Scalar>;

    explicit CombinedMemory(Eigen::Index n)
        : solver(n),
          slip(Vectors::Zero(n, 2)),
          work(VectorX<Scalar>::Zero(n)),
          bound(VectorX<Scalar>::Zero(n)),
          pressure(ArrayX<Scalar>::Zero(n)),
          column(VectorX<Scalar>::Zero(n)),
          product(VectorX<Scalar>::Zero(n)),
          rate(VectorX<Scalar>::Zero(n)),
          bound_rate(VectorX<Scalar>::Zero(n)),
          start(Vectors::Zero(n, 2)),
          displacement(Vectors::Zero(n, 2)),
          right(Vectors::Zero(n, 2)),
          response(Vectors::Zero(n, 2)),
          carried{right, right, right, right},
          jump_work{JumpWork<Scalar>(n), JumpWork<Scalar>(n)} {}

    CombinedSolver<Scalar> solver;
    std::uint64_t system = 0;  // the solver's matrices are those of this model and stage
    RollingStage<Scalar> stage{.distance = std::numeric_limits<Scalar>::quiet_NaN()};
    Vectors slip;             // of all stages so far
    VectorX<Scalar> work;     // of all stages so far
    VectorX<Scalar> bound;    // mu p_n / G of the present stage
    ArrayX<Scalar> pressure;  // p_n of the present stage [Pa]
    VectorX<Scalar> column, product, rate, bound_rate;
    Vectors start;         // tractions that the present stage is sought from
    Vectors displacement;  // that it starts from
    Vectors right, response;
    std::array<Vectors, 4> carried;  // what the first stage adds to the constants of the second, by each parameter
    std::array<JumpWork<Scalar>, 2> jump_work;
};

}  // namespace rollbem::detail
