// A bogie with two S1002 wheelsets rolls steadily through curves of 60E1 rails, in balance by the tables of forces and
// their exact tangents: positions, heat of friction, the least damped motion, and whether Newton's method from the
// middle of the track and from 5 mm to either side finds one equilibrium.
//
//     ./examples/bogie_curve [step of the radius, percent]
//
// Curves turn right; cant balances the centrifugal force, and every wheel keeps its load.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <rollbem/compiled/wheelset.hpp>

namespace {

using namespace rollbem;

constexpr double load = 1e5, mu = 0.3, speed = 20, radius = 0.46;  // of each wheel [N], [-], [m/s], [m]
constexpr double lateral_spring = 5e6, yaw_spring = 1e7;           // of each axle in the frame [N/m], [N m/rad]
constexpr double damper = 1e4, half_wheelbase = 1.25;              // beside the lateral spring [N s/m], [m]

// Shifts and yaws of an axle are relative to the track where it is, those of the frame to the track at its middle. y to
// the right, yaw clockwise from above.
enum { y, yaw, pitch_rate, axle_size, frame_y = 2 * axle_size, frame_yaw, size };
using Vector = Eigen::Matrix<double, size, 1>;
using Matrix = Eigen::Matrix<double, size, size>;
constexpr std::array<int, 6> positions{y, axle_size + y, frame_y, yaw, axle_size + yaw, frame_yaw};

class Bogie {
public:
    double curvature = 0;          // positive to the right [1/m]
    std::array<double, 2> heat{};  // of each axle where growth was asked for, for each metre rolled [J/m]

    /// Newton's method from axles and frame beside the middle of the track [m]; nothing if it gets stuck.
    std::optional<Vector> balance(double shift) {
        Vector x{{shift, 0, -speed / radius, shift, 0, -speed / radius, shift, 0}}, rest = residual(x);
        const Vector arms{{1, 0.75, radius, 1, 0.75, radius, 1, 1}};  // of the moments [m]
        const auto norm = [&](const Vector& forces) { return forces.cwiseQuotient(arms).norm() / load; };
        for (int k = 0; k < 200 && !(norm(rest) < 1e-9); ++k) {
            const Vector step = by_position_.partialPivLu().solve(rest), from = x;
            double least = std::numeric_limits<double>::infinity();
            for (double part = 1; part > 1e-3; part /= 2) {  // the best of them, as forces bend where contacts jump
                const double left = norm(residual(from - part * step));
                if (left < least) x = from - part * step;
                least = std::min(least, left);
            }
            rest = residual(x);
        }
        return norm(rest) < 1e-9 ? std::optional(x) : std::nullopt;
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
        return Eigen::EigenSolver<Eigen::MatrixXd>(A(kept, kept), false).eigenvalues().real().maxCoeff();
    }

private:
    /// Forces and moments on axles and frame [N], [N m]; leaves their derivatives in by_position_ and by_speed_.
    Vector residual(const Vector& x) {
        static constexpr std::array rows{1, 5, 4};  // lateral force, moments about the vertical and about the axle
        Vector sum = Vector::Zero();
        by_position_ = by_speed_ = Matrix::Zero();
        heat = {};
        for (int axle = 0; axle < 2; ++axle) {
            const int first = axle_size * axle;
            const double along = axle == 0 ? half_wheelbase : -half_wheelbase;
            const WheelsetPosition at{.lateral = x[first + y], .yaw = x[first + yaw]};
            const WheelsetSpeeds speeds{speed, x[first + pitch_rate], 0, 0, 0, speed * curvature};
            const ContactTable::OnRails rails = geometry_.on_rails(at.lateral, at.yaw, {load, load});
            for (const WheelsetSide side : {WheelsetSide::left, WheelsetSide::right}) {
                const WheelForces now = geometry_.look_up(creep_, side, at, speeds, load, mu);
                const Eigen::Matrix<double, 3, WheelForces::inputs> by = now.tangent(rows, Eigen::all);
                heat[std::size_t(axle)] += now.heat / speed;
                sum.segment<axle_size>(first) += now.force(rows);
                by_position_.block<axle_size, axle_size>(first, first) +=
                    by(Eigen::all, std::array{WheelForces::lateral, WheelForces::yaw, WheelForces::pitch_rate});
                const auto fall = by.col(WheelForces::vertical_speed), roll = by.col(WheelForces::roll_rate);
                by_speed_.block<axle_size, 2>(first, first) +=
                    by(Eigen::all, std::array{WheelForces::lateral_speed, WheelForces::yaw_rate}) +
                    fall * Eigen::RowVector2d(rails.height_by_lateral, rails.height_by_yaw) +
                    roll * Eigen::RowVector2d(rails.roll_by_lateral, rails.roll_by_yaw);
            }
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

    ContactTable geometry_ = ContactTable::read(ROLLBEM_TABLES "/s1002_60e1.contact");
    CreepForceTable creep_ = CreepForceTable::read(ROLLBEM_TABLES "/steel.creep");
    Matrix by_position_, by_speed_;
};

}  // namespace

int main(int argc, char** argv) {
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
