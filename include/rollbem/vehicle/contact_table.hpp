// ContactTable: where the wheels of a wheelset touch real rails, over lateral shift and yaw, as a table; and with a
// table of creep forces all contact forces of a wheelset by look-up, with tangents.
#pragma once

#include "../detail/language.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <limits>
#include <ostream>
#include <utility>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "../detail/checked_stream.hpp"
#include "../detail/finite.hpp"
#include "../detail/require.hpp"
#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../scene/patch_contact.hpp"
#include "../scene/wheelset.hpp"
#include "../status.hpp"
#include "creep_force_table.hpp"
#include "detail/wheelset_velocity.hpp"

namespace rollbem {

/// Forces of the rail on one wheel.
struct WheelForces {
    /// What a wheel does at one of its points of contact, as on the right wheel.
    struct Point {
        double load_share = 0;        ///< of the wheel's vertical load, without friction [-]; 0: no contact, no numbers
        std::array<double, 3> arm{};  ///< of the point from the middle of the axle, in track axes [m]
        double angle = 0;             ///< delta of the plane [rad]
        double rolling_radius = 0;    ///< [m]
        double normal_load = 0;       ///< N [N]
        PatchContact<double> ellipse{{1, 1, 1, 0}};  ///< that the creep forces are those of
        Creepage<double> creepage{};                 ///< wheel minus rail, as creepage_of
        TangentialForce<double> force{};             ///< on the wheel, in the plane [N], [N m]
        double heat = 0;                             ///< that friction makes [W]
    };

    /// What a derivative of the forces is taken with respect to.
    enum Input : Eigen::Index {
        lateral,
        yaw,
        forward,
        pitch_rate,
        lateral_speed,
        vertical_speed,
        roll_rate,
        yaw_rate,
        load,
        mu,
        inputs
    };

    /// In track axes F_x, F_y, F_z [N], and M_x, M_y, M_z [N m] about the middle of the axle; NaN unless ok.
    Eigen::Matrix<double, 6, 1, Eigen::DontAlign> force =
        Eigen::Matrix<double, 6, 1, Eigen::DontAlign>::Constant(std::numeric_limits<double>::quiet_NaN());
    /// Their derivatives, a column for each Input in SI units; exact but at jumps, see ContactTable.
    Eigen::Matrix<double, 6, inputs, Eigen::DontAlign> tangent =
        Eigen::Matrix<double, 6, inputs, Eigen::DontAlign>::Zero();
    std::array<Point, 2> points;
    double heat = 0;  ///< of both points [W]
    /// wrong_table (the position lies beyond the table, or Poisson's ratios differ), invalid_load (load or mu is
    /// negative), invalid_step (the wheel does not roll: the mean of its speed and the circumferential one is 0),
    /// not_finite, no_solution (the rail cannot carry the load: friction holds the wheel up)
    StepStatus status = StepStatus::not_finite;

    auto derivative(Input input) const { return tangent.col(input); }
};

/// Rows of a point of contact in a ContactTable.
struct ContactRow {
    enum Of : Eigen::Index {
        arm_x,
        arm_y,
        arm_z,
        angle,
        length,  ///< a/N^(1/3) [m/N^(1/3)]
        width,   ///< b/N^(1/3)
        share,
        radius,
        c11,  ///< of the ellipse; so are the next two
        c22,
        c23,
        kept,        ///< of the correction in full sliding, 0 to 1
        correction,  ///< 3 x 3 by rows, minus the identity: of (xi, eta, phi c), so that the ellipse has the patch's
                     ///< forces
        point_rows = correction + 9,
    };
};

namespace detail {

/// The creepages at which an ellipse has the forces of the patch that it stands for, from those of the patch: E^-1 L
/// times them as far as the contact sticks, in full sliding those of rigid bodies. `of(row)` are numbers of the point,
/// `bound` is mu N. The share of sticking is 1 - |u| of CreepForceGrid.
template <class Scalar, class Rows>
std::array<Scalar, 3> ellipse_creepages(const std::array<Scalar, 3>& creepage, const Scalar& a, const Scalar& b,
                                        double shear_modulus, const Scalar& bound, const Rows& of) {
    using std::sqrt;
    using enum ContactRow::Of;
    const Scalar &xi = creepage[0], &eta = creepage[1];
    const Scalar c = sqrt(a * b), spin = creepage[2] * c;
    const Scalar along = of(c11) * xi, across = of(c22) * eta + of(c23) * spin;
    const Scalar turning = of(c11) * of(c22) * spin * spin, square = along * along + across * across + turning;
    const Scalar slip = sqrt(square + Scalar(1e-200)) * (shear_modulus * a * b);  // no division by 0 in its derivative
    const Scalar sticking = bound * CreepForceGrid::half_way;
    const Scalar sum = sticking + slip;
    const Scalar reach = sum > 0 ? Scalar(of(kept) + (1 - of(kept)) * sticking / sum) : Scalar(1);
    const auto corrected = [&](const Scalar& own, Eigen::Index row) -> Scalar {
        const Eigen::Index entry = correction + 3 * row;
        return own + reach * (of(entry) * xi + of(entry + 1) * eta + of(entry + 2) * spin);
    };
    return {corrected(xi, 0), corrected(eta, 1), corrected(spin, 2) / c};
}

}  // namespace detail

/// Geometry of contact by look-up: for the right wheel and up to two points the place, angle and rolling radius, the
/// share of the load and an ellipse for the creep forces; the left wheel is its mirror image. Made by
/// make_contact_table().
///
/// Along the shift values follow monotone cubic splines (C1, no overshoot), across the yaw cubic convolution (C1).
/// Points of contact jump on real profiles: then the load goes over from one point to the other within a few hundredths
/// of a millimetre, as the table has it at its nodes, and continuously in between, so that forces have no steps and
/// nothing chatters; a jump narrower than the step of the table is spread over it. A point without load is where the
/// nearest one with load is. Loads differ from those of the table by Hertz's law: a, b grow as the cube root of the
/// normal load; places and shares stay. Immutable: threads may share it.
class ContactTable {
public:
    /// Positions of a table: lateral shifts and yaw angles in equal steps, from minus the largest to the largest.
    ///
    /// Invariant: shifts and yaws are odd, from 5 to 10001 and from 3 to 1001; the largest are positive and finite.
    struct Grid {
        double largest_shift = 9e-3;  ///< [m]
        Eigen::Index shifts = 181;
        double largest_yaw = 15e-3;  ///< [rad]
        Eigen::Index yaws = 13;

        double shift(Eigen::Index i) const { return largest_shift * (2 * double(i) / double(shifts - 1) - 1); }
        double yaw(Eigen::Index k) const { return largest_yaw * (2 * double(k) / double(yaws - 1) - 1); }
        Eigen::Index nodes() const { return shifts * yaws; }
    };

    /// Height and roll of a wheelset whose wheels carry equal loads, and their derivatives.
    struct OnRails {
        double height = 0, roll = 0;                        ///< [m], [rad]
        double height_by_lateral = 0, roll_by_lateral = 0;  ///< [-], [rad/m]
        double height_by_yaw = 0, roll_by_yaw = 0;          ///< [m/rad], [-]
    };

    /// Rows of a column of nodes: those of both points, each as ContactRow, then
    enum Row : Eigen::Index { height = 2 * ContactRow::point_rows, roll, rows };

    /// `values`: the rows of all nodes, for each yaw in turn all shifts. `nominal_load` is that of a wheel. Throws
    /// std::invalid_argument if the grid breaks its invariant, the number of nodes differs, or one of the values is not
    /// finite.
    ContactTable(const Grid& grid, double nominal_load, double shear_modulus, double poisson_ratio,
                 Eigen::ArrayXXd values);

    /// From what write() wrote; throws as CreepForceTable::read does.
    static ContactTable read(std::istream& stream);
    static ContactTable read(const std::filesystem::path& path) { return detail::read_file<ContactTable>(path, name); }

    /// Little-endian, version 1: the text "rollbem contact geometry", version, numbers of shifts and yaws (32 bits
    /// each), largest shift and yaw, nominal load, G, nu, the mean of each row (64 bits each), and for each node the
    /// rows minus their means (32 bits each), then the checksum FNV-1a of all bytes before (64 bits).
    void write(std::ostream& stream) const;

    const Grid& grid() const { return grid_; }
    double nominal_load() const { return nominal_load_; }  ///< vertical, of each wheel [N]
    double shear_modulus() const { return shear_modulus_; }
    double poisson_ratio() const { return poisson_ratio_; }
    const Eigen::ArrayXXd& values() const { return values_; }

    bool covers(double lateral, double yaw) const {
        return std::abs(lateral) <= grid_.largest_shift * (1 + 1e-12) &&
               std::abs(yaw) <= grid_.largest_yaw * (1 + 1e-12);
    }

    /// The position must be covered.
    OnRails on_rails(double lateral, double yaw) const noexcept;

    /// The forces of one wheel under a vertical load [N] with the coefficient of friction mu. Lateral shift and yaw of
    /// `position` count; vertical speed and roll rate are those that the vehicle has, for one that follows its rails
    /// those of on_rails(). N follows from the load, N cos delta - F_s sin delta, by Newton's method. A point that
    /// carries less than 1e-100 N carries none; above 1e150 N the status is invalid_load. Does not allocate.
    template <std::same_as<double> Scalar = double>  // for rollbem::compiled
    WheelForces look_up(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                        const WheelsetSpeeds& speeds, double load, double friction_coefficient) const noexcept;

private:
    static constexpr const char* name = "ContactTable";
    static constexpr const char* magic = "rollbem contact geometry";
    static constexpr std::uint32_t version = 1;

    /// A cell of the grid, and the weights of its nodes in values and derivatives.
    struct Cell {
        Eigen::Index shift, yaw;
        std::array<double, 4> along, along_rate, across, across_rate;
    };
    Cell cell(double lateral, double yaw) const noexcept;
    /// Some rows of the table; those of a point with the one behind them, as an even number is quick.
    static constexpr int whole_packets = static_cast<int>(ContactRow::point_rows) + 1;
    template <int Rows>
    struct Sample {
        using Values = Eigen::Array<double, Rows, 1>;
        Values value = Values::Zero(), by_shift = value, by_yaw = value;
    };
    template <int Rows>
    Sample<Rows> sample(const Cell& cell, Eigen::Index first) const noexcept;

    // By WheelForces::Input, then by the normal load of the point; the last is 0, for a whole number of packets.
    static constexpr Eigen::Index by_load = WheelForces::inputs, partials = by_load + 2;
    using Gradient = Eigen::Matrix<double, partials, 1>;
    using Dual = Eigen::AutoDiffScalar<Gradient>;
    template <int Rows>
    static Dual dual(const Sample<Rows>& at, Eigen::Index row) {
        Dual found(at.value[row], Gradient::Zero());
        found.derivatives()[0] = at.by_shift[row];
        found.derivatives()[1] = at.by_yaw[row];
        return found;
    }

    Grid grid_;
    double nominal_load_, shear_modulus_, poisson_ratio_;
    Eigen::ArrayXXd values_, slopes_;  ///< slopes by the shift, over its step
};

inline ContactTable::ContactTable(const Grid& grid, double nominal_load, double shear_modulus, double poisson_ratio,
                                  Eigen::ArrayXXd values)
    : grid_(grid),
      nominal_load_(nominal_load),
      shear_modulus_(shear_modulus),
      poisson_ratio_(poisson_ratio),
      values_(std::move(values)) {
    detail::require_positive(name, "largest_shift", grid_.largest_shift);
    detail::require_positive(name, "largest_yaw", grid_.largest_yaw);
    detail::require(grid_.shifts % 2 == 1 && grid_.shifts >= 5 && grid_.shifts <= 10001, name, "shifts", grid_.shifts,
                    "be odd, from 5 to 10001");
    detail::require(grid_.yaws % 2 == 1 && grid_.yaws >= 3 && grid_.yaws <= 1001, name, "yaws", grid_.yaws,
                    "be odd, from 3 to 1001");
    detail::require_positive(name, "nominal_load", nominal_load_);
    detail::require_positive(name, "shear_modulus", shear_modulus_);
    detail::require_poisson_ratio(name, poisson_ratio_);
    detail::require(values_.rows() == rows && values_.cols() == grid_.nodes(), name, "number of nodes", values_.cols(),
                    "be that of the grid");
    detail::require(values_.isFinite().all(), name, "values", "not finite", "be finite");
    // central differences, limited to three times the smaller one-sided one: monotone (Fritsch and Carlson 1980)
    slopes_.resize(rows, grid_.nodes());
    for (Eigen::Index node = 0; node < grid_.nodes(); ++node) {
        const Eigen::Index i = node % grid_.shifts;
        if (i == 0 || i + 1 == grid_.shifts) {
            const Eigen::Index step = i == 0 ? 1 : -1;
            slopes_.col(node) = double(step) * (values_.col(node + step) - values_.col(node));
            continue;
        }
        const Eigen::ArrayXd before = values_.col(node) - values_.col(node - 1),
                             after = values_.col(node + 1) - values_.col(node), mean = (before + after) / 2;
        const Eigen::ArrayXd most = 3 * before.abs().cwiseMin(after.abs());
        slopes_.col(node) = (before * after > 0).select(mean.cwiseMin(most).cwiseMax(-most), 0);
    }
}

inline auto ContactTable::cell(double lateral, double yaw) const noexcept -> Cell {
    const double i_at = (lateral / grid_.largest_shift + 1) / 2 * double(grid_.shifts - 1),
                 k_at = (yaw / grid_.largest_yaw + 1) / 2 * double(grid_.yaws - 1);
    const auto i = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(i_at), 0, grid_.shifts - 2),
               k = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(k_at), 0, grid_.yaws - 2);
    const double t = i_at - double(i), u = k_at - double(k);
    Cell found{
        i,
        k,
        {(1 + 2 * t) * (1 - t) * (1 - t), t * t * (3 - 2 * t), t * (1 - t) * (1 - t), t * t * (t - 1)},
        {6 * t * (t - 1), 6 * t * (1 - t), (1 - t) * (1 - 3 * t), t * (3 * t - 2)},
        {-u * (1 - u) * (1 - u) / 2, 1 + u * u * (1.5 * u - 2.5), u * (0.5 + u * (2 - 1.5 * u)), u * u * (u - 1) / 2},
        {-(1 - u) * (1 - 3 * u) / 2, u * (4.5 * u - 5), 0.5 + u * (4 - 4.5 * u), u * (1.5 * u - 1)}};
    for (double& rate : found.along_rate) rate *= double(grid_.shifts - 1) / (2 * grid_.largest_shift);
    for (double& rate : found.across_rate) rate *= double(grid_.yaws - 1) / (2 * grid_.largest_yaw);
    for (auto* weights : {&found.across, &found.across_rate}) {  // beyond the ends values go on linearly
        auto& w = *weights;
        if (k == 0) {
            w[1] += 2 * w[0];
            w[2] -= std::exchange(w[0], 0.0);
        }
        if (k + 2 == grid_.yaws) {
            w[2] += 2 * w[3];
            w[1] -= std::exchange(w[3], 0.0);
        }
    }
    return found;
}

template <int Rows>
auto ContactTable::sample(const Cell& cell, Eigen::Index first) const noexcept -> Sample<Rows> {
    Sample<Rows> found;
    const Eigen::Index last = (std::min)(cell.yaw + 2, grid_.yaws - 1);
    for (Eigen::Index row = (std::max<Eigen::Index>)(cell.yaw - 1, 0); row <= last; ++row) {
        const Eigen::Index node = row * grid_.shifts + cell.shift;
        const auto own = static_cast<std::size_t>(row - cell.yaw + 1);
        const auto blend = [&](const std::array<double, 4>& weights) -> Eigen::Array<double, Rows, 1> {
            return weights[0] * values_.col(node).segment<Rows>(first) +
                   weights[1] * values_.col(node + 1).segment<Rows>(first) +
                   weights[2] * slopes_.col(node).segment<Rows>(first) +
                   weights[3] * slopes_.col(node + 1).segment<Rows>(first);
        };
        const Eigen::Array<double, Rows, 1> at = blend(cell.along);
        found.value += cell.across[own] * at;
        found.by_yaw += cell.across_rate[own] * at;
        found.by_shift += cell.across[own] * blend(cell.along_rate);
    }
    return found;
}

inline auto ContactTable::on_rails(double lateral, double yaw) const noexcept -> OnRails {
    const Sample<2> at = sample<2>(cell(lateral, yaw), height);
    return {at.value[0], at.value[1], at.by_shift[0], at.by_shift[1], at.by_yaw[0], at.by_yaw[1]};
}

template <std::same_as<double> Scalar>
WheelForces ContactTable::look_up(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                                  const WheelsetSpeeds& speeds, double load,
                                  double friction_coefficient) const noexcept {
    using enum ContactRow::Of;
    WheelForces result;
    const double mirror = side == WheelsetSide::left ? -1 : 1;
    std::array<double, WheelForces::inputs> inputs{mirror * position.lateral, mirror * position.yaw,    speeds.forward,
                                                   speeds.pitch_rate,         mirror * speeds.lateral,  speeds.vertical,
                                                   mirror * speeds.roll_rate, mirror * speeds.yaw_rate, load,
                                                   friction_coefficient};
    for (const double input : inputs) {
        if (!detail::is_finite(input)) return result;
    }
    constexpr double least = 1e-100, most = 1e150;  // [N]: less is none, and under more an ellipse has no size
    if (!(load >= 0 && load <= most && friction_coefficient >= 0)) {
        result.status = StepStatus::invalid_load;
        return result;
    }
    if (!covers(position.lateral, position.yaw)) {
        result.status = StepStatus::wrong_table;
        return result;
    }
    // rolling backwards is the mirror image, across the track, of rolling forward
    const double tread = sample<1>(cell(inputs[0], inputs[1]), radius).value[0];
    const double along = speeds.forward - speeds.pitch_rate * tread < 0 ? -1 : 1;
    for (const auto which : {WheelForces::yaw, WheelForces::forward, WheelForces::pitch_rate, WheelForces::yaw_rate}) {
        inputs[static_cast<std::size_t>(which)] *= along;
    }
    const auto input = [&](WheelForces::Input which) {
        return Dual(inputs[static_cast<std::size_t>(which)], partials, static_cast<int>(which));
    };
    const Cell at = cell(inputs[0], inputs[1]);
    const Dual mu = input(WheelForces::mu);
    const detail::WheelsetVelocity<Dual> velocity(
        {input(WheelForces::forward), input(WheelForces::pitch_rate), input(WheelForces::lateral_speed),
         input(WheelForces::vertical_speed), input(WheelForces::roll_rate), input(WheelForces::yaw_rate)},
        dual(sample<1>(at, roll), 0), input(WheelForces::yaw));
    std::array<Dual, 6> sum;
    sum.fill(Dual(0, Gradient::Zero()));
    for (std::size_t k = 0; k < 2; ++k) {
        const auto first = static_cast<Eigen::Index>(k) * point_rows;
        Dual part = dual(sample<1>(at, first + share), 0);
        if (part.value() > 1) part = Dual(1, Gradient::Zero());
        if (!(part.value() > 0) || part.value() * load < least) continue;
        const auto rows_of = sample<whole_packets>(at, first);
        const auto point = [&](Eigen::Index row) { return dual(rows_of, row); };
        WheelForces::Point& found = result.points[k];
        const Dual r_x = point(arm_x), r_y = point(arm_y), r_z = point(arm_z), delta = point(angle), r = point(radius);
        const Dual sine = sin(delta), cosine = cos(delta);
        const Dual reference = (input(WheelForces::forward) - input(WheelForces::pitch_rate) * r) * 0.5;
        if (!(reference.value() >= (std::numeric_limits<double>::min)())) {
            result.status = StepStatus::invalid_step;
            return result;
        }
        const std::array<Dual, 3> slip = velocity.slip({r_x, r_y, r_z}, sine, cosine);
        const Dual xi = slip[0] / reference, eta = slip[1] / reference, phi = slip[2] / reference;
        const Dual wanted = part * input(WheelForces::load);

        // the creep forces under a normal load
        std::array<Dual, 3> force;
        const auto press = [&](double normal_load) {
            Dual N(normal_load, partials, by_load);
            const double root = std::cbrt(normal_load);
            Dual size(root, Gradient::Zero());
            size.derivatives()[by_load] = root / (3 * normal_load);
            const Dual a = point(length) * size, b = point(width) * size;
            const std::array<Dual, 3> own = detail::ellipse_creepages<Dual>(
                {xi, eta, phi}, a, b, shear_modulus_, mu * N, [&](Eigen::Index row) { return point(row); });
            found.ellipse = PatchContact<double>({a.value(), b.value(), shear_modulus_, poisson_ratio_});
            const TabulatedForce now = creep.look_up(found.ellipse, friction_coefficient, normal_load,
                                                     {own[0].value(), own[1].value(), own[2].value()});
            const auto combine = [&](auto part_of) {
                return Dual(part_of(now.force), part_of(now.tangent.by_longitudinal) * own[0].derivatives() +
                                                    part_of(now.tangent.by_lateral) * own[1].derivatives() +
                                                    part_of(now.tangent.by_spin) * own[2].derivatives() +
                                                    part_of(now.tangent_by_load) * N.derivatives() +
                                                    part_of(now.tangent_by_friction_coefficient) * mu.derivatives() +
                                                    part_of(now.tangent_by_half_length) * a.derivatives() +
                                                    part_of(now.tangent_by_half_width) * b.derivatives());
            };
            force = {combine([](const TangentialForce<double>& f) { return f.longitudinal; }),
                     combine([](const TangentialForce<double>& f) { return f.lateral; }),
                     combine([](const TangentialForce<double>& f) { return f.moment; })};
            return std::pair(N, now.status);
        };
        // 1. nearly: a step of Newton's method without the change of the correction
        double normal_load = wanted.value() / cosine.value();
        {
            const double root = std::cbrt(normal_load), a = root * rows_of.value[length],
                         b = root * rows_of.value[width];
            const auto [xi_1, eta_1, phi_1] = detail::ellipse_creepages<double>(
                {xi.value(), eta.value(), phi.value()}, a, b, shear_modulus_, friction_coefficient * normal_load,
                [&](Eigen::Index row) { return rows_of.value[row]; });
            const PatchContact<double> ellipse({a, b, shear_modulus_, poisson_ratio_});
            const TabulatedForce now = creep.look_up(ellipse, friction_coefficient, normal_load, {xi_1, eta_1, phi_1});
            const double by_size = a * now.tangent_by_half_length.lateral + b * now.tangent_by_half_width.lateral;
            const double growth = now.tangent_by_load.lateral + by_size / (3 * normal_load);
            const double change = now.force.lateral * sine.value() / (cosine.value() - growth * sine.value());
            if (now.status == StepStatus::ok) normal_load += (std::clamp)(change, -normal_load / 2, normal_load);
        }
        // 2. by Newton's method with tangents, whose last step is taken along them
        bool settled = false;
        for (int round = 0; round < 30 && !settled; ++round) {
            if (!(normal_load > 0 && detail::is_finite(normal_load))) break;
            const auto [N, status] = press(normal_load);
            if (status != StepStatus::ok) {
                result.status = status;
                return result;
            }
            const Dual excess = N * cosine - force[1] * sine - wanted;
            const double slope = excess.derivatives()[by_load], change = excess.value() / slope;
            settled = std::abs(change) <= 1e-6 * normal_load;
            normal_load -= (std::clamp)(change, -normal_load, normal_load / 2);
            if (!settled) continue;
            // N is the function of the inputs that keeps the excess at 0
            Gradient by_inputs = -excess.derivatives() / slope;
            by_inputs[by_load] = 0;
            for (Dual& one : force) {
                const double slope_of_one = std::exchange(one.derivatives()[by_load], 0.0);
                one.value() -= slope_of_one * change;
                one.derivatives() += slope_of_one * by_inputs;
            }
            const Dual carried(normal_load, by_inputs);
            const Dual f_y = force[1] * cosine + carried * sine, f_z = force[1] * sine - carried * cosine;
            sum[0] += force[0];
            sum[1] += f_y;
            sum[2] += f_z;
            sum[3] += r_y * f_z - r_z * f_y;
            sum[4] += r_z * force[0] - r_x * f_z - force[2] * sine;
            sum[5] += r_x * f_y - r_y * force[0] + force[2] * cosine;
        }
        if (!settled) {
            result.status = StepStatus::no_solution;
            return result;
        }
        found.load_share = part.value();
        found.arm = {along * r_x.value(), r_y.value(), r_z.value()};
        found.angle = delta.value();
        found.rolling_radius = r.value();
        found.normal_load = normal_load;
        found.creepage = {along * xi.value(), eta.value(), along * phi.value()};
        found.force = {along * force[0].value(), force[1].value(), along * force[2].value()};
        found.heat = -reference.value() *
                     (found.force.longitudinal * found.creepage.longitudinal +
                      found.force.lateral * found.creepage.lateral + found.force.moment * found.creepage.spin);
        result.heat += found.heat;
    }
    // the left wheel is the mirror image
    const std::array<double, 6> signs{along, mirror, 1, mirror, along, along * mirror};
    const std::array<double, WheelForces::inputs> turned{mirror, along * mirror, along,          along, mirror,
                                                         1,      mirror,         along * mirror, 1,     1};
    for (Eigen::Index i = 0; i < 6; ++i) {
        const auto own = static_cast<std::size_t>(i);
        result.force[i] = signs[own] * sum[own].value();
        for (Eigen::Index j = 0; j < WheelForces::inputs; ++j) {
            result.tangent(i, j) = signs[own] * turned[static_cast<std::size_t>(j)] * sum[own].derivatives()[j];
        }
    }
    result.status =
        detail::is_finite(result.force.sum() + result.tangent.sum()) ? StepStatus::ok : StepStatus::not_finite;
    return result;
}

inline void ContactTable::write(std::ostream& stream) const {
    detail::CheckedWriter writer(stream, magic);
    for (const Eigen::Index count : {Eigen::Index(version), grid_.shifts, grid_.yaws}) {
        writer.integer(static_cast<std::uint32_t>(count));
    }
    const Eigen::ArrayXd means = values_.rowwise().mean();
    for (const double value : {grid_.largest_shift, grid_.largest_yaw, nominal_load_, shear_modulus_, poisson_ratio_}) {
        writer.number(value);
    }
    for (const double mean : means) writer.number(mean);
    for (Eigen::Index node = 0; node < grid_.nodes(); ++node) {
        for (Eigen::Index row = 0; row < rows; ++row)
            writer.number(static_cast<float>(values_(row, node) - means[row]));
    }
    writer.finish();
}

inline ContactTable ContactTable::read(std::istream& stream) {
    detail::CheckedReader reader(stream, name, magic);
    const auto found = reader.integer<std::uint32_t>();
    detail::require(found == version, name, "version", found, "be 1");
    Grid grid;
    grid.shifts = reader.integer<std::uint32_t>();
    grid.yaws = reader.integer<std::uint32_t>();
    detail::require(grid.shifts <= 10001 && grid.yaws <= 1001, name, "number of nodes", grid.nodes(),
                    "be at most 10001 times 1001");
    grid.largest_shift = reader.number();
    grid.largest_yaw = reader.number();
    const double load = reader.number(), G = reader.number(), nu = reader.number();
    Eigen::ArrayXd means(rows);
    for (double& mean : means) mean = reader.number();
    Eigen::ArrayXXd values(Eigen::Index(rows), grid.nodes());
    for (Eigen::Index node = 0; node < grid.nodes(); ++node) {
        for (Eigen::Index row = 0; row < rows; ++row) values(row, node) = means[row] + double(reader.single());
    }
    reader.finish();
    return {grid, load, G, nu, std::move(values)};
}

}  // namespace rollbem
