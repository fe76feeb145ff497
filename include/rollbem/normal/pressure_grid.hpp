// A normal pressure given on a grid over a contact patch, and its mean over rectangular elements.
#pragma once

#include "../detail/decl.hpp"

#include <cstddef>
#include <vector>

#include "../types.hpp"
#include "hertz_ellipse.hpp"

namespace rollbem {

/// Pressure that is bilinear between the points of a grid, and zero outside it. Invariant: at least two x and two y,
/// strictly ascending; pressures finite, not negative, with a positive integral.
class PressureGrid {
public:
    /// x and y of the grid, in any unit of length, and the pressures [Pa, or any unit] at x[i], y[j] in row i, column
    /// j. Throws std::invalid_argument if they break the invariant or the sizes differ.
    PressureGrid(ArrayX<double> x, ArrayX<double> y, MatrixX<double> pressure);

    const ArrayX<double>& x() const { return x_; }
    const ArrayX<double>& y() const { return y_; }

    /// Integral of the pressure over the grid.
    double integral() const { return over({x_[0], x_[x_.size() - 1], y_[0], y_[y_.size() - 1]}); }

    /// The mean over each rectangle, exactly, in the unit of the pressures. Throws std::invalid_argument if one has no
    /// area.
    ArrayX<double> operator()(const std::vector<Rectangle<double>>& elements) const;

private:
    /// Weights of the values at the knots in the integral of their linear interpolation from `low` to `high`; `first`
    /// is the index of the first weight's knot.
    struct Weights {
        Eigen::Index first;
        std::vector<double> values;
    };

    static void require_ascending(const char* number, const char* name, const ArrayX<double>& knots);

    static Weights weights(const ArrayX<double>& knots, double low, double high);

    double over(const Rectangle<double>& element) const;

    ArrayX<double> x_, y_;
    MatrixX<double> pressure_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/pressure_grid.ipp"
#endif
