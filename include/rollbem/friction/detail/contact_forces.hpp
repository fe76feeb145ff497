// Force and moment of the tractions in a contact, and their derivatives by its semi-axes.
#pragma once

#include <Eigen/Core>

#include "../../rolling/step_frame.hpp"
#include "../../scene/contact_units.hpp"
#include "../../system/elements.hpp"
#include "../../types.hpp"
#include "../state.hpp"

namespace rollbem::detail {

/// Sums over elements in SI units, of tractions in G. Semi-axes in those of the contact.
template <int directions, class Scalar>
class ContactForces {
public:
    using Vectors = ElementVectors<Scalar, directions>;
    using Force = typename FrictionStep<directions, Scalar>::Force;
    using Axes = SemiAxes<Scalar>;

    /// The moment is unknown with one direction, and where places are not known.
    ContactForces(const ContactUnits<Scalar>& units, const Elements<Scalar>& elements)
        : units_(units), areas_(elements.areas.matrix()) {
        if constexpr (directions == 2) {
            if (!elements.places_are_known()) return;
            moments_.resize(areas_.size(), 2);
            moments_ << -(elements.areas * elements.centre_y).matrix(), (elements.areas * elements.centre_x).matrix();
        }
    }

    const VectorX<Scalar>& areas() const { return areas_; }
    /// Force per unit of the sum of areas times tractions.
    Scalar unit(const Axes& axes) const {
        return units_.width * units_.length * axes.half_length * axes.half_width * units_.shear_modulus;
    }
    Force of(const Vectors& tractions, const Axes& axes) const { return total(tractions, unit(axes), axes); }

    /// The derivative by a semi-axis [m] of the solution of a StickSlip, whose last response is that to the semi-axis
    /// over that of the contact.
    template <class Solver>
    Force rate(const Solver& solver, const Axes& axes, Axis axis, bool keeps_shape) const {
        const auto own = OwnGrowth<Scalar>::by(axis, keeps_shape);
        const bool by_length = axis == Axis::half_length;
        const Scalar semi_axis = by_length ? axes.half_length : axes.half_width;
        const Axes arms{own.arms.half_length * axes.half_length, own.arms.half_width * axes.half_width};
        const Force direct = total(solver.traction(), own.power / semi_axis * unit(axes), arms);
        return 1 / (by_length ? units_.length : units_.half_width) * (direct + of(solver.response(), axes));
    }

private:
    // `factor` times the sum of area times vector; moments also times the arms, along x a, and of a patch along y b in
    // its own, times a_0.
    Force total(const Vectors& vectors, Scalar factor, const Axes& arms) const {
        if constexpr (directions == 1) {
            return factor * areas_.dot(vectors);
        } else {
            Force force{factor * areas_.dot(vectors.col(0)), factor * areas_.dot(vectors.col(1))};
            if (moments_.rows() == 0) return force;
            const Scalar across = units_.line ? arms.half_length : arms.half_width;
            force.moment =
                factor * units_.length *
                (across * moments_.col(0).dot(vectors.col(0)) + arms.half_length * moments_.col(1).dot(vectors.col(1)));
            return force;
        }
    }

    ContactUnits<Scalar> units_;
    VectorX<Scalar> areas_;
    Vectors moments_;  // of unit tractions; empty if unknown
};

}  // namespace rollbem::detail
