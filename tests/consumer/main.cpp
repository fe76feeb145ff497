// A user's program: everything included, one number computed.
#include <rollbem/rollbem.hpp>

int main() { return 0; }
