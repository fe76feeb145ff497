// Normal pressures given at points of a line contact or on a grid over a patch, and their means over elements.
#pragma once

#include "../detail/decl.hpp"

#include <vector>

#include "../discretisation/mesh.hpp"
#include "../types.hpp"
#include "hertz.hpp"

namespace rollbem {

/// Pressure that is linear between given points, and zero before the first and after the last. Two points at the same x
/// make a jump. Invariant: -1 <= x/a <= 1, ascending; pressures finite, not negative, with a positive integral.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PressureTable triangle(Eigen::Array3d(-1, 0, 1), Eigen::Array3d(0, 1e9, 0));  // x/a, p_n [Pa]
///     return triangle(cosine_mesh(20)).maxCoeff() < 1e9 && triangle.integral() == 1e9 ? 0 : 1;
/// }
/// \endcode
class PressureTable {
public:
    /// Points x/a [-] and the pressures there [Pa, or any unit]. Throws std::invalid_argument if they break the
    /// invariant or the lengths differ.
    PressureTable(ArrayX<double> x_over_a, ArrayX<double> pressure);

    /// Integral of the pressure over x/a: the load per width over a.
    double integral() const;

    /// The pressure at x/a [-], in the unit of the pressures; at a jump, the pressure ahead of it.
    double operator()(double x_over_a) const;

    /// The mean over each element of a mesh, in the unit of the pressures.
    ArrayX<double> operator()(const Mesh<double>& mesh) const;

private:
    // on the segment that ends at point j
    double at(double x, Eigen::Index j) const;

    ArrayX<double> x_, pressure_;
};

/// Pressure that is bilinear between the points of a grid, and zero outside it. Invariant: at least two x and two y,
/// strictly ascending; pressures finite, not negative, with a positive integral.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PressureGrid even(Eigen::Array2d(-1, 1), Eigen::Array2d(-1, 1), Eigen::Matrix2d::Constant(1e9));
///     return even.integral() == 4e9 ? 0 : 1;  // over 2 x 2
/// }
/// \endcode
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
    ArrayX<double> operator()(const std::vector<PatchMesh<double>::Rectangle>& elements) const;

private:
    /// Weights of the values at the knots in the integral of their linear interpolation from `low` to `high`; `first`
    /// is the index of the first weight's knot.
    struct Weights {
        Eigen::Index first;
        std::vector<double> values;
    };

    static void require_ascending(const char* number, const char* name, const ArrayX<double>& knots);

    static Weights weights(const ArrayX<double>& knots, double low, double high);

    double over(const PatchMesh<double>::Rectangle& element) const;

    ArrayX<double> x_, y_;
    MatrixX<double> pressure_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/pressure.ipp"
#endif
