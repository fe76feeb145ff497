#include "creep_curve.hpp"

#include <cmath>

#include <rollbem/closed_form/friction.hpp>

#include "support/sheet.hpp"

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

namespace {

/// A row of the table.
struct CreepRow {
    const CreepCurve& curve;
    const CreepPoint& point;
    const CreepResult& result;
    CreepCurve::Exact exact;

    study::Cell falling(std::size_t k) const { return falling_cells(curve.falling)[k]; }
};

const study::Sheet<CreepRow>& creep_sheet() {
    using R = CreepRow;
    static const study::Sheet<CreepRow> columns{
        "method, derivative",
        {{"mesh", "and what follows it: the scheme", [](const R& r) { return r.result.mesh_name; }},
         {"n", "elements"},
         {"alpha_L", "of the scheme; empty with --fit-border", [](const R& r) { return r.result.alpha_L; }},
         {"alpha_T", "of the scheme; empty with --fit-border", [](const R& r) { return r.result.alpha_T; }},
         {"creepage_ratio", "delta = xi G/(2 (1-nu) mu p0)", [](const R& r) { return r.point.longitudinal; }},
         {"force_ratio", "-F_x/(mu N)", [](const R& r) { return r.result.force_ratio; }},
         {"exact", "Carter's, where it holds", [](const R& r) { return r.exact.longitudinal; }},
         {"relative_error", "force_ratio/exact - 1",
          [](const R& r) { return relative_error(r.result.force_ratio, r.exact.longitudinal); }},
         {"stick_count", "elements that stick", [](const R& r) { return r.result.stick_count; }},
         {"rounds", "iterations of the active set", [](const R& r) { return r.result.rounds; }},
         {"complementarity_residual",
          "the largest violation of |p| <= mu p_n (over mu p0) and of the direction of slip (over |xi|)",
          [](const R& r) { return r.result.complementarity_residual; }},
         {"time_us", "[microseconds] of the solution, median of at least 5 runs",
          [](const R& r) { return r.result.time_us; }},
         {"lateral_ratio", "as creepage_ratio, across the rolling direction",
          [](const R& r) { return r.point.lateral; }},
         {"lateral_force_ratio", "-F_y/(mu N)", [](const R& r) { return r.result.lateral_force_ratio; }},
         {"assembly_us", "the same, of the assembly of G'", [](const R& r) { return r.result.assembly_us; }},
         {"tangent_ratio", "d force_ratio/d creepage_ratio", [](const R& r) { return r.result.tangent_ratio; }},
         {"slip_work", "for each distance a rolled, in mu N mu p0 a/G, summed over the elements (second order in 1/n)",
          [](const R& r) { return r.result.slip_work; }},
         {"pivots", "of the fallback, used where rounds did not settle", [](const R& r) { return r.result.pivots; }},
         {"status",
          "where it is not ok, force_ratio, tangent_ratio and slip_work are empty. It is assists_creepage where some "
          "tractions of the same scheme in full adhesion assist the creepage, so that the scheme does not converge "
          "there: "
          "alpha <= 0 (or close to 0 on coarse meshes), or alpha > 1. (With friction, alpha = 0 converges, to first "
          "order, "
          "where several elements slip.)",
          [](const R& r) { return r.result.status; }},
         {"lateral_exact", "as exact", [](const R& r) { return r.exact.lateral; }},
         {"lateral_relative_error", "as relative_error",
          [](const R& r) {
              const auto& force = r.result.lateral_force_ratio;
              return force ? relative_error(*force, r.exact.lateral) : study::Cell();
          }},
         {"lateral_tangent_ratio", "as tangent_ratio", [](const R& r) { return r.result.lateral_tangent_ratio; }},
         {"spin_ratio", "phi a by the same 2 (1-nu) mu p0/G",
          [](const R& r) { return r.point.lateral ? study::Cell(r.point.spin) : study::Cell(); }},
         {"moment_ratio", "-M_z/(mu N a)", [](const R& r) { return r.result.moment_ratio; }},
         {"layer", "--layer", [](const R& r) { return r.curve.layer; }},
         {"falling_ratio", "--falling and --memory", [](const R& r) { return r.falling(0); }},
         {"half_velocity", "--falling and --memory", [](const R& r) { return r.falling(1); }},
         {"memory_distance", "--falling and --memory", [](const R& r) { return r.falling(2); }},
         {"least_velocity", "--falling and --memory", [](const R& r) { return r.falling(3); }},
         {"sweep", "--sweep", [](const R& r) { return study::Cell(r.curve.sweep); }}},
        study::settings};
    return columns;
}

}  // namespace

std::vector<std::string> creep_columns() { return creep_sheet().names(); }

std::string creep_help() { return creep_sheet().help(); }

study::Row creep_row(const CreepCurve& curve, const study::Scene& scene, const CreepPoint& point,
                     const CreepResult& result) {
    return creep_sheet().row(scene, {curve, point, result, curve.exact(scene, point)});
}

}  // namespace friction
