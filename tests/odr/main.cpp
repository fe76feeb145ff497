// Two translation units that include everything can be linked, and share one copy of each function.
#include <cstdio>

#include <rollbem/rollbem.hpp>

using CreepCoefficient = double (*)(double);
CreepCoefficient steady_c11_elsewhere();

int main() {
    if (steady_c11_elsewhere() == &rollbem::steady_c11<double>) return 0;
    std::puts("the two translation units have different copies of steady_c11");
    return 1;
}
