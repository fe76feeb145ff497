// rollbem_patch: an elliptic contact patch of wheel and rail with Coulomb friction and spin, under a load that varies.
//
// Co-simulation alone.
#include <memory>
#include <utility>

#include <rollbem/adhesion/patch_stability.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/detail/require.hpp>
#include <rollbem/discretisation/patch_mesh.hpp>
#include <rollbem/elasticity/rectangle_kernel.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>
#include <rollbem/normal/patch_pressure.hpp>

#include "contact_variables.hpp"
#include "friction_contact.hpp"
#include "model.hpp"

namespace fmu {

namespace {

using Scalar = double;

const Enumeration mesh_sizes{
    "MeshSize",
    {{"follows_load", "that of the contact; normal_load > 0, changes of a below the distance rolled"},
     {"fixed", "that of the contact under largest_load; the wheel may lift off"}}};

class Patch final : public FrictionContact<rollbem::HertzPatchLoad<Scalar>> {
public:
    explicit Patch(Interface used) : FrictionContact(used) {
        add({.name = "shear_modulus", .value = &shear_modulus_, .unit = "Pa", .description = "G of both bodies"});
        add({.name = "poisson_ratio", .value = &poisson_ratio_, .description = "nu of both bodies"});
        add_radius(wheel_.rolling, "wheel_rolling_radius", "Radius of the wheel, in the plane of rolling");
        add_radius(wheel_.lateral, "wheel_lateral_radius", "Radius of the wheel's profile at the contact");
        add_radius(rail_.rolling, "rail_rolling_radius", "Radius of the rail in the plane of rolling");
        add_radius(rail_.lateral, "rail_lateral_radius", "Radius of the rail's profile at the contact");
        add({.name = "friction_coefficient", .value = &friction_coefficient_, .description = "mu"});
        add({.name = "elements", .value = &elements_, .description = "Number of elements a strip, 1 to 32"});
        add({.name = "strips",
             .value = &strips_,
             .description = "Number of strips along the rolling direction, 1 to 32"});
        add({.name = "mesh_size", .value = &mesh_size_, .description = "What the mesh covers", .items = &mesh_sizes});
        add({.name = "largest_load",
             .value = &largest_load_,
             .unit = "N",
             .description = "The largest normal_load that a fixed mesh can take"});
        add({.name = "initial_state",
             .value = &initial_state_,
             .description = "State at the start",
             .items = &initial_states});
        add_input(
            slip_[0], "longitudinal_slip_velocity", "m/s",
            "Velocity of the wheel relative to the rail along the rolling direction, as rigid bodies, in the middle of "
            "the contact; creepage times rolling_speed");
        add_input(slip_[1], "lateral_slip_velocity", "m/s", "The same across the rolling direction, along y");
        add_input(spin_, "spin_rate", "rad/s",
                  "Angular velocity of the wheel relative to the rail about the normal, from x to y; spin times "
                  "rolling_speed");
        add_input(speed_, "rolling_speed", "m/s", "V, the speed of the contact along the rail; not negative");
        add_input(load_, "normal_load", "N", "N at the end of a step; not negative");
        add_output(&force_.longitudinal, "longitudinal_force", "N",
                   "Force on the wheel; opposes the slip velocity in steady rolling without spin");
        add_output(&force_.lateral, "lateral_force", "N", "The same across the rolling direction");
        add_output(&force_.moment, "spin_moment", "N.m",
                   "Moment on the wheel about the normal through the middle of the contact");
        add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start");
        add_output(&half_length_, "contact_half_length", "m", "a, the semi-axis along x under normal_load");
        add_output(&half_width_, "contact_half_width", "m", "b, the semi-axis along y under normal_load");
        add_output(&sticking_elements_, "sticking_elements", "", "Number of elements that stick");
        add_output(&status_, "status", "", "Status of the last step", &step_statuses);
    }

    void initialise() override {
        for (const auto& [name, count] : {std::pair("elements", elements_), std::pair("strips", strips_)}) {
            require(count >= 1 && count <= 32, name, count, "lie in [1, 32]");
        }
        for (const auto& [name, value] :
             {std::pair("shear_modulus", shear_modulus_), std::pair("largest_load", largest_load_)}) {
            require(rollbem::detail::is_finite(value) && value > 0, name, value, "be positive and finite");
        }
        for (const auto& [name, radius] :
             {std::pair("wheel_rolling_radius", wheel_.rolling), std::pair("wheel_lateral_radius", wheel_.lateral),
              std::pair("rail_rolling_radius", rail_.rolling), std::pair("rail_lateral_radius", rail_.lateral)}) {
            require(!rollbem::detail::is_nan(radius) && radius != 0, name, radius, "be a number other than 0");
        }
        const bool fixed = mesh_size_ == static_cast<int>(MeshLength::fixed);
        require(load_.value >= 0 && (fixed || load_.value > 0), "normal_load", load_.value,
                fixed ? "not be negative" : "be positive where mesh_size is follows_load");
        require(!fixed || load_.value <= largest_load_, "normal_load", load_.value, "be at most largest_load");
        const rollbem::ElasticBody<Scalar> body{.young_modulus = 2 * shear_modulus_ * (1 + poisson_ratio_),
                                                .poisson_ratio = poisson_ratio_};
        // not at normal_load, so that a state can be restored in a contact built under another one
        const rollbem::HertzEllipse<Scalar> ellipse(
            {.load = largest_load_, .radii_1 = wheel_, .radii_2 = rail_, .body_1 = body, .body_2 = body});
        const rollbem::PatchContact<Scalar> contact({.half_length = ellipse.half_length(),
                                                     .half_width = ellipse.half_width(),
                                                     .shear_modulus = shear_modulus_,
                                                     .poisson_ratio = poisson_ratio_});
        const rollbem::PatchMesh<Scalar> mesh = patch_mesh(contact, elements_, strips_);
        const rollbem::NodeDifference scheme{rollbem::Nodes::chebyshev};
        const rollbem::HalfSpace<Scalar> kernel(poisson_ratio_);
        using Hertz = rollbem::HertzPatchLoad<Scalar>;
        begin(
            fixed ? Hertz::fixed(ellipse, contact, mesh) : Hertz::breathing(ellipse, contact, mesh),
            FrictionModel(
                contact, fixed ? rolling_system(mesh, scheme, kernel) : breathing_system(contact, mesh, scheme, kernel),
                judge_stability(patch_parts(mesh, scheme, kernel)),
                rollbem::Friction{friction_coefficient_, hertz_pressures(contact, mesh, largest_load_)}),
            1);
    }

private:
    template <class Value>
    static void require(bool holds, const char* parameter, Value value, const char* rule) {
        rollbem::detail::require(holds, "rollbem_patch", parameter, value, rule);
    }

    void add_radius(Scalar& radius, const char* name, std::string description) {
        add({.name = name,
             .value = &radius,
             .unit = "m",
             .description = std::move(description) + "; negative if concave, 1e9 if flat"});
    }

    void show_size(Scalar load) override {
        const auto axes = hertz_->semi_axes(load);
        half_length_ = axes.half_length;
        half_width_ = axes.half_width;
    }

    Scalar shear_modulus_ = 8e10, poisson_ratio_ = 0.28, friction_coefficient_ = 0.3, largest_load_ = 2e5;
    rollbem::PrincipalRadii<Scalar> wheel_{.rolling = 0.46, .lateral = 1e9}, rail_{.rolling = 1e9, .lateral = 0.3};
    int elements_ = 8, strips_ = 8, mesh_size_ = static_cast<int>(MeshLength::follows_load);
    Scalar half_length_ = 0, half_width_ = 0;
};

}  // namespace

const Identity identity{
    .identifier = "rollbem_patch",
    .description = "Elliptic contact patch with Coulomb friction and spin under a normal load that varies",
    .model_exchange = false,
    .stop_time = 0.01,
    .step_size = 5e-5};

std::unique_ptr<Model> make_model(Interface used) { return std::make_unique<Patch>(used); }

}  // namespace fmu
