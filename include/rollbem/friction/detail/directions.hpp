// What distinguishes one direction of creepage from two: the solver for stick and slip, and the blocks of the matrices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../scene/creepage.hpp"
#include "../../system/element_blocks.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "active_set.hpp"
#include "stick_slip.hpp"

namespace rollbem::detail {

/// The slip of the elements of a solver and its derivatives with respect to their bounds, the interface between
/// SlipDependentSet and solvers: what both numbers of directions have in common. All memory is allocated by the
/// constructors.
template <class Scalar_>
class SlippingElements {
public:
    using Scalar = Scalar_;
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;

    /// d|s_i| / d bound_l = -sense_i by_traction(i, k) sense_l, where l is the k-th slipping element.
    const MatrixX<Scalar>& by_traction() const { return by_traction_; }
    Index slipping_count() const { return count_; }
    Index slipping(Index k) const { return slipping_[static_cast<std::size_t>(k)]; }
    /// by_traction() is the same as long as this number is.
    unsigned long revision() const { return revision_; }

protected:
    explicit SlippingElements(Index n)
        : zones_(static_cast<std::size_t>(n), Zone::stick),
          by_traction_(MatrixX<Scalar>::Zero(n, n)),
          slipping_(static_cast<std::size_t>(n)) {}

    std::vector<Zone> zones_;
    MatrixX<Scalar> by_traction_;
    std::vector<Index> slipping_;
    Index count_ = 0;
    unsigned long revision_ = (std::numeric_limits<unsigned long>::max)();
};

template <class Scalar>
class ActiveSetSlip : public SlippingElements<Scalar> {
public:
    using typename SlippingElements<Scalar>::Index, typename SlippingElements<Scalar>::Vector;
    using Solver = ActiveSet<Scalar>;
    using Outcome = typename Solver::Outcome;
    using Start = SolutionStart<1, Scalar>;
    using Vectors = Vector;  ///< constants of the equations, tractions
    static constexpr int directions = 1;

    explicit ActiveSetSlip(Index n) : SlippingElements<Scalar>(n), unit_(n), response_(n) {}

    static Vectors zero(Index n) { return Vector::Zero(n); }

    void begin(const Start& start) { this->zones_ = start.zones; }
    /// Each solution starts from the previous one.
    Outcome solve(const Vector& bound, Solver& solver) {
        const Outcome outcome = solver.solve(bound, this->zones_);
        this->zones_ = solver.zones();
        return outcome;
    }
    static void add(const Outcome& before, Outcome& outcome) {
        outcome.rounds += before.rounds;
        outcome.pivots += before.pivots;
    }

    /// |s| of an element.
    static Scalar size(const Solver& solver, Index i) {
        return (std::max)(Scalar(0), solver.signs()[i] * solver.slip()[i]);
    }
    /// 0 for a sticking element, else a sign.
    static const Vector& sense(const Solver& solver) { return solver.signs(); }

    /// Computes by_traction() for the zones of the solver's solution.
    void linearise(Solver& solver, bool) {
        if (this->revision_ == solver.revision()) return;
        this->revision_ = solver.revision();
        this->count_ = 0;
        for (Index j = 0; j < unit_.size(); ++j) {
            if (solver.signs()[j] == 0) continue;
            unit_ = solver.matrix().col(j);
            solver.respond(unit_, response_);
            unit_.noalias() += solver.matrix() * response_;
            this->by_traction_.col(this->count_) = unit_;
            this->slipping_[static_cast<std::size_t>(this->count_++)] = j;
        }
    }

    /// The changes of tractions and |s| caused by changes of the constants and, unless null, of the bounds.
    static void respond(Solver& solver, const Vector& change, const Vector* bound_change, Vector& traction_change,
                        Vector& size_change) {
        solver.respond(change, traction_change, bound_change);
        size_change = change;
        size_change.noalias() += solver.matrix() * traction_change;
        size_change.array() *= solver.signs().array();
    }
    /// The change of tractions that follows if the bounds change by `more`, too, which is overwritten.
    static void add_response(Solver& solver, const Vector& change, const Vector* bound_change, Vector& more,
                             Vector& traction_change) {
        if (bound_change != nullptr) more += *bound_change;
        solver.respond(change, traction_change, &more);
    }

private:
    Vector unit_, response_;
};

/// The same for two directions.
template <class Scalar>
class BothSlip : public SlippingElements<Scalar> {
public:
    using typename SlippingElements<Scalar>::Index, typename SlippingElements<Scalar>::Vector;
    using Vectors = ElementVectors<Scalar>;
    using Solver = StickSlip<2, Scalar>;
    using Outcome = typename Solver::Outcome;
    using Start = SolutionStart<2, Scalar>;
    static constexpr int directions = 2;

    explicit BothSlip(Index n)
        : SlippingElements<Scalar>(n), start_(nullptr), compact_(n, n), across_(n, n), aside_(n, n) {}

    static Vectors zero(Index n) { return Vectors::Zero(n, 2); }

    void begin(const Start& start) { start_ = &start; }
    Outcome solve(const Vector& bound, Solver& solver) {
        if (start_ != nullptr) solver.begin(*start_);
        start_ = nullptr;
        const Outcome outcome = solver.solve(bound);
        is_regular_ = outcome.tangent_exists;
        return outcome;
    }
    static void add(const Outcome& before, Outcome& outcome) { outcome.rounds += before.rounds; }

    static Scalar size(const Solver& solver, Index i) { return solver.slip_size(i); }
    static const Vector& sense(const Solver& solver) { return solver.slides(); }

    /// If there is no tangent, the derivatives are those without slip. Angles of turned slip follow if it has to be
    /// `exact`.
    void linearise(Solver& solver, bool exact) {
        const auto revision =
            static_cast<unsigned long>(2 * solver.revision() + (exact && solver.angles_follow() ? 1 : 0));
        if (this->revision_ == revision) return;
        this->revision_ = revision;
        this->count_ = is_regular_ ? solver.slipping_count() : 0;
        for (Index k = 0; k < this->count_; ++k) this->slipping_[static_cast<std::size_t>(k)] = solver.slipping(k);
        if (!is_regular_) return;
        solver.couple(exact, compact_, across_, aside_);
        this->by_traction_.leftCols(this->count_).setZero();
        for (Index k = 0; k < this->count_; ++k) {
            for (Index l = 0; l < this->count_; ++l) this->by_traction_(this->slipping(l), k) = compact_(l, k);
        }
    }

    static void respond(Solver& solver, const Vectors& change, const Vector* bound_change, Vectors& traction_change,
                        Vector& size_change) {
        solver.respond(change, traction_change, bound_change, 1, &size_change);
    }
    static void add_response(Solver& solver, const Vectors&, const Vector*, const Vector& more,
                             Vectors& traction_change) {
        solver.add_response(more, traction_change);
    }

private:
    const Start* start_;
    MatrixX<Scalar> compact_, across_, aside_;
    bool is_regular_ = false;
};

template <int directions, class Scalar>
struct Directions {
    static_assert(directions == 1 || directions == 2);
    using Solver = ByDirections<directions, ActiveSet<Scalar>, StickSlip<2, Scalar>>;
    using Slip = ByDirections<directions, ActiveSetSlip<Scalar>, BothSlip<Scalar>>;
    using Value = ByDirections<directions, Scalar, Creepage<Scalar>>;
    using System = ElementSystem<Scalar, directions>;
    using Gradient = ByDirections<directions, MatrixX<Scalar>, DirectionBlocks<Scalar>>;  // G'

    static Solver solver(Eigen::Index n, bool coupled) {
        if constexpr (directions == 1) {
            return Solver(n);
        } else {
            return Solver(n, coupled);
        }
    }
};

/// G' of a system.
template <class Scalar>
const MatrixX<Scalar>& gradient(const ElementSystem<Scalar>& system) {
    return system.G_prime();
}
template <class Scalar>
const DirectionBlocks<Scalar>& gradient(const ElementSystem<Scalar, 2>& system) {
    return system.G_prime_blocks();
}

/// Whether tractions along one direction cause slip along the other.
template <class Scalar>
bool is_coupled(const MatrixX<Scalar>&) {
    return false;
}
template <class Scalar>
bool is_coupled(const DirectionBlocks<Scalar>& G_prime) {
    return G_prime[0][1].size() > 0;
}

}  // namespace rollbem::detail
