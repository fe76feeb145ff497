// Bodies of vehicle/wear.hpp. Internal.
#pragma once

#include "../wear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../simplified_theory.hpp"

namespace rollbem {

ROLLBEM_DECL double t_gamma(const TangentialForce& force, const Creepage& creepage) {
    return -(force.longitudinal * creepage.longitudinal + force.lateral * creepage.lateral +
             force.moment * creepage.spin);
}

ROLLBEM_DECL double surface_fatigue_index(const RailPatch& patch, const PatchForce& friction, double shear_yield) {
    return std::hypot(friction.force.longitudinal, friction.force.lateral) / patch.load -
           shear_yield / patch.peak_pressure;
}

ROLLBEM_DECL double surface_fatigue_index(const WheelForces::Point& point, double shear_yield) {
    return std::hypot(point.force.longitudinal, point.force.lateral) / point.normal_load -
           shear_yield / point.peak_pressure;
}

ROLLBEM_DECL double y_over_q(const WheelForces& wheel, WheelsetSide side) {
    const double outwards = side == WheelsetSide::right ? -wheel.force[1] : wheel.force[1];
    return outwards / -wheel.force[2];
}

ROLLBEM_DECL CreepCoefficients<double> creep_coefficients(const CreepForceTable& creep, const PatchContact& ellipse) {
    const char* const who = "creep_coefficients";
    detail::require(ellipse.outline() == nullptr, who, "contact", "outline", "be an ellipse");
    const std::string rule = "be within 0.01 of the table's, " + detail::to_text(creep.grid().poisson_ratio());
    detail::require(creep.fits(ellipse.poisson_ratio()), who, "poisson_ratio", ellipse.poisson_ratio(), rule.c_str());
    const CreepageTangent at_rest = creep.look_up(ellipse, 1, 1, {}).tangent;
    const double unit = -ellipse.shear_modulus() * ellipse.half_length() * ellipse.half_width();
    return {at_rest.by_longitudinal.longitudinal / unit, at_rest.by_lateral.lateral / unit,
            at_rest.by_spin.lateral / unit / ellipse.c()};
}

ROLLBEM_DECL PatchForce strip_work_of(const WheelForces::Point& point, const CreepForceTable& creep, double mu,
                                      const SimplifiedMesh& mesh) {
    detail::require_not_negative("strip_work_of", "friction_coefficient", mu);
    detail::require_mesh("strip_work_of", mesh);
    PatchForce found;
    found.status = Status::no_contact;
    if (!(point.load_share > 0)) return found;
    const CreepCoefficients<double> coefficients = creep_coefficients(creep, point.ellipse);
    const double half = std::numbers::pi / 2, b = point.ellipse.half_width();
    const Eigen::ArrayXd angles = Eigen::ArrayXd::LinSpaced(Eigen::Index(mesh.strips) + 1, -half, half);
    found = {.creepage = point.creepage,
             .force = point.force,
             .slip_work = t_gamma(point),
             .edges = b * angles.sin(),
             .strip_work = Eigen::ArrayXd::Zero(mesh.strips),
             .elements = Eigen::Index(mesh.strips) * mesh.elements,
             .status = Status::ok};
    if (mu > 0) {
        const SimplifiedTheory theory(point.ellipse, coefficients, mu, point.normal_load, mesh);
        // particles enter FASTSIM's ellipse at its largest x
        const Mirror mirror = point.rolling_velocity < 0 ? Mirror::reversing_x() : Mirror();
        const SimplifiedForce shares =
            theory.fastsim(mirrored(point.creepage, mirror), [&](const SimplifiedElement& element) {
                found.strip_work[element.strip] -=
                    element.area * (element.traction[0] * element.slip[0] + element.traction[1] * element.slip[1]);
            });
        if (shares.status != Status::ok) return {};
    }
    if (!(found.strip_work.sum() > 0)) found.strip_work = (angles.head(mesh.strips) + half / mesh.strips).cos().cube();
    found.strip_work *= found.slip_work / found.strip_work.sum();
    if (!detail::is_finite(found.strip_work.sum())) return {};
    return found;
}

ROLLBEM_DECL double arc_length(const Profile& rail, const WheelForces::Point& point) {
    double nearest = std::numeric_limits<double>::infinity(), s = std::numeric_limits<double>::quiet_NaN();
    for (Eigen::Index i = 1; i < rail.size(); ++i) {
        const double before = rail.y()[i - 1] - point.rail_y, after = rail.y()[i] - point.rail_y;
        if (before * after > 0 || before == after) continue;
        const double angle = std::atan2(rail.z()[i] - rail.z()[i - 1], rail.y()[i] - rail.y()[i - 1]);
        if (std::abs(angle - point.angle) >= nearest) continue;
        nearest = std::abs(angle - point.angle);
        s = rail.s()[i - 1] + before / (before - after) * (rail.s()[i] - rail.s()[i - 1]);
    }
    return s;
}

ROLLBEM_DECL ProfileWear::ProfileWear(const Profile& profile, Eigen::Index cells) : length_(profile.length()) {
    detail::require(cells >= 1, "ProfileWear", "number of cells", cells, "be at least 1");
    work_ = Eigen::ArrayXd::Zero(cells);
}

ROLLBEM_DECL void ProfileWear::add(double s, const PatchForce& friction, double weight) {
    if (friction.status != Status::ok || friction.strip_work.size() == 0) return;
    detail::require(detail::is_finite(s), "ProfileWear", "s", s, "be finite: the patch must lie on the profile");
    const double reach = friction.edges.abs().maxCoeff(), place = std::clamp(s, -reach, length_ + reach);
    for (Eigen::Index k = 0; k < friction.strip_work.size(); ++k) {
        const double low = place + friction.edges[k], high = place + friction.edges[k + 1];
        const auto cell = [&](double at) {
            return std::clamp(static_cast<Eigen::Index>(std::floor(at / width())), Eigen::Index(0), work_.size() - 1);
        };
        for (Eigen::Index i = cell(low); i <= cell(high); ++i) {
            const double from = i == cell(low) ? low : double(i) * width(),
                         to = i == cell(high) ? high : double(i + 1) * width();
            work_[i] += weight * friction.strip_work[k] * (to - from) / (high - low) / width();
        }
    }
}

}  // namespace rollbem
