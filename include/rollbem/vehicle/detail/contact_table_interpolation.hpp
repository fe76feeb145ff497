// Interpolation of the numbers of a ContactTable. Internal.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <Eigen/Core>

#include "../contact_table.hpp"
#include "table_weights.hpp"
#include "to_double.hpp"

namespace rollbem {

struct ContactTable::Interpolation {
    const ContactTable& table;

    static constexpr const char* name = "ContactTable";
    static constexpr const char* magic = "rollbem contact geometry";
    static constexpr std::uint32_t version = 3;

    /// A place on the grid, without the load.
    struct Cell {
        std::size_t shift;
        double yaw;
        detail::HermiteWeights along;
        detail::RowWeights<most_yaws> across;
    };
    Cell cell(double lateral, double yaw) const noexcept {
        const std::size_t i = detail::interval_of(table.grid_.shifts, lateral);
        return {i,
                yaw,
                {lateral, table.grid_.shifts[i], table.grid_.shifts[i + 1]},
                detail::even_weights<most_yaws>(table.grid_.yaws, yaw)};
    }
    template <int Rows>
    struct Sample {
        Eigen::Array<double, Rows, 1, Eigen::DontAlign> value, by_shift, by_yaw;
    };
    /// Rows in whole packets that forces depend on; then peak and places, which have no derivatives.
    static constexpr int differentiated_rows = ContactRow::peak, sampled_rows = differentiated_rows + 4;
    static_assert(differentiated_rows % 4 == 0 && sampled_rows == int(ContactRow::correction_by_yaw) + 1);
    /// Rows of a point over their means, at the place, under one load of the table; the correction with its odd part.
    struct LoadedRows {
        Eigen::Array<double, packed_rows, 1> value, by_shift, by_yaw;
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
        const double w1 = at.along.value[1], w2 = at.along.value[2], w3 = at.along.value[3], r1 = at.along.rate[1],
                     r2 = at.along.rate[2], r3 = at.along.rate[3];
        const Eigen::Index first = zone * table.grid_.nodes() + table.grid_.node(load, 0, at.shift);
        const auto next = Eigen::Index(table.grid_.shifts.size() * packed_rows);  // from one yaw to the next
        for (int i = 0; i < packed_rows; i += 4) {
            const float *points = side.points.col(first).data() + i, *slopes = side.slopes.col(first).data() + i;
            Eigen::Array4d value = Eigen::Array4d::Zero(), by_shift = value, by_yaw = value;
            for (std::size_t k = 0; k < table.grid_.yaws.size(); ++k, points += next, slopes += next) {
                const double across = at.across.value[k], turning = at.across.rate[k];
                const Eigen::Array4d one = detail::to_double(Four(points)),
                                     rise = detail::to_double(Four(points + packed_rows) - Four(points)),
                                     low = detail::to_double(Four(slopes)),
                                     high = detail::to_double(Four(slopes + packed_rows));
                // the first two weights add up to 1
                const Eigen::Array4d here = one + w1 * rise + w2 * low + w3 * high;
                value += across * here;
                if constexpr (!derivatives) continue;
                by_shift += across * (r1 * rise + r2 * low + r3 * high);
                by_yaw += turning * here;
            }
            found.value.template segment<4>(i) = value;
            if constexpr (!derivatives) continue;
            found.by_shift.template segment<4>(i) = by_shift;
            found.by_yaw.template segment<4>(i) = by_yaw;
        }
        const auto add_odd_part = [&](auto& rows) {
            rows.template segment<9>(ContactRow::correction) +=
                at.yaw * rows.template segment<9>(ContactRow::correction_by_yaw);
        };
        if constexpr (derivatives) {
            add_odd_part(found.by_shift);
            add_odd_part(found.by_yaw);
            found.by_yaw.template segment<9>(ContactRow::correction) +=
                found.value.template segment<9>(ContactRow::correction_by_yaw);
        }
        add_odd_part(found.value);
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
