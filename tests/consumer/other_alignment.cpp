// A unit with another alignment than that of rollbem::compiled, which the linker refuses.
#include <rollbem/compiled/creep_force_table.hpp>

int main() {}
