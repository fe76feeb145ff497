// What a contact in full adhesion carries from step to step, and what a step returns: plain data.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "../scene/creepage.hpp"
#include "../scene/force.hpp"
#include "../status.hpp"
#include "../types.hpp"

namespace rollbem {

/// Everything that the next step needs to know about the past. A copy is a checkpoint; a state written to a file and
/// read back continues identically to the last bit.
template <class Scalar_ = double>
struct AdhesionState {
    using Scalar = Scalar_;

    VectorX<Scalar> traction;  ///< the system's unknowns times G: for elements p on body 1 [Pa], trailing to leading
    std::uint64_t system = 0;  ///< fingerprint() of the model that the state belongs to
    Scalar half_length = 0;    ///< a of the contact that the tractions act on [m], positive and finite
    /// Rolled in the step that led here [m]. Makes a next step of the same distance cheaper, and changes results by
    /// round-off only.
    Scalar distance = 0;
    Scalar half_width = 0;  ///< b of a patch [m], positive and finite; on a line it does not vary and is not read
};

namespace detail {

/// Numbers for k creepages, in the order longitudinal, lateral, spin.
template <int k, class Scalar>
using InputVector = Eigen::Matrix<Scalar, k, 1, Eigen::DontAlign>;

template <int k, class Scalar>
struct AdhesionValues {
    static_assert(k == 1 || k == 3, "one creepage, or longitudinal and lateral creepage and spin");
    using Value = Creepage<Scalar>;
    using Force = TangentialForce<Scalar>;
    using Tangent = CreepageTangent<Scalar>;

    static Force unknown() { return {}; }
    static Tangent unknown_tangent() { return {}; }
    static InputVector<3, Scalar> vector(const Value& value) { return {value.longitudinal, value.lateral, value.spin}; }
    template <class Vector>
    static Force force(const Vector& vector) {
        return {vector[0], vector[1], vector[2]};
    }
    template <class Matrix>
    static Tangent tangent(const Matrix& matrix) {
        return {force(matrix.col(0)), force(matrix.col(1)), force(matrix.col(2))};
    }
};

template <class Scalar>
struct AdhesionValues<1, Scalar> {
    using Value = Scalar;
    using Force = Scalar;
    using Tangent = Scalar;

    static Scalar unknown() { return std::numeric_limits<Scalar>::quiet_NaN(); }
    static Scalar unknown_tangent() { return unknown(); }
    static InputVector<1, Scalar> vector(Scalar value) { return InputVector<1, Scalar>::Constant(value); }
    template <class Single>
    static Scalar force(const Single& vector) {
        return vector(0, 0);
    }
    template <class Single>
    static Scalar tangent(const Single& matrix) {
        return matrix(0, 0);
    }
};

}  // namespace detail

/// Result of a step or of steady rolling. NaN unless the status is ok. With one input forces and their derivatives are
/// numbers, with three TangentialForce and CreepageTangent.
template <int inputs = 1, class Scalar_ = double>
struct AdhesionStep {
    using Scalar = Scalar_;
    using Values = detail::AdhesionValues<inputs, Scalar>;
    using Force = typename Values::Force;
    using Tangent = typename Values::Tangent;

    Force force = Values::unknown();            ///< 2b F_bar on body 1 [N]
    Force force_per_width = Values::unknown();  ///< F_bar [N/m], moment [N]; NaN for a patch
    /// d force / d creepage at the end of the step [N]; for a rigid shift d force / d shift [N/m].
    Tangent tangent = Values::unknown_tangent();
    /// d force / d half-length at the end of the step [N/m] with motion, dq and initial state fixed. NaN for steps that
    /// are not to a given half-length, and if the model cannot breathe.
    Force tangent_by_half_length = Values::unknown();
    /// The same of a patch by its half-width. At constant a/b: see FrictionStep::tangent_by_load.
    Force tangent_by_half_width = Values::unknown();
    Status status = Status::not_finite;
};

}  // namespace rollbem
