// The equations of a friction problem in two directions with the sticking elements eliminated: slip of the others as a
// function of their tractions, and Newton's equations for the directions in which they slide.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "../../detail/in_place_lu.hpp"
#include "../../types.hpp"
#include "roles.hpp"
#include "slip_matrix.hpp"

namespace rollbem::detail {

/// The equations s = M p + c with s_S = 0, where S are the elements that stick and K all others:
///     s_K = d + C p_K,    C = M_KK - M_KS M_SS^-1 M_SK
/// C comes from eliminating S or, if few elements do not stick, from the inverse B = M^-1 as C = (B_KK)^-1. Each group
/// of M has one matrix of its size, whose unknowns are packed: first S, then K, each direction by direction. Results
/// depend on M and the roles alone, to the last bit. All memory is allocated by the constructor.
class CondensedSlip : public RoleLists {
public:
    using Vector = VectorX<double>;
    using Matrix = MatrixX<double>;
    using M = SlipMatrix<2>;

    /// The contribution of the constants c, for one set of roles.
    struct Base {
        explicit Base(Index n) : packed(Vectors<2>::Zero(n, 2)), by_inverse(packed) {}
        /// To be called when the constants have changed.
        void forget() { revision = 0, inverse_is_known = false; }

        Vectors<2> packed;
        Vectors<2> by_inverse;  // -B c, for any roles
        std::uint64_t revision = 0;
        bool inverse_is_known = false;
    };

    explicit CondensedSlip(const M& matrix)
        : RoleLists(matrix.size()),
          depth_(matrix.depth()),
          packed_(matrix.group_size()),
          slip_(matrix.group_size()),
          order_(static_cast<std::size_t>(matrix.group_size())),
          swaps_(static_cast<std::size_t>(2 * matrix.size())) {
        for (std::size_t g = 0; g < matrix.groups(); ++g) table_[g].resize(matrix.group_size(), matrix.group_size());
    }

    /// Eliminates the elements that stick, with a nearby matrix where M_SS is singular; false if both fail.
    bool condense(M& matrix, const std::vector<Role>& roles) {
        if (are_of(matrix, roles)) return is_usable_;
        take(matrix, roles);
        Index* next = order_.data();
        const auto list = [&](Index first, Index last) {
            for (Index d = 0; d < depth_; ++d) {
                for (Index k = first; k < last; ++k) *next++ = d * size() + (*this)[k];
            }
        };
        list(0, sticking());
        list(sticking(), size());
        by_inverse_ = 2 * others() <= size() && !matrix.serves_once && matrix.find_inverse(table_);
        is_regular_ = is_usable_ = true;
        for (std::size_t g = 0; g < matrix.groups(); ++g) by_inverse_ ? release(matrix, g) : eliminate(matrix, g);
        return is_usable_;
    }

    /// Finds the contribution of the constants c; null means c = 0.
    void find_base(const M& matrix, const Vectors<2>* c, Base& base) {
        if (base.revision == revision()) return;
        base.revision = revision();
        if (c == nullptr) return void(base.packed.setZero());
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            auto packed = matrix.part(base.packed, g), by_inverse = matrix.part(base.by_inverse, g);
            if (by_inverse_ && !base.inverse_is_known) {
                by_inverse.noalias() = matrix.inverse(g) * matrix.part(*c, g);
                by_inverse = -by_inverse;
            }
            pack((by_inverse_ ? base.by_inverse.data() : c->data()) + place(g), 0, packed.data());
            if (!by_inverse_) eliminate_vector_in_place<double>(table_[g], swaps(g), stuck(), packed);
        }
        base.inverse_is_known = base.inverse_is_known || by_inverse_;
    }

    /// Finds the slip of K from the tractions of K.
    void find_slip(const M& matrix, const Base& base, const Vectors<2>& p, Vectors<2>& s) {
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            find_slip(g, matrix.part(base.packed, g), p);
            unpack(slip_, loose(), s.data() + place(g));
        }
    }
    /// Finds the slip of K and the tractions of S from the tractions of K; the slip of S becomes zero.
    void complete(const M& matrix, const Base& base, Vectors<2>& p, Vectors<2>& s) {
        for (std::size_t g = 0; g < matrix.groups(); ++g) {
            const auto constant = matrix.part(base.packed, g);
            find_slip(g, constant, p);
            slip_.head(stuck()).setZero();
            unpack(slip_, slip_.size(), s.data() + place(g));
            if (stuck() == 0) continue;
            if (by_inverse_) {
                stick_by_inverse(matrix.inverse(g));
                packed_.head(stuck()) += constant.head(stuck());
            } else {
                packed_.head(stuck()).noalias() = table_[g].topRightCorner(stuck(), loose()) * packed_.tail(loose());
                packed_.head(stuck()) += constant.head(stuck());
                substitute_in_place<double>(table_[g], stuck(), packed_.head(stuck()));
                packed_.head(stuck()) = -packed_.head(stuck());
            }
            for (Index k = 0; k < stuck(); ++k) p.data()[place(g) + unknown(k)] = packed_[k];
        }
    }

    /// Sets `target` to X_k . C_kl Y_l for all sliding elements k and l; X and Y have a row for each.
    template <class Target>
    void form(const M&, const Vectors<2>& X, const Vectors<2>& Y, Target&& target) const {
        const Index count = sliding();
        const auto part = [&](std::size_t g, Index d, Index e, Index l) {
            return table_[g].col(stuck() + e * others() + l).segment(stuck() + d * others(), count);
        };
        const auto x = X.col(0).head(count), y = X.col(1).head(count);
        for (Index l = 0; l < count; ++l) {
            const double u = Y(l, 0), v = Y(l, 1);
            if (depth_ == 1) {
                target.col(l) = u * x.cwiseProduct(part(0, 0, 0, l)) + v * y.cwiseProduct(part(1, 0, 0, l));
            } else {
                target.col(l) = x.cwiseProduct(u * part(0, 0, 0, l) + v * part(0, 0, 1, l)) +
                                y.cwiseProduct(u * part(0, 1, 0, l) + v * part(0, 1, 1, l));
            }
        }
    }

private:
    // Number of unknowns of a group in S, and in K; first unknown of a group; place in a group of a packed unknown.
    Index stuck() const { return depth_ * sticking(); }
    Index loose() const { return depth_ * others(); }
    Index place(std::size_t g) const { return static_cast<Index>(g) * size(); }
    Index unknown(Index k) const { return order_[static_cast<std::size_t>(k)]; }
    Index* swaps(std::size_t g) { return swaps_.data() + place(g); }

    // Copies unknowns into packed order, from the packed one `first` on.
    void pack(const double* from, Index first, double* to) const {
        for (Index k = first; k < packed_.size(); ++k) *to++ = from[unknown(k)];
    }
    // Copies the last `count` packed unknowns back to their places.
    void unpack(const Vector& from, Index count, double* to) const {
        for (Index k = from.size() - count; k < from.size(); ++k) to[unknown(k)] = from[k];
    }

    void eliminate(M& matrix, std::size_t g) {
        const auto factorise = [&](bool shifts) {
            Matrix& table = table_[g];
            for (Index k = 0; k < table.cols(); ++k)
                pack(matrix.group(g).col(unknown(k)).data(), 0, table.col(k).data());
            for (Index k = 0; shifts && k < stuck(); ++k) table(k, k) += matrix.shift(unknown(k) % size());
            eliminate_in_place<double>(table, swaps(g), stuck());
            return has_pivots(table, stuck());
        };
        if (factorise(false)) return;
        is_regular_ = false;
        is_usable_ = factorise(true) && is_usable_;
    }
    // Finds C from B_KK, whose factors lie in the opposite corner of the table.
    void release(const M& matrix, std::size_t g) {
        Matrix& table = table_[g];
        for (Index k = 0; k < loose(); ++k) {
            pack(matrix.inverse(g).col(unknown(stuck() + k)).data(), stuck(), table.col(k).data());
        }
        auto factors = table.topLeftCorner(loose(), loose());
        factorise_in_place<double>(factors, swaps(g));
        is_regular_ = is_usable_ = is_usable_ && has_pivots(table, loose());
        invert_factors<double>(factors, swaps(g), table.bottomRightCorner(loose(), loose()));
    }

    // Packs the tractions of K into packed_ and finds the slip of K in slip_.
    template <class Constant>
    void find_slip(std::size_t g, const Constant& constant, const Vectors<2>& p) {
        pack(p.data() + place(g), stuck(), packed_.data() + stuck());
        const auto C = table_[g].bottomRightCorner(loose(), loose());
        auto tractions = packed_.tail(loose()), slip = slip_.tail(loose());
        if (by_inverse_) {
            tractions -= constant.tail(loose());
            slip.noalias() = C * tractions;
        } else {
            slip = constant.tail(loose());
            if (!tractions.isZero(0)) slip.noalias() += C * tractions;
        }
    }
    // Sets packed_ to B_SK s_K.
    void stick_by_inverse(const Matrix& inverse) {
        const auto column = [&](Index k) { return inverse.col(unknown(stuck() + k)); };
        const auto slip = slip_.tail(loose());
        packed_.setZero();  // for now in the order of B
        Index k = 0;
        for (; k + 4 <= loose(); k += 4) {
            packed_ += slip[k] * column(k) + slip[k + 1] * column(k + 1) + slip[k + 2] * column(k + 2) +
                       slip[k + 3] * column(k + 3);
        }
        for (; k < loose(); ++k) packed_ += slip[k] * column(k);
        slip_ = packed_;
        pack(slip_.data(), 0, packed_.data());
    }

    Index depth_;
    std::array<Matrix, 2> table_;
    Vector packed_, slip_;
    std::vector<Index> order_;  // packed order of the unknowns of a group
    std::vector<Index> swaps_;
    bool by_inverse_ = false;
};

/// Newton's equations for the directions of sliding tractions, whose magnitudes are given: one unknown tau for each
/// sliding element, in the order of RoleLists. At a point (p, s), let n be the unit vector along the traction of an
/// element, t the unit vector across it, a and w the vectors n and t turned back (SlipRotation), and k = -a.s/b the
/// stiffness of the element. With C from CondensedSlip, the tractions change by tau t, where
///     (w.C t + k) tau = -w.s
class SlipDirectionSystem {
public:
    using Row = ElementVector<2>;

    explicit SlipDirectionSystem(Index n)
        : along_(Vectors<2>::Zero(n, 2)),
          across_(along_),
          against_(along_),
          aside_(along_),
          stiffness_(n),
          turn_(n),
          factors_(n, n),
          swaps_(static_cast<std::size_t>(n)) {}

    /// Sets the directions and the stiffness of each sliding element.
    template <class Rotation>
    void aim(const RoleLists& lists, const Vectors<2>& direction, const Vectors<2>& slip, const VectorX<double>& bound,
             const Rotation& rotation) {
        count_ = lists.sliding();
        for (Index l = 0; l < count_; ++l) {
            const Index i = lists.other(l);
            const Row along = direction.row(i), against = rotation.turned_back(i, along);
            along_.row(l) = along;
            across_.row(l) << -along[1], along[0];
            against_.row(l) = against;
            aside_.row(l) << -against[1], against[0];
            // the stiffness stays finite, however small the bound
            stiffness_[l] =
                std::clamp(-against.dot(slip.row(i)) / bound[i], 0.0, (std::numeric_limits<double>::max)() / 1000);
        }
    }
    /// False if the equations are singular to working precision.
    bool factorise(const SlipMatrix<2>& matrix, const CondensedSlip& condensed) {
        auto factors = factors_.topLeftCorner(count_, count_);
        condensed.form(matrix, aside_, across_, factors);
        factors.diagonal() += stiffness_.head(count_);
        factorise_in_place<double>(factors, swaps_.data());
        return has_pivots(factors_, count_);
    }

    const Vectors<2>& along() const { return along_; }      ///< n
    const Vectors<2>& across() const { return across_; }    ///< t
    const Vectors<2>& against() const { return against_; }  ///< a
    const Vectors<2>& aside() const { return aside_; }      ///< w
    /// Solves for tau at this slip and adds tau t to the tractions.
    void turn(const RoleLists& lists, const Vectors<2>& slip, Vectors<2>& traction) {
        for (Index l = 0; l < count_; ++l) turn_[l] = -aside_.row(l).dot(slip.row(lists.other(l)));
        solve_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), turn_.head(count_));
        for (Index l = 0; l < count_; ++l) traction.row(lists.other(l)) += turn_[l] * across_.row(l);
    }
    void solve_columns(Eigen::Ref<MatrixX<double>> right) {
        solve_columns_in_place<double>(factors_.topLeftCorner(count_, count_), swaps_.data(), right);
    }

private:
    Vectors<2> along_, across_, against_, aside_;
    VectorX<double> stiffness_, turn_;
    MatrixX<double> factors_;
    std::vector<Index> swaps_;
    Index count_ = 0;
};

}  // namespace rollbem::detail
