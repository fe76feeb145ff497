// Profile: the section of a wheel or a rail, a curve through points, smooth except at corners.
#pragma once

#include "../detail/decl.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace rollbem {

/// A curve (y(s), z(s)) [m] over the length s along the polygon of its points; y to the right, z down.
///
/// \code
/// #include <rollbem/profiles.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Profile wheel = s1002(), rail = rail_60e1().moved(0.025, 0, 0);  // canted by 1 in 40
///     return wheel.length() > 0.05 && rail.length() > 0.05 ? 0 : 1;          // along the profiles [m]
/// }
/// \endcode
///
/// - Wheel: the right one, z = 0 on the tape circle and the flange at negative y.
/// - Rail: z = 0 at its highest point, and the inner side of the right rail at negative y.
///
/// It is a cubic spline in both, broken at corners: points where the polygon turns by more than 30 degrees, and by at
/// most 6 at every other point within 2 mm.
///
/// Invariant: at least 4 points, finite, from 1e-100 to 1e100 from one to the next, and the polygon turns by at most
/// 150 degrees at each; y grows from the first to the last (moved() keeps their order).
class Profile {
public:
    /// The use of the curve: a whole wheel, a whole rail, or a piece that need not look like either, such as rollers
    /// and cut-outs.
    enum class Use { wheel, rail, piece };

    struct Point {
        double y, z;
        std::array<double, 2> slope, bend;  ///< d(y, z)/ds [-] and d2(y, z)/ds2 [1/m]
    };

    /// A rigid motion, moved(angle, dy, dz), and how well the moved profile fits: the result of align().
    struct Alignment {
        double angle, dy, dz;  ///< [rad], [m], [m]
        double residual;       ///< root mean square of the distances from the reference's parts that count [m]
        double share;          ///< of the parts' length that counts [-]: the rest is worn, or not measured
    };

    /// The result of flange_sizes(): the sizes of EN 15313 [m]; NaN where the profile has no such place.
    struct FlangeSizes {
        double height;     ///< Sh, from the tape circle's point down to the tip
        double thickness;  ///< Sd, from the flange's back to its face 10 mm below the tape circle's point
        double qr;         ///< qR, along y from that place of the face to the face 2 mm above the tip
    };

    /// The result of rail_wear(): what is missing of a rail's head [m]; NaN where one of both has no such place.
    struct RailWear {
        double vertical;  ///< at y = 0
        double side;      ///< on the inner side, `depth` below the top of the rail before
    };

    /// Takes points in the order of the curve, from either end. Throws std::invalid_argument if they break the
    /// invariant, naming the point by its number from 1.
    Profile(Eigen::ArrayXd y, Eigen::ArrayXd z, Use use = Use::rail);

    double length() const { return knots_[knots_.size() - 1]; }
    Eigen::Index size() const { return knots_.size(); }     ///< number of points
    const Eigen::ArrayXd& s() const { return knots_; }      ///< s of the points
    const Eigen::ArrayXd& y() const { return values_[0]; }  ///< y of the points
    const Eigen::ArrayXd& z() const { return values_[1]; }  ///< z of the points
    /// The numbers of the points at corners, from 0 and growing.
    const std::vector<Eigen::Index>& corners() const { return corners_; }
    bool is_piece() const { return piece_; }

    /// The point at 0 <= s <= length(), beyond a corner if s is at one; outside, the spline of the last interval goes
    /// on.
    Point at(double s) const noexcept;

    /// The same curve turned about the origin by `angle` [rad], from y towards z, and moved by (dy, dz) [m]. Throws
    /// std::invalid_argument unless they are finite.
    Profile moved(double angle, double dy, double dz) const;

    /// The mirror image at y = 0: the right profile of a left one.
    Profile mirrored() const;

    /// The profile without the noise of measurement, by a smoothing spline in y and z. Waves of `wave_length` [m] are
    /// halved, shorter waves are damped more (by the fourth power of the length), longer waves and corners stay. Throws
    /// std::invalid_argument unless the wave length is positive and finite.
    Profile smoothed(double wave_length) const;

private:
    static void check(Eigen::Index i, bool holds, const char* rule);
    double length_of_step(Eigen::Index i) const {
        return std::hypot(values_[0][i] - values_[0][i - 1], values_[1][i] - values_[1][i - 1]);
    }
    void reverse();

    std::array<Eigen::ArrayXd, 2> values_, bends_;  // y and z, and their second derivatives
    Eigen::ArrayXd knots_;
    std::vector<Eigen::Index> corners_;
    bool piece_ = false;
};

namespace detail {

inline constexpr double usual_cant = 0.02499479361892016;

}  // namespace detail

/// The wheel S1002 (EN 13715), from the flange's back to 60 mm outside the tape circle; tape circle at y = 0.
Profile s1002();

/// The rail UIC 60 (UIC 861; by the centres of its arcs, which join at 10.50 and 25.99 mm from the middle), canted
/// inwards, towards negative y, by `cant` [rad], its highest point at y = z = 0; the profiles below likewise.
Profile rail_uic60(double cant = detail::usual_cant);

/// The rail 60E1 (EN 13674-1; joints 20.456 and 52.053 mm apart).
Profile rail_60e1(double cant = detail::usual_cant);

/// The rail 54E1 (EN 13674-1; joints 20.024 and 49.727 mm apart).
Profile rail_54e1(double cant = detail::usual_cant);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/profile.ipp"
#endif
