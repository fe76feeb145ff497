// Position and speeds of a wheelset on its track, and reflections, which turn a left wheel into a right one and rolling
// backwards into rolling forward.
#pragma once

#include "../detail/language.hpp"

#include <array>

#include "../types.hpp"
#include "creepage.hpp"
#include "patch_contact.hpp"

namespace rollbem {

enum class WheelsetSide { left, right };

/// Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. The middle
/// of the axle is at (0, lateral, height - r0), rolled about x, then yawed about z.
struct WheelsetPosition {
    double lateral = 0;  ///< y_ws [m]
    double height = 0;   ///< z_ws [m], positive down; 0 where profiles with z = 0 at the tape circle and the top touch
    double roll = 0;     ///< phi [rad]
    double yaw = 0;      ///< psi [rad]
    double along = 0;    ///< place of the middle of the axle along the track [m], for rails that change along it
    double pitch = 0;    ///< turn about the axle [rad], for wheels that are not round; negative when rolling forward
};

/// Speeds of a wheelset: the middle of its axle moves by `forward` along x. In a curve of radius R to the right the yaw
/// rate is V/R, the left wheel is the outer one, and the yaw is measured from the radial direction.
struct WheelsetSpeeds {
    double forward = 1;                  ///< V [m/s]
    double pitch_rate = 0;               ///< rate of the turn about the axle [rad/s], about -V/r forward; 0: locked
    double lateral = 0, vertical = 0;    ///< velocity of the middle of the axle [m/s]
    double roll_rate = 0, yaw_rate = 0;  ///< [rad/s]
};

/// A reflection that reverses x, y, both or neither of the track's axes, and with them x and s of planes of contact. It
/// is its own inverse. mirrored(value, mirror) is the image of a value.
///
/// \code
/// #include <rollbem/vehicle.hpp>
///
/// int main() {
///     using namespace rollbem;
///     // the left wheel at 2 mm to the right is the right wheel at 2 mm to the left
///     return mirrored(WheelsetPosition{.lateral = 2e-3}, Mirror::of(WheelsetSide::left)).lateral == -2e-3 ? 0 : 1;
/// }
/// \endcode
class Mirror {
public:
    constexpr Mirror() = default;  ///< the identity: everything is its own image

    static constexpr Mirror reversing_x() { return {-1, 1}; }   ///< reverses x, and with it the direction of rolling
    static constexpr Mirror across_track() { return {1, -1}; }  ///< reverses y: left and right
    /// The reflection that makes the wheel of this side a right wheel.
    static constexpr Mirror of(WheelsetSide side) { return side == WheelsetSide::left ? across_track() : Mirror(); }

    /// Signs of the components along x, y, z of a place, velocity or force.
    constexpr std::array<double, 3> of_vector() const { return {x_, y_, 1}; }
    /// Signs of turns, rates and moments about x, y, z, which behave like a product of two vectors.
    constexpr std::array<double, 3> of_turn() const { return {y_, x_, x_ * y_}; }

private:
    constexpr Mirror(double x, double y) : x_(x), y_(y) {}

    double x_ = 1, y_ = 1;
};

inline WheelsetPosition mirrored(WheelsetPosition position, const Mirror& mirror) {
    const auto [x, y, z] = mirror.of_vector();
    const auto [about_x, about_y, about_z] = mirror.of_turn();
    position.along *= x;
    position.lateral *= y;
    position.height *= z;
    position.roll *= about_x;
    position.pitch *= about_y;
    position.yaw *= about_z;
    return position;
}

inline WheelsetSpeeds mirrored(WheelsetSpeeds speeds, const Mirror& mirror) {
    const auto [x, y, z] = mirror.of_vector();
    const auto [about_x, about_y, about_z] = mirror.of_turn();
    speeds.forward *= x;
    speeds.lateral *= y;
    speeds.vertical *= z;
    speeds.roll_rate *= about_x;
    speeds.pitch_rate *= about_y;
    speeds.yaw_rate *= about_z;
    return speeds;
}

inline Creepage mirrored(const Creepage& creepage, const Mirror& mirror) {
    return {mirror.of_vector()[0] * creepage.longitudinal, mirror.of_vector()[1] * creepage.lateral,
            mirror.of_turn()[2] * creepage.spin};
}

inline TangentialForce mirrored(const TangentialForce& force, const Mirror& mirror) {
    return {mirror.of_vector()[0] * force.longitudinal, mirror.of_vector()[1] * force.lateral,
            mirror.of_turn()[2] * force.moment};
}

inline Outline mirrored(const Outline& outline, const Mirror& mirror) {
    const auto [x, y, z] = mirror.of_vector();
    ArrayX<double> lines = outline.y(), trailing = lines, leading = lines;
    const Eigen::Index last = lines.size() - 1;
    for (Eigen::Index i = 0; i <= last; ++i) {
        const double from = outline.y()[y < 0 ? last - i : i];
        const double ends[] = {outline.trailing(from), outline.leading(from)};
        lines[i] = double(y) * from;
        trailing[i] = double(x) * ends[x < 0 ? 1 : 0];
        leading[i] = double(x) * ends[x < 0 ? 0 : 1];
    }
    return {lines, trailing, leading};
}

}  // namespace rollbem
