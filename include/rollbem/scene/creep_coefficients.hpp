// Kalker's creep coefficients of a contact patch.
#pragma once

#include "../detail/language.hpp"

namespace rollbem {

/// Kalker's creep coefficients: F_x = -G a b c11 xi, F_y = -G a b (c22 eta + c c23 phi),
/// M_z = -G a b c (c32 eta + c c33 phi) about the origin, with creepages xi, eta [-], spin phi [1/m] and c = sqrt(a b);
/// of an outline, c stands for a and b. In the limit of small elements c32 = -c23 if the patch is symmetric fore and
/// aft. Real for steady rolling, complex for harmonic creepage.
template <class Value>
struct CreepCoefficients {
    Value c11 = 0, c22 = 0, c23 = 0, c32 = 0, c33 = 0;
};

}  // namespace rollbem
