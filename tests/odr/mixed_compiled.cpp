// The unit of a mixed pair whose functions come from rollbem::compiled: both have the same functions, and what one
// makes the other uses.
#include "mixed.hpp"

int main() {
    const Made by_library = make(), by_headers = make_by_headers();
    const bool same = by_library.function == by_headers.function &&
                      by_library.profile.length() == by_headers.profile.length() &&
                      by_library.profile.at(0.03).z == by_headers.profile.at(0.03).z;
    return same ? 0 : 1;
}
