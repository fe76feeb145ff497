// step_response NU B_OVER_A Q...: prints the exact -F/(a G xi) at each distance Q = q/a after a step of the creepage.
#include <cstdio>
#include <cstdlib>

#include <rollbem/reference/step_response.hpp>

int main(int count, char** arguments) {
    if (count < 3) return 2;
    const rollbem::reference::StepResponse response(std::atof(arguments[1]), std::atof(arguments[2]));
    for (int i = 3; i < count; ++i) std::printf("%.17g\n", response.step(std::atof(arguments[i])));
}
