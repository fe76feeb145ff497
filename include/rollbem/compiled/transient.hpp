// Steps in time compiled for double. Replaces adhesion/transient.hpp; link rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../adhesion/transient.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template class TransientModel<double>;

}  // namespace rollbem
