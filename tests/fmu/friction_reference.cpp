// friction_reference line|patch follows|fixed: reads lines of duration [s], both slip velocities [m/s], spin [rad/s],
// rolling speed [m/s] and load [N], and prints the library's result of each step: both forces, the moment and the slip
// work bit for bit, and the number of elements that stick. Exits with 1 at a step that is not ok.
#include <cstdio>
#include <string_view>

#include "library.hpp"

template <class Contact>
int run(Contact contact) {
    double duration, longitudinal, lateral, spin, speed, load, work = 0;
    while (std::scanf("%la %la %la %la %la %la", &duration, &longitudinal, &lateral, &spin, &speed, &load) == 6) {
        const auto step = contact.step(duration, longitudinal, lateral, spin, speed, load);
        if (step.status != rollbem::StepStatus::ok) return 1;
        work += step.slip_work;
        std::printf("%a %a %a %a %d\n", step.force.longitudinal, step.force.lateral, step.force.moment, work,
                    static_cast<int>(step.stick_count));
    }
    return 0;
}

int main(int count, char** arguments) {
    if (count != 3) return 2;
    const bool fixed = std::string_view(arguments[2]) == "fixed";
    return std::string_view(arguments[1]) == "patch" ? run(library::patch(fixed)) : run(library::line(fixed));
}
