// A user of headers with bodies, with the headers alone or, beside compiled.cpp, with rollbem::compiled.
#include <cmath>

#include <rollbem/normal/profile.hpp>

#ifndef FACES_MAIN
#define FACES_MAIN main
#endif

int FACES_MAIN() {
    const rollbem::Profile wheel = rollbem::s1002();
    return std::abs(wheel.at(wheel.length() / 2).z) < 0.03 && rollbem::rail_60e1().size() > 100 ? 0 : 1;
}
