// Weights of the nodes of a contact table along its three coordinates, with their derivatives. All are C1.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace rollbem::detail {

/// The slope at a node from the differences before and after it, over steps of different lengths.
template <class Value>
Value slope_between(const Value& before, double step_before, const Value& after, double step_after) {
    return (before * step_after + after * step_before) * (1 / (step_before + step_after));
}

/// The slope, limited to three times the smaller difference and to 0 at extrema: no overshoot (Fritsch and Carlson
/// 1980).
inline double limited(double slope, double before, double after) {
    if (!(before * after > 0)) return 0;
    const double most = 3 * (std::min)(std::abs(before), std::abs(after));
    return std::clamp(slope, -most, most);
}

/// Weights of cubic Hermite interpolation in one interval: of both values, then both slopes; and their derivatives.
struct HermiteWeights {
    std::array<double, 4> value, rate;

    HermiteWeights(double at, double low, double high) {
        const double step = high - low, t = (at - low) / step;
        value = {(1 + 2 * t) * (1 - t) * (1 - t), t * t * (3 - 2 * t), step * t * (1 - t) * (1 - t),
                 step * t * t * (t - 1)};
        rate = {6 * t * (t - 1) / step, 6 * t * (1 - t) / step, (1 - t) * (1 - 3 * t), t * (3 * t - 2)};
    }
};

/// The interval of ascending nodes that holds a place; beyond the nodes, the first or last interval.
inline std::size_t interval_of(const std::vector<double>& nodes, double at) {
    const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, at);
    return static_cast<std::size_t>(above - nodes.begin()) - 1;
}

/// Weights of all nodes of a row of at most `most`.
template <std::size_t most>
struct RowWeights {
    std::array<double, most> value{}, rate{};
};

/// Weights of the polynomial in yaw^2 through all nodes, which are not negative and begin with 0.
template <std::size_t most>
RowWeights<most> even_weights(const std::vector<double>& yaws, double yaw) {
    RowWeights<most> weights;
    for (std::size_t i = 0; i < yaws.size(); ++i) {
        double value = 1, slope = 0;  // weight, and its slope by yaw^2
        for (std::size_t j = 0; j < yaws.size(); ++j) {
            if (j == i) continue;
            const double per_apart = 1 / (yaws[i] * yaws[i] - yaws[j] * yaws[j]),
                         factor = (yaw * yaw - yaws[j] * yaws[j]) * per_apart;
            slope = slope * factor + value * per_apart;
            value *= factor;
        }
        weights.value[i] = value;
        weights.rate[i] = 2 * yaw * slope;
    }
    return weights;
}

/// Weights of the nodes in [first, last); all others are 0.
template <std::size_t most>
struct LocalWeights : RowWeights<most> {
    std::size_t first, last;
};

/// Weights of cubic Hermite interpolation with slopes of parabolas through three nodes; beyond the nodes constant.
template <std::size_t most>
LocalWeights<most> hermite_weights(const std::vector<double>& nodes, double at) {
    const std::size_t count = nodes.size();
    if (count == 1 || at <= nodes.front() || at >= nodes.back()) {
        const std::size_t end = count > 1 && at >= nodes.back() ? count - 1 : 0;
        LocalWeights<most> weights{{}, end, end + 1};
        weights.value[end] = 1;
        return weights;
    }
    const std::size_t i = interval_of(nodes, at);
    LocalWeights<most> weights{{}, i > 0 ? i - 1 : 0, (std::min)(i + 3, count)};
    const HermiteWeights own(at, nodes[i], nodes[i + 1]);
    const auto step = [&](std::size_t k) { return nodes[k + 1] - nodes[k]; };
    const auto add_difference = [&](std::size_t k, double value, double rate) {  // difference of nodes k, k + 1
        const double per_step = 1 / step(k);
        weights.value[k] -= value * per_step;
        weights.value[k + 1] += value * per_step;
        weights.rate[k] -= rate * per_step;
        weights.rate[k + 1] += rate * per_step;
    };
    for (const std::size_t end : {std::size_t(0), std::size_t(1)}) {
        const std::size_t node = i + end;
        weights.value[node] += own.value[end];
        weights.rate[node] += own.rate[end];
        const double value = own.value[2 + end], rate = own.rate[2 + end];
        if (node == 0 || node + 1 == count) {
            add_difference(node == 0 ? 0 : count - 2, value, rate);
            continue;
        }
        const double before = step(node - 1), after = step(node), sum = before + after;
        add_difference(node - 1, value * after / sum, rate * after / sum);
        add_difference(node, value * before / sum, rate * before / sum);
    }
    return weights;
}

}  // namespace rollbem::detail
