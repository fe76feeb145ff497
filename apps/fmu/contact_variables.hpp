// What FMUs have in common: parameters of a line contact, and how the status of a step is reported.
#pragma once

#include <rollbem/elasticity/any_kernel.hpp>
#include <rollbem/normal/hertz.hpp>
#include <rollbem/scene/contact.hpp>
#include <rollbem/status.hpp>

#include "model.hpp"

namespace fmu {

/// Where the half-length comes from.
enum HalfLengthFrom { half_length_given = 1, of_nominal_load };

/// Which line kernel.
enum KernelName { plane_kernel = 1, strip_kernel };

/// Where a simulation begins.
enum InitialState { at_rest = 1, in_steady_rolling };

/// Sizes and material of a contact, with the library's names, as its messages use them.
struct ContactParameters {
    double shear_modulus = 8e10;  // steel
    double poisson_ratio = 0.28;
    double half_width = 0.05;
    int half_length_from = half_length_given;
    double half_length = 0.005;
    double combined_radius = 0.46;
    double nominal_load = 1e5;
    int kernel = plane_kernel;

    void add_to(Model& model);

    rollbem::LineModel model() const {
        return kernel == plane_kernel ? rollbem::LineModel::plane : rollbem::LineModel::strip;
    }

    /// Hertz's line contact under the nominal load, and the contact that results; a given half-length determines the
    /// radius. Both throw std::invalid_argument, naming the parameter that is out of range.
    rollbem::HertzLine<double> line() const;
    rollbem::Contact<double> contact() const;
    /// The same with another half-length [m].
    rollbem::Contact<double> contact_of(double length) const;

private:
    bool half_length_is_given() const;
};

extern const Enumeration initial_states;

/// The statuses of a step: 0 none, 1 ok.
extern const Enumeration step_statuses;

/// The value of a variable of that enumeration.
inline int value_of(rollbem::StepStatus status) { return static_cast<int>(status) + 1; }

Outcome outcome_of(rollbem::StepStatus status);

}  // namespace fmu
