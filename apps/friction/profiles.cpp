#include "profiles.hpp"

#include <rollbem/closed_form/friction.hpp>

#include "creep_curve.hpp"

namespace friction {

std::string profile_header() {
    return "n,creepage_ratio,x_over_a,traction,bound,stick,slip,exact,mesh,method,derivative,alpha_L,"
           "alpha_T,status,lateral_ratio,lateral_traction,lateral_slip,layer,friction_ratio," +
           study::join(study::setting_columns(), ",") + "\n";
}

void write_profiles(const Profiles& profiles, const CreepCurve& curve, study::TableFile& file) {
    for (const auto& [key, profile] : profiles.all()) {
        const bool carter = curve.carter() && profile.point.lateral.value_or(0) == 0 && profile.point.spin == 0;
        const bool both = profile.lateral_traction.size() > 0;
        for (Eigen::Index i = 0; i < profile.mesh.size(); ++i) {
            const double x = profile.mesh.centres()[i];
            study::Cell traction, stick, slip, exact, lateral_traction, lateral_slip;
            if (profile.status == "ok") {
                traction = profile.traction[i];
                stick = int(profile.sticks[std::size_t(i)]);
                slip = profile.slip[i];
                if (both) lateral_traction = profile.lateral_traction[i];
                if (both) lateral_slip = profile.lateral_slip[i];
            }
            study::Cell friction_ratio;
            if (profile.status == "ok" && profile.friction.size() > 0) friction_ratio = profile.friction[i];
            if (carter) exact = rollbem::carter_friction_traction(x, profile.point.longitudinal);
            file.rows().write(study::csv_line(study::joined(
                {profile.mesh.size(), profile.point.longitudinal, x, traction, profile.bound[i], stick, slip, exact,
                 profile.mesh_name, profile.scene->method, profile.scene->derivative, profile.alpha_L, profile.alpha_T,
                 profile.status, profile.point.lateral, lateral_traction, lateral_slip, curve.layer, friction_ratio},
                study::setting_cells(*profile.scene))));
        }
    }
    file.commit();
}

}  // namespace friction
