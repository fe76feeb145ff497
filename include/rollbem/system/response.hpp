// Response: the result of a linear problem in full adhesion, steady, G' p = inputs, Eq. (15), or under creepages
// e^{st}, Eq. (16). Lines, patches and Chebyshev states, real or complex, share it and one rule of its validity.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "../scene/contact.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Unknowns and forces per unit of each of k creepages, dimensionless; Value is real for steady rolling, else complex.
/// Creepage, tractions and force act along the kernel's direction: with a lateral kernel c11 is c22.
template <class Value>
struct Response {
    using Scalar = typename Eigen::NumTraits<Value>::Real;

    /// Unknowns, n x k:
    ///
    /// - elements: p / (G creepage) on body 1, trailing to leading, against the creepage;
    /// - a patch: p_x, then p_y;
    /// - solve_steady(Chebyshev, kernel): the coefficients of a Chebyshev::Traction.
    ///
    /// Empty in sweeps.
    MatrixX<Value> unknowns{};
    MatrixX<Value> coefficients{};  ///< k x k: entry (i, j) is minus force i per creepage j
    /// k x k: estimates of the relative errors of the coefficients, for Chebyshev states and for patches that were also
    /// solved on other meshes; otherwise empty.
    MatrixX<Scalar> error_estimates{};
    Scalar residual = 0;  ///< |A p - inputs| / (|A| |p| + |inputs|) in the maximum norm, A = G' - s G [-]
    Scalar rcond = 0;     ///< estimate of 1 / (|A| |A^-1|) in the 1-norm [-]
    Status status = Status::not_finite;

    /// The first coefficient: Kalker's creep coefficient of a line, -F_bar / (a G xi), Eq. (30); see steady_c11 for
    /// b >> a.
    Value c11() const {
        return coefficients.size() > 0 ? coefficients(0, 0) : Value(std::numeric_limits<Scalar>::quiet_NaN());
    }
    /// The error estimate of c11; NaN if there is none.
    Scalar error_estimate() const {
        return error_estimates.size() > 0 ? error_estimates(0, 0) : std::numeric_limits<Scalar>::quiet_NaN();
    }
};

/// Force on body 1 [N] of a line contact in steady rolling, over its width(): -a G c11 xi per metre, Eq. (30).
inline double creep_force(const Contact& contact, const Response<double>& steady, double creepage) {
    return -contact.width() * contact.half_length() * contact.shear_modulus() * steady.c11() * creepage;
}

}  // namespace rollbem
