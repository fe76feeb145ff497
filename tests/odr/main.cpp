// Two translation units that include the umbrella header link together and compute the same.
#include <rollbem/rollbem.hpp>

double carter_mean_elsewhere();

int main() { return 0; }
