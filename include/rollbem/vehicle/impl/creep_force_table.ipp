// Bodies of vehicle/creep_force_table.hpp. Internal.
#pragma once

#include "../creep_force_table.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <numbers>
#include <ostream>
#include <utility>

#include "../../closed_form/carter.hpp"
#include "../../detail/checked_stream.hpp"
#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../detail/cubic_spline.hpp"
#include "../detail/finite_force.hpp"
#include "../detail/to_double.hpp"

namespace rollbem {

ROLLBEM_DECL CreepForceTable::Grid::Grid(double poisson_ratio, double smallest_a_over_b, double largest_a_over_b,
                                         int levels, std::vector<CreepCoefficients<double>> coefficients)
    : nu_(poisson_ratio),
      smallest_(smallest_a_over_b),
      largest_(largest_a_over_b),
      levels_(levels),
      coefficients_(std::move(coefficients)) {
    detail::require(detail::is_finite(nu_) && nu_ >= 0 && nu_ <= 0.5, name, "poisson_ratio", nu_, "lie in [0, 0.5]");
    detail::require(detail::is_finite(smallest_) && smallest_ > 0, name, "smallest_a_over_b", smallest_,
                    "be positive and finite");
    detail::require(detail::is_finite(largest_) && largest_ > smallest_, name, "largest_a_over_b", largest_,
                    "be finite and above the smallest");
    detail::require(levels_ >= 4 && levels_ <= 64, name, "levels", levels_, "lie in [4, 64]");
    detail::require(shapes() >= 4 && shapes() <= 1000, name, "number of ellipses", shapes(), "lie in [4, 1000]");
    const Eigen::Index count = coefficient_count(levels_, shapes());
    detail::require(count <= most_coefficients, name,
                    "number of coefficients (levels + 3)^2 (2 levels + 3) (shapes + 2)", count, "be at most 10000000");
    scales_.resize(4, shapes());
    for (Eigen::Index i = 0; i < shapes(); ++i) {
        const CreepCoefficients<double>& c = coefficients_[static_cast<std::size_t>(i)];
        for (const double one : {c.c11, c.c22, c.c23, -c.c32, c.c33}) {
            detail::require(detail::is_finite(one) && one > 0, name, "creep coefficient (c32: its negative)", one,
                            "be positive and finite");
        }
        scales_.col(i) << c.c11, c.c22, c.c23, std::sqrt(c.c11 * c.c22);
    }
    for (int i = 0; i < levels_; ++i) {
        for (int j = -levels_ + 1; j < levels_; ++j) {
            for (int k = j < 0 ? 1 : 0; k < levels_; ++k) {
                const int square = i * i + j * j + k * k;
                if (square > 0 && square < levels_ * levels_) nodes_.push_back({i, j, k});
            }
        }
    }
}

ROLLBEM_DECL auto CreepForceTable::Grid::slabs() const -> std::vector<Slab> {
    std::vector<Slab> slabs;
    for (Eigen::Index shape = 0; shape < shapes(); ++shape) {
        for (Eigen::Index node = 0; node < nodes(); ++node) {
            if (node == 0 || place(node).x != place(node - 1).x) slabs.push_back({shape, node, node});
            ++slabs.back().last;
        }
    }
    return slabs;
}

}  // namespace rollbem

namespace rollbem::detail {

/// The forces of one ellipse on the whole cube of the lattice, -n-2 ... n+2 in all directions, during its making.
class ForceLattice {
public:
    using Value = Eigen::Array<double, 3, 1>;

    explicit ForceLattice(int levels)
        : n_(levels), m_(levels + 2), w_(2 * m_ + 1), values_(static_cast<std::size_t>(w_ * w_ * w_), Value::Zero()) {}

    Value& at(int x, int y, int spin) { return values_[place(x, y, spin)]; }

    /// Sets a node and its mirror images. Components that vanish by symmetry are set to 0.
    void set(int x, int y, int spin, Value force) {
        if (x == 0) force[0] = 0;
        if (y == 0 && spin == 0) force[1] = force[2] = 0;
        for (const int s : {1, -1}) {
            for (const int t : {1, -1}) at(s * x, t * y, t * spin) = {s * force[0], t * force[1], t * force[2]};
        }
    }

    /// Spline coefficients of the given nodes inside and of an extension outside. The extension continues 1/|X| with
    /// the opposite sign, f(2 n - |u|) = 2 f_slide - f(|u|), so that the derivative with respect to 1/|X| is continuous
    /// in full sliding. The values inside depend on the spline, hence the iteration. A step of 2/3 leaves about a third
    /// of the error, also at nodes that are nearly their own mirror image, where a full step would only change the
    /// error's sign.
    void complete(const CreepForceTable::Grid& grid, Eigen::Index shape) {
        struct Outer {
            int x, y, spin;
            double size;
            Value sliding;
        };
        std::vector<Outer> outer;
        for (int x = 0; x <= m_; ++x) {
            for (int y = -m_; y <= m_; ++y) {
                for (int spin = 0; spin <= m_; ++spin) {
                    const double size = std::sqrt(double(x * x + y * y + spin * spin));
                    if (size < n_ || size > n_ + 3 || (spin == 0 && y < 0)) continue;
                    const Creepage v = grid.creepage(shape, Eigen::Array3d(x, y, spin));
                    const auto full = full_sliding(grid.a_over_b(shape), v.longitudinal, v.lateral, v.spin);
                    outer.push_back({x, y, spin, size, {full.longitudinal, full.lateral, full.moment}});
                }
            }
        }
        for (const Outer& node : outer) set(node.x, node.y, node.spin, node.sliding);
        fill_corners();
        const std::vector<Value> given = values_;
        std::vector<Value> mirrored;
        for (const Outer& node : outer) mirrored.push_back(node.sliding);
        for (int pass = 0; pass < 6; ++pass) {
            to_coefficients();
            for (std::size_t i = 0; i < outer.size(); ++i) {
                const Outer& node = outer[i];
                const double factor = (2 * n_ - node.size) / node.size;
                const Value image = interpolate(factor * node.x, factor * node.y, factor * node.spin);
                mirrored[i] += (2 * node.sliding - image - mirrored[i]) * 2 / 3;
            }
            values_ = given;
            for (std::size_t i = 0; i < outer.size(); ++i) set(outer[i].x, outer[i].y, outer[i].spin, mirrored[i]);
            fill_corners();
        }
        to_coefficients();
    }

private:
    std::size_t place(int x, int y, int spin) const {
        return static_cast<std::size_t>(((x + m_) * w_ + y + m_) * w_ + spin + m_);
    }

    /// Fills nodes that only nodes outside need with the nearest of these.
    void fill_corners() {
        for (int x = -m_; x <= m_; ++x) {
            for (int y = -m_; y <= m_; ++y) {
                for (int spin = -m_; spin <= m_; ++spin) {
                    const double size = std::sqrt(double(x * x + y * y + spin * spin));
                    if (size <= n_ + 3) continue;
                    const double factor = (n_ + 2) / size;
                    const auto nearest = [&](int k) { return static_cast<int>(std::lround(factor * k)); };
                    at(x, y, spin) = at(nearest(x), nearest(y), nearest(spin));
                }
            }
        }
    }

    void to_coefficients() {
        std::vector<double> factors;
        for (int i = 0; i < w_; ++i) {
            for (int j = 0; j < w_; ++j) {
                to_spline_coefficients(&values_[static_cast<std::size_t>((i * w_ + j) * w_)], w_, 1, factors);
            }
        }
        for (int i = 0; i < w_; ++i) {
            for (int j = 0; j < w_; ++j) {
                to_spline_coefficients(&values_[static_cast<std::size_t>(i * w_ * w_ + j)], w_, w_, factors);
            }
        }
        for (int i = 0; i < w_ * w_; ++i) {
            to_spline_coefficients(&values_[static_cast<std::size_t>(i)], w_, w_ * w_, factors);
        }
    }

    Value interpolate(double x, double y, double spin) const {
        const auto cell = [&](double u) { return std::clamp(static_cast<int>(std::floor(u)), 1 - m_, m_ - 2); };
        const int i = cell(x), j = cell(y), k = cell(spin);
        const SplineWeights by_x(x - i), by_y(y - j), by_spin(spin - k);
        Value sum = Value::Zero();
        for (int p = 0; p < 4; ++p) {
            for (int q = 0; q < 4; ++q) {
                for (int r = 0; r < 4; ++r) {
                    const double weight = by_x.value[static_cast<std::size_t>(p)] *
                                          by_y.value[static_cast<std::size_t>(q)] *
                                          by_spin.value[static_cast<std::size_t>(r)];
                    sum += weight * values_[place(i - 1 + p, j - 1 + q, k - 1 + r)];
                }
            }
        }
        return sum;
    }

    int n_, m_, w_;
    std::vector<Value> values_;
};

}  // namespace rollbem::detail

namespace rollbem {

struct CreepForceTable::Splines {
    const CreepForceTable& table;

    static constexpr const char* name = "CreepForceTable";
    static constexpr const char* magic = "rollbem creep forces";
    static constexpr std::uint32_t version = 4;
    static constexpr double most = 100;

    // Coefficients belong to nodes -1 ... n+1 for xi and phi, -n-1 ... n+1 for eta, -1 ... shapes for log(a/b): the
    // cell of any point has all its neighbours. Each node has four numbers, the last of which is 0.
    static constexpr std::size_t width = 4;
    Eigen::Index side() const { return table.n_ + 3; }
    Eigen::Index line() const { return 2 * table.n_ + 3; }
    Eigen::Index per_shape() const { return side() * line() * side(); }
    std::size_t at(Eigen::Index shape, Eigen::Index x, Eigen::Index y, Eigen::Index spin) const {
        return static_cast<std::size_t>((((shape + 1) * side() + x + 1) * line() + y + table.n_ + 1) * side() + spin +
                                        1) *
               width;
    }

    /// Forces over mu N and their derivatives with respect to the coordinates of the lattice, xi and phi not negative.
    struct Sample {
        Eigen::Array3d value, by_x, by_y, by_spin, by_shape;
    };

    /// The cell of nodes that holds a point, and the place in it.
    struct Cell {
        Eigen::Index s, i, j, k;
        detail::SplineWeights by_shape, by_x, by_y, by_spin;

        Cell(const CreepForceTable& of, double shape, double x, double y, double spin)
            : s(below(shape, 0, of.grid_.shapes() - 2)),
              i(below(x, 0, of.n_ - 1)),
              j(below(y, -of.n_, of.n_ - 1)),
              k(below(spin, 0, of.n_ - 1)),
              by_shape(shape - static_cast<double>(s)),
              by_x(x - static_cast<double>(i)),
              by_y(y - static_cast<double>(j)),
              by_spin(spin - static_cast<double>(k)) {}
        static Eigen::Index below(double u, Eigen::Index low, Eigen::Index high) {
            return (std::min)(low + static_cast<Eigen::Index>(u - static_cast<double>(low)), high);  // u >= low
        }
    };
    /// The four numbers of a node; the last is not used.
    using Quad = Eigen::Map<const Eigen::Array4f, Eigen::Aligned16>;
    /// The first of four neighbours in phi.
    const float* row_of(const Cell& cell, std::size_t p, std::size_t q) const {
        return table.coefficients_.data() + at(cell.s - 1, cell.i - 1 + static_cast<Eigen::Index>(p),
                                               cell.j - 1 + static_cast<Eigen::Index>(q), cell.k - 1);
    }

    /// An ellipse between the ellipses of the table.
    struct Ellipse {
        bool on_table;
        double shape;          ///< coordinate of the lattice; beyond the table its last ellipse's
        double shape_per_log;  ///< its derivative by log(a/b), 0 beyond the table
        Eigen::Index cell;     ///< cell of the lattice that contains the shape
        detail::SplineWeights by_shape;
        Eigen::Array4d linear, linear_by_shape;  ///< the scales of the grid
    };
    /// The difference between the linear law and the splines where creepage vanishes, over the coordinates of the
    /// lattice, and its derivative by the shape.
    struct RestCorrection {
        Eigen::Matrix3d value, by_shape;
        Eigen::Vector3d moment_by_shape;  ///< derivative of the linear law's moment
    };
    /// X mu N/(G a b) from scales of the grid.
    static Eigen::Array3d linear_law(const Eigen::Array4d& scales, double c, const Creepage& v) noexcept {
        return {scales[0] * v.longitudinal, scales[1] * v.lateral + scales[2] * c * v.spin, scales[3] * c * v.spin};
    }

    /// Coefficients of splines through the columns, with one more beyond either end.
    static Eigen::ArrayXXd with_ends(Eigen::ArrayXXd columns) {
        const Eigen::Index count = columns.cols();
        Eigen::ArrayXXd all(columns.rows(), count + 2);
        const auto curvature = [&](Eigen::Index i, Eigen::Index step) -> Eigen::ArrayXd {
            return 2 * columns.col(i) - 5 * columns.col(i + step) + 4 * columns.col(i + 2 * step) -
                   columns.col(i + 3 * step);
        };
        const Eigen::ArrayXd first = curvature(0, 1), last = curvature(count - 1, -1);
        std::vector<double> factors;
        for (Eigen::Index i = 0; i < columns.rows(); ++i) {
            detail::to_spline_coefficients(columns.data() + i, count, columns.rows(), factors);
        }
        all.middleCols(1, count) = columns;
        all.col(0) = 2 * columns.col(0) - columns.col(1) + first;
        all.col(count + 1) = 2 * columns.col(count - 1) - columns.col(count - 2) + last;
        return all;
    }

    auto sample(double shape, double x, double y, double spin) const noexcept -> Sample {
        const Cell cell(table, shape, x, y, spin);
        const detail::SplineWeights &by_shape = cell.by_shape, &by_x = cell.by_x, &by_y = cell.by_y,
                                    &by_spin = cell.by_spin;
        using Number = Eigen::Array4d;
        using Single = Eigen::Array4f;  // its digits suffice for a derivative
        Number value = Number::Zero(), along_x = value, along_y = value, along_spin = value;
        Single along_shape = Single::Zero();
        const std::array<double, 4>& share = by_shape.value;
        const auto single = [](double weight) { return static_cast<float>(weight); };
        const float slope_1 = single(by_shape.slope[1]), slope_2 = single(by_shape.slope[2]),
                    slope_3 = single(by_shape.slope[3]);
        const std::size_t next_shape = static_cast<std::size_t>(per_shape()) * width;
        for (std::size_t p = 0; p < 4; ++p) {
            Number line = Number::Zero(), line_y = line, line_spin = line;
            Single line_shape = Single::Zero();
            for (std::size_t q = 0; q < 4; ++q) {
                const float* const first = row_of(cell, p, q);
                Number here = Number::Zero(), here_spin = here;
                for (std::size_t t = 0; t < 4; ++t) {
                    const float* const from = first + t * width;
                    const Number node = share[0] * detail::to_double(Quad(from)) +
                                        share[1] * detail::to_double(Quad(from + next_shape)) +
                                        share[2] * detail::to_double(Quad(from + 2 * next_shape)) +
                                        share[3] * detail::to_double(Quad(from + 3 * next_shape));
                    here += by_spin.value[t] * node;
                    here_spin += by_spin.slope[t] * node;
                }
                Single here_shape = Single::Zero();
                for (std::size_t t = 0; t < 4; ++t) {
                    const float* const from = first + t * width;
                    const Single one = Quad(from);
                    // differences between ellipses suffice, as the slopes add up to 0
                    here_shape += single(by_spin.value[t]) * (slope_1 * (Quad(from + next_shape) - one) +
                                                              slope_2 * (Quad(from + 2 * next_shape) - one) +
                                                              slope_3 * (Quad(from + 3 * next_shape) - one));
                }
                line += by_y.value[q] * here;
                line_y += by_y.slope[q] * here;
                line_spin += by_y.value[q] * here_spin;
                line_shape += single(by_y.value[q]) * here_shape;
            }
            value += by_x.value[p] * line;
            along_x += by_x.slope[p] * line;
            along_y += by_x.value[p] * line_y;
            along_spin += by_x.value[p] * line_spin;
            along_shape += single(by_x.value[p]) * line_shape;
        }
        return {value.head<3>(), along_x.head<3>(), along_y.head<3>(), along_spin.head<3>(),
                along_shape.head<3>().cast<double>()};
    }

    /// The value without derivatives, to the rounding of Digits.
    template <class Digits>
    Eigen::Array3d value(double shape, double x, double y, double spin) const noexcept {
        const Cell cell(table, shape, x, y, spin);
        const std::array<double, 4>&share = cell.by_shape.value, &by_spin = cell.by_spin.value;
        const std::size_t next_shape = static_cast<std::size_t>(per_shape()) * width;
        using Number = Eigen::Array<Digits, 4, 1>;
        const auto wide = [](const Eigen::Array4f& node) -> Number {
            if constexpr (std::same_as<Digits, float>) {
                return node;
            } else {
                return detail::to_double(node);
            }
        };
        const auto digits = [](double weight) { return static_cast<Digits>(weight); };
        const Digits share_0 = digits(share[0]), share_1 = digits(share[1]), share_2 = digits(share[2]),
                     share_3 = digits(share[3]);
        std::array<Digits, 16> both;
        for (std::size_t i = 0; i < 16; ++i) both[i] = digits(cell.by_y.value[i / 4] * by_spin[i % 4]);
        Eigen::Array4d sum = Eigen::Array4d::Zero();
        for (std::size_t p = 0; p < 4; ++p) {
            Number line = Number::Zero();
            for (std::size_t q = 0; q < 4; ++q) {
                const float* from = row_of(cell, p, q);
                for (std::size_t t = 0; t < 4; ++t, from += width) {
                    const Number node = share_0 * wide(Quad(from)) + share_1 * wide(Quad(from + next_shape)) +
                                        share_2 * wide(Quad(from + 2 * next_shape)) +
                                        share_3 * wide(Quad(from + 3 * next_shape));
                    line += both[4 * q + t] * node;
                }
            }
            sum += cell.by_x.value[p] * line.template cast<double>();
        }
        return sum.head<3>();
    }

    auto ellipse(double a_over_b) const noexcept -> Ellipse {
        const double position = (std::log(a_over_b) - table.first_log_) * table.per_log_;
        const bool on_table = position >= -1e-12 && position <= 1 + 1e-12;
        const double shape = std::clamp(position, 0.0, 1.0) * static_cast<double>(table.grid_.shapes() - 1);
        const auto cell = (std::min)(static_cast<Eigen::Index>(shape), table.grid_.shapes() - 2);
        const detail::SplineWeights by_shape(shape - static_cast<double>(cell));
        const double shape_per_log = on_table ? static_cast<double>(table.grid_.shapes() - 1) * table.per_log_ : 0;
        Eigen::Array4d linear = Eigen::Array4d::Zero(), linear_by_shape = linear;
        for (Eigen::Index k = 0; k < 4; ++k) {
            const Eigen::Array4d of = table.scales_.col(cell + k).head<4>();
            linear += by_shape.value[static_cast<std::size_t>(k)] * of;
            linear_by_shape += by_shape.slope[static_cast<std::size_t>(k)] * of;
        }
        return {on_table, shape, shape_per_log, cell, by_shape, linear, linear_by_shape};
    }

    auto rest_correction(const Ellipse& on) const noexcept -> RestCorrection {
        const double step = CreepForceTable::Grid::saturation_scale /
                            static_cast<double>(table.n_);  // step of X for one level, at rest
        Eigen::Array<double, 7, 1> rest = Eigen::Array<double, 7, 1>::Zero(), changed = rest;
        for (Eigen::Index k = 0; k < 4; ++k) {
            const Eigen::Array<double, 7, 1> of = table.at_rest_.col(on.cell + k).template head<7>();
            rest += on.by_shape.value[static_cast<std::size_t>(k)] * of;
            changed += on.by_shape.slope[static_cast<std::size_t>(k)] * of;
        }
        const double c22 = on.linear[1], c23 = on.linear[2], c32 = rest[5], c33 = rest[6];
        const double couples = c32 / c22, turns = (c33 - couples * c23) / on.linear[3];
        RestCorrection correction;
        correction.value.col(0) << step - rest[0], 0, 0;
        correction.value.col(1) << 0, step - rest[1], couples * step - rest[3];
        correction.value.col(2) << 0, -rest[2], turns * step - rest[4];
        const double couples_by_shape = (changed[5] - couples * on.linear_by_shape[1]) / c22;
        const double turns_by_shape =
            (changed[6] - couples_by_shape * c23 - couples * on.linear_by_shape[2] - turns * on.linear_by_shape[3]) /
            on.linear[3];
        correction.by_shape.col(0) << -changed[0], 0, 0;
        correction.by_shape.col(1) << 0, -changed[1], couples_by_shape * step - changed[3];
        correction.by_shape.col(2) << 0, -changed[2], turns_by_shape * step - changed[4];
        correction.moment_by_shape << 0, step * couples_by_shape, step * turns_by_shape;
        return correction;
    }

    /// The factor that keeps a force within mu N, and its derivative by the size of the force over mu N.
    struct Bound {
        double factor = 1, slope = 0;

        explicit Bound(double size) {
            constexpr double margin = 5e-4;
            if (size <= 1 - margin) return;
            const double t = (std::min)((size - 1 + margin) / margin, 1.0);
            factor = (1 - margin + margin * t * (1 + t * (1 - t))) / size;
            slope = ((1 - t) * (1 + 3 * t) - factor) / size;
        }
    };
    static void limit(Eigen::Array3d& force) { force.head<2>() *= Bound(force.matrix().head<2>().norm()).factor; }
    static void limit(Sample& at) {
        const double size = at.value.matrix().head<2>().norm();
        const Bound bound(size);
        if (bound.slope == 0) return;
        const Eigen::Array2d force = at.value.head<2>();
        for (Eigen::Array3d* by : {&at.by_x, &at.by_y, &at.by_spin, &at.by_shape}) {
            const double grows = (force * by->head<2>()).sum() / size;
            by->head<2>() = bound.factor * by->head<2>() + bound.slope * grows * force;
        }
        at.value.head<2>() = bound.factor * force;
    }

    auto saturation_parameter(const PatchContact& contact, const Creepage& creepage) const noexcept -> LinearForce {
        const Ellipse on = ellipse(contact.a_over_b());
        const double c = contact.c(), stiffness = contact.shear_modulus() * c * c;
        const Eigen::Vector3d w = linear_law(on.linear, c, creepage);
        const double size = w.stableNorm();
        if (!(size > 0)) return {0, {}, 0, 0};
        const Eigen::Vector3d along = w * (stiffness / size);
        const Eigen::Vector3d spins(0, on.linear[2] * c, on.linear[3] * c);
        // derivatives by the logarithm of c at constant a/b, and by the logarithm of a/b
        const double by_size = 2 * stiffness * size + along.dot(spins) * creepage.spin;
        const double by_shape = on.shape_per_log * along.dot(linear_law(on.linear_by_shape, c, creepage).matrix());
        return {stiffness * size,
                {along[0] * on.linear[0], along[1] * on.linear[1], along.dot(spins)},
                (by_size / 2 + by_shape) / contact.half_length(),
                (by_size / 2 - by_shape) / contact.half_width()};
    }

    template <std::floating_point Digits>
    TangentialForce force(const PatchContact::Parameters& contact, double friction_coefficient, double load,
                          const Creepage& creepage) const noexcept {
        const double bound = friction_coefficient * load,
                     c = std::sqrt(contact.half_length) * std::sqrt(contact.half_width),
                     stiffness = contact.shear_modulus * c * c;
        const Ellipse on = ellipse(contact.half_length / contact.half_width);
        const Eigen::Array3d w = linear_law(on.linear, c, creepage);
        const CreepForceTable::Grid::Stretch stretch =
            CreepForceTable::Grid::stretch(bound / stiffness, w.matrix().stableNorm());
        if (std::isinf(stretch.factor)) return {0, 0, 0};
        const Eigen::Array3d u = w * (stretch.factor * static_cast<double>(table.n_));
        if (!detail::is_finite(u.sum())) return {u.sum(), u.sum(), u.sum()};
        const double turn = u[2] < 0 || (u[2] == 0 && u[1] < 0) ? -1 : 1;
        const Eigen::Vector3d place(std::abs(u[0]), turn * u[1], turn * u[2]);
        Eigen::Array3d of = value<Digits>(on.shape, place[0], place[1], place[2]);
        const double left = 1 - place.norm();
        if (left > 0) of += left * left * left * (3 - 2 * left) * (rest_correction(on).value * place).array();
        limit(of);
        return {(u[0] < 0 ? bound : -bound) * of[0], -bound * turn * of[1], -bound * turn * c * of[2]};
    }

    CreepForceTable::Force look_up(const PatchContact& contact, double friction_coefficient, double load,
                                   const Creepage& creepage) const noexcept {
        CreepForceTable::Force result;
        const auto ended = [&](Status status) {
            result.status = status;
            return result;
        };
        if (contact.outline() || !table.fits(contact.poisson_ratio())) {
            return ended(Status::wrong_table);
        }
        for (const double given : {friction_coefficient, load}) {
            if (!detail::is_finite(given) || !(given >= 0)) return ended(Status::invalid_load);
        }
        if (!detail::is_finite(creepage)) return ended(Status::not_finite);

        const double bound = friction_coefficient * load, c = contact.c(), stiffness = contact.shear_modulus() * c * c;
        const Ellipse on = ellipse(contact.a_over_b());
        const Eigen::Array4d &linear = on.linear, &linear_by_shape = on.linear_by_shape;
        result.a_over_b_on_table = on.on_table;
        const Eigen::Array4d unit = linear * Eigen::Array4d(1, 1, c, c);  // coordinates X mu N/(G a b) per creepage
        const Eigen::Array3d w = linear_law(linear, c, creepage);
        const double size = w.matrix().stableNorm();
        const CreepForceTable::Grid::Stretch stretch = CreepForceTable::Grid::stretch(bound / stiffness, size);
        if (!detail::is_finite(stretch.factor)) {  // no creepage, and no friction or too little to divide by
            const TangentialForce none{0, 0, 0};
            return {none, {none, none, none}, none, none, none, none, result.a_over_b_on_table, Status::ok};
        }
        const Eigen::Array3d u = w * (stretch.factor * static_cast<double>(table.n_));
        if (!detail::is_finite(u.sum())) return ended(Status::not_finite);  // creepage times c overflows
        const auto sign = [](double value) { return value > 0 ? 1.0 : value < 0 ? -1.0 : 0.0; };
        const double x_sign = sign(u[0]), sign_of_pair = u[2] != 0 ? sign(u[2]) : sign(u[1]);
        const double turn = sign_of_pair < 0 ? -1 : 1;
        Sample at = sample(on.shape, std::abs(u[0]), turn * u[1], turn * u[2]);
        // Second differences do not exist where creepage vanishes (forces are like xi - xi |xi|/3), so that the spline
        // misses the linear law there. The difference is added over the first step only.
        const double distance = u.matrix().norm();
        const Eigen::Vector3d place(std::abs(u[0]), turn * u[1], turn * u[2]);
        if (distance < 1) {
            const RestCorrection correction = rest_correction(on);
            const Eigen::Vector3d all = correction.value * place;
            const double left = 1 - distance, share = left * left * left * (1 + 2 * distance);
            const double slope = distance > 0 ? -left * left * (1 + 8 * distance) / distance : 0;  // d share, over |u|
            at.value += share * all.array();
            at.by_shape += share * (correction.by_shape * place).array();
            if (distance < 1e-9) {  // no rounding
                at.by_shape = Eigen::Array3d(0, 0, correction.moment_by_shape.dot(place));
            }
            at.by_x += share * correction.value.col(0).array() + slope * place[0] * all.array();
            at.by_y += share * correction.value.col(1).array() + slope * place[1] * all.array();
            at.by_spin += share * correction.value.col(2).array() + slope * place[2] * all.array();
        }
        if (distance < 1e-9) {  // no rounding
            at.value = at.by_x * place[0] + at.by_y * place[1] + at.by_spin * place[2];
        }
        limit(at);

        // The signs of the quadrant; between the two groups of symmetry derivatives change sign with both.
        const Eigen::Array3d signs(x_sign, sign_of_pair, sign_of_pair), force = at.value * signs;
        const double both = x_sign * sign_of_pair;
        Eigen::Matrix3d by_u;
        by_u.col(0) = at.by_x * Eigen::Array3d(1, both, both);
        by_u.col(1) = at.by_y * Eigen::Array3d(both, 1, 1);
        by_u.col(2) = at.by_spin * Eigen::Array3d(both, 1, 1);
        Eigen::Matrix3d slope = (-bound * stretch.factor * static_cast<double>(table.n_)) * by_u;
        if (size > 0) {
            const Eigen::Vector3d direction = w / size;
            const Eigen::Vector3d radial = slope * direction;
            slope -= radial * direction.transpose() * stretch.radial;
        }
        // Forces over c are homogeneous of degree 1 in mu N and w. Derivatives are taken
        //
        // - by mu N;
        // - by the logarithm of c at constant a/b: in w, in G a b and in the arm of the moment;
        // - by the logarithm of a/b: in w and in the table.
        const Eigen::Array3d along = slope * w.matrix(), by_bound = -force - along / (bound > 0 ? bound : 1);
        const Eigen::Vector3d w_by_shape = linear_law(linear_by_shape, c, creepage);
        Eigen::Array3d by_size = slope.rightCols<2>() * Eigen::Vector2d(unit[2] * creepage.spin, w[2]);
        by_size += 2 * along;
        by_size[2] -= bound * force[2];
        const Eigen::Array3d by_a_over_b =
            on.shape_per_log * ((slope * w_by_shape).array() - bound * at.by_shape * signs);
        slope.col(2) = unit[2] * slope.col(1) + unit[3] * slope.col(2);
        slope.col(1) *= unit[1];
        slope.col(0) *= unit[0];
        const auto in_si = [&](const Eigen::Array3d& of) { return TangentialForce{of[0], of[1], c * of[2]}; };
        const double a = contact.half_length(), b = contact.half_width();
        result.force = in_si(Eigen::Array3d::Zero() - bound * force);
        result.tangent = {in_si(slope.col(0)), in_si(slope.col(1)), in_si(slope.col(2))};
        result.tangent_by_load = in_si(friction_coefficient * by_bound);
        result.tangent_by_friction_coefficient = in_si(load * by_bound);
        result.tangent_by_half_length = in_si((by_size / 2 + by_a_over_b) / a);
        result.tangent_by_half_width = in_si((by_size / 2 - by_a_over_b) / b);
        return detail::is_finite(result) ? ended(Status::ok) : CreepForceTable::Force{};
    }

    /// Fills at_rest_ from the coefficients of the splines.
    static void fill_rest_correction(CreepForceTable& table);
};

ROLLBEM_DECL CreepForceTable::CreepForceTable(CreepForceTable::Grid grid)
    : grid_(std::move(grid)),
      n_(grid_.levels()),
      first_log_(std::log(grid_.smallest_a_over_b())),
      per_log_(1 / (std::log(grid_.largest_a_over_b()) - first_log_)) {
    scales_ = Splines::with_ends(grid_.scales());
    coefficients_.resize(static_cast<std::size_t>((grid_.shapes() + 2) * Splines{*this}.per_shape()) * Splines::width);
}

ROLLBEM_DECL CreepForceTable::CreepForceTable(CreepForceTable::Grid grid,
                                              const Eigen::Ref<const Eigen::Array3Xd>& forces)
    : CreepForceTable(std::move(grid)) {
    const Eigen::Index nodes = grid_.nodes(), shapes = grid_.shapes();
    detail::require(forces.cols() == nodes * shapes, Splines::name, "number of forces", forces.cols(),
                    "be the number of nodes times the number of ellipses");
    for (Eigen::Index i = 0; i < forces.cols(); ++i) {
        for (Eigen::Index k = 0; k < 3; ++k) {
            detail::require(detail::is_finite(forces(k, i)) && std::abs(forces(k, i)) <= Splines::most, Splines::name,
                            "force over mu N", forces(k, i), "be finite and at most 100");
        }
    }
    Eigen::ArrayXXd columns(3 * Splines{*this}.per_shape(), shapes);
    for (Eigen::Index shape = 0; shape < shapes; ++shape) {
        detail::ForceLattice cube(grid_.levels());
        for (Eigen::Index node = 0; node < nodes; ++node) {
            const CreepForceTable::Grid::Place& place = grid_.place(node);
            cube.set(place.x, place.y, place.spin, forces.col(shape * nodes + node));
        }
        cube.complete(grid_, shape);
        Eigen::Index row = 0;
        for (int x = -1; x <= n_ + 1; ++x) {
            for (int y = -static_cast<int>(n_) - 1; y <= n_ + 1; ++y) {
                for (int spin = -1; spin <= n_ + 1; ++spin, row += 3) {
                    columns.block<3, 1>(row, shape) = cube.at(x, y, spin);
                }
            }
        }
    }
    const Eigen::ArrayXXd all = Splines::with_ends(std::move(columns));
    for (Eigen::Index shape = 0; shape < shapes + 2; ++shape) {
        for (Eigen::Index i = 0; i < Splines{*this}.per_shape(); ++i) {
            for (Eigen::Index k = 0; k < 3; ++k) {
                coefficients_[static_cast<std::size_t>(shape * Splines{*this}.per_shape() + i) * Splines::width +
                              static_cast<std::size_t>(k)] = static_cast<float>(all(3 * i + k, shape));
            }
        }
    }
    Splines::fill_rest_correction(*this);
}

ROLLBEM_DECL void CreepForceTable::Splines::fill_rest_correction(CreepForceTable& table) {
    Eigen::ArrayXXd columns(7, table.grid_.shapes());
    for (Eigen::Index i = 0; i < table.grid_.shapes(); ++i) {
        const CreepCoefficients<double>& c = table.grid_.coefficients()[static_cast<std::size_t>(i)];
        const Sample at = Splines{table}.sample(static_cast<double>(i), 0, 0, 0);
        columns.col(i) << at.by_x[0], at.by_y[1], at.by_spin[1], at.by_y[2], at.by_spin[2], c.c32, c.c33;
    }
    table.at_rest_ = with_ends(std::move(columns));
}

ROLLBEM_DECL auto CreepForceTable::saturation_parameter(const PatchContact& contact,
                                                        const Creepage& creepage) const noexcept -> LinearForce {
    return Splines{*this}.saturation_parameter(contact, creepage);
}

ROLLBEM_DECL CreepForceTable::Force CreepForceTable::look_up(const PatchContact& contact, double friction_coefficient,
                                                             double load, const Creepage& creepage) const noexcept {
    return Splines{*this}.look_up(contact, friction_coefficient, load, creepage);
}

ROLLBEM_DECL void CreepForceTable::write(std::ostream& stream) const {
    detail::CheckedWriter writer(stream, Splines::magic);
    writer.integer(Splines::version);
    writer.integer(static_cast<std::uint32_t>(n_));
    writer.integer(static_cast<std::uint32_t>(grid_.shapes()));
    for (const double value : {grid_.poisson_ratio(), grid_.smallest_a_over_b(), grid_.largest_a_over_b()}) {
        writer.number(value);
    }
    for (const CreepCoefficients<double>& c : grid_.coefficients()) {
        for (const double value : {c.c11, c.c22, c.c23, c.c32, c.c33}) writer.number(value);
    }
    for (std::size_t i = 0; i < coefficients_.size(); ++i) {
        if (i % Splines::width < 3) writer.number(coefficients_[i]);
    }
    writer.finish();
}

ROLLBEM_DECL CreepForceTable CreepForceTable::read(std::istream& stream) {
    detail::CheckedReader reader(stream, Splines::name, Splines::magic);
    const auto found = reader.integer<std::uint32_t>();
    detail::require(found == Splines::version, Splines::name, "version", found, "be 4");
    const auto levels = reader.integer<std::uint32_t>(), shapes = reader.integer<std::uint32_t>();
    detail::require(levels <= 64, Splines::name, "levels", levels, "be at most 64");
    detail::require(shapes <= 1000, Splines::name, "number of ellipses", shapes, "be at most 1000");
    const double nu = reader.number(), smallest = reader.number(), largest = reader.number();
    std::vector<CreepCoefficients<double>> coefficients(shapes);
    for (CreepCoefficients<double>& c : coefficients) {
        for (double* value : {&c.c11, &c.c22, &c.c23, &c.c32, &c.c33}) *value = reader.number();
    }
    CreepForceTable table(
        CreepForceTable::Grid(nu, smallest, largest, static_cast<int>(levels), std::move(coefficients)));
    for (std::size_t i = 0; i < table.coefficients_.size(); ++i) {
        if (i % Splines::width == 3) continue;
        const float value = reader.single();
        detail::require(detail::is_finite(value) && std::abs(value) <= 1e3F, Splines::name, "coefficient", value,
                        "be finite and at most 1000");
        table.coefficients_[i] = value;
    }
    Splines::fill_rest_correction(table);
    reader.finish();
    return table;
}

ROLLBEM_DECL CreepForceTable CreepForceTable::read(const std::filesystem::path& path) {
    return detail::read_file<CreepForceTable>(path, Splines::name);
}

template <std::floating_point Digits>
TangentialForce CreepForceTable::force(const PatchContact::Parameters& contact, double friction_coefficient,
                                       double load, const Creepage& creepage) const noexcept {
    return Splines{*this}.force<Digits>(contact, friction_coefficient, load, creepage);
}

ROLLBEM_DECL ReducedFriction::ReducedFriction(const Parameters& parameters) : p_(parameters) {
    constexpr const char* name = "ReducedFriction";
    detail::require(p_.adhesion_factor > 0 && p_.adhesion_factor <= 1, name, "adhesion_factor", p_.adhesion_factor,
                    "lie in (0, 1]");
    detail::require(p_.slip_factor > 0 && p_.slip_factor <= p_.adhesion_factor, name, "slip_factor", p_.slip_factor,
                    "be positive and at most adhesion_factor");
    detail::require(p_.friction_ratio >= 0 && p_.friction_ratio <= 1, name, "friction_ratio", p_.friction_ratio,
                    "lie in [0, 1]");
    detail::require_not_negative(name, "fall", p_.fall);
}

ROLLBEM_DECL auto ReducedFriction::look_up(const CreepForceTable& table, const PatchContact& contact, double mu_0,
                                           double load, double speed, const Creepage& creepage) const noexcept
    -> Force {
    Force result;
    if (!detail::is_finite(speed) || !detail::is_finite(creepage)) return result;
    result.status = Status::invalid_step;
    if (speed < 0) return result;
    const auto& [xi, eta, phi] = creepage;
    const double a = contact.half_length(), b = contact.half_width();
    const double arm = std::hypot(a, b) / std::sqrt(5.0), slip = std::hypot(xi, eta, arm * phi);
    const double left = (1 - p_.friction_ratio) * std::exp(-p_.fall * speed * slip);
    const double part = left + p_.friction_ratio, mu = mu_0 * part;
    const CreepForceTable::Force clean = table.look_up(contact, mu, load, creepage);
    static_cast<CreepForceTable::Force&>(result) = clean;
    if (clean.status != Status::ok) return result;
    result.friction_coefficient = mu;

    const CreepForceTable::LinearForce linear = table.saturation_parameter(contact, creepage);
    // without friction the contact slides; 1e100 is far in full sliding, and 1e-100 is rest
    const double eps = (std::min)(std::numbers::pi / 4 * linear.value / (mu * load), 1e100);
    const bool slides = !(mu * load > 0);
    const Law reduced = law(eps, p_.adhesion_factor, p_.slip_factor), full = law(eps, 1, 1);
    const bool rests = !(eps > 1e-100) && !slides;
    const double r = slides ? 1 : rests ? (p_.adhesion_factor + p_.slip_factor) / 2 : reduced.value / full.value;
    // derivative of r by log(eps); even in eps, so that at rest it is 0
    const double bend = slides || rests ? 0 : eps * (reduced.slope - r * full.slope) / full.value;
    const TangentialForce bent = bend * clean.force;
    const auto bent_over = [&](double by) {
        return bend != 0 ? TangentialForce{bent.longitudinal / by, bent.lateral / by, bent.moment / by}
                         : TangentialForce{0, 0, 0};
    };
    const TangentialForce by_mu = r * clean.tangent_by_friction_coefficient + bent_over(-mu);
    const double by_slip = -p_.fall * speed * mu_0 * left;  // derivative of mu
    const auto tangent = [&](const TangentialForce& by, double of_linear, double of_slip) {
        return r * by + (bend != 0 ? of_linear / linear.value : 0) * bent + (by_slip * of_slip) * by_mu;
    };
    const auto per_slip = [&](double of) { return slip > 0 ? of / slip : 0; };
    const double turn = per_slip(arm * phi), per_size = phi * turn / (5 * arm);
    const auto& [by_xi, by_eta, by_phi] = linear.by_creepage;
    result.force = r * clean.force;
    result.tangent = {tangent(clean.tangent.by_longitudinal, by_xi, per_slip(xi)),
                      tangent(clean.tangent.by_lateral, by_eta, per_slip(eta)),
                      tangent(clean.tangent.by_spin, by_phi, arm * turn)};
    result.tangent_by_load = r * clean.tangent_by_load + bent_over(-load);
    result.tangent_by_friction_coefficient = part * by_mu;
    result.tangent_by_half_length = tangent(clean.tangent_by_half_length, linear.by_half_length, per_size * a);
    result.tangent_by_half_width = tangent(clean.tangent_by_half_width, linear.by_half_width, per_size * b);
    result.tangent_by_speed = (-p_.fall * slip * mu_0 * left) * by_mu;
    const auto& [x, y, moment] = result.tangent_by_speed;
    return detail::is_finite(result) && detail::is_finite(x + y + moment) ? result : Force{};
}

ROLLBEM_DECL auto ReducedFriction::law(double eps, double k_A, double k_S) noexcept -> Law {
    const double x = k_A * eps, y = k_S * eps, q = 1 / (1 + x * x);
    return {x * q + std::atan(y), k_A * q * (2 * q - 1) + k_S / (1 + y * y)};
}

}  // namespace rollbem
