// Steps in time compiled for double. Replaces adhesion/transient.hpp; link rollbem::compiled.
#pragma once

#include "../adhesion/transient.hpp"
#include "rolling_system.hpp"

namespace rollbem {

extern template class AdhesionModel<1, double>;
extern template class AdhesionModel<3, double>;

}  // namespace rollbem
