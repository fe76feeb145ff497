// Friction in two directions to second order: the direction of slip is taken at the centre of the element, where the
// traction acts.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include "../../detail/finite.hpp"
#include "../../system/detail/centre_values.hpp"
#include "../../types.hpp"
#include "roles.hpp"

namespace rollbem::detail {

/// The slip s_i holds half an element ahead of the centre of its element, where the traction acts. If the traction
/// opposed s_i, the error would be of first order where the direction of slip varies. Slip at the centre points along
///     m_i = (s_i + s_(i-1))/2,   at a trailing element   m_0 = (3 s_0 - s_1)/2,
/// with i - 1 the row behind in the same strip, and s = 0 where elements stick (CentreValues). The law with m_i in
/// place of s_i is not well posed. Well posed is a second solution with fixed angles: it turns s_i by the angle from
/// s_i to m_i in the first solution.
///
/// Angles are at most 60 degrees, and 0 where an element does not slip, or s_i or m_i vanishes. With one direction
/// nothing turns. All memory is allocated by the constructor.
template <int directions>
class SlipRotation {
public:
    using Row = ElementVector<directions>;

    explicit SlipRotation(Index n)
        : rotation_(Vectors<directions>::Zero(n, directions)),
          along_slip_(rotation_),
          along_centre_(rotation_),
          rate_(VectorX<double>::Zero(n)) {}

    bool turns() const { return turns_; }
    /// Whether any angle changes with the slip that find() was called with.
    bool follows() const { return follows_; }
    void stop() { turns_ = follows_ = false; }
    /// Finds the angles of a solution whose slip has not been turned. False if there is nothing to turn.
    bool find(const CentreValues<double>& centres, const Vectors<directions>& slip, const Roles<directions>& roles) {
        stop();
        rate_.setZero();
        for (Index i = 0; i < rate_.size(); ++i) {
            set(i, 1, 0);
            if (roles[i] == Role::slides) find_angle(centres, i, slip);
        }
        return turns_;
    }

    /// Halves all angles.
    void halve() {
        for (Index i = 0; i < rate_.size(); ++i) {
            const double cosine = std::sqrt((1 + cosine_of(i)) / 2);  // at least cos 30 degrees
            set(i, cosine, sine_of(i) / (2 * cosine));
        }
        rate_ /= 2;
    }

    /// Finds the changes of the angles caused by a change of the slip that find() was called with.
    void find_angle_change(const CentreValues<double>& centres, const Vectors<directions>& slip_change,
                           VectorX<double>& angle_change) const {
        angle_change.setZero();
        for (Index i = 0; i < rate_.size(); ++i) {
            if (rate_[i] == 0) continue;
            const Row centre = at_centre(centres, i, slip_change), own = slip_change.row(i);
            angle_change[i] = rate_[i] * (cross<directions>(along_centre_.row(i), centre) -
                                          cross<directions>(along_slip_.row(i), own));
        }
    }

    /// R_i v; v turned back, R_i^-1 v.
    Row turned(Index i, const Row& v) const { return turns_ ? rotated(v, cosine_of(i), sine_of(i)) : v; }
    Row turned_back(Index i, const Row& v) const { return turns_ ? rotated(v, cosine_of(i), -sine_of(i)) : v; }

private:
    double cosine_of(Index i) const { return rotation_(i, 0); }
    double sine_of(Index i) const { return rotation_(i, directions - 1); }
    void set(Index i, double cosine, double sine) {
        rotation_(i, 0) = cosine;
        if constexpr (directions == 2) rotation_(i, 1) = sine;
    }
    static Row rotated(const Row& v, [[maybe_unused]] double cosine, [[maybe_unused]] double sine) {
        if constexpr (directions == 1) {
            return v;
        } else {
            return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]};
        }
    }

    // The angle from s_i to m_i.
    void find_angle(const CentreValues<double>& centres, Index i, const Vectors<directions>& slip) {
        const Row own = slip.row(i), centre = at_centre(centres, i, slip);
        const double size = length(own), centre_size = length(centre);
        if (!(size > 0) || !(centre_size > 0)) return;
        // unit vectors, as products of large slips overflow
        const Row along = own / size, aim = centre / centre_size;
        const double cosine = along.dot(aim), sine = cross<directions>(along, aim);
        if (!is_finite(cosine)) return;
        along_slip_.row(i) = along / size;
        along_centre_.row(i) = aim / centre_size;
        const bool cut = cosine < 0.5;
        rate_[i] = cut ? 0 : 1;
        follows_ = follows_ || !cut;
        if (!(sine != 0)) return;
        set(i, cut ? 0.5 : cosine, cut ? std::copysign(std::sqrt(0.75), sine) : sine);
        turns_ = true;
    }

    // m_i
    Row at_centre(const CentreValues<double>& centres, Index i, const Vectors<directions>& slip) const {
        Row centre;
        for (Index d = 0; d < directions; ++d) centre[d] = centres.at(i, slip.col(d));
        return centre;
    }

    Vectors<directions> rotation_;                   // cosine and sine of the angles
    Vectors<directions> along_slip_, along_centre_;  // s_i and m_i of the angles, each over the square of its length
    VectorX<double> rate_;  // 1 for angles that follow the slip, halved with them; 0 for others
    bool turns_ = false, follows_ = false;
};

}  // namespace rollbem::detail
