// Full adhesion by Chebyshev polynomials instead of elements, for kernels with a logarithm: a few unknowns, with
// geometric convergence. The result is the same kind of system as for elements, so that all functions of a system
// accept it.
#pragma once

#include "../detail/decl.hpp"

#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include "../adhesion/state_space.hpp"
#include "../closed_form/carter.hpp"
#include "../elasticity/line_kernel.hpp"
#include "../system/response.hpp"
#include "../system/rolling_system.hpp"
#include "../types.hpp"

namespace rollbem {

/// The discretisation: m states u_0 ... u_{m-1}, the first Chebyshev coefficients of the displacement
/// u(x) = sum u_k T_k(x/a), for the traction p = sum_{k=0..m} a_k T_k(x/a)/sqrt(1 - (x/a)^2). Zero slip,
/// du/dx - du/dq = xi, holds in the coefficients of T_0 ... T_{m-1}; u_m follows from p = 0 at the leading edge,
/// sum a_k = 0 (the tau method).
struct Chebyshev {
    /// A traction by its coefficients: p/G, or p/(G xi), is sum a_k T_k(x/a)/sqrt(1 - (x/a)^2), where the a_k add up to
    /// zero. It vanishes like a square root at the leading edge and is infinite at the trailing one. Value is real, or
    /// complex for harmonic creepage.
    template <class Value>
    struct Traction {
        using Scalar = typename Eigen::NumTraits<Value>::Real;

        VectorX<Value> coefficients;

        Value operator()(const EdgeDistances<Scalar>& position) const;
        /// The traction at x/a. Throws std::invalid_argument unless -1 <= x/a <= 1.
        Value operator()(std::type_identity_t<Scalar> x_over_a) const {
            return (*this)(EdgeDistances<Scalar>::at(x_over_a));
        }
    };

    /// The system of Chebyshev states: its unknowns are the displacement coefficients u_0 ... u_{m-1}, in units of a,
    /// and its equations are zero slip at the m Chebyshev points, trailing to leading.
    ///
    /// \code
    /// #include <rollbem/line.hpp>
    ///
    /// int main() {
    ///     using namespace rollbem;
    ///     const Chebyshev::System<double> system = rolling_system(Chebyshev{12}, StripKernel<double>(10, 0.72, 0.28));
    ///     const auto response = solve_response(system, {0, 1});  // omega a/V = 1
    ///     const VectorX<std::complex<double>> unknowns = response.unknowns.col(0);
    ///     return std::abs(system.traction(unknowns)(0.5)) > 0 ? 0 : 1;  // |p/(G xi)| at x = a/2
    /// }
    /// \endcode
    ///
    /// Invariant: the invariant of RollingSystem, and the half-width is finite.
    template <class Scalar_>
    class System : public RollingSystem<Scalar_> {
    public:
        using Scalar = Scalar_;

        /// Takes the result of rolling_system(Chebyshev, kernel): u_m = last . u, and a_0 ... a_m = stiffness u.
        System(RollingSystem<Scalar> system, VectorX<Scalar> last, MatrixX<Scalar> stiffness)
            : RollingSystem<Scalar>(std::move(system)), last_(std::move(last)), stiffness_(std::move(stiffness)) {}

        /// p/G from the unknowns of any problem on the system, real or complex; also p/(G xi) from unknowns per
        /// creepage. Throws std::invalid_argument unless there are size() unknowns.
        template <class Value>
        Traction<Value> traction(const VectorX<Value>& unknowns) const;

        /// A = G^-1 G' without an inverse: du/dq = A u - e_0 xi, q = V t/a.
        MatrixX<Scalar> rates() const;

        /// The lateral system with spin. Inputs: lateral creepage, and spin times a, whose rigid slip is x at the
        /// Chebyshev points. Outputs: F_y over a G and the moment M_z = (pi/2) a_1 over a^2 G, both per width. Throws
        /// std::invalid_argument unless there are at least 2 states: spin acts on u_1.
        RollingSystem<Scalar> with_spin() const;

    private:
        VectorX<Scalar> last_;       // u_m = last . u
        MatrixX<Scalar> stiffness_;  // (m+1) x m: maps u to a_0 ... a_m
    };

    Eigen::Index states = 12;
};

/// The system of Chebyshev states: G = (T_k(x_l)) at the m Chebyshev points, whose condition is sqrt(2), and G' = G A =
/// (T_k'(x_l) + T_m'(x_l) last_k). Narrow strips need more states (recommended_scheme). Rounding does not limit the
/// number of states in double, but the fastest mode decays at about m^2/10, and for m >= 200 rcond(G') is too small for
/// the reduction of FrequencySweep. In float the status of a steady solution of the system is ill_conditioned above
/// some 60 states; the status of solve_steady(Chebyshev, kernel) never is. Throws std::invalid_argument unless
///
/// - there is at least one state;
/// - the half-width is finite (otherwise only solve_steady exists), and b/a >= 0.001;
/// - for a plane kernel, Lambda > 0, as its model is otherwise unstable in the time domain.
template <LineKernel Kernel>
Chebyshev::System<typename Kernel::Scalar> rolling_system(const Chebyshev& method, const Kernel& kernel);

/// Steady rolling at unit creepage; the unknowns are the coefficients of a Chebyshev::Traction, p/(G xi). The estimate
/// of c11's relative error is twice the contribution of the kernel's smooth part to the last two coefficients, which
/// decay geometrically; Status::not_converged if it exceeds 1e-2. The residual is not computed, but NaN.
///
/// In steady rolling u = x + a constant that is determined by sum a_k = 0, so that K_00 is not needed and an infinite
/// half-width has a solution. For the plane kernel a single state is exact. The kernel must be a LineKernel. Throws
/// std::invalid_argument unless there is at least one state and b/a >= 0.001.
template <LineKernel Kernel>
Response<typename Kernel::Scalar> solve_steady(const Chebyshev& method, const Kernel& kernel);

/// The state space of Chebyshev states: without an inverse, B = -e_0.
StateSpace state_space(const Chebyshev::System<double>& system);

/// The state space of a kernel with a number of states: 8 states are exact to rounding if nothing changes within a
/// contact length. Throws std::invalid_argument unless there is at least one state, the half-width is finite, b/a >=
/// 0.001 and, for a plane kernel, Lambda > 0.
template <LineKernel Kernel>
StateSpace state_space(const Chebyshev& method, const Kernel& kernel) {
    return state_space(rolling_system(method, kernel));
}

}  // namespace rollbem

#include "impl/chebyshev.tpp"

#ifdef ROLLBEM_COMPILED
namespace rollbem {
extern template Response<double> solve_steady<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
extern template Response<double> solve_steady<PlaneKernel<double>>(const Chebyshev&, const PlaneKernel<double>&);
extern template Response<double> solve_steady<StripKernel<double>>(const Chebyshev&, const StripKernel<double>&);
extern template Chebyshev::System<double> rolling_system<AnyKernel<double>>(const Chebyshev&, const AnyKernel<double>&);
extern template Chebyshev::System<double> rolling_system<PlaneKernel<double>>(const Chebyshev&,
                                                                              const PlaneKernel<double>&);
extern template Chebyshev::System<double> rolling_system<StripKernel<double>>(const Chebyshev&,
                                                                              const StripKernel<double>&);
}  // namespace rollbem
#endif
