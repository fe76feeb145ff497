// Response of the force at the end of a step to the load and the half-length there, stage by stage.
// Independent of units and of the kind of load.
#pragma once

#include "../../detail/language.hpp"

#include <cstddef>

#include <Eigen/Core>

#include "../../assembly/rolling_system.hpp"
#include "../../types.hpp"
#include "active_set.hpp"
#include "rolling_stage.hpp"

namespace rollbem::detail {

/// Position of a stage in its step, for quantities that vary linearly during the step.
template <class Scalar>
struct StagePlace {
    Scalar part;      ///< share of the step that the stage takes
    Scalar progress;  ///< share of the step that is done at the end of the stage
};

/// Parameters of the tangents, as indices of what the first stage passes to the second.
struct TangentBy {
    static constexpr std::size_t creepage = 0, load = 1, half_length = 2;
};

/// Derivatives of the tractions of a stage by the bounds and by the half-length at the end of the step, while no
/// element changes its zone. The response of the first of two stages changes the constants of the second. All memory is
/// allocated by the constructor.
template <class Scalar>
class LoadTangents {
public:
    using Vector = VectorX<Scalar>;

    explicit LoadTangents(Eigen::Index n)
        : bound_change_(Vector::Zero(n)),
          carried_by_load_(Vector::Zero(n)),
          carried_by_length_(Vector::Zero(n)),
          response_(Vector::Zero(n)),
          displacement_(Vector::Zero(n)),
          rate_(Vector::Zero(n)),
          change_(Vector::Zero(n)) {}

    /// Starts a step and chooses its tangents.
    void begin(bool by_load, bool by_half_length) {
        by_load_ = by_load;
        by_half_length_ = by_half_length;
        carried_by_load_.setZero();
        carried_by_length_.setZero();
    }
    bool by_load() const { return by_load_; }
    bool by_half_length() const { return by_half_length_; }

    /// d bound / d load at the end of the step, to be filled if by_load(); for falling friction d (p_n/G) / d load.
    Vector& bound_change() { return bound_change_; }

    /// The first of two stages, solved in `solver`; the second starts from U + ratio (U_1 - U).
    template <class Stages>
    void carry(Stages& stages, const RollingSystem<Scalar>& system, const RollingStage<Scalar>& stage,
               const StagePlace<Scalar>& place, Scalar ratio, ActiveSet<Scalar>& solver) {
        if (by_load_) {
            respond_to_load(stages, place, solver);
            stages.carry_response(TangentBy::load);
            find_displacement(system, stage.half_length, response_, carried_by_load_);
            carried_by_load_ *= -ratio;
        }
        if (by_half_length_) {
            respond_to_half_length(stages, system, stage, place, solver);
            stages.carry_response(TangentBy::half_length);
            find_displacement(system, stage.half_length, response_, carried_by_length_);
            carried_by_length_ += place.progress * rate_;
            carried_by_length_ *= -ratio;
        }
    }

    /// dp / d load of the last stage.
    template <class Stages>
    const Vector& respond_to_load(Stages& stages, const StagePlace<Scalar>& place, ActiveSet<Scalar>& solver) {
        stages.respond(solver, carried_by_load_, Scalar(1), response_, TangentBy::load, &bound_change_, place.progress);
        return response_;
    }

    /// dp / da of the last stage, a in a_0: dM p = progress dU/da - part zeta G' p.
    template <class Stages>
    const Vector& respond_to_half_length(Stages& stages, const RollingSystem<Scalar>& system,
                                         const RollingStage<Scalar>& stage, const StagePlace<Scalar>& place,
                                         ActiveSet<Scalar>& solver) {
        find_displacement(system, stage.half_length, solver.traction(), displacement_);
        find_displacement_rate(system, stage.half_length, solver.traction(), displacement_, rate_);
        change_.noalias() = system.G_prime() * solver.traction();
        change_.array() = place.progress * rate_.array() - place.part * *system.points() * change_.array();
        change_ += carried_by_length_;
        stages.respond_to_half_length(solver, change_, response_, TangentBy::half_length);
        return response_;
    }

private:
    Vector bound_change_;
    Vector carried_by_load_, carried_by_length_;  // contributions of the first stage to dc of the second
    Vector response_, displacement_, rate_, change_;
    bool by_load_ = false, by_half_length_ = false;
};

}  // namespace rollbem::detail
