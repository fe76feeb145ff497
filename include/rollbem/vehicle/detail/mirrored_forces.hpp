// Mirror images of the forces of a wheel. Internal.
#pragma once

#include "../../detail/language.hpp"

#include <cstddef>

#include "../../scene/detail/mirror.hpp"
#include "../wheelset_forces.hpp"

namespace rollbem::detail {

inline PatchForce mirrored(PatchForce friction, const Mirror& mirror) {
    friction.creepage = mirrored(friction.creepage, mirror);
    friction.force = mirrored(friction.force, mirror);
    const auto [x, y, z] = mirror.of_vector();
    if (y < 0) {
        friction.edges = -friction.edges.reverse().eval();
        friction.strip_work = friction.strip_work.reverse().eval();
    }
    for (Yield::LoadedRectangle& element : friction.surface) {
        if (x < 0)
            element = {-element.x_2,        -element.x_1,       element.y_1,     element.y_2,
                       -element.traction_x, element.traction_y, element.pressure};
        if (y < 0)
            element = {element.x_1,        element.x_2,         -element.y_2,    -element.y_1,
                       element.traction_x, -element.traction_y, element.pressure};
    }
    return friction;
}

inline WheelsetForces::Wrench mirrored(WheelsetForces::Wrench wrench, const Mirror& mirror) {
    for (std::size_t i = 0; i < 3; ++i) {
        wrench.force[i] *= mirror.of_vector()[i];
        wrench.moment[i] *= mirror.of_turn()[i];
    }
    return wrench;
}

}  // namespace rollbem::detail
