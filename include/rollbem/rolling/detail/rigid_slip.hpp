// The rigid slip of creepages in the equations of a system, and the forces of its unknowns: the units of spin and
// moment, and the change of both as the semi-axes of the contact vary. Internal.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "../../scene/detail/contact_units.hpp"
#include "../../scene/detail/directions.hpp"
#include "../../scene/patch_contact.hpp"
#include "../../types.hpp"
#include "stage.hpp"

namespace rollbem::detail {

/// Rigid slip of unit creepages, a column for each. The slip of spin, (-y, x), follows the points of a patch: its
/// longitudinal half grows with the half-width, its lateral half with the half-length.
template <int directions>
class RigidSlip {
public:
    using Axes = SemiAxes;

    /// Takes the inputs of a system; `modulus` is G in the unit of the tractions.
    RigidSlip(const ContactUnits& units, const MatrixX<double>& inputs, double modulus) : columns_(modulus * inputs) {
        for (Eigen::Index j = 0; j < columns_.cols(); ++j) columns_.col(j) *= units.arm(j);
    }

    /// Rigid slip at the contact's own semi-axes.
    const MatrixX<double>& columns() const { return columns_; }

    /// Adds `factor` times the rigid slip of a unit creepage; in `sum` the directions follow one another.
    template <class Vectors>
    void add(std::size_t creepage, double factor, const Axes& at, Vectors&& sum) const {
        if (creepage == 2 && at != contact_axes) return add_spin(factor, at, sum);
        in_a_column(sum) += factor * columns_.col(static_cast<Eigen::Index>(creepage));
    }
    /// Adds `factor` times the derivative of the rigid slip of unit spin by a semi-axis; with `keeps_shape` the
    /// half-width follows the half-length.
    template <class Vectors>
    void add_spin_rate(Axis axis, bool keeps_shape, double factor, Vectors&& sum) const {
        const bool by_length = axis == Axis::half_length;
        add_spin(factor, {by_length ? 1.0 : 0.0, by_length && !keeps_shape ? 0.0 : 1.0}, sum);
    }

private:
    template <class Vectors>
    static auto in_a_column(Vectors& sum) {
        return Eigen::Map<VectorX<double>>(sum.data(), sum.size());
    }
    template <class Vectors>
    void add_spin(double factor, const Axes& stretch, Vectors& sum) const {
        const Eigen::Index n = columns_.rows() / 2;
        auto all = in_a_column(sum);
        all.head(n) += factor * stretch.half_width * columns_.col(2).head(n);
        all.tail(n) += factor * stretch.half_length * columns_.col(2).tail(n);
    }

    MatrixX<double> columns_;
};

/// Forces of unknowns in SI units, and with two directions their moment. Areas grow with both semi-axes, each arm of
/// the moment with one of them.
template <int directions>
class ContactForces {
public:
    using Axes = SemiAxes;
    using Forces = InputVector<directions>;

    /// Takes the outputs of a system; `modulus` is G in the unit of the tractions.
    ContactForces(const ContactUnits& units, const MatrixX<double>& outputs, double modulus)
        : length_(units.length), half_width_(units.half_width), columns_(outputs) {
        const double unit = units.width * units.length * (units.shear_modulus / modulus);
        for (Eigen::Index j = 0; j < columns_.cols(); ++j) columns_.col(j) *= unit * units.arm(j);
    }

    /// Forces per unknown at the contact's own semi-axes, a column for each.
    const MatrixX<double>& columns() const { return columns_; }

    /// Forces of the unknowns of all directions, one direction after the other.
    template <class Vectors>
    Forces of(const Vectors& unknowns, const Axes& at) const {
        return at == contact_axes ? total(unknowns) : stretched(unknowns, at, at);
    }

    /// The derivative of the forces by a semi-axis [m]. `response` is the derivative of the unknowns by the semi-axis
    /// over the contact's; with `keeps_shape` the other semi-axis grows in proportion. At constant tractions the force
    /// is a power of the semi-axis, and either arm of the moment adds a factor to this growth.
    template <class Vectors>
    Forces rate(const Vectors& unknowns, const Vectors& response, const Axes& at, Axis axis, bool keeps_shape) const {
        const bool by_length = axis == Axis::half_length;
        const double power = keeps_shape ? 2 : 1, more = keeps_shape ? 1.5 : 2.0;
        const Axes arms{(by_length || keeps_shape ? more : 1) * at.half_length,
                        (!by_length || keeps_shape ? more : 1) * at.half_width};
        const Forces direct = stretched(unknowns, at, arms) * (power / (by_length ? at.half_length : at.half_width));
        return (direct + of(response, at)) / (by_length ? length_ : half_width_);
    }

private:
    template <class Vectors>
    Forces total(const Vectors& unknowns) const {
        const Eigen::Map<const VectorX<double>> all(unknowns.data(), unknowns.size());
        Forces forces;
        for (Eigen::Index j = 0; j < forces.size(); ++j) forces[j] = columns_.col(j).dot(all);
        return forces;
    }
    template <class Vectors>
    Forces stretched(const Vectors& unknowns, const Axes& at, const Axes& arms) const {
        Forces forces = total(unknowns);
        if constexpr (directions == 2) {
            const Eigen::Index n = columns_.rows() / 2;
            const Eigen::Map<const VectorX<double>> all(unknowns.data(), unknowns.size());
            const auto moment = columns_.col(2);
            forces[2] =
                arms.half_width * moment.head(n).dot(all.head(n)) + arms.half_length * moment.tail(n).dot(all.tail(n));
        }
        return forces * (at.half_length * at.half_width);
    }

    double length_, half_width_;
    MatrixX<double> columns_;
};

}  // namespace rollbem::detail
