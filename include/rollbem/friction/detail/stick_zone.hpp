// Steady rolling with slip behind a border c and stick from there to the leading edge, in closed form and Chebyshev
// series. Dimensionless (a = G = 1) and for creepage >= 0; nothing here checks that the picture holds.
#pragma once

#include "../../detail/language.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../../detail/array_functions.hpp"
#include "../../detail/gauss_legendre.hpp"
#include "../../types.hpp"

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

/// What is known of a solution: all that tractions and slip are evaluated from. y = 1 + c is the distance of the border
/// from the trailing edge.
///
/// In slip p = -bound(x), in stick p = p_1 + p_2. With h(s) = bound(s) sqrt((1+s)/(1-s)), s = -1 + y (1 + cos phi)/2 and
/// h = sum h_n cos(n phi) in slip, the logarithmic part of the kernel alone gives
/// - in stick p_1 = -sqrt((1-x)/(1+x)) sum h_n rho^n, rho = y/(sqrt(1+x) + sqrt(x-c))^2, and a slope pi S h_0 of slip
///   and p_1 together, S the kernel's strength;
/// - in slip the slope pi S h_0 - pi S sqrt((1-x)/(1+x)) sum h_n sin(n phi).
/// (From the inversion of the finite Hilbert transform bounded at both ends: the integrals over the stick zone that
/// it asks for are elementary, those over the slip zone are the coefficients h_n.) p_2 = sqrt(1-t^2) sum q_k U_k(t),
/// t = -1 ... 1 in stick, answers the kernel's smooth part; there is none for the plane kernel.
template <class Scalar>
struct StickZone {
    Scalar y = 0;
    Scalar creepage = 0;
    Scalar strength = 1;  // S
    ArrayX<Scalar> h, q;
    ArrayX<Scalar> places, loads;  // sum of loads[j] f(places[j]): integral of p f, f as smooth as the smooth part

    Scalar traction(Scalar x) const {  // of stick
        const Scalar behind = std::max(x + (1 - y), Scalar(0)), root = std::sqrt(1 + x) + std::sqrt(behind);
        if (!(y > 0)) return 0;
        const Scalar rho = y / (root * root), small = std::numeric_limits<Scalar>::epsilon() / 4;
        Scalar sum = 0, power = 1;
        for (Eigen::Index n = 0; n < h.size() && power > small; ++n, power *= rho) sum += h[n] * power;
        Scalar p = -std::sqrt((1 - x) / (1 + x)) * sum;
        if (q.size() > 0 && y < 2) {
            const Scalar ahead = 1 - x, length = 2 - y;
            p += 2 * std::sqrt(behind * ahead) / length *
                 second_kind_sum(q, 0, std::clamp<Scalar>((behind - ahead) / length, -1, 1));
        }
        return p;
    }

    template <class SmoothSlope>
    Scalar slip(Scalar x, const SmoothSlope& smooth_slope) const {  // of slip, over the rolling velocity
        const Scalar pi = std::numbers::pi_v<Scalar>;
        const Scalar to_border = std::max(y - (1 + x), Scalar(0));
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

/// The M points phi = (j + 1/2) pi/M of the midpoint rule in an angle: Gauss and Chebyshev's in its cosine.
template <class Scalar>
struct AngularPoints {
    ArrayX<Scalar> cosine, rise;  // cos(phi), and (1 + cos(phi))/2 without cancellation

    explicit AngularPoints(Eigen::Index M) : cosine(M), rise(M) {
        for (Eigen::Index j = 0; j < M; ++j) {
            const Scalar half = std::cos((Scalar(2 * j + 1) / Scalar(4 * M)) * std::numbers::pi_v<Scalar>);
            rise[j] = half * half;
            cosine[j] = 2 * rise[j] - 1;
        }
    }
    Eigen::Index size() const { return rise.size(); }
    /// Of the integral of a function of (1 + cos(phi))/2 = 0 ... 1.
    Scalar weight(Eigen::Index j) const {
        return std::sqrt(rise[j] * (1 - rise[j])) * std::numbers::pi_v<Scalar> / static_cast<Scalar>(size());
    }
};

/// Points and orders of one level of accuracy.
template <class Scalar>
struct StickZoneRule {
    const AngularPoints<Scalar>* points;  // of the slip zone
    Eigen::Index unknowns;                // N: q_0 ... q_{N-2} and one more; 0 without a smooth part
    ArrayX<Scalar> eta, omega;            // K of integrals of even functions from 0 to 1: Gauss-Legendre

    StickZoneRule(const AngularPoints<Scalar>& slip_points, Eigen::Index N, Eigen::Index K)
        : points(&slip_points), unknowns(N), eta(K), omega(K) {
        if (K == 0) return;
        const QuadratureRule<Scalar> rule = gauss_legendre<Scalar>(2 * K);
        for (Eigen::Index j = 0; j < K; ++j) {
            eta[j] = rule.nodes[K + j];
            omega[j] = rule.weights[K + j];
        }
    }
};

/// The steady problem as a function of its border: the creepage that belongs to it is part of the answer.
template <class Scalar, class Kernel, class Bound>
class StickZoneProblem {
public:
    struct Point {
        Scalar creepage, force, tangent;
    };

    StickZoneProblem(const Kernel& kernel, const Bound& bound) : kernel_(kernel), bound_(bound) {
        zone_.strength = kernel.smooth_split().strength;
    }

    /// 0 <= y <= 2. At y = 0 nothing slips and nothing is loaded; at y = 2 all slips.
    Point evaluate(Scalar y, const StickZoneRule<Scalar>& rule) {
        const Scalar pi = std::numbers::pi_v<Scalar>, S = zone_.strength;
        const Eigen::Index M = rule.points->size();
        zone_.y = y;
        values_.resize(M);
        Scalar h_0 = 0, h_1 = 0;
        for (Eigen::Index j = 0; j < M; ++j) {
            const Scalar from_trailing = y * rule.points->rise[j];
            values_[j] = bound_(from_trailing - 1) * std::sqrt(from_trailing / (2 - from_trailing));
            h_0 += values_[j];
            h_1 += values_[j] * rule.points->cosine[j];
        }
        h_0 /= static_cast<Scalar>(M);
        h_1 *= 2 / static_cast<Scalar>(M);
        Point point{pi * S * h_0, -pi * (h_0 - h_1 * y / 4), -(2 - y) / (2 * S)};
        if (rule.unknowns > 0) add_smooth_part(rule, point);
        return point;
    }

    /// The zone of the last evaluation, at its creepage plus `excess`: no more than what is left of a root.
    const StickZone<Scalar>& zone(Scalar creepage, const StickZoneRule<Scalar>& rule) {
        if (rule.unknowns == 0) transform(rule);
        zone_.creepage = creepage;
        return zone_;
    }

private:
    /// h_n from the values. A long series is that of a pressure with kinks: what lies beyond is of their size over its
    /// order squared, and dies out ahead of the border.
    void transform(const StickZoneRule<Scalar>& rule) {
        const Eigen::Index M = values_.size(), count = std::min<Eigen::Index>(M, 1024);
        ArrayX<Scalar>& h = zone_.h;
        h.resize(count);
        now_ = constant_array(M, Scalar(1));
        before_ = rule.points->cosine;
        Scalar largest = 0;
        for (Eigen::Index n = 0; n < count; ++n) {
            h[n] = dot(values_.data(), now_.data(), M) * (n == 0 ? 1 : 2) / static_cast<Scalar>(M);
            largest = std::max(largest, std::abs(h[n]));
            for (Eigen::Index j = 0; j < M; ++j) {
                const Scalar next = 2 * rule.points->cosine[j] * now_[j] - before_[j];
                before_[j] = now_[j];
                now_[j] = next;
            }
        }
        Eigen::Index kept = count;
        while (kept > 1 && std::abs(h[kept - 1]) <= 4 * std::numeric_limits<Scalar>::epsilon() * largest) --kept;
        h.conservativeResize(kept);
    }

    /// With p_2 = sqrt((1-t)/(1+t)) [D + (1+t) sum q_k U_k(t)] the slope in stick is that of all tractions at N
    /// Chebyshev points; D, which no bounded traction has, is linear in the creepage and vanishes at the one that is
    /// sought.
    void add_smooth_part(const StickZoneRule<Scalar>& rule, Point& point) {
        const Scalar pi = std::numbers::pi_v<Scalar>, S = zone_.strength, y = zone_.y;
        const Eigen::Index N = rule.unknowns, K = rule.eta.size(), points = 2 * N;
        transform(rule);
        ArrayX<Scalar>& places = zone_.places;
        ArrayX<Scalar>& loads = zone_.loads;
        places.resize(2 * K + points);
        loads.resize(2 * K + points);
        // slip: x = -1 + y eta^2, on which sqrt(1+x) is smooth. p_1: 1 + x = y cosh^2 u, rho = exp(-2u), which resolves
        // the layer at the border however thin; u = U (1 - eta^2), on which sqrt(1-x) is smooth.
        const Scalar U = y > 0 ? std::asinh(std::sqrt((2 - y) / y)) : Scalar(0);
        for (Eigen::Index j = 0; j < K; ++j) {
            const Scalar eta = rule.eta[j], from_trailing = y * eta * eta;
            places[j] = from_trailing - 1;
            loads[j] = -bound_(places[j]) * 2 * y * eta * rule.omega[j];
            const Scalar u = U * (1 - eta * eta), wave = std::sinh(u), rho = std::exp(-2 * u);
            Scalar sum = 0, power = 1;
            for (Eigen::Index n = 0; n < zone_.h.size() && power > std::numeric_limits<Scalar>::epsilon() / 4;
                 ++n, power *= rho) {
                sum += zone_.h[n] * power;
            }
            const Scalar ahead = y * std::sinh(U * eta * eta) * std::sinh(U + u);  // 1 - x
            places[K + j] = y * wave * wave + (y - 1);
            loads[K + j] = -4 * std::sqrt(std::max(ahead, Scalar(0)) * y) * wave * sum * U * eta * rule.omega[j];
        }
        const Scalar half = (2 - y) / 2, centre = y / 2;
        for (Eigen::Index l = 0; l < points; ++l) {
            const Scalar angle = pi * Scalar(l + 1) / Scalar(2 * points + 1), sine = std::sin(angle);
            places[2 * K + l] = centre + half * std::cos(2 * angle);
            loads[2 * K + l] = half * 4 * pi / Scalar(2 * points + 1) * sine * sine;
        }
        MatrixX<Scalar> system(N, N), right(N, 2), slopes(N, points), modes(points, N);
        for (Eigen::Index i = 0; i < N; ++i) {
            const Scalar angle = (Scalar(2 * i + 1) / Scalar(2 * N)) * pi, x = centre + half * std::cos(angle);
            Scalar known = 0;
            for (Eigen::Index j = 0; j < 2 * K; ++j) known += loads[j] * kernel_.smooth_slope(x - places[j]);
            for (Eigen::Index l = 0; l < points; ++l) {
                slopes(i, l) = loads[2 * K + l] * kernel_.smooth_slope(x - places[2 * K + l]);
            }
            right(i, 0) = 1;
            right(i, 1) = point.creepage + known;
            for (Eigen::Index k = 0; k < N; ++k) system(i, k) = -pi * S * std::cos(static_cast<Scalar>(k) * angle);
        }
        for (Eigen::Index l = 0; l < points; ++l) {
            const Scalar angle = 2 * pi * Scalar(l + 1) / Scalar(2 * points + 1);
            modes(l, 0) = 1;
            for (Eigen::Index k = 1; k < N; ++k) {
                modes(l, k) = (1 + std::cos(angle)) * std::sin(static_cast<Scalar>(k) * angle) / std::sin(angle);
            }
        }
        system.noalias() += slopes * modes;
        const MatrixX<Scalar> solution = Eigen::PartialPivLU<MatrixX<Scalar>>(system).solve(right);
        point.creepage = solution(0, 1) / solution(0, 0);
        const VectorX<Scalar> amplitudes = point.creepage * solution.col(0) - solution.col(1);
        const auto second = [&](auto&& column) { return N > 1 ? column[1] : Scalar(0); };
        zone_.q = amplitudes.tail(N - 1).array();
        point.force += half * pi / 2 * second(amplitudes);
        point.tangent = half * pi * (solution(0, 0) + second(solution.col(0)) / 2);
        const VectorX<Scalar> tractions = modes.rightCols(N - 1) * amplitudes.tail(N - 1);
        for (Eigen::Index l = 0; l < points; ++l) loads[2 * K + l] *= tractions[l];
    }

    const Kernel& kernel_;
    const Bound& bound_;
    StickZone<Scalar> zone_;
    ArrayX<Scalar> values_, now_, before_;
};

}  // namespace rollbem::detail
