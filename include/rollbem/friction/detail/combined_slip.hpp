// Slip of the elements of a CombinedSolver and its derivatives by their bounds, for FallingSet in two directions.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "combined_solver.hpp"

namespace rollbem::detail {

/// The interface between FallingSet and its solver, as ActiveSetSlip in one direction; d|s| of an element is the change
/// of its slip against its traction. All memory is allocated by the constructor.
template <class Scalar_>
class CombinedSlip {
public:
    using Scalar = Scalar_;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;
    using Solver = CombinedSolver<Scalar>;
    using Outcome = typename Solver::Outcome;
    using Start = SolutionStart<2, Scalar>;
    static constexpr int directions = 2;

    explicit CombinedSlip(Index n)
        : traction_(Vectors::Zero(n, 2)),
          slip_change_(n, 2),
          zones_(static_cast<std::size_t>(n), Zone::stick),
          coupling_(MatrixX<Scalar>::Zero(n, n)),
          slipping_(static_cast<std::size_t>(n)) {}

    static Vectors zero(Index n) { return Vectors::Zero(n, 2); }

    void begin(const Start& start) {
        traction_ = start.traction;
        zones_ = start.zones;
    }
    Outcome solve(const Vector& bound, Solver& solver) {
        const Outcome outcome = solver.solve(bound, traction_, zones_);
        traction_ = solver.traction();
        zones_ = solver.zones();
        is_regular_ = outcome.tangent_exists;
        ++solution_;
        return outcome;
    }
    static void add(const Outcome& before, Outcome& outcome) { outcome.rounds += before.rounds; }

    static Scalar size(const Solver& solver, Index i) { return std::hypot(solver.slip()(i, 0), solver.slip()(i, 1)); }
    static const Vector& sense(const Solver& solver) { return solver.slides(); }

    /// If there is no tangent, the derivatives are those without slip.
    void linearise(Solver& solver) {
        if (revision_ == solution_) return;
        revision_ = solution_;
        CombinedEquations<Scalar>& equations = solver.equations();
        count_ = is_regular_ ? equations.slipping_count() : 0;
        for (Index k = 0; k < count_; ++k) slipping_[static_cast<std::size_t>(k)] = equations.slipping(k);
        coupling_.leftCols(count_).setZero();
        if (is_regular_) equations.couple(coupling_);
    }
    const MatrixX<Scalar>& by_traction() const { return coupling_; }
    Index slipping_count() const { return count_; }
    Index slipping(Index k) const { return slipping_[static_cast<std::size_t>(k)]; }
    unsigned long revision() const { return revision_; }

    void change_size(const Solver& solver, const Vectors& change, const Vectors& traction_change, Vector& size_change) {
        solver.multiply(traction_change, slip_change_);
        slip_change_ += change;
        size_change = -slip_change_.cwiseProduct(solver.against_slip()).rowwise().sum();
    }

private:
    Vectors traction_, slip_change_;
    std::vector<Zone> zones_;
    MatrixX<Scalar> coupling_;
    std::vector<Index> slipping_;
    Index count_ = 0;
    bool is_regular_ = false;
    unsigned long solution_ = 0, revision_ = 0;
};

}  // namespace rollbem::detail
