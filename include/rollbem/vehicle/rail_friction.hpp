// Friction of a rail that varies over the rail's surface: a lubricated gauge face, a treated top.
#pragma once

#include "../detail/decl.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

namespace rollbem {

/// The coefficient of friction over the angle of the rail's surface or over its y, linear between the nodes and
/// constant beyond them.
class RailFriction {
public:
    /// Coordinate of the nodes: delta of the surface [rad], or y of the rail's profile [m], both as on the right rail.
    enum class Over { angle, y };

    /// Throws std::invalid_argument unless there is a node, nodes ascend, angles lie within a quarter turn and y within
    /// +-1 m, and coefficients are finite and not negative.
    RailFriction(Over over, std::vector<double> nodes, std::vector<double> coefficients);

    /// mu [-] where the surface has the angle [rad] and lies at y [m].
    double at(double angle, double y) const;

private:
    Over over_;
    std::vector<double> nodes_, coefficients_;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/rail_friction.ipp"
#endif
