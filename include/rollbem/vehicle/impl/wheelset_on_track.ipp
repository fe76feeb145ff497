// Bodies of vehicle/wheelset_on_track.hpp. Internal.
#pragma once

#include "../wheelset_on_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../detail/rising_root.hpp"
#include "../../normal/detail/finite_position.hpp"
#include "../../scene/detail/mirror.hpp"
#include "../detail/slip_velocity.hpp"

namespace rollbem {

ROLLBEM_DECL Creepage creepage_of(const RailPatch& patch, const WheelsetPosition& at, const WheelsetSpeeds& speeds,
                                  double radius) {
    const Creepage slip = detail::SlipVelocity(patch, at, speeds, radius).at_reference();
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    return {slip.longitudinal / speed, slip.lateral / speed, slip.spin / speed};
}

ROLLBEM_DECL Eigen::MatrixX2d curved_slip_of(const RailPatch& patch, const WheelsetPosition& at,
                                             const WheelsetSpeeds& speeds, double radius, const Eigen::ArrayXd& x,
                                             const Eigen::ArrayXd& s) {
    const detail::SlipVelocity slip(patch, at, speeds, radius);
    const double speed = std::abs(rolling_velocity_of(patch, speeds));
    const Creepage linear = creepage_of(patch, at, speeds, radius);
    const NormalContact::Cells& grid = patch.grid;
    const Eigen::ArrayXd middle = (patch.rail_n + patch.wheel_n) / 2;
    Eigen::MatrixX2d rows(x.size(), 2);
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double row = std::clamp((s[i] - grid.y(0)) / grid.dy, 0.0, double(grid.ny - 1) - 1e-9);
        const auto j = static_cast<Eigen::Index>(row);
        const double part = row - double(j), n = (1 - part) * patch.wheel_n[j] + part * patch.wheel_n[j + 1];
        const Creepage here = slip(x[i], s[i], n, std::atan((middle[j + 1] - middle[j]) / grid.dy));
        rows(i, 0) = here.longitudinal / speed - (linear.longitudinal - linear.spin * s[i]);
        rows(i, 1) = here.lateral / speed - (linear.lateral + linear.spin * x[i]);
    }
    return rows;
}

ROLLBEM_DECL PatchContact contact_of(const RailPatch& patch, const WheelOnRail::Dimensions& dimensions) {
    detail::require(patch.outline.has_value(), "contact_of", "status of the patch", name(patch.status), "be ok");
    return {*patch.outline, dimensions.shear_modulus, dimensions.poisson_ratio};
}

ROLLBEM_DECL PressureGrid pressure_of(const RailPatch& patch) {
    const NormalContact::Cells& grid = patch.grid;
    return {Eigen::ArrayXd::LinSpaced(grid.nx, grid.x(0), grid.x(grid.nx - 1)),
            Eigen::ArrayXd::LinSpaced(grid.ny, grid.y(0), grid.y(grid.ny - 1)), patch.pressure.matrix()};
}

ROLLBEM_DECL auto WheelsetOnTrack::solve(WheelsetPosition position, const std::array<double, 2>& loads,
                                         Workspace& workspace, Free free, const WheelOnRail::Options& options) const
    -> Contacts {
    Contacts contacts;
    WheelOnRail::Options cells = options;
    // height of the right wheel minus height of the left one; a roll lowers the right wheel, so that the gap falls
    const auto gap = [&](double roll) {
        position.roll = roll;
        for (const Side side : sides) {
            const auto k = static_cast<std::size_t>(side);
            WheelsetPosition at = seen_from(side, position);
            at.height += height_above(side);
            WheelOnRail::Options of = cells;
            // without numbers of the one wheel there are none of the other
            if (free == Free::height_and_roll && side == Side::right) {
                of.halves_cells = of.halves_cells && has_numbers(contacts.wheels[0].status);
            }
            contacts.wheels[k] = free == Free::nothing
                                     ? wheels_[k].solve_at_height(at, workspace.wheels[k], of)
                                     : wheels_[k].solve_for_load(at, loads[k], workspace.wheels[k], of);
        }
        contacts.status = (std::max)(contacts.wheels[0].status, contacts.wheels[1].status);
        return contacts.wheels[1].height - (contacts.wheels[0].height - height_above(Side::left));
    };
    // the roll on the given cells, then on those that suffice
    if (free == Free::height_and_roll) cells.halves_cells = false;
    double roll = position.roll, excess = gap(roll);
    contacts.position = position;
    if (free != Free::height_and_roll) return contacts;
    // contacts, and with them heights, jump a little where grids change
    constexpr double precise = 1e-10, rough = 1e-8, jump = 1e-6;  // tolerances of the height [m]
    const detail::RisingRoot anywhere(wheels_[0].wheel_origin() + wheels_[1].wheel_origin(), 5e-3);
    detail::RisingRoot root = anywhere;
    const auto refined = [&] { return cells.halves_cells == options.halves_cells; };
    // a patch with few cells at one roll need not have few at the next
    const auto goes_on = [&] {
        return has_numbers(contacts.status) || (contacts.status == Status::few_cells && !cells.halves_cells);
    };
    for (int k = 0, fine = 0; k < 60 && goes_on(); ++k) {
        fine += refined();
        const bool found =
            std::abs(excess) <= (fine > 2 ? rough : precise) || (root.width() < 1e-10 && std::abs(excess) < jump);
        if (found && refined()) break;
        if (!found) roll = root.next(roll, -excess);
        if (!refined() && std::abs(excess) < jump) {
            cells.halves_cells = options.halves_cells;
            root = anywhere;
        }
        excess = gap(roll);
    }
    if (has_numbers(contacts.status) && std::abs(excess) > jump) contacts.status = Status::load_not_reached;
    if (!has_numbers(contacts.status)) {
        for (WheelOnRail::Contact& wheel : contacts.wheels) wheel.status = contacts.status;
    }
    position.height = (contacts.wheels[0].height - height_above(Side::left) + contacts.wheels[1].height) / 2;
    contacts.position = position;
    return contacts;
}

}  // namespace rollbem

namespace rollbem::detail {

/// s of a wheel's profile below which the wheel climbs over its flange: the end of the flank towards the crown. The
/// flank is the first stretch outside the crown steeper than 45 degrees, without the parts less steep than its steepest
/// place by more than 2 degrees, as measured flanks are not straight; 0 if there is none inside the tape circle at y =
/// `tape` [m].
inline double end_of_flank(const Profile& wheel, double tape) {
    constexpr double degree = std::numbers::pi / 180, steep = 45 * degree;
    const auto angle = [&](Eigen::Index i) {
        const std::array<double, 2> slope = wheel.at(wheel.s()[i]).slope;
        return std::atan2(-slope[1], slope[0]);
    };
    Eigen::Index from = 0;
    wheel.z().maxCoeff(&from);
    while (from < wheel.size() && angle(from) <= steep) ++from;
    if (from == wheel.size() || wheel.y()[from] >= tape) return 0;
    double steepest = 0;
    for (Eigen::Index i = from; i < wheel.size() && angle(i) > steep; ++i) steepest = (std::max)(steepest, angle(i));
    while (angle(from) < steepest - 2 * degree) ++from;
    return wheel.s()[from];
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelsetOnTrack::RollingRadii rolling_radii(const WheelsetOnTrack& wheelset, double lateral) {
    WheelsetOnTrack::RollingRadii radii{.lateral = lateral};
    radii.status = Status::ok;
    for (const WheelsetSide side : WheelsetOnTrack::sides) {
        const WheelOnRail& wheel = wheelset.wheel(side);
        WheelOnRail::RigidContact& contact = radii.wheels[std::size_t(side)];
        contact = rigid_contact(wheel, WheelsetOnTrack::seen_from(side, WheelsetPosition{.lateral = lateral}));
        radii.status = (std::max)(radii.status, contact.status);
        const double tape = 0.07 - wheel.dimensions().tape_offset;
        if (contact.status == Status::ok && contact.wheel_s < detail::end_of_flank(wheel.wheel(), tape)) {
            radii.status = (std::max)(radii.status, Status::beyond_clearance);
        }
    }
    return radii;
}

ROLLBEM_DECL WheelsetOnTrack::RadiusDifference::RadiusDifference(Eigen::ArrayXd lateral, Eigen::ArrayXd difference,
                                                                 double distance, double radius)
    : y_(std::move(lateral)), difference_(std::move(difference)), distance_(distance), radius_(radius) {
    constexpr const char* who = "RadiusDifference";
    const Eigen::Index n = y_.size();
    detail::require(n >= 2, who, "number of points", n, "be at least 2");
    detail::require(difference_.size() == n, who, "number of differences", difference_.size(),
                    "equal the number of points");
    detail::require_positive(who, "distance", distance);
    detail::require_positive(who, "radius", radius);
    integral_.setZero(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        detail::require_finite(who, "lateral", y_[i]);
        detail::require_finite(who, "difference", difference_[i]);
        if (i == 0) continue;
        detail::require(y_[i] > y_[i - 1], who, "lateral", y_[i], "exceed the one before it");
        integral_[i] = integral_[i - 1] + (y_[i] - y_[i - 1]) * (difference_[i] + difference_[i - 1]) / 2;
    }
}

ROLLBEM_DECL double WheelsetOnTrack::RadiusDifference::at(double lateral) const {
    const Eigen::Index i = interval(lateral);
    return difference_[i] + slope(i) * (lateral - y_[i]);
}

ROLLBEM_DECL double WheelsetOnTrack::RadiusDifference::integral(double lateral) const {
    const Eigen::Index i = interval(lateral);
    const double from = lateral - y_[i];
    return integral_[i] + from * (difference_[i] + slope(i) * from / 2);
}

ROLLBEM_DECL Eigen::Index WheelsetOnTrack::RadiusDifference::interval(double lateral) const {
    const double* const inner = y_.data() + 1;
    return std::upper_bound(inner, inner + y_.size() - 2, lateral) - inner;
}

}  // namespace rollbem

namespace rollbem::detail {

constexpr double least_conicity = 1e-6;

// places of contact are too inexact for a smaller one
constexpr double least_amplitude = 1e-6;

// [m]; energies of a smaller wave drown in the rounding of the integrals

struct WaveMiddle {
    double y;
    Status status;
};

/// The middle of a wave of this amplitude: the zero of value(middle) [m^2], which rises; beyond_clearance unless the
/// zero lies between the ends of Delta r, unstable where the function falls from end to end.
template <class Value>
WaveMiddle middle_of_wave(const WheelsetOnTrack::RadiusDifference& radii, double amplitude, const Value& value) {
    constexpr double balanced = 1e-12;  // symmetric wheelsets have their wave in the middle
    double low = radii.low() + amplitude, high = radii.high() - amplitude;
    if (!(low <= high)) return {0, Status::beyond_clearance};
    const bool back_from_low = value(low) <= 0, back_from_high = value(high) >= 0;
    if (!back_from_low && !back_from_high) return {0, Status::unstable};
    if (!back_from_low || !back_from_high) return {0, Status::beyond_clearance};
    double middle = (low + high) / 2;
    for (int k = 0; k < 60; ++k) {
        const double excess = value(middle);
        if (std::abs(excess) < balanced * amplitude * amplitude) break;
        (excess < 0 ? low : high) = middle;
        middle = (low + high) / 2;
    }
    return {middle, Status::ok};
}

/// The mean of f(sin phi, cos phi) over -pi/2 < phi < pi/2.
template <class Function>
double mean_over_wave(const Function& f) {
    constexpr int count = 4000;
    double sum = 0;
    for (int k = 0; k < count; ++k) {
        const double phi = std::numbers::pi * ((k + 0.5) / count - 0.5);
        sum += f(std::sin(phi), std::cos(phi));
    }
    return sum / count;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelsetOnTrack::RadiusDifference::Conicity equivalent_conicity(
    const WheelsetOnTrack::RadiusDifference& radii, double amplitude) {
    detail::require(detail::is_finite(amplitude) && amplitude >= detail::least_amplitude, "equivalent_conicity",
                    "amplitude", amplitude, "be positive and finite, and at least 1e-6 m");
    WheelsetOnTrack::RadiusDifference::Conicity result{.amplitude = amplitude};
    const detail::WaveMiddle middle = detail::middle_of_wave(
        radii, amplitude, [&](double y) { return radii.integral(y + amplitude) - radii.integral(y - amplitude); });
    const detail::WaveMiddle balanced = detail::middle_of_wave(radii, amplitude, [&](double y) {
        return amplitude * detail::mean_over_wave([&](double sine, double) { return radii.at(y + amplitude * sine); });
    });
    result.status = (std::max)(middle.status, balanced.status);
    if (result.status != Status::ok) return result;
    result.y_min = middle.y - amplitude;
    result.y_max = middle.y + amplitude;
    result.tan_gamma_linear = detail::mean_over_wave(
        [&](double sine, double) { return radii.at(balanced.y + amplitude * sine) * sine / amplitude; });
    // y'^2 = 2 (energy - integral)/(e r0)
    const double energy = (std::min)(radii.integral(result.y_min), radii.integral(result.y_max));
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    const double mean = detail::mean_over_wave([&](double sine, double cosine) {
        const double left = energy - radii.integral(middle.y + amplitude * sine);
        least = (std::min)(least, left);
        largest = (std::max)(largest, left);
        return amplitude * cosine / std::sqrt(left);
    });
    const double flat = detail::least_conicity * amplitude * amplitude;
    const bool is_flat = least > -flat && largest < flat;
    result.status = is_flat || least > 0 ? Status::ok : Status::unstable;
    result.tan_gamma = is_flat ? 0 : 1 / (mean * mean);
    result.wavelength = 2 * std::numbers::pi * std::sqrt(radii.distance() * radii.radius() / (2 * result.tan_gamma));
    return result;
}

ROLLBEM_DECL std::optional<double> conicity_nonlinearity(const WheelsetOnTrack::RadiusDifference& radii) {
    const WheelsetOnTrack::RadiusDifference::Conicity little = equivalent_conicity(radii, 2e-3),
                                                      large = equivalent_conicity(radii, 4e-3);
    if (little.status != Status::ok || large.status != Status::ok) return std::nullopt;
    return (large.tan_gamma - little.tan_gamma) / 2e-3;
}

}  // namespace rollbem

namespace rollbem::detail {

/// Rolling radii in steps from the middle to one side. The last one lies at the end of the range in which both wheels
/// have a contact. Empty if this end is the middle.
inline std::vector<WheelsetOnTrack::RollingRadii> radii_outwards(const WheelsetOnTrack& wheelset, double step) {
    constexpr double reach = 0.1, precise = 1e-9;  // [m]
    std::vector<WheelsetOnTrack::RollingRadii> radii;
    double out = 0;
    for (int k = 0; std::abs(out = k * step) < reach; ++k) {
        WheelsetOnTrack::RollingRadii at = rolling_radii(wheelset, out);
        if (at.status != Status::ok) break;
        radii.push_back(std::move(at));
    }
    if (radii.empty()) return radii;
    WheelsetOnTrack::RollingRadii last = radii.back();
    while (std::abs(out - last.lateral) > precise) {
        WheelsetOnTrack::RollingRadii middle = rolling_radii(wheelset, (out + last.lateral) / 2);
        if (middle.status == Status::ok) {
            last = std::move(middle);
        } else {
            out = middle.lateral;
        }
    }
    if (last.lateral != radii.back().lateral) radii.push_back(std::move(last));
    return radii;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL std::optional<WheelsetOnTrack::RadiusDifference> radius_difference(const WheelsetOnTrack& wheelset,
                                                                                double step) {
    detail::require(step >= 1e-6 && step <= 1e-3, "radius_difference", "step", step, "lie in [1e-6, 1e-3]");
    std::vector<WheelsetOnTrack::RollingRadii> radii = detail::radii_outwards(wheelset, -step);
    const std::vector<WheelsetOnTrack::RollingRadii> right = detail::radii_outwards(wheelset, step);
    std::reverse(radii.begin(), radii.end());
    if (!right.empty()) radii.insert(radii.end(), right.begin() + 1, right.end());
    const auto n = static_cast<Eigen::Index>(radii.size());
    Eigen::ArrayXd y(n), difference(n);
    Eigen::Index balanced = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
        const WheelsetOnTrack::RollingRadii& at = radii[std::size_t(i)];
        y[i] = at.lateral;
        difference[i] = at.difference();
        if (difference[i] <= 0) balanced = i;
    }
    if (n < 2 || balanced < 0 || difference[n - 1] < 0) return std::nullopt;
    // both points of contact where Delta r is 0, between two positions
    const WheelsetOnTrack::RollingRadii &low = radii[std::size_t(balanced)],
                                        &high = radii[std::size_t((std::min)(balanced + 1, n - 1))];
    const double rise = high.difference() - low.difference(), share = rise > 0 ? -low.difference() / rise : 0;
    const auto mean = [](const WheelsetOnTrack::RollingRadii& at) {
        return (at.wheels[0].rolling_radius + at.wheels[1].rolling_radius) / 2;
    };
    const double distance = low.distance() + share * (high.distance() - low.distance()),
                 radius = mean(low) + share * (mean(high) - mean(low));
    return WheelsetOnTrack::RadiusDifference(std::move(y), std::move(difference), distance, radius);
}

ROLLBEM_DECL WheelsetPosition WheelsetOnTrack::seen_from(Side side, const WheelsetPosition& position) {
    return detail::mirrored(position, detail::Mirror::of(side));
}

ROLLBEM_DECL WheelsetSpeeds WheelsetOnTrack::seen_from(Side side, const WheelsetSpeeds& speeds) {
    return detail::mirrored(speeds, detail::Mirror::of(side));
}

ROLLBEM_DECL WheelsetPosition WheelsetOnTrack::Contacts::seen(Side side) const {
    WheelsetPosition at = seen_from(side, position);
    at.height = wheels[std::size_t(side)].height;
    return at;
}

}  // namespace rollbem
