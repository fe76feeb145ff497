// Interpolation of the numbers of a ContactTable. Internal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "../contact_table.hpp"
#include "table_weights.hpp"
#include "widened.hpp"

namespace rollbem {

struct ContactTable::Interpolation {
    const ContactTable& table;

    static constexpr const char* name = "ContactTable";
    static constexpr const char* magic = "rollbem contact geometry";
    static constexpr std::uint32_t version = 2;

    /// A place on the grid, without the load.
    struct Cell {
        std::size_t shift;
        detail::HermiteWeights along;
        detail::RowWeights<most_yaws> across;
    };
    Cell cell(double lateral, double yaw) const noexcept {
        const std::size_t i = detail::interval_of(table.grid_.shifts, lateral);
        return {i,
                {lateral, table.grid_.shifts[i], table.grid_.shifts[i + 1]},
                detail::even_weights<most_yaws>(table.grid_.yaws, yaw)};
    }
    template <int Rows>
    struct Sample {
        Eigen::Array<double, Rows, 1, Eigen::DontAlign> value, by_shift, by_yaw;
    };
    /// Number of rows in whole packets that have derivatives; places on the profiles follow without.
    static constexpr int differentiated_rows = packed_rows - 4;
    static_assert(ContactRow::peak <= differentiated_rows && ContactRow::rail_y >= differentiated_rows);
    /// Rows of a point over their means, at the place, under one load of the table.
    struct LoadedRows {
        Eigen::Array<double, packed_rows, 1> value;
        Eigen::Array<double, differentiated_rows, 1> by_shift, by_yaw;
    };
    Eigen::Index first_node(std::size_t load) const { return table.grid_.node(load, 0, 0); }

    /// Height of a wheel and roll at a load, with derivatives by shift, yaw and load.
    struct WheelOnRails {
        std::array<double, 4> height, roll;
    };

    /// Rows of a field with slopes, at the nodes of one load, which begin at `first`.
    template <int Rows, class Field>
    auto sample(const Cell& at, const Field& values, const Field& slopes, Eigen::Index row,
                Eigen::Index first) const noexcept -> Sample<Rows> {
        using Values = Eigen::Array<double, Rows, 1, Eigen::DontAlign>;
        Sample<Rows> found{Values::Zero(), Values::Zero(), Values::Zero()};
        const auto& [w, rate] = at.along;
        for (std::size_t k = 0; k < table.grid_.yaws.size(); ++k) {
            const Eigen::Index node = first + Eigen::Index(k * table.grid_.shifts.size() + at.shift);
            const double across = at.across.value[k], turning = at.across.rate[k];
            for (Eigen::Index i = 0; i < Rows; ++i) {
                const double one = double(values(row + i, node)), rise = double(values(row + i, node + 1)) - one,
                             three = double(slopes(row + i, node)), four = double(slopes(row + i, node + 1));
                const double here =
                    one + w[1] * rise + w[2] * three + w[3] * four;  // the first two weights add up to 1
                found.value[i] += across * here;
                found.by_yaw[i] += turning * here;
                found.by_shift[i] += across * (rate[1] * rise + rate[2] * three + rate[3] * four);
            }
        }
        return found;
    }

    /// Without `derivatives`, the derivatives in `found` are left unchanged.
    template <bool derivatives>
    void sample_rows(const Cell& at, const Stored& side, Eigen::Index zone, std::size_t load,
                     LoadedRows& found) const noexcept {
        using Four = Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>;
        const double w1 = at.along.value[1], w2 = at.along.value[2], w3 = at.along.value[3];
        for (std::size_t k = 0; k < table.grid_.yaws.size(); ++k) {
            const Eigen::Index node = zone * table.grid_.nodes() + table.grid_.node(load, k, at.shift);
            const float *points = side.points.col(node).data(), *slopes = side.slopes.col(node).data();
            const double across = at.across.value[k], turning = at.across.rate[k], r1 = across * at.along.rate[1],
                         r2 = across * at.along.rate[2], r3 = across * at.along.rate[3];
            const bool is_first = k == 0;
            const auto add = [is_first](auto to, const Eigen::Array4d& more) { is_first ? to = more : to += more; };
            for (int i = 0; i < packed_rows; i += 4) {
                const Eigen::Array4d one = detail::widened(Four(points + i)),
                                     rise = detail::widened(Four(points + packed_rows + i) - Four(points + i)),
                                     low = detail::widened(Four(slopes + i)),
                                     high = detail::widened(Four(slopes + packed_rows + i));
                // the first two weights add up to 1
                const Eigen::Array4d here = one + w1 * rise + w2 * low + w3 * high;
                add(found.value.template segment<4>(i), across * here);
                if constexpr (!derivatives) continue;
                if (i >= differentiated_rows) continue;
                add(found.by_shift.template segment<4>(i), r1 * rise + r2 * low + r3 * high);
                add(found.by_yaw.template segment<4>(i), turning * here);
            }
        }
    }

    auto wheel_on_rails(const Stored& side, double lateral, double yaw, double load) const noexcept -> WheelOnRails {
        const double root = std::cbrt(load);
        const auto weights = detail::hermite_weights<most_loads>(table.roots_, root);
        const Cell at = cell(lateral, yaw);
        WheelOnRails found{};
        for (std::size_t l = weights.first; l < weights.last; ++l) {
            const Sample<2> own = sample<2>(at, side.given.on_rails, side.on_rails_slopes, 0, first_node(l));
            for (auto [of, row] : {std::pair(&found.height, 0), {&found.roll, 1}}) {
                (*of)[0] += weights.value[l] * own.value[row];
                (*of)[1] += weights.value[l] * own.by_shift[row];
                (*of)[2] += weights.value[l] * own.by_yaw[row];
                (*of)[3] += weights.rate[l] * own.value[row] / (3 * root * root);
            }
        }
        return found;
    }
    Stored stored(Side side) const;
};

}  // namespace rollbem
