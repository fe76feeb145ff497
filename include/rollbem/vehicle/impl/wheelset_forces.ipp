// Bodies of vehicle/wheelset_forces.hpp. Internal.
#pragma once

#include "../wheelset_forces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/rising_root.hpp"
#include "../../normal/detail/finite_position.hpp"
#include "../detail/free_pitch_rate.hpp"
#include "../detail/slip_velocity.hpp"

namespace rollbem::detail {

/// Multiplies all forces of a wheel by a factor.
inline void scale(WheelOnRail::Contact& wheel, std::vector<PatchForce>& forces, double factor) {
    for (RailPatch& patch : wheel.patches) {
        for (double* of : {&patch.load, &patch.peak_pressure}) *of *= factor;
        patch.pressure *= factor;
    }
    for (PatchForce& patch : forces) {
        patch.force = factor * patch.force;
        patch.slip_work *= factor;
        patch.strip_work *= factor;
    }
}

/// Searches for the vertical load of a wheel's normal forces with which normal forces and friction carry the wanted
/// load. `log_load_factor` is the logarithm of the former over the latter.
class CarriedLoad {
public:
    double log_load_factor = 0;

    /// Whether normal forces and friction carry the wanted load to 1e-6, or the wheel does not touch; otherwise sets
    /// another load. Contacts jump a little where grids change: there all forces are scaled.
    bool settled(WheelOnRail::Contact& wheel, std::vector<PatchForce>& forces, double wanted) {
        double carried = 0;
        for (std::size_t i = 0; i < forces.size(); ++i)
            carried -= wrench_of(wheel.patches[i], forces[i], 0, 0).force[2];
        const double excess = std::log((std::max)(carried / wanted, 1e-2));
        if (!is_finite(carried) || std::abs(excess) < 1e-6) return true;
        before_ = std::exchange(log_load_factor, root_.next(log_load_factor, excess));
        constexpr double jump = 1e-2;
        if (root_.width() > 1e-6) return false;
        if (std::abs(excess) > jump) {
            root_ = RisingRoot(1, largest);  // the bounds belonged to another state of the other wheel
            return false;
        }
        scale(wheel, forces, wanted / carried);
        return true;
    }
    /// Returns halfway to the previous load.
    void halve_step() { log_load_factor = (log_load_factor + before_) / 2; }

private:
    static constexpr double largest = 1.4;  // largest step
    double before_ = 0;
    RisingRoot root_{1, largest};
};

/// Contacts and friction in turn, until they carry the loads.
class RollingBalance {
public:
    RollingBalance(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling, const RollingFriction& friction)
        : wheelset_(wheelset),
          rolling_(rolling),
          friction_(friction),
          position_(rolling.position),
          speeds_(rolling.speeds) {}

    WheelsetForces solve(WheelsetOnTrack::Workspace& workspace, const WheelOnRail::Options& options) {
        for (bool settled = false; !settled;) {
            ++result_.rounds;
            find_contacts(workspace, options);
            if (halves_steps()) continue;
            if (rolling_.free_pitch) speeds_.pitch_rate = free_pitch_rate(wheelset_, result_.contacts, speeds_);
            settled = true;
            for (const Side side : WheelsetOnTrack::sides) {
                find_friction(side);
                settled = is_balanced(side) && settled;
            }
        }
        judge();
        for (const Side side : WheelsetOnTrack::sides) add_forces(side);
        return std::move(result_);
    }

private:
    using Side = WheelsetOnTrack::Side;
    using Free = WheelsetOnTrack::Free;

    WheelOnRail::Contact& wheel(Side side) { return result_.contacts.wheels[std::size_t(side)]; }

    void find_contacts(WheelsetOnTrack::Workspace& workspace, const WheelOnRail::Options& options) {
        std::array<double, 2> loads = rolling_.loads;
        for (std::size_t k = 0; k < 2; ++k) loads[k] *= std::exp(carried_[k].log_load_factor);
        result_.contacts = wheelset_.solve(position_, loads, workspace, rolling_.free, options);
        // the roll changes little from one round to the next
        if (has_numbers(result_.contacts.status)) position_.roll = result_.contacts.position.roll;
    }

    /// Whether a wheel has lost the numbers that it had under the previous loads; then loads return towards these.
    bool halves_steps() {
        constexpr int most = 4;
        bool lost = false;
        for (std::size_t k = 0; k < 2 && failures_ < most; ++k) {
            if (has_numbers(result_.contacts.wheels[k].status) || result_.patches[k].empty()) continue;
            carried_[k].halve_step();
            lost = true;
        }
        failures_ += lost;
        return lost;
    }

    void find_friction(Side side) {
        std::vector<PatchForce>& found = result_.patches[std::size_t(side)];
        found.clear();
        if (!has_numbers(wheel(side).status)) return;
        result_.pitch_rate = speeds_.pitch_rate;
        found = patch_forces(wheel(side).patches, result_.contacts.seen(side),
                             WheelsetOnTrack::seen_from(side, speeds_), wheelset_.wheel(side).dimensions(), friction_);
    }

    /// Whether a wheel needs no further round: it carries its load, it has none, or its search has ended with another
    /// status.
    bool is_balanced(Side side) {
        constexpr int most = 40;
        constexpr double out_of_reach = 5;  // a load of 150 times the one wanted
        const auto k = static_cast<std::size_t>(side);
        Status& status = wheel(side).status;
        if (!has_numbers(status) || rolling_.free == Free::nothing || !rolling_.loads_include_friction) return true;
        if (carried_[k].settled(wheel(side), result_.patches[k], rolling_.loads[k])) return true;
        const bool last = result_.rounds >= most, lifted = carried_[k].log_load_factor > out_of_reach;
        if (lifted) status = Status::load_not_reached;
        if (lifted && rolling_.free == Free::height_and_roll) {
            for (const Side both : WheelsetOnTrack::sides) wheel(both).status = Status::load_not_reached;
        }
        if (last) status = (std::max)(status, Status::unbalanced);
        return last || lifted;
    }

    /// Sets statuses of wheels by the statuses of their patches, and the status of the contacts.
    void judge() {
        for (const Side side : WheelsetOnTrack::sides) {
            Status& status = wheel(side).status;
            for (const PatchForce& patch : result_.patches[std::size_t(side)]) {
                if (patch.status == Status::invalid_step) status = (std::max)(status, Status::unbalanced);
            }
        }
        result_.contacts.status = (std::max)(wheel(Side::left).status, wheel(Side::right).status);
    }

    void add_forces(Side side) {
        const auto k = static_cast<std::size_t>(side);
        std::vector<PatchForce>& friction = result_.patches[k];
        if (!has_numbers(wheel(side).status)) friction.clear();
        const WheelsetPosition at = result_.contacts.seen(side);
        const double axle = at.height - wheelset_.wheel(side).dimensions().radius;
        Wrench sum;
        for (std::size_t i = 0; i < friction.size(); ++i) {
            sum += wrench_of(wheel(side).patches[i], friction[i], at.lateral, axle);
        }
        result_.on_wheel[k] = mirrored(sum, Mirror::of(side));
        result_.on_wheelset += result_.on_wheel[k];
    }

    const WheelsetOnTrack& wheelset_;
    const WheelsetRolling& rolling_;
    const RollingFriction& friction_;
    WheelsetPosition position_;
    WheelsetSpeeds speeds_;
    std::array<CarriedLoad, 2> carried_;
    int failures_ = 0;
    WheelsetForces result_;
};

/// Whether a wheel has friction, and each of the others is lifted.
inline bool has_friction_result(const WheelsetForces& forces) {
    const auto& [left, right] = forces.contacts.wheels;
    const auto known = [](Status status) { return has_numbers(status) || status == Status::no_contact; };
    return known(left.status) && known(right.status) && (has_numbers(left.status) || has_numbers(right.status));
}

/// Makes the status of wheels with numbers, and of the wheelset, no better than this one.
inline void set_at_least(WheelsetForces& forces, Status status) {
    for (WheelOnRail::Contact& wheel : forces.contacts.wheels) {
        if (has_numbers(wheel.status)) wheel.status = (std::max)(wheel.status, status);
        forces.contacts.status = (std::max)(forces.contacts.status, wheel.status);
    }
}

/// Leaves contacts.
inline void take_friction_out(WheelsetForces& forces) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::vector<PatchForce>& patches : forces.patches) {
        for (PatchForce& patch : patches) {
            patch = {.creepage = {nan, nan, nan},
                     .force = {nan, nan, nan},
                     .elements = patch.elements,
                     .status = patch.status == Status::ok ? Status::no_solution : patch.status};
        }
    }
    const Wrench unknown{{nan, nan, nan}, {nan, nan, nan}};
    forces.on_wheel = {unknown, unknown};
    forces.on_wheelset = unknown;
    forces.pitch_rate = nan;
}

/// The pitch rate at which friction has the wanted longitudinal force, between -20 and 20 % of creepage.
inline WheelsetForces roll_at_force(const WheelsetOnTrack& wheelset, WheelsetRolling rolling,
                                    const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                                    const WheelOnRail::Options& options) {
    constexpr double steepest = 100, largest_step = 0.02, most = 0.2, enough = 1e-6, jumps = 1e-9;
    const double wanted = *std::exchange(rolling.force, std::nullopt), forward = rolling.speeds.forward < 0 ? -1 : 1;
    rolling.free_pitch = true;
    WheelsetForces result = RollingBalance(wheelset, rolling, friction).solve(workspace, options);
    rolling.free_pitch = false;
    const double free = result.pitch_rate;
    RisingRoot root(steepest, largest_step);
    double creepage = 0;
    for (int k = 0; k < 80 && has_friction_result(result); ++k) {
        double load = 0;
        for (const WheelOnRail::Contact& wheel : result.contacts.wheels) {
            for (const RailPatch& patch : wheel.patches) load += patch.load;
        }
        const double excess = forward * (result.on_wheelset.force[0] - wanted) / load;
        if (std::abs(excess) < enough) return result;
        creepage = root.next(creepage, excess);
        if (!(std::abs(creepage) < most)) break;
        if (root.width() < jumps) {  // forces jump here with the grids of the contacts
            set_at_least(result, Status::unbalanced);
            return result;
        }
        rolling.speeds.pitch_rate = free * (1 + creepage);
        result = RollingBalance(wheelset, rolling, friction).solve(workspace, options);
    }
    take_friction_out(result);
    return result;
}

}  // namespace rollbem::detail

namespace rollbem {

ROLLBEM_DECL WheelsetForces rolling_forces(const WheelsetOnTrack& wheelset, const WheelsetRolling& rolling,
                                           const RollingFriction& friction, WheelsetOnTrack::Workspace& workspace,
                                           const WheelOnRail::Options& options) {
    if (!detail::is_finite(rolling.speeds)) return {};
    if (rolling.force) return detail::roll_at_force(wheelset, rolling, friction, workspace, options);
    return detail::RollingBalance(wheelset, rolling, friction).solve(workspace, options);
}

}  // namespace rollbem
