// Force elements of tests/laws: wheels by look-up.
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>

#include <Eigen/Geometry>

#include <rollbem/vehicle.hpp>

#include "laws/force_element.hpp"
#include "vehicle/made_tables.hpp"

namespace laws {

using testing::s1002_60e1, testing::steel;

/// -1 stands for the left side, 1 for the right one, and nothing for any other number.
inline WheelsetSide side_of(double sign) {
    if (std::abs(sign) != 1) throw std::invalid_argument("no side");
    return sign < 0 ? WheelsetSide::left : WheelsetSide::right;
}

/// Forces by the inputs of WheelForces, where a roll of 0 stands for that of equal loads, and the side, -1 for left.
inline WheelForces wheel_forces(const Numbers& x, ContactTable::Friction friction = {}, bool tangents = true) {
    friction.coefficient = x[9];
    const auto answer = tangents ? &ContactTable::look_up : &ContactTable::forces;
    return (s1002_60e1().*answer)(steel(), side_of(x[11]), {.lateral = x[0], .yaw = x[1]},
                                  {x[2], x[3], x[4], x[5], x[6], x[7]},
                                  {x[8], x[10] != 0 ? std::optional(x[10]) : std::nullopt}, friction);
}

inline Numbers draw_wheel(Draw& draw, bool rolls, double largest_shift = 8e-3) {
    const double lateral = largest_shift * draw.uniform(-1, 1) * (rolls ? 0.8 : 1), yaw = draw.uniform(-0.014, 0.014);
    Numbers x(12);
    x << lateral, yaw, 30, -30 / 0.46 + draw.uniform(-0.1, 0.1), draw.uniform(-0.1, 0.1), draw.uniform(-0.05, 0.05),
        draw.uniform(-0.05, 0.05), draw.uniform(-0.05, 0.05), 1e5 * draw.uniform(0.5, 1.5), draw.uniform(0.2, 0.4), 0,
        draw.sign();
    if (rolls) x[10] = s1002_60e1().on_rails(lateral, yaw).roll + draw.uniform(-1e-4, 1e-4);
    return x;
}

/// Values are forces, moments and heat. The table gives all lengths.
inline ForceElement wheel_look_up(bool rolls, const ContactTable::Friction& friction) {
    constexpr double Q = 1e5;
    const Quantity length{1e-4}, slide{0.03, 0, 0, -1}, turn{0.02, 0, 0, -1};
    steel(), s1002_60e1();  // are read now, not by an answer
    ForceElement result{
        .name = rolls ? "a wheel, with a roll" : "a wheel",
        .inputs = {length, length, slide, {0.06, 0, 0, -1}, slide, slide, turn, turn, {Q}, {0.3}, length, {0}},
        .values = {{Q}, {Q}, {Q}, {Q}, {Q}, {Q}, {Q, 0, 0, -1}},
        .draw = [rolls](Draw& draw) { return draw_wheel(draw, rolls); },
        .answer =
            [rolls, friction](const Numbers& x) {
                const WheelForces at = wheel_forces(x, friction);
                Answer answer{Numbers(7), at.tangent.leftCols(rolls ? 11 : 10), at.status};
                answer.values << at.force, at.status == Status::ok ? at.heat : nan;
                if (at.status != Status::ok) answer.tangent.setConstant(nan);
                return answer;
            },
        .symmetries = {{"the other wheel", "--++-+--++--", "+-+-+-+"}, {"backwards", "+---+++-++++", "-+++--+"}},
        .refusals = {{0, {-1, 9.1e-3}, Status::wrong_table},
                     {1, {0.1, -1}, Status::wrong_table},
                     {8, {-1, -1e-300, 1e151, 1e300}, Status::invalid_load},
                     {9, {-1, -1e-300}, Status::invalid_load}}};
    result.on_rail = [friction](const Numbers& x) {
        const double sign = x[11];
        const Eigen::DiagonalMatrix<double, 3> mirror(1, sign, 1);
        std::vector<Wrench> parts;
        for (const WheelForces::Point& point : wheel_forces(x, friction).points) {
            if (!(point.load_share > 0)) continue;
            const Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
            const Eigen::AngleAxisd normal(point.angle, axis), plane(point.friction_angle, axis);
            const auto& [along, across, moment] = point.force;
            parts.push_back({mirror * Eigen::Vector3d(point.arm[0], point.arm[1], point.arm[2]),
                             mirror * (normal * Eigen::Vector3d(0, 0, point.normal_load) -
                                       plane * Eigen::Vector3d(along, across, 0)),
                             -sign * (mirror * (plane * Eigen::Vector3d(0, 0, moment)))});
        }
        return parts;
    };
    for (std::size_t j = 0; j < 10; ++j) result.refusals.push_back({j, {nan, infinite, -infinite}, Status::not_finite});
    return result;
}

/// Height and roll by lateral shift, yaw, mean and half of the difference of both loads.
inline ForceElement height_and_roll() {
    return {.name = "height and roll",
            .inputs = {{1e-4}, {1e-3}, {1e5}, {1e5}},
            .values = {{1e-4}, {1e-4}},
            .draw =
                [](Draw& draw) {
                    Numbers x(4);
                    x << draw.uniform(-6e-3, 6e-3), draw.uniform(-0.012, 0.012), draw.uniform(7e4, 1.3e5),
                        draw.uniform(-2e4, 2e4);
                    return x;
                },
            .answer =
                [](const Numbers& x) {
                    const auto at = s1002_60e1().on_rails(x[0], x[1], {x[2] - x[3], x[2] + x[3]});
                    Answer answer{Numbers(2), Tangent(2, 4)};
                    answer.values << at.height, at.roll;
                    answer.tangent << at.height_by_lateral, at.height_by_yaw,
                        at.height_by_load[0] + at.height_by_load[1], at.height_by_load[1] - at.height_by_load[0],
                        at.roll_by_lateral, at.roll_by_yaw, at.roll_by_load[0] + at.roll_by_load[1],
                        at.roll_by_load[1] - at.roll_by_load[0];
                    return answer;
                },
            .symmetries = {{"across the track", "--+-", "+-"}}};
}

/// The load of a wheel by lateral shift, yaw, its height, and the side, -1 for left.
inline ForceElement load_at_height() {
    return {.name = "the load of a wheel at a height",
            .inputs = {{1e-4}, {1e-3}, {1e-4}, {0}},
            .values = {{1e5}},
            .draw =
                [](Draw& draw) {
                    Numbers x(4);
                    const double lateral = draw.uniform(-6e-3, 6e-3), yaw = draw.uniform(-0.012, 0.012);
                    const double side = draw.sign(), Q = draw.uniform(5e4, 1.3e5);
                    const auto at = s1002_60e1().on_rails(lateral, yaw, {Q, Q});
                    x << lateral, yaw, at.height + side * ContactTable::half_base * at.roll, side;
                    return x;
                },
            .answer =
                [](const Numbers& x) {
                    const auto at = s1002_60e1().load_at_height(side_of(x[3]), x[0], x[1], x[2]);
                    Answer answer{Numbers::Constant(1, at.load), Tangent(1, 3), at.status};
                    answer.tangent << at.by_lateral, at.by_yaw, at.by_height;
                    if (at.status != Status::ok) answer.tangent.setConstant(nan);
                    return answer;
                },
            .symmetries = {{"the other wheel", "--+-", "+"}},
            .refusals = {{0, {-1, 9.1e-3}, Status::wrong_table}, {1, {0.1, -1}, Status::wrong_table}}};
}

}  // namespace laws
