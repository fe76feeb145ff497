// FrictionFrame: a step with friction, or steady rolling, while its stages are solved.
#pragma once

#include "../../rolling/step_frame.hpp"
#include "../../scene/rigid_motion.hpp"
#include "../../system/element_blocks.hpp"
#include "../../types.hpp"
#include "../state.hpp"
#include "imposed_slip.hpp"
#include "scratch.hpp"

namespace rollbem::detail {

/// The load at the end of a step: pressures [Pa] of at least all unknown elements, half-length and half-width [m].
template <class Scalar>
struct StepLoad {
    const ArrayX<Scalar>& pressure;
    Scalar half_length, half_width;
    const ArrayX<Scalar>* pressure_rate = nullptr;  ///< of a step under a load of its own, else null
};

/// What is asked for. The load has been checked, and in a step the motion.
template <int directions, class Scalar>
struct FrictionRequest {
    const FrictionState<directions, Scalar>& from;
    rollbem::Travel<Scalar> travel;
    const RigidMotion<CreepageAlong<directions, Scalar>>& motion;
    StepLoad<Scalar> load;
};

template <int directions_, class Scalar, class Bounds>
struct FrictionFrame : StepFrame<CreepageAlong<directions_, Scalar>, Scalar> {
    static constexpr int directions = directions_;
    using Change = typename StickSlip<directions, Scalar>::Change;

    /// Derivatives in addition to those by the creepages.
    struct Asked {
        bool by_load = false, by_half_length = false, by_half_width = false;
    };
    const FrictionRequest<directions, Scalar>& request;
    const ElementSystem<Scalar, directions>& system;
    const ImposedSlip<directions, Scalar>& slip;
    FrictionScratch<directions, Scalar>& scratch;
    Bounds bounds;
    Asked asked{};
    FrictionStep<directions, Scalar> result{};  ///< of all stages so far
    bool tangent_exists = true;
};

}  // namespace rollbem::detail
