// How fast the elements of an ActiveSet slip, and what their bounds do to that: FallingSet in one direction.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../types.hpp"
#include "../state.hpp"
#include "active_set.hpp"

namespace rollbem::detail {

/// What FallingSet asks of the solver behind it. Everything is allocated by the constructor.
template <class Scalar_>
class ActiveSetSlip {
public:
    using Scalar = Scalar_;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Solver = ActiveSet<Scalar>;
    using Outcome = typename Solver::Outcome;
    using Start = std::vector<Zone>;      ///< where a solution is sought from
    using Vectors = Vector;               ///< constants of the equations, tractions
    static constexpr int parameters = 3;  ///< tangents that a first stage carries to the second: see TangentBy

    explicit ActiveSetSlip(Index n)
        : zones_(static_cast<std::size_t>(n), Zone::stick),
          by_traction_(n, n),
          slipping_(static_cast<std::size_t>(n)),
          unit_(n),
          response_(n) {}

    static Vectors zero(Index n) { return Vector::Zero(n); }

    void begin(const Start& zones) { zones_ = zones; }
    /// Each solution starts from the one before.
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
    /// 0 where an element sticks, else a sign: |s_i| changes by -sense_i by_traction(i, k) sense_l with the bound of l,
    /// the k-th element that slips.
    static const Vector& sense(const Solver& solver) { return solver.signs(); }

    /// Finds by_traction(), while elements stick or slip as in the solver's solution.
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
    /// by_traction() is the same as long as this is.
    unsigned long revision() const { return revision_; }

    /// The change of |s| by that of the constants and of the tractions.
    static void change_size(const Solver& solver, const Vector& change, const Vector& traction_change,
                            Vector& size_change) {
        size_change = change;
        size_change.noalias() += solver.matrix() * traction_change;
        size_change.array() *= solver.signs().array();
    }

private:
    static constexpr unsigned long never = std::numeric_limits<unsigned long>::max();

    Start zones_;
    MatrixX<Scalar> by_traction_;
    std::vector<Index> slipping_;
    Index count_ = 0;
    unsigned long revision_ = never;
    Vector unit_, response_;
};

}  // namespace rollbem::detail
