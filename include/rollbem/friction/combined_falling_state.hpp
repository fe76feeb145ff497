// State and workspace of friction that depends on the velocity of slip, in two directions.
#pragma once

#include "../detail/language.hpp"

#include <Eigen/Core>

#include "../types.hpp"
#include "combined_state.hpp"
#include "combined_workspace.hpp"
#include "detail/combined_slip.hpp"
#include "detail/falling_scratch.hpp"

namespace rollbem {

/// What the next step needs of the past: in addition to tractions, zones and load the coefficients of friction.
template <class Scalar_ = double>
struct CombinedFallingState : CombinedFrictionState<Scalar_> {
    using Scalar = Scalar_;

    /// mu [-] of each unknown element, finite and not negative. Without memory it is mu_s(v), and the next solution is
    /// sought from it.
    ArrayX<Scalar> friction_coefficient;
    /// mu [-] in the first stage of a step of sdirk2, from which the search for that of the next one starts; otherwise
    /// as friction_coefficient. Changes results by round-off only, unless there are several solutions.
    ArrayX<Scalar> stage_coefficient;
};

/// Factors and scratch memory, as CombinedFrictionWorkspace. Its slip() and slip_work() are those of what was solved
/// last.
template <class Scalar_ = double>
class CombinedFallingWorkspace : public CombinedFrictionWorkspace<Scalar_> {
public:
    using Scalar = Scalar_;

    /// For n unknown elements.
    explicit CombinedFallingWorkspace(Eigen::Index n) : CombinedFrictionWorkspace<Scalar>(n), scratch_(n) {}

private:
    template <class, class>
    friend class SteadyCombinedFallingModel;
    template <class, class>
    friend class CombinedFallingModel;

    detail::FallingScratch<detail::CombinedSlip<Scalar>> scratch_;
};

}  // namespace rollbem
