// Action and reaction: forces on the wheel are those on the rail reversed, at their places.
#pragma once

#include <Eigen/Geometry>

#include "laws/force_element.hpp"

namespace laws {

/// Force and moment of the values are minus the sums over what acts on the rail.
inline void reacts(const ForceElement& of, double tolerance = 1e-12, int scenes = 20) {
    const Numbers out = sizes(of.values);
    for_each_scene(of, scenes, [&](const Numbers& x) {
        const Answer at = of.answer(x);
        Numbers sum = at.values.head(6);
        for (const Wrench& part : of.on_rail(x)) {
            sum.head(3) += part.force;
            sum.tail(3) += part.place.cross(part.force) + part.moment;
        }
        CHECK(at.values.head(6).norm() > 0);
        CHECK(sum.cwiseQuotient(out.head(6)).cwiseAbs().maxCoeff() <= tolerance);
    });
}

}  // namespace laws
