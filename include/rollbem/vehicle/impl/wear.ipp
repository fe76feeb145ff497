// Bodies of vehicle/wear.hpp. Internal.
#pragma once

#include "../wear.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "../../detail/finite.hpp"
#include "../../detail/linear_between.hpp"
#include "../../detail/require.hpp"
#include "../../scene/detail/mirror.hpp"
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
    const TangentialForce::ByCreepage at_rest = creep.look_up(ellipse, 1, 1, {}).tangent;
    const double unit = -ellipse.shear_modulus() * ellipse.half_length() * ellipse.half_width();
    return {at_rest.by_longitudinal.longitudinal / unit, at_rest.by_lateral.lateral / unit,
            at_rest.by_spin.lateral / unit / ellipse.c()};
}

ROLLBEM_DECL PatchForce strip_work_of(const WheelForces::Point& point, const CreepForceTable& creep, double mu,
                                      const SimplifiedTheory::Mesh& mesh) {
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
        const detail::Mirror mirror = point.rolling_velocity < 0 ? detail::Mirror::reversing_x() : detail::Mirror();
        const SimplifiedTheory::Force shares =
            theory.fastsim(mirrored(point.creepage, mirror), [&](const SimplifiedTheory::Element& element) {
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

ROLLBEM_DECL double archard_coefficient(double pressure, double sliding_velocity, double hardness) {
    if (pressure > 0.8 * hardness) return 350e-4;
    return sliding_velocity < 0.2 || sliding_velocity > 0.7 ? 5e-4 : 35e-4;
}

ROLLBEM_DECL ProfileWear::Law::Law(const std::vector<double>& t_gamma_per_area, const std::vector<double>& rate) {
    constexpr const char* who = "ProfileWear::Law";
    detail::require(!t_gamma_per_area.empty(), who, "number of places", 0, "be at least 1");
    detail::require(t_gamma_per_area.size() == rate.size(), who, "number of rates", rate.size(),
                    "be the number of places");
    for (std::size_t k = 0; k < rate.size(); ++k) {
        const double place = t_gamma_per_area[k];
        detail::require(detail::is_finite(place) && place >= 0, who, "t_gamma_per_area", place,
                        "be finite and not negative");
        detail::require(k == 0 || place > t_gamma_per_area[k - 1], who, "t_gamma_per_area", place,
                        "lie above the one before");
        detail::require(detail::is_finite(rate[k]) && rate[k] >= 0, who, "rate", rate[k], "be finite and not negative");
        work_.push_back(1e6 * place);
        depth_.push_back(1e-3 / density * rate[k]);
    }
}

ROLLBEM_DECL ProfileWear::Law ProfileWear::Law::t_gamma() {
    ProfileWear::Law law({0, 10.4, 77.2}, {0, 55.12, 55.12});
    law.slope_ = 1e-9 / density * 61.9;
    return law;
}

ROLLBEM_DECL ProfileWear::Law ProfileWear::Law::archard_kth(double hardness) {
    detail::require_positive("ProfileWear::Law", "hardness", hardness);
    ProfileWear::Law law;
    law.hardness_ = hardness;
    return law;
}

ROLLBEM_DECL double ProfileWear::Law::depth(const Place& place) const {
    if (hardness_ > 0) {
        return archard_coefficient(place.pressure, place.sliding_velocity, hardness_) * place.pressure * place.slip /
               hardness_;
    }
    if (!(place.work > 0)) return 0;
    return detail::linear_between(work_, depth_, place.work) + slope_ * (std::max)(0.0, place.work - work_.back());
}

ROLLBEM_DECL PatchForce wear_of(const PatchForce& friction, const ProfileWear::Law& law, double velocity) {
    constexpr Eigen::Index parts = 4;  // of a strip
    PatchForce worn = friction;
    const Eigen::ArrayXd& edges = friction.edges;
    const Eigen::Index strips = friction.strip_work.size();
    if (strips == 0 || friction.slip.size() == 0) {
        worn.strip_work.resize(0);
        return worn;
    }
    // 1. The law over the elements of each strip
    const Eigen::ArrayXd widths = edges.tail(strips) - edges.head(strips);
    Eigen::ArrayXd volumes = Eigen::ArrayXd::Zero(strips);
    for (Eigen::Index i = 0; i < friction.slip.size(); ++i) {
        const Yield::LoadedRectangle& element = friction.surface[friction.first_element + std::size_t(i)];
        const double area = (element.x_2 - element.x_1) * (element.y_2 - element.y_1);
        const ProfileWear::Law::Place place{friction.work[i] / area, element.pressure, friction.slip[i],
                                            friction.slip[i] * std::abs(velocity)};
        const double* const inner = edges.data() + 1;
        volumes[std::upper_bound(inner, inner + strips - 1, (element.y_1 + element.y_2) / 2) - inner] +=
            law.depth(place) * area;
    }
    // 2. Linear between the middles of strips, 0 at the outer edges
    std::vector<double> places{edges[0]}, densities{0};
    for (Eigen::Index k = 0; k < strips; ++k) {
        places.push_back((edges[k] + edges[k + 1]) / 2);
        densities.push_back(volumes[k] / widths[k]);
    }
    places.push_back(edges[strips]);
    densities.push_back(0);
    worn.edges.resize(strips * parts + 1);
    worn.strip_work.resize(strips * parts);
    for (Eigen::Index j = 0; j < strips * parts; ++j) {
        const double part = widths[j / parts] / parts, low = edges[j / parts] + double(j % parts) * part;
        worn.edges[j] = low;
        worn.strip_work[j] = part * detail::linear_between(places, densities, low + part / 2);
    }
    worn.edges[strips * parts] = edges[strips];
    const double sum = worn.strip_work.sum();
    if (sum > 0) worn.strip_work *= volumes.sum() / sum;
    return worn;
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

ROLLBEM_DECL Eigen::ArrayXd ProfileWear::at_points(const Profile& profile) const {
    // the integral up to a place
    Eigen::ArrayXd sums(work_.size() + 1);
    sums[0] = 0;
    for (Eigen::Index i = 0; i < work_.size(); ++i) sums[i + 1] = sums[i] + work_[i] * width();
    const auto up_to = [&](double s) {
        const double cells = std::clamp(s / width(), 0.0, double(work_.size()));
        const auto i = (std::min)(Eigen::Index(cells), work_.size() - 1);
        return sums[i] + (cells - double(i)) * (sums[i + 1] - sums[i]);
    };
    const Eigen::Index n = profile.size();
    Eigen::ArrayXd means(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double from = i == 0 ? 0 : (profile.s()[i - 1] + profile.s()[i]) / 2,
                     to = i == n - 1 ? profile.length() : (profile.s()[i] + profile.s()[i + 1]) / 2;
        means[i] = (up_to(to) - up_to(from)) / (to - from);
    }
    return means;
}

}  // namespace rollbem
