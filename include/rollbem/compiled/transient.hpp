// Steps in time compiled for double: in place of problem/transient.hpp, with rollbem::compiled.
#pragma once

#include "../problem/transient.hpp"
#include "assembly.hpp"

namespace rollbem {

extern template class TransientModel<double>;

}  // namespace rollbem
