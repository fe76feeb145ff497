// The library as a C++ program calls it, for comparison with the FMUs.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include <rollbem/adhesion/transient.hpp>
#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>
#include <rollbem/spectral/chebyshev.hpp>

namespace library {

constexpr double half_length = 5e-3, half_width = 0.05, shear_modulus = 8e10, poisson_ratio = 0.28;
constexpr double friction_coefficient = 0.3, nominal_load = 1e5, largest_load = 2e5;

/// Steps of a contact with friction under Hertz's pressure, from rest.
template <class Hertz>
class Friction {
public:
    using Model = rollbem::FrictionModel<rollbem::ConstantFriction<>, 2>;
    using Step = Model::Step;

    /// Loads are divided by `load_width` for `hertz`; the first one is nominal_load.
    Friction(Hertz hertz, Model model, double load_width)
        : hertz_(std::move(hertz)),
          load_width_(load_width),
          load_(hertz_.at(nominal_load / load_width)),
          model_(std::move(model)),
          workspace_(model_.workspace()),
          now_(model_.at_rest()) {
        now_.normal_pressure = load_.normal_pressure;
        now_.half_length = load_.half_length;
        if (load_.half_width > 0) now_.half_width = load_.half_width;
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
        hertz_.set(load / load_width_, load_);
        load_.normal_pressure *= factor;
        load_.pressure_rate *= factor;
    }
    Step keep(const Step& step) {
        if (step.status == rollbem::Status::ok) std::swap(now_, next_);
        return step;
    }

    Hertz hertz_;
    double load_width_;
    rollbem::NormalLoad<double> load_;
    Model model_;
    Model::Workspace workspace_;
    Model::State now_, next_;
};

/// rollbem_friction at its start values, with 40 elements; a fixed mesh is uniform.
inline Friction<rollbem::HertzLoad<double>> line(bool fixed) {
    using Hertz = rollbem::HertzLoad<double>;
    const rollbem::ElasticBody<double> body{2 * shear_modulus * (1 + poisson_ratio), poisson_ratio};
    const double load_per_width = nominal_load / (2 * half_width);
    const rollbem::HertzLine<double> line({.load_per_width = load_per_width,
                                           .combined_radius = std::numbers::pi * shear_modulus / (1 - poisson_ratio) *
                                                              half_length * half_length / (4 * load_per_width),
                                           .body_1 = body,
                                           .body_2 = body});
    const double first_load = (fixed ? largest_load : nominal_load) / (2 * half_width);
    const double length = line.half_length() * (fixed ? std::sqrt(first_load / line.load_per_width()) : 1);
    const rollbem::Mesh<double> mesh = fixed ? rollbem::uniform_mesh<double>(40) : rollbem::cosine_mesh<double>(40);
    const Hertz hertz = fixed ? Hertz::fixed(line, mesh, length) : Hertz::breathing(line, mesh);
    const rollbem::Contact<double> contact({.half_length = length,
                                            .half_width = half_width,
                                            .shear_modulus = shear_modulus,
                                            .poisson_ratio = poisson_ratio});
    const rollbem::NodeDifference scheme{fixed ? rollbem::Nodes::centres : rollbem::Nodes::chebyshev};
    using Kernel = rollbem::PlaneKernel<double>;
    return {hertz,
            {contact,
             {rolling_system(mesh, scheme, Kernel::longitudinal(contact)),
              rolling_system(mesh, scheme, Kernel::lateral(contact))},
             rollbem::unchecked,
             {friction_coefficient, hertz.at(first_load).normal_pressure}},
            2 * half_width};
}

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
inline Friction<rollbem::HertzPatchLoad<double>> patch(bool fixed) {
    using Hertz = rollbem::HertzPatchLoad<double>;
    const rollbem::HertzEllipse<double> ellipse = library::ellipse();
    const rollbem::PatchContact<double> contact = ellipse.contact();
    const rollbem::PatchMesh<double> mesh = patch_mesh(contact, 8, 8);
    const rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
    const rollbem::HalfSpace<double> kernel(poisson_ratio);
    return {fixed ? Hertz::fixed(ellipse, contact, mesh) : Hertz::breathing(ellipse, contact, mesh),
            {contact,
             fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
             rollbem::unchecked,
             {friction_coefficient, hertz_pressures(contact, mesh, largest_load)}},
            1};
}

/// The steps of rollbem_adhesion at its start values, with 12 states and steps of equal length.
class Adhesion {
public:
    explicit Adhesion(double distance)
        : contact_({.half_length = half_length,
                    .half_width = half_width,
                    .shear_modulus = shear_modulus,
                    .poisson_ratio = poisson_ratio}),
          model_(contact_,
                 rolling_system(rollbem::Chebyshev{.states = 12}, rollbem::PlaneKernel<double>::longitudinal(contact_)),
                 rollbem::unchecked, rollbem::Integrator::matrix_exponential),
          distance_(distance),
          workspace_(model_.workspace()),
          now_(model_.at_rest()),
          next_(now_) {}

    double step(double shift) {
        const auto motion = rollbem::RigidMotion<double>::shift(shift);
        const double force = model_.advance(now_, {distance_, motion}, next_, workspace_).force;
        std::swap(now_, next_);
        return force;
    }

private:
    rollbem::Contact<double> contact_;
    rollbem::AdhesionModel<> model_;
    double distance_;
    rollbem::AdhesionWorkspace<> workspace_;
    rollbem::AdhesionState<> now_, next_;
};

}  // namespace library
