// Reflections, which turn a left wheel into a right one and rolling backwards into rolling forward. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <array>
#include <cstddef>

#include "../../types.hpp"
#include "../creepage.hpp"
#include "../patch_contact.hpp"
#include "../wheelset.hpp"

namespace rollbem::detail {

/// A reflection that reverses x, y, both or neither of the track's axes, and with them x and s of planes of contact. It
/// is its own inverse. mirrored(value, mirror) is the image of a value.
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

/// Reflects a place or velocity, by its components, and a turn or its rates.
inline void reflect(const Mirror& mirror, const std::array<double*, 3>& vector, const std::array<double*, 3>& turn) {
    for (std::size_t k = 0; k < 3; ++k) {
        *vector[k] *= mirror.of_vector()[k];
        *turn[k] *= mirror.of_turn()[k];
    }
}

inline WheelsetPosition mirrored(WheelsetPosition of, const Mirror& mirror) {
    reflect(mirror, {&of.along, &of.lateral, &of.height}, {&of.roll, &of.pitch, &of.yaw});
    return of;
}

inline WheelsetSpeeds mirrored(WheelsetSpeeds of, const Mirror& mirror) {
    reflect(mirror, {&of.forward, &of.lateral, &of.vertical}, {&of.roll_rate, &of.pitch_rate, &of.yaw_rate});
    return of;
}

inline Creepage mirrored(const Creepage& creepage, const Mirror& mirror) {
    return {mirror.of_vector()[0] * creepage.longitudinal, mirror.of_vector()[1] * creepage.lateral,
            mirror.of_turn()[2] * creepage.spin};
}

inline TangentialForce mirrored(const TangentialForce& force, const Mirror& mirror) {
    return {mirror.of_vector()[0] * force.longitudinal, mirror.of_vector()[1] * force.lateral,
            mirror.of_turn()[2] * force.moment};
}

inline PatchContact::Outline mirrored(const PatchContact::Outline& outline, const Mirror& mirror) {
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

}  // namespace rollbem::detail
