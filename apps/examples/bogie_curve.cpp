// A bogie with two S1002 wheelsets rolls steadily through curves of 60E1 rails, in balance by the tables of forces and
// their exact tangents: positions, heat of friction, the least damped motion, and whether Newton's method from the
// middle of the track and from 5 mm to either side finds one equilibrium.
//
//     ./examples/bogie_curve [step of the radius, percent]
//     ./examples/bogie_curve patches [radius, m]...
//
// Curves turn right; cant balances the centrifugal force, and every wheel keeps its load. The second form compares the
// balance by friction on patches, with the least damped motion by central differences.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/wheel_on_rail.hpp>
#include <rollbem/vehicle/contact_table.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>
#include <rollbem/vehicle/wheelset_forces.hpp>

namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 20, radius = 0.46;  // of each wheel [N], [-], [m/s], [m]
constexpr double lateral_spring = 5e6, yaw_spring = 1e7;           // of each axle in the frame [N/m], [N m/rad]
constexpr double damper = 1e4, half_wheelbase = 1.25;              // beside the lateral spring [N s/m], [m]

// Shift and yaw of an axle are relative to the track at the axle, shift and yaw of the frame to the track at its
// middle. y points to the right, yaw turns clockwise from above.
enum { y, yaw, pitch_rate, axle_size, frame_y = 2 * axle_size, frame_yaw, size };
using Vector = Eigen::Matrix<double, size, 1>;
using Matrix = Eigen::Matrix<double, size, size>;
constexpr std::array<int, 6> positions{y, axle_size + y, frame_y, yaw, axle_size + yaw, frame_yaw};

/// Lateral force, moments about the vertical and about the axle [N], [N m]; their derivatives with respect to shift,
/// yaw, pitch rate, lateral speed, yaw rate, vertical speed and roll rate.
struct AxleForces {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 3, 7> by = decltype(by)::Zero();
    double heat = 0;  // [W]
};

class Bogie {
public:
    double curvature = 0;          // positive to the right [1/m]
    double patch_step = 0;         // of the shift, for differences of friction on patches [m]; 0: by tables
    std::array<double, 2> heat{};  // of each axle where growth was asked for, for each metre rolled [J/m]

    /// Newton's method from axles and frame beside the middle of the track [m]; nothing if it gets stuck.
    std::optional<Vector> balance(double shift) {
        return balance(Vector{{shift, 0, -speed / radius, shift, 0, -speed / radius, shift, 0}});
    }
    std::optional<Vector> balance(Vector x) {
        const double precise = patch_step > 0 ? 1e-4 : 1e-9;  // patches carry their loads to 1e-6, and jump a little
        Vector rest = residual(x);
        const Vector arms{{1, 0.75, radius, 1, 0.75, radius, 1, 1}};  // of the moments [m]
        const auto norm = [&](const Vector& forces) { return forces.cwiseQuotient(arms).norm() / load; };
        for (int k = 0; k < 200 && !(norm(rest) < precise); ++k) {
            const Vector step = Eigen::MatrixXd(by_position_).partialPivLu().solve(rest), from = x;
            double least = std::numeric_limits<double>::infinity();
            for (double part = 1; part > 1e-3; part /= 2) {  // the best of them, as forces bend where contacts jump
                const double left = norm(residual(from - part * step));
                if (left < least) x = from - part * step;
                least = std::min(least, left);
            }
            rest = residual(x);
        }
        return norm(rest) < precise ? std::optional(x) : std::nullopt;
    }

    /// The largest growth of a small deviation from an equilibrium [1/s]. Height and roll follow the rails.
    double growth(const Vector& x) {
        residual(x);
        const Vector mass{{1813, 1120, 112, 1813, 1120, 112, 2615, 3067}};  // [kg], [kg m^2]
        // of positions and speeds; nothing depends on angles of pitch, which are left out in the end
        Eigen::MatrixXd A(2 * size, 2 * size);
        A << Matrix::Zero(), Matrix::Identity(), by_position_, by_speed_;
        A.bottomRows<size>().array().colwise() /= mass.array();
        for (const int pitch : {int(pitch_rate), axle_size + pitch_rate}) A.col(size + pitch) += A.col(pitch);
        std::array<int, positions.size() + size> kept{};
        std::iota(std::ranges::copy(positions, kept.begin()).out, kept.end(), int(size));
        const Eigen::MatrixXd moving = A(kept, kept);
        return Eigen::EigenSolver<Eigen::MatrixXd>(moving, false).eigenvalues().real().maxCoeff();
    }

private:
    AxleForces by_tables(const WheelsetPosition& at, const WheelsetSpeeds& speeds) const {
        AxleForces sum;
        for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
            const WheelForces now = geometry_.look_up(creep_, side, at, speeds, load, mu);
            sum.force += now.force(rows);
            using enum WheelForces::Input;
            sum.by +=
                now.tangent(rows, std::array<Eigen::Index, 7>{lateral, WheelForces::yaw, WheelForces::pitch_rate,
                                                              lateral_speed, yaw_rate, vertical_speed, roll_rate});
            sum.heat += now.heat;
        }
        return sum;
    }
    AxleForces by_patches(const WheelsetPosition& at, const WheelsetSpeeds& speeds) {
        const auto forces = [&](const WheelsetPosition& there, const WheelsetSpeeds& moving) -> Eigen::Vector3d {
            const auto now = rolling_forces(
                track_, {.position = there, .loads = {load, load}, .speeds = moving, .free_pitch = false},
                {.coefficient = mu}, workspace_);
            return {now.on_wheelset.force[1], now.on_wheelset.moment[2], now.on_wheelset.moment[1]};
        };
        AxleForces sum{.force = forces(at, speeds)};
        const std::array<double, 7> steps{patch_step, patch_step / 2, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3};
        for (int k = 0; k < 7; ++k) {
            const auto moved = [&](double by) {
                WheelsetPosition there = at;
                WheelsetSpeeds moving = speeds;
                const std::array input{&there.lateral,   &there.yaw,       &moving.pitch_rate, &moving.lateral,
                                       &moving.yaw_rate, &moving.vertical, &moving.roll_rate};
                *input[std::size_t(k)] += by;
                return forces(there, moving);
            };
            const double step = steps[std::size_t(k)];
            sum.by.col(k) = (moved(step) - moved(-step)) / (2 * step);
        }
        return sum;
    }

    /// Forces and moments on axles and frame [N], [N m]; leaves their derivatives in by_position_ and by_speed_.
    Vector residual(const Vector& x) {
        Vector sum = Vector::Zero();
        by_position_ = by_speed_ = Matrix::Zero();
        heat = {};
        for (int axle = 0; axle < 2; ++axle) {
            const int first = axle_size * axle;
            const double along = axle == 0 ? half_wheelbase : -half_wheelbase;
            const WheelsetPosition at{.lateral = x[first + y], .yaw = x[first + yaw]};
            const WheelsetSpeeds speeds{speed, x[first + pitch_rate], 0, 0, 0, speed * curvature};
            const ContactTable::OnRails rails = geometry_.on_rails(at.lateral, at.yaw, {load, load});
            const AxleForces now = patch_step > 0 ? by_patches(at, speeds) : by_tables(at, speeds);
            heat[std::size_t(axle)] = now.heat / speed;
            sum.segment<axle_size>(first) += now.force;
            by_position_.block<axle_size, axle_size>(first, first) += now.by.leftCols<3>();
            by_speed_.block<axle_size, 2>(first, first) +=
                now.by.middleCols<2>(3) +
                now.by.col(5) * Eigen::RowVector2d(rails.height_by_lateral, rails.height_by_yaw) +
                now.by.col(6) * Eigen::RowVector2d(rails.roll_by_lateral, rails.roll_by_yaw);
            // In the axes of the frame's place the track bends to y = curvature x^2/2 with the direction curvature x:
            // the axle is there at its own shift plus that and turned by its own yaw plus this, its seat in the frame
            // at the frame's shift + x times its yaw, turned by that yaw.
            const Vector shift = Vector::Unit(first + y) - Vector::Unit(frame_y) - along * Vector::Unit(frame_yaw),
                         turn = Vector::Unit(first + yaw) - Vector::Unit(frame_yaw);
            sum -= lateral_spring * (shift.dot(x) + curvature * along * along / 2) * shift +
                   yaw_spring * (turn.dot(x) + curvature * along) * turn;
            by_position_ -= lateral_spring * shift * shift.transpose() + yaw_spring * turn * turn.transpose();
            by_speed_ -= damper * shift * shift.transpose();
        }
        return sum;
    }

    static constexpr std::array rows{1, 5, 4};  // lateral force, moments about the vertical and about the axle
    WheelsetOnTrack track_{WheelOnRail(s1002(), rail_60e1())};
    WheelsetOnTrack::Workspace workspace_;
    ContactTable geometry_ = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
    CreepForceTable creep_ = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    Matrix by_position_, by_speed_;
};

/// Balance by tables and, from there, by patches.
int compare(int count, char** radii) {
    bool all = count > 0;
    std::puts(
        "# R m, growth 1/s, y and yaw of axles and frame mm, mrad: by tables, then by patches with 10, 20, 40 um");
    for (int k = 0; k < count; ++k) {
        const double radius_of_curve = std::atof(radii[k]);
        if (!(radius_of_curve >= 300)) {
            std::fprintf(stderr, "bogie_curve: radius of the curve = %s m must be at least 300\n", radii[k]);
            return 2;
        }
        Bogie bogie;
        bogie.curvature = 1 / radius_of_curve;
        std::optional<Vector> x = bogie.balance(0);
        for (const double step : {0.0, 1e-5, 2e-5, 4e-5}) {
            bogie.patch_step = step;
            if (x && step == 1e-5) x = bogie.balance(*x);
            all = all && x;
            if (!x) continue;
            std::printf("%8.2f %8.4f", 1 / bogie.curvature, bogie.growth(*x));
            for (const int i : positions) std::printf(" %8.4f", 1e3 * (*x)[i]);
            std::puts("");
            std::fflush(stdout);
        }
    }
    return all ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && std::strcmp(argv[1], "patches") == 0) return compare(argc - 2, argv + 2);
    const double percent = argc > 1 ? std::atof(argv[1]) : 10;
    if (!(percent >= 0.01 && percent <= 900)) {
        std::fprintf(stderr, "bogie_curve: step of the radius = %g %% must lie in [0.01, 900]\n", percent);
        return 2;
    }
    Bogie bogie;
    int radii = 0, single = 0, several = 0;
    std::puts("# R m, growth 1/s, y and yaw of axles and frame mm, mrad, heat J/m, starts that converge, equilibria");
    for (double R = 300; R < 3000 * (1 + 1e-9); R *= 1 + percent / 100) {
        bogie.curvature = 1 / R;
        std::vector<Vector> found;  // that differ
        int converged = 0;
        for (const double shift : {0.0, 5e-3, -5e-3}) {
            const std::optional<Vector> x = bogie.balance(shift);
            const auto same = [&](const Vector& other) { return (*x - other)(positions).norm() < 1e-6; };
            if (x && std::ranges::none_of(found, same)) found.push_back(*x);
            converged += int(x.has_value());
        }
        for (const Vector& x : found) {
            std::printf("%8.2f %8.4f", R, bogie.growth(x));
            for (const int k : positions) std::printf(" %8.4f", 1e3 * x[k]);
            std::printf(" %8.3f %8.3f %d %zu\n", bogie.heat[0], bogie.heat[1], converged, found.size());
        }
        ++radii;
        single += int(converged == 3 && found.size() == 1);
        several += int(found.size() > 1);
    }
    std::printf("# %d radii: all starts give one equilibrium at %d, more are found at %d\n", radii, single, several);
    return several == 0 && single > 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
