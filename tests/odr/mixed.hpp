// What both units of a mixed pair, one with and one without ROLLBEM_COMPILED, make and use.
#pragma once

#include <rollbem/normal/profile.hpp>

struct Made {
    rollbem::Profile (*function)();
    rollbem::Profile profile;
};

inline Made make() { return {&rollbem::s1002, rollbem::s1002().moved(0.01, 0, 0)}; }

Made make_by_headers();
