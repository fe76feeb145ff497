#include <stdexcept>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/load.hpp>

#include "friction/rolling.hpp"
#include "patch.hpp"

namespace patch {

namespace {

using PatchContact = rollbem::PatchContact;
using friction::Rolling;

// --- contacts ------------------------------------------------------------------------------------------------------

PatchContact stretched(const PatchContact& contact, const AxisRatios& axes) {
    return PatchContact({.half_length = axes.a * contact.half_length(),
                         .half_width = axes.b * contact.half_width(),
                         .shear_modulus = contact.shear_modulus(),
                         .poisson_ratio = contact.poisson_ratio()});
}

/// The contact that the mesh of a whole run covers, and that mesh.
struct Covered {
    Covered(const TimeScene& scene, const Patch& patch)
        : contact(scene.run.load_varies() && !scene.run.breathing ? stretched(patch.contact, scene.largest_axes())
                                                                  : patch.contact),
          mesh(rollbem::patch_mesh(contact, patch.mesh.along(), patch.across)) {}

    PatchContact contact;
    rollbem::PatchMesh<double> mesh;
};

/// Throws BadInput if modes of the patch grow.
rollbem::FrictionModel make_contact(const TimeScene& scene, const Patch& patch, const Covered& covered,
                                    const Eigen::ArrayXd& pressures) {
    const PatchContact& contact = covered.contact;
    const rollbem::PatchMesh<double>& mesh = covered.mesh;
    const auto make = [&](rollbem::ElementSystem<double, 2> system, const rollbem::StabilityVerdict& verdict) {
        if (!verdict.stable()) {
            throw std::invalid_argument("modes must decay, whatever rounding does; take another --n or --strips");
        }
        return rollbem::FrictionModel(contact, std::move(system), verdict, friction_of(scene.law, patch, pressures),
                                      scene.run.integrator);
    };
    return study::blame(patch.label() + " cannot be stepped", [&]() -> rollbem::FrictionModel {
        const auto [least, largest] = scene.shapes();
        if (scene.run.breathing && largest > least * (1 + 1e-9)) {
            const double a_over_b = patch.contact.a_over_b(), margin = 1 + 1e-6;
            const rollbem::PatchShapes<double> shapes(
                mesh.along(), patch.across, patch.scheme, patch.kernel(),
                {.least = a_over_b * least / margin, .largest = a_over_b * largest * margin});
            return make(shapes.system(a_over_b), rollbem::judge_stability(shapes));
        }
        return make(scene.run.breathing ? rollbem::breathing_system(contact, mesh, patch.scheme, patch.kernel())
                                        : rollbem::rolling_system(mesh, patch.scheme, patch.kernel()),
                    rollbem::judge_stability(rollbem::patch_subsystems(mesh, patch.scheme, patch.kernel())));
    });
}

Rolling make_rolling(const TimeScene& scene, const Patch& patch) {
    const Covered covered(scene, patch);
    const Eigen::ArrayXd pressures = scene.run.load_varies()
                                         ? rollbem::hertz_pressures(covered.contact, covered.mesh, mu_N(patch))
                                         : scene.pressure(patch);
    Rolling rolling{.contact = make_contact(scene, patch, covered, pressures),
                    .run = scene.run,
                    .spin_unit = 1 / patch.contact.c(),
                    .full = mu_N(patch),
                    .a_0 = patch.contact.half_length()};
    if (!scene.run.load_varies()) return rolling;
    if (scene.run.breathing) {
        rolling.load_at = [&patch, &scene, pressures](double q) {
            const AxisRatios axes = scene.axes(q);
            return rollbem::NormalLoad{scene.run.load_ratio(q) / (axes.a * axes.b) * pressures,
                                       axes.a * patch.contact.half_length(),
                                       {},
                                       axes.b * patch.contact.half_width()};
        };
        return rolling;
    }
    const rollbem::SemiAxes least = rollbem::least_resolved(covered.contact, covered.mesh);
    rolling.fits = [&scene, &patch, least](double q) {
        if (scene.run.load_ratio(q) == 0) return true;
        const PatchContact now = stretched(patch.contact, scene.axes(q));
        return now.half_length() >= least.half_length && now.half_width() >= least.half_width;
    };
    rolling.load_at = [&patch, &scene, contact = covered.contact,
                       elements = covered.mesh.rectangles(covered.contact.half_length())](double q) {
        rollbem::NormalLoad normal{
            Eigen::ArrayXd::Zero(Eigen::Index(elements.size())), contact.half_length(), {}, contact.half_width()};
        const double ratio = scene.run.load_ratio(q);
        if (ratio == 0) return normal;
        normal.normal_pressure =
            rollbem::hertz_pressures(stretched(patch.contact, scene.axes(q)), elements, ratio * mu_N(patch));
        return normal;
    };
    return rolling;
}

// --- rows ----------------------------------------------------------------------------------------------------------

struct TimeRow {
    const TimeScene& scene;
    const CreepPoint point;  ///< at the end of the row
    const Patch& patch;
    const friction::Moment& moment;

    double load_ratio() const { return scene.run.load_ratio(moment.q); }
    AxisRatios axes() const { return scene.axes(moment.q); }
    double force(double value) const { return 0 - value / mu_N(patch); }
    double work(double value) const { return value * patch.contact.c() / (mu_N(patch) * mu_N(patch)); }
};

study::Sheet<TimeRow, Patch> time_sheet(bool falls) {
    using R = TimeRow;
    using friction::if_computed, friction::if_valid;
    std::vector<study::Column<R>> columns = study::joined<study::Column<R>>(
        {{"q_over_a", "distance rolled q/a_0; the first row is at q = dq", [](const R& r) { return r.moment.q; }},
         {"load_ratio", "load N/N_0", &R::load_ratio},
         {"a_ratio", "semi-axis a/a_0: by Hertz the cube root of load_ratio, or as in the table of the load",
          [](const R& r) { return r.axes().a; }},
         {"b_ratio", "semi-axis b/b_0, likewise", [](const R& r) { return r.axes().b; }},
         {"longitudinal_force", "longitudinal force -F_x/(mu N_0)",
          if_valid([](const R& r) { return r.force(r.moment.step.force.longitudinal); })},
         {"lateral_force", "lateral force -F_y/(mu N_0)",
          if_valid([](const R& r) { return r.force(r.moment.step.force.lateral); })},
         {"spin_moment", "moment -M_z/(mu N_0 c_0)",
          if_valid([](const R& r) { return r.force(r.moment.step.force.moment / r.patch.contact.c()); })},
         {"stick_count", "number of elements that stick",
          if_valid([](const R& r) { return r.moment.step.stick_count; })},
         {"slip_work", "work of slip since the start [mu N_0 mu N_0/(G c_0)]",
          if_valid([](const R& r) { return r.work(r.moment.slip_work); })},
         {"creep_work",
          "work of the creepages -int (F_x xi + F_y eta + M_z phi) dq since the start, in the same unit, from the "
          "forces at both ends of a step (at its end with implicit-euler); creep_work = slip_work + change of "
          "elastic_energy, to the order of the mesh and of dq, whatever the load does",
          if_valid([](const R& r) { return r.work(r.moment.creep_work); })},
         {"status",
          "ok; unresolved where the ellipse is narrower than three of its strips or elements of a mesh that does "
          "not follow it, and throughout with fewer than six steps in a period of --load-sine (2 pi --dq > "
          "LENGTH): results are empty, works count such steps all the same; the reason where a step failed; "
          "after_failure behind it",
          [](const R& r) { return r.moment.status; }},
         {"elastic_energy", "elastic energy, in the same unit",
          if_valid([](const R& r) { return r.work(r.moment.elastic_energy); })},
         {"rounds", "number of Newton steps", if_computed([](const R& r) { return r.moment.rounds; })},
         {"complementarity_residual", "largest violation of Coulomb's law",
          if_computed([](const R& r) { return r.moment.step.complementarity_residual; })},
         {"integrator", "integrator, as in its option",
          [](const R& r) { return study::word(r.scene.run.integrator); }}},
        study::joined(
            creepage_columns<R>(),
            {{"shift_x", "rigid shift along x of this row over a_0, times G a b/(mu N), given or found for --force",
              [](const R& r) { return r.moment.shift.longitudinal / r.patch.contact.half_length(); }},
             {"shift_y", "rigid shift along y of this row, likewise",
              [](const R& r) { return r.moment.shift.lateral / r.patch.contact.half_length(); }}}));
    if (falls) {
        columns.push_back({"jump_work",
                           "with " + study::friction_law_flags() +
                               ": elastic energy that jumps of the tractions have released, which creep_work "
                               "contains besides, in the unit of works",
                           if_valid([](const R& r) { return r.work(r.moment.jump_work); })});
        columns = study::joined(columns,
                                study::friction_law_columns<R>([](const R& r) -> const auto& { return r.scene.law; }));
    }
    return {identity, columns, distinctions};
}

}  // namespace

std::string transient_help() { return time_sheet(true).help(); }

study::Table transient_table(const TimeScene& scene) {
    const bool by_force = scene.run.by_force();
    const auto row = [&scene, by_force](const Patch& patch, const friction::Moment& moment) {
        CreepPoint point = moment.shifted ? CreepPoint{0, 0, 0} : scene.at(moment.q);
        if (by_force && !moment.shifted) point.longitudinal = moment.creepage.longitudinal;
        return TimeRow{scene, point, patch, moment};
    };
    // the table refers to its sheet
    static const study::Sheet<TimeRow, Patch> constant = time_sheet(false), falling = time_sheet(true);
    study::Table table = friction::rolling_table(
        scene.law ? falling : constant, scene.patches, scene.run,
        [&](const Patch& patch) { return make_rolling(scene, patch); }, row);
    table.plot = [&, by_force](const study::Records& rows) {
        return draw_in_time(rows, scene.run.load_varies(), by_force);
    };
    return table;
}

}  // namespace patch
