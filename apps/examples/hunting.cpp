// A wheelset with coned wheels hunts: Klingel's wave, the speed at which it becomes unstable, and the limit cycle
// above, with longitudinal, lateral and spin creepage on elliptic contacts, in SI units.
//
//     ./examples/hunting [number of speeds]
//
//     contact: a = 6.294 mm, b = 4.754 mm, c11, c22, c23, c33 = 4.5477 4.1259 1.8619 1.0001
//     wavelength at walking pace: 16.07717 m, Klingel 16.07698 m
//     critical speed by the table without spin: 71.0601 m/s
//       with the spin of the cones: +1.4e-03 of it
//     growth at 72.58 m/s: 0.1332 1/s in time, 0.1332 by the eigenvalue
//
// Wheelset, track and flange are those of Cooperrider's bogie (C. Kaas-Petersen, Acta Mechanica 61 (1986) 89-107), on a
// frame that does not move and with a suspension a fifth as stiff, so that it hunts at a speed of trains.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <rollbem/adhesion/creep_coefficients.hpp>
#include <rollbem/adhesion/frequency.hpp>
#include <rollbem/assembly/patch_system.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/normal/hertz_ellipse.hpp>
#include <rollbem/normal/patch_pressure.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

namespace {

using namespace rollbem;
using Complex = std::complex<double>;

struct Wheelset {
    double mass = 1022;              // m [kg]
    double inertia = 678;            // of yaw, I [kg m^2]
    double radius = 0.4572;          // r_0 [m]
    double half_gauge = 0.716;       // s [m], between the contacts
    double conicity = 0.05;          // lambda
    double load = 66674;             // N of each wheel [N]: half a car body, frame and two wheelsets on four wheels
    double friction = 0.15;          // mu
    double lateral_spring = 0.73e6;  // [N/m]
    double yaw_spring = 0.56e6;      // [N m/rad]
    double flange_spring = 14.6e6;   // [N/m] once the play is used up
    double play = 9.1e-3;            // [m]
};

/// y to the right and yaw psi clockwise from above, as z points down, and their rates.
using State = Eigen::Vector4d;  // y, psi, dy/dt, dpsi/dt

// 1. Creepages of the right (side = 1) and the left wheel (-1), which roll with omega = V/r_0 on radii r_0 +- lambda y.
// The cone turns the axis of rotation out of the plane of contact: spin.
Creepage<double> creepage(const Wheelset& w, double speed, const State& x, int side) {
    return {-side * (w.half_gauge * x[3] / speed + w.conicity * x[0] / w.radius), x[2] / speed - x[1],
            x[3] / speed - side * w.conicity / w.radius};
}

/// d(creepage)/d(state): xi, eta, phi per y, psi, dy/dt, dpsi/dt.
Eigen::Matrix<double, 3, 4> creepage_rates(const Wheelset& w, double speed, int side) {
    Eigen::Matrix<double, 3, 4> rates = Eigen::Matrix<double, 3, 4>::Zero();
    rates(0, 0) = -side * w.conicity / w.radius;
    rates(0, 3) = -side * w.half_gauge / speed;
    rates(1, 1) = -1;
    rates(1, 2) = rates(2, 3) = 1 / speed;
    return rates;
}

/// What F_x, F_y, M_z of a wheel contribute to the force along y and the moment about z.
Eigen::Matrix<double, 2, 3> force_arms(const Wheelset& w, int side) {
    Eigen::Matrix<double, 2, 3> arms;
    arms << 0, 1, 0, -side * w.half_gauge, 0, 1;
    return arms;
}

/// Spring of the suspension, and of the flange beyond the play [N].
double guiding_force(const Wheelset& w, double y) {
    const double beyond = std::max(std::abs(y) - w.play, 0.0);
    return -w.lateral_spring * y - std::copysign(w.flange_spring * beyond, y);
}

// 2. Linear: [mass] x'' = force; the state matrix from what the forces of each wheel lose per xi, eta, phi.
using CreepMatrix = Eigen::Matrix3d;

Eigen::Matrix4d state_matrix(const Wheelset& w, double speed, const std::array<CreepMatrix, 2>& by_creepage) {
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A(0, 2) = A(1, 3) = 1;
    for (const int side : {1, -1}) {
        A.bottomRows<2>() += force_arms(w, side) * by_creepage[side == 1 ? 0 : 1] * creepage_rates(w, speed, side);
    }
    A(2, 0) -= w.lateral_spring;
    A(3, 1) -= w.yaw_spring;
    A.row(2) /= w.mass;
    A.row(3) /= w.inertia;
    return A;
}

/// The eigenvalue that decays least [1/s].
Complex least_damped(const Eigen::MatrixXd& A) {
    const Eigen::VectorXcd values = Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
    return *std::max_element(values.begin(), values.end(), [](Complex p, Complex q) { return p.real() < q.real(); });
}

/// -d(F_x, F_y, M_z)/d(xi, eta, phi) by Kalker's linear law.
template <class Value>
Eigen::Matrix<Value, 3, 3> linear_law(const PatchContact<double>& contact, const CreepCoefficients<Value>& k) {
    const double c = contact.c(), unit = contact.shear_modulus() * c * c;
    Eigen::Matrix<Value, 3, 3> law;
    law << k.c11, 0, 0, 0, k.c22, c * k.c23, 0, c * k.c32, c * c * k.c33;
    return unit * law;
}

/// The smallest speed at which an eigenvalue no longer decays, by bisection.
template <class LeastDamped>
double critical_speed(double low, double high, const LeastDamped& eigenvalue) {
    while (high - low > 1e-10 * high) {
        const double middle = (low + high) / 2;
        (eigenvalue(middle).real() > 0 ? high : low) = middle;
    }
    return (low + high) / 2;
}

/// The same with creep coefficients that depend on the frequency: V and omega at which i omega solves the equations, by
/// Newton's method from those of steady coefficients.
double critical_speed(const Wheelset& w, const PatchContact<double>& contact, const FrequencySweep<double>& sweep,
                      double speed, double omega) {
    const auto determinant = [&](double V, double frequency) {
        const auto law =
            linear_law<Complex>(contact, creep_coefficients(contact, sweep(frequency * contact.half_length() / V)));
        Eigen::Matrix4cd A = Eigen::Matrix4cd::Zero();
        for (const int side : {1, -1}) {
            A.bottomRows<2>() -= force_arms(w, side).cast<Complex>() * law * creepage_rates(w, V, side).cast<Complex>();
        }
        const Complex s(0, frequency);
        Eigen::Matrix2cd stiffness = -A.bottomLeftCorner<2, 2>() - s * A.bottomRightCorner<2, 2>();
        stiffness(0, 0) += w.lateral_spring + s * s * w.mass;
        stiffness(1, 1) += w.yaw_spring + s * s * w.inertia;
        return stiffness.determinant();
    };
    for (int k = 0; k < 20; ++k) {
        const double dV = 1e-5 * speed, dw = 1e-5 * omega;
        const Complex value = determinant(speed, omega), by_speed = (determinant(speed + dV, omega) - value) / dV,
                      by_omega = (determinant(speed, omega + dw) - value) / dw;
        Eigen::Matrix2d jacobian;
        jacobian << by_speed.real(), by_omega.real(), by_speed.imag(), by_omega.imag();
        const Eigen::Vector2d change = -jacobian.inverse() * Eigen::Vector2d(value.real(), value.imag());
        speed += change[0];
        omega += change[1];
        if (std::abs(change[0]) < 1e-9 * speed) break;
    }
    return speed;
}

// 3. With saturation: a table of the ellipses near that of the wheels, from 8 x 8 elements.
CreepForceTable make_table(const PatchContact<double>& wheel) {
    const int shapes = 4, levels = 20;
    const double smallest = wheel.a_over_b() / 1.1, largest = wheel.a_over_b() * 1.1, nu = wheel.poisson_ratio();
    const double bound = 0.01, load = bound / 0.3;  // mu N/(G a b) of the contacts below, where G a b = 1
    const NodeDifference scheme{Nodes::chebyshev};
    const HalfSpace<double> kernel(nu);
    std::vector<CreepCoefficients<double>> coefficients;
    std::vector<PatchContact<double>> ellipses;
    for (int i = 0; i < shapes; ++i) {
        const double a = std::sqrt(CreepForceGrid::a_over_b_of(i, shapes, smallest, largest));
        ellipses.push_back(
            PatchContact<double>({.half_length = a, .half_width = 1 / a, .shear_modulus = 1, .poisson_ratio = nu}));
        const Response<double> steady = solve_steady(ellipses.back(), patch_mesh(ellipses.back(), 8, 8), scheme);
        coefficients.push_back(creep_coefficients(ellipses.back(), steady));
    }
    CreepForceGrid grid(nu, smallest, largest, levels, coefficients);
    Eigen::Array3Xd forces(3, shapes * grid.nodes());
    for (int i = 0; i < shapes; ++i) {
        const PatchContact<double>& ellipse = ellipses[static_cast<std::size_t>(i)];
        const PatchMesh<double> mesh = patch_mesh(ellipse, 8, 8);
        const FrictionModel model(ellipse, steady_system(mesh, scheme, kernel),
                                  {0.3, hertz_pressures(ellipse, mesh, load)});
        auto workspace = model.workspace();
        auto now = model.at_rest(), next = now;
        for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
            const Creepage<double> v = grid.creepage(i, node);
            const auto step =
                model.steady(now, {bound * v.longitudinal, bound * v.lateral, bound * v.spin}, next, workspace);
            if (step.status != StepStatus::ok) return {grid, Eigen::Array3Xd(3, 0)};  // refused
            forces.col(i * grid.nodes() + node) << -step.force.longitudinal, -step.force.lateral, -step.force.moment;
            std::swap(now, next);
        }
    }
    forces /= bound;
    return {grid, forces};
}

struct Wheels {
    const CreepForceTable& table;
    PatchContact<double> contact;

    TabulatedForce operator()(const Wheelset& w, const Creepage<double>& creepage) const {
        return table.look_up(contact, w.friction, w.load, creepage);
    }
};

/// d(F_x, F_y, M_z)/d(xi, eta, phi) of both wheels in the middle of the track, where they spin against each other.
std::array<CreepMatrix, 2> tangents(const Wheelset& w, const Wheels& wheels, double spin) {
    std::array<CreepMatrix, 2> matrices;
    for (const int side : {1, -1}) {
        const auto t = wheels(w, {0, 0, -side * spin}).tangent;
        Eigen::Index column = 0;
        for (const auto& by : {t.by_longitudinal, t.by_lateral, t.by_spin}) {
            matrices[side == 1 ? 0 : 1].col(column++) << by.longitudinal, by.lateral, by.moment;
        }
    }
    return matrices;
}

/// State, and what the drive that keeps V and omega has put in and creepage has turned into heat [J].
struct Ride {
    State x = State::Zero();
    double work = 0, heat = 0;
};

Ride rate(const Wheelset& w, const Wheels& wheels, double speed, const Ride& at) {
    const State& x = at.x;
    Ride d;
    Eigen::Vector2d force(guiding_force(w, x[0]), -w.yaw_spring * x[1]);
    for (const int side : {1, -1}) {
        const Creepage<double> v = creepage(w, speed, x, side);
        const auto f = wheels(w, v).force;
        const Eigen::Vector3d forces(f.longitudinal, f.lateral, f.moment);
        force += force_arms(w, side) * forces;
        d.heat -= speed * forces.dot(Eigen::Vector3d(v.longitudinal, v.lateral, v.spin));
        d.work += speed *
                  forces.dot(Eigen::Vector3d(side * w.conicity * x[0] / w.radius, x[1], side * w.conicity / w.radius));
    }
    d.x << x[2], x[3], force[0] / w.mass, force[1] / w.inertia;
    return d;
}

double energy(const Wheelset& w, const State& x) {
    const double beyond = std::max(std::abs(x[0]) - w.play, 0.0);
    return (w.mass * x[2] * x[2] + w.inertia * x[3] * x[3] + w.lateral_spring * x[0] * x[0] +
            w.yaw_spring * x[1] * x[1] + w.flange_spring * beyond * beyond) /
           2;
}

/// `seconds` by the classic Runge-Kutta method; returns the largest |y| of the last third [m].
double roll(const Wheelset& w, const Wheels& wheels, double speed, double seconds, double dt, Ride& ride) {
    const auto moved = [](const Ride& from, double by, const Ride& along) {
        return Ride{from.x + by * along.x, from.work + by * along.work, from.heat + by * along.heat};
    };
    double largest = 0;
    const int steps = static_cast<int>(std::lround(seconds / dt));
    for (int k = 0; k < steps; ++k) {
        const Ride k1 = rate(w, wheels, speed, ride), k2 = rate(w, wheels, speed, moved(ride, dt / 2, k1)),
                   k3 = rate(w, wheels, speed, moved(ride, dt / 2, k2)),
                   k4 = rate(w, wheels, speed, moved(ride, dt, k3));
        ride = moved(moved(moved(moved(ride, dt / 6, k1), dt / 3, k2), dt / 3, k3), dt / 6, k4);
        if (3 * k > 2 * steps) largest = std::max(largest, std::abs(ride.x[0]));
    }
    return largest;
}

}  // namespace

int main(int argc, char** argv) {
    const int speeds = argc > 1 ? std::atoi(argv[1]) : 4;
    if (speeds < 2 || speeds > 1000) {
        std::fprintf(stderr, "hunting: number of speeds = %s must be an integer in [2, 1000]\n", argv[1]);
        return 2;
    }
    const Wheelset w;
    const ElasticBody<double> steel{.young_modulus = 2.07e11, .poisson_ratio = 0.28};
    const HertzEllipse<double> hertz({.load = w.load,
                                      .radii_1 = {w.radius, std::numeric_limits<double>::infinity()},
                                      .radii_2 = {std::numeric_limits<double>::infinity(), 0.3},
                                      .body_1 = steel,
                                      .body_2 = steel});
    const PatchContact<double> contact = hertz.contact();
    const PatchMesh<double> mesh = patch_mesh(contact, 12, 12);
    const NodeDifference scheme{Nodes::chebyshev};
    const auto kalker = creep_coefficients(contact, solve_steady(contact, mesh, scheme));
    std::printf("contact: a = %.3f mm, b = %.3f mm, c11, c22, c23, c33 = %.4f %.4f %.4f %.4f\n",
                1e3 * contact.half_length(), 1e3 * contact.half_width(), kalker.c11, kalker.c22, kalker.c23,
                kalker.c33);

    // without inertia and springs, slowly: Klingel's wave
    Wheelset free = w;
    free.lateral_spring = free.yaw_spring = 0;
    const CreepMatrix law = -linear_law<double>(contact, kalker);
    const double crawl = 0.1, klingel = 2 * std::numbers::pi * std::sqrt(w.radius * w.half_gauge / w.conicity);
    const double wave =
        2 * std::numbers::pi * crawl / std::abs(least_damped(state_matrix(free, crawl, {law, law})).imag());
    std::printf("wavelength at walking pace: %.5f m, Klingel %.5f m\n", wave, klingel);

    const auto by_kalker = [&](double speed) { return least_damped(state_matrix(w, speed, {law, law})); };
    const double linear = critical_speed(5, 300, by_kalker);
    const double omega = std::abs(by_kalker(linear).imag());
    const FrequencySweep<double> sweep(patch_parts(mesh, scheme, HalfSpace<double>(0.28)));
    const double unsteady = critical_speed(w, contact, sweep, linear, omega);
    const Wheels wheels{make_table(contact), contact};
    const std::array<CreepMatrix, 2> at_rest = tangents(w, wheels, 0),
                                     at_spin = tangents(w, wheels, w.conicity / w.radius);
    const auto by_table = [&](double speed) { return least_damped(state_matrix(w, speed, at_spin)); };
    const double critical = critical_speed(5, 300, by_table);
    const double without_spin =
        critical_speed(5, 300, [&](double speed) { return least_damped(state_matrix(w, speed, at_rest)); });
    std::printf("critical speed by Kalker's coefficients: %.4f m/s\n", linear);
    std::printf("  by those of its frequency, omega a/V = %.5f: %+.1e of it\n", omega * contact.half_length() / linear,
                unsteady / linear - 1);
    std::printf("critical speed by the table without spin: %.4f m/s\n", without_spin);
    std::printf("  with the spin of the cones: %+.1e of it\n", critical / without_spin - 1);

    // 4. A small deviation grows as the eigenvalue says.
    const double faster = 1.02 * critical, dt = 2e-4;
    const Complex eigenvalue = by_table(faster);
    const double period = 2 * std::numbers::pi / std::abs(eigenvalue.imag());
    Ride ride;
    ride.x[0] = 1e-7;
    roll(w, wheels, faster, 3, dt, ride);
    const double before = roll(w, wheels, faster, 3 * period, dt, ride);
    roll(w, wheels, faster, 17 * period, dt, ride);
    const double after = roll(w, wheels, faster, 3 * period, dt, ride);
    const double growth = std::log(after / before) / (20 * period);
    std::printf("growth at %.2f m/s: %.4f 1/s in time, %.4f by the eigenvalue\n", faster, growth, eigenvalue.real());

    // 5. Amplitudes that last, from a small and a large deviation.
    std::printf("%10s %16s %16s %12s\n", "V m/s", "|y| small mm", "|y| large mm", "gap/heat");
    bool right = std::abs(wave / klingel - 1) < 1e-4 && std::abs(unsteady / linear - 1) < 1e-3 &&
                 std::abs(without_spin / linear - 1) < 2e-4 && std::abs(growth / eigenvalue.real() - 1) < 5e-3;
    for (int i = 0; i < speeds; ++i) {
        const double share = 0.9 + 0.3 * i / (speeds - 1), speed = share * critical;
        std::array<double, 2> lasting{};
        double worst = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            Ride start;
            start.x[0] = k == 0 ? 1e-3 : 10e-3;
            const double energy_before = energy(w, start.x);
            lasting[k] = roll(w, wheels, speed, 60, 5e-4, start);
            const double gap = start.work - start.heat - energy(w, start.x) + energy_before;
            worst = std::max(worst, std::abs(gap) / start.heat);
        }
        std::printf("%10.3f %16.5f %16.5f %12.1e\n", speed, 1e3 * lasting[0], 1e3 * lasting[1], worst);
        // above the critical speed the play is used up, from any deviation
        const bool hunts = lasting[0] > w.play && std::abs(lasting[0] / lasting[1] - 1) < 1e-3;
        const bool calm = lasting[0] < 1e-3 && lasting[1] < 1e-3;
        right = right && worst < 1e-4 && (share < 0.98 ? calm : share < 1.03 || hunts);
    }
    return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
