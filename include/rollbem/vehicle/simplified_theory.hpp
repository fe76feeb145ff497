// FASTSIM (Kalker 1982) and FaStrip (Sichani, Enblom and Berg 2016): creep forces of an ellipse by independent strips,
// as in most multibody programs.
#pragma once

#include "../detail/language.hpp"

#include <array>

#include "../scene/creepage.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"

namespace rollbem {

/// FASTSIM and FaStrip on one ellipse under Hertz's pressure, with Kalker's coefficients c11, c22 and c23 from any
/// source. Signs are as in Creepage. Convergence is of first order in the elements of a strip. Nothing allocates.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const PatchContact contact({6e-3, 4e-3, 8.2e10, 0.28});  // a, b [m], G [Pa], nu
///     const auto steady = solve_steady(contact, patch_mesh(contact, 8, 8), NodeDifference{Nodes::chebyshev});
///     const SimplifiedTheory theory(contact, creep_coefficients(contact, steady), 0.3, 80e3);
///     return theory.fastsim({1e-3, 5e-4, 0.1}).force.longitudinal < 0 ? 0 : 1;
/// }
/// \endcode
///
/// Invariant: the contact is an ellipse; c11, c22, c23, mu and N are positive and finite; there are at least 3 strips,
/// each of at least one element.
class SimplifiedTheory {
public:
    /// Largest traction of FASTSIM over the ellipse; both bounds carry mu N.
    enum class Bound {
        parabolic,  ///< mu 2N/(pi a b) (1 - x^2/a^2 - y^2/b^2): Kalker's, the pressure of simplified theory
        elliptic    ///< mu times Hertz's pressure
    };

    /// Strips of an ellipse, narrower towards its tips, and elements of equal length in each.
    struct Mesh {
        int strips = 10, elements = 10;
        Bound bound = Bound::parabolic;
    };

    /// An element in simplified theory; elements are found from the leading to the trailing edge of each strip.
    struct Element {
        int strip;                       ///< number of the strip, counted from y = -b
        double x, y;                     ///< its centre [m]
        double area;                     ///< [m^2]
        std::array<double, 2> traction;  ///< p_x, p_y on body 1 [Pa]
        std::array<double, 2>
            slip;  ///< slip of body 1 on body 2 over the rolling velocity [-]; FaStrip takes FASTSIM's
        bool slips;
    };

    /// Forces of simplified theory on body 1.
    struct Force {
        TangentialForce force{};             ///< NaN unless ok
        Status status = Status::not_finite;  ///< not_finite: creepages, or their forces; otherwise ok
    };

    /// Throws std::invalid_argument naming the parameter that breaks the invariant.
    SimplifiedTheory(const PatchContact& contact, const CreepCoefficients<double>& coefficients,
                     double friction_coefficient, double load, const Mesh& mesh);
    SimplifiedTheory(const PatchContact& contact, const CreepCoefficients<double>& coefficients,
                     double friction_coefficient, double load)
        : SimplifiedTheory(contact, coefficients, friction_coefficient, load, Mesh{}) {}

    /// Kalker's FASTSIM: displacement is proportional to traction, by the flexibilities L1 = 8a/(3 c11 G), L2 = 8a/(3
    /// c22 G) and L3 = pi a sqrt(a/b)/(4 c23 G), which give the linear law, and particles enter at the leading edge
    /// without traction. `visit` is called with each Element.
    template <class Visitor>
    Force fastsim(const Creepage& creepage, Visitor&& visit) const {
        return solve(creepage, false, visit);
    }
    Force fastsim(const Creepage& creepage) const {
        return solve(creepage, false, [](const Element&) {});
    }

    /// FaStrip. Elements in the stick zone follow strip theory: Carter's solution with lateral creepage and spin,
    /// scaled to Kalker's coefficients. All other elements have mu times Hertz's pressure in the direction of FASTSIM's
    /// traction, which has one flexibility in strips that slip from the leading edge on. The stick zone satisfies the
    /// strip's equations at any Poisson's ratio; published formulae weight spin beside lateral creepage by 1 - nu.
    /// Where |3 c c23 G phi/(2 pi mu p0)| >= 1, strip theory has no stick.
    template <class Visitor>
    Force fastrip(const Creepage& creepage, Visitor&& visit) const {
        return solve(creepage, true, visit);
    }
    Force fastrip(const Creepage& creepage) const {
        return solve(creepage, true, [](const Element&) {});
    }

private:
    /// Displacement over traction [m/Pa] by longitudinal and lateral creepage and by spin.
    struct Flexibility {
        double longitudinal, lateral, spin;
    };
    struct Strip {
        double y, half_length;
    };
    /// Tractions of a strip that sticks, over mu p0/a: `outer` times the half circle over the strip less `inner` times
    /// the one over its stick zone, whose middle lies `slip` ahead of the strip's, as it is shorter by 2 slip.
    struct StickZone {
        double slip;
        std::array<double, 2> outer, inner;

        bool holds(double x, const Strip& strip) const { return x > 2 * slip - strip.half_length; }
    };

    Flexibility flexibility() const;
    /// The mean of the three flexibilities, weighted by the creepages.
    Flexibility one_flexibility(const Creepage& at) const;

    /// Whether creepages are so small that no traction without a bound overflows on its way through the ellipse.
    bool is_in_range(const Creepage& at) const;

    /// Integral of sqrt(half_length^2 - x^2) from 0.
    static double half_circle(double x, double half_length);
    /// mu times the mean of Hertz's pressure over an element.
    double elliptic(double ahead, double behind, double half_length) const;
    double bound(double ahead, double behind, double half_length) const;

    /// Stick requires displacements with a constant slope along x and a slope that grows with x across it. Tractions of
    /// the slip zone behind continue the tractions of the stick zone and reach mu p.
    StickZone stick_zone(const Creepage& at, double y) const;

    /// One element of FASTSIM. On entry its traction is the traction of the element ahead. Particles come from the
    /// middle of the element ahead, into the first element from the leading edge.
    void slide(const Creepage& at, const Flexibility& L, double step, double mu_p, Element& element) const;

    /// One element of strip theory. `ahead` is the x of its front edge.
    void stick_or_slip(const StickZone& zone, const Strip& strip, double ahead, Element& element) const;

    template <class Visitor>
    Force solve(const Creepage& creepage, bool by_strips, Visitor&& visit) const;

    PatchContact contact_;
    CreepCoefficients<double> c_;
    Mesh mesh_;
    double mu_, peak_;
};

}  // namespace rollbem

#include "impl/simplified_theory.tpp"
