// Far entries of a kernel that offers its Taylor coefficients. A term costs more than in the series for a logarithm,
// but the series serves any kernel that is smooth away from zero.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "../../detail/gauss_legendre.hpp"
#include "../../types.hpp"
#include "entries.hpp"
#include "kernel_view.hpp"

namespace rollbem::detail {

/// Taylor's series of the kernel about the distance d, integrated term by term. Keeps references to its arguments.
template <class Scalar>
class TaylorSeries {
public:
    using Array = ArrayX<Scalar>;

    /// `last`: far_ratio^last is below round-off.
    TaylorSeries(const Entries<Scalar>& entries, const KernelView<Scalar>& kernel, int last)
        : entries_(entries), kernel_(kernel), last_(last) {}

    /// Writes every far entry to result(l, m).
    void fill(MatrixX<Scalar>& result) const {
        const QuadratureRule<Scalar> rule = second_average<Scalar>(entries_.averages);
        std::vector<Eigen::Index> distant;
        for (Eigen::Index m = 0; m < entries_.columns.half.size(); ++m) {
            distant.clear();
            for (Eigen::Index l = 0; l < entries_.count; ++l) {
                if (!entries_.is_near(l, m)) distant.push_back(l);
            }
            if (distant.empty()) continue;
            Array d(static_cast<Eigen::Index>(distant.size())), delta(d.size());
            for (Eigen::Index i = 0; i < d.size(); ++i) {
                d[i] = entries_.distance(distant[static_cast<std::size_t>(i)], m);
                delta[i] = entries_.rows.half[distant[static_cast<std::size_t>(i)]];
            }
            for (const Eigen::Index l : distant) result(l, m) = 0;
            Array shifted(d.size());
            for (Eigen::Index k = 0; k < rule.nodes.size(); ++k) {
                for (Eigen::Index i = 0; i < d.size(); ++i) shifted[i] = d[i] + rule.nodes[k] * delta[i];
                const Array sum = taylor_sum(shifted, entries_.columns.half[m], delta);
                for (Eigen::Index i = 0; i < d.size(); ++i) {
                    result(distant[static_cast<std::size_t>(i)], m) += rule.weights[k] / 2 * sum[i];
                }
            }
        }
    }

private:
    using Table = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

    // sum of M_2j g^{(q+2j)}(d) / (2j)! with the moments of LogarithmicSeries
    Array taylor_sum(const Array& d, Scalar h, const Array& delta) const {
        const Eigen::Index q = entries_.slope() ? 1 : 0;
        const Table series = kernel_.taylor(d, 2 * last_ + q);
        const Eigen::Index size = d.size();
        Array A(size), B(size), sum(size), moment(size), power(size);
        for (Eigen::Index i = 0; i < size; ++i) {
            const Scalar outer = (entries_.averages > 0 ? h + delta[i] : h) / d[i], inner = (h - delta[i]) / d[i];
            A[i] = outer * outer;
            B[i] = entries_.averages > 0 ? inner * inner : Scalar(0);
            sum[i] = 0;
            moment[i] = 1;
            power[i] = B[i];
        }
        for (Eigen::Index j = 0; j <= last_; ++j) {
            const Scalar factor = entries_.averages > 0 ? 1 / Scalar((2 * j + 1) * (j + 1)) : 1 / Scalar(2 * j + 1);
            const Scalar weight = (q == 1 ? Scalar(2 * j + 1) : Scalar(1)) * factor;
            const Scalar* term = series.data() + (2 * j + q) * size;
            for (Eigen::Index i = 0; i < size; ++i) {
                sum[i] += weight * moment[i] * term[i];
                moment[i] = moment[i] * A[i] + power[i];
                power[i] *= B[i];
            }
        }
        for (Eigen::Index i = 0; i < size; ++i) sum[i] = 2 * h * (q == 1 ? sum[i] / d[i] : sum[i]);
        return sum;
    }

    const Entries<Scalar>& entries_;
    const KernelView<Scalar>& kernel_;
    int last_;
};

}  // namespace rollbem::detail
