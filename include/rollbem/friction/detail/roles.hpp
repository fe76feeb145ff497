// What each element of a friction problem is assumed to do: stick, slide, or neither for want of pressure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../../detail/length.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

enum class Role : unsigned char {
    sticks,   ///< s_i = 0
    slides,   ///< |p_i| = b_i > 0, p_i along a given direction
    is_free,  ///< p_i = 0 as b_i = 0; slips as it likes
};

/// A vector of one element.
template <int directions, class Scalar>
using ElementVector = Eigen::Matrix<Scalar, 1, directions>;

template <class Scalar>
Scalar length(const ElementVector<1, Scalar>& v) {
    return std::abs(v[0]);
}
template <class Scalar>
Scalar length(const ElementVector<2, Scalar>& v) {
    return length(v[0], v[1]);
}

template <int directions, class Scalar>
struct Roles {
    using Index = Eigen::Index;
    using Row = ElementVector<directions, Scalar>;

    explicit Roles(Index n)
        : of(static_cast<std::size_t>(n), Role::sticks),
          direction(ElementVectors<Scalar, directions>::Zero(n, directions)) {}

    Index size() const { return direction.rows(); }
    Role operator[](Index i) const { return of[static_cast<std::size_t>(i)]; }
    void stick(Index i) { set(i, Role::sticks, Row::Zero()); }
    void release(Index i) { set(i, Role::is_free, Row::Zero()); }
    void slide(Index i, const Row& along) { set(i, Role::slides, along); }
    bool any_slides() const { return std::find(of.begin(), of.end(), Role::slides) != of.end(); }

    std::vector<Role> of;
    /// Unit vectors along the tractions of elements that slide; 0 for others.
    ElementVectors<Scalar, directions> direction;

private:
    void set(Index i, Role role, const Row& along) {
        of[static_cast<std::size_t>(i)] = role;
        direction.row(i) = along;
    }
};

/// The elements that stick, slide and are free, in this order and each in ascending order.
class RoleLists {
public:
    using Index = Eigen::Index;

    explicit RoleLists(Index n) : elements_(static_cast<std::size_t>(n)), of_(elements_.size()) {}

    void take(const std::vector<Role>& roles) {
        of_ = roles;
        Index count = 0;
        const auto add = [&](Role role) {
            for (std::size_t i = 0; i < roles.size(); ++i) {
                if (roles[i] == role) elements_[static_cast<std::size_t>(count++)] = static_cast<Index>(i);
            }
            return count;
        };
        sticking_ = add(Role::sticks);
        sliding_ = add(Role::slides) - sticking_;
        add(Role::is_free);
    }
    bool are_of(const std::vector<Role>& roles) const { return roles == of_; }

    Index size() const { return static_cast<Index>(elements_.size()); }
    Index sticking() const { return sticking_; }
    Index sliding() const { return sliding_; }
    Index others() const { return size() - sticking_; }  ///< that do not stick
    Index operator[](Index k) const { return elements_[static_cast<std::size_t>(k)]; }
    Index sticking(Index k) const { return (*this)[k]; }
    Index other(Index k) const { return (*this)[sticking_ + k]; }  ///< first those that slide

private:
    std::vector<Index> elements_;
    std::vector<Role> of_;
    Index sticking_ = 0, sliding_ = 0;
};

/// Of which M and roles equations with the sticking elements eliminated are.
class EliminatedRoles {
public:
    explicit EliminatedRoles(Eigen::Index n) : lists_(n) {}

    const RoleLists& lists() const { return lists_; }
    template <class Matrix>
    bool holds(const Matrix& matrix, const std::vector<Role>& roles) const {
        return matrix_revision_ == matrix.revision() && lists_.are_of(roles);
    }
    /// Changes whenever M or the roles do.
    std::uint64_t revision() const { return revision_; }
    /// Whether M_SS is not singular to working precision.
    bool is_regular() const { return is_regular_; }

protected:
    RoleLists lists_;
    std::uint64_t matrix_revision_ = 0, revision_ = 0;
    bool is_regular_ = false, is_usable_ = false;  // as it is; or that of a nearby matrix
};

}  // namespace rollbem::detail
