// Wear of the rails in a curve: the leading wheelset of a bogie rolls slowly through it, in balance at every point by
// the tables of forces. The tables give the work over both rails' profiles and the wear by Archard's law; friction on
// the patches themselves is compared.
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
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/wear.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 15;         // of each wheel [N], [-], [m/s]
constexpr double half_wheelbase = 1.25, yaw_spring = 5e6;  // of the bogie [m], of the axle in its frame [N m/rad]
constexpr double hardness = 3e9;                           // of the rail [Pa]
constexpr double outwards = 5e3;                           // lateral load by cant deficiency, on the axle [N]

/// Lateral shift, yaw and pitch rate in which a wheelset rolls through a curve.
class Curving {
public:
    /// `radius` [m] belongs to the full curve, where the lateral load is `outwards`; the load grows with the curvature.
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
    WheelForces look_up(WheelsetSide side, const WheelsetRolling& at) const {
        return geometry_.look_up(creep_, side, at.position, at.speeds, load, mu);
    }
    const CreepForceTable& creep() const { return creep_; }

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

/// The volume worn off a rail per metre rolled, over the strips of a wheel's points [m^3/m]: k p s/H of each element,
/// under the pressure of its ellipse, the coefficient by the peak of its zone.
PatchForce archard_wear(const WheelForces::Point& point, const CreepForceTable& creep) {
    PatchForce worn = strip_work_of(point, creep, mu);
    worn.strip_work.setZero();
    const double a = point.ellipse.half_length(), b = point.ellipse.half_width(),
                 peak = 1.5 * point.normal_load / (std::numbers::pi * a * b);
    const SimplifiedTheory theory(point.ellipse, creep_coefficients(creep, point.ellipse), mu, point.normal_load);
    theory.fastsim(point.creepage, [&](const SimplifiedTheory::Element& element) {
        const double x = element.x / a, y = element.y / b, rest = 1 - x * x - y * y,
                     shape = rest > 0 ? std::sqrt(rest) : 0, slip = std::hypot(element.slip[0], element.slip[1]);
        const double k = archard_coefficient(shape * point.peak_pressure, slip * speed, hardness);
        worn.strip_work[element.strip] += k * shape * peak * slip * element.area / hardness;
    });
    return worn;
}

/// Work of one wheelset on a rail by patches and by table [J/m^2], and the wear by Archard's law [m].
struct RailWear {
    ProfileWear patches, table, archard;

    RailWear(const Profile& rail, Eigen::Index cells) : patches(rail, cells), table(patches), archard(patches) {}

    void add(const WheelOnRail::Contact& contact, const std::vector<PatchForce>& forces, double weight) {
        for (std::size_t k = 0; k < forces.size(); ++k) {
            if (forces[k].status != Status::ok) throw std::runtime_error(name(forces[k].status));
            patches.add(contact.patches[k].rail_s, forces[k], weight);
        }
    }
    void add(const Profile& rail, const CreepForceTable& creep, const WheelForces& wheel, double weight) {
        for (const WheelForces::Point& point : wheel.points) {
            if (!(point.load_share > 0)) continue;
            const double s = arc_length(rail, point);
            table.add(s, strip_work_of(point, creep, mu), weight);
            archard.add(s, archard_wear(point, creep), weight);
        }
    }
};

double t_gamma_of(const WheelForces& wheel) {
    double sum = 0;
    for (const WheelForces::Point& point : wheel.points) sum += point.load_share > 0 ? t_gamma(point) : 0;
    return sum;
}
double sum_of(const ProfileWear& wear) { return wear.work().sum() * wear.width(); }

}  // namespace

int main(int argc, char** argv) {
    const double radius = argc > 1 ? std::atof(argv[1]) : 400;
    const int positions = argc > 2 ? std::atoi(argv[2]) : 40;
    if (!(radius >= 100) || positions < 4) {
        std::fprintf(stderr, "usage: curve_wear [radius >= 100 m] [positions >= 4]\n");
        return 2;
    }
    const WheelsetOnTrack track(WheelOnRail(s1002(), rail_60e1()));
    const Profile& rail = track.wheel().rail();
    const auto cells = static_cast<Eigen::Index>(rail.length() / 5e-4);
    std::array<RailWear, 2> wear{RailWear(rail, cells), RailWear(rail, cells)};
    WheelsetOnTrack::Workspace workspace;
    Curving wheelset(radius);
    WheelsetRolling rolling;
    WheelsetForces forces;
    double work = 0, before = 0;  // by table, per metre rolled [J/m]; curvature of the forces
    std::printf("# curve 1/m, shift mm, yaw mrad, T gamma N and Y/Q of the inner and the outer wheel\n");
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
        std::printf("# %9.6f %8.3f %8.3f", curvature, 1e3 * rolling.position.lateral, 1e3 * rolling.position.yaw);
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const auto k = static_cast<std::size_t>(side);
            const WheelForces now = wheelset.look_up(side, rolling);
            wear[k].add(forces.contacts.wheels[k], forces.patches[k], 1.0 / positions);
            wear[k].add(rail, wheelset.creep(), now, 1.0 / positions);
            work += t_gamma_of(now) / positions;
            std::printf(" %10.2f %6.3f", t_gamma_of(now), y_over_q(now, side));
        }
        std::puts("");
    }
    // 3. Work and wear over the rail's profile: y towards the field side, z down
    std::printf("# y mm, z mm, inner rail: work by patches and by table J/m^2, wear nm; outer rail\n");
    for (Eigen::Index i = 0; i < cells; ++i) {
        const Profile::Point at = rail.at((double(i) + 0.5) * wear[0].patches.width());
        std::printf("%8.3f %8.3f", 1e3 * at.y, 1e3 * at.z);
        for (const RailWear& of : wear) {
            std::printf(" %12.3f %12.3f %12.5f", of.patches.work()[i], of.table.work()[i], 1e9 * of.archard.work()[i]);
        }
        std::puts("");
    }
    // nothing is lost, the outer rail wears more, and the table does the work of the patches
    const double inner = sum_of(wear[0].table), outer = sum_of(wear[1].table),
                 by_patches = sum_of(wear[0].patches) + sum_of(wear[1].patches);
    double misplaced = 0;
    for (const RailWear& of : wear)
        misplaced += (of.table.work() - of.patches.work()).abs().sum() / 2 * of.table.width();
    std::fprintf(stderr, "work by table over that by patches %.4f, in other places %.3f of it\n",
                 (inner + outer) / by_patches, misplaced / by_patches);
    const bool agrees = std::abs(inner + outer - by_patches) < 0.1 * by_patches;
    return std::abs(inner + outer - work) < 1e-9 * work && outer > inner && agrees ? EXIT_SUCCESS : EXIT_FAILURE;
}
