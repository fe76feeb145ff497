// The look-up of a wheel's forces in a ContactTable, step by step. Internal; include vehicle/contact_table.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "../contact_table.hpp"
#include "contact_table_interpolation.hpp"
#include "ellipse_creepages.hpp"
#include "wheelset_velocity.hpp"

namespace rollbem::detail {

/// One look-up. Lengths and loads refer to the right wheel; a left wheel, and rolling backwards, are mirror images.
class WheelLookUp {
public:
    /// The look-up writes into `result`, whose numbers must have the values of an empty WheelForces.
    WheelLookUp(const ContactTable& table, const CreepForceTable& creep, const ContactTable::Friction& friction,
                WheelForces& result)
        : table_(table), creep_(creep), friction_(friction), result_(result) {}

    void operator()(WheelsetSide side, const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                    const ContactTable::Load& load, bool tangents) {
        tangents_ = tangents;
        result_.status = set_inputs(side, position, speeds, load);
        if (result_.status != Status::ok) return;
        const auto& loads = table_.grid_.loads;
        result_.load_on_table = inputs_[WheelForces::load] >= loads.front() * (1 - 1e-12) &&
                                inputs_[WheelForces::load] <= loads.back() * (1 + 1e-12);
        if (inputs_[WheelForces::load] < least_load) {
            result_.force.setZero();
            return;
        }
        result_.status = locate();
        if (result_.status == Status::ok) tangents_ ? balance() : balance_values();
    }

private:
    static constexpr double least_load = 1e-100, most_load = 1e150;  // [N]; under a larger load an ellipse has no size
    static constexpr double least_share = 1e-3;

    /// What the geometry of a contact depends on: the shift at which the profiles meet, the yaw, the sum of the
    /// vertical normal loads, and a given roll.
    enum Place : Eigen::Index { by_shift, by_yaw, by_sum, by_roll };
    /// A number with its derivatives by Place.
    using Dual = Eigen::AutoDiffScalar<Eigen::Vector4d>;
    /// What forces depend on besides: the speeds, in the order of WheelForces::Input, and mu.
    static constexpr int speed_count = int(WheelForces::yaw_rate - WheelForces::forward) + 1,
                         motion_count = speed_count + 1;
    using BySpeeds = Eigen::Matrix<double, 3, speed_count>;

    template <class Number>
    static constexpr bool has_slopes = std::same_as<Number, Dual>;
    template <class Number>
    static Number constant(double value) {
        if constexpr (has_slopes<Number>) {
            return {value, Eigen::Vector4d::Zero()};
        } else {
            return value;
        }
    }
    template <class Number>
    static Number variable(double value, Place of) {
        Number found = constant<Number>(value);
        if constexpr (has_slopes<Number>) found.derivatives()[of] = 1;
        return found;
    }
    /// Sine and cosine of an angle with its derivatives, from sine and cosine of its value.
    template <class Number>
    static SineCosine<Number> turned(const Number& angle, const SineCosine<double>& value) {
        if constexpr (has_slopes<Number>) {
            return {{value.sine, value.cosine * angle.derivatives()},
                    {value.cosine, -value.sine * angle.derivatives()}};
        } else {
            return value;
        }
    }
    static double value_of(double number) { return number; }
    static double value_of(const Dual& number) { return number.value(); }
    double input(WheelForces::Input which) const { return inputs_[std::size_t(which)]; }

    // --- inputs

    Status set_inputs(WheelsetSide side, const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                      const ContactTable::Load& load) {
        mirror_ = side == WheelsetSide::left ? -1 : 1;
        side_ = &table_.sides_[table_.index_of(side)];
        has_roll_ = load.roll.has_value();
        inputs_ = {mirror_ * position.lateral,
                   mirror_ * position.yaw,
                   speeds.forward,
                   speeds.pitch_rate,
                   mirror_ * speeds.lateral,
                   speeds.vertical,
                   mirror_ * speeds.roll_rate,
                   mirror_ * speeds.yaw_rate,
                   load.vertical,
                   friction_.coefficient,
                   has_roll_ ? mirror_ * *load.roll : 0};
        for (const double input : inputs_) {
            if (!is_finite(input)) return Status::not_finite;
        }
        bool valid = load.vertical >= 0 && load.vertical <= most_load && friction_.coefficient >= 0;
        for (const double factor : friction_.factor) {
            valid = valid && factor >= 0 && is_finite(factor * friction_.coefficient);
        }
        if (!valid) return Status::invalid_load;
        if (!creep_.fits(table_.poisson_ratio())) return Status::wrong_table;
        return table_.covers(position.lateral, position.yaw) ? Status::ok : Status::wrong_table;
    }

    // --- position

    /// Finds the shift at which the profiles meet, the cell, and whether the wheel rolls forward.
    Status locate() {
        const double radius = side_->given.radius;
        along_ = inputs_[WheelForces::forward] - inputs_[WheelForces::pitch_rate] * radius < 0 ? -1 : 1;
        for (const auto which :
             {WheelForces::yaw, WheelForces::forward, WheelForces::pitch_rate, WheelForces::yaw_rate}) {
            inputs_[std::size_t(which)] *= along_;
        }
        yawed_ = sine_cosine(input(WheelForces::yaw));
        shift_ = {.value = inputs_[WheelForces::lateral]};
        if (has_roll_) {
            // a roll beyond the roll of equal loads moves the wheel's profile on the rail
            const auto equal = nodes_
                                   .wheel_on_rails(*side_, inputs_[WheelForces::lateral], inputs_[WheelForces::yaw],
                                                   inputs_[WheelForces::load])
                                   .roll;
            shift_ = {.value = shift_.value - radius * (inputs_[WheelForces::roll] - equal[0]),
                      .by_lateral = 1 + radius * equal[1],
                      .by_yaw = radius * equal[2],
                      .by_load = radius * equal[3],
                      .by_roll = -radius};
            if (!table_.covers(shift_.value, inputs_[WheelForces::yaw])) return Status::wrong_table;
        }
        cell_ = nodes_.cell(shift_.value, inputs_[WheelForces::yaw]);
        loads_ = table_.grid_.loads.size();
        for (std::size_t l = 0; l < loads_ && !has_roll_; ++l) {
            rolls_[l] = nodes_.sample<1>(cell_, side_->given.on_rails, side_->on_rails_slopes, 1, nodes_.first_node(l));
        }
        const Eigen::Index zones = side_->given.zones.count();
        for (Eigen::Index zone = 0; zone < zones; ++zone) {
            zones_[std::size_t(zone)].carries = side_->carries(zone, cell_.shift);
        }
        if (carry_count() == 0) return Status::wrong_table;
        if (carry_count() == 1) return Status::ok;  // the only zone carries the whole load
        for (Eigen::Index zone = 0; zone < zones; ++zone) {
            Zone& of = zones_[std::size_t(zone)];
            if (!std::exchange(of.carries, false)) continue;
            for (std::size_t l = 0; l < loads_; ++l) {
                const Eigen::Index first = zone * table_.grid_.nodes() + nodes_.first_node(l);
                of.share[l] = nodes_.sample<1>(cell_, side_->points, side_->slopes, ContactRow::share, first);
                of.carries = of.carries || of.share[l].value[0] > 0;
            }
        }
        return Status::ok;
    }

    // --- geometry at a load

    using LoadWeights = LocalWeights<ContactTable::most_loads>;
    struct Zone {
        bool carries = false;
        std::array<bool, ContactTable::most_loads> is_sampled{};
        std::array<ContactTable::Interpolation::Sample<1>, ContactTable::most_loads> share;
        std::array<ContactTable::Interpolation::LoadedRows, ContactTable::most_loads> rows;
        // rows and their derivatives at the present sum of loads
        Eigen::Array<double, ContactTable::Interpolation::sampled_rows, 1> value;
        Eigen::Array<double, ContactTable::Interpolation::differentiated_rows, 1> by_sum, by_shift, by_yaw;
    };

    std::ptrdiff_t carry_count() const {
        return std::count_if(zones_.begin(), zones_.end(), [](const Zone& of) { return of.carries; });
    }

    template <class Number>
    static void multiply_slopes(Zone& of, Eigen::Index row, double factor) {
        if constexpr (has_slopes<Number>) {
            if (row >= ContactTable::Interpolation::differentiated_rows) return;
            for (double* slope : {&of.by_shift[row], &of.by_yaw[row], &of.by_sum[row]}) *slope *= factor;
        }
    }
    /// The rows of a zone at a sum of loads. The arm along x is divided by the yaw.
    template <class Number>
    void interpolate(Zone& of, Eigen::Index zone, const LoadWeights& weights, double root) {
        using enum ContactRow::Of;
        const double yaw = input(WheelForces::yaw);
        for (std::size_t l = weights.first; l < weights.last; ++l) {
            if (std::exchange(of.is_sampled[l], true)) continue;
            tangents_ ? nodes_.sample_rows<true>(cell_, *side_, zone, l, of.rows[l])
                      : nodes_.sample_rows<false>(cell_, *side_, zone, l, of.rows[l]);
        }
        using Nodes = ContactTable::Interpolation;
        const auto at_load = [&]<int count>(const auto& weight, auto rows, std::integral_constant<int, count>) {
            const auto at = [&](std::size_t l) { return weight[l] * (of.rows[l].*rows).template head<count>(); };
            auto sum = at(weights.first).eval();
            for (std::size_t l = weights.first + 1; l < weights.last; ++l) sum += at(l);
            return sum;
        };
        constexpr std::integral_constant<int, Nodes::sampled_rows> sampled;
        constexpr std::integral_constant<int, Nodes::differentiated_rows> differentiated;
        const auto& means = side_->interpolated_means;
        of.value = at_load(weights.value, &Nodes::LoadedRows::value, sampled);
        of.value += means.template head<Nodes::sampled_rows>();
        of.value.template segment<9>(correction) += yaw * means.template segment<9>(correction_by_yaw);
        if constexpr (has_slopes<Number>) {
            of.by_sum = at_load(weights.rate, &Nodes::LoadedRows::value, differentiated) / (3 * root * root);
            of.by_shift = at_load(weights.value, &Nodes::LoadedRows::by_shift, differentiated);
            of.by_yaw = at_load(weights.value, &Nodes::LoadedRows::by_yaw, differentiated);
            of.by_yaw.template segment<9>(correction) += means.template segment<9>(correction_by_yaw);
            multiply_slopes<Number>(of, arm_x, yaw);
            of.by_yaw[arm_x] += of.value[arm_x];
        }
        of.value[arm_x] *= yaw;
        constexpr auto& positive = ContactRow::positive;
        Eigen::Array<double, int(positive.size()), 1> powers;
        for (std::size_t k = 0; k < positive.size(); ++k) powers[Eigen::Index(k)] = of.value[positive[k]];
        powers = powers.exp().eval();  // all at once, in packets
        for (std::size_t k = 0; k < positive.size(); ++k) {
            of.value[positive[k]] = powers[Eigen::Index(k)];
            multiply_slopes<Number>(of, positive[k], powers[Eigen::Index(k)]);
        }
        if (!(of.value[full_sliding_share] >= 0 && of.value[full_sliding_share] <= 1)) {
            of.value[full_sliding_share] = std::clamp(of.value[full_sliding_share], 0.0, 1.0);
            multiply_slopes<Number>(of, full_sliding_share, 0);
        }
    }
    template <class Number>
    static Number number(const Zone& of, Eigen::Index row) {
        if constexpr (has_slopes<Number>) {
            return {of.value[row], Eigen::Vector4d(of.by_shift[row], of.by_yaw[row], of.by_sum[row], 0)};
        } else {
            return of.value[row];
        }
    }

    /// The share of a zone before normalisation (division by the sum of shares), not negative: by limited cubics over
    /// the loads.
    template <class Number>
    Number share(const Zone& of, double root) const {
        const auto& nodes = table_.roots_;
        const auto at = [&](std::size_t l) {
            Number found = constant<Number>(of.share[l].value[0]);
            if constexpr (has_slopes<Number>)
                found.derivatives().template head<2>() << of.share[l].by_shift[0], of.share[l].by_yaw[0];
            return found;
        };
        Number found = constant<Number>(0);
        if (loads_ == 1 || root <= nodes.front() || root >= nodes.back()) {
            found = at(loads_ > 1 && root >= nodes.back() ? loads_ - 1 : 0);
        } else {
            const std::size_t i = interval_of(nodes, root);
            const HermiteWeights w(root, nodes[i], nodes[i + 1]);
            const auto slope = [&](std::size_t l) -> Number {
                const auto difference = [&](std::size_t k) -> Number {
                    return (at(k + 1) - at(k)) * (1 / (nodes[k + 1] - nodes[k]));
                };
                if (l == 0 || l + 1 == loads_) return difference(l == 0 ? 0 : l - 1);
                const Number before = difference(l - 1), after = difference(l);
                const Number middle = slope_between(before, nodes[l] - nodes[l - 1], after, nodes[l + 1] - nodes[l]);
                const double most = limited(value_of(middle), value_of(before), value_of(after));
                if (most == value_of(middle)) return middle;
                if (most == 0) return constant<Number>(0);
                const Number& lesser = std::abs(value_of(before)) < std::abs(value_of(after)) ? before : after;
                return lesser * 3;
            };
            const Number low = at(i), high = at(i + 1), low_slope = slope(i), high_slope = slope(i + 1);
            found = w.value[0] * low + w.value[1] * high + w.value[2] * low_slope + w.value[3] * high_slope;
            if constexpr (has_slopes<Number>)
                found.derivatives()[by_sum] = (w.rate[0] * low.value() + w.rate[1] * high.value() +
                                               w.rate[2] * low_slope.value() + w.rate[3] * high_slope.value()) /
                                              (3 * root * root);
        }
        constexpr double e = least_share;
        if (!(value_of(found) > 0)) return constant<Number>(0);
        if (value_of(found) < 2 * e) return found * found * (1 / (4 * e));
        return found - constant<Number>(e);
    }

    // --- forces

    template <class Number>
    struct ZoneContact {
        double share = 0;             // share of the vertical load; 0: no contact
        std::array<Number, 3> force;  // force in the plane, and moment about its normal
        Number normal, size, angle, normal_sine, normal_cosine, half_length, half_width;  // size: N^(1/3)
        Number friction_angle, sine, cosine;  // of the plane in which friction acts
        std::array<Number, 3> arm, creepage;
        Number rolling;                                    // V [m/s]
        Eigen::Matrix<double, 3, motion_count> by_motion;  // derivatives of the force by speeds and mu
    };
    /// All zones at one sum of loads.
    template <class Number>
    struct Pass {
        Number excess;  // load carried by the zones minus the wheel's load
        Eigen::Matrix<double, 1, motion_count> excess_by_motion;
        bool does_not_roll = false;
        Number roll;                // of the wheelset
        SineCosine<double> rolled;  // sine and cosine of the roll
        std::array<ZoneContact<Number>, ContactTable::Zones::most> contacts;
    };

    /// Forces of one zone under its normal load.
    template <class Number>
    Status forces_on(Pass<Number>& pass, std::size_t zone, const Number& load) {
        using enum ContactRow::Of;
        const Zone& of = zones_[zone];
        ZoneContact<Number>& found = pass.contacts[zone];
        const auto row = [&](Eigen::Index which) { return number<Number>(of, which); };
        found.angle = row(angle);
        found.friction_angle = found.angle + row(plane);
        for (auto [of_angle, sine, cosine] : {std::tuple(&found.angle, &found.normal_sine, &found.normal_cosine),
                                              {&found.friction_angle, &found.sine, &found.cosine}}) {
            const SineCosine<Number> inclined = turned(*of_angle, sine_cosine(value_of(*of_angle)));
            *sine = inclined.sine;
            *cosine = inclined.cosine;
        }
        found.arm = {row(arm_x), row(arm_y), row(arm_z)};
        found.normal = load / found.normal_cosine;
        found.rolling = (input(WheelForces::forward) - input(WheelForces::pitch_rate) * row(radius)) * 0.5;
        found.size = constant<Number>(std::cbrt(value_of(found.normal)));
        if constexpr (has_slopes<Number>)
            found.size.derivatives() = found.size.value() / (3 * found.normal.value()) * found.normal.derivatives();
        found.half_length = row(length) * found.size;
        found.half_width = row(width) * found.size;
        found.force.fill(constant<Number>(0));
        found.by_motion.setZero();
        found.creepage.fill(constant<Number>(0));
        if (!(value_of(found.rolling) >= (std::numeric_limits<double>::min)())) {
            pass.does_not_roll = true;
            return Status::ok;
        }
        const std::array<Number, 3> slip = velocity(pass).slip(found.arm, found.sine, found.cosine);
        for (std::size_t i = 0; i < 3; ++i) found.creepage[i] = slip[i] / found.rolling;
        const double mu = input(WheelForces::mu) * friction_.factor[zone];
        const std::array<Number, 3> own = ellipse_creepages<Number>(found.creepage, found.half_length, found.half_width,
                                                                    table_.shear_modulus(), mu * found.normal, row);
        return creep_forces(pass, zone, own);
    }

    /// The wheel's motion.
    template <class Number>
    WheelsetVelocity<Number> velocity(const Pass<Number>& pass) const {
        const auto speed = [&](WheelForces::Input of) { return constant<Number>(input(of)); };
        return {{speed(WheelForces::forward), speed(WheelForces::pitch_rate), speed(WheelForces::lateral_speed),
                 speed(WheelForces::vertical_speed), speed(WheelForces::roll_rate), speed(WheelForces::yaw_rate)},
                turned(pass.roll, pass.rolled),
                turned(variable<Number>(input(WheelForces::yaw), by_yaw), yawed_)};
    }

    PatchContact::Parameters ellipse(double a, double b) const {
        return {a, b, table_.shear_modulus(), table_.poisson_ratio()};
    }

    /// Forces on the ellipse of a zone at its own creepages, without derivatives.
    Status creep_forces(Pass<double>& pass, std::size_t zone, const std::array<double, 3>& own) const {
        ZoneContact<double>& found = pass.contacts[zone];
        const Creepage creepage{own[0], own[1], own[2]};
        const PatchContact::Parameters axes = ellipse(found.half_length, found.half_width);
        const double mu = input(WheelForces::mu) * friction_.factor[zone], N = found.normal;
        TangentialForce force;
        Status status = Status::ok;
        if (friction_.reduced != nullptr) {
            const ReducedFriction::Force now =
                friction_.reduced->look_up(creep_, PatchContact(axes), mu, N, found.rolling, creepage);
            force = now.force;
            status = now.status;
        } else {
            force =
                is_rough_ ? creep_.force<float>(axes, mu, N, creepage) : creep_.force<double>(axes, mu, N, creepage);
        }
        found.force = {force.longitudinal, force.lateral, force.moment};
        return status;
    }

    /// Forces on the ellipse of a zone at its own creepages, with all derivatives.
    Status creep_forces(Pass<Dual>& pass, std::size_t zone, const std::array<Dual, 3>& own) const {
        ZoneContact<Dual>& found = pass.contacts[zone];
        const double factor = friction_.factor[zone], mu = input(WheelForces::mu) * factor, N = found.normal.value();
        const Creepage creepage{own[0].value(), own[1].value(), own[2].value()};
        const PatchContact contact(ellipse(found.half_length.value(), found.half_width.value()));
        CreepForceTable::Force now;
        Eigen::Vector3d by_speed = Eigen::Vector3d::Zero();
        const auto column = [](const TangentialForce& of) {
            return Eigen::Vector3d(of.longitudinal, of.lateral, of.moment);
        };
        if (friction_.reduced != nullptr) {
            const ReducedFriction::Force reduced =
                friction_.reduced->look_up(creep_, contact, mu, N, found.rolling.value(), creepage);
            now = reduced;
            by_speed = column(reduced.tangent_by_speed);
        } else {
            now = creep_.look_up(contact, mu, N, creepage);
        }
        Eigen::Matrix3d by_creepage;
        by_creepage << column(now.tangent.by_longitudinal), column(now.tangent.by_lateral), column(now.tangent.by_spin);
        const Eigen::Vector3d force = column(now.force);
        Eigen::Matrix<double, 3, 4> by_place =
            column(now.tangent_by_load) * found.normal.derivatives().transpose() +
            column(now.tangent_by_half_length) * found.half_length.derivatives().transpose() +
            column(now.tangent_by_half_width) * found.half_width.derivatives().transpose() +
            by_speed * found.rolling.derivatives().transpose();
        for (Eigen::Index i = 0; i < 3; ++i) {
            by_place += by_creepage.col(i) * own[std::size_t(i)].derivatives().transpose();
        }
        for (Eigen::Index i = 0; i < 3; ++i) found.force[std::size_t(i)] = {force[i], by_place.row(i).transpose()};

        // the ellipse's creepages by the contact's three, and by mu N
        const std::array<Dual, 3> given{Dual(found.creepage[0].value(), 4, 0), Dual(found.creepage[1].value(), 4, 1),
                                        Dual(found.creepage[2].value(), 4, 2)};
        const std::array<Dual, 3> moved = ellipse_creepages<Dual>(
            given, constant<Dual>(found.half_length.value()), constant<Dual>(found.half_width.value()),
            table_.shear_modulus(), Dual(mu * N, 4, 3), [&](Eigen::Index row) { return zones_[zone].value[row]; });
        Eigen::Matrix<double, 3, 4> by_given;
        for (Eigen::Index i = 0; i < 3; ++i) by_given.row(i) = moved[std::size_t(i)].derivatives().transpose();
        const Eigen::Matrix<double, 3, 4> by_own = by_creepage * by_given;
        Eigen::Matrix<double, 1, speed_count> rolling_by_speeds = Eigen::Matrix<double, 1, speed_count>::Zero();
        rolling_by_speeds[0] = 0.5;
        rolling_by_speeds[WheelForces::pitch_rate - WheelForces::forward] =
            -0.5 * zones_[zone].value[ContactRow::radius];
        found.by_motion.template leftCols<speed_count>() =
            by_own.leftCols<3>() * creepage_by_speeds(pass, found, rolling_by_speeds) + by_speed * rolling_by_speeds;
        found.by_motion.col(speed_count) = factor * (column(now.tangent_by_friction_coefficient) + N * by_own.col(3));
        return now.status;
    }

    /// Derivatives of a contact's creepages by the speeds, from the derivatives of its rolling velocity.
    BySpeeds creepage_by_speeds(const Pass<Dual>& pass, const ZoneContact<Dual>& of,
                                const Eigen::Matrix<double, 1, speed_count>& rolling_by_speeds) const {
        using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, speed_count, 1>>;
        const auto speed = [&](int which) {
            return Number(inputs_[std::size_t(WheelForces::forward + which)], speed_count, which);
        };
        const auto fixed = [](double number) { return Number(number, Eigen::Matrix<double, speed_count, 1>::Zero()); };
        const WheelsetVelocity<Number> velocity({speed(0), speed(1), speed(2), speed(3), speed(4), speed(5)},
                                                {fixed(pass.rolled.sine), fixed(pass.rolled.cosine)},
                                                {fixed(yawed_.sine), fixed(yawed_.cosine)});
        const std::array<Number, 3> slip =
            velocity.slip({fixed(of.arm[0].value()), fixed(of.arm[1].value()), fixed(of.arm[2].value())},
                          fixed(of.sine.value()), fixed(of.cosine.value()));
        BySpeeds found;
        for (Eigen::Index i = 0; i < 3; ++i) {
            found.row(i) = (slip[std::size_t(i)].derivatives().transpose() -
                            of.creepage[std::size_t(i)].value() * rolling_by_speeds) /
                           of.rolling.value();
        }
        return found;
    }

    /// The roll of the wheelset: the given roll, or the roll under equal loads.
    template <class Number>
    Number roll(const LoadWeights& weights, double root) const {
        if (has_roll_) return variable<Number>(input(WheelForces::roll), by_roll);
        Number found = constant<Number>(0);
        for (std::size_t l = weights.first; l < weights.last; ++l) {
            const ContactTable::Interpolation::Sample<1>& own = rolls_[l];
            if constexpr (has_slopes<Number>) {
                found.value() += weights.value[l] * own.value[0];
                found.derivatives() +=
                    Eigen::Vector4d(weights.value[l] * own.by_shift[0], weights.value[l] * own.by_yaw[0],
                                    weights.rate[l] * own.value[0] / (3 * root * root), 0);
            } else {
                found += weights.value[l] * own.value[0];
            }
        }
        return found;
    }

    // --- balance

    /// Finds the sum of vertical normal loads with which normal forces and friction carry the load: Newton's method,
    /// whose last step is taken along the tangents.
    void balance() {
        // errors of values are as the square of the last step, errors of tangents as the step
        constexpr double settled = 1e-7;
        Pass<Dual> pass;
        Pass<double> values;
        double sum = secants(values).value_or(input(WheelForces::load));
        for (int round = 0; round < 30; ++round) {
            result_.status = at_sum(pass, sum);
            if (result_.status != Status::ok) return;
            const double change = pass.excess.value() / pass.excess.derivatives()[by_sum];
            if (!is_finite(change)) break;
            if (std::abs(change) <= settled * sum) return finish(pass, change);
            sum -= std::clamp(change, -sum, sum / 2);
        }
        result_.status = Status::no_solution;
    }

    /// The balance without tangents.
    void balance_values() {
        Pass<double> pass;
        if (secants(pass)) {
            result_.status = Status::ok;
            return finish(pass, 0);
        }
        tangents_ = true;
        for (Zone& of : zones_) of.is_sampled.fill(false);
        balance();
        result_.tangent.setZero();
    }

    /// The sum of vertical normal loads by secants on values alone, first in single precision and, if no tangents
    /// follow, then in double precision; nothing if the secants do not converge at once.
    std::optional<double> secants(Pass<double>& pass) {
        constexpr double settled = 4e-9, known = 1e-5;
        const double load = input(WheelForces::load), missed = tangents_ ? 3e-8 : settled / 2;
        double sum = load, last = 0, before = -load, rate = 0;  // without normal loads nothing is carried
        is_rough_ = true;
        for (int round = 0; round < 10; ++round) {
            if (at_sum(pass, sum) != Status::ok) break;
            const double excess = pass.excess, step = std::abs(sum - last);
            if (step > known * sum) rate = (excess - before) / (sum - last);
            const double change = excess / rate;
            if (!(std::abs(change) < sum / 2)) break;
            if (!is_rough_ && std::abs(change) <= settled * sum) return sum - change;
            // friction is nearly a power of the load, so that the error of a secant is its curvature over both steps
            if (is_rough_ && std::abs(change * (1 - rate)) * step <= missed * sum * sum) {
                if (tangents_) return sum - change;
                is_rough_ = false;
            }
            before = excess;
            last = std::exchange(sum, sum - change);
        }
        return std::nullopt;
    }

    /// Forces of all zones whose vertical normal loads sum up to `sum`, and their excess over the load.
    template <class Number>
    Status at_sum(Pass<Number>& pass, double sum) {
        const double root = std::cbrt(sum);
        const LoadWeights weights = hermite_weights<ContactTable::most_loads>(table_.roots_, root);
        pass.roll = roll<Number>(weights, root);
        pass.rolled = sine_cosine(value_of(pass.roll));
        const auto count = std::size_t(side_->given.zones.count());
        std::array<Number, ContactTable::Zones::most> shares;
        Number total = constant<Number>(0);
        const bool one_carries = carry_count() == 1;
        for (std::size_t k = 0; k < count; ++k) {
            shares[k] = constant<Number>(one_carries && zones_[k].carries ? 1 : 0);
            if (!one_carries && zones_[k].carries) shares[k] = share<Number>(zones_[k], root);
            total += shares[k];
        }
        if (!(value_of(total) > 0)) return Status::wrong_table;
        const Number whole = variable<Number>(sum, by_sum);
        pass.excess = whole - constant<Number>(input(WheelForces::load));
        pass.excess_by_motion.setZero();
        pass.does_not_roll = false;
        for (std::size_t k = 0; k < count; ++k) {
            ZoneContact<Number>& of = pass.contacts[k];
            of.share = 0;
            if (!(value_of(shares[k]) > 0)) continue;
            const Number portion = shares[k] / total, load = portion * whole;
            if (value_of(load) < least_load) continue;
            interpolate<Number>(zones_[k], Eigen::Index(k), weights, root);
            of.share = value_of(portion);
            const Status status = forces_on(pass, k, load);
            if (status != Status::ok) return status;
            pass.excess -= of.force[1] * of.sine;
            if constexpr (has_slopes<Number>) pass.excess_by_motion -= of.sine.value() * of.by_motion.row(1);
        }
        return Status::ok;
    }

    /// Value of a number after the sum has fallen by `change`.
    static double after(double number, double /*change*/) { return number; }
    static double after(const Dual& number, double change) {
        return number.value() - number.derivatives()[by_sum] * change;
    }

    /// Writes a point as after the last step, so that its numbers agree with the wrench.
    template <class Number>
    void settle(std::size_t zone, const ZoneContact<Number>& of, double change) {
        const auto settled = [&](const Number& number) { return after(number, change); };
        WheelForces::Point& point = result_.points[zone];
        const auto& row = zones_[zone].value;
        point.load_share = of.share;
        point.rolling_radius = row[ContactRow::radius];
        point.rail_y = row[ContactRow::rail_y];
        point.wheel_y = row[ContactRow::wheel_y];
        point.peak_pressure = row[ContactRow::peak] * value_of(of.size);
        point.ellipse = PatchContact(ellipse(value_of(of.half_length), value_of(of.half_width)));
        point.normal_load = settled(of.normal);
        point.angle = settled(of.angle);
        point.friction_angle = settled(of.friction_angle);
        point.arm = {along_ * settled(of.arm[0]), settled(of.arm[1]), settled(of.arm[2])};
        point.creepage = {along_ * settled(of.creepage[0]), settled(of.creepage[1]), along_ * settled(of.creepage[2])};
        point.force = {along_ * settled(of.force[0]), settled(of.force[1]), along_ * settled(of.force[2])};
        point.rolling_velocity = along_ * settled(of.rolling);
        point.heat = -settled(of.rolling) *
                     (point.force.longitudinal * point.creepage.longitudinal +
                      point.force.lateral * point.creepage.lateral + point.force.moment * point.creepage.spin);
    }

    /// The wrench. The sum of normal loads, which falls by `change`, is the function of the inputs that keeps the
    /// excess at 0.
    template <class Number>
    void finish(const Pass<Number>& pass, double change) {
        std::array<Number, 6> wrench;
        wrench.fill(constant<Number>(0));
        Eigen::Matrix<double, 6, motion_count> by_motion = Eigen::Matrix<double, 6, motion_count>::Zero();
        for (std::size_t k = 0; k < std::size_t(side_->given.zones.count()); ++k) {
            const ZoneContact<Number>& of = pass.contacts[k];
            if (!(of.share > 0)) continue;
            const auto& [r_x, r_y, r_z] = of.arm;
            const Number f_x = of.force[0], f_y = of.force[1] * of.cosine + of.normal * of.normal_sine,
                         f_z = of.force[1] * of.sine - of.normal * of.normal_cosine;
            wrench[0] += f_x;
            wrench[1] += f_y;
            wrench[2] += f_z;
            wrench[3] += r_y * f_z - r_z * f_y;
            wrench[4] += r_z * f_x - r_x * f_z - of.force[2] * of.sine;
            wrench[5] += r_x * f_y - r_y * f_x + of.force[2] * of.cosine;
            if constexpr (has_slopes<Number>) {
                const double sine = of.sine.value(), cosine = of.cosine.value(), x = r_x.value(), y = r_y.value(),
                             z = r_z.value();
                Eigen::Matrix<double, 6, 3> by_force;
                by_force << 1, 0, 0, 0, cosine, 0, 0, sine, 0, 0, y * sine - z * cosine, 0, z, -x * sine, -sine, -y,
                    x * cosine, cosine;
                by_motion.noalias() += by_force.lazyProduct(of.by_motion);
            }
            settle(k, of, change);
            result_.heat += result_.points[k].heat;
        }
        const std::array<double, 6> signs{along_, mirror_, 1, mirror_, along_, along_ * mirror_};
        for (std::size_t i = 0; i < 6; ++i) result_.force[Eigen::Index(i)] = signs[i] * after(wrench[i], change);
        if constexpr (has_slopes<Number>) {
            Eigen::Matrix<double, 1, WheelForces::inputs> signs_of_inputs;
            for (Eigen::Index j = 0; j < WheelForces::inputs; ++j) signs_of_inputs[j] = sign_of(j);
            for (std::size_t i = 0; i < 6; ++i) {
                const double slope = wrench[i].derivatives()[by_sum] / pass.excess.derivatives()[by_sum];
                const Eigen::Vector4d place = wrench[i].derivatives() - slope * pass.excess.derivatives();
                Eigen::Matrix<double, 1, WheelForces::inputs> row;
                row[WheelForces::lateral] = place[by_shift] * shift_.by_lateral;
                row[WheelForces::yaw] = place[by_shift] * shift_.by_yaw + place[by_yaw];
                row[WheelForces::load] = place[by_shift] * shift_.by_load + slope;
                row[WheelForces::roll] = place[by_shift] * shift_.by_roll + place[by_roll];
                const Eigen::Matrix<double, 1, motion_count> motion =
                    by_motion.row(Eigen::Index(i)) - slope * pass.excess_by_motion;
                row.segment<speed_count>(WheelForces::forward) = motion.head<speed_count>();
                row[WheelForces::mu] = motion[speed_count];
                result_.tangent.row(Eigen::Index(i)) = signs[i] * row.cwiseProduct(signs_of_inputs);
            }
        }
        const double sum = result_.force.sum() + result_.tangent.sum() + result_.heat;
        if (!is_finite(sum)) result_.status = Status::not_finite;
        if (pass.does_not_roll && result_.status == Status::ok) {
            result_.status = Status::invalid_step;
            result_.tangent.setZero();
        }
    }
    /// Sign of an input in the mirror images.
    double sign_of(Eigen::Index input) const {
        switch (input) {
            case WheelForces::lateral:
            case WheelForces::lateral_speed:
            case WheelForces::roll_rate:
            case WheelForces::roll: return mirror_;
            case WheelForces::yaw:
            case WheelForces::yaw_rate: return along_ * mirror_;
            case WheelForces::forward:
            case WheelForces::pitch_rate: return along_;
            default: return 1;
        }
    }

    const ContactTable& table_;
    const ContactTable::Interpolation nodes_{table_};
    const CreepForceTable& creep_;
    const ContactTable::Friction& friction_;
    const ContactTable::Stored* side_ = nullptr;
    WheelForces& result_;
    std::array<double, WheelForces::inputs> inputs_{};
    double mirror_ = 1, along_ = 1;
    bool tangents_ = false, is_rough_ = true, has_roll_ = false;
    struct Shift {
        double value = 0, by_lateral = 1, by_yaw = 0, by_load = 0, by_roll = 0;
    };
    Shift shift_;
    SineCosine<double> yawed_{0, 1};
    ContactTable::Interpolation::Cell cell_{0, 0, {0, 0, 1}, {}};
    std::size_t loads_ = 0;
    std::array<ContactTable::Interpolation::Sample<1>, ContactTable::most_loads> rolls_;  // rolls of equal loads
    std::array<Zone, ContactTable::Zones::most> zones_;
};

}  // namespace rollbem::detail
