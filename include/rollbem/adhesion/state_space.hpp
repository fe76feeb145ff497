// A contact in full adhesion as linear ordinary differential equations, for programs with their own integrators,
// linearisation or controller design: dimensionless, and in SI units of a line or patch at a speed.
#pragma once

#include "../detail/decl.hpp"

#include "../scene/contact.hpp"
#include "../scene/patch_contact.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"

namespace rollbem {

/// The equations d x/d(q/a) = A x + B v, C x + D v = -forces, where q = V t is the distance rolled and x are the
/// unknowns of the system from which they were made, x = 0 at rest. The k inputs and outputs are dimensionless:
/// - v: creepages, and spin times a;
/// - forces: over a G per unit width, on a patch over G a^2; the moment over one more a.
/// The creep coefficients at s, in V/a, are C (s I - A)^-1 B + D; c11 if k = 1.
///
/// in_si() returns dx/dt = A x + B v, F = C x + D v in the same form:
/// - k = 1: one creepage [-] and its force on body 1 [N], of a line over the width 2b, negative for positive creepage;
/// - k = 3: xi, eta [-] and spin [1/m], F_x, F_y [N] and M_z [N m];
/// - A [1/s]; B [1/s], for spin [m/s]; C and D [N], for the moment [N m]; D for spin has one more [m].
/// The states remain dimensionless (Chebyshev states: displacement coefficients over a; elements: p/G).
struct StateSpace {
    MatrixX<double> A;     ///< n x n
    MatrixX<double> B, C;  ///< n x k, k x n
    MatrixX<double> D;     ///< k x k; zero, but for a reduced system
};

/// The state space of any system: A = G^-1 G', B = -G^-1 inputs, C = -outputs^T. Throws std::invalid_argument, naming
/// rcond(G), if G is singular to working precision (rcond <= 100 n eps), to which many elements with alpha_L = 0 come
/// close.
StateSpace state_space(const RollingSystem<double>& system);

/// Converts a state space to SI units, for a contact that rolls at `speed` V [m/s]: A V/a, B V/a, -2b a G C, -2b a G D,
/// with one more factor a for spin and for the moment. Throws std::invalid_argument unless V is positive and finite,
/// the contact's half-width is finite, and there is one input or three.
StateSpace in_si(const StateSpace& dimensionless, const Contact& contact, double speed);

/// Converts a state space of a patch to SI units: G a^2 takes the place of 2b a G; for an outline a is its c.
StateSpace in_si(const StateSpace& dimensionless, const PatchContact& contact, double speed);

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/state_space.ipp"
#endif
