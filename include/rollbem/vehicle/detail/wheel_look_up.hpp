// The look-up of a wheel's forces in a ContactTable, step by step. Internal; include vehicle/contact_table.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

#include "contact_table.hpp"
#include "wheelset_velocity.hpp"

namespace rollbem::detail {

/// One look-up. Lengths and loads refer to the right wheel; a left wheel, and rolling backwards, are mirror images.
class WheelLookUp {
public:
    WheelLookUp(const ContactTable& table, const CreepForceTable& creep, const WheelFriction& friction, bool tangents)
        : table_(table), creep_(creep), friction_(friction), tangents_(tangents) {}

    WheelForces operator()(WheelsetSide side, const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                           const WheelLoad& load) {
        result_.status = take(side, position, speeds, load);
        if (result_.status != Status::ok) return result_;
        const auto& loads = table_.grid_.loads;
        result_.load_on_table = inputs_[WheelForces::load] >= loads.front() * (1 - 1e-12) &&
                                inputs_[WheelForces::load] <= loads.back() * (1 + 1e-12);
        if (inputs_[WheelForces::load] < least_load) {
            result_.force.setZero();
            return result_;
        }
        result_.status = locate();
        if (result_.status != Status::ok) return result_;
        tangents_ ? balance<all>() : balance_values();
        return result_;
    }

private:
    static constexpr double least_load = 1e-100, most_load = 1e150;  // [N]; under a larger load an ellipse has no size
    static constexpr double least_share = 1e-3;

    // A number with its derivatives: by all of WheelForces::Input if tangents are asked for, and last by the sum of the
    // vertical normal loads; or without derivatives.
    template <int partials>
    using Gradient = Eigen::Matrix<double, partials, 1>;
    template <int partials>
    using Dual = Eigen::AutoDiffScalar<Gradient<partials>>;
    static constexpr int none = 0, one = 1, all = WheelForces::inputs + 1;
    template <int partials>
    static constexpr bool by_inputs = partials == all;
    template <int partials>
    static constexpr int by_sum = partials - 1;
    template <int partials>
    static Dual<partials> constant(double value) {
        return {value, Gradient<partials>::Zero()};
    }
    template <int partials>
    Dual<partials> input(WheelForces::Input which) const {
        const double value = inputs_[std::size_t(which)];
        if constexpr (by_inputs<partials>) return {value, partials, static_cast<int>(which)};
        return constant<partials>(value);
    }

    // --- inputs

    Status take(WheelsetSide side, const WheelsetPosition& position, const WheelsetSpeeds& speeds,
                const WheelLoad& load) {
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
        shift_ = input<all>(WheelForces::lateral);
        if (has_roll_) {
            // a roll beyond the roll of equal loads moves the wheel's profile on the rail
            const auto table = table_
                                   .wheel_on_rails(*side_, inputs_[WheelForces::lateral], inputs_[WheelForces::yaw],
                                                   inputs_[WheelForces::load])
                                   .roll;
            Dual<all> equal = constant<all>(table[0]);
            equal.derivatives()[WheelForces::lateral] = table[1];
            equal.derivatives()[WheelForces::yaw] = table[2];
            equal.derivatives()[WheelForces::load] = table[3];
            shift_ = Dual<all>(shift_ - radius * (input<all>(WheelForces::roll) - equal));
            if (!table_.covers(shift_.value(), inputs_[WheelForces::yaw])) return Status::wrong_table;
        }
        cell_ = table_.cell(shift_.value(), inputs_[WheelForces::yaw]);
        loads_ = table_.grid_.loads.size();
        for (std::size_t l = 0; l < loads_ && !has_roll_; ++l) {
            rolls_[l] = table_.sample<1>(cell_, side_->given.on_rails, side_->on_rails_slopes, 1, table_.first_node(l));
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
                const Eigen::Index first = zone * table_.grid_.nodes() + table_.first_node(l);
                of.share[l] = table_.sample<1>(cell_, side_->points, side_->slopes, ContactRow::share, first);
                of.carries = of.carries || of.share[l].value[0] > 0;
            }
        }
        return Status::ok;
    }

    // --- geometry at a load

    using Values = ContactRow::Values;
    struct Zone {
        bool carries = false, is_sampled = false;
        std::array<ContactTable::Sample<1>, ContactTable::most_loads> share;
        ContactTable::RowsByLoad rows;
        Values value, by_shift, by_yaw, by_sum;  // rows and their derivatives at the present sum of loads
    };

    std::ptrdiff_t carry_count() const {
        return std::count_if(zones_.begin(), zones_.end(), [](const Zone& of) { return of.carries; });
    }

    /// The rows of a zone at a sum of loads. Odd parts are divided by the yaw.
    template <int partials>
    void interpolate(Zone& of, Eigen::Index zone, const RowWeights<ContactTable::most_loads>& weights, double root) {
        using enum ContactRow::Of;
        const double yaw = inputs_[WheelForces::yaw];
        const auto times_yaw = [&](Values& values) {
            values[arm_x] *= yaw;
            values.segment<9>(correction) += yaw * values.segment<9>(correction_by_yaw);
        };
        if (!std::exchange(of.is_sampled, true)) {
            tangents_ ? table_.sample_rows<true>(cell_, *side_, zone, of.rows)
                      : table_.sample_rows<false>(cell_, *side_, zone, of.rows);
        }
        const auto at_load = [&](const auto& weight, auto part) -> Values {
            auto sum = (weight[0] * part(of.rows[0])).eval();
            for (std::size_t l = 1; l < loads_; ++l) sum += weight[l] * part(of.rows[l]);
            return sum.template head<ContactRow::rows>();
        };
        using Rows = ContactTable::LoadedRows;
        const auto values = [](const Rows& rows) -> const auto& { return rows.value; };
        of.value = side_->means + at_load(weights.value, values);
        if constexpr (partials > none) {
            of.by_sum = at_load(weights.rate, values) / (3 * root * root);
            times_yaw(of.by_sum);
        }
        if constexpr (by_inputs<partials>) {
            of.by_shift = at_load(
                weights.value, [](const Rows& rows) -> const auto& { return rows.by_shift; });
            times_yaw(of.by_shift);
            of.by_yaw = at_load(
                weights.value, [](const Rows& rows) -> const auto& { return rows.by_yaw; });
            times_yaw(of.by_yaw);
            of.by_yaw[arm_x] += of.value[arm_x];
            of.by_yaw.segment<9>(correction) += of.value.segment<9>(correction_by_yaw);
        }
        times_yaw(of.value);
    }
    template <int partials>
    Dual<partials> dual(const Zone& of, Eigen::Index row) const {
        Dual<partials> found = constant<partials>(of.value[row]);
        if constexpr (by_inputs<partials>) {
            if (has_roll_) {
                found.derivatives() = of.by_shift[row] * shift_.derivatives();
            } else {
                found.derivatives()[WheelForces::lateral] = of.by_shift[row];
            }
            found.derivatives()[WheelForces::yaw] += of.by_yaw[row];
        }
        if constexpr (partials > none) found.derivatives()[by_sum<partials>] = of.by_sum[row];
        return found;
    }

    /// The share of a zone before normalisation (division by the sum of shares), not negative: by limited cubics over
    /// the loads.
    template <int partials>
    Dual<partials> share(const Zone& of, double root) const {
        using Number = Dual<partials>;
        const auto& nodes = table_.roots_;
        const auto at = [&](std::size_t l) {
            Number found = constant<partials>(of.share[l].value[0]);
            if constexpr (by_inputs<partials>) {
                found.derivatives() = of.share[l].by_shift[0] * shift_.derivatives();
                found.derivatives()[WheelForces::yaw] += of.share[l].by_yaw[0];
            }
            return found;
        };
        Number found = constant<partials>(0);
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
                const double most = limited(middle.value(), before.value(), after.value());
                if (most == middle.value()) return middle;
                if (most == 0) return constant<partials>(0);
                const Number& lesser = std::abs(before.value()) < std::abs(after.value()) ? before : after;
                return lesser * 3;
            };
            const Number low = at(i), high = at(i + 1), low_slope = slope(i), high_slope = slope(i + 1);
            found = w.value[0] * low + w.value[1] * high + w.value[2] * low_slope + w.value[3] * high_slope;
            if constexpr (partials > none)
                found.derivatives()[by_sum<partials>] =
                    (w.rate[0] * low.value() + w.rate[1] * high.value() + w.rate[2] * low_slope.value() +
                     w.rate[3] * high_slope.value()) /
                    (3 * root * root);
        }
        constexpr double e = least_share;
        if (!(found.value() > 0)) return constant<partials>(0);
        if (found.value() < 2 * e) return found * found * (1 / (4 * e));
        return found - constant<partials>(e);
    }

    // --- forces

    template <int partials>
    struct Contact {
        double share = 0;                     // share of the vertical load; 0: no contact
        std::array<Dual<partials>, 3> force;  // force in the plane, and moment about its normal
        Dual<partials> normal, angle, sine, cosine, half_length, half_width;
        std::array<Dual<partials>, 3> arm, creepage;
        Dual<partials> rolling;  // V [m/s]
    };
    /// All zones at one sum of loads.
    template <int partials>
    struct Pass {
        Dual<partials> excess;  // load carried by the zones minus the wheel's load
        bool stands = false;
        std::optional<WheelsetVelocity<Dual<partials>>> velocity;
        std::array<Contact<partials>, ContactZones::most> contacts;
    };

    /// Forces of one zone under its normal load.
    template <int partials>
    Status press(Pass<partials>& pass, std::size_t zone, const Dual<partials>& load) {
        using Number = Dual<partials>;
        using enum ContactRow::Of;
        const Zone& of = zones_[zone];
        Contact<partials>& found = pass.contacts[zone];
        const auto row = [&](Eigen::Index which) { return dual<partials>(of, which); };
        found.angle = row(angle);
        found.sine = sin(found.angle);
        found.cosine = cos(found.angle);
        found.arm = {row(arm_x), row(arm_y), row(arm_z)};
        found.normal = load / found.cosine;
        const Number& N = found.normal;
        found.rolling =
            (input<partials>(WheelForces::forward) - input<partials>(WheelForces::pitch_rate) * row(radius)) * 0.5;
        const Number& reference = found.rolling;
        const double root = std::cbrt(N.value());
        const Number size(root, (root / (3 * N.value())) * N.derivatives());
        const auto positive = [&](Eigen::Index which) {  // cubics may undershoot where a zone begins to carry
            constexpr double least = 1e-9;
            return of.value[which] > least ? row(which) : constant<partials>(least);
        };
        found.half_length = positive(length) * size;
        found.half_width = positive(width) * size;
        found.force.fill(constant<partials>(0));
        found.creepage.fill(constant<partials>(0));
        if (!(reference.value() >= (std::numeric_limits<double>::min)())) {
            pass.stands = true;
            return Status::ok;
        }
        const std::array<Number, 3> slip = pass.velocity->slip(found.arm, found.sine, found.cosine);
        found.creepage = {slip[0] / reference, slip[1] / reference, slip[2] / reference};
        const Number &a = found.half_length, &b = found.half_width;
        const Number mu = input<partials>(WheelForces::mu) * friction_.factor[zone];
        const std::array<Number, 3> own =
            ellipse_creepages<Number>(found.creepage, a, b, table_.shear_modulus(), mu * N, row);
        return creep_forces<partials>(own, {N, mu, a, b, reference}, found.force);
    }

    PatchContact<double>::Parameters ellipse(double a, double b) const {
        return {a, b, table_.shear_modulus(), table_.poisson_ratio()};
    }
    template <int partials>
    struct Terms {
        const Dual<partials>&N, &mu, &a, &b, &speed;
    };
    template <int partials>
    Status creep_forces(const std::array<Dual<partials>, 3>& own, const Terms<partials>& terms,
                        std::array<Dual<partials>, 3>& force) const {
        const Creepage<double> creepage{own[0].value(), own[1].value(), own[2].value()};
        const PatchContact<double>::Parameters axes = ellipse(terms.a.value(), terms.b.value());
        TabulatedForce now;
        TangentialForce<double> by_speed{0, 0, 0};
        if constexpr (partials == none) {
            if (friction_.reduced == nullptr) {
                const double mu = terms.mu.value(), N = terms.N.value();
                const TangentialForce<double> alone = is_rough_ ? creep_.force<float>(axes, mu, N, creepage)
                                                                : creep_.force<double>(axes, mu, N, creepage);
                force = {constant<none>(alone.longitudinal), constant<none>(alone.lateral),
                         constant<none>(alone.moment)};
                return Status::ok;
            }
        }
        const PatchContact<double> ellipse(axes);
        if (friction_.reduced != nullptr) {
            const ReducedFriction::Force reduced = friction_.reduced->look_up(
                creep_, ellipse, terms.mu.value(), terms.N.value(), terms.speed.value(), creepage);
            now = reduced;
            by_speed = reduced.tangent_by_speed;
        } else {
            now = creep_.look_up(ellipse, terms.mu.value(), terms.N.value(), creepage);
        }
        const auto combine = [&](auto part) {
            return Dual<partials>(part(now.force),
                                  part(now.tangent.by_longitudinal) * own[0].derivatives() +
                                      part(now.tangent.by_lateral) * own[1].derivatives() +
                                      part(now.tangent.by_spin) * own[2].derivatives() +
                                      part(now.tangent_by_load) * terms.N.derivatives() +
                                      part(now.tangent_by_friction_coefficient) * terms.mu.derivatives() +
                                      part(now.tangent_by_half_length) * terms.a.derivatives() +
                                      part(now.tangent_by_half_width) * terms.b.derivatives() +
                                      part(by_speed) * terms.speed.derivatives());
        };
        force = {combine([](const TangentialForce<double>& f) { return f.longitudinal; }),
                 combine([](const TangentialForce<double>& f) { return f.lateral; }),
                 combine([](const TangentialForce<double>& f) { return f.moment; })};
        return now.status;
    }

    /// The wheel's motion; the roll is given, or follows from equal loads.
    template <int partials>
    void move(Pass<partials>& pass, const RowWeights<ContactTable::most_loads>& weights, double root) const {
        using Number = Dual<partials>;
        Number rolled = input<partials>(WheelForces::roll);
        if (!has_roll_) {
            rolled = constant<partials>(0);
            for (std::size_t l = 0; l < loads_; ++l) {
                const ContactTable::Sample<1>& own = rolls_[l];
                rolled.value() += weights.value[l] * own.value[0];
                if constexpr (by_inputs<partials>) {
                    rolled.derivatives()[WheelForces::lateral] += weights.value[l] * own.by_shift[0];
                    rolled.derivatives()[WheelForces::yaw] += weights.value[l] * own.by_yaw[0];
                }
                if constexpr (partials > none)
                    rolled.derivatives()[by_sum<partials>] += weights.rate[l] * own.value[0] / (3 * root * root);
            }
        }
        pass.velocity.emplace(
            typename WheelsetVelocity<Number>::Speeds{
                input<partials>(WheelForces::forward), input<partials>(WheelForces::pitch_rate),
                input<partials>(WheelForces::lateral_speed), input<partials>(WheelForces::vertical_speed),
                input<partials>(WheelForces::roll_rate), input<partials>(WheelForces::yaw_rate)},
            rolled, input<partials>(WheelForces::yaw));
    }

    // --- balance

    /// Finds the sum of vertical normal loads with which normal forces and friction carry the load: Newton's method,
    /// whose last step is taken along the tangents.
    template <int partials>
    void balance() {
        // errors of values are as the square of the last step, errors of tangents as the step
        constexpr double settled = by_inputs<partials> ? 1e-7 : 1e-5;
        Pass<partials> pass;
        Pass<none> values;
        double sum = secants(values).value_or(inputs_[WheelForces::load]);
        for (int round = 0; round < 30; ++round) {
            result_.status = at_sum(pass, sum);
            if (result_.status != Status::ok) return;
            const double change = pass.excess.value() / pass.excess.derivatives()[by_sum<partials>];
            if (!is_finite(change)) break;
            if (std::abs(change) <= settled * sum) return finish(pass, change);
            sum -= std::clamp(change, -sum, sum / 2);
        }
        result_.status = Status::no_solution;
    }

    /// The balance without tangents.
    void balance_values() {
        Pass<none> pass;
        if (!secants(pass)) return balance<one>();
        result_.status = Status::ok;
        finish(pass, 0);
    }

    /// The sum of vertical normal loads by secants on values alone, first in single precision and, if no tangents
    /// follow, then in double precision; nothing if the secants do not converge at once.
    std::optional<double> secants(Pass<none>& pass) {
        constexpr double settled = 1e-8, known = 1e-5;
        const double load = inputs_[WheelForces::load], missed = tangents_ ? 3e-8 : settled / 2;
        double sum = load, last = 0, before = -load, rate = 0;  // without normal loads nothing is carried
        is_rough_ = true;
        for (int round = 0; round < 10; ++round) {
            if (at_sum(pass, sum) != Status::ok) break;
            const double excess = pass.excess.value(), step = std::abs(sum - last);
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
    template <int partials>
    Status at_sum(Pass<partials>& pass, double sum) {
        using Number = Dual<partials>;
        const double root = std::cbrt(sum);
        const auto weights = hermite_weights<ContactTable::most_loads>(table_.roots_, root);
        move(pass, weights, root);
        const auto count = std::size_t(side_->given.zones.count());
        std::array<Number, ContactZones::most> shares;
        Number total = constant<partials>(0);
        const bool one_carries = carry_count() == 1;
        for (std::size_t k = 0; k < count; ++k) {
            shares[k] = constant<partials>(one_carries && zones_[k].carries ? 1 : 0);
            if (!one_carries && zones_[k].carries) shares[k] = share<partials>(zones_[k], root);
            total += shares[k];
        }
        if (!(total.value() > 0)) return Status::wrong_table;
        Number whole = constant<partials>(sum);
        if constexpr (partials > none) whole.derivatives()[by_sum<partials>] = 1;
        pass.excess = whole - input<partials>(WheelForces::load);
        pass.stands = false;
        for (std::size_t k = 0; k < count; ++k) {
            pass.contacts[k].share = 0;
            if (!(shares[k].value() > 0)) continue;
            const Number part = shares[k] / total, load = part * whole;
            if (load.value() < least_load) continue;
            interpolate<partials>(zones_[k], Eigen::Index(k), weights, root);
            pass.contacts[k].share = part.value();
            const Status status = press(pass, k, load);
            if (status != Status::ok) return status;
            pass.excess -= pass.contacts[k].force[1] * pass.contacts[k].sine;
        }
        return Status::ok;
    }

    /// Value of a number after the sum has fallen by `change`.
    template <int partials>
    static double after(const Dual<partials>& number, double change) {
        if constexpr (partials == none) {
            return number.value();
        } else {
            return number.value() - number.derivatives()[by_sum<partials>] * change;
        }
    }

    /// Writes a point as after the last step, so that its numbers agree with the wrench.
    template <int partials>
    void settle(std::size_t zone, const Contact<partials>& of, double change) {
        const auto settled = [&](const Dual<partials>& number) { return after(number, change); };
        WheelForces::Point& point = result_.points[zone];
        const ContactRow::Values& row = zones_[zone].value;
        point.load_share = of.share;
        point.rolling_radius = row[ContactRow::radius];
        point.rail_y = row[ContactRow::rail_y];
        point.wheel_y = row[ContactRow::wheel_y];
        point.peak_pressure = row[ContactRow::peak] * std::cbrt(of.normal.value());
        point.ellipse = PatchContact<double>(ellipse(of.half_length.value(), of.half_width.value()));
        point.normal_load = settled(of.normal);
        point.angle = settled(of.angle);
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
    template <int partials>
    void finish(const Pass<partials>& pass, double change) {
        using Number = Dual<partials>;
        std::array<Number, 6> wrench;
        wrench.fill(constant<partials>(0));
        for (std::size_t k = 0; k < std::size_t(side_->given.zones.count()); ++k) {
            const Contact<partials>& of = pass.contacts[k];
            if (!(of.share > 0)) continue;
            const auto& [r_x, r_y, r_z] = of.arm;
            const Number f_x = of.force[0], f_y = of.force[1] * of.cosine + of.normal * of.sine,
                         f_z = of.force[1] * of.sine - of.normal * of.cosine;
            wrench[0] += f_x;
            wrench[1] += f_y;
            wrench[2] += f_z;
            wrench[3] += r_y * f_z - r_z * f_y;
            wrench[4] += r_z * f_x - r_x * f_z - of.force[2] * of.sine;
            wrench[5] += r_x * f_y - r_y * f_x + of.force[2] * of.cosine;
            settle(k, of, change);
            result_.heat += result_.points[k].heat;
        }
        const std::array<double, 6> signs{along_, mirror_, 1, mirror_, along_, along_ * mirror_};
        for (Eigen::Index i = 0; i < 6; ++i) {
            const Number& component = wrench[std::size_t(i)];
            result_.force[i] = signs[std::size_t(i)] * after(component, change);
            if constexpr (by_inputs<partials>) {
                const double slope = component.derivatives()[by_sum<partials>];
                const Gradient<partials> gradient =
                    component.derivatives() -
                    slope / pass.excess.derivatives()[by_sum<partials>] * pass.excess.derivatives();
                for (Eigen::Index j = 0; j < WheelForces::inputs; ++j) {
                    result_.tangent(i, j) = signs[std::size_t(i)] * sign_of(j) * gradient[j];
                }
            }
        }
        const double sum = result_.force.sum() + result_.tangent.sum() + result_.heat;
        if (!is_finite(sum)) result_.status = Status::not_finite;
        if (pass.stands && result_.status == Status::ok) {
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
    const CreepForceTable& creep_;
    const WheelFriction& friction_;
    const ContactTable::Stored* side_ = nullptr;
    WheelForces result_;
    std::array<double, WheelForces::inputs> inputs_{};
    double mirror_ = 1, along_ = 1;
    bool tangents_, is_rough_ = true, has_roll_ = false;
    Dual<all> shift_;
    ContactTable::Cell cell_{0, {0, 0, 1}, {}};
    std::size_t loads_ = 0;
    std::array<ContactTable::Sample<1>, ContactTable::most_loads> rolls_;  // rolls of equal loads
    std::array<Zone, ContactZones::most> zones_;
};

}  // namespace rollbem::detail

namespace rollbem {

template <std::same_as<double> Scalar>
WheelForces ContactTable::look_up(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                                  const WheelsetSpeeds& speeds, const WheelLoad& load,
                                  const WheelFriction& friction) const noexcept {
    return detail::WheelLookUp(*this, creep, friction, true)(side, position, speeds, load);
}

template <std::same_as<double> Scalar>
WheelForces ContactTable::forces(const CreepForceTable& creep, WheelsetSide side, const WheelsetPosition& position,
                                 const WheelsetSpeeds& speeds, const WheelLoad& load,
                                 const WheelFriction& friction) const noexcept {
    return detail::WheelLookUp(*this, creep, friction, false)(side, position, speeds, load);
}

}  // namespace rollbem
