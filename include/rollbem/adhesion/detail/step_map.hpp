// The linear map from the unknowns before a step to the unknowns after it, for steps of one distance at one
// half-length.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "../../rolling/detail/stage.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../types.hpp"
#include "rational_exponential.hpp"
#include "stage_factors.hpp"

namespace rollbem::detail {

/// C = A B without memory from the heap, which Eigen's product takes for large matrices.
template <class A, class B, class C>
void multiply(const A& a, const B& b, C& c) {
    constexpr Eigen::Index tile = 64;
    c.setZero();
    for (Eigen::Index j = 0; j < b.cols(); j += tile) {
        const Eigen::Index columns = (std::min)(tile, b.cols() - j);
        for (Eigen::Index m = 0; m < a.cols(); m += tile) {
            const Eigen::Index depth = (std::min)(tile, a.cols() - m);
            for (Eigen::Index i = 0; i < a.rows(); i += tile) {
                const Eigen::Index rows = (std::min)(tile, a.rows() - i);
                c.block(i, j, rows, columns).noalias() += a.block(i, m, rows, depth) * b.block(m, j, depth, columns);
            }
        }
    }
}

template <int directions>
class StepMap {
public:
    static constexpr Eigen::Index k = input_count<directions>;
    using Square = InputMatrix<directions>;

    explicit StepMap(Eigen::Index n)
        : Y_(MatrixX<double>::Zero(n, n + k)), map_(MatrixX<double>::Zero(n, n + 2 * k)), product_(map_) {}

    /// Whether the map belongs to a model's steps of dq [m].
    bool is_of(std::uint64_t model, double dq) const { return model == model_ && dq == dq_; }

    /// Steps of dq [m] of a model, a_0 = `unit` [m]. The map is found for h, which is dq/a_0 halved `doublings` times,
    /// and then doubled as often.
    struct Steps {
        std::uint64_t model;
        double dq, unit;
        int doublings;
    };
    /// Computes the map, O(n^3). Powers of Y = part h (G - part h G')^-1 G' give the change of y for h and, applied to
    /// the adjacent columns, the change due to the creepages, whose rigid slip is `slip`. `outputs` turn y into forces.
    void prepare(const Steps& steps, const Influence& influence, const RationalExponential& rational,
                 const MatrixX<double>& slip, const MatrixX<double>& outputs, StageFactors& factors) {
        model_ = steps.model;
        dq_ = steps.dq;
        const Eigen::Index n = Y_.rows();
        const double distance = rational.part * std::ldexp(steps.dq / steps.unit, -steps.doublings);
        Y_.leftCols(n) = distance * influence.G_prime;
        Y_.rightCols(k) = (rational.part / steps.unit) * slip;
        factors.prepare(steps.model, influence, {.distance = distance});
        for (Eigen::Index j = 0; j < n + k; ++j) factors.solve(Y_.col(j));
        add_power(rational, rational.degree);
        for (int j = rational.degree - 1; j >= 1; --j) {
            multiply(Y_.leftCols(n), map_, product_);
            map_.swap(product_);
            add_power(rational, j);
        }
        // two steps become one, with e^w - 1 in place of e^w, so that short steps keep their digits
        for (int doubling = 0; doubling < steps.doublings; ++doubling) {
            multiply(map_.leftCols(n), map_, product_);
            map_.rightCols(k) = 0.5 * map_.rightCols(k) + 0.25 * (map_.middleCols(n, k) + product_.rightCols(k));
            map_.middleCols(n, k) += 0.5 * product_.middleCols(n, k);
            map_.leftCols(n) += map_.leftCols(n) + product_.leftCols(n);
        }
        map_.rightCols(2 * k) *= -1;
        for (Eigen::Index i = 0; i < k; ++i) {
            for (Eigen::Index j = 0; j < k; ++j) {
                force_per_shift_(i, j) = outputs.col(i).dot(map_.col(n + j));
                force_per_ramp_(i, j) = outputs.col(i).dot(map_.col(n + k + j));
            }
        }
    }

    void apply(const VectorX<double>& from, const ImposedMotion<directions>& motion, VectorX<double>& to) const {
        const Eigen::Index n = Y_.rows();
        to = from + motion.shift[0] * map_.col(n) + motion.ramp[0] * map_.col(n + k);
        for (Eigen::Index j = 1; j < k; ++j) {
            to += motion.shift[j] * map_.col(n + j) + motion.ramp[j] * map_.col(n + k + j);
        }
        to.noalias() += map_.leftCols(n) * from;
    }

    Square tangent(const ImposedMotion<directions>& motion) const {
        return motion.shift_per_end * force_per_shift_ + motion.ramp_per_end * force_per_ramp_;
    }

private:
    void add_power(const RationalExponential& rational, int j) {
        const Eigen::Index n = Y_.rows();
        if (j == rational.degree) map_.setZero();
        map_.leftCols(n + k) += rational.b(j) * Y_;
        map_.rightCols(k) += rational.ramp_weight(j) * Y_.rightCols(k);
    }

    MatrixX<double> Y_;
    MatrixX<double> map_;  // [change, per shift, per ramp]: y_new - y = change y + per_shift v dq + per_ramp dv dq
    MatrixX<double> product_;
    Square force_per_shift_ = Square::Zero(), force_per_ramp_ = Square::Zero();
    std::uint64_t model_ = 0;
    double dq_ = -1;
};

}  // namespace rollbem::detail

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template class detail::StepMap<1>;
extern template class detail::StepMap<2>;
}  // namespace rollbem
#endif
