// Contact: the contact area and material of two-dimensional tangential rolling contact: half-length a, half-width b,
// shear modulus G and Poisson's ratio nu, checked once on construction.
#pragma once

#include <limits>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"

namespace rollbem {

/// Sizes and material of a contact area 2a x 2b. Invariant: 1e-120 <= a <= 1e60, 0 < b <= inf,
/// 0 < G < inf, 0 <= nu <= 0.5.
///
/// \code
/// #include <rollbem/line.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const Contact contact({5e-3, 0.05, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const auto steady = solve_steady(Chebyshev{8}, StripKernel<double>::longitudinal(contact));
///     return creep_force(contact, steady, 1e-4) < 0 ? 0 : 1;  // [N]; positive creepage, negative force
/// }
/// \endcode
///
/// The contact is -a <= x <= a with the leading edge at x = +a and the trailing edge at x = -a. Any consistent set of
/// units may be used; SI units are given here. The shape of every solution depends on nu and b/a alone: a and G only
/// set its scale.
class Contact {
public:
    struct Parameters {
        double half_length;                                           ///< a [m], in the rolling direction x
        double half_width = std::numeric_limits<double>::infinity();  ///< b [m]; infinite for steady problems only
        double shear_modulus;                                         ///< G [Pa] of both (equal) bodies
        double poisson_ratio;                                         ///< nu [-]
    };

    /// Throws std::invalid_argument naming the parameter that breaks the invariant.
    explicit Contact(const Parameters& parameters) : parameters_(parameters) {
        const Parameters& p = parameters_;
        detail::require_half_length("Contact", p.half_length);
        detail::require(!detail::is_nan(p.half_width) && p.half_width > 0, "Contact", "half_width", p.half_width,
                        "be positive");
        detail::require_positive("Contact", "shear_modulus", p.shear_modulus);
        detail::require_poisson_ratio("Contact", p.poisson_ratio);
        detail::require(aspect() > 0, "Contact", "half_width / half_length", aspect(), "be positive");
    }

    /// The contact with a = G = 1 and b = `aspect`.
    static Contact dimensionless(double aspect, double poisson_ratio) {
        detail::require(!detail::is_nan(aspect) && aspect > 0, "Contact", "aspect", aspect, "be positive");
        return Contact({.half_length = 1, .half_width = aspect, .shear_modulus = 1, .poisson_ratio = poisson_ratio});
    }

    double half_length() const { return parameters_.half_length; }
    double half_width() const { return parameters_.half_width; }
    /// 2b, the width over which friction's results are totals; 1 where b is infinite: results are then per metre.
    double width() const { return detail::is_finite(half_width()) ? 2 * half_width() : 1.0; }
    double shear_modulus() const { return parameters_.shear_modulus; }
    double poisson_ratio() const { return parameters_.poisson_ratio; }
    double aspect() const { return parameters_.half_width / parameters_.half_length; }  ///< b/a [-]

private:
    Parameters parameters_;
};

}  // namespace rollbem
