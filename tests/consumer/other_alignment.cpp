// What every header of rollbem::compiled includes, in a unit with another alignment, which the linker refuses.
#include <rollbem/compiled/detail/alignment.hpp>

int main() {}
