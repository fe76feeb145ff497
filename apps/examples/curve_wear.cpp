// Where the rails of a curve wear: the leading wheelset of a bogie rolls slowly through it, in balance at every point
// by the tables of forces; friction on the patches themselves then says how much work is done where on both rails.
//
//     ./examples/curve_wear [radius of the curve, m] [positions] > curve_wear.txt
//
// A quarter of the positions each lie on the transition curves; the curve turns left, so that the right rail is the
// outer one.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>

#include <Eigen/Dense>

#include <rollbem/compiled/wheelset.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/wear.hpp>

namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 15;         // of each wheel [N], [-], [m/s]
constexpr double half_wheelbase = 1.25, yaw_spring = 5e6;  // of the bogie [m], of the axle in its frame [N m/rad]
constexpr double outwards = 5e3;                           // what superelevation leaves over, on the axle [N]

/// Lateral shift, yaw and pitch rate in which a wheelset rolls through a curve.
class Curving {
public:
    /// `radius` [m] is that of the full curve, where the lateral load is `outwards`; it grows with the curvature.
    explicit Curving(double radius) : radius_(radius) { at_[2] = -speed / 0.46; }

    /// Newton's method from the point before. The frame points outwards by the angle of half a wheelbase.
    WheelsetRolling at(double curvature) {
        Eigen::Vector3d rest = residual(at_, curvature);
        for (int k = 0; k < 100 && rest.norm() > 1e-6 * load; ++k) {
            const Eigen::Vector3d step = tangent_.inverse() * rest, from = at_;
            double least = std::numeric_limits<double>::infinity();
            for (double part = 1; part > 0.01; part /= 2) {  // the best of them, as forces bend where contacts jump
                const double size = residual(from - part * step, curvature).norm();
                if (size < least) at_ = from - part * step;
                least = std::min(least, size);
            }
            rest = residual(at_, curvature);
        }
        if (!(rest.norm() < 1e-5 * load)) throw std::runtime_error("the wheelset finds no balance in the curve");
        WheelsetRolling rolling{.position = {at_[0], 0, 0, at_[1]}, .loads = {load, load}};
        rolling.speeds = speeds(at_, curvature);
        rolling.free_pitch = false;
        return rolling;
    }

private:
    static WheelsetSpeeds speeds(const Eigen::Vector3d& x, double curvature) {
        return {.forward = speed, .pitch_rate = x[2], .yaw_rate = -speed * curvature};
    }

    /// Lateral force [N], moments about the vertical and about the axle [N m]; leaves their derivatives in tangent_.
    Eigen::Vector3d residual(const Eigen::Vector3d& x, double curvature) {
        Eigen::Matrix<double, 6, 1> force = decltype(force)::Zero();
        Eigen::Matrix<double, 6, 3> by = decltype(by)::Zero();
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces now = geometry_.look_up(creep_, side, {x[0], 0, 0, x[1]}, speeds(x, curvature), load, mu);
            force += now.force;
            by.col(0) += now.derivative(WheelForces::lateral);
            by.col(1) += now.derivative(WheelForces::yaw);
            by.col(2) += now.derivative(WheelForces::pitch_rate);
        }
        tangent_ << by.row(1), by.row(5), by.row(4);
        tangent_(1, 1) -= yaw_spring;
        return {force[1] + outwards * curvature * radius_, force[5] - yaw_spring * (x[1] - half_wheelbase * curvature),
                force[4]};
    }

    double radius_;
    ContactTable geometry_ = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
    CreepForceTable creep_ = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    Eigen::Vector3d at_ = Eigen::Vector3d::Zero();
    Eigen::Matrix3d tangent_;
};

}  // namespace

int main(int argc, char** argv) try {
    const double radius = argc > 1 ? std::atof(argv[1]) : 400;
    const int positions = argc > 2 ? std::atoi(argv[2]) : 40;
    if (!(radius >= 100) || positions < 4) {
        std::fprintf(stderr, "usage: curve_wear [radius >= 100 m] [positions >= 4]\n");
        return 2;
    }
    const WheelsetOnTrack track(WheelOnRail(s1002(), rail_60e1()));
    const Profile& rail = track.wheel().rail();
    const auto cells = static_cast<Eigen::Index>(rail.length() / 5e-4);
    std::array<ProfileWear, 2> wear{ProfileWear(rail, cells), ProfileWear(rail, cells)};
    WheelsetOnTrack::Workspace workspace;
    Curving wheelset(radius);
    WheelsetRolling rolling;
    WheelsetForces forces;
    double work = 0, before = 0;  // per metre rolled [J/m]; curvature of the forces
    std::printf("# curve 1/m, shift mm, yaw mrad, T gamma of the inner and the outer wheel N\n");
    for (int i = 0; i < positions; ++i) {
        const double along = (i + 0.5) / positions, curvature = std::min({4 * along, 1.0, 4 * (1 - along)}) / radius;
        if (curvature != before) {  // the full curve is computed once
            // 1. Balance on a curve that begins and ends in straight lines
            rolling = wheelset.at(curvature);
            // 2. The patches of both wheels and their friction
            forces = rolling_forces(track, rolling, {.coefficient = mu}, workspace);
            before = curvature;
        }
        if (!has_numbers(forces.contacts.status)) throw std::runtime_error(name(forces.contacts.status));
        std::array<double, 2> gamma{};
        for (std::size_t side = 0; side < 2; ++side) {
            for (std::size_t k = 0; k < forces.patches[side].size(); ++k) {
                const PatchForce& patch = forces.patches[side][k];
                if (patch.status != Status::ok) throw std::runtime_error(name(patch.status));
                wear[side].add(forces.contacts.wheels[side].patches[k].rail_s, patch, 1.0 / positions);
                work += patch.slip_work / positions;
                gamma[side] += t_gamma(patch);
            }
        }
        std::printf("# %9.6f %8.3f %8.3f %10.2f %10.2f\n", curvature, 1e3 * rolling.position.lateral,
                    1e3 * rolling.position.yaw, gamma[0], gamma[1]);
    }
    // 3. Where on the rails: y towards the field side of the rail, z down
    std::printf("# y mm, z mm, work on the inner and on the outer rail J/m^2, of one wheelset\n");
    for (Eigen::Index i = 0; i < cells; ++i) {
        const Profile::Point at = rail.at((double(i) + 0.5) * wear[0].width());
        std::printf("%8.3f %8.3f %12.3f %12.3f\n", 1e3 * at.y, 1e3 * at.z, wear[0].work()[i], wear[1].work()[i]);
    }
    // nothing is lost, and the outer rail wears more
    const double inner = wear[0].work().sum() * wear[0].width(), outer = wear[1].work().sum() * wear[1].width();
    return std::abs(inner + outer - work) < 1e-9 * work && outer > inner ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
    std::fprintf(stderr, "curve_wear: %s\n", error.what());
    return 1;
}
