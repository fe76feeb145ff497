// Friction in two directions to second order: the direction of slip is taken where the traction of the element acts.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../detail/length.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "roles.hpp"

namespace rollbem::detail {

/// The slip s_i of a row that lies half an element ahead of the centre of its element opposes a traction that acts
/// there. Where the direction of slip varies, that is an error of first order. Slip at the centre points along
///     m_i = s_i + s_(i-1),   at a trailing element   m_0 = 3 s_0 - s_1,
/// with the row behind in the same strip and zero where elements stick. Replacing s_i by m_i in the law is not well
/// posed; turning s_i by the angle from s_i to m_i of a solution, and solving once more at fixed angles, is.
///
/// Angles are at most 60 degrees, and 0 where an element does not slip, or s_i or m_i vanishes, or a trailing element
/// has none ahead. All memory is allocated by the constructor.
template <class Scalar>
class TurnedSlip {
public:
    using Index = Eigen::Index;
    using Vectors = ElementVectors<Scalar>;
    using Row = ElementVector<2, Scalar>;

    explicit TurnedSlip(Index n)
        : behind_(static_cast<std::size_t>(n)),
          ahead_(behind_),
          rotation_(Vectors::Zero(n, 2)),
          along_slip_(rotation_),
          along_centre_(rotation_),
          share_(VectorX<Scalar>::Zero(n)),
          rate_(share_) {}

    /// The row behind each in its strip, -1 for a trailing element. Empty: slip is not turned.
    void set_behind(const std::vector<Index>& behind) {
        is_known_ = !behind.empty();
        std::copy(behind.begin(), behind.end(), behind_.begin());
        std::fill(ahead_.begin(), ahead_.end(), Index(-1));
        for (std::size_t i = 0; i < behind.size(); ++i) {
            if (behind_[i] >= 0) ahead_[at(behind_[i])] = static_cast<Index>(i);
        }
        stop();
    }

    bool turns() const { return turns_; }
    /// Whether any angle changes with the slip that find() was called with.
    bool follows() const { return follows_; }
    void stop() { turns_ = follows_ = false; }
    /// Finds the angles of a solution whose slip has not been turned. False if there is nothing to turn.
    bool find(const Vectors& slip, const Roles<2, Scalar>& roles) {
        stop();
        if (!is_known_) return false;
        rotation_.col(0).setOnes();
        rotation_.col(1).setZero();
        rate_.setZero();
        for (Index i = 0; i < rate_.size(); ++i) {
            const Index other = partner(at(i));
            if (roles[i] != Role::slides || other < 0) continue;
            share_[i] = roles[other] == Role::sticks ? 0 : behind_[at(i)] < 0 ? -1 : 1;
            find_angle(i, slip);
        }
        return turns_;
    }

    /// Halves all angles.
    void halve() {
        for (Index i = 0; i < rotation_.rows(); ++i) {
            const Scalar cosine = std::sqrt((1 + rotation_(i, 0)) / 2);  // at least cos 30 degrees
            rotation_(i, 0) = cosine;
            rotation_(i, 1) /= 2 * cosine;
        }
        rate_ /= 2;
    }

    /// The derivatives of the angles by those of the slip that find() was called with.
    void follow(const Vectors& slip_change, VectorX<Scalar>& angle_change) const {
        angle_change.setZero();
        for (Index i = 0; i < rate_.size(); ++i) {
            if (rate_[i] == 0) continue;
            const auto [dx, dy] = at_centre(i, slip_change);
            const Scalar centre = along_centre_(i, 0) * dy - along_centre_(i, 1) * dx;
            const Scalar own = along_slip_(i, 0) * slip_change(i, 1) - along_slip_(i, 1) * slip_change(i, 0);
            angle_change[i] = rate_[i] * (centre - own);
        }
    }

    /// R_i v, and v turned back.
    Row turned(Index i, const Row& v) const {
        if (!turns_) return v;
        const Scalar cosine = rotation_(i, 0), sine = rotation_(i, 1);
        return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]};
    }
    Row turned_back(Index i, const Row& v) const {
        if (!turns_) return v;
        const Scalar cosine = rotation_(i, 0), sine = rotation_(i, 1);
        return {cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]};
    }

private:
    static std::size_t at(Index i) { return static_cast<std::size_t>(i); }

    // The angle from s_i to m_i.
    void find_angle(Index i, const Vectors& slip) {
        const auto [x, y] = at_centre(i, slip);
        const Scalar size = length(slip(i, 0), slip(i, 1)), centre = length(x, y);
        if (!(size > 0) || !(centre > 0)) return;
        // unit vectors, as products of large slips overflow
        const Scalar along = slip(i, 0) / size, across = slip(i, 1) / size;
        const Scalar cosine = (along * x + across * y) / centre, sine = (along * y - across * x) / centre;
        if (!is_finite(cosine)) return;
        along_slip_.row(i) << along / size, across / size;
        along_centre_.row(i) << x / centre / centre, y / centre / centre;
        const bool cut = cosine < Scalar(0.5);
        rate_[i] = cut ? 0 : 1;
        follows_ = follows_ || !cut;
        if (!(sine != 0)) return;
        rotation_(i, 0) = cut ? Scalar(0.5) : cosine;
        rotation_(i, 1) = cut ? std::copysign(std::sqrt(Scalar(0.75)), sine) : sine;
        turns_ = true;
    }

    // The element whose slip counts for the direction at the centre of element k; -1 if none does.
    Index partner(std::size_t k) const { return behind_[k] < 0 ? ahead_[k] : behind_[k]; }
    // m_i of element i, which has a partner.
    std::pair<Scalar, Scalar> at_centre(Index i, const Vectors& slip) const {
        const Index other = partner(at(i));
        const Scalar own = behind_[at(i)] < 0 ? 3 : 1, share = share_[i];
        return {own * slip(i, 0) + share * slip(other, 0), own * slip(i, 1) + share * slip(other, 1)};
    }

    std::vector<Index> behind_, ahead_;
    Vectors rotation_;                   // cosine and sine of the angles
    Vectors along_slip_, along_centre_;  // s_i and m_i of which they are the angles, over the squares of their lengths
    VectorX<Scalar> share_;              // of the partner's slip in m_i
    VectorX<Scalar> rate_;               // 0 for angles that do not follow the slip, half for those that are halved
    bool is_known_ = false, turns_ = false, follows_ = false;
};

/// The same with one direction: slip is what it is.
struct UnturnedSlip {
    explicit UnturnedSlip(Eigen::Index) {}

    static constexpr bool turns() { return false; }
    static constexpr bool follows() { return false; }
    void stop() {}
    template <class Row>
    const Row& turned(Eigen::Index, const Row& v) const {
        return v;
    }
    template <class Row>
    const Row& turned_back(Eigen::Index, const Row& v) const {
        return v;
    }
};

template <int directions, class Scalar>
using SlipTurn = ByDirections<directions, UnturnedSlip, TurnedSlip<Scalar>>;

}  // namespace rollbem::detail
