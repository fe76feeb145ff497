// A header whose bodies are in rollbem::compiled, in a unit with another alignment, which the linker refuses.
#include <rollbem/normal/profile.hpp>

int main() {}
