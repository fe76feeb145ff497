// The observed order of convergence.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace support {

/// Least-squares slope of -ln|errors| against ln(counts), the numbers of elements or of steps.
inline double observed_order(const std::vector<double>& counts, const std::vector<double>& errors) {
    const double count = static_cast<double>(counts.size());
    double mean_x = 0, mean_y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        mean_x += std::log(counts[i]) / count;
        mean_y += std::log(std::abs(errors[i])) / count;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double x = std::log(counts[i]) - mean_x;
        xx += x * x;
        xy += x * (std::log(std::abs(errors[i])) - mean_y);
    }
    return -xy / xx;
}

}  // namespace support
