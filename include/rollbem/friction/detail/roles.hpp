// Roles of the elements of a friction problem: each is assumed to stick, to slide, or to be free for want of pressure.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../detail/length.hpp"

namespace rollbem::detail {

enum class Role : unsigned char {
    sticks,   ///< s_i = 0
    slides,   ///< |p_i| = b_i > 0, p_i along a given direction
    is_free,  ///< p_i = 0 because b_i = 0; any slip is allowed
};

using Index = Eigen::Index;
/// Tractions or slip of the elements, a row each.
template <int directions>
using Vectors = Eigen::Matrix<double, Eigen::Dynamic, directions>;
/// The traction or slip of one element.
template <int directions>
using ElementVector = Eigen::Matrix<double, 1, directions>;

inline double length(const ElementVector<1>& v) { return std::abs(v[0]); }
inline double length(const ElementVector<2>& v) { return length(v[0], v[1]); }

template <int directions>
double largest_length(const Vectors<directions>& vectors) {
    if constexpr (directions == 1) return vectors.cwiseAbs().maxCoeff();
    double result = 0;
    for (Index i = 0; i < vectors.rows(); ++i) {
        result = (std::max)(result, length(ElementVector<directions>(vectors.row(i))));
    }
    return result;
}

/// The sine of the angle from one vector to another, times both lengths; 0 with one direction.
template <int directions>
double cross(const Eigen::Matrix<double, 1, directions>& from, const Eigen::Matrix<double, 1, directions>& to) {
    return directions == 1 ? 0.0 : from[0] * to[directions - 1] - from[directions - 1] * to[0];
}

template <int directions>
struct Roles {
    using Row = ElementVector<directions>;

    explicit Roles(Index n)
        : of(static_cast<std::size_t>(n), Role::sticks), direction(Vectors<directions>::Zero(n, directions)) {}

    Index size() const { return direction.rows(); }
    Role operator[](Index i) const { return of[static_cast<std::size_t>(i)]; }
    void stick(Index i) { set(i, Role::sticks, Row::Zero()); }
    void release(Index i) { set(i, Role::is_free, Row::Zero()); }
    /// Makes an element slide along a vector of length `norm`, or stick if the length is not positive.
    void slide(Index i, const Row& along, double norm) {
        if (!(norm > 0)) return stick(i);
        set(i, Role::slides, directions == 1 ? Row(Row::Constant(along[0] > 0 ? 1 : -1)) : Row(along / norm));
    }
    void slide(Index i, const Row& along) { slide(i, along, length(along)); }
    /// Turns the direction of an element that slides, unless the vector vanishes.
    void align(Index i, const Row& along) {
        const double norm = length(along);
        if (norm > 0) direction.row(i) = along / norm;
    }
    bool any_slides() const { return std::find(of.begin(), of.end(), Role::slides) != of.end(); }

    std::vector<Role> of;
    /// Unit vectors along the tractions of elements that slide; 0 for others.
    Vectors<directions> direction;

private:
    void set(Index i, Role role, const Row& along) {
        of[static_cast<std::size_t>(i)] = role;
        direction.row(i) = along;
    }
};

/// Lists of the elements that stick, slide and are free, in this order, each list in ascending order. They belong to
/// equations whose sticking elements have been eliminated, for one M and one set of roles.
class RoleLists {
public:
    explicit RoleLists(Index n) : elements_(static_cast<std::size_t>(n)), of_(elements_.size()) {}

    Index size() const { return static_cast<Index>(elements_.size()); }
    Index sticking() const { return sticking_; }
    Index sliding() const { return sliding_; }
    Index others() const { return size() - sticking_; }  ///< number of elements that do not stick
    Index operator[](Index k) const { return elements_[static_cast<std::size_t>(k)]; }
    Index other(Index k) const { return (*this)[sticking_ + k]; }  ///< k-th of them; sliding ones come first
    /// Whether the elements that stick follow one another.
    bool stick_together() const { return sticking_ == 0 || (*this)[sticking_ - 1] - (*this)[0] == sticking_ - 1; }
    /// The entries of elements that stick together.
    template <class Values>
    auto stuck(Values& values) const {
        return values.segment(sticking_ == 0 ? 0 : (*this)[0], sticking_);
    }

    template <class Matrix>
    bool are_of(const Matrix& matrix, const std::vector<Role>& roles) const {
        return matrix_revision_ == matrix.revision() && same_bits(roles, of_);
    }
    /// A number that changes whenever M or the roles change.
    std::uint64_t revision() const { return revision_; }
    /// Whether M_SS is regular to working precision.
    bool is_regular() const { return is_regular_; }

protected:
    template <class Matrix>
    void take(Matrix& matrix, const std::vector<Role>& roles) {
        matrix_revision_ = matrix.revision();
        revision_ = matrix.next_serial();
        of_ = roles;
        auto next = elements_.begin();
        const auto add = [&](Role role) {
            const auto first = next;
            for (std::size_t i = 0; i < roles.size(); ++i) {
                if (roles[i] == role) *next++ = static_cast<Index>(i);
            }
            return static_cast<Index>(next - first);
        };
        sticking_ = add(Role::sticks);
        sliding_ = add(Role::slides);
        add(Role::is_free);
    }

    std::uint64_t matrix_revision_ = 0;
    bool is_regular_ = false, is_usable_ = false;  // M_SS itself can be solved; it or a nearby matrix can

private:
    std::vector<Index> elements_;
    std::vector<Role> of_;
    Index sticking_ = 0, sliding_ = 0;
    std::uint64_t revision_ = 0;
};

}  // namespace rollbem::detail
