// Bodies of spectral/chebyshev.hpp. Internal.
#pragma once

#include "../chebyshev.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Core>
#include <Eigen/LU>

#include "../../adhesion/state_space.hpp"
#include "../../closed_form/carter.hpp"
#include "../../detail/circle_table.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/reciprocal_condition.hpp"
#include "../../detail/require.hpp"
#include "../../elasticity/detail/plane_model.hpp"
#include "../../status.hpp"
#include "../../system/detail/contact_fit.hpp"
#include "../../system/detail/response_parts.hpp"
#include "../../system/response.hpp"
#include "../../system/rolling_system.hpp"
#include "../../types.hpp"
#include "../detail/chebyshev_compliance.hpp"
#include "../detail/quotient.hpp"

namespace rollbem {

template <class Scalar_>
MatrixX<Scalar_> Chebyshev::System<Scalar_>::rates() const {
    const Eigen::Index m = this->size();
    MatrixX<Scalar> A(m, m);
    // T_k' = 2k (T_{k-1} + T_{k-3} + ...), where T_0 counts half
    const auto derivative = [](Eigen::Index i, Eigen::Index k) {
        if (i >= k || (k - i) % 2 == 0) return Scalar(0);
        return static_cast<Scalar>(i == 0 ? k : 2 * k);
    };
    for (Eigen::Index k = 0; k < m; ++k) {
        for (Eigen::Index i = 0; i < m; ++i) A(i, k) = derivative(i, k) + derivative(i, m) * last_[k];
    }
    return A;
}

template <LineKernel Kernel>
Chebyshev::System<typename Kernel::Scalar> rolling_system(const Chebyshev& method, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    detail::require_stable_model(kernel);
    const SmoothSplit<Scalar> split = detail::chebyshev_split(method.states, kernel);
    detail::require(detail::is_finite(split.constant), "Chebyshev", "constant part of the kernel", split.constant,
                    "be finite: an infinite half-width is for steady problems only");
    const Eigen::Index m = method.states;
    const MatrixX<Scalar> inverse = detail::chebyshev_stiffness(kernel, split, m);

    VectorX<Scalar> last(m), sums(m + 1);
    for (Eigen::Index k = 0; k <= m; ++k) {
        sums[k] = 0;
        for (Eigen::Index i = 0; i <= m; ++i) sums[k] += inverse(i, k);
    }
    for (Eigen::Index k = 0; k < m; ++k) last[k] = -sums[k] / sums[m];
    MatrixX<Scalar> stiffness(m + 1, m);
    ArrayX<Scalar> weights(m);
    for (Eigen::Index k = 0; k < m; ++k) {
        for (Eigen::Index i = 0; i <= m; ++i) stiffness(i, k) = inverse(i, k) + inverse(i, m) * last[k];
        weights[k] = std::numbers::pi_v<Scalar> * stiffness(0, k);
    }

    const detail::CircleTable<Scalar> circle(m);
    MatrixX<Scalar> G(m, m), G_prime(m, m);
    ArrayX<Scalar> points(m);
    for (Eigen::Index l = 0; l < m; ++l) {
        const Eigen::Index theta = 2 * (m - l) - 1;  // angle of x_l = cos(theta pi/2m)
        points[l] = circle.cosine(theta);
        const Scalar sine = circle.sine(theta);
        const Scalar slope_m = (theta % 4 == 1 ? static_cast<Scalar>(m) : -static_cast<Scalar>(m)) / sine;
        Eigen::Index angle = 0;  // k theta
        for (Eigen::Index k = 0; k < m; ++k) {
            G(l, k) = circle.cosine(angle);
            G_prime(l, k) = static_cast<Scalar>(k) * circle.sine(angle) / sine + slope_m * last[k];
            angle += theta;
            if (angle >= circle.size()) angle -= circle.size();
        }
    }
    return {{std::move(G), std::move(G_prime), std::move(weights),
             detail::origin_of<Scalar>(kernel, std::move(points), true)},
            std::move(last),
            std::move(stiffness)};
}

}  // namespace rollbem

namespace rollbem::detail {

template <LineKernel Kernel>
Response<typename Kernel::Scalar> solve_chebyshev_steady(const Chebyshev& method, const Kernel& kernel) {
    using Scalar = typename Kernel::Scalar;
    const SmoothSplit<Scalar> split = detail::chebyshev_split(method.states, kernel);
    const Eigen::Index m = method.states;
    const Scalar carter = 1 / (std::numbers::pi_v<Scalar> * split.strength);
    MatrixX<Scalar> equations = detail::scaled_compliance(kernel, split, m);
    equations.row(0).setOnes();
    VectorX<Scalar> right = VectorX<Scalar>::Zero(m + 1);
    right[1] = carter;
    const Eigen::PartialPivLU<MatrixX<Scalar>> lu(equations);
    Response<Scalar> response;
    response.unknowns = lu.solve(right);
    const auto a = response.unknowns.col(0);
    response.coefficients.setConstant(1, 1, -std::numbers::pi_v<Scalar> * a[0]);
    if (!detail::all_finite(response.unknowns) || !detail::is_finite(response.c11())) return response;
    response.rcond = detail::reciprocal_condition(lu, detail::one_norm(equations));
    response.residual = std::numeric_limits<Scalar>::quiet_NaN();  // not computed
    const auto by_smooth_part = [&](Eigen::Index k) {
        return std::abs(k == 0 ? a[0] + carter : k == 1 ? a[1] - carter : a[k]);
    };
    const Scalar rounding = static_cast<Scalar>(m + 1) * std::numeric_limits<Scalar>::epsilon();
    const Scalar error = 2 * (by_smooth_part(m - 1) + by_smooth_part(m)) / std::abs(a[0]) + rounding;
    response.error_estimates.setConstant(1, 1, error);
    response.status =
        detail::is_finite(error) ? detail::trust<Scalar>(m + 1, response.rcond, 0, 100) : Status::ill_conditioned;
    if (response.status == Status::ok && !(error <= Scalar(1e-2))) response.status = Status::not_converged;
    return response;
}

}  // namespace rollbem::detail

namespace rollbem {

template <LineKernel Kernel>
Response<typename Kernel::Scalar> solve_steady(const Chebyshev& method, const Kernel& kernel) {
    return detail::solve_chebyshev_steady(method, kernel);
}

template <class Value>
auto Chebyshev::Traction<Value>::operator()(const EdgeDistances<Scalar>& position) const -> Value {
    return detail::quotient_by_leading(coefficients, position.leading) *
           std::sqrt(position.leading / position.trailing);
}

template <class Scalar_>
auto Chebyshev::System<Scalar_>::with_spin() const -> RollingSystem<Scalar> {
    detail::require(this->size() >= 2, "Chebyshev::System", "number of states", this->size(),
                    "be at least 2: spin acts on the second");
    return this->with_spin_by("Chebyshev::System", std::numbers::pi_v<Scalar> / 2 * stiffness_.row(1).transpose());
}

inline StateSpace state_space(const Chebyshev::System<double>& system) {
    const Eigen::Index m = system.size();
    StateSpace result{.A = system.rates(),
                      .B = MatrixX<double>::Zero(m, 1),
                      .C = -system.outputs().transpose(),
                      .D = MatrixX<double>::Zero(1, 1)};
    result.B(0, 0) = -1;
    return result;
}

template <class Scalar_>
template <class Value>
auto Chebyshev::System<Scalar_>::traction(const VectorX<Value>& unknowns) const -> Traction<Value> {
    detail::require(unknowns.size() == this->size(), "Chebyshev::System", "number of unknowns", unknowns.size(),
                    "equal the number of states");
    return {stiffness_.template cast<Value>() * unknowns};
}

}  // namespace rollbem
