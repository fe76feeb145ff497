#include "profiles.hpp"

#include <rollbem/closed_form/friction.hpp>

namespace friction {

void write_profiles(const Profiles& profiles, const Pressure& pressure, bool with_header, study::TableFile& file) {
    if (with_header) {
        file.rows().write(study::csv_line({"n", "creepage_ratio", "x_over_a", "traction", "bound", "stick", "slip",
                                           "exact", "mesh", "method", "derivative", "alpha_L", "alpha_T", "status"}));
    }
    for (const auto& [key, profile] : profiles.all()) {
        for (Eigen::Index i = 0; i < profile.mesh.size(); ++i) {
            const double x = profile.mesh.centres()[i];
            study::Cell traction, stick, slip, exact;
            if (profile.status == "ok") {
                traction = profile.traction[i];
                stick = int(profile.sticks[std::size_t(i)]);
                slip = profile.slip[i];
            }
            if (pressure.hertz) exact = rollbem::carter_friction_traction(x, profile.ratio);
            file.rows().write(
                study::csv_line({profile.mesh.size(), profile.ratio, x, traction, profile.bound[i], stick, slip, exact,
                                 profile.mesh_name, profile.scene->method, profile.scene->derivative, profile.alpha_L,
                                 profile.alpha_T, profile.status}));
        }
    }
    file.commit();
}

}  // namespace friction
