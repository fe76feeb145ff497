// friction_reference follows|fixed: reads lines of duration [s], both slip velocities and the rolling speed [m/s] and
// the load [N], and prints the library's result of each step: both forces and the slip work bit for bit, and the number
// of elements that stick. Exits with 1 at a step that is not ok.
#include <cstdio>
#include <string_view>

#include "library.hpp"

int main(int count, char** arguments) {
    if (count != 2) return 2;
    library::Friction contact(std::string_view(arguments[1]) == "fixed");
    double duration, longitudinal, lateral, speed, load, work = 0;
    while (std::scanf("%la %la %la %la %la", &duration, &longitudinal, &lateral, &speed, &load) == 5) {
        const library::Friction::Step step = contact.step(duration, longitudinal, lateral, speed, load);
        if (step.status != rollbem::StepStatus::ok) return 1;
        work += step.slip_work;
        std::printf("%a %a %a %d\n", step.force.longitudinal, step.force.lateral, work,
                    static_cast<int>(step.stick_count));
    }
}
