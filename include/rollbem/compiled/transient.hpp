// Steps in time compiled for double: in place of adhesion/transient.hpp, with rollbem::compiled.
#pragma once

#include "../detail/language.hpp"

#include "../adhesion/transient.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template class TransientModel<double>;

}  // namespace rollbem
