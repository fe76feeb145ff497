// Random scenes and the law of friction that their solutions have to obey, of extremes_study and of the tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include <rollbem/friction/state.hpp>

namespace drawn {

/// Draws of a seed, but for normal() the same with every standard library.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : bits_(seed) {}

    int integer(int count) { return static_cast<int>(unit() * count); }  ///< below `count`
    int integer(int low, int high) { return low + integer(high - low + 1); }
    bool one_in(int count) { return integer(count) == 0; }
    double sign() { return one_in(2) ? -1 : 1; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    double decades(double low, double high) { return std::pow(10, uniform(low, high)); }
    double logarithmic(double low, double high) { return low * std::pow(high / low, unit()); }
    double normal() { return normal_(bits_); }

private:
    double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }

    std::mt19937_64 bits_;
    std::normal_distribution<double> normal_;
};

/// The distance of a solution from Coulomb's law, not a number where the solution has a value that is none.
template <class Scalar>
struct Violation {
    Scalar bound = 0;      ///< |p| <= bound, and = where it slips; a traction
    Scalar stick = 0;      ///< no slip of elements that stick; a slip
    Scalar direction = 0;  ///< slip against traction, up to 60 degrees off where it is turned; a slip
};

/// The violation by the rows of tractions and slips, whose columns are both directions.
template <class Tractions, class Slips, class Bounds, class Scalar = typename Slips::Scalar>
Violation<Scalar> violation(const Tractions& tractions, const Slips& slips, const Bounds& bounds,
                            const std::vector<rollbem::Zone>& zones, bool turned) {
    Violation<Scalar> worst;
    const auto raise = [](Scalar& value, Scalar to) { value = to <= value ? value : to; };  // to what is no number, too
    for (Eigen::Index i = 0; i < slips.rows(); ++i) {
        const Scalar x = tractions(i, 0), y = tractions(i, 1), u = slips(i, 0), w = slips(i, 1);
        const Scalar traction = std::hypot(x, y), excess = traction - bounds[i], slid = std::hypot(u, w);
        const bool sticks = zones[static_cast<std::size_t>(i)] == rollbem::Zone::stick;
        raise(worst.bound, sticks ? std::max(excess, Scalar(0)) : std::abs(excess));
        if (sticks) raise(worst.stick, slid);
        if (sticks || traction == 0) continue;
        const Scalar along = (x * u + y * w) / traction, across = (x * w - y * u) / traction;
        raise(worst.direction, turned ? along + slid / 2 : std::max(std::abs(across), along));
    }
    return worst;
}

}  // namespace drawn
