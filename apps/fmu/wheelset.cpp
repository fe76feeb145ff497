// rollbem_wheelset: the forces of both rails on a wheelset, by look-up in a contact table and a table of creep forces.
// Forces are steady ones at the inputs of the end of a step, without memory; the FMU is for co-simulation alone.
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include <Eigen/Core>

#include <rollbem/vehicle/contact_table.hpp>

#include "model.hpp"
#include "shared_table.hpp"

namespace fmu {

namespace {

using rollbem::Status;
using rollbem::WheelForces;

constexpr Eigen::Index components = 6, motions = 8;  // of a force, of inputs besides loads, in the order of WheelForces

class Wheelset final : public Model {
public:
    Wheelset() {
        add_parameter(&friction_coefficient_, "friction_coefficient", "", "Coefficient of friction mu")
            .is_not_negative();
        add_parameter(&contact_table_, "contact_table_file", "",
                      "Path of a contact table made by contact_table; empty: the table packed with this FMU, S1002 on "
                      "60E1 canted 1:40, gauge 1435 mm");
        add_parameter(&creep_table_, "creep_table_file", "",
                      "Path of a table (.bin) made by creep_table; empty: the table packed with this FMU");
        // as in WheelForces::Input
        add_input(inputs_[0], "lateral_shift", "m", "Position y of the middle of the axle, to the right");
        add_input(inputs_[1], "yaw", "rad", "Yaw angle psi about z, which points down");
        add_input(inputs_[2], "rolling_speed", "m/s", "Speed V along the track; not negative").is_not_negative();
        add_input(inputs_[3], "pitch_rate", "rad/s", "Angular velocity about the axle, negative when rolling forward");
        add_input(inputs_[4], "lateral_velocity", "m/s", "Velocity of the middle of the axle along y");
        add_input(inputs_[5], "vertical_velocity", "m/s",
                  "Velocity along z; the rate of height where the rails guide the wheelset");
        add_input(inputs_[6], "roll_rate", "rad/s",
                  "Angular velocity about x; the rate of roll where the rails guide the wheelset");
        add_input(inputs_[7], "yaw_rate", "rad/s", "Angular velocity about z");
        add_input(inputs_[8], "left_load", "N", "Vertical load of the left wheel; not negative").is_not_negative();
        add_input(inputs_[9], "right_load", "N", "Vertical load of the right wheel; not negative").is_not_negative();
        constexpr std::array names{"longitudinal_force", "lateral_force", "vertical_force",
                                   "roll_moment",        "pitch_moment",  "yaw_moment"};
        constexpr std::array on{"both wheels", "the left wheel", "the right wheel"};
        constexpr std::array prefixes{"", "left_", "right_"};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < names.size(); ++i) {
                const std::string of = i < 3 ? "Force of the rail on " : "Moment of the rail on ";
                add_output(&forces_[static_cast<Eigen::Index>(names.size() * k + i)],
                           std::string(prefixes[k]) + names[i], i < 3 ? "N" : "N.m",
                           of + on[k] + (i < 3 ? ", along " : " about the middle of the axle, about ") + "xyz"[i % 3]);
            }
        }
        add_output(&height_, "height", "m", "Height z_ws of a wheelset that follows its rails, positive down");
        add_output(&roll_, "roll", "rad", "Roll of that wheelset about x");
        add_slip_work();
        add_status();
    }

    double partial(Eigen::Index output, Eigen::Index input) override {
        if (output >= forces_.size()) throw NoDerivative{};
        return by_(output, input);
    }

    void archive(Archive& archive) override {
        archive.keep(by_);
        archive.keep(heat_);
    }

private:
    std::optional<Status> build() override {
        require_inputs();
        contacts_ = shared_table<rollbem::ContactTable>(
            "contact_table_file", contact_table_.empty() ? resources + "/s1002_60e1.contact" : contact_table_);
        creep_ = shared_table<rollbem::CreepForceTable>(
            "creep_table_file", creep_table_.empty() ? resources + "/steel.creep" : creep_table_);
        const Status status = look_up(0);
        require(status == Status::ok, "status of the tables at the first inputs", name(status), "be ok");
        return status;
    }

    Status advance(double duration) override {
        const double before = heat_;
        const Status status = look_up(duration);
        if (status == Status::ok) slip_work_ += duration * (before + heat_) / 2;
        return status;
    }

    Status look_up(double duration) {
        const auto x = after(duration, inputs_);
        if (x[WheelForces::forward] < 0) return Status::invalid_step;
        const std::array loads{x[motions], x[motions + 1]};
        std::array<WheelForces, 2> wheels;
        for (std::size_t k = 0; k < 2; ++k) {
            wheels[k] = contacts_->look_up(*creep_, k == 0 ? rollbem::WheelsetSide::left : rollbem::WheelsetSide::right,
                                           {.lateral = x[0], .yaw = x[1]}, {x[2], x[3], x[4], x[5], x[6], x[7]},
                                           loads[k], friction_coefficient_);
            if (wheels[k].status != Status::ok) return wheels[k].status;
        }
        const bool both = loads[0] > 0 && loads[1] > 0;  // a wheel that is lifted has no height
        const auto rails = both ? contacts_->on_rails(x[0], x[1], loads) : contacts_->on_rails(x[0], x[1]);
        height_ = rails.height;
        roll_ = rails.roll;
        heat_ = wheels[0].heat + wheels[1].heat;
        for (Eigen::Index k = 0; k < 2; ++k) {
            const WheelForces& wheel = wheels[static_cast<std::size_t>(k)];
            forces_.segment<components>(components * (k + 1)) = wheel.force;
            by_.block<components, motions>(components * (k + 1), 0) = wheel.tangent.leftCols<motions>();
            by_.block<components, 1>(components * (k + 1), motions + k) = wheel.derivative(WheelForces::load);
        }
        forces_.head<components>() = wheels[0].force + wheels[1].force;
        by_.topRows<components>() = by_.middleRows<components>(components) + by_.bottomRows<components>();
        return Status::ok;
    }

    double friction_coefficient_ = 0.3;
    std::string contact_table_, creep_table_;
    std::array<Input, motions + 2> inputs_{{{0}, {0}, {20}, {-20 / 0.46}, {0}, {0}, {0}, {0}, {1e5}, {1e5}}};
    Eigen::Matrix<double, 3 * components, 1> forces_ = decltype(forces_)::Zero();  // of both wheels, left, right
    double height_ = 0, roll_ = 0;

    std::shared_ptr<const rollbem::ContactTable> contacts_;
    std::shared_ptr<const rollbem::CreepForceTable> creep_;
    Eigen::Matrix<double, 3 * components, motions + 2> by_ = decltype(by_)::Zero();  // derivatives of forces by inputs
    double heat_ = 0;                                                                // at the end of the last step [W]
};

}  // namespace

const Identity identity{.identifier = "rollbem_wheelset",
                        .description = "Contact forces of a wheelset on real rails, by look-up",
                        .stop_time = 1,
                        .step_size = 1e-3};

std::unique_ptr<Model> make_model() { return std::make_unique<Wheelset>(); }

}  // namespace fmu
