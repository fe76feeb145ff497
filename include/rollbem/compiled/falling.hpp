// Friction that falls exponentially with slip, compiled for double: in place of friction/falling.hpp, with
// rollbem::compiled. Other laws are compiled where they are used.
#pragma once

#include "../detail/language.hpp"

#include "../friction/falling.hpp"
#include "friction.hpp"

namespace rollbem {

extern template class detail::FallingSet<detail::ActiveSetSlip<double>>;
extern template class detail::FallingStages<ExponentialFall<double>, detail::ActiveSetSlip<double>>;
extern template class SteadyFallingModel<ExponentialFall<double>, double>;
extern template class FallingFrictionModel<ExponentialFall<double>, double>;

}  // namespace rollbem
