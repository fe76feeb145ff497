// rollbem_wheelset: the forces of both rails on a wheelset, by look-up in a contact table and a table of creep forces.
// Forces are steady ones at the inputs of the end of a step, without memory; the FMU is for co-simulation alone.
#include <array>
#include <cstddef>
#include <memory>
#include <string>

#include <rollbem/detail/finite.hpp>
#include <rollbem/vehicle/contact_table.hpp>

#include "model.hpp"
#include "shared_table.hpp"

namespace fmu {

namespace {

using rollbem::Status;
using rollbem::WheelForces;

constexpr std::array sides{rollbem::WheelsetSide::left, rollbem::WheelsetSide::right};
constexpr Eigen::Index components = 6;

class Wheelset final : public Model {
public:
    Wheelset() {
        add_parameter(&friction_coefficient_, "friction_coefficient", "", "Coefficient of friction mu").min = 0;
        add_parameter(&contact_table_, "contact_table_file", "",
                      "Path of a contact table made by contact_table; empty: the table packed with this FMU, S1002 on "
                      "60E1 canted 1:40, gauge 1435 mm");
        add_parameter(&creep_table_, "creep_table_file", "",
                      "Path of a table (.bin) made by creep_table; empty: the table packed with this FMU");
        // as in WheelForces::Input
        add_input(motion_[0], "lateral_shift", "m", "Position y of the middle of the axle, to the right");
        add_input(motion_[1], "yaw", "rad", "Yaw angle psi about z, which points down");
        add_input(motion_[2], "rolling_speed", "m/s", "Speed V along the track; not negative").min = 0;
        add_input(motion_[3], "pitch_rate", "rad/s", "Angular velocity about the axle, negative when rolling forward");
        add_input(motion_[4], "lateral_velocity", "m/s", "Velocity of the middle of the axle along y");
        add_input(motion_[5], "vertical_velocity", "m/s",
                  "Velocity along z; the rate of height where the rails guide the wheelset");
        add_input(motion_[6], "roll_rate", "rad/s",
                  "Angular velocity about x; the rate of roll where the rails guide the wheelset");
        add_input(motion_[7], "yaw_rate", "rad/s", "Angular velocity about z");
        add_input(loads_[0], "left_load", "N", "Vertical load of the left wheel; not negative").min = 0;
        add_input(loads_[1], "right_load", "N", "Vertical load of the right wheel; not negative").min = 0;
        constexpr std::array names{"longitudinal_force", "lateral_force", "vertical_force",
                                   "roll_moment",        "pitch_moment",  "yaw_moment"};
        constexpr std::array on{"both wheels", "the left wheel", "the right wheel"};
        constexpr std::array prefixes{"", "left_", "right_"};
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t i = 0; i < names.size(); ++i) {
                const std::string of = i < 3 ? "Force of the rail on " : "Moment of the rail on ";
                add_output(&forces_[k][Eigen::Index(i)], std::string(prefixes[k]) + names[i], i < 3 ? "N" : "N.m",
                           of + on[k] + (i < 3 ? ", along " : " about the middle of the axle, about ") + "xyz"[i % 3]);
            }
        }
        add_output(&height_, "height", "m", "Height z_ws of a wheelset that follows its rails, positive down");
        add_output(&roll_, "roll", "rad", "Roll of that wheelset about x");
        add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start");
        add_output(&status_, "status", "", "Status of the last step", &step_statuses);
    }

    void initialise() override {
        require(rollbem::detail::is_finite(friction_coefficient_) && friction_coefficient_ >= 0, "friction_coefficient",
                friction_coefficient_, "be finite and not negative");
        require_finite_inputs();
        contacts_ = shared_table<rollbem::ContactTable>(
            "contact_table_file", contact_table_.empty() ? resources + "/s1002_60e1.contact" : contact_table_);
        creep_ = shared_table<rollbem::CreepForceTable>(
            "creep_table_file", creep_table_.empty() ? resources + "/steel.creep" : creep_table_);
        const Status status = look_up(0);
        require(status == Status::ok, "status of the tables at the first inputs", name(status), "be ok");
        slip_work_ = 0;
        status_ = value_of(status);
    }

    Outcome step(double duration) override {
        const double before = heat_;
        const Status status = look_up(duration);
        status_ = value_of(status);
        if (status == Status::ok) slip_work_ += duration * (before + heat_) / 2;
        return outcome_of(status);
    }

    double partial(const Variable& unknown, const Variable& known) override {
        const auto column_of = [&](std::size_t side) -> Eigen::Index {
            if (&known.real() == &loads_[side].value) return WheelForces::load;
            for (std::size_t i = 0; i < motion_.size(); ++i) {
                if (&known.real() == &motion_[i].value) return static_cast<Eigen::Index>(i);
            }
            return -1;
        };
        for (std::size_t k = 0; k < 3; ++k) {
            for (Eigen::Index row = 0; row < components; ++row) {
                if (&unknown.real() != &forces_[k][row] || known.causality != Causality::input) continue;
                double sum = 0;
                for (std::size_t side = 0; side < 2; ++side) {
                    const Eigen::Index column = column_of(side);
                    if ((k == 0 || k == side + 1) && column >= 0) sum += tangents_[side](row, column);
                }
                return sum;
            }
        }
        throw NoDerivative(unknown, known, ": the forces have some by the inputs");
    }

    void archive(Archive& archive) override {
        for (auto& tangent : tangents_) archive.keep(tangent);
        archive.keep(heat_);
    }

private:
    using Force = Eigen::Matrix<double, components, 1>;

    Status look_up(double duration) {
        std::array<double, 8> at{};
        for (std::size_t i = 0; i < at.size(); ++i) at[i] = motion_[i].after(duration);
        const auto [lateral, yaw, forward, pitch_rate, across, down, roll_rate, yaw_rate] = at;
        if (forward < 0) return Status::invalid_step;
        std::array<WheelForces, 2> wheels;
        for (std::size_t k = 0; k < 2; ++k) {
            wheels[k] = contacts_->look_up(*creep_, sides[k], {.lateral = lateral, .yaw = yaw},
                                           {forward, pitch_rate, across, down, roll_rate, yaw_rate},
                                           loads_[k].after(duration), friction_coefficient_);
            if (wheels[k].status != Status::ok) return wheels[k].status;
        }
        const std::array loads{loads_[0].after(duration), loads_[1].after(duration)};
        const bool both = loads[0] > 0 && loads[1] > 0;  // a wheel that is lifted has no height
        const auto rails = both ? contacts_->on_rails(lateral, yaw, loads) : contacts_->on_rails(lateral, yaw);
        height_ = rails.height;
        roll_ = rails.roll;
        heat_ = wheels[0].heat + wheels[1].heat;
        forces_[0] = wheels[0].force + wheels[1].force;
        for (std::size_t k = 0; k < 2; ++k) {
            forces_[k + 1] = wheels[k].force;
            tangents_[k] = wheels[k].tangent;
        }
        return Status::ok;
    }

    double friction_coefficient_ = 0.3;
    std::string contact_table_, creep_table_;
    std::array<Input, 8> motion_{{{0}, {0}, {20}, {-20 / 0.46}, {0}, {0}, {0}, {0}}};
    std::array<Input, 2> loads_{{{1e5}, {1e5}}};
    std::array<Force, 3> forces_{Force::Zero(), Force::Zero(), Force::Zero()};  // of both wheels, left, right
    double height_ = 0, roll_ = 0, slip_work_ = 0;
    int status_ = 0;

    std::shared_ptr<const rollbem::ContactTable> contacts_;
    std::shared_ptr<const rollbem::CreepForceTable> creep_;
    std::array<Eigen::Matrix<double, components, WheelForces::inputs>, 2> tangents_{};
    double heat_ = 0;  // at the end of the last step [W]
};

}  // namespace

const Identity identity{.identifier = "rollbem_wheelset",
                        .description = "Contact forces of a wheelset on real rails, by look-up",
                        .stop_time = 1,
                        .step_size = 1e-3};

std::unique_ptr<Model> make_model() { return std::make_unique<Wheelset>(); }

}  // namespace fmu
