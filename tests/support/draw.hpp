// Random draws.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace support {

/// Draws of a seed.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : generator_(seed) {}

    int integer(int count) { return static_cast<int>(generator_() % static_cast<unsigned>(count)); }  ///< below `count`
    bool one_in(int count) { return integer(count) == 0; }
    double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
    double decades(double low, double high) { return std::pow(10, uniform(low, high)); }
    double normal() { return normal_(generator_); }

private:
    std::mt19937_64 generator_;
    std::normal_distribution<double> normal_;
};

}  // namespace support
