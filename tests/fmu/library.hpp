// The library as a C++ program calls it, for comparison with the FMUs.
#pragma once

#include <rollbem/adhesion/transient.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/friction/transient.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/spectral/chebyshev.hpp>

namespace library {

constexpr double half_length = 5e-3, half_width = 0.05, shear_modulus = 8e10, poisson_ratio = 0.28;
constexpr double friction_coefficient = 0.3, nominal_load = 1e5, largest_load = 2e5;

/// The steps of rollbem_friction at its start values, with 40 elements.
class Friction {
public:
    using Step = rollbem::FrictionStep<2>;

    explicit Friction(bool fixed) : Friction(line(), fixed) {}

    /// `duration` [s], slip velocities and rolling speed [m/s], load at the end [N].
    Step step(double duration, double longitudinal, double lateral, double speed, double load) {
        hertz_.set(load / (2 * half_width), load_);
        const Step result = model_.advance(
            now_, duration * speed,
            rollbem::RigidMotion<rollbem::Creepage<double>>::shift({duration * longitudinal, duration * lateral}),
            load_, next_, workspace_);
        if (result.status == rollbem::StepStatus::ok) std::swap(now_, next_);
        return result;
    }

private:
    using Model = rollbem::FrictionModel<rollbem::ConstantFriction<>, 2>;

    static rollbem::HertzLine<double> line() {
        const rollbem::ElasticBody<double> body{2 * shear_modulus * (1 + poisson_ratio), poisson_ratio};
        const double load_per_width = nominal_load / (2 * half_width);
        return rollbem::HertzLine<double>({.load_per_width = load_per_width,
                                           .combined_radius = std::numbers::pi * shear_modulus / (1 - poisson_ratio) *
                                                              half_length * half_length / (4 * load_per_width),
                                           .body_1 = body,
                                           .body_2 = body});
    }

    static rollbem::HertzLoad<double> hertz_of(const rollbem::HertzLine<double>& line, bool fixed, double length) {
        const rollbem::Mesh<double> mesh = fixed ? rollbem::uniform_mesh<double>(40) : rollbem::cosine_mesh<double>(40);
        return fixed ? rollbem::HertzLoad<double>::fixed(line, mesh, length)
                     : rollbem::HertzLoad<double>::breathing(line, mesh);
    }

    static Model model_of(bool fixed, double length, const rollbem::NormalLoad<double>& load) {
        const rollbem::Contact<double> contact({.half_length = length,
                                                .half_width = half_width,
                                                .shear_modulus = shear_modulus,
                                                .poisson_ratio = poisson_ratio});
        const rollbem::Mesh<double> mesh = fixed ? rollbem::uniform_mesh<double>(40) : rollbem::cosine_mesh<double>(40);
        const rollbem::NodeDifference scheme{fixed ? rollbem::Nodes::centres : rollbem::Nodes::chebyshev};
        using Kernel = rollbem::PlaneKernel<double>;
        return Model(contact,
                     {rolling_system(mesh, scheme, Kernel::longitudinal(contact)),
                      rolling_system(mesh, scheme, Kernel::lateral(contact))},
                     rollbem::unchecked, {friction_coefficient, load.normal_pressure});
    }

    static double length_of(const rollbem::HertzLine<double>& line, bool fixed) {
        if (!fixed) return line.half_length();
        return line.half_length() * std::sqrt(largest_load / (2 * half_width) / line.load_per_width());
    }

    Friction(const rollbem::HertzLine<double>& line, bool fixed)
        : hertz_(hertz_of(line, fixed, length_of(line, fixed))),
          load_(hertz_.at((fixed ? largest_load : nominal_load) / (2 * half_width))),
          model_(model_of(fixed, length_of(line, fixed), load_)),
          workspace_(model_.workspace()),
          now_(model_.at_rest()) {
        hertz_.set(nominal_load / (2 * half_width), load_);
        now_.normal_pressure = load_.normal_pressure;
        now_.half_length = load_.half_length;
        next_ = now_;
    }

    rollbem::HertzLoad<double> hertz_;
    rollbem::NormalLoad<double> load_;
    Model model_;
    Model::Workspace workspace_;
    Model::State now_, next_;
};

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
        const double force = model_.advance(now_, distance_, motion, next_, workspace_).force;
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
