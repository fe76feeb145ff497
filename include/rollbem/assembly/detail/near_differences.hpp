// Entries near the singularity: differences of the logarithm's antiderivatives, in closed form. With equal widths,
// neighbours in a row share the values of the antiderivatives.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "../../detail/array_functions.hpp"
#include "../../elasticity/kernel_concepts.hpp"
#include "../../types.hpp"
#include "entries.hpp"

namespace rollbem::detail {

/// The integral over an element is a difference of the antiderivative at its edges; each average over 2 delta adds one
/// more difference, of the next antiderivative. Keeps references to its arguments.
template <class Scalar>
class NearDifferences {
public:
    using Array = ArrayX<Scalar>;

    NearDifferences(const Entries<Scalar>& entries, const SmoothSplit<Scalar>& split)
        : entries_(entries), split_(split) {}

    /// Writes every near entry to result(l, m).
    void fill(MatrixX<Scalar>& result) const {
        const Entries<Scalar>& entries = entries_;  // a local reference, which stays in a register
        const Eigen::Index n = entries.columns.half.size();
        const Scalar spread = Scalar(entries.averages + 1) / (2 * std::sqrt(Entries<Scalar>::far_ratio));
        std::vector<Run> runs;
        std::vector<Scalar> arguments;
        runs.reserve(static_cast<std::size_t>(entries.count));
        arguments.reserve(static_cast<std::size_t>(std::min<Eigen::Index>(16 * entries.count, 2048)));
        for (Eigen::Index l = 0; l < entries.count; ++l) {
            if (entries.equal_widths) {  // the near columns surround the point
                const Scalar nearest = entries.distance(l, 0) / (2 * entries.columns.half[0]);
                const Eigen::Index first = clamp_index(std::ceil(nearest - spread), n);
                const Eigen::Index end = clamp_index(std::floor(nearest + spread) + 1, n);
                if (end > first) append_run(l, first, end - first, runs, arguments);
            } else {
                for (Eigen::Index m = 0; m < n; ++m) {
                    const Eigen::Index first = m;
                    while (m < n && entries.is_near(l, m)) ++m;
                    if (m > first) append_run(l, first, m - first, runs, arguments);
                }
            }
            if (arguments.size() > 2048 || l + 1 == entries.count) {
                evaluate_runs(runs, arguments, result);
                runs.clear();
                arguments.clear();
            }
        }
    }

private:
    struct Run {
        Eigen::Index row, first, count, position;
    };

    // How often the logarithm is integrated: for the slope once for each average, for the displacement once more.
    int level() const { return entries_.averages + (entries_.slope() ? 0 : 1); }

    // of the logarithm; constants that cancel in the slope are left out
    Array antiderivative(const Array& x) const {
        const Scalar s = split_.strength;
        const bool slope = entries_.slope();
        if (level() == 1) {
            const Scalar constant = split_.constant + s;
            Array result = finite_log(x);
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                result[i] = slope ? -s * x[i] * result[i] : x[i] * (constant - s * result[i]);
            }
            return result;
        }
        if (level() == 2) {
            const Scalar constant = (2 * split_.constant + 3 * s) / 4;
            Array result = finite_log(x);
            for (Eigen::Index i = 0; i < x.size(); ++i) {
                const Scalar square = x[i] * x[i];
                result[i] = slope ? -s / 2 * square * result[i] : square * (constant - s / 2 * result[i]);
            }
            return result;
        }
        Array result(x.size());
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] = std::abs(x[i]);
        log_in_place(result);
        for (Eigen::Index i = 0; i < x.size(); ++i) result[i] *= -s;
        return result;
    }

    static Eigen::Index clamp_index(Scalar value, Eigen::Index n) {
        return static_cast<Eigen::Index>(std::clamp(value, Scalar(0), static_cast<Scalar>(n)));
    }

    // The differences run over the element's two edges and, once for each average, over +-delta about the point. With
    // equal widths all these steps are equal, so that neighbours share all but one evaluation.
    void append_run(Eigen::Index l, Eigen::Index first, Eigen::Index count, std::vector<Run>& runs,
                    std::vector<Scalar>& arguments) const {
        runs.push_back({l, first, count, static_cast<Eigen::Index>(arguments.size())});
        const Scalar delta = entries_.rows.half[l];
        if (entries_.equal_widths) {
            const Scalar h = entries_.columns.half[0];
            const Scalar start = entries_.distance(l, first) + Scalar(entries_.averages + 1) * h;
            for (Eigen::Index i = 0; i < count + entries_.averages + 1; ++i) {
                arguments.push_back(start - static_cast<Scalar>(2 * i) * h);
            }
            return;
        }
        for (int point = entries_.averages; point >= -entries_.averages; point -= 2) {
            const Scalar shift = Scalar(point) * delta;
            for (Eigen::Index m = first; m < first + count; ++m) {
                arguments.push_back(entries_.distance(l, m) + entries_.columns.half[m] + shift);
            }
            const Eigen::Index last = first + count - 1;
            arguments.push_back(entries_.distance(l, last) - entries_.columns.half[last] + shift);
        }
    }

    void evaluate_runs(const std::vector<Run>& runs, const std::vector<Scalar>& arguments,
                       MatrixX<Scalar>& result) const {
        if (arguments.empty()) return;
        Array x(static_cast<Eigen::Index>(arguments.size()));
        std::copy(arguments.begin(), arguments.end(), x.data());
        const Array values = antiderivative(x);
        const Entries<Scalar>& entries = entries_;
        for (const Run& run : runs) {
            Scalar divisor = 1;
            for (int i = 0; i < entries.averages; ++i) divisor *= 2 * entries.rows.half[run.row];
            for (Eigen::Index i = 0; i < run.count; ++i) {
                Scalar sum = 0;
                if (entries.equal_widths) {
                    const Scalar* v = values.data() + run.position + i;
                    sum = entries.averages == 0   ? v[0] - v[1]
                          : entries.averages == 1 ? (v[0] - v[1]) - (v[1] - v[2])
                                                  : ((v[0] - v[1]) - (v[1] - v[2])) - ((v[1] - v[2]) - (v[2] - v[3]));
                } else {
                    const Eigen::Index stride = run.count + 1;
                    const auto element = [&](Eigen::Index point) {
                        const Scalar* v = values.data() + run.position + point * stride + i;
                        return v[0] - v[1];
                    };
                    sum = entries.averages == 0   ? element(0)
                          : entries.averages == 1 ? element(0) - element(1)
                                                  : (element(0) - element(1)) - (element(1) - element(2));
                }
                result(run.row, run.first + i) = sum / divisor;
            }
        }
    }

    const Entries<Scalar>& entries_;
    const SmoothSplit<Scalar>& split_;
};

}  // namespace rollbem::detail
