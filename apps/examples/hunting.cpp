// A wheelset with S1002 profiles hunts on rails 60E1: equivalent conicity, the speed at which it becomes unstable, and
// limit cycles with flange contact and their balance of energy, with the forces of tables, in a time step of its own
// choice.
//
//     ./examples/hunting [number of speeds] [seconds of each]
//
// The passenger vehicle of the Manchester benchmarks (S. Iwnicki, Vehicle System Dynamics 30 (1998) 295-313) has this
// wheelset, here on a frame that does not move, with a softer suspension, so that it hunts at a speed of trains. Height
// and roll follow the rails without inertia; the wheels' loads balance the moment about the track.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace {

using namespace rollbem;

const auto geometry = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
const auto steel = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");

constexpr double mass = 1813, inertia = 1120, axle_inertia = 112;     // [kg], of yaw and of pitch [kg m^2]
constexpr double lateral_spring = 1e6, yaw_spring = 1.5e6;            // [N/m], [N m/rad]
constexpr double track_mass = 500, track_spring = 2e7, damper = 5e4;  // under it, lateral [kg], [N/m], [N s/m]
constexpr double load = 1e5, friction = 0.3;                          // of each wheel [N]
constexpr double half_spacing = 0.75, radius = 0.46;                  // of the tape circles [m]

// The state: y to the right, yaw clockwise from above as z points down, the track's lateral motion; their rates, the
// pitch rate; the drive's work, the heat, and the work of normal forces [J], which would be 0 on rigid bodies.
enum { y, yaw, track, lateral_speed, yaw_rate, track_speed, pitch_rate, motion, drive = motion, heat, normal, states };
using State = Eigen::Matrix<double, states, 1>;

WheelForces wheel(double side, double shift, double yaw, const WheelsetSpeeds& speeds,
                  const ContactTable::Load& carried) {
    return geometry.look_up(steel, side < 0 ? WheelsetSide::left : WheelsetSide::right, {.lateral = shift, .yaw = yaw},
                            speeds, carried, friction);
}

struct Vehicle {
    double speed, transfer = 0, step = 1e-4;  // [m/s], of load from left to right [N], of time [s]
    Status status = Status::ok;
    State middle = State::Zero();  // free rolling in the middle of the track

    explicit Vehicle(double v) : speed(v) {
        middle[pitch_rate] = -speed / radius;
        for (int k = 0; k < 20; ++k) middle[pitch_rate] -= rate(middle)[pitch_rate] / by(pitch_rate)[pitch_rate];
    }

    State rate(const State& x) {
        const double shift = x[y] - x[track], shift_rate = x[lateral_speed] - x[track_speed];
        const ContactTable::OnRails rails = geometry.on_rails(shift, x[yaw]);
        const double fall = rails.height_by_lateral * shift_rate + rails.height_by_yaw * x[yaw_rate],
                     roll_rate = rails.roll_by_lateral * shift_rate + rails.roll_by_yaw * x[yaw_rate],
                     gyro = axle_inertia * x[pitch_rate];
        const Eigen::Vector3d axle(-std::sin(x[yaw]), std::cos(rails.roll) * std::cos(x[yaw]),
                                   std::sin(rails.roll) * std::cos(x[yaw]));
        const Eigen::Vector3d turn = x[pitch_rate] * axle + Eigen::Vector3d(roll_rate, 0, x[yaw_rate]);
        const WheelsetSpeeds speeds{speed, x[pitch_rate], shift_rate, fall, roll_rate, x[yaw_rate]};
        Eigen::Matrix<double, 6, 1> force, by_transfer;
        double change = load, heating = 0, pushing = 0;
        if (!std::isfinite(transfer)) transfer = 0;
        for (int round = 0; round < 10 && std::abs(change) > 1e-7 * load; ++round) {
            force.setZero();
            by_transfer.setZero();
            heating = pushing = 0;
            for (const double side : {-1.0, 1.0}) {
                const WheelForces now = wheel(side, shift, x[yaw], speeds, {load + side * transfer, rails.roll});
                status = std::max(status, now.status);
                force += now.force;
                by_transfer += side * now.derivative(WheelForces::load);
                heating += now.heat;
                for (const WheelForces::Point& point : now.points) {
                    const Eigen::Vector3d arm(point.arm[0], side * point.arm[1], point.arm[2]),
                        turned = turn.cross(arm);
                    pushing += point.normal_load * (side * (shift_rate + turned[1]) * std::sin(point.angle) -
                                                    (fall + turned[2]) * std::cos(point.angle));
                }
            }
            change = -(force[3] + gyro * x[yaw_rate]) / by_transfer[3];
            transfer += change;
            force += change * by_transfer;
        }
        return {x[lateral_speed],
                x[yaw_rate],
                x[track_speed],
                (force[1] - lateral_spring * x[y]) / mass,
                (force[5] - yaw_spring * x[yaw] - gyro * roll_rate) / inertia,
                (-force[1] - track_spring * x[track] - damper * x[track_speed]) / track_mass,
                axle.dot(force.tail<3>()) / axle_inertia,
                -force[0] * speed,
                heating + damper * x[track_speed] * x[track_speed],
                pushing};
    }

    /// Energy of motion, springs and height [J].
    static double energy(const State& x) {
        const auto square = [&](int k) { return x[k] * x[k]; };
        return (mass * square(lateral_speed) + inertia * square(yaw_rate) + axle_inertia * square(pitch_rate) +
                lateral_spring * square(y) + yaw_spring * square(yaw) + track_mass * square(track_speed) +
                track_spring * square(track)) /
                   2 -
               2 * load * geometry.on_rails(x[y] - x[track], x[yaw]).height;
    }

    /// d(rate)/d(state k) in the middle.
    State by(int k) {
        const State moved = 1e-8 * State::Unit(k);
        return (rate(middle + moved) - rate(middle - moved)) / 2e-8;
    }

    /// The largest growth of a small deviation [1/s].
    double growth() {
        Eigen::MatrixXd A(motion, motion);
        for (int k = 0; k < motion; ++k) A.col(k) = by(k).head<motion>();
        return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues().real().maxCoeff();
    }

    /// `seconds` by the method of Bogacki and Shampine, orders 3 and 2; returns the largest shift of the last third
    /// [m]; NaN if a wheel lifts off or leaves the table.
    double roll(double seconds, State& x) {
        const Eigen::Array<double, motion, 1> tolerance{3.5e-9, 3.5e-9, 3.5e-9, 3.5e-8, 3.5e-8, 3.5e-8, 3.5e-7};
        double time = 0, largest = 0;
        State first = rate(x);
        while (time < seconds) {
            const double h = std::min(step, seconds - time);
            const State second = rate(x + h / 2 * first), third = rate(x + h * 3 / 4 * second);
            const State next = x + h / 9 * (2 * first + 3 * second + 4 * third), last = rate(next);
            const State error = h * (-5 * first + 6 * second + 8 * third - 9 * last) / 72;
            const bool lost = std::exchange(status, Status::ok) != Status::ok;
            const double share = lost ? 1e3 : (error.head<motion>().array() / tolerance).abs().maxCoeff();
            // the size of a shortened last step is no hint for the next one, unless the step is refused
            if (h == step || share > 1) step = h * std::clamp(0.9 / std::cbrt(share), 0.3, 2.0);
            if (share > 1 && h < 1e-7) return std::numeric_limits<double>::quiet_NaN();
            if (share > 1) continue;
            time += h;
            x = next;
            first = last;
            if (3 * time > 2 * seconds) largest = std::max(largest, std::abs(x[y] - x[track]));
        }
        return largest;
    }
};

/// Difference of the rolling radii [m], of two points their mean by load.
double radius_difference(double shift) {
    double sum = 0;
    for (const double side : {-1.0, 1.0}) {
        for (const WheelForces::Point& point :
             wheel(side, shift, 0, {.forward = 1, .pitch_rate = -1 / radius}, load).points) {
            sum += side * point.load_share * point.rolling_radius;
        }
    }
    return sum;
}

/// Equivalent conicity of EN 15302: the cone whose Klingel wave is as long as the solution of y'' = -Delta r/(2 s r_0)
/// with this amplitude [m], four times the distance from there to the middle, by the energy of this oscillator; sines
/// as its speed is 0 at the amplitude.
double conicity(double amplitude) {
    constexpr int points = 400;
    double quarter = 0, energy = 0, before = amplitude;
    for (int i = points - 1; i >= 0; --i) {
        const double angle = std::numbers::pi / 2 * (i + 0.5) / points, shift = amplitude * std::sin(angle);
        energy += (before - shift) * radius_difference((before + shift) / 2) / (half_spacing * radius);
        quarter += std::numbers::pi / 2 / points * amplitude * std::cos(angle) / std::sqrt(energy);
        before = shift;
    }
    return half_spacing * radius * std::pow(std::numbers::pi / (2 * quarter), 2);
}

}  // namespace

int main(int argc, char** argv) {
    const int speeds = argc > 1 ? std::atoi(argv[1]) : 4;
    const double seconds = argc > 2 ? std::atof(argv[2]) : 4;
    if (speeds < 2 || speeds > 1000 || !(seconds > 0)) {
        std::fprintf(stderr, "hunting: number of speeds = %d must be an integer in [2, 1000], seconds = %g positive\n",
                     speeds, seconds);
        return 2;
    }
    std::printf("%12s %12s\n", "amplitude mm", "conicity");
    for (int i = 1; i <= 26; ++i) std::printf("%12.2f %12.4f\n", 0.25 * i, conicity(0.25e-3 * i));

    double low = 20, critical = 100;  // by bisection
    while (critical - low > 1e-9 * critical) {
        const double speed = (low + critical) / 2;
        (Vehicle(speed).growth() > 0 ? critical : low) = speed;
    }
    std::printf("critical speed: %.3f m/s\n", critical);

    // amplitudes that last, from a small and a large deviation
    bool right = true;
    std::printf("%8s %14s %14s %10s %12s %10s\n", "V m/s", "|y| small mm", "|y| large mm", "gap/heat", "normal/heat",
                "s per s");
    for (int i = 0; i < speeds; ++i) {
        const double share = 0.8 + 0.35 * i / (speeds - 1);
        const std::clock_t clock = std::clock();
        std::array<double, 2> lasting{1e-3, 6e-3};
        double gap = 0, stored = 0;
        for (double& deviation : lasting) {
            Vehicle vehicle(share * critical);
            State now = vehicle.middle + deviation * State::Unit(y);
            const double start = Vehicle::energy(now);
            deviation = vehicle.roll(seconds, now);
            const double rest = now[drive] - now[heat] + now[normal] - (Vehicle::energy(now) - start);
            gap = std::max(gap, std::abs(rest) / now[heat]);
            stored = std::max(stored, std::abs(now[normal]) / now[heat]);
        }
        const double cost = double(std::clock() - clock) / CLOCKS_PER_SEC / (2 * seconds);
        std::printf("%8.3f %14.5f %14.5f %10.1e %12.1e %10.2f\n", share * critical, 1e3 * lasting[0], 1e3 * lasting[1],
                    gap, stored, cost);
        right = right && gap < 2e-6 && (share > 0.96 || lasting[0] < 1e-3) &&
                (share < 1.04 || (lasting[1] > 6.2e-3 && lasting[0] < 1.01 * lasting[1]));
    }
    return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
