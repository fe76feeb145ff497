// A normal pressure given at points of the contact, and its mean over elements, for friction problems whose pressure is
// not Hertz's.
#pragma once

#include "../detail/decl.hpp"

#include "../discretisation/mesh.hpp"
#include "../types.hpp"

namespace rollbem {

/// Pressure that is linear between given points, and zero before the first and after the last. Two points at the same x
/// make a jump. Invariant: -1 <= x/a <= 1, ascending; pressures finite, not negative, with a positive integral.
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

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/pressure_table.ipp"
#endif
