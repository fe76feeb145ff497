// Distance rolled in a step, and the relative rigid-body motion of the two bodies meanwhile.
#pragma once

#include <limits>

#include <Eigen/Core>

#include "../detail/finite.hpp"
#include "../status.hpp"
#include "creepage.hpp"

namespace rollbem {

namespace detail {

template <class Value>
struct NumberOf {
    using type = Value;
    static constexpr int directions = 1;
};
template <>
struct NumberOf<Creepage> {
    using type = double;
    static constexpr int directions = 2;
};

}  // namespace detail

/// Distance and duration of one step, or of steady rolling any distance and its duration. Only friction that depends on
/// the velocity of slip needs the duration; everything else takes a plain dq.
struct Travel {
    constexpr Travel() = default;
    constexpr Travel(double distance,
                     double seconds = std::numeric_limits<double>::quiet_NaN())  // NOLINT: implicit on purpose
        : dq(distance), duration(seconds) {}

    /// A second of steady rolling at V [m/s].
    static constexpr Travel at_speed(double V) { return {V, 1}; }

    double dq = 0;  ///< distance rolled [m], positive, at least 1e-292; 0 for a rigid shift without rolling
    double duration = std::numeric_limits<double>::quiet_NaN();  ///< [s], positive; NaN if it does not matter

    constexpr double speed() const { return dq / duration; }  ///< V [m/s]
};

/// Motion during one step. Value_ is a number for creepage in one direction (the kernel's), and Creepage for
/// both. With friction each element may also have a rigid slip of its own: on curved surfaces, rigid slip is not linear
/// in x and y.
///
/// \code
/// #include <rollbem/patch.hpp>
///
/// int main() {
///     using namespace rollbem;
///     const auto growing = RigidMotion<Creepage>::linear({0, 0, 0}, {1e-3, 5e-4, 0.1});  // xi, eta [-], spin [1/m]
///     const auto shift = RigidMotion<double>::shift(1e-6);                               // [m], without rolling
///     return growing.check(1e-3) == Status::ok && shift.check(0) == Status::ok ? 0 : 1;
/// }
/// \endcode
template <class Value_>
class RigidMotion {
public:
    using Value = Value_;
    static constexpr int directions = detail::NumberOf<Value>::directions;
    /// A row per unknown element, a column per direction.
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, directions>;
    using RowsView = Eigen::Map<const Rows>;

    /// Constant creepage xi [-].
    RigidMotion(Value creepage) : start_(creepage), end_(creepage) {}  // NOLINT: implicit on purpose
    RigidMotion(double longitudinal, double lateral, double spin = 0) requires(directions == 2)
        : RigidMotion(Value{longitudinal, lateral, spin}) {}

    /// Creepage [-] that varies linearly over the step.
    static RigidMotion linear(Value start, Value end) { return {start, end, Kind::linear}; }

    /// Rigid shift xi dq [m] of body 1 relative to body 2, uniform over the step: it needs no division by a speed that
    /// may vanish, and dq = 0 is allowed.
    static RigidMotion shift(Value shift) { return {shift, shift, Kind::shift}; }

    /// The same motion with an additional rigid slip [-] (for a shift [m]) for each element, at the point of the
    /// element's equation (Elements::x, y): constant over the step, or linear from `start` to `end`. Refers to the
    /// rows, which a temporary cannot be. Steps that take no rows, or have another number of elements, refuse the
    /// motion (Status::invalid_step).
    RigidMotion with_rows(const Rows& rows) const { return with_rows(rows, rows); }
    RigidMotion with_rows(const Rows& start, const Rows& end) const {
        return with_rows(RowsView(start.data(), start.rows(), start.cols()),
                         RowsView(end.data(), end.rows(), end.cols()));
    }
    RigidMotion with_rows(const Rows&&) const = delete;
    RigidMotion with_rows(const Rows&&, const Rows&) const = delete;
    RigidMotion with_rows(const Rows&, const Rows&&) const = delete;
    RigidMotion with_rows(const Rows&&, const Rows&&) const = delete;
    RigidMotion with_rows(const RowsView& start, const RowsView& end) const;

    /// The component along one direction, 0 longitudinal or 1 lateral; spin is left out.
    RigidMotion<double> along(Eigen::Index direction) const requires(directions == 2) {
        const auto component = [&](const Value& value) { return direction == 0 ? value.longitudinal : value.lateral; };
        RigidMotion<double> own(component(start_), component(end_),
                                static_cast<typename RigidMotion<double>::Kind>(kind_));
        own.row_count_ = row_count_;
        if (row_count_ <= 0) return own;
        own.start_rows_ = start_rows_ + direction * row_count_;
        own.end_rows_ = end_rows_ + direction * row_count_;
        return own;
    }

    bool is_shift() const { return kind_ == Kind::shift; }
    bool is_linear() const { return kind_ == Kind::linear; }  ///< made by linear(), whatever the values
    Value start() const { return start_; }                    ///< creepage at the start [-], or the shift [m]
    Value end() const { return end_; }                        ///< creepage at the end [-], or the shift [m]

    bool has_rows() const { return row_count_ != 0; }
    RowsView start_rows() const { return {start_rows_, row_count_, Rows::ColsAtCompileTime}; }  ///< if it has rows
    RowsView end_rows() const { return {end_rows_, row_count_, Rows::ColsAtCompileTime}; }

    /// Whether the motion can be used with a distance rolled dq, in any unit, and, if it has rows, with this number of
    /// elements: ok, invalid_step or not_finite.
    Status check(double dq, Eigen::Index row_count = 0) const noexcept;
    /// Whether the motion can be used in steady rolling.
    Status check_rows(Eigen::Index row_count) const noexcept;

private:
    template <class Other>
    friend class RigidMotion;
    enum class Kind { constant, linear, shift };

    RigidMotion(Value start, Value end, Kind kind) : start_(start), end_(end), kind_(kind) {}

    static constexpr Eigen::Index invalid = -1;

    Value start_, end_;
    Kind kind_ = Kind::constant;
    const double *start_rows_ = nullptr, *end_rows_ = nullptr;
    Eigen::Index row_count_ = 0;
};

}  // namespace rollbem

#include "impl/rigid_motion.tpp"
