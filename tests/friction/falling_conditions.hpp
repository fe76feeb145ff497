// What a solution with friction that falls with slip must fulfil, evaluated anew from the matrices of the scene, in any
// scalar type.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <rollbem/friction/friction.hpp>

namespace falling_tests {

/// The largest violation of each condition over what rounding allows, 200 (n + 10) units in the last place.
template <class Scalar>
struct Violation {
    Scalar bound = 0;      ///< |p| <= mu p_n, and = where it slips
    Scalar stick = 0;      ///< no slip of elements that stick
    Scalar direction = 0;  ///< slip against traction
    Scalar friction = 0;   ///< mu of its equation; a velocity that is off by rounding is allowed for
    Scalar mu = 0;         ///< the largest difference of mu, for comparison with a residual

    Scalar worst() const { return std::max({bound, stick, direction, friction}); }
};

/// mu of the particle that comes to x/a = `x`: linear between the points, mu_s(0) at the leading edge and ahead of it.
template <class Scalar>
Scalar carried(const rollbem::ArrayX<Scalar>& points, const rollbem::ArrayX<Scalar>& mu, Scalar x, Scalar ahead) {
    const Eigen::Index n = points.size();
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        if (points[i] > x) continue;
        if (points[i] == x) return mu[i];  // the last point may lie at the edge or in front of it
        if (x >= 1) return ahead;
        const Scalar right = i == n - 1 ? Scalar(1) : points[i + 1], value = i == n - 1 ? ahead : mu[i + 1];
        return mu[i] + (x - points[i]) / (right - points[i]) * (value - mu[i]);
    }
    return mu[0];
}

/// Of a steady solution (`before` null, `way` 1) or of an implicit step by `way` (in a, as imposed slip and slip) from
/// `before`. `duration` [s] is that of the step, or of the passage of one half-length.
template <class Scalar, class Law>
Violation<Scalar> violation(const Law& law, const rollbem::FrictionMemory<Scalar>& memory,
                            const rollbem::ElementSystem<Scalar>& system, Scalar half_length, Scalar shear_modulus,
                            Scalar way, Scalar imposed, Scalar duration,
                            const rollbem::FrictionState<1, Scalar>* before,
                            const rollbem::FrictionState<1, Scalar>& after) {
    using std::abs;
    const Eigen::Index n = after.traction.size();
    const Scalar rounding = 200 * static_cast<Scalar>(n + 10) * std::numeric_limits<Scalar>::epsilon();
    const Scalar at_rest = law(Scalar(0));
    const rollbem::VectorX<Scalar> p = after.traction / shear_modulus;
    rollbem::VectorX<Scalar> slip = -way * (system.G_prime() * p);
    Scalar scale = abs(imposed) + way * (system.G_prime().cwiseAbs() * p.cwiseAbs()).maxCoeff();
    if (before != nullptr) {
        const rollbem::VectorX<Scalar> old = before->traction / shear_modulus;
        slip += system.G() * (p - old);
        scale += (system.G().cwiseAbs() * (p.cwiseAbs() + old.cwiseAbs())).maxCoeff();
    }
    slip.array() += imposed;
    const Scalar slip_rounding = rounding * scale, largest = after.friction_coefficient.maxCoeff() + at_rest;
    const Scalar traction_rounding = rounding * largest * after.normal_pressure.maxCoeff();
    const Scalar velocity_per_slip = half_length / duration;

    Violation<Scalar> worst;
    const auto raise = [](Scalar& value, Scalar to) { value = to <= value ? value : to; };  // to what is no number, too
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar mu = after.friction_coefficient[i], bound = mu * after.normal_pressure[i];
        const bool sticks = after.zones[static_cast<std::size_t>(i)] == rollbem::Zone::stick;
        const Scalar traction = after.traction[i], excess = abs(traction) - bound;
        raise(worst.bound, (sticks ? std::max(excess, Scalar(0)) : abs(excess)) / traction_rounding);
        if (sticks) raise(worst.stick, abs(slip[i]) / slip_rounding);
        if (!sticks && traction != 0) raise(worst.direction, (traction < 0 ? -slip[i] : slip[i]) / slip_rounding);
        const auto expected = [&](Scalar v) {
            if (!(after.normal_pressure[i] > 0)) return at_rest;
            if (memory.distance == 0) return Scalar(law(v));
            const Scalar came = before == nullptr ? (i == n - 1 ? at_rest : after.friction_coefficient[i + 1])
                                                  : carried(*system.points(), before->friction_coefficient,
                                                            (*system.points())[i] + way, at_rest);
            const Scalar time = before == nullptr ? duration * system.elements().intervals[i] : duration;
            const Scalar forgets = time * std::max(v, memory.least_velocity) / memory.distance;
            return (came + forgets * law(v)) / (1 + forgets);
        };
        const Scalar v = sticks ? Scalar(0) : abs(slip[i]) * velocity_per_slip, off = slip_rounding * velocity_per_slip;
        const Scalar middle = expected(v), difference = abs(mu - middle);
        const Scalar spread =
            sticks ? Scalar(0)
                   : std::max(abs(expected(v + off) - middle), abs(expected(std::max(v - off, Scalar(0))) - middle));
        raise(worst.friction, difference / (rounding * largest + spread));
        raise(worst.mu, difference);
    }
    return worst;
}

}  // namespace falling_tests
