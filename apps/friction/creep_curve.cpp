#include "creep_curve.hpp"

#include <cmath>

#include <rollbem/closed_form/friction.hpp>

#include "support/files.hpp"

namespace friction {

bool CreepCurve::timed() const { return study::has_times(options); }

CreepCurve::Exact CreepCurve::exact(const study::Scene& scene, const CreepPoint& point) const {
    if (!carter() || point.spin != 0) return {};
    using rollbem::carter_force_ratio;
    if (!point.lateral) return {carter_force_ratio(point.longitudinal), std::nullopt};
    const double nu = scene.contact.poisson_ratio(), along = point.longitudinal, across = *point.lateral;
    if (across == 0) return {carter_force_ratio(along), 0.0};
    // the ratio is in units of the longitudinal compliance 1 - nu; across it is 1
    if (along == 0) return {0.0, carter_force_ratio((1 - nu) * across)};
    if (nu != 0) return {};
    const double size = std::hypot(along, across), force = carter_force_ratio(size);
    return {force * along / size, force * across / size};
}

const std::vector<std::string>& creep_columns() {
    static const std::vector<std::string> columns = study::joined(
        study::cells_of("method,derivative,mesh,n,alpha_L,alpha_T,creepage_ratio,force_ratio,exact,relative_error,"
                        "stick_count,rounds,complementarity_residual,time_us,lateral_ratio,lateral_force_ratio,"
                        "assembly_us,tangent_ratio,slip_work,pivots,status,lateral_exact,lateral_relative_error,"
                        "lateral_tangent_ratio,spin_ratio,moment_ratio,layer,falling_ratio,half_velocity,"
                        "memory_distance,least_velocity,sweep"),
        study::setting_columns());
    return columns;
}

study::Row creep_row(const CreepCurve& curve, const study::Scene& scene, const CreepPoint& point,
                     const CreepResult& result) {
    const CreepCurve::Exact exact = curve.exact(scene, point);
    const study::Cell lateral_error =
        result.lateral_force_ratio ? relative_error(*result.lateral_force_ratio, exact.lateral) : study::Cell();
    return study::row_of(
        {{scene.method, scene.derivative, result.mesh_name, scene.n(), result.alpha_L, result.alpha_T},
         {point.longitudinal, result.force_ratio, exact.longitudinal,
          relative_error(result.force_ratio, exact.longitudinal)},
         {result.stick_count, result.rounds, result.complementarity_residual, result.time_us},
         {point.lateral, result.lateral_force_ratio, result.assembly_us, result.tangent_ratio, result.slip_work},
         {result.pivots, result.status, exact.lateral, lateral_error, result.lateral_tangent_ratio},
         {point.lateral ? study::Cell(point.spin) : study::Cell(), result.moment_ratio, curve.layer},
         falling_cells(curve.falling),
         {study::Cell(curve.sweep)},
         study::setting_cells(scene)});
}

}  // namespace friction
