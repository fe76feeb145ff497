// The other translation unit.
#include <rollbem/rollbem.hpp>

using CreepCoefficient = double (*)(double);
CreepCoefficient steady_c11_elsewhere() { return &rollbem::steady_c11<double>; }
