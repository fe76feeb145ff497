// The least that shows that the headers, Eigen and the language are found; to compile Eigen would take most of the
// time.
#include <rollbem/status.hpp>

#if !__has_include(<Eigen/Core>)
#error "Eigen is not found"
#endif

int main() { return rollbem::has_numbers(rollbem::Status::ok) ? 0 : 1; }
