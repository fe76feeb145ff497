// What wears and tires wheels and rails that roll: frictional work, where on a profile it is done, the fatigue index.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "../detail/require.hpp"
#include "wheelset_forces.hpp"

namespace rollbem {

/// T gamma [N], the work of creep forces on creepages per metre rolled [J/m]: -(F_x xi + F_s eta + M_n phi). Wear per
/// metre is a function of it over the area (British Rail Research; Braghin et al. 2006). It is the heat of friction
/// (slip_work) up to the errors of the discretisation, where slip is that of the three creepages.
inline double t_gamma(const PatchForce& patch) {
    return -(patch.force.longitudinal * patch.creepage.longitudinal + patch.force.lateral * patch.creepage.lateral +
             patch.force.moment * patch.creepage.spin);
}

/// FI_surf [-] of Ekberg, Kabo and Andersson (2002): the force of friction over the normal force, less k/p_max, k the
/// yield stress in shear [Pa]; of Hertz's contact p_max = 3N/(2 pi a b). Where it is positive, the surface flows
/// plastically in every passage, and cracks may start.
inline double surface_fatigue_index(const RailPatch& patch, const PatchForce& friction, double shear_yield) {
    return std::hypot(friction.force.longitudinal, friction.force.lateral) / patch.load -
           shear_yield / patch.peak_pressure;
}

/// Frictional work per metre rolled, over the arc length of a profile, summed over many patches.
class ProfileWear {
public:
    /// Throws std::invalid_argument unless there is a cell.
    ProfileWear(const Profile& profile, Eigen::Index cells) : length_(profile.length()) {
        detail::require(cells >= 1, "ProfileWear", "number of cells", cells, "be at least 1");
        work_ = Eigen::ArrayXd::Zero(cells);
    }

    /// Adds `weight` times the work of a patch, whose reference point lies at `s` along the profile [m], uniform in
    /// each of its strips. What lies beyond the profile's ends counts in the outermost cells. Ignores friction without
    /// result.
    void add(double s, const PatchForce& friction, double weight = 1) {
        for (Eigen::Index k = 0; k < friction.strip_work.size(); ++k) {
            const double low = s + friction.edges[k], high = s + friction.edges[k + 1];
            const auto cell = [&](double at) {
                return std::clamp(static_cast<Eigen::Index>(std::floor(at / width())), Eigen::Index(0),
                                  work_.size() - 1);
            };
            for (Eigen::Index i = cell(low); i <= cell(high); ++i) {
                const double from = i == cell(low) ? low : double(i) * width(),
                             to = i == cell(high) ? high : double(i + 1) * width();
                work_[i] += weight * friction.strip_work[k] * (to - from) / (high - low) / width();
            }
        }
    }

    double width() const { return length_ / double(work_.size()); }  ///< of a cell [m]
    /// Of each cell, per metre rolled and metre of profile [J/m^2].
    const Eigen::ArrayXd& work() const { return work_; }

private:
    double length_;
    Eigen::ArrayXd work_;
};

}  // namespace rollbem
