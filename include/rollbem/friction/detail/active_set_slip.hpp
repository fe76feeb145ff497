// The slip of the elements of an ActiveSet and its dependence on the bounds: for FallingSet in one direction.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "active_set.hpp"

namespace rollbem::detail {

/// The interface between FallingSet and its solver. All memory is allocated by the constructor.
template <class Scalar_>
class ActiveSetSlip {
public:
    using Scalar = Scalar_;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Solver = ActiveSet<Scalar>;
    using Outcome = typename Solver::Outcome;
    using Start = SolutionStart<1, Scalar>;
    using Vectors = Vector;  ///< constants of the equations, tractions
    static constexpr int directions = 1;

    explicit ActiveSetSlip(Index n)
        : zones_(static_cast<std::size_t>(n), Zone::stick),
          by_traction_(n, n),
          slipping_(static_cast<std::size_t>(n)),
          unit_(n),
          response_(n) {}

    static Vectors zero(Index n) { return Vector::Zero(n); }

    void begin(const Start& start) { zones_ = start.zones; }
    /// Each solution starts from the previous one.
    Outcome solve(const Vector& bound, Solver& solver) {
        const Outcome outcome = solver.solve(bound, zones_);
        zones_ = solver.zones();
        return outcome;
    }
    static void add(const Outcome& before, Outcome& outcome) {
        outcome.rounds += before.rounds;
        outcome.pivots += before.pivots;
    }

    /// |s| of an element.
    static Scalar size(const Solver& solver, Index i) {
        return std::max(Scalar(0), solver.signs()[i] * solver.slip()[i]);
    }
    /// 0 for a sticking element, else a sign: d|s_i| / d bound_l = -sense_i by_traction(i, k) sense_l, where l is the
    /// k-th slipping element.
    static const Vector& sense(const Solver& solver) { return solver.signs(); }

    /// Computes by_traction() for the zones of the solver's solution.
    void linearise(Solver& solver) {
        if (revision_ == solver.revision()) return;
        revision_ = solver.revision();
        count_ = 0;
        for (Index j = 0; j < unit_.size(); ++j) {
            if (solver.signs()[j] == 0) continue;
            unit_ = solver.matrix().col(j);
            solver.respond(unit_, response_);
            unit_.noalias() += solver.matrix() * response_;
            by_traction_.col(count_) = unit_;
            slipping_[static_cast<std::size_t>(count_++)] = j;
        }
    }
    const MatrixX<Scalar>& by_traction() const { return by_traction_; }
    Index slipping_count() const { return count_; }
    Index slipping(Index k) const { return slipping_[static_cast<std::size_t>(k)]; }
    /// by_traction() is the same as long as this number is.
    unsigned long revision() const { return revision_; }

    /// The change of |s| caused by changes of the constants and the tractions.
    static void change_size(const Solver& solver, const Vector& change, const Vector& traction_change,
                            Vector& size_change) {
        size_change = change;
        size_change.noalias() += solver.matrix() * traction_change;
        size_change.array() *= solver.signs().array();
    }

private:
    static constexpr unsigned long never = std::numeric_limits<unsigned long>::max();

    std::vector<Zone> zones_;
    MatrixX<Scalar> by_traction_;
    std::vector<Index> slipping_;
    Index count_ = 0;
    unsigned long revision_ = never;
    Vector unit_, response_;
};

}  // namespace rollbem::detail
