// A wheelset with S1002 profiles hunts on rails 60E1: equivalent conicity, the speed at which it becomes unstable, and
// limit cycles with flange contact, with the forces of tables, in a time step of its own choice.
//
//     ./examples/hunting [number of speeds] [seconds of each]
//
// The wheelset is that of the passenger vehicle of the Manchester benchmarks (S. Iwnicki, Vehicle System Dynamics 30
// (1998) 295-313), on a frame that does not move, with a softer suspension, so that it hunts at a speed of trains.
// Height and roll follow the rails without inertia; the wheels' loads are those that balance the moment about the
// track.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include <rollbem/vehicle/contact_table.hpp>

namespace {

using namespace rollbem;

template <class Table>
Table read(const char* path) {
    std::ifstream file(path, std::ios::binary);
    return Table::read(file);
}

const ContactTable& s1002_on_60e1() {
    static const auto table = read<ContactTable>(ROLLBEM_TABLES "/s1002_60e1.contact");
    return table;
}

const CreepForceTable& steel() {
    static const auto table = read<CreepForceTable>(ROLLBEM_TABLES "/steel.creep");
    return table;
}

struct Wheelset {
    double mass = 1813;                         // [kg]
    double inertia = 1120, axle_inertia = 112;  // of yaw and of pitch [kg m^2]
    double lateral_spring = 1e6;                // [N/m]
    double yaw_spring = 1.5e6;                  // [N m/rad]
    double load = 1e5;                          // of each wheel [N]
    double friction = 0.3;
    double track_mass = 500, track_spring = 2e7,
           track_damper = 5e4;  // under the wheelset, lateral [kg], [N/m], [N s/m]
};

// y to the right, yaw clockwise from above as z points down, their rates, the pitch rate, and the lateral motion of the
// track; the integrals of what the drive puts in, of the heat, and of the power of the normal forces [J], which would
// be none on rigid bodies
enum { y, yaw, lateral_speed, yaw_rate, pitch_rate, track, track_speed, motion, drive = motion, heat, normal, states };
using State = Eigen::Matrix<double, states, 1>;
using Matrix = Eigen::Matrix<double, motion, motion>;

class Vehicle {
public:
    Vehicle(const Wheelset& wheelset, double speed, const ContactTable& geometry = s1002_on_60e1())
        : w_(wheelset), speed_(speed), geometry_(geometry) {
        middle_[pitch_rate] = -speed / 0.46;
        for (int k = 0; k < 20; ++k) {  // rolls freely in the middle of the track
            const State change = rate(middle_);
            middle_[pitch_rate] -= change[pitch_rate] / matrix_(pitch_rate, pitch_rate);
        }
        rate(middle_);
    }

    const State& middle() const { return middle_; }

    /// d(state)/dt; leaves its derivatives, right where the wheelset is in the middle, in matrix().
    State rate(const State& x) {
        const double shift = x[y] - x[track], shift_rate = x[lateral_speed] - x[track_speed];
        const WheelsetOnRails rails = geometry_.on_rails(shift, x[yaw]);
        const double fall = rails.height_by_lateral * shift_rate + rails.height_by_yaw * x[yaw_rate],
                     roll_rate = rails.roll_by_lateral * shift_rate + rails.roll_by_yaw * x[yaw_rate],
                     gyro = w_.axle_inertia * x[pitch_rate], tilt = std::sin(rails.roll) * std::cos(x[yaw]);
        const WheelsetSpeeds speeds{speed_, x[pitch_rate], shift_rate, fall, roll_rate, x[yaw_rate]};
        Eigen::Matrix<double, WheelForces::inputs, motion> inputs = decltype(inputs)::Zero();
        const auto input = [&](WheelInput which, int column) -> double& { return inputs(int(which), column); };
        input(WheelInput::lateral, y) = input(WheelInput::yaw, yaw) = input(WheelInput::pitch_rate, pitch_rate) = 1;
        input(WheelInput::lateral_speed, lateral_speed) = input(WheelInput::yaw_rate, yaw_rate) = 1;
        input(WheelInput::vertical_speed, lateral_speed) = rails.height_by_lateral;
        input(WheelInput::vertical_speed, yaw_rate) = rails.height_by_yaw;
        input(WheelInput::roll_rate, lateral_speed) = rails.roll_by_lateral;
        input(WheelInput::roll_rate, yaw_rate) = rails.roll_by_yaw;
        inputs.col(track) = -inputs.col(y);
        inputs.col(track_speed) = -inputs.col(lateral_speed);

        State change = State::Zero();
        Eigen::Matrix<double, 6, 1> force, by_transfer;
        Eigen::Matrix<double, 6, motion> by_state;
        for (int round = 0; round < 10; ++round) {  // which load goes over from the left wheel to the right one
            force.setZero();
            by_transfer.setZero();
            by_state.setZero();
            change.setZero();
            for (const double side : {-1.0, 1.0}) {
                const WheelForces now =
                    geometry_.look_up(steel(), side < 0 ? WheelsetSide::left : WheelsetSide::right,
                                      {shift, 0, 0, x[yaw]}, speeds, w_.load + side * transfer_, w_.friction);
                status_ = std::max(status_, now.status);
                force += now.force;
                by_transfer += side * now.derivative(WheelInput::load);
                by_state += now.tangent * inputs;
                change[heat] += now.heat;
                for (const PointForces& point : now.points) {
                    if (point.load_share == 0) continue;
                    const double w_x = roll_rate - x[pitch_rate] * std::sin(x[yaw]),
                                 w_y = x[pitch_rate] * std::cos(rails.roll) * std::cos(x[yaw]),
                                 w_z = x[yaw_rate] + x[pitch_rate] * tilt;
                    const double r_x = point.arm[0], r_y = side * point.arm[1], r_z = point.arm[2];
                    const double across = shift_rate + w_z * r_x - w_x * r_z, down = fall + w_x * r_y - w_y * r_x;
                    change[normal] +=
                        point.normal_load * (side * across * std::sin(point.angle) - down * std::cos(point.angle));
                }
            }
            const double step = (force[3] + gyro * x[yaw_rate]) / by_transfer[3];
            if (!(std::abs(step) > 1e-7 * w_.load)) break;
            transfer_ -= step;
        }
        Eigen::Matrix<double, 1, motion> transfer = -by_state.row(3) / by_transfer[3];
        transfer[yaw_rate] -= gyro / by_transfer[3];
        by_state += by_transfer * transfer;
        matrix_.setZero();
        matrix_.row(track_speed) = -by_state.row(1) / w_.track_mass;
        matrix_(track_speed, track) -= w_.track_spring / w_.track_mass;
        matrix_(track_speed, track_speed) -= w_.track_damper / w_.track_mass;
        by_state(1, y) -= w_.lateral_spring;
        by_state(5, yaw) -= w_.yaw_spring;
        by_state.row(5) -= gyro * inputs.row(int(WheelInput::roll_rate));
        matrix_(y, lateral_speed) = matrix_(yaw, yaw_rate) = matrix_(track, track_speed) = 1;
        matrix_.row(lateral_speed) = by_state.row(1) / w_.mass;
        matrix_.row(yaw_rate) = by_state.row(5) / w_.inertia;
        matrix_.row(pitch_rate) = by_state.row(4) / w_.axle_inertia;

        change[y] = x[lateral_speed];
        change[yaw] = x[yaw_rate];
        change[lateral_speed] = (force[1] - w_.lateral_spring * x[y]) / w_.mass;
        change[yaw_rate] = (force[5] - w_.yaw_spring * x[yaw] - gyro * roll_rate) / w_.inertia;
        change[pitch_rate] =
            (force[4] * std::cos(rails.roll) * std::cos(x[yaw]) - force[3] * std::sin(x[yaw]) + force[5] * tilt) /
            w_.axle_inertia;
        change[track] = x[track_speed];
        change[track_speed] =
            (-force[1] - w_.track_spring * x[track] - w_.track_damper * x[track_speed]) / w_.track_mass;
        change[drive] = -force[0] * speed_;
        change[heat] += w_.track_damper * x[track_speed] * x[track_speed];
        return change;
    }

    const Matrix& matrix() const { return matrix_; }

    /// Kinetic energy, that of the springs and of the height [J].
    double energy(const State& x) const {
        return (w_.mass * x[lateral_speed] * x[lateral_speed] + w_.inertia * x[yaw_rate] * x[yaw_rate] +
                w_.axle_inertia * x[pitch_rate] * x[pitch_rate] + w_.lateral_spring * x[y] * x[y] +
                w_.yaw_spring * x[yaw] * x[yaw] + w_.track_mass * x[track_speed] * x[track_speed] +
                w_.track_spring * x[track] * x[track]) /
                   2 -
               2 * w_.load * geometry_.on_rails(x[y] - x[track], x[yaw]).height;
    }

    /// `seconds` by the method of Bogacki and Shampine, orders 3 and 2; returns the largest shift of the last third
    /// [m]; NaN if a wheel lifts off or leaves the table.
    double roll(double seconds, State& x, double tolerance) {
        double time = 0, largest = 0;
        State first = rate(x);
        while (time < seconds) {
            const double h = std::min(step_, seconds - time);
            const State second = rate(x + h / 2 * first), third = rate(x + h * 3 / 4 * second);
            const State next = x + h / 9 * (2 * first + 3 * second + 4 * third), last = rate(next);
            const State error = h * (-5 * first + 6 * second + 8 * third - 9 * last) / 72;
            Eigen::Array<double, motion, 1> scale;
            scale << 1e-3, 1e-3, 1e-2, 1e-2, 1e-1, 1e-3, 1e-2;
            const double share = (error.head<motion>().array() / scale).abs().maxCoeff() / tolerance;
            if (std::exchange(status_, StepStatus::ok) != StepStatus::ok) {
                if (h < 1e-7) return std::numeric_limits<double>::quiet_NaN();
                step_ = h / 4;
                transfer_ = 0;
                first = rate(x);
                continue;
            }
            if (h == step_ || share > 1) step_ = h * std::clamp(0.9 / std::cbrt(share), 0.3, 2.0);
            if (share > 1) continue;
            time += h;
            x = next;
            first = last;
            if (3 * time > 2 * seconds) largest = std::max(largest, std::abs(x[y] - x[track]));
        }
        return largest;
    }

private:
    Wheelset w_;
    double speed_, transfer_ = 0, step_ = 1e-4;
    const ContactTable& geometry_;
    StepStatus status_ = StepStatus::ok;
    State middle_ = State::Zero();
    Matrix matrix_;
};

/// The eigenvalue of hunting that decays least [1/s].
std::complex<double> least_damped(const Matrix& A) {
    const auto values = Eigen::EigenSolver<Matrix>(A, false).eigenvalues().eval();
    return *std::max_element(values.begin(), values.end(), [](auto p, auto q) { return p.real() < q.real(); });
}

/// The smallest speed at which hunting no longer decays, by bisection [m/s].
double critical_speed(const Wheelset& w, double low, double high) {
    while (high - low > 1e-9 * high) {
        const double middle = (low + high) / 2;
        (least_damped(Vehicle(w, middle).matrix()).real() > 0 ? high : low) = middle;
    }
    return low;
}

constexpr double half_spacing = 0.75, radius = 0.46;  // of the tape circles [m]

double klingel(double conicity) { return 2 * std::numbers::pi * std::sqrt(half_spacing * radius / conicity); }

/// Equivalent conicity of EN 15302 over the amplitude [m]: the cone whose Klingel wave is as long as the solution of
/// y'' = -Delta r(y)/(2 s r_0), where Delta r is the difference of rolling radii, of two points their mean by load.
class Conicity {
public:
    Conicity() {
        double last = 0;
        for (std::size_t i = 1; i < potential_.size(); ++i) {
            const double now = difference(step * double(i));
            potential_[i] = potential_[i - 1] + step * (last + now) / (4 * half_spacing * radius);
            last = now;
        }
    }

    /// By the time of a quarter of the wave from the energy of this oscillator; sines as they are 0 at its ends.
    double operator()(double amplitude) const {
        constexpr int points = 400;
        double quarter = 0;
        for (int i = 0; i < points; ++i) {
            const double angle = std::numbers::pi / 2 * (i + 0.5) / points;
            quarter += std::numbers::pi / 2 / points * amplitude * std::cos(angle) /
                       std::sqrt(2 * (at(amplitude) - at(amplitude * std::sin(angle))));
        }
        return half_spacing * radius * std::pow(std::numbers::pi / (2 * quarter), 2);
    }

private:
    static constexpr double step = 1e-5;

    static double difference(double shift) {
        double sum = 0;
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces now = s1002_on_60e1().look_up(steel(), side, {.lateral = shift},
                                                            {.forward = 1, .pitch_rate = -1 / radius}, 1e5, 0.3);
            for (const PointForces& point : now.points) {
                sum += (side == WheelsetSide::right ? 1 : -1) * point.load_share * point.rolling_radius;
            }
        }
        return sum;
    }
    double at(double shift) const {
        const auto i = std::min(static_cast<std::size_t>(shift / step), potential_.size() - 2);
        const double part = shift / step - double(i);
        return potential_[i] + part * (potential_[i + 1] - potential_[i]);
    }

    std::array<double, 651> potential_{};
};

}  // namespace

int main(int argc, char** argv) {
    const int speeds = argc > 1 ? std::atoi(argv[1]) : 4;
    if (speeds < 2 || speeds > 1000) {
        std::fprintf(stderr, "hunting: number of speeds = %s must be an integer in [2, 1000]\n", argv[1]);
        return 2;
    }
    const double seconds = argc > 2 ? std::atof(argv[2]) : 4;
    if (!(seconds > 0)) {
        std::fprintf(stderr, "hunting: seconds = %s must be positive\n", argv[2]);
        return 2;
    }
    const Conicity conicity;
    std::printf("%12s %12s\n", "amplitude mm", "conicity");
    for (int i = 1; i <= 26; ++i) std::printf("%12.2f %12.4f\n", 0.25 * i, conicity(0.25e-3 * i));

    // slowly and without springs: Klingel's wave, on ellipses and on the patches that they stand for
    const Wheelset w;
    Wheelset free = w;
    free.lateral_spring = free.yaw_spring = 0;
    Eigen::ArrayXXd values = s1002_on_60e1().values();
    for (const Eigen::Index point : {0, int(ContactRow::point_rows)}) {
        values.middleRows(point + ContactRow::correction, 9).setZero();
    }
    const ContactTable ellipses(s1002_on_60e1().grid(), 1e5, s1002_on_60e1().shear_modulus(), 0.28, values);
    const auto wavelength = [&](const ContactTable& geometry) {
        constexpr double crawl = 0.1;
        return 2 * std::numbers::pi * crawl / std::abs(least_damped(Vehicle(free, crawl, geometry).matrix()).imag());
    };
    const double wave = wavelength(ellipses);
    std::printf("wavelength at walking pace: %.4f m on ellipses, Klingel %.4f m; %.4f m on patches\n", wave,
                klingel(conicity(1e-4)), wavelength(s1002_on_60e1()));

    // a small deviation grows as the eigenvalue says
    const double critical = critical_speed(w, 20, 100);
    Vehicle faster(w, 1.02 * critical);
    const std::complex<double> eigenvalue = least_damped(faster.matrix());
    const double period = 2 * std::numbers::pi / std::abs(eigenvalue.imag());
    State x = faster.middle();
    x[y] = 1e-7;
    faster.roll(5 * period, x, 1e-9);
    const double before = faster.roll(3 * period, x, 1e-9);
    faster.roll(7 * period, x, 1e-9);
    const double growth = std::log(faster.roll(3 * period, x, 1e-9) / before) / (10 * period);
    std::printf("critical speed: %.3f m/s; growth at 1.02 of it: %.4f 1/s in time, %.4f by the eigenvalue\n", critical,
                growth, eigenvalue.real());

    // amplitudes that last, from a small and a large deviation
    bool right = std::abs(wave / klingel(conicity(1e-4)) - 1) < 0.01 && std::abs(growth / eigenvalue.real() - 1) < 0.01;
    std::printf("%8s %14s %14s %10s %12s %10s\n", "V m/s", "|y| small mm", "|y| large mm", "gap/heat", "normal/heat",
                "s per s");
    for (int i = 0; i < speeds; ++i) {
        const double share = 0.8 + 0.35 * i / (speeds - 1);
        std::array<double, 2> lasting{};
        double gap = 0, lost = 0, slowest = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            Vehicle vehicle(w, share * critical);
            State now = vehicle.middle();
            now[y] = k == 0 ? 1e-3 : 6e-3;
            const double start = vehicle.energy(now);
            const std::clock_t clock = std::clock();
            lasting[k] = vehicle.roll(seconds, now, 1e-5);
            slowest = std::max(slowest, double(std::clock() - clock) / CLOCKS_PER_SEC / seconds);
            const double change = vehicle.energy(now) - start;
            gap = std::max(gap, std::abs(now[drive] - now[heat] + now[normal] - change) / now[heat]);
            lost = std::max(lost, std::abs(now[normal]) / now[heat]);
        }
        std::printf("%8.3f %14.5f %14.5f %10.1e %12.1e %10.2f\n", share * critical, 1e3 * lasting[0], 1e3 * lasting[1],
                    gap, lost, slowest);
        right = right && gap < 5e-6 && (share > 0.96 || lasting[0] < 1e-3) &&
                (share < 1.04 || (lasting[1] > 6.2e-3 && lasting[0] < 1.01 * lasting[1]));
    }
    return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
