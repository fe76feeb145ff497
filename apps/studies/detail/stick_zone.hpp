// Steady rolling with slip behind a border c and stick from there to the leading edge, in closed form and Chebyshev
// series. Dimensionless (a = G = 1) and for creepage >= 0; whether slip and stick are so arranged is not checked here.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include <rollbem/types.hpp>

namespace rollbem::detail {

/// Sum of a_k U_k(t), by Clenshaw's recurrence.
template <class Scalar>
Scalar second_kind_sum(const ArrayX<Scalar>& a, Eigen::Index first, Scalar t) {
    Scalar one = 0, two = 0;
    for (Eigen::Index k = a.size() - 1; k >= first; --k) {
        const Scalar next = a[k] + 2 * t * one - two;
        two = one;
        one = next;
    }
    return one;
}

/// A solution: the data from which tractions and slip are evaluated. y = 1 + c is the distance of the border from the
/// trailing edge.
///
/// In slip p = -bound(x), in stick p = p_1 + p_2. With h(s) = bound(s) sqrt((1+s)/(1-s)), s = -1 + y (1 + cos phi)/2
/// and h = sum h_n cos(n phi) in slip, the logarithmic part of the kernel alone gives
/// - in stick p_1 = -sqrt((1-x)/(1+x)) sum h_n rho^n, rho = y/(sqrt(1+x) + sqrt(x-c))^2, and the slope pi S h_0 due to
///   slip and p_1 together, where S is the kernel's strength;
/// - in slip the slope pi S h_0 - pi S sqrt((1-x)/(1+x)) sum h_n sin(n phi).
/// (From the inversion of the finite Hilbert transform bounded at both ends: its integrals over the stick zone are
/// elementary, its integrals over the slip zone are the coefficients h_n.) p_2 = sqrt(1-t^2) sum q_k U_k(t), t = -1 ...
/// 1 in stick, balances the kernel's smooth part; it vanishes for the plane kernel.
template <class Scalar>
struct StickZone {
    Scalar y = 0;
    Scalar creepage = 0;
    Scalar strength = 1;  // S
    ArrayX<Scalar> h, q;
    ArrayX<Scalar> places, loads;  // sum of loads[j] f(places[j]): integral of p f for smooth f

    Scalar power_sum(Scalar rho) const {  // sum h_n rho^n, to rounding
        Scalar sum = 0, power = 1;
        for (Eigen::Index n = 0; n < h.size() && power > std::numeric_limits<Scalar>::epsilon() / 4;
             ++n, power *= rho) {
            sum += h[n] * power;
        }
        return sum;
    }

    Scalar traction(Scalar x) const {  // in stick
        const Scalar behind = (std::max)(x + (1 - y), Scalar(0)), root = std::sqrt(1 + x) + std::sqrt(behind);
        if (!(y > 0)) return 0;
        Scalar p = -std::sqrt((1 - x) / (1 + x)) * power_sum(y / (root * root));
        if (q.size() > 0 && y < 2) {
            const Scalar ahead = 1 - x, length = 2 - y;
            p += 2 * std::sqrt(behind * ahead) / length *
                 second_kind_sum(q, 0, std::clamp<Scalar>((behind - ahead) / length, -1, 1));
        }
        return p;
    }

    template <class SmoothSlope>
    Scalar slip(Scalar x, const SmoothSlope& smooth_slope) const {  // in the slip zone, over the rolling velocity
        const Scalar pi = std::numbers::pi_v<Scalar>;
        const Scalar to_border = (std::max)(y - (1 + x), Scalar(0));
        const Scalar cosine = std::clamp<Scalar>(1 - 2 * to_border / y, -1, 1);
        Scalar slip = creepage - pi * strength * (h.size() > 0 ? h[0] : Scalar(0));
        slip += 2 * pi * strength * std::sqrt((1 - x) * to_border) / y * second_kind_sum(h, 1, cosine);
        for (Eigen::Index j = 0; j < places.size(); ++j) slip -= loads[j] * smooth_slope(x - places[j]);
        if (q.size() > 0 && y < 2) {
            // behind the stick zone the slope of sqrt(1-t^2) U_k is -pi S r^(k+1), |r| < 1
            const Scalar root = std::sqrt(to_border) + std::sqrt(1 - x), r = -(2 - y) / (root * root);
            Scalar power = r;
            for (Eigen::Index k = 0; k < q.size(); ++k, power *= r) slip += pi * strength * q[k] * power;
        }
        return slip;
    }
};

}  // namespace rollbem::detail
