// Creep forces of one contact by a table, with the tangent that an implicit integrator wants.
//
//     ./examples/creep_force [table]
#include <cstdio>

#include <rollbem/vehicle/creep_force_table.hpp>

int main(int argc, char** argv) {
    using namespace rollbem;
    const auto table = CreepForceTable::read(argc > 1 ? argv[1] : "../apps/creep/steel.creep");  // once
    const PatchContact contact(
        {.half_length = 6e-3, .half_width = 4e-3, .shear_modulus = 8.2e10, .poisson_ratio = 0.28});
    // each step: mu = 0.3, 80 kN, longitudinal and lateral creepage [-], spin [1/m]
    const auto now = table.look_up(contact, 0.3, 80e3, {1e-3, 5e-4, 0.1});
    if (!has_numbers(now.status) || !now.a_over_b_on_table) return 1;
    const double slope = now.tangent.by_longitudinal.longitudinal;
    std::printf("F_x = %.0f N, dF_x/dxi = %.3e N\n", now.force.longitudinal, slope);
}
