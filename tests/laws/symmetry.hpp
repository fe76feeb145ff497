// Mirror images of inputs have mirror images of values and tangents.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "laws/force_element.hpp"

namespace laws {

/// `tolerance` is over the sizes; 0 means to the last bit.
inline void is_symmetric(const ForceElement& of, double tolerance = 0, int scenes = 50) {
    const Numbers in = sizes(of.inputs);
    const auto signs = [](const std::string& text) {
        Numbers result(static_cast<Eigen::Index>(text.size()));
        for (std::size_t i = 0; i < text.size(); ++i) result[static_cast<Eigen::Index>(i)] = text[i] == '-' ? -1 : 1;
        return result;
    };
    REQUIRE(!of.symmetries.empty());
    for (const Symmetry& symmetry : of.symmetries) {
        const Numbers turned = signs(symmetry.inputs), image = signs(symmetry.values),
                      out = sizes(of.values).head(image.size());
        double moved = 0;
        for_each_scene(of, scenes, [&](const Numbers& x) {
            const Answer one = of.answer(x), other = of.answer(x.cwiseProduct(turned));
            INFO(symmetry.name);
            REQUIRE(other.status == one.status);
            const auto apart = [&](const Numbers& values, const Numbers& from) {
                return (values - from).cwiseQuotient(out).cwiseAbs().maxCoeff();
            };
            const Numbers expected = one.values.head(image.size()).cwiseProduct(image);
            CHECK(apart(other.values.head(image.size()), expected) <= tolerance);
            moved = std::max(moved, apart(one.values.head(image.size()), expected));
            const Eigen::Index rows = one.tangent.rows();
            for (Eigen::Index j = 0; j < one.tangent.cols(); ++j) {
                const Numbers slope = turned[j] * one.tangent.col(j).cwiseProduct(image.head(rows));
                const double error = (other.tangent.col(j) - slope).cwiseQuotient(out.head(rows)).cwiseAbs().maxCoeff();
                CHECK(error * in[j] <= tolerance);
            }
        });
        CHECK((moved > 1e-3 || (image.array() > 0).all()));
    }
}

}  // namespace laws
