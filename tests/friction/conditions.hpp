// What a solution with friction must fulfil, evaluated anew from the matrices of the scene, in any scalar type and with
// two directions, one of which may be empty.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include <rollbem/friction/friction.hpp>

namespace friction_conditions {

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
/// `before`, with slip that is not turned. `duration` [s] is that of the step, or of the passage of one half-length. A
/// state without coefficients has the constant one of `law`.
template <class Scalar, class Law>
Violation<Scalar> violation(const Law& law, const rollbem::FrictionMemory<Scalar>& memory,
                            const rollbem::ElementSystem<Scalar, 2>& system, Scalar half_length, Scalar shear_modulus,
                            Scalar way, const std::array<Scalar, 2>& imposed, Scalar duration,
                            const rollbem::FrictionState<2, Scalar>* before,
                            const rollbem::FrictionState<2, Scalar>& after) {
    using std::abs;
    const Eigen::Index n = after.traction.rows();
    const Scalar rounding = 200 * static_cast<Scalar>(n + 10) * std::numeric_limits<Scalar>::epsilon();
    const Scalar at_rest = law(Scalar(0));
    const auto coefficients = [&](const rollbem::FrictionState<2, Scalar>& state) -> rollbem::ArrayX<Scalar> {
        if (state.friction_coefficient.size() == 0) return rollbem::ArrayX<Scalar>::Constant(n, at_rest);
        return state.friction_coefficient;
    };
    const rollbem::ArrayX<Scalar> mus = coefficients(after), mus_before = coefficients(before ? *before : after);
    rollbem::ElementVectors<Scalar> slip(n, 2);
    Scalar scale = 0;
    for (std::size_t d = 0; d < 2; ++d) {
        const auto col = static_cast<Eigen::Index>(d);
        const rollbem::VectorX<Scalar> p = after.traction.col(col) / shear_modulus;
        const rollbem::MatrixX<Scalar>& G_prime = system.G_prime(d, d);
        slip.col(col) = -way * (G_prime * p);
        Scalar size = abs(imposed[d]) + way * (G_prime.cwiseAbs() * p.cwiseAbs()).maxCoeff();
        if (before != nullptr) {
            const rollbem::MatrixX<Scalar>& G = system.G(d, d);
            const rollbem::VectorX<Scalar> old = before->traction.col(col) / shear_modulus;
            slip.col(col) += G * (p - old);
            size += (G.cwiseAbs() * (p.cwiseAbs() + old.cwiseAbs())).maxCoeff();
        }
        slip.col(col).array() += imposed[d];
        scale += size;
    }
    const Scalar slip_rounding = rounding * scale, largest = mus.maxCoeff() + at_rest;
    const Scalar traction_rounding = rounding * largest * after.normal_pressure.maxCoeff();
    const Scalar velocity_per_slip = half_length / duration;

    Violation<Scalar> worst;
    const auto raise = [](Scalar& value, Scalar to) { value = to <= value ? value : to; };  // to what is no number, too
    for (Eigen::Index i = 0; i < n; ++i) {
        const Scalar mu = mus[i], bound = mu * after.normal_pressure[i];
        const bool sticks = after.zones[static_cast<std::size_t>(i)] == rollbem::Zone::stick;
        const Scalar x = after.traction(i, 0), y = after.traction(i, 1), u = slip(i, 0), w = slip(i, 1);
        const Scalar traction = std::hypot(x, y), excess = traction - bound, slid = std::hypot(u, w);
        raise(worst.bound, (sticks ? std::max(excess, Scalar(0)) : abs(excess)) / traction_rounding);
        if (sticks) raise(worst.stick, slid / slip_rounding);
        if (!sticks && traction != 0) {
            raise(worst.direction, std::max(abs(x * w - y * u), x * u + y * w) / (traction * slip_rounding));
        }
        const auto expected = [&](Scalar v) {
            if (!(after.normal_pressure[i] > 0)) return at_rest;
            if (memory.distance == 0) return Scalar(law(v));
            const auto& points = system.elements().x;
            const Scalar came = before == nullptr ? (i == n - 1 ? at_rest : mus[i + 1])
                                                  : carried(points, mus_before, points[i] + way, at_rest);
            const Scalar time = before == nullptr ? duration * system.elements().intervals[i] : duration;
            const Scalar forgets = time * std::max(v, memory.least_velocity) / memory.distance;
            return (came + forgets * law(v)) / (1 + forgets);
        };
        const Scalar v = sticks ? Scalar(0) : slid * velocity_per_slip, off = slip_rounding * velocity_per_slip;
        const Scalar middle = expected(v), difference = abs(mu - middle);
        const Scalar spread =
            sticks ? Scalar(0)
                   : std::max(abs(expected(v + off) - middle), abs(expected(std::max(v - off, Scalar(0))) - middle));
        raise(worst.friction, difference / (rounding * largest + spread));
        raise(worst.mu, difference);
    }
    return worst;
}

}  // namespace friction_conditions
