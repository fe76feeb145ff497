// Forces take work from steady motion: none of them feeds it.
#pragma once

#include "laws/force_element.hpp"

namespace laws {

/// The power of the forces against their motions is not negative, but for `tolerance` of |forces| |motions|.
inline void dissipates(const ForceElement& of, double tolerance = 1e-12, int scenes = 100) {
    const Eigen::Index n = static_cast<Eigen::Index>(of.motions);
    REQUIRE(n > 0);
    for_each_scene(of, scenes, [&](const Numbers& x) {
        const Answer at = of.answer(x);
        REQUIRE(at.status == Status::ok);
        const double least = -tolerance * at.values.head(n).cwiseAbs().dot(x.head(n).cwiseAbs());
        CHECK(-at.values.head(n).dot(x.head(n)) >= least);
    });
}

}  // namespace laws
