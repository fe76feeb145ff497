// The equations of a stick zone that ends at a given border: creepage, force and tractions, for any kernel that offers
// the slope of its smooth part. Internal.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/LU>

#include <rollbem/detail/circle_table.hpp>
#include <rollbem/detail/gauss_legendre.hpp>
#include <rollbem/types.hpp>

#include "angular_points.hpp"
#include "stick_zone.hpp"

namespace rollbem::detail {

/// Points and orders of one level of accuracy.
template <class Scalar>
struct StickZoneRule {
    const AngularPoints<Scalar>* points = nullptr;  // points of the slip zone
    Eigen::Index unknowns = 0;                      // N: D and q_0 ... q_{N-2}; 0 without a smooth part
    Eigen::Index places = 0;                        // P, points of the integrals of the unknowns
    ArrayX<Scalar> eta, omega;                      // K Gauss-Legendre points for even functions from 0 to 1

    void set(const AngularPoints<Scalar>& slip_points, Eigen::Index N, Eigen::Index P, Eigen::Index K) {
        points = &slip_points;
        unknowns = N;
        places = P;
        if (K == eta.size()) return;
        const QuadratureRule<Scalar> rule = gauss_legendre<Scalar>(2 * K);
        eta = rule.nodes.tail(K);
        omega = rule.weights.tail(K);
    }
};

/// The steady problem as a function of its border: the creepage is part of the solution.
template <class Scalar, class Kernel, class Bound>
class StickZoneProblem {
public:
    struct Point {
        Scalar creepage, force, tangent;
    };

    StickZoneProblem(const Kernel& kernel, const Bound& bound) : kernel_(kernel), bound_(bound) {
        zone_.strength = kernel.smooth_split().strength;
    }

    /// 0 <= y <= 2. At y = 0 nothing slips and there is no load; at y = 2 everything slips.
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

    /// The zone of the last evaluation at `creepage`, which differs from its own creepage only by the tolerance of the
    /// search.
    const StickZone<Scalar>& zone(Scalar creepage, const StickZoneRule<Scalar>& rule) {
        if (rule.unknowns == 0) transform();
        zone_.creepage = creepage;
        return zone_;
    }

private:
    /// Transforms the values into h_n. A long series belongs to a pressure with kinks: the terms left out are of the
    /// size of the kinks over their order squared, and decay ahead of the border.
    void transform() {
        const Eigen::Index M = values_.size(), count = std::min<Eigen::Index>(M, 1024);
        const CircleTable<Scalar> circle(M);
        ArrayX<Scalar>& h = zone_.h;
        h.resize(count);
        Scalar largest = 0;
        for (Eigen::Index n = 0; n < count; ++n) {
            Scalar sum = 0;
            Eigen::Index angle = n;  // n (2 j + 1)
            for (Eigen::Index j = 0; j < M; ++j) {
                sum += values_[j] * circle.cosine(angle);
                angle += 2 * n;
                if (angle >= circle.size()) angle -= circle.size();
            }
            h[n] = sum * static_cast<Scalar>(n == 0 ? 1 : 2) / static_cast<Scalar>(M);
            largest = (std::max)(largest, std::abs(h[n]));
        }
        Eigen::Index kept = count;
        while (kept > 1 && std::abs(h[kept - 1]) <= 4 * std::numeric_limits<Scalar>::epsilon() * largest) --kept;
        h.conservativeResize(kept);
    }

    /// With p_2 = sqrt((1-t)/(1+t)) [D + (1+t) sum q_k U_k(t)] the slope in stick due to all tractions is imposed at N
    /// Chebyshev points; D, which must vanish for bounded tractions, is linear in the creepage and so determines it.
    void add_smooth_part(const StickZoneRule<Scalar>& rule, Point& point) {
        const Eigen::Index N = rule.unknowns, K = rule.eta.size(), points = rule.places;
        transform();
        zone_.places.resize(2 * K + points);
        zone_.loads.resize(2 * K + points);
        place_known_tractions(rule);
        place_unknown_tractions(2 * K, points);
        const MatrixX<Scalar> modes = modes_at_points(N, points);
        const MatrixX<Scalar> solution = amplitudes(N, 2 * K, point.creepage, modes);

        const Scalar pi = std::numbers::pi_v<Scalar>, half = (2 - zone_.y) / 2;
        point.creepage = solution(0, 1) / solution(0, 0);
        const VectorX<Scalar> amplitude = point.creepage * solution.col(0) - solution.col(1);
        const auto second = [&](auto&& column) { return N > 1 ? column[1] : Scalar(0); };
        zone_.q = amplitude.tail(N - 1).array();
        point.force += half * pi / 2 * second(amplitude);
        point.tangent = half * pi * (solution(0, 0) + second(solution.col(0)) / 2);
        const VectorX<Scalar> tractions = modes.rightCols(N - 1) * amplitude.tail(N - 1);
        for (Eigen::Index l = 0; l < points; ++l) zone_.loads[2 * K + l] *= tractions[l];
    }

    /// The tractions of slip and p_1, at K points each. Slip: x = -1 + y eta^2, on which sqrt(1+x) is smooth. p_1:
    /// 1 + x = y cosh^2 u, rho = exp(-2u), which resolves the layer at the border however thin; u = U (1 - eta^2), on
    /// which sqrt(1-x) is smooth.
    void place_known_tractions(const StickZoneRule<Scalar>& rule) {
        const Eigen::Index K = rule.eta.size();
        const Scalar y = zone_.y, U = y > 0 ? std::asinh(std::sqrt((2 - y) / y)) : Scalar(0);
        for (Eigen::Index j = 0; j < K; ++j) {
            const Scalar eta = rule.eta[j], from_trailing = y * eta * eta;
            zone_.places[j] = from_trailing - 1;
            zone_.loads[j] = -bound_(zone_.places[j]) * 2 * y * eta * rule.omega[j];
            const Scalar u = U * (1 - eta * eta), wave = std::sinh(u), rho = std::exp(-2 * u);
            const Scalar ahead = y * std::sinh(U * eta * eta) * std::sinh(U + u);  // 1 - x
            zone_.places[K + j] = y * wave * wave + (y - 1);
            zone_.loads[K + j] = -4 * std::sqrt((std::max)(ahead, Scalar(0)) * y) * wave * zone_.power_sum(rho) * U *
                                 eta * rule.omega[j];
        }
    }

    /// The points of p_2 over sqrt((1-t)/(1+t)) and their weights, stored from index `first`.
    void place_unknown_tractions(Eigen::Index first, Eigen::Index points) {
        const Scalar pi = std::numbers::pi_v<Scalar>, half = (2 - zone_.y) / 2, centre = zone_.y / 2;
        for (Eigen::Index l = 0; l < points; ++l) {
            const Scalar angle = pi * Scalar(l + 1) / Scalar(2 * points + 1), sine = std::sin(angle);
            zone_.places[first + l] = centre + half * std::cos(2 * angle);
            zone_.loads[first + l] = half * 4 * pi / Scalar(2 * points + 1) * sine * sine;
        }
    }

    /// The modes at the points of the unknown tractions: 1 for D, then (1+t) U_k(t).
    static MatrixX<Scalar> modes_at_points(Eigen::Index N, Eigen::Index points) {
        MatrixX<Scalar> modes(points, N);
        for (Eigen::Index l = 0; l < points; ++l) {
            const Scalar angle = 2 * std::numbers::pi_v<Scalar> * Scalar(l + 1) / Scalar(2 * points + 1);
            modes(l, 0) = 1;
            for (Eigen::Index k = 1; k < N; ++k) {
                modes(l, k) = (1 + std::cos(angle)) * std::sin(static_cast<Scalar>(k) * angle) / std::sin(angle);
            }
        }
        return modes;
    }

    /// Solves for D and q_k: column 0 holds them per unit creepage, column 1 the part to be subtracted. The first
    /// `known` points have their loads, which without a smooth part would cause the slope `creepage`.
    MatrixX<Scalar> amplitudes(Eigen::Index N, Eigen::Index known, Scalar creepage,
                               const MatrixX<Scalar>& modes) const {
        const Scalar pi = std::numbers::pi_v<Scalar>, half = (2 - zone_.y) / 2, centre = zone_.y / 2;
        MatrixX<Scalar> system(N, N), right(N, 2), slopes(N, modes.rows());
        for (Eigen::Index i = 0; i < N; ++i) {
            const Scalar angle = (Scalar(2 * i + 1) / Scalar(2 * N)) * pi, x = centre + half * std::cos(angle);
            const auto slope = [&](Eigen::Index j) {
                return zone_.loads[j] * kernel_.smooth_slope(x - zone_.places[j]);
            };
            Scalar known_slope = 0;
            for (Eigen::Index j = 0; j < known; ++j) known_slope += slope(j);
            for (Eigen::Index l = 0; l < modes.rows(); ++l) slopes(i, l) = slope(known + l);
            right(i, 0) = 1;
            right(i, 1) = creepage + known_slope;
            for (Eigen::Index k = 0; k < N; ++k) {
                system(i, k) = -pi * zone_.strength * std::cos(static_cast<Scalar>(k) * angle);
            }
        }
        system.noalias() += slopes * modes;
        return Eigen::PartialPivLU<MatrixX<Scalar>>(system).solve(right);
    }

    const Kernel& kernel_;
    const Bound& bound_;
    StickZone<Scalar> zone_;
    ArrayX<Scalar> values_;
};

}  // namespace rollbem::detail
