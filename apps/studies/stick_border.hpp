// Steady rolling with friction with a slip zone at the trailing edge and stick ahead of it, as under Hertz's pressure:
// border, force and tractions exactly, by series instead of elements.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <functional>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/detail/finite.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/scene/contact.hpp>
#include <rollbem/status.hpp>
#include <rollbem/types.hpp>

#include "detail/angular_points.hpp"
#include "detail/exact_border.hpp"
#include "detail/stick_zone.hpp"

namespace rollbem::studies {

/// A pressure known at every point: p_n [Pa] at x/a in [-1, 1], finite and not negative, and its mean on each element
/// of any mesh, in case elements are needed. HertzLine::Pressure and PressureTable are such laws.
template <class Pressure, class Scalar>
concept PressureLaw = requires(const Pressure& pressure, Scalar x_over_a, const Mesh<Scalar>& mesh) {
    { pressure(x_over_a) } -> std::convertible_to<Scalar>;
    { pressure(mesh) } -> std::convertible_to<ArrayX<Scalar>>;
};

/// Steady rolling with friction at one creepage: exact, or by elements if slip and stick are arranged otherwise.
template <class Scalar_>
struct StickBorderSolution {
    using Scalar = Scalar_;

    static constexpr Scalar none = std::numeric_limits<Scalar>::quiet_NaN();

    bool exact = false;  ///< whether one border separates slip and stick; if not, all results are by elements
    /// x/a at which stick begins [-]: -1 without creepage, 1 for full sliding; NaN unless exact.
    Scalar border = none;
    /// F_bar on body 1 [N/m]. Like all following members, NaN if the creepage is not finite.
    Scalar force_per_width = none;
    /// Estimate of the error of F_bar [N/m]: the change due to more coefficients, and the effect of violations of the
    /// law between the sampled points. NaN unless exact.
    Scalar force_error = none;
    Scalar tangent_per_width = none;  ///< d F_bar / d creepage [N/m]
    /// Work that slip turns into heat per unit width and distance rolled [J/m^2]: -F_bar xi if exact, as the elastic
    /// energy is constant in steady rolling; with elements as FrictionStep::slip_work.
    Scalar slip_work_per_width = none;
    /// Largest violation at the sampled points of |p| <= mu p_n (over the largest mu p_n) and of the direction of slip
    /// (over |xi|).
    Scalar complementarity_residual = none;
    Eigen::Index coefficients = 0;  ///< number of points of the pressure in the slip zone; 0 unless exact
    Eigen::Index unknowns = 0;      ///< number of unknowns of the linear system for the kernel's smooth part; 0 for the
                                    ///< plane kernel
    int evaluations = 0;            ///< number of borders tried
    Status status = Status::not_finite;

    /// Traction p on body 1 [Pa] at x/a in [-1, 1]; with elements, the traction of the element at x. NaN outside, and
    /// if the status is neither ok nor no_solution.
    Scalar traction(Scalar x_over_a) const {
        if (!defined_at(x_over_a)) return none;
        if (elements) return elements->traction[elements->index(x_over_a)];
        const Scalar p = x_over_a > border ? zone.traction(x_over_a) : -bound(x_over_a);
        return sign * shear_modulus * p;
    }
    /// Slip s/V [-] at x/a, zero in stick. NaN where the traction is.
    Scalar slip(Scalar x_over_a) const {
        if (!defined_at(x_over_a)) return none;
        if (elements) return elements->slip[elements->index(x_over_a)];
        return x_over_a > border || !(zone.y > 0) ? Scalar(0) : sign * zone.slip(x_over_a, smooth_slope);
    }

    /// The solution by elements, if it is not exact.
    struct OnElements {
        Mesh<Scalar> mesh;
        VectorX<Scalar> traction;  ///< [Pa], trailing to leading
        VectorX<Scalar> slip;      ///< s/V [-]

        Eigen::Index index(Scalar x_over_a) const {
            const Scalar* const first = mesh.edges_from_trailing().data();
            const Eigen::Index edge = std::upper_bound(first, first + mesh.size(), 1 + x_over_a) - first;
            return std::max<Eigen::Index>(edge - 1, 0);
        }
    };
    std::optional<OnElements> elements;  ///< empty if the solution is exact

    // data of an exact solution, for traction() and slip()
    detail::StickZone<Scalar> zone;
    std::function<Scalar(Scalar)> bound, smooth_slope;
    Scalar sign = 1, shear_modulus = 1;

private:
    bool defined_at(Scalar x) const {
        const bool solved = status == Status::ok || status == Status::no_solution;
        return solved && detail::is_finite(x) && x >= -1 && x <= 1;
    }
};

}  // namespace rollbem::studies

namespace rollbem::detail {

/// Steady rolling by elements, for a result that is otherwise empty.
template <class Kernel, class Pressure>
void solve_on_elements(const Contact& contact, const Kernel& kernel, double friction_coefficient,
                       const Pressure& pressure, double creepage, Eigen::Index count,
                       studies::StickBorderSolution<double>& result) {
    const Mesh<double> mesh = cosine_mesh<double>(count);
    const FrictionModel model(contact, steady_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel),
                              Friction{.law = {friction_coefficient}, .normal_pressure = pressure(mesh)});
    const FrictionState rest = model.at_rest();
    FrictionState state = rest;
    FrictionModel::Workspace workspace = model.workspace();
    const FrictionStep step = model.steady(rest, {.motion = Creepage{creepage}}, state, workspace);
    result.elements.emplace(
        studies::StickBorderSolution<double>::OnElements{mesh, state.traction.col(0), workspace.slip().col(0)});
    result.force_per_width = step.force.longitudinal / contact.width();
    result.tangent_per_width = step.tangent.by_longitudinal.longitudinal / contact.width();
    result.slip_work_per_width = step.slip_work / contact.width();
    result.complementarity_residual = step.complementarity_residual;
    result.status = step.status;
}

}  // namespace rollbem::detail

namespace rollbem::studies {

/// Steady rolling with friction at a creepage [-], by the exact border between slip, behind it, and stick, ahead of it.
///
/// For pressures without jumps inside the contact (they need not vanish at its ends) that lead to one slip zone at the
/// trailing edge. Only the pressure in the slip zone matters, where the number of points is doubled until the force
/// converges: pressures analytic over sqrt(1 - x^2), such as Hertz's, are exact to rounding with few points; tables
/// have kinks, which converge like 1/M^2. The solver on cosine_mesh(fallback_elements) with alpha = 0.5 is used
/// instead, and `exact` is false, if
///
/// - the pressure jumps;
/// - the estimated error exceeds 1e-6 mu N;
/// - the strip is narrower than b/a = 0.02; or
/// - the law is violated (several zones of stick or slip, slip against the traction, |p| above the bound).
///
/// A pressure that decreases linearly to zero at the leading edge, as on the last segment of a table, lies below the
/// traction of stick there, which decreases like a square root: a second slip zone begins at the leading edge. The
/// shorter the last segment, the smaller its effect; points at -cos of equidistant angles make it short
/// (docs/measured.md).
///
/// `kernel` has the contact's half-width in units of a; `pressure` gives p_n [Pa] at every point and its means, e.g.
/// hertz.pressure(), and the result keeps a copy of it. Throws std::invalid_argument unless fallback_elements >= 1, the
/// coefficient of friction and the pressure are finite and not negative, and the pressure is positive somewhere.
template <LineKernel Kernel, PressureLaw<double> Pressure>
StickBorderSolution<double> solve_stick_border(const Contact& contact, const Kernel& kernel,
                                               double friction_coefficient, const Pressure& pressure, double creepage,
                                               Eigen::Index fallback_elements = 40) {
    constexpr const char* who = "solve_stick_border";
    detail::require(fallback_elements >= 1, who, "fallback_elements", fallback_elements, "be at least 1");
    detail::require_not_negative(who, "friction_coefficient", friction_coefficient);
    // one type for all pressures, so that the following code is compiled once for each kernel
    const std::function<double(double)> bound = [pressure, scale = friction_coefficient / contact.shear_modulus()](
                                                    double x) -> double { return scale * pressure(x); };
    detail::PointsOfLevels<double> levels;
    const detail::PressureScan<double> scan = detail::scan_pressure<double>(bound, levels);
    detail::require(scan.largest > 0 || friction_coefficient == 0, who, "largest normal_pressure", scan.largest,
                    "be positive");

    StickBorderSolution<double> result;
    result.shear_modulus = contact.shear_modulus();
    if (!detail::is_finite(creepage)) return result;
    result.sign = creepage < 0 ? -1.0 : 1.0;
    const double force_unit = contact.half_length() * contact.shear_modulus();
    const std::optional<detail::ExactBorder<double>> exact =
        detail::find_exact_border(kernel, bound, scan, levels, std::abs(creepage), result.evaluations);
    if (exact) {
        result.exact = true;
        result.border = exact->zone.y - 1;
        result.force_per_width = result.sign * force_unit * exact->force;
        result.force_error = force_unit * exact->force_error;
        result.tangent_per_width = force_unit * exact->tangent;
        result.complementarity_residual = exact->residual;
        result.coefficients = exact->coefficients;
        result.unknowns = exact->unknowns;
        result.zone = exact->zone;
        result.bound = bound;
        result.smooth_slope = [kernel](double x) { return kernel.smooth_slope(x); };
        result.slip_work_per_width = -result.force_per_width * creepage;
        result.status = Status::ok;
    } else {
        detail::solve_on_elements(contact, kernel, friction_coefficient, pressure, creepage, fallback_elements, result);
    }
    return result;
}

}  // namespace rollbem::studies
