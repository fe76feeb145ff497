// coarse_table FILE: writes the table of steady creep forces that is packed with rollbem_patch.fmu.
#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>

#include <rollbem/vehicle/make_creep_force_table.hpp>

int main(int count, char** arguments) {
    if (count != 2) return 2;
    try {
        const auto table = rollbem::make_creep_force_table({.shapes = 12, .levels = 10, .n = 10});
        std::ofstream file(arguments[1], std::ios::binary);
        table.write(file);
        if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + arguments[1]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "coarse_table: %s\n", error.what());
        return 1;
    }
}
