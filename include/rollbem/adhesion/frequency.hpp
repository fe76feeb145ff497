// Frequency response: harmonic creepage, (G' - i (omega/V) G) p = xi, Eq. (16), and the complex creep coefficient.
// One LU per frequency, or for sweeps one reduction to Hessenberg form and then O(n^2) per frequency.
#pragma once

#include "../detail/decl.hpp"

#include <complex>
#include <optional>
#include <vector>

#include "../system/rolling_system.hpp"
#include "response.hpp"

namespace rollbem {

/// The creep coefficient c11, or all k x k coefficients, at many frequencies. With M = G'^-1 G = U H U^T and H in
/// Hessenberg form, (G' - s G) p = xi becomes (I - s H) (U^T p) = U^T G'^-1 xi: one O(n^3) reduction on construction,
/// then O(n^2) per frequency. If rcond(G') is too small to rely on M, each frequency has its own LU decomposition; see
/// reduced(). Const objects may be shared by threads.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const FrequencySweep sweep(rolling_system(Chebyshev{12}, StripKernel<double>(10, 0.72, 0.28)));
///     double last = 10;
///     for (const double z : {0.0, 0.5, 1.0, 2.0}) {  // omega a/V
///         const double size = std::abs(sweep(z).c11());
///         if (!(size < last)) return 1;
///         last = size;
///     }
/// }
/// \endcode
///
/// Responses have no unknowns. Their residual belongs to the reduced equations; their rcond comes from one more
/// right-hand side, and coefficients are accurate to eps/rcond. With several subsystems both are the worst of all.
class FrequencySweep {
public:
    using Complex = std::complex<double>;

    /// A sweep of one system.
    explicit FrequencySweep(RollingSystem<double> system);
    /// A sweep of several uncoupled subsystems, as patch_subsystems makes them: the creepages of the first come first,
    /// then the creepages of the next. Throws std::invalid_argument if there is none.
    explicit FrequencySweep(std::vector<RollingSystem<double>> parts);

    /// Whether the reduction is used in all subsystems.
    bool reduced() const;

    /// Response at z = omega a/V, of either sign. Throws std::invalid_argument if z is not finite.
    Response<Complex> operator()(double z) const;

    /// Response to creepages e^{st}. Throws std::invalid_argument if s is not finite.
    Response<Complex> at(Complex s) const;

private:
    struct Reduced {
        MatrixX<double> H;
        MatrixX<double> steady, outputs;  // U^T G'^-1 inputs, U^T outputs
        double norm = 0;
    };

    struct Column;  // internal

    struct Part {
        RollingSystem<double> system;
        Eigen::Index first;  // index of its first creepage among all creepages
        bool consistent;     // the steady tractions oppose the creepage
        std::optional<Reduced> reduced;
    };

    void add(RollingSystem<double> part);

    // (I - s H) y = b column by column from the right: one column operation, with the larger of two pivots, eliminates
    // the entry below the diagonal; the remaining column gives one unknown of the triangular system and is not needed
    // again. The column operations are applied to the unknowns at the end, O(n).
    static Response<Complex> solve_reduced(const Reduced& reduced, const Complex& s);

    // Adds the coefficients of input j and the largest residual so far, from the solution y.
    static void finish(const Reduced& reduced, const Column& y, Eigen::Index j, const Complex& ratio, double scale,
                       double norm, Response<Complex>& point);

    std::vector<Part> parts_;
    Eigen::Index input_count_ = 0;
};

}  // namespace rollbem

#ifndef ROLLBEM_COMPILED
#include "impl/frequency.ipp"
#endif
