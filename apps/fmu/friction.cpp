// rollbem_friction: a contact with Coulomb friction in both directions under a load that varies, on elements.
//
// Co-simulation alone: stick and slip change element by element. A step of duration h rolls by V h and shifts the wheel
// by s h, both at a constant rate, so that V = 0 is a rigid shift; the load varies linearly over the step.
#include <cmath>
#include <memory>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/normal/hertz_load.hpp>

#include "contact_variables.hpp"
#include "friction_contact.hpp"
#include "model.hpp"

namespace fmu {

namespace {

using Scalar = double;

enum MeshName { cosine_elements = 1, uniform_elements };

const Enumeration meshes{"Mesh",
                         {{"cosine", "second order where the mesh follows the load"}, {"uniform", "for a fixed mesh"}}};

const Enumeration mesh_lengths{
    "MeshLength",
    {{"follows_load", "that of the contact; plane kernel, normal_load > 0, changes of a below the distance rolled"},
     {"fixed", "that of the contact under largest_load; the wheel may lift off"}}};

class Friction final : public FrictionContact<rollbem::HertzLoad<Scalar>> {
public:
    explicit Friction(Interface used) : FrictionContact(used) {
        parameters_.add_to(*this);
        add_parameter(&friction_coefficient_, "friction_coefficient", "", "mu").min = 0;
        add_parameter(&elements_, "elements", "", "Number of elements, 1 to 1000").lies_in(1, 1000);
        add_parameter(&mesh_, "mesh", "", "Spacing of the elements", &meshes);
        add_parameter(&mesh_length_, "mesh_length", "", "What the mesh covers", &mesh_lengths);
        add_parameter(&largest_load_, "largest_load", "N", "The largest normal_load that a fixed mesh can take");
        add_parameter(&initial_state_, "initial_state", "", "State at the start", &initial_states);
        add_input(
            slip_[0], "longitudinal_slip_velocity", "m/s",
            "Velocity of the wheel relative to the rail along the rolling direction, as rigid bodies; creepage times "
            "rolling_speed");
        add_input(slip_[1], "lateral_slip_velocity", "m/s", "The same across the rolling direction");
        add_input(speed_, "rolling_speed", "m/s", "V, the speed of the contact along the rail; not negative").min = 0;
        add_input(load_, "normal_load", "N", "N over the width 2b at the end of a step; not negative").min = 0;
        add_friction_factor();
        add_output(&force_.longitudinal, "longitudinal_force", "N",
                   "Force on the wheel, over the width 2b; opposes the slip velocity in steady rolling");
        add_output(&force_.lateral, "lateral_force", "N", "The same across the rolling direction");
        add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start");
        add_output(&half_length_, "contact_half_length", "m", "a under normal_load").min = 0;
        add_output(&sticking_elements_, "sticking_elements", "", "Number of elements that stick").min = 0;
        add_output(&status_, "status", "", "Status of the last step", &step_statuses);
    }

    void initialise() override {
        const rollbem::HertzLine<Scalar> line = parameters_.line();
        require(elements_ >= 1 && elements_ <= 1000, "elements", elements_, "lie in [1, 1000]");
        const bool fixed = mesh_length_ == fixed_mesh;
        const rollbem::LineModel model = parameters_.model();
        require(fixed || model == rollbem::LineModel::plane, "mesh_length", mesh_length_,
                "be 2 (fixed) where kernel is strip, which knows one length only");
        require(load_.value >= 0 && (fixed || load_.value > 0), "normal_load", load_.value,
                fixed ? "not be negative" : "be positive where mesh_length is follows_load");

        Scalar length = line.half_length();
        if (fixed) {
            require(rollbem::detail::is_finite(largest_load_) && largest_load_ > 0, "largest_load", largest_load_,
                    "be positive and finite");
            require(load_.value <= largest_load_, "normal_load", load_.value, "be at most largest_load");
            length *= std::sqrt(per_width(largest_load_) / line.load_per_width());
        }
        const bool cosine = mesh_ == cosine_elements;
        const rollbem::Mesh<Scalar> mesh =
            cosine ? rollbem::cosine_mesh<Scalar>(elements_) : rollbem::uniform_mesh<Scalar>(elements_);
        const rollbem::NodeDifference scheme{cosine ? rollbem::Nodes::chebyshev : rollbem::Nodes::centres};
        const auto hertz = fixed ? rollbem::HertzLoad<Scalar>::fixed(line, mesh, length)
                                 : rollbem::HertzLoad<Scalar>::breathing(line, mesh);
        const rollbem::Contact<Scalar> contact = parameters_.contact_of(length);
        using Kernel = rollbem::AnyKernel<Scalar>;
        const rollbem::ElementSystem system(rolling_system(mesh, scheme, Kernel::longitudinal(model, contact)),
                                            rolling_system(mesh, scheme, Kernel::lateral(model, contact)));
        const Scalar first_load = hertz.breathes() ? parameters_.nominal_load : largest_load_;
        begin(hertz,
              FrictionModel(contact, system, judge_stability(system),
                            rollbem::Friction{friction_coefficient_, hertz.at(per_width(first_load)).normal_pressure}),
              2 * parameters_.half_width);
    }

private:
    void show_size(Scalar load) override { half_length_ = hertz_->half_length(per_width(load)); }

    Scalar per_width(Scalar load) const { return load / (2 * parameters_.half_width); }

    ContactParameters parameters_;
    Scalar friction_coefficient_ = 0.3;
    int elements_ = 40;
    int mesh_ = cosine_elements;
    int mesh_length_ = mesh_follows_load;
    Scalar largest_load_ = 2e5;
    Scalar half_length_ = 0;
};

}  // namespace

const Identity identity{.identifier = "rollbem_friction",
                        .description =
                            "Tangential rolling contact with Coulomb friction in both directions under a "
                            "normal load that varies",
                        .model_exchange = false,
                        .stop_time = 0.01,
                        .step_size = 2.5e-5};

std::unique_ptr<Model> make_model(Interface used) { return std::make_unique<Friction>(used); }

}  // namespace fmu
