// library_run KIND VARIANT START: results of the library's steps, as a C++ program calls it, bit for bit, for steps
// read as lines of duration [s] and inputs in SI units. KIND is patch, rollbem_patch at its start values, with slip
// velocities, spin, rolling speed, load and factor of friction as inputs, and VARIANT follows or fixed, the mesh, or
// the file of a table of creep forces; or wheelset, with the folder of its tables as VARIANT and the inputs of its FMU.
// Where START is steady, the first line is that state. Prints forces and moments, slip work and the number of elements
// that stick. Exits with 1 at a step that is not ok.
#include <array>
#include <cstdio>
#include <string>
#include <utility>

#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/patch_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/vehicle/contact_table.hpp>

namespace {

using rollbem::Status;
using Hertz = rollbem::HertzEllipse::Load;
using Model = rollbem::FrictionModel;

constexpr double poisson_ratio = 0.28, friction_coefficient = 0.3, nominal_load = 1e5, largest_load = 2e5;

/// The ellipse under largest_load.
rollbem::HertzEllipse start_ellipse() {
    const rollbem::ElasticBody body{2 * 8e10 * (1 + poisson_ratio), poisson_ratio};
    return rollbem::HertzEllipse({.load = largest_load,
                                  .radii_1 = {.rolling = 0.46, .lateral = 1e9},
                                  .radii_2 = {.rolling = 1e9, .lateral = 0.3},
                                  .body_1 = body,
                                  .body_2 = body});
}

template <std::size_t Count>
bool read(std::array<double, Count>& numbers) {
    for (double& one : numbers) {
        if (std::scanf("%la", &one) != 1) return false;
    }
    return true;
}

void print(const rollbem::TangentialForce& force, double work, Eigen::Index stick_count) {
    std::printf("%a %a %a %a %a\n", force.longitudinal, force.lateral, force.moment, work,
                static_cast<double>(stick_count));
}

bool roll_patch(bool fixed, bool steady) {
    const rollbem::HertzEllipse ellipse = start_ellipse();
    const rollbem::PatchContact contact = ellipse.contact();
    const rollbem::PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
    const rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
    const rollbem::HalfSpace<double> kernel(poisson_ratio);
    Hertz hertz = fixed ? Hertz::fixed(ellipse, contact, mesh) : Hertz::breathing(ellipse, contact, mesh);
    Model model(contact, fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
                rollbem::unchecked, {friction_coefficient, hertz_pressures(contact, mesh, largest_load)});
    Model::Workspace workspace = model.workspace();
    rollbem::NormalLoad normal = hertz.at(nominal_load);
    Model::State now = model.at_rest();
    now.normal_pressure = normal.normal_pressure;
    now.half_length = normal.half_length;
    now.half_width = normal.half_width;
    Model::State next = now;
    double work = 0;
    for (std::array<double, 7> line{}; read(line); steady = false) {
        const auto& [duration, longitudinal, lateral, spin, speed, load, factor] = line;
        hertz.set(load, normal);
        normal.normal_pressure *= factor;
        normal.pressure_rate *= factor;
        const rollbem::Creepage shift{duration * longitudinal, duration * lateral, duration * spin};
        const auto step =
            steady
                ? model.steady(now, {.motion = {longitudinal / speed, lateral / speed, spin / speed}, .load = normal},
                               next, workspace)
                : model.advance(now, {duration * speed, Model::Motion::shift(shift), normal}, next, workspace);
        if (step.status != Status::ok) return false;
        std::swap(now, next);
        if (!steady) work += step.slip_work;
        print(step.force, work, step.stick_count);
    }
    return true;
}

bool roll_by_table(const std::string& file) {
    const auto table = rollbem::CreepForceTable::read(file);
    const rollbem::HertzEllipse ellipse = start_ellipse();
    double work = 0;
    bool first = true;
    for (std::array<double, 7> line{}; read(line); first = false) {
        const auto& [duration, longitudinal, lateral, spin, speed, load, factor] = line;
        const auto found = table.look_up(ellipse.under(load).contact(), friction_coefficient * factor, load,
                                         {longitudinal / speed, lateral / speed, spin / speed});
        if (found.status != Status::ok) return false;
        const auto& [along, across, moment] = found.force;
        if (!first) work += -duration * (longitudinal * along + lateral * across + spin * moment);
        print(found.force, work, 0);
    }
    return true;
}

bool roll_wheelset(const std::string& folder) {
    const auto creep = rollbem::CreepForceTable::read(folder + "/steel.creep");
    const auto contacts = rollbem::ContactTable::read(folder + "/s1002_60e1.contact");
    double work = 0, before = 0;
    bool first = true;
    for (std::array<double, 11> x{}; read(x); first = false) {
        std::array<rollbem::WheelForces, 2> wheels;
        for (std::size_t k = 0; k < 2; ++k) {
            wheels[k] = contacts.look_up(creep, k == 0 ? rollbem::WheelsetSide::left : rollbem::WheelsetSide::right,
                                         {.lateral = x[1], .yaw = x[2]}, {x[3], x[4], x[5], x[6], x[7], x[8]}, x[9 + k],
                                         friction_coefficient);
            if (wheels[k].status != Status::ok) return false;
        }
        const double heat = wheels[0].heat + wheels[1].heat;
        if (!first) work += x[0] * (before + heat) / 2;
        before = heat;
        using Forces = Eigen::Matrix<double, 6, 1>;
        const Forces both = wheels[0].force + wheels[1].force;
        for (const auto& forces : {both, Forces(wheels[0].force), Forces(wheels[1].force)}) {
            for (const double one : forces) std::printf("%a ", one);
        }
        std::printf("%a\n", work);
    }
    return true;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 4) return 2;
    const std::string kind = arguments[1], variant = arguments[2];
    const bool steady = std::string(arguments[3]) == "steady";
    if (kind == "wheelset") return !roll_wheelset(variant);
    const bool by_elements = variant == "follows" || variant == "fixed";
    return !(by_elements ? roll_patch(variant == "fixed", steady) : roll_by_table(variant));
}
