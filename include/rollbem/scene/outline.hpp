// Outline: a contact area that each line along the rolling direction cuts in one interval, given by its trailing and
// leading edges at some y, and straight between these.
#pragma once

#include "../detail/decl.hpp"

#include <algorithm>
#include <utility>

#include "../types.hpp"

namespace rollbem {

/// The edges of a contact area over y, linear between the given lines y = const. Creepages, spin and moment refer to
/// the origin of its coordinates.
///
/// Invariant: at least two lines, all numbers finite, y strictly increasing, trailing < leading; on the first and the
/// last line both may be equal (a tip). The area is positive and finite.
class Outline {
public:
    /// y, x of the trailing and x of the leading edge of each line [m, or any unit of length]. Throws
    /// std::invalid_argument, with the number of the line from 1, if they break the invariant.
    Outline(ArrayX<double> y, ArrayX<double> trailing, ArrayX<double> leading);

    const ArrayX<double>& y() const { return y_; }
    double low() const { return y_[0]; }               ///< smallest y
    double high() const { return y_[y_.size() - 1]; }  ///< largest y
    double area() const { return area_; }

    /// x of an edge at low() <= y <= high().
    double trailing(double y) const { return at(trailing_, y); }
    double leading(double y) const { return at(leading_, y); }

private:
    static void check(Eigen::Index line, const char* quantity, double value, bool holds, const char* rule);

    double at(const ArrayX<double>& edge, double y) const;

    ArrayX<double> y_, trailing_, leading_;
    double area_ = 0;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/outline.ipp"
#endif
