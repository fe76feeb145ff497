// The tangent of a force element is the derivative of its values.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "laws/force_element.hpp"

namespace laws {

/// How well a tangent is a derivative, in values over their sizes per input over its size.
struct Exactness {
    int scenes = 60;
    double step = 1e-3;     ///< of an input, over its size
    double error = 1e-6;    ///< over the largest derivative of the scene, or over 1
    double share = 1;       ///< of the derivatives that are that exact; higher derivatives may jump beside the others
    double rough = 2e-2;    ///< the error of all, over the same
    bool is_curved = true;  ///< central differences show their second order
};

/// Compares tangents with central differences of two steps, extrapolated; in ROLLBEM_TANGENT_SCENES scenes, if set.
inline void has_tangent(const ForceElement& of, const Exactness& exactness = {}) {
    const Numbers in = sizes(of.inputs), out = sizes(of.values);
    int exact = 0, all = 0, other_branch = 0;
    std::vector<double> ratios;
    const char* const wanted = std::getenv("ROLLBEM_TANGENT_SCENES");
    for_each_scene(of, wanted != nullptr ? std::atoi(wanted) : exactness.scenes, [&](const Numbers& x) {
        const Answer at = of.answer(x);
        REQUIRE(at.status == Status::ok);
        const Eigen::Index rows = at.tangent.rows();
        const auto over_sizes = [&](const Numbers& slope, Eigen::Index j) {
            return in[j] * slope.cwiseQuotient(out.head(rows)).cwiseAbs().maxCoeff();
        };
        double scale = 1;
        for (Eigen::Index j = 0; j < at.tangent.cols(); ++j) scale = std::max(scale, over_sizes(at.tangent.col(j), j));
        for (Eigen::Index j = 0; j < at.tangent.cols(); ++j) {
            bool same = true;
            const auto central = [&](double h) -> Numbers {
                Numbers more = x, less = x;
                more[j] += h;
                less[j] -= h;
                const Answer above = of.answer(more), below = of.answer(less);
                for (const Answer& beside : {above, below}) {
                    same = same && beside.branch == at.branch && beside.status == Status::ok;
                }
                return (above.values - below.values).head(rows) / (more[j] - less[j]);
            };
            const double h = exactness.step * in[j];
            const Numbers far = central(h), close = central(h / 2);
            if (!same) {
                ++other_branch;
                continue;
            }
            const auto error = [&](const Numbers& slope) { return over_sizes(slope - at.tangent.col(j), j) / scale; };
            const double found = error((4 * close - far) / 3);
            CAPTURE(j, found, at.tangent.col(j).transpose(), close.transpose());
            CHECK(found < exactness.rough);
            exact += found < exactness.error ? 1 : 0;
            ++all;
            if (error(far) > 1e2 * found && error(far) > 1e-7) ratios.push_back(error(far) / error(close));
        }
    });
    CAPTURE(of.name, exact, all, other_branch);
    CHECK(exact >= exactness.share * all);
    CHECK(other_branch < all);
    if (!exactness.is_curved) return;
    REQUIRE(ratios.size() > 10);
    std::nth_element(ratios.begin(), ratios.begin() + static_cast<long>(ratios.size() / 2), ratios.end());
    CHECK(std::abs(ratios[ratios.size() / 2] - 4) < 0.2);
}

}  // namespace laws
