// Coulomb friction compiled for double. Replaces friction/friction.hpp; link rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../friction/friction.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template class detail::ActiveSet<double>;
extern template class detail::FrictionCore<double>;
extern template class SteadyFrictionModel<double>;
extern template class FrictionModel<double>;
extern template class detail::CombinedSolver<double>;
extern template class detail::CombinedCore<double>;
extern template class SteadyCombinedModel<double>;
extern template class CombinedFrictionModel<double>;

}  // namespace rollbem
