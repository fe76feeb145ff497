#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/rolling/run.hpp>

#include "friction/rolling.hpp"
#include "patch.hpp"
#include "support/timing.hpp"

namespace patch {

namespace {

constexpr double peak = 3 / (2 * std::numbers::pi);  // mu p_0

/// A row of the table of forces or, with an element i, of the table of tractions.
struct FrictionRow {
    const Friction& scene;
    const Patch& patch;
    const CreepPoint& point;
    const rollbem::FrictionStep& step;
    const rollbem::FrictionState& state;
    const rollbem::ElementVectors& slip;
    const rollbem::Elements<double>& elements;
    double largest_slip;  ///< rigid
    study::Cell time_us;
    Eigen::Index i = 0;

    bool ok() const { return step.status == rollbem::Status::ok; }
    double strip_width() const { return patch.mesh.widths()[i / patch.mesh.elements_per_strip()]; }
};

template <class Value>
auto if_ok(const Value& value) {
    return study::where(&FrictionRow::ok, value);
}

using FrictionColumns = std::vector<study::Column<FrictionRow>>;

/// The columns beside those of constant friction and creepages over mu N: of --falling, and of SI units.
FrictionColumns further_columns(bool falls, bool si) {
    using R = FrictionRow;
    FrictionColumns columns;
    if (si) {
        columns = {{"force_x", "with --creepage: force along x on body 1 [N]",
                    if_ok([](const R& r) { return r.scene.si->force * r.step.force.longitudinal; })},
                   {"force_y", "force along y on body 1 [N]",
                    if_ok([](const R& r) { return r.scene.si->force * r.step.force.lateral; })},
                   {"moment_z", "moment on body 1 about its middle [N m]",
                    if_ok([](const R& r) { return r.scene.si->moment * r.step.force.moment; })}};
    }
    if (!falls) return columns;
    return study::joined(columns,
                         study::friction_law_columns<R>([](const R& r) -> const auto& { return r.scene.law; }));
}

study::Sheet<FrictionRow, Patch> friction_sheet(bool falls, bool si) {
    using R = FrictionRow;
    const FrictionColumns forces = study::joined(
        creepage_columns<R>(),
        {{"longitudinal_force", "longitudinal force -F_x/(mu N)",
          if_ok([](const R& r) { return 0 - r.step.force.longitudinal / mu_N(r.patch); })},
         {"lateral_force", "lateral force -F_y/(mu N)",
          if_ok([](const R& r) { return 0 - r.step.force.lateral / mu_N(r.patch); })},
         {"spin_moment", "moment -M_z/(mu N c)",
          if_ok([](const R& r) { return 0 - r.step.force.moment / r.patch.contact.c() / mu_N(r.patch); })},
         {"stick_count", "number of elements that stick", [](const R& r) { return r.step.stick_count; }},
         {"rounds", "number of Newton steps", [](const R& r) { return r.step.rounds; }},
         {"complementarity_residual", "largest violation of Coulomb's law",
          [](const R& r) { return r.step.complementarity_residual; }},
         {"time_us", "time of the solution, matrices ready [microseconds]", &R::time_us},
         {"status", "ok, or why forces and tractions are empty", [](const R& r) { return name(r.step.status); }}});
    return {identity, study::joined(forces, further_columns(falls, si)), distinctions};
}

study::Sheet<FrictionRow, Patch> traction_sheet(bool falls) {
    using R = FrictionRow;
    FrictionColumns columns = study::joined(
        creepage_columns<R>(),
        {{"x", "centre of the element along x [a, outlines: c]", [](const R& r) { return r.elements.centre_x[r.i]; }},
         {"y", "centre of the element along y [b, outlines: c]",
          [](const R& r) { return r.elements.centre_y[r.i] * r.patch.contact.a_over_b(); }},
         {"width", "width of the element along x [a, outlines: c]",
          [](const R& r) { return r.elements.areas[r.i] / r.strip_width(); }},
         {"strip_width", "width of the element along y [b, outlines: c]",
          [](const R& r) { return r.strip_width() * r.patch.contact.a_over_b(); }},
         {"pressure_bound", "bound mu p_n of the traction [mu p_0 = 3 mu N/(2 pi a b)]",
          [](const R& r) { return r.state.normal_pressure[r.i] / peak; }},
         {"traction_x", "tractions along x and y [mu p_0]",
          if_ok([](const R& r) { return r.state.traction(r.i, 0) / peak; })},
         {"traction_y", "", if_ok([](const R& r) { return r.state.traction(r.i, 1) / peak; })},
         {"slip_x", "slip along x and y [largest rigid slip of the patch]",
          if_ok([](const R& r) { return r.slip(r.i, 0) / r.largest_slip; })},
         {"slip_y", "", if_ok([](const R& r) { return r.slip(r.i, 1) / r.largest_slip; })},
         {"stick", "1 where the element sticks, else 0",
          if_ok([](const R& r) { return int(r.state.zones[std::size_t(r.i)] == rollbem::Zone::stick); })},
         {"status", "ok, or why tractions are empty", [](const R& r) { return name(r.step.status); }}});
    if (falls) {
        columns.push_back({"friction",
                           "with " + study::friction_law_flags() + ": coefficient of friction of the element [mu_0]",
                           if_ok([](const R& r) { return r.state.friction_coefficient[r.i]; })});
    }
    return {identity, columns, "scheme"};
}

double largest_slip(const Patch& patch, const CreepPoint& point, const rollbem::Elements<double>& elements) {
    const rollbem::Creepage motion = creepage(patch, point);
    const double spin = motion.spin * patch.contact.half_length();
    const double largest =
        ((motion.longitudinal - spin * elements.y).square() + (motion.lateral + spin * elements.x).square())
            .sqrt()
            .maxCoeff();
    return largest > 0 ? largest : 1;  // then nothing slips
}

}  // namespace

std::string friction_help() {
    return friction_sheet(true, true).help() + "--tractions FILE, one row for each element:\n" +
           traction_sheet(true).help();
}

rollbem::Friction friction_of(const std::optional<study::ChosenLaw>& law, const Patch& patch,
                              Eigen::ArrayXd pressures) {
    if (!law) return {1.0, std::move(pressures)};
    // slip velocities in V mu_0 p_0/G, distances in c mu_0 p_0/G
    const auto falls = [own = law->law()](double velocity) {
        return own.is_constant() ? own.at_rest() : own.of_slip()(velocity / peak);
    };
    return {falls,
            std::move(pressures),
            {.distance = law->memory.distance * patch.contact.c() * peak,
             .least_velocity = law->memory.least_velocity * peak}};
}

study::Table friction_table(const Friction& scene) {
    const study::Sheet<FrictionRow, Patch> forces = friction_sheet(scene.law.has_value(), scene.si.has_value()),
                                           elementwise = traction_sheet(scene.law.has_value());
    study::Table table = forces.frame(scene.patches, scene.points.size());
    study::SideTable& tractions = table.put_beside("tractions", elementwise.names(), scene.keeps_tractions);
    table.compute = [&scene, &tractions, forces, elementwise](std::size_t task, study::RowRange range,
                                                              const study::Emit& emit) {
        const Patch& patch = scene.patches[task];
        const rollbem::Elements<double> elements = rollbem::patch_elements(patch.mesh, patch.scheme);
        const rollbem::FrictionModel model(patch.contact, steady_system(patch.mesh, patch.scheme, patch.kernel()),
                                           friction_of(scene.law, patch, scene.pressure(patch)));
        const auto rest = model.at_rest();
        auto state = rest;
        auto workspace = model.workspace();
        for (std::size_t k = range.first; k < range.last; ++k) {
            rollbem::FrictionStep step;
            CreepPoint point = scene.points[k];
            const auto at = [&](double longitudinal) -> rollbem::FrictionStep {
                point.longitudinal = longitudinal;
                return model.steady(rest, {rollbem::Travel::at_speed(1), creepage(patch, point)}, state, workspace);
            };
            const auto time_us = study::time_us_if(scene.timed, [&] {
                step = scene.force ? friction::find_for_force(*scene.force, mu_N(patch), 0, at)
                                   : at(scene.points[k].longitudinal);
                return step.force.longitudinal;
            });
            if (scene.force && step.status != rollbem::Status::ok) point.longitudinal = std::nan("");
            FrictionRow row{
                scene,  patch, point, step, state, workspace.slip(), elements, largest_slip(patch, point, elements),
                time_us};
            emit(forces.row(patch, row));
            for (; tractions.wanted && row.i < elements.size(); ++row.i) {
                tractions.rows[task].push_back(elementwise.row(patch, row));
            }
        }
    };
    table.plot = [&scene, &tractions](const study::Records& rows) {
        return scene.from_above ? draw_from_above(scene.patches, scene.points.front(), tractions)
                                : draw_friction(rows, scene.force.has_value());
    };
    return table;
}

}  // namespace patch
