// What FMUs have in common.
#include "contact_variables.hpp"

#include <numbers>
#include <string>

#include <rollbem/detail/require.hpp>

namespace fmu {

namespace {

const Enumeration half_length_sources{"HalfLengthFrom",
                                      {{"half_length", "the parameter half_length"},
                                       {"nominal_load", "by Hertz from nominal_load, combined_radius and material"}}};

const Enumeration kernels{"Kernel", {{"plane", "much wider than long"}, {"strip", "of finite width"}}};

/// None yet, then all of rollbem::StepStatus, counted from 0; name() returns not_finite for every value beyond them.
Enumeration enumerate_statuses() {
    using rollbem::StepStatus;
    Enumeration result{"StepStatus", {{"none", "nothing has been computed yet"}}, 0};
    const std::string beyond = name(StepStatus::not_finite);
    for (int i = 0;; ++i) {
        const std::string item = name(static_cast<StepStatus>(i));
        if (item == beyond && i != static_cast<int>(StepStatus::not_finite)) return result;
        result.items.push_back({item});
    }
}

}  // namespace

const Enumeration initial_states{"InitialState",
                                 {{"rest", "no traction"}, {"steady", "steady rolling at the first inputs"}}};

const Enumeration step_statuses = enumerate_statuses();

void ContactParameters::add_to(Model& model) {
    model.add_parameter(&shear_modulus, "shear_modulus", "Pa", "G of both bodies");
    model.add_parameter(&poisson_ratio, "poisson_ratio", "", "nu of both bodies").lies_in(0, 0.5);
    model.add_parameter(&half_width, "half_width", "m", "b: the contact is 2b wide");
    model.add_parameter(&half_length_from, "half_length_from", "", "Where the half-length a comes from",
                        &half_length_sources);
    model.add_parameter(&half_length, "half_length", "m",
                        "a, in the rolling direction, under nominal_load; used where half_length_from is half_length");
    model.add_parameter(&combined_radius, "combined_radius", "m",
                        "R of 1/R = 1/R_wheel + 1/R_rail; used where half_length_from is nominal_load");
    model.add_parameter(&nominal_load, "nominal_load", "N",
                        "Normal force under which the contact has its half-length a");
    model.add_parameter(&kernel, "kernel", "", "Relation of displacements to tractions", &kernels);
}

rollbem::HertzLine<double> ContactParameters::line() const {
    contact_of(half_length_is_given() ? half_length : half_width);  // checks what is used below
    rollbem::detail::require(rollbem::detail::is_finite(nominal_load) && nominal_load > 0, "HertzLine", "nominal_load",
                             nominal_load, "be positive and finite");
    const rollbem::ElasticBody<double> body{.young_modulus = 2 * shear_modulus * (1 + poisson_ratio),
                                            .poisson_ratio = poisson_ratio};
    const double load_per_width = nominal_load / (2 * half_width);
    // from a^2 = 4 P R/(pi E*), where E* = G/(1 - nu) of two equal bodies
    const double radius =
        std::numbers::pi * shear_modulus / (1 - poisson_ratio) * half_length * half_length / (4 * load_per_width);
    return rollbem::HertzLine<double>({.load_per_width = load_per_width,
                                       .combined_radius = half_length_is_given() ? radius : combined_radius,
                                       .body_1 = body,
                                       .body_2 = body});
}

rollbem::Contact<double> ContactParameters::contact() const {
    return half_length_is_given() ? contact_of(half_length) : contact_of(line().half_length());
}

rollbem::Contact<double> ContactParameters::contact_of(double length) const {
    const rollbem::Contact<double> contact({.half_length = length,
                                            .half_width = half_width,
                                            .shear_modulus = shear_modulus,
                                            .poisson_ratio = poisson_ratio});
    rollbem::detail::require(rollbem::detail::is_finite(half_width), "Contact", "half_width", half_width, "be finite");
    return contact;
}

bool ContactParameters::half_length_is_given() const { return half_length_from == half_length_given; }

Outcome outcome_of(rollbem::StepStatus status) {
    if (status == rollbem::StepStatus::ok) return Outcome::ok;
    return status == rollbem::StepStatus::not_finite ? Outcome::not_a_number : Outcome::refused;
}

}  // namespace fmu
