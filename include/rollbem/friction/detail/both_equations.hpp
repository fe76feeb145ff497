// The linear equations of a Newton step for friction in two directions: elements that stick, elements that slip.
// The result depends on the arguments alone, to the last bit, never on what was solved before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../detail/length.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "released_equations.hpp"
#include "slip_turn.hpp"
#include "stick_equations.hpp"

namespace rollbem::detail {

/// The zones assumed in a Newton step. An element sticks, or slips, or has no pressure and does neither.
template <class Scalar>
struct BothPartition {
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;

    explicit BothPartition(Index n)
        : stick(Vector::Ones(n)), slide(Vector::Zero(n)), stiffness(Vector::Zero(n)), direction(Vectors::Zero(n, 2)) {}

    void let_stick(Index i) { set(i, 1); }
    void let_go(Index i) { set(i, 0); }
    /// The traction points along (x, y), whose length is `norm`; k is the slip against it over its size.
    void let_slide(Index i, Scalar x, Scalar y, Scalar norm, Scalar k) {
        stick[i] = 0;
        slide[i] = 1;
        direction(i, 0) = x / norm;
        direction(i, 1) = y / norm;
        // finite, however small the bound
        stiffness[i] = (std::min)(k, (std::numeric_limits<Scalar>::max)() / 1000);
    }

    /// Zone from the natural map, (x, y) = p - reach s. `margin`: round-off relative to the bound.
    void place(Index i, Scalar x, Scalar y, Scalar bound, Scalar reach, Scalar margin) {
        const Scalar norm = length(x, y);
        if (bound == 0) {
            let_go(i);
        } else if (norm > (1 + margin) * bound) {
            let_slide(i, x, y, norm, (norm - bound) / (bound * reach));
        } else {
            let_stick(i);
        }
    }

    /// Whether tractions and slip satisfy all conditions, to `margin` relative to each bound and to `creep` in the
    /// slip.
    bool holds(const Vector& bound, const Vectors& p, const Vectors& s, Scalar margin, Scalar creep) const {
        for (Index i = 0; i < bound.size(); ++i) {
            const Scalar x = p(i, 0), y = p(i, 1), u = s(i, 0), v = s(i, 1), norm = length(x, y);
            if (stick[i] != 0) {
                if (!(norm <= (1 + margin) * bound[i])) return false;
                if (!(length(u, v) <= creep)) return false;
            } else if (slide[i] != 0) {
                if (!(std::abs(norm - bound[i]) <= margin * bound[i])) return false;
                if (!(std::abs(x * v - y * u) <= creep * bound[i])) return false;
                if (!(x * u + y * v <= creep * bound[i])) return false;
            }
        }
        return true;
    }

    Vector stick, slide;  // 1 for the elements that do
    Vector stiffness;     // of elements that slip; 0 for others, as is the direction
    Vectors direction;

private:
    void set(Index i, Scalar sticks) {
        stick[i] = sticks;
        slide[i] = 0;
        direction.row(i).setZero();
        stiffness[i] = 0;
    }
};

/// Sum of |p - P(p - reach s)| over the elements with pressure, P the projection onto the circle of the bound: zero at
/// solutions alone.
template <class Scalar>
Scalar natural_residual(const VectorX<Scalar>& bound, const VectorX<Scalar>& reach, const ElementVectors<Scalar>& p,
                        const ElementVectors<Scalar>& s) {
    Scalar sum = 0;
    for (Eigen::Index i = 0; i < bound.size(); ++i) {
        if (bound[i] == 0) continue;
        const Scalar x = p(i, 0) - reach[i] * s(i, 0), y = p(i, 1) - reach[i] * s(i, 1), norm = length(x, y);
        const Scalar share = norm > bound[i] ? bound[i] / norm : Scalar(1);
        sum += length(p(i, 0) - share * x, p(i, 1) - share * y);
    }
    return sum;
}

/// Finds the change dp of tractions that satisfies, with ds = M dp,
/// - where elements stick:  s + ds = 0;
/// - where they slip:       dp = tau t and t.R(s + ds) + k tau = 0, t the unit vector across the traction, R the turn
///                          of the element's slip, if slip is turned;
/// - where they are free:   dp = 0.
/// If each direction has its own matrix M, the elements that stick are eliminated one direction at a time; LU with
/// pivoting then gives the tau. If the directions are coupled, the equations are solved from full adhesion, or all
/// together if that is less work. All equations are factorised together as well if those of the sticking elements alone
/// are singular, as for a leading element without influence on its own slip. All memory is allocated by the
/// constructor.
template <class Scalar>
class BothEquations {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Matrix = MatrixX<Scalar>;

    /// `coupled`: traction in one direction causes slip in the other, too. Without `matrices` only exchange_factors()
    /// gives it factors.
    explicit BothEquations(Index n, bool coupled = false, bool matrices = true)
        : size_(n),
          coupled_(coupled),
          side_{Side(coupled ? 0 : n), Side(coupled ? 0 : n)},
          released_(coupled ? n : 0),
          factors_(coupled ? 0 : n, coupled ? 0 : n),
          whole_(2 * n, 2 * n),
          right_(2 * n),
          directions_(n),
          tangent_(ElementVectors<Scalar>::Zero(n, 2)),
          test_(ElementVectors<Scalar>::Zero(n, 2)),
          slip_(ElementVectors<Scalar>::Zero(n, 2)),
          across_(n, 2),
          change_(ElementVectors<Scalar>::Zero(n, 2)),
          slipping_(n),
          sticking_(n),
          eliminated_for_(n),
          swaps_(static_cast<std::size_t>(2 * n)) {
        for (Matrix& block : block_) block.resize(coupled && matrices ? n : 0, coupled && matrices ? n : 0);
    }

    Index size() const { return size_; }
    bool coupled() const { return coupled_; }
    /// M: slip in direction `slip` (0 longitudinal, 1 lateral) by tractions in direction `by`; both the same unless
    /// coupled.
    const Matrix& matrix(std::size_t slip, std::size_t by) const {
        return coupled_ ? block_[2 * slip + by] : side_[slip].sticking.matrix();
    }
    /// The same, to be filled again: the factors become invalid.
    Matrix& new_matrix(std::size_t slip, std::size_t by) {
        released_.forget();
        return coupled_ ? block_[2 * slip + by] : side_[slip].sticking.new_matrix();
    }
    /// Exchanges the factors for those kept in `other`; M stays.
    void exchange_factors(BothEquations& other) {
        for (std::size_t d = 0; d < 2; ++d) side_[d].exchange_factors(other.side_[d]);
        if (coupled_) released_.exchange_factors(other.released_);
        factors_.swap(other.factors_);
        whole_.swap(other.whole_);
        tangent_.swap(other.tangent_);
        test_.swap(other.test_);
        slipping_.swap(other.slipping_);
        sticking_.swap(other.sticking_);
        eliminated_for_.swap(other.eliminated_for_);
        swaps_.swap(other.swaps_);
        std::swap(way_, other.way_);
        eliminated_revisions_.swap(other.eliminated_revisions_);
    }
    /// s = M p
    void multiply(const ElementVectors<Scalar>& p, ElementVectors<Scalar>& s) const {
        for (std::size_t d = 0; d < 2; ++d) {
            s.col(column(d)).noalias() = matrix(d, d) * p.col(column(d));
            if (coupled_) s.col(column(d)).noalias() += matrix(d, 1 - d) * p.col(column(1 - d));
        }
    }

    /// Factorises for the elements that stick and slip; the stiffness is k. False if the equations are singular to
    /// working precision.
    bool factorise(const BothPartition<Scalar>& part, const SlipTurn<Scalar>& turn);

    /// Takes the directions of traction and slip from `part`, with the same elements slipping, but keeps the factors.
    void aim(const BothPartition<Scalar>& part, const SlipTurn<Scalar>& turn) {
        for (Index k = 0; k < slipping_.count; ++k) {
            tangent_(k, 0) = -part.direction(slipping_[k], 1);
            tangent_(k, 1) = part.direction(slipping_[k], 0);
        }
        test_ = tangent_;
        for (Index k = 0; k < slipping_.count; ++k) turn.take_back(slipping_[k], test_, k);
        if (way_ != Way::released) return;
        for (Index k = 0; k < slipping_.count; ++k) released_.aim(k, tangent_.row(k), test_.row(k));
    }

    /// dp for the slip s.
    void solve(const ElementVectors<Scalar>& s, ElementVectors<Scalar>& change);
    /// The same to working precision for `part`, at which the factors have been aimed; those of coupled directions may
    /// be of an earlier Newton step near the solution. `slip_change`, unless null, becomes ds.
    void solve(const ElementVectors<Scalar>& s, const BothPartition<Scalar>& part, ElementVectors<Scalar>& change,
               ElementVectors<Scalar>* slip_change);

    /// The same without products with M; the tractions of slipping elements also grow by `share` times `sizes`. Null:
    /// no slip, no growth. `slip_change`, unless null, becomes s + ds. False if these factors cannot give that.
    bool respond(const ElementVectors<Scalar>* s, const Vector* sizes, Scalar share, ElementVectors<Scalar>& change,
                 ElementVectors<Scalar>* slip_change) {
        if (!knows_all_slip()) return false;
        change.setZero();
        solve_reduced(s, sizes, share, change, slip_change);
        return true;
    }

    /// Whether the present factors are for the same elements that slip.
    bool slips_as(const BothPartition<Scalar>& part) const {
        Index slips = 0;
        for (Index k = 0; k < slipping_.count; ++k) slips += part.slide[slipping_[k]] != 0 ? 1 : 0;
        return slips == slipping_.count && static_cast<Scalar>(slips) == part.slide.sum();
    }
    /// The elements that slip in the present factors.
    Index slipping_count() const { return slipping_.count; }
    Index slipping(Index k) const { return slipping_[k]; }

    /// Derivatives with respect to the size of tractions: entry (i, k) becomes the slip of element i, against its
    /// present slip, due to a unit increase of the traction of the k-th slipping element, the sizes of the others
    /// fixed. Rows of elements that do not slip are left unchanged. With `turning`, those entries hold before what the
    /// increase adds to the slip across, by turning it.
    void couple(Matrix& coupling, bool turning = false) {
        const Index count = slipping_.count;
        if (way_ == Way::reduced) {
            Corner along = corner(0, size_), turn = corner(size_, 0);
            for (Index k = 0; turning && k < count; ++k) {
                for (Index l = 0; l < count; ++l) turn(l, k) = coupling(slipping_[l], k);
            }
            couple_reduced(turning);
            for (Index k = 0; k < count; ++k) {
                for (Index l = 0; l < count; ++l) coupling(slipping_[l], k) = along(l, k);
            }
            return;
        }
        for (Index k = 0; k < count; ++k) {
            for (Index l = 0; l < count; ++l) right_[l] = turning ? coupling(slipping_[l], k) : Scalar(0);
            couple_whole(k);
            for (Index l = 0; l < count; ++l) coupling(slipping_[l], k) = right_[l];
        }
    }
    /// Calls use(i, ds) with the change of slip due to the same increase for each element i that slips, as in `part`.
    template <class Use>
    void couple(const BothPartition<Scalar>& part, ElementVectors<Scalar>& slip_change, const Use& use) {
        const Index count = slipping_.count;
        const bool is_reduced = knows_all_slip();
        if (is_reduced) couple_reduced(false);
        const Corner along = corner(0, size_), turn = corner(size_, 0);
        slip_change.setZero();
        for (Index k = 0; k < count; ++k) {
            if (!is_reduced) {
                right_.head(count).setZero();
                couple_whole(k);
                use(slipping_[k], slip_);
                continue;
            }
            for (Index l = 0; l < count; ++l) {
                const Scalar across = part.stiffness[slipping_[l]] * turn(l, k);
                for (Index d = 0; d < 2; ++d) {
                    slip_change(slipping_[l], d) =
                        against(l, static_cast<std::size_t>(d)) * along(l, k) + across * test_(l, d);
                }
            }
            use(slipping_[k], slip_change);
        }
    }

private:
    enum class Way : unsigned char { reduced, whole, released };

    // Some of the elements, in storage for all of them, which copies keep.
    struct List {
        explicit List(Index n) : elements(static_cast<std::size_t>(n)) {}

        void take(const Vector& chosen) {
            count = 0;
            for (Index i = 0; i < chosen.size(); ++i) {
                if (chosen[i] != 0) elements[static_cast<std::size_t>(count++)] = i;
            }
        }
        void swap(List& other) {
            elements.swap(other.elements);
            std::swap(count, other.count);
        }
        Index operator[](Index k) const { return elements[static_cast<std::size_t>(k)]; }
        friend bool operator==(const List& one, const List& other) {
            return one.count == other.count &&
                   std::equal(one.elements.begin(), one.elements.begin() + one.count, other.elements.begin());
        }

        std::vector<Index> elements;
        Index count = 0;
    };

    // One direction. With S the elements that stick and L those that slip:
    struct Side {
        explicit Side(Index n)
            : sticking(n), answer(n, n), reduced(n, n), across(n, n), stuck(n), amplitude(n), induced(n) {}

        // influence of slipping elements on sticking ones, and through them on each other
        void eliminate(const List& slipping) {
            const Index sticks = sticking.count(), slips = slipping.count;
            const Matrix& M = sticking.matrix();
            for (Index k = 0; k < sticks; ++k) {
                const Index own = sticking.listed(k);
                for (Index l = 0; l < slips; ++l) across(l, k) = M(slipping[l], own);
            }
            for (Index l = 0; l < slips; ++l) {
                const Index own = slipping[l];
                for (Index k = 0; k < sticks; ++k) answer(k, l) = M(sticking.listed(k), own);
                for (Index k = 0; k < slips; ++k) reduced(k, l) = M(slipping[k], own);
                sticking.solve_listed(answer.col(l).head(sticks));
                reduced.col(l).head(slips).noalias() -=
                    across.topLeftCorner(slips, sticks) * answer.col(l).head(sticks);
            }
        }
        // dp of S at fixed tractions of L, and the slip of L then; null: s is zero
        void start(const Scalar* s, const List& slipping) {
            const Index sticks = sticking.count(), slips = slipping.count;
            amplitude.head(slips).setZero();
            if (s == nullptr) {
                stuck.head(sticks).setZero();
                induced.head(slips).setZero();
                return;
            }
            for (Index k = 0; k < sticks; ++k) stuck[k] = -s[sticking.listed(k)];
            sticking.solve_listed(stuck.head(sticks));
            for (Index k = 0; k < slips; ++k) induced[k] = s[slipping[k]];
            induced.head(slips).noalias() += across.topLeftCorner(slips, sticks) * stuck.head(sticks);
        }
        // amplitudes of L grow by `more`; the slip that this induces on L
        template <class Column>
        void grow(const Column& more, Index slips) {
            amplitude.head(slips) += more;
            induced.head(slips).noalias() += reduced.topLeftCorner(slips, slips) * more;
        }
        void finish(Index slips) {
            const Index sticks = sticking.count();
            stuck.head(sticks).noalias() -= answer.topLeftCorner(sticks, slips) * amplitude.head(slips);
        }
        void exchange_factors(Side& other) {
            sticking.exchange_factors(other.sticking);
            answer.swap(other.answer);
            reduced.swap(other.reduced);
            across.swap(other.across);
        }

        StickEquations<Scalar> sticking;
        Matrix answer;   // M(S, S)^-1 M(S, L)
        Matrix reduced;  // M(L, L) - M(L, S) M(S, S)^-1 M(S, L)
        Matrix across;   // M(L, S)
        Vector stuck, amplitude, induced;
    };

    // Reduced equations give no slip of elements without pressure.
    bool knows_all_slip() const { return way_ == Way::reduced && side_[0].sticking.count() + slipping_.count == size_; }
    static Index column(std::size_t direction) { return static_cast<Index>(direction); }
    bool eliminate(const Vector& stick) {
        for (Side& side : side_) {
            if (!side.sticking.factorise(stick)) return false;
        }
        const std::array<unsigned long, 2> revisions{side_[0].sticking.revision(), side_[1].sticking.revision()};
        if (revisions == eliminated_revisions_ && slipping_ == eliminated_for_) return true;
        for (Side& side : side_) side.eliminate(slipping_);
        eliminated_for_ = slipping_;
        eliminated_revisions_ = revisions;
        return true;
    }

    // If it is less work than all equations together.
    bool release(const BothPartition<Scalar>& part) {
        Index sticks = 0;
        for (Index i = 0; i < size_; ++i) sticks += part.stick[i] != 0 ? 1 : 0;
        const Index slips = slipping_.count, frees = size_ - sticks - slips;
        if (2 * (slips + frees) > 2 * sticks + slips) return false;
        const auto fill = [&](Matrix& whole) { whole << block_[0], block_[1], block_[2], block_[3]; };
        if (!released_.find_inverse(fill)) return false;
        released_.clear();
        for (Index k = 0; k < slips; ++k) {
            released_.add(slipping_[k], tangent_.row(k), test_.row(k), part.stiffness[slipping_[k]]);
        }
        const Eigen::Matrix<Scalar, 1, 2> any(1, 0);
        for (Index i = 0; frees > 0 && i < size_; ++i) {
            if (part.stick[i] == 0 && part.slide[i] == 0) {
                released_.add(i, any, any, std::numeric_limits<Scalar>::infinity());
            }
        }
        return true;
    }

    bool factorise_reduced(const Vector& stiffness) {
        const Index count = slipping_.count;
        const auto test = [&](Index d) { return test_.col(d).head(count); };
        for (Index k = 0; k < count; ++k) {
            factors_.col(k).head(count) = tangent_(k, 0) * test(0).cwiseProduct(side_[0].reduced.col(k).head(count)) +
                                          tangent_(k, 1) * test(1).cwiseProduct(side_[1].reduced.col(k).head(count));
            factors_(k, k) += stiffness[slipping_[k]];
        }
        return factorise_first(factors_, count);
    }

    // See respond().
    void solve_reduced(const ElementVectors<Scalar>* s, const Vector* sizes, Scalar share,
                       ElementVectors<Scalar>& change, ElementVectors<Scalar>* slip_change) {
        const Index count = slipping_.count;
        const auto grow = [&](std::size_t d, const auto& directions) {
            directions_.head(count) = directions.head(count).cwiseProduct(right_.head(count));
            side_[d].grow(directions_.head(count), count);
        };
        for (std::size_t d = 0; d < 2; ++d)
            side_[d].start(s == nullptr ? nullptr : s->col(column(d)).data(), slipping_);
        if (sizes != nullptr) {
            for (Index k = 0; k < count; ++k) right_[k] = share * (*sizes)[slipping_[k]];
            grow(0, tangent_.col(1));
            right_.head(count) = -right_.head(count);
            grow(1, tangent_.col(0));
        }
        for (Index k = 0; k < count; ++k) {
            right_[k] = -(test_(k, 0) * side_[0].induced[k] + test_(k, 1) * side_[1].induced[k]);
        }
        solve_in_place<Scalar>(factors_.topLeftCorner(count, count), swaps_.data(), right_.head(count));
        if (slip_change != nullptr) slip_change->setZero();
        for (std::size_t d = 0; d < 2; ++d) {
            Side& side = side_[d];
            if (slip_change == nullptr) {
                side.amplitude.head(count) += tangent_.col(column(d)).head(count).cwiseProduct(right_.head(count));
            } else {
                grow(d, tangent_.col(column(d)));
                for (Index k = 0; k < count; ++k) (*slip_change)(slipping_[k], column(d)) = side.induced[k];
            }
            for (Index k = 0; k < count; ++k) change(slipping_[k], column(d)) = side.amplitude[k];
            side.finish(count);
            for (Index k = 0; k < side.sticking.count(); ++k) {
                change(side.sticking.listed(k), column(d)) = side.stuck[k];
            }
        }
    }

    // Unknowns and equations: sticking elements longitudinal, then lateral, then slipping ones.
    bool factorise_whole(const Vector& stick, const Vector& stiffness) {
        sticking_.take(stick);
        const Index sticks = sticking_.count, slips = slipping_.count, size = 2 * sticks + slips;
        whole_.topLeftCorner(size, size).setZero();
        for (std::size_t d = 0; d < 2; ++d) {
            for (std::size_t by = 0; by < 2; ++by) {
                if (by == d || coupled_) add_whole(d, by);
            }
        }
        for (Index k = 0; k < slips; ++k) whole_(2 * sticks + k, 2 * sticks + k) += stiffness[slipping_[k]];
        return factorise_first(whole_, size);
    }

    // The slip in direction d by tractions in direction `by`.
    void add_whole(std::size_t d, std::size_t by) {
        const Index sticks = sticking_.count, slips = slipping_.count;
        const Index row = column(d) * sticks, first = column(by) * sticks, last = 2 * sticks;
        for (Index k = 0; k < sticks; ++k) {
            const auto influence = matrix(d, by).col(sticking_[k]);
            for (Index j = 0; j < sticks; ++j) whole_(row + j, first + k) = influence[sticking_[j]];
            for (Index j = 0; j < slips; ++j) {
                whole_(last + j, first + k) += test_(j, column(d)) * influence[slipping_[j]];
            }
        }
        for (Index k = 0; k < slips; ++k) {
            const auto influence = matrix(d, by).col(slipping_[k]);
            const Scalar share = tangent_(k, column(by));
            for (Index j = 0; j < sticks; ++j) whole_(row + j, last + k) += share * influence[sticking_[j]];
            for (Index j = 0; j < slips; ++j) {
                whole_(last + j, last + k) += share * test_(j, column(d)) * influence[slipping_[j]];
            }
        }
    }

    void solve_whole(const ElementVectors<Scalar>& s, ElementVectors<Scalar>& change) {
        const Index sticks = sticking_.count, slips = slipping_.count, size = 2 * sticks + slips;
        for (Index k = 0; k < sticks; ++k) {
            right_[k] = -s(sticking_[k], 0);
            right_[sticks + k] = -s(sticking_[k], 1);
        }
        for (Index k = 0; k < slips; ++k) {
            const Index i = slipping_[k];
            right_[2 * sticks + k] = -(test_(k, 0) * s(i, 0) + test_(k, 1) * s(i, 1));
        }
        solve_in_place<Scalar>(whole_.topLeftCorner(size, size), swaps_.data(), right_.head(size));
        for (Index d = 0; d < 2; ++d) {
            for (Index k = 0; k < sticks; ++k) change(sticking_[k], d) = right_[d * sticks + k];
            for (Index k = 0; k < slips; ++k) change(slipping_[k], d) = tangent_(k, d) * right_[2 * sticks + k];
        }
    }

    // Unit vector along the traction of the k-th element that slips.
    Scalar along(Index k, std::size_t direction) const { return direction == 0 ? tangent_(k, 1) : -tangent_(k, 0); }
    // Unit vector against the slip of that element: along its traction, turned back.
    Scalar against(Index k, std::size_t direction) const { return direction == 0 ? test_(k, 1) : -test_(k, 0); }

    // A part of whole_, which is not in use, for the elements that slip.
    using Corner = Eigen::Block<Matrix>;
    Corner corner(Index row, Index column) { return whole_.block(row, column, slipping_.count, slipping_.count); }

    // couple() for all columns: into corner(0, n) the slip against the present one, into corner(n, 0) minus the change
    // of tractions across. If `adds`, the latter holds before what is added to the slip across.
    void couple_reduced(bool adds) {
        const Index count = slipping_.count;
        Corner across = corner(0, 0), along = corner(0, size_), turn = corner(size_, 0);
        if (!adds) turn.setZero();
        for (Index k = 0; k < count; ++k) {
            for (Index l = 0; l < count; ++l) {
                const Scalar x = side_[0].reduced(l, k), y = side_[1].reduced(l, k);
                const Scalar u = x * this->along(k, 0), v = y * this->along(k, 1);
                across(l, k) = against(l, 0) * x * tangent_(k, 0) + against(l, 1) * y * tangent_(k, 1);
                along(l, k) = against(l, 0) * u + against(l, 1) * v;
                turn(l, k) += test_(l, 0) * u + test_(l, 1) * v;
            }
        }
        solve_columns_in_place<Scalar>(factors_.topLeftCorner(count, count), swaps_.data(), turn);
        for (Index k = 0; k < count; ++k) along.col(k).noalias() -= across * turn.col(k);
    }
    void couple_whole(Index k) {
        change_.setZero();
        for (std::size_t d = 0; d < 2; ++d) change_(slipping_[k], column(d)) = along(k, d);
        multiply(change_, slip_);
        across_ = slip_;
        for (Index l = 0; l < slipping_.count; ++l) across_.row(slipping_[l]) += right_[l] * test_.row(l);
        solve(across_, change_);
        multiply(change_, across_);
        slip_ += across_;
        for (Index l = 0; l < slipping_.count; ++l) {
            right_[l] = against(l, 0) * slip_(slipping_[l], 0) + against(l, 1) * slip_(slipping_[l], 1);
        }
    }

    // The leading part of a matrix. False if it is singular to working precision.
    bool factorise_first(Matrix& A, Index count) {
        factorise_in_place<Scalar>(A.topLeftCorner(count, count), swaps_.data());
        for (Index k = 0; k < count; ++k) {
            if (!is_finite(A(k, k)) || A(k, k) == 0) return false;
        }
        return true;
    }

    Index size_;
    bool coupled_;
    std::array<Side, 2> side_;     // empty if coupled
    std::array<Matrix, 4> block_;  // empty unless coupled
    ReleasedEquations<Scalar> released_;
    Matrix factors_, whole_;
    Vector right_, directions_;
    ElementVectors<Scalar> tangent_;  // t of the elements that slip, in their order
    ElementVectors<Scalar> test_;     // R^-1 t of the same: the component of the slip that their equations take
    ElementVectors<Scalar> slip_, across_, change_;
    List slipping_, sticking_, eliminated_for_;
    std::vector<Index> swaps_;
    Way way_ = Way::whole;
    std::array<unsigned long, 2> eliminated_revisions_{0, 0};  // 0: of no matrix yet
};

template <class Scalar>
bool BothEquations<Scalar>::factorise(const BothPartition<Scalar>& part, const SlipTurn<Scalar>& turn) {
    slipping_.take(part.slide);
    aim(part, turn);
    if (coupled_) {
        way_ = release(part) ? Way::released : Way::whole;
        if (way_ == Way::released) return released_.factorise();
    } else {
        way_ = eliminate(part.stick) ? Way::reduced : Way::whole;
    }
    return way_ == Way::whole ? factorise_whole(part.stick, part.stiffness) : factorise_reduced(part.stiffness);
}

template <class Scalar>
void BothEquations<Scalar>::solve(const ElementVectors<Scalar>& s, ElementVectors<Scalar>& change) {
    change.setZero();
    if (way_ == Way::whole) solve_whole(s, change);
    if (way_ == Way::reduced) solve_reduced(&s, nullptr, 0, change, nullptr);
    if (way_ == Way::released) released_.solve(s, change);
}

template <class Scalar>
void BothEquations<Scalar>::solve(const ElementVectors<Scalar>& s, const BothPartition<Scalar>& part,
                                  ElementVectors<Scalar>& change, ElementVectors<Scalar>* slip_change) {
    if (way_ == Way::released) {
        released_.solve(s, part.stiffness, change, slip_change);
        return;
    }
    solve(s, change);
    if (!coupled_) {
        if (slip_change != nullptr) multiply(change, *slip_change);
        return;
    }
    multiply(change, change_);
    Scalar share = 1;
    for (int round = 0; round < 4 && share > Scalar(1e-5); ++round) {
        across_ = (s + change_).array().colwise() * part.stick.array();
        for (Index k = 0; k < slipping_.count; ++k) {
            const Index i = slipping_[k];
            Scalar rest = 0;
            for (Index d = 0; d < 2; ++d) {
                rest += test_(k, d) * (s(i, d) + change_(i, d)) + part.stiffness[i] * tangent_(k, d) * change(i, d);
            }
            across_.row(i) = rest * test_.row(k);
        }
        solve(across_, slip_);
        change += slip_;
        multiply(change, change_);
        share = slip_.norm() / change.norm();
    }
    if (slip_change != nullptr) *slip_change = change_;
}

}  // namespace rollbem::detail
