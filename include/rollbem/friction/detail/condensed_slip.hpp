// The equations of a friction problem in two directions with the sticking elements eliminated: slip of the others as a
// function of their tractions.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"

namespace rollbem::detail {

/// s = M p + c with s_S = 0, where S are the elements that stick and K all others:
///     s_K = d + C p_K,    C = M_KK - M_KS M_SS^-1 M_SK,
/// either by eliminating S, or, if few elements do not stick, from B = M^-1: C = (B_KK)^-1. One matrix of the size of M
/// holds everything. A function of M and the roles alone, to the last bit. All memory is allocated by the constructor.
template <class Scalar>
class CondensedSlip : public EliminatedRoles {
public:
    using Index = Eigen::Index;
    using Vector = VectorX<Scalar>;
    using Vectors = ElementVectors<Scalar>;
    using Matrix = MatrixX<Scalar>;
    using M = SlipMatrix<2, Scalar>;

    /// What the constants c contribute, for one set of roles.
    struct Base {
        explicit Base(Index n) : packed(Vectors::Zero(n, 2)), by_inverse(packed) {}
        /// The constants have changed.
        void forget() { revision = 0, inverse_is_known = false; }

        Vectors packed;      // of each group: S, then K
        Vectors by_inverse;  // -B c, for any roles
        std::uint64_t revision = 0;
        bool inverse_is_known = false;
    };

    explicit CondensedSlip(const M& matrix)
        : EliminatedRoles(matrix.size()),
          depth_(matrix.depth()),
          packed_(matrix.group_size()),
          slip_(matrix.group_size()),
          swaps_(static_cast<std::size_t>(2 * matrix.size())) {
        for (std::size_t g = 0; g < matrix.groups(); ++g) table_[g].resize(matrix.group_size(), matrix.group_size());
    }

    /// Where M_SS is singular, that of a nearby matrix takes its place. False if there is none.
    bool condense(M& matrix, const std::vector<Role>& roles) {
        if (holds(matrix, roles)) return is_usable_;
        lists_.take(roles);
        matrix_revision_ = matrix.revision();
        revision_ = matrix.next_serial();
        by_inverse_ = 2 * lists_.others() <= lists_.size() && !matrix.serves_once() && matrix.find_inverse(table_);
        is_regular_ = is_usable_ = true;
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            by_inverse_ ? release(matrix, g) : eliminate(matrix, g);
        }
        return is_usable_;
    }

    /// For the constants c; null: zero.
    void find_base(const M& matrix, const Vectors* c, Base& base) {
        if (base.revision == revision_) return;
        base.revision = revision_;
        if (c == nullptr) {
            base.packed.setZero();
            return;
        }
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            Eigen::Map<Vector> packed(base.packed.data() + place(g), packed_.size());
            if (!by_inverse_) {
                pack(g, *c, 0, lists_.size(), packed);
                eliminate_vector_in_place<Scalar>(table_[g], swaps(g), depth_ * lists_.sticking(), packed);
                continue;
            }
            if (!base.inverse_is_known) {
                Eigen::Map<Vector> all(base.by_inverse.data() + place(g), packed_.size());
                all.noalias() = matrix.inverse(g) * Eigen::Map<const Vector>(c->data() + place(g), packed_.size());
                all = -all;
            }
            pack(g, base.by_inverse, 0, lists_.size(), packed);
        }
        base.inverse_is_known = base.inverse_is_known || by_inverse_;
    }

    /// The slip of K caused by its tractions.
    void find_slip(const M& matrix, const Base& base, const Vectors& p, Vectors& s) {
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            find_slip(g, base, p);
            unpack(g, slip_, lists_.sticking(), lists_.size(), s);
        }
    }
    /// The same, and the tractions of S; its slip becomes zero.
    void complete(const M& matrix, const Base& base, Vectors& p, Vectors& s) {
        const Index sticking = depth_ * lists_.sticking(), others = depth_ * lists_.others();
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            find_slip(g, base, p);
            slip_.head(sticking).setZero();
            unpack(g, slip_, 0, lists_.size(), s);
            if (sticking == 0) continue;
            if (by_inverse_) {
                stick_by_inverse(matrix, g, base);
            } else {
                packed_.head(sticking).noalias() = table_[g].topRightCorner(sticking, others) * packed_.tail(others);
                packed_.head(sticking) += of_base(g, base).head(sticking);
                substitute_in_place<Scalar>(table_[g], sticking, packed_.head(sticking));
                packed_.head(sticking) = -packed_.head(sticking);
            }
            unpack(g, packed_, 0, lists_.sticking(), p);
        }
    }

    /// X_k . C_kl Y_l of the elements k and l that slide; X and Y have a row for each.
    template <class Target>
    void form(const M&, const Vectors& X, const Vectors& Y, Target&& target) const {
        const Index count = lists_.sliding(), others = lists_.others();
        const auto part = [&](std::size_t g, Index d, Index e, Index l) {
            const Index corner = table_[g].rows() - depth_ * others;
            return table_[g].col(corner + e * others + l).segment(corner + d * others, count);
        };
        const auto x = X.col(0).head(count), y = X.col(1).head(count);
        for (Index l = 0; l < count; ++l) {
            const Scalar u = Y(l, 0), v = Y(l, 1);
            if (depth_ == 1) {
                target.col(l) = u * x.cwiseProduct(part(0, 0, 0, l)) + v * y.cwiseProduct(part(1, 0, 0, l));
            } else {
                target.col(l) = x.cwiseProduct(u * part(0, 0, 0, l) + v * part(0, 0, 1, l)) +
                                y.cwiseProduct(u * part(0, 1, 0, l) + v * part(0, 1, 1, l));
            }
        }
    }

private:
    using Packed = Eigen::Map<const Vector>;

    // Where the unknowns of a group begin in those of all.
    Index place(std::size_t g) const { return static_cast<Index>(g) * lists_.size(); }
    // Of an element in its group.
    Index unpacked(Index i, Index d) const { return depth_ == 1 ? i : d * lists_.size() + i; }
    Index* swaps(std::size_t g) { return swaps_.data() + place(g); }
    Packed of_base(std::size_t g, const Base& base) const {
        return Packed(base.packed.data() + place(g), packed_.size());
    }
    // Calls use(packed unknown, element, direction) for the elements first ... last - 1 of the lists.
    template <class Use>
    void for_unknowns(std::size_t g, Index first, Index last, const Use& use) const {
        const Index sticking = lists_.sticking(), others = lists_.others();
        for (Index d = 0; d < depth_; ++d) {
            const Index column = depth_ == 1 ? static_cast<Index>(g) : d;
            for (Index k = first; k < (std::min)(last, sticking); ++k) use(d * sticking + k, lists_[k], column);
            const Index shift = (depth_ - 1) * sticking + d * others;
            for (Index k = (std::max)(first, sticking); k < last; ++k) use(shift + k, lists_[k], column);
        }
    }
    template <class Packed>
    void pack(std::size_t g, const Vectors& from, Index first, Index last, Packed&& to) const {
        for_unknowns(g, first, last, [&](Index k, Index i, Index d) { to[k] = from(i, d); });
    }
    void unpack(std::size_t g, const Vector& from, Index first, Index last, Vectors& to) const {
        for_unknowns(g, first, last, [&](Index k, Index i, Index d) { to(i, d) = from[k]; });
    }

    // Entries of a column of M, or of B from `from` on, in packed order; the elements first ... last - 1 of the lists.
    void gather(const Scalar* from, Index first, Index last, Scalar* to) const {
        for (Index k = first; k < last; ++k) *to++ = from[lists_[k]];
    }

    void eliminate(M& matrix, std::size_t g) {
        const Index sticking = depth_ * lists_.sticking();
        fill(matrix, g);
        eliminate_in_place<Scalar>(table_[g], swaps(g), sticking);
        if (is_finite(table_[g], sticking)) return;
        is_regular_ = false;
        fill(matrix, g);
        for_unknowns(g, 0, lists_.sticking(), [&](Index k, Index i, Index) { table_[g](k, k) += matrix.shift(i); });
        eliminate_in_place<Scalar>(table_[g], swaps(g), sticking);
        is_usable_ = is_usable_ && is_finite(table_[g], sticking);
    }
    void fill(const M& matrix, std::size_t g) {
        Matrix& table = table_[g];
        const Index sticking = lists_.sticking(), others = lists_.others();
        for_unknowns(g, 0, lists_.size(), [&](Index column, Index j, Index e) {
            for (Index d = 0; d < depth_; ++d) {
                const auto own = static_cast<std::size_t>(depth_ == 1 ? e : d);
                const Scalar* from = matrix.block(own, static_cast<std::size_t>(e)).col(j).data();
                Scalar* to = table.col(column).data();
                gather(from, 0, sticking, to + d * sticking);
                gather(from, sticking, lists_.size(), to + depth_ * sticking + d * others);
            }
        });
    }
    // C from B_KK, whose factors lie in the other corner.
    void release(const M& matrix, std::size_t g) {
        Matrix& table = table_[g];
        const Index sticking = lists_.sticking(), others = lists_.others(), count = depth_ * others;
        for_unknowns(g, sticking, lists_.size(), [&](Index k, Index j, Index e) {
            const Scalar* from = matrix.inverse(g).col(unpacked(j, e)).data();
            Scalar* to = table.col(k - depth_ * sticking).data();
            for (Index d = 0; d < depth_; ++d) {
                gather(from + unpacked(0, d), sticking, lists_.size(), to + d * others);
            }
        });
        auto factors = table.topLeftCorner(count, count);
        factorise_in_place<Scalar>(factors, swaps(g));
        is_regular_ = is_usable_ = is_usable_ && is_finite(table, count);
        invert_factors<Scalar>(factors, swaps(g), table.bottomRightCorner(count, count));
    }
    static bool is_finite(const Matrix& factors, Index count) {
        for (Index k = 0; k < count; ++k) {
            if (!detail::is_finite(factors(k, k)) || factors(k, k) == 0) return false;
        }
        return true;
    }

    // Packed tractions of K, and their slip.
    void find_slip(std::size_t g, const Base& base, const Vectors& p) {
        const Index others = depth_ * lists_.others();
        pack(g, p, lists_.sticking(), lists_.size(), packed_);
        const auto C = table_[g].bottomRightCorner(others, others);
        if (by_inverse_) {
            packed_.tail(others) -= of_base(g, base).tail(others);
            slip_.tail(others).noalias() = C * packed_.tail(others);
        } else {
            slip_.tail(others) = of_base(g, base).tail(others);
            if (!packed_.tail(others).isZero(0)) slip_.tail(others).noalias() += C * packed_.tail(others);
        }
    }
    // v_S + B_SK s_K
    void stick_by_inverse(const M& matrix, std::size_t g, const Base& base) {
        const Index others = lists_.others(), count = depth_ * others;
        const auto column = [&](Index k) {
            return matrix.inverse(g).col(unpacked(lists_.other(k % others), k / others));
        };
        const auto slip = slip_.tail(count);
        packed_.setZero();  // in the order of B
        Index k = 0;
        for (; k + 4 <= count; k += 4) {
            packed_ += slip[k] * column(k) + slip[k + 1] * column(k + 1) + slip[k + 2] * column(k + 2) +
                       slip[k + 3] * column(k + 3);
        }
        for (; k < count; ++k) packed_ += slip[k] * column(k);
        slip_ = packed_;
        for_unknowns(g, 0, lists_.sticking(), [&](Index to, Index i, Index d) {
            packed_[to] = slip_[unpacked(i, d)] + base.packed(place(g) + to);
        });
    }

    Index depth_;
    std::array<Matrix, 2> table_;
    Vector packed_, slip_;
    std::vector<Index> swaps_;
    bool by_inverse_ = false;
};

}  // namespace rollbem::detail
