// The other translation unit.
#include <rollbem/adhesion/critical_alpha.hpp>
#include <rollbem/adhesion/stability.hpp>
#include <rollbem/rollbem.hpp>

using CreepCoefficient = double (*)(double);
CreepCoefficient steady_c11_elsewhere() { return &rollbem::steady_c11<double>; }
