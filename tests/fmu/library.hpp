// The library as a C++ program calls it, for comparison with the FMUs.
#pragma once

#include <utility>

#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>

namespace library {

constexpr double shear_modulus = 8e10, poisson_ratio = 0.28;
constexpr double friction_coefficient = 0.3, nominal_load = 1e5, largest_load = 2e5;

/// Steps of a contact with friction under Hertz's pressure, from rest.
class Friction {
public:
    using Hertz = rollbem::HertzPatchLoad<double>;
    using Model = rollbem::FrictionModel<rollbem::ConstantFriction<>, 2>;
    using Step = Model::Step;

    /// The first load is nominal_load.
    Friction(Hertz hertz, Model model)
        : hertz_(std::move(hertz)),
          load_(hertz_.at(nominal_load)),
          model_(std::move(model)),
          workspace_(model_.workspace()),
          now_(model_.at_rest()) {
        now_.normal_pressure = load_.normal_pressure;
        now_.half_length = load_.half_length;
        now_.half_width = load_.half_width;
        next_ = now_;
    }

    /// `duration` [s], slip velocities [m/s] and spin [rad/s], rolling speed [m/s], load [N] and factor of mu at the
    /// end.
    Step step(double duration, const rollbem::Creepage<double>& slip, double speed, double load, double factor = 1) {
        set(load, factor);
        return keep(model_.advance(
            now_,
            {duration * speed,
             Model::Motion::shift({duration * slip.longitudinal, duration * slip.lateral, duration * slip.spin}),
             load_},
            next_, workspace_));
    }
    Step steady(const rollbem::Creepage<double>& slip, double speed, double load, double factor) {
        set(load, factor);
        const auto& [longitudinal, lateral, spin] = slip;
        return keep(model_.steady(
            now_, {.motion = {longitudinal / speed, lateral / speed, spin / speed}, .load = load_}, next_, workspace_));
    }

private:
    void set(double load, double factor) {
        hertz_.set(load, load_);
        load_.normal_pressure *= factor;
        load_.pressure_rate *= factor;
    }
    Step keep(const Step& step) {
        if (step.status == rollbem::Status::ok) std::swap(now_, next_);
        return step;
    }

    Hertz hertz_;
    rollbem::NormalLoad<double> load_;
    Model model_;
    Model::Workspace workspace_;
    Model::State now_, next_;
};

/// The ellipse of rollbem_patch at its start values under largest_load.
inline rollbem::HertzEllipse<double> ellipse() {
    const rollbem::ElasticBody<double> body{2 * shear_modulus * (1 + poisson_ratio), poisson_ratio};
    return rollbem::HertzEllipse<double>({.load = largest_load,
                                          .radii_1 = {.rolling = 0.46, .lateral = 1e9},
                                          .radii_2 = {.rolling = 1e9, .lateral = 0.3},
                                          .body_1 = body,
                                          .body_2 = body});
}

/// rollbem_patch at its start values, with 8 x 8 elements.
inline Friction patch(bool fixed) {
    using Hertz = Friction::Hertz;
    const rollbem::HertzEllipse<double> ellipse = library::ellipse();
    const rollbem::PatchContact<double> contact = ellipse.contact();
    const rollbem::PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
    const rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
    const rollbem::HalfSpace<double> kernel(poisson_ratio);
    return {fixed ? Hertz::fixed(ellipse, contact, mesh) : Hertz::breathing(ellipse, contact, mesh),
            {contact,
             fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
             rollbem::unchecked,
             {friction_coefficient, hertz_pressures(contact, mesh, largest_load)}}};
}

}  // namespace library
