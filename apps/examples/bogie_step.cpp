// A bogie in time: two S1002 wheelsets on 60E1 rails in a frame run from the straight through a transition of 40 m into
// a curve to the right, whose cant balances the centrifugal force. The step is linearly implicit, by the tables' exact
// tangents, so that stiff contacts and wheels without inertia in roll take steps of 1 ms.
//
//     ./examples/bogie_step [radius of the curve, m]
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <Eigen/Dense>

#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 20, wheel_radius = 0.46;  // of each wheel [N], [-], [m/s], [m]
constexpr double lateral_spring = 5e6, yaw_spring = 1e7, damper = 1e5;   // of each axle [N/m], [N m/rad], [N s/m]
constexpr double half_wheelbase = 1.25;                                  // [m]

// The coordinates of each axle and, without the last, of the frame, relative to the track where it is. y points to the
// right, yaw clockwise from above; pitch rates are negative when rolling forward.
enum { y, yaw, pitch, axle_size, frame_y = 2 * axle_size, frame_yaw, size };
using Vector = Eigen::Matrix<double, size, 1>;
using Matrix = Eigen::Matrix<double, size, size>;
const Vector mass{{1813, 1120, 112, 1813, 1120, 112, 2615, 3067}};  // [kg], [kg m^2]

struct Bogie {
    ContactTable geometry = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
    CreepForceTable creep = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    Vector x = Vector::Zero(), v{{0, 0, -speed / wheel_radius, 0, 0, -speed / wheel_radius, 0, 0}};
    double heat = 0;      // of all contacts [W]
    std::string fault{};  // of the last step

    /// A step of h [s] where the track has a curvature [1/m] and its change along it [1/m^2].
    void step(double h, double curvature, double change) {
        Vector force = -speed * speed * change * Vector{{0, 1120, 0, 0, 1120, 0, 0, 3067}};
        Matrix by_x = Matrix::Zero(), by_v = Matrix::Zero();
        heat = 0;
        for (int axle = 0; axle < 2; ++axle) {
            const int first = axle_size * axle;
            const double along = axle == 0 ? half_wheelbase : -half_wheelbase;
            const WheelsetPosition at{.lateral = x[first + y], .yaw = x[first + yaw]};
            const auto rails = geometry.on_rails(at.lateral, at.yaw, {load, load});
            const Eigen::RowVector2d fall(rails.height_by_lateral, rails.height_by_yaw),
                roll(rails.roll_by_lateral, rails.roll_by_yaw);
            const Eigen::Vector2d moves = v.segment<2>(first);
            const WheelsetSpeeds speeds{speed,           v[first + pitch], v[first + y],
                                        fall.dot(moves), roll.dot(moves),  v[first + yaw] + speed * curvature};
            for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
                const WheelForces now = geometry.look_up(creep, side, at, speeds, load, mu);
                if (now.status != Status::ok) fault = name(now.status);
                const std::array rows{1, 5, 4};  // F_y, M_z, M_y
                const Eigen::Matrix<double, 3, WheelForces::inputs> by = now.tangent(rows, Eigen::all);
                force.segment<3>(first) += now.force(rows);
                by_x.block<3, 2>(first, first) += by(Eigen::all, std::array{WheelForces::lateral, WheelForces::yaw});
                by_v.block<3, 3>(first, first) += by(
                    Eigen::all, std::array{WheelForces::lateral_speed, WheelForces::yaw_rate, WheelForces::pitch_rate});
                by_v.block<3, 2>(first, first) +=
                    by.col(WheelForces::vertical_speed) * fall + by.col(WheelForces::roll_rate) * roll;
                heat += now.heat;
            }
            // the axle beside its seat in the frame, as the track bends between them
            const Vector shift = Vector::Unit(first + y) - Vector::Unit(frame_y) - along * Vector::Unit(frame_yaw),
                         turn = Vector::Unit(first + yaw) - Vector::Unit(frame_yaw);
            const double apart = shift.dot(x) + curvature * along * along / 2;
            force -= (lateral_spring * apart + damper * shift.dot(v)) * shift +
                     yaw_spring * (turn.dot(x) + curvature * along) * turn;
            by_x -= lateral_spring * shift * shift.transpose() + yaw_spring * turn * turn.transpose();
            by_v -= damper * shift * shift.transpose();
        }
        const Eigen::MatrixXd implicit = Matrix(mass.asDiagonal()) - h * by_v - h * h * by_x;
        v += implicit.partialPivLu().solve(h * (force + h * by_x * v));
        x += h * v;
    }
};

}  // namespace

int main(int argc, char** argv) {
    const double R = argc > 1 ? std::atof(argv[1]) : 600, h = 1e-3, before = 10, transition = 40,
                 end = 150;  // [m], [s]
    if (!(R >= 300)) {
        std::fprintf(stderr, "bogie_step: radius of the curve = %g m must be at least 300\n", R);
        return 2;
    }
    Bogie bogie;
    std::puts("# place m, y mm and yaw mrad of the leading and the trailing axle, heat of friction J/m");
    const int steps = int(end / speed / h);
    for (int k = 0; k <= steps && bogie.fault.empty(); ++k) {
        const double place = k * h * speed, in_curve = (place - before) / transition;
        const bool bends = in_curve > 0 && in_curve < 1;
        bogie.step(h, std::clamp(in_curve, 0.0, 1.0) / R, bends ? 1 / (R * transition) : 0);
        if (k % 250 > 0) continue;
        const Vector now = 1e3 * bogie.x;
        std::printf("%6.1f %8.4f %8.4f %8.4f %8.4f %9.3f\n", place, now[y], now[yaw], now[axle_size + y],
                    now[axle_size + yaw], bogie.heat / speed);
    }
    const double moving = bogie.v.head<2>().norm();
    std::printf("# %s, the leading axle moves by %.1e m/s\n", bogie.fault.empty() ? "ok" : bogie.fault.c_str(), moving);
    return bogie.fault.empty() && moving < 1e-5 ? EXIT_SUCCESS : EXIT_FAILURE;
}
