// Linear interpolation between ascending places.
#pragma once

#include "language.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rollbem::detail {

/// The value at x, linear between the places, which ascend, and constant beyond them.
inline double linear_between(const std::vector<double>& places, const std::vector<double>& values, double x) {
    const auto above = std::upper_bound(places.begin(), places.end(), x);
    if (above == places.begin()) return values.front();
    if (above == places.end()) return values.back();
    const auto k = static_cast<std::size_t>(above - places.begin());
    const double share = (x - places[k - 1]) / (places[k] - places[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
}

}  // namespace rollbem::detail
