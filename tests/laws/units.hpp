// Values do not depend on the units of length, stress and time.
#pragma once

#include <cmath>
#include <cstddef>

#include "laws/force_element.hpp"

namespace laws {

/// In units of 1/8 m, 1/64 Pa and 1/2 s, powers of two and of the cube.
inline void keeps_units(const ForceElement& of, double tolerance = 1e-9, int scenes = 30) {
    const auto factors = [](const std::vector<Quantity>& quantities) {
        Numbers result = sizes(quantities);
        for (std::size_t i = 0; i < quantities.size(); ++i) {
            const Quantity& q = quantities[i];
            result[static_cast<Eigen::Index>(i)] = std::ldexp(1.0, 3 * q.length + 6 * q.stress + q.time);
        }
        return result;
    };
    const Numbers inputs = factors(of.inputs), values = factors(of.values), in = sizes(of.inputs),
                  out = sizes(of.values);
    for_each_scene(of, scenes, [&](const Numbers& x) {
        const Answer one = of.answer(x), other = of.answer(x.cwiseProduct(inputs));
        REQUIRE(one.status == Status::ok);
        REQUIRE(other.status == Status::ok);
        CHECK((other.values.cwiseQuotient(values) - one.values).cwiseQuotient(out).cwiseAbs().maxCoeff() <= tolerance);
        const Eigen::Index rows = one.tangent.rows();
        for (Eigen::Index j = 0; j < one.tangent.cols(); ++j) {
            const Numbers slope = inputs[j] * other.tangent.col(j).cwiseQuotient(values.head(rows));
            const double error = (slope - one.tangent.col(j)).cwiseQuotient(out.head(rows)).cwiseAbs().maxCoeff();
            CHECK(error * in[j] <= tolerance);
        }
    });
}

}  // namespace laws
