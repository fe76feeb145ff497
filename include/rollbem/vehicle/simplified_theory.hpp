// FASTSIM (Kalker 1982) and FaStrip (Sichani, Enblom and Berg 2016): creep forces of an ellipse by independent strips,
// as in most multibody programs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/creep_coefficients.hpp"
#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../status.hpp"

namespace rollbem {

/// Largest traction of FASTSIM over the ellipse; both bounds carry mu N.
enum class TractionBound {
    parabolic,  ///< mu 2N/(pi a b) (1 - x^2/a^2 - y^2/b^2): Kalker's, the pressure of simplified theory
    elliptic    ///< mu times Hertz's pressure
};

/// Strips of an ellipse, narrower towards its tips, and elements of equal length in each.
struct SimplifiedMesh {
    int strips = 10, elements = 10;
    TractionBound bound = TractionBound::parabolic;
};

namespace detail {

inline void require_mesh(const char* who, const SimplifiedMesh& mesh) {
    require(mesh.strips >= 3, who, "number of strips", mesh.strips, "be at least 3");
    require(mesh.elements >= 1, who, "number of elements", mesh.elements, "be at least 1");
}

}  // namespace detail

/// An element in simplified theory; elements are found from the leading to the trailing edge of each strip.
struct SimplifiedElement {
    int strip;                       ///< number of the strip, counted from y = -b
    double x, y;                     ///< its centre [m]
    double area;                     ///< [m^2]
    std::array<double, 2> traction;  ///< p_x, p_y on body 1 [Pa]
    std::array<double, 2> slip;  ///< slip of body 1 on body 2 over the rolling velocity [-]; FaStrip takes FASTSIM's
    bool slips;
};

/// Forces of simplified theory on body 1.
struct SimplifiedForce {
    TangentialForce<double> force{};     ///< NaN unless ok
    Status status = Status::not_finite;  ///< not_finite: creepages, or their forces; otherwise ok
};

/// FASTSIM and FaStrip on one ellipse under Hertz's pressure, with Kalker's coefficients c11, c22 and c23 from any
/// source. Signs are as in Creepage. Convergence is of first order in the elements of a strip. Nothing allocates.
///
/// Invariant: the contact is an ellipse; c11, c22, c23, mu and N are positive and finite; there are at least 3 strips,
/// each of at least one element.
class SimplifiedTheory {
public:
    /// Throws std::invalid_argument naming the parameter that breaks the invariant.
    SimplifiedTheory(const PatchContact<double>& contact, const CreepCoefficients<double>& coefficients,
                     double friction_coefficient, double load, const SimplifiedMesh& mesh = {})
        : contact_(contact), c_(coefficients), mesh_(mesh), mu_(friction_coefficient) {
        const char* const who = "SimplifiedTheory";
        detail::require(contact.outline() == nullptr, who, "contact", "outline", "be an ellipse");
        detail::require_positive(who, "c11", c_.c11);
        detail::require_positive(who, "c22", c_.c22);
        detail::require_positive(who, "c23", c_.c23);
        detail::require_positive(who, "friction_coefficient", mu_);
        detail::require_positive(who, "load", load);
        detail::require_mesh(who, mesh);
        peak_ = 3 * load / (2 * std::numbers::pi * contact.half_length() * contact.half_width());
    }

    /// Kalker's FASTSIM: displacement is proportional to traction, by the flexibilities L1 = 8a/(3 c11 G), L2 = 8a/(3
    /// c22 G) and L3 = pi a sqrt(a/b)/(4 c23 G), which give the linear law, and particles enter at the leading edge
    /// without traction. `visit` is called with each SimplifiedElement.
    template <class Visitor>
    SimplifiedForce fastsim(const Creepage<double>& creepage, Visitor&& visit) const {
        return solve(creepage, false, visit);
    }
    SimplifiedForce fastsim(const Creepage<double>& creepage) const {
        return solve(creepage, false, [](const SimplifiedElement&) {});
    }

    /// FaStrip. Elements in the stick zone follow strip theory: Carter's solution with lateral creepage and spin,
    /// scaled to Kalker's coefficients. All other elements have mu times Hertz's pressure in the direction of FASTSIM's
    /// traction, which has one flexibility in strips that slip from the leading edge on. The stick zone satisfies the
    /// strip's equations at any Poisson's ratio; published formulae weight spin beside lateral creepage by 1 - nu.
    /// Where |3 c c23 G phi/(2 pi mu p0)| >= 1, strip theory has no stick.
    template <class Visitor>
    SimplifiedForce fastrip(const Creepage<double>& creepage, Visitor&& visit) const {
        return solve(creepage, true, visit);
    }
    SimplifiedForce fastrip(const Creepage<double>& creepage) const {
        return solve(creepage, true, [](const SimplifiedElement&) {});
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

    Flexibility flexibility() const {
        const double a = contact_.half_length(), G = contact_.shear_modulus();
        return {8 * a / (3 * c_.c11 * G), 8 * a / (3 * c_.c22 * G),
                std::numbers::pi * a * std::sqrt(contact_.a_over_b()) / (4 * c_.c23 * G)};
    }
    /// The mean of the three flexibilities, weighted by the creepages.
    Flexibility one_flexibility(const Creepage<double>& at) const {
        const Flexibility L = flexibility();
        const std::array<double, 3> weight{std::abs(at.longitudinal), std::abs(at.lateral),
                                           contact_.c() * std::abs(at.spin)};
        const double size = std::hypot(weight[0], weight[1], weight[2]);
        const double mean = (weight[0] * L.longitudinal + weight[1] * L.lateral + weight[2] * L.spin) / size;
        return {mean, mean, mean};
    }

    /// Whether creepages are so small that no traction without a bound overflows on its way through the ellipse.
    bool is_in_range(const Creepage<double>& at) const {
        const Flexibility L = flexibility();
        const double a = contact_.half_length(), b = contact_.half_width(), xi = std::abs(at.longitudinal),
                     eta = std::abs(at.lateral), phi = std::abs(at.spin);
        return detail::is_finite(2 * a * (xi / L.longitudinal + eta / L.lateral + phi * (a + b) / L.spin)) &&
               detail::is_finite(xi + eta + contact_.c() * phi);
    }

    /// Integral of sqrt(half_length^2 - x^2) from 0.
    static double half_circle(double x, double half_length) {
        if (!(half_length > 0)) return 0;
        const double over = std::clamp(x / half_length, -1.0, 1.0);
        return half_length * half_length / 2 * (over * std::sqrt((1 - over) * (1 + over)) + std::asin(over));
    }
    /// mu times the mean of Hertz's pressure over an element.
    double elliptic(double ahead, double behind, double half_length) const {
        return mu_ * peak_ / contact_.half_length() *
               (half_circle(ahead, half_length) - half_circle(behind, half_length)) / (ahead - behind);
    }
    double bound(double ahead, double behind, double half_length) const {
        if (mesh_.bound == TractionBound::elliptic) return elliptic(ahead, behind, half_length);
        const double a = contact_.half_length(), mean = (ahead * ahead + ahead * behind + behind * behind) / 3;
        return mu_ * peak_ * 4 / 3 * (half_length * half_length - mean) / (a * a);
    }

    /// Stick requires displacements with a constant slope along x and a slope that grows with x across it. Tractions of
    /// the slip zone behind continue the tractions of the stick zone and reach mu p.
    StickZone stick_zone(const Creepage<double>& at, double y) const {
        const double pi = std::numbers::pi, unit = contact_.shear_modulus() / (2 * mu_ * peak_),
                     a = contact_.half_length();
        const double psi = unit * 3 * contact_.c() * c_.c23 * at.spin / pi, rest = (1 - psi) * (1 + psi);
        const double along = unit * 4 / (pi * pi) * c_.c11 * at.longitudinal -
                             psi * y / (a * (1 - contact_.poisson_ratio())),
                     across = unit * 4 / (pi * pi) * c_.c22 * at.lateral;
        if (!(rest > 1e-9) || !detail::is_finite(across)) return {2 * a, {}, {}};
        const double slip = (std::hypot(across, std::sqrt(rest) * along) + psi * across) / rest;
        if (!(slip > 0)) return {0, {0, psi}, {0, 0}};  // spin alone, in the middle strip
        const std::array<double, 2> outer{along / slip, across / slip + psi};
        return {a * slip, outer, {outer[0], outer[1] - psi}};
    }

    /// One element of FASTSIM. On entry its traction is the traction of the element ahead. Particles come from the
    /// middle of the element ahead, into the first element from the leading edge.
    void slide(const Creepage<double>& at, const Flexibility& L, double step, double mu_p,
               SimplifiedElement& element) const {
        const std::array<double, 2> compliance{L.longitudinal, L.lateral};
        const double x = element.x + step / 2;
        const std::array<double, 2> rate{at.longitudinal / L.longitudinal - at.spin * element.y / L.spin,
                                         at.lateral / L.lateral + at.spin * x / L.spin};
        std::array<double, 2> trial;
        for (std::size_t k = 0; k < 2; ++k) trial[k] = element.traction[k] - step * rate[k];
        const double size = std::hypot(trial[0], trial[1]);
        element.slips = size > mu_p;
        const double kept = element.slips ? mu_p / size : 1;
        for (std::size_t k = 0; k < 2; ++k) {
            element.traction[k] = kept * trial[k];
            element.slip[k] = compliance[k] * (element.traction[k] - trial[k]) / step;
        }
    }

    /// One element of strip theory. `ahead` is the x of its front edge.
    void stick_or_slip(const StickZone& zone, const Strip& strip, double ahead, SimplifiedElement& element) const {
        const double behind = 2 * element.x - ahead, p = elliptic(ahead, behind, strip.half_length);
        element.slips = !zone.holds(element.x, strip);
        if (element.slips) {
            const double size = std::hypot(element.traction[0], element.traction[1]);
            for (double& component : element.traction) component *= size > 0 ? p / size : 0;
            return;
        }
        const double inner = elliptic(ahead - zone.slip, behind - zone.slip, strip.half_length - zone.slip);
        for (std::size_t k = 0; k < 2; ++k) element.traction[k] = zone.inner[k] * inner - zone.outer[k] * p;
        element.slip = {};
    }

    template <class Visitor>
    SimplifiedForce solve(const Creepage<double>& creepage, bool by_strips, Visitor&& visit) const {
        if (!is_in_range(creepage)) return {};
        TangentialForce<double> force{0, 0, 0};
        const double turn = std::numbers::pi / mesh_.strips;
        for (int j = 0; j < mesh_.strips; ++j) {
            // angles of equal size on the unit circle make sums over strips exact for smooth functions
            const double angle = (j + 0.5) * turn - std::numbers::pi / 2;
            const Strip strip{contact_.half_width() * std::sin(angle), contact_.half_length() * std::cos(angle)};
            const StickZone zone = by_strips ? stick_zone(creepage, strip.y) : StickZone{};
            const double length = 2 * strip.half_length / mesh_.elements;
            SimplifiedElement by_fastsim{j,  0,  strip.y, length * contact_.half_width() * std::cos(angle) * turn,
                                         {}, {}, false};
            Flexibility L = flexibility();
            for (int i = 0; i < mesh_.elements; ++i) {
                const double ahead = strip.half_length - i * length, step = i > 0 ? length : length / 2;
                by_fastsim.x = ahead - length / 2;
                const double mu_p = bound(ahead, ahead - length, strip.half_length);
                slide(creepage, L, step, mu_p, by_fastsim);
                if (i == 0 && by_strips && by_fastsim.slips) {
                    L = one_flexibility(creepage);
                    by_fastsim.traction = {};
                    slide(creepage, L, step, mu_p, by_fastsim);
                }
                SimplifiedElement element = by_fastsim;
                if (by_strips) stick_or_slip(zone, strip, ahead, element);
                const double f_x = element.area * element.traction[0], f_y = element.area * element.traction[1];
                force = force + TangentialForce<double>{f_x, f_y, element.x * f_y - element.y * f_x};
                visit(std::as_const(element));
            }
        }
        if (!detail::is_finite(force.longitudinal + force.lateral + force.moment)) return {};
        return {force, Status::ok};
    }

    PatchContact<double> contact_;
    CreepCoefficients<double> c_;
    SimplifiedMesh mesh_;
    double mu_, peak_;
};

}  // namespace rollbem
