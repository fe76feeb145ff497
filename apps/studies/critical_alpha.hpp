// The smallest alpha_T at which a scheme becomes unstable: a scan by the fast count, confirmed by settled signs. The
// unstable set need not be an interval, so the scan starts from below and bisects only the first crossing.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include <Eigen/LU>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/detail/finite.hpp>
#include <rollbem/detail/reciprocal_condition.hpp>

namespace rollbem::studies {

/// Range and resolution of the search of critical_alpha_T.
struct CriticalAlphaOptions {
    double first = 0.3, last = 1.5;  ///< range of alpha_T [-]
    double step = 5e-4;              ///< step of the scan [-]: unstable islands narrower than this can be missed
    double tolerance = 1e-5;         ///< tolerance of the crossing [-]
};

}  // namespace rollbem::studies

namespace rollbem::detail {

// Largest number of steps of the scan taken at once where nothing happens: both ends are stable, the angle of the
// eigenvalue nearest to the imaginary axis changes by at most a quarter, and G is far from singular. An eigenvalue can
// move fast only through infinity, where G is nearly singular.
inline constexpr long largest_stride = 16;

template <class Scalar, class Kernel, class SchemeOf>
class CriticalAlphaSearch {
public:
    CriticalAlphaSearch(const Mesh<Scalar>& mesh, const SchemeOf& scheme_of, const Kernel& kernel)
        : mesh_(mesh), scheme_of_(scheme_of), kernel_(kernel) {}

    struct Look {
        bool unstable;           // whether a settled sign is positive
        Scalar flattest_cosine;  // as in StabilityResult::Count; 0 if unknown
        bool regular;            // whether G is far from singular
    };

    Look look(double alpha_T) const {
        const ElementSystem<Scalar> system = rolling_system(mesh_, scheme_of_(alpha_T), kernel_);
        const StabilityResult::Count count = count_unstable(system);
        if (count.status == Status::ok && count.unstable_count == 0) {
            const Scalar rcond =
                reciprocal_condition(Eigen::PartialPivLU<MatrixX<Scalar>>(system.G()), one_norm(system.G()));
            return {false, count.flattest_cosine, rcond > Scalar(1e-6)};
        }
        return {judge_stability(system).certainly_unstable(), 0, false};
    }

private:
    const Mesh<Scalar>& mesh_;
    const SchemeOf& scheme_of_;
    const Kernel& kernel_;
};

}  // namespace rollbem::detail

namespace rollbem::studies {

/// The smallest alpha_T in [first, last] at which an eigenvalue certainly grows, to within `tolerance` from above;
/// empty if there is none. `scheme_of(alpha_T)` makes the scheme. Throws std::invalid_argument for an invalid range or
/// step, if a scheme does not fit the mesh, if G is not finite, or for a plane kernel with Lambda <= 0.
template <class Scalar, class SchemeOf, LineKernel Kernel>
requires RollingScheme<std::invoke_result_t<const SchemeOf&, double>, Scalar> std::optional<double> critical_alpha_T(
    const Mesh<Scalar>& mesh, const SchemeOf& scheme_of, const Kernel& kernel,
    const CriticalAlphaOptions& options = {}) {
    detail::require_finite("critical_alpha_T", "first", options.first);
    detail::require(detail::is_finite(options.last) && options.last >= options.first, "critical_alpha_T", "last",
                    options.last, "be finite and at least first");
    detail::require_positive("critical_alpha_T", "step", options.step);
    detail::require_positive("critical_alpha_T", "tolerance", options.tolerance);
    const detail::CriticalAlphaSearch<Scalar, Kernel, SchemeOf> search(mesh, scheme_of, kernel);
    const auto grid = [&options](long k) { return options.first + static_cast<double>(k) * options.step; };
    const long count = std::lround(std::floor((options.last - options.first) / options.step * (1 + 1e-12)));

    auto here = search.look(grid(0));
    if (here.unstable) return grid(0);
    long k = 0, fine_until = 0;
    while (k < count) {
        const long stride = k < fine_until ? 1 : (std::min)(here.regular ? detail::largest_stride : 1, count - k);
        const auto next = search.look(grid(k + stride));
        if (stride > 1) {
            const bool quiet = !next.unstable && next.regular &&
                               std::abs(next.flattest_cosine - here.flattest_cosine) <=
                                   (std::min)(-here.flattest_cosine, -next.flattest_cosine) / 4;
            if (!quiet) {
                fine_until = k + stride;
                continue;
            }
        }
        if (next.unstable) {
            double stable = grid(k), unstable = grid(k + 1);
            while (unstable - stable > options.tolerance) {
                const double middle = stable + (unstable - stable) / 2;
                (search.look(middle).unstable ? unstable : stable) = middle;
            }
            return unstable;
        }
        here = next;
        k += stride;
    }
    return std::nullopt;
}

}  // namespace rollbem::studies
