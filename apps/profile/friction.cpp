#include "friction.hpp"

#include <cmath>

#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>

namespace profile {

PatchForces forces_on(const rollbem::RailPatch& patch, const rollbem::WheelsetPosition& at, double pitch_rate,
                      const rollbem::TrackDimensions& dimensions, const FrictionSettings& settings) {
    const rollbem::Creepage<double> slip =
        rollbem::creepage_of(patch, at, {.forward = settings.speed, .pitch_rate = pitch_rate}, dimensions.radius);
    const rollbem::PatchContact<double> contact = rollbem::contact_of(patch, dimensions);
    const rollbem::PressureGrid<double> pressures = rollbem::pressure_of(patch);
    PatchForces forces{.creepage = {-slip.longitudinal, -slip.lateral, -slip.spin}};
    // where the scheme would gain energy on these strips, as on some flange contacts, with fewer
    for (Eigen::Index strips = settings.strips; strips >= 5 || strips == settings.strips; strips -= 2) {
        const rollbem::PatchMesh<double> mesh =
            rollbem::patch_mesh(contact, rollbem::cosine_mesh(settings.n), rollbem::uniform_mesh(strips));
        const auto elements = rollbem::rectangles(mesh, contact.half_length());
        Eigen::ArrayXd pressure = pressures(elements);
        double load = 0;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const auto& [x_1, x_2, y_1, y_2] = elements[i];
            load += pressure[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
        }
        pressure *= patch.load / load;
        const auto system = steady_system(mesh, rollbem::NodeDifference{rollbem::Nodes::chebyshev},
                                          rollbem::HalfSpace<double>(contact.poisson_ratio()));
        const rollbem::FrictionModel model(contact, system, {settings.mu, pressure, {}, false});
        auto workspace = model.workspace();
        auto state = model.at_rest();
        const auto step = model.steady(model.at_rest(), slip, state, workspace);
        const auto& force = step.force;
        forces.longitudinal = force.longitudinal;
        forces.lateral = force.lateral;
        forces.moment = force.moment;
        forces.power = step.slip_work * (settings.speed + std::abs(pitch_rate) * patch.rolling_radius) / 2;
        forces.elements = mesh.size();
        forces.status = step.status;
        if (step.status != rollbem::StepStatus::assists_creepage) break;
    }
    return forces;
}

double free_pitch_rate(const Rolling& left, const Rolling& right, double speed, double radius) {
    const auto creepage = [&](double rate) {
        const rollbem::WheelsetSpeeds speeds{.forward = speed, .pitch_rate = rate};
        return rollbem::creepage_of(left.patch, left.at, speeds, radius).longitudinal +
               rollbem::creepage_of(right.patch, right.at, speeds, radius).longitudinal;
    };
    double rate = -speed / radius, last = 1.001 * rate, before = creepage(last);
    for (int k = 0; k < 10; ++k) {
        const double here = creepage(rate);
        if (here == before) break;
        const double next = rate - here * (rate - last) / (here - before);
        last = rate;
        before = here;
        rate = next;
    }
    return rate;
}

}  // namespace profile
