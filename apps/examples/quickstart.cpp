#include <iostream>

#include <rollbem/rollbem.hpp>

int main() {
    // a wheel-rail contact in SI units: a = 5 mm, b = 50 mm, steel
    const rollbem::Contact<double> contact(
        {.half_length = 5e-3, .half_width = 50e-3, .shear_modulus = 8e10, .poisson_ratio = 0.28});
    const rollbem::Mesh<double> mesh = rollbem::cosine_mesh(40);
    const rollbem::NodeDifference scheme;
    const auto kernel = rollbem::StripKernel<double>::longitudinal(contact);
    const auto rolling = rollbem::solve_steady(mesh, scheme, kernel);
    if (rolling.status != rollbem::Status::ok) return 1;
    std::cout << "F = " << creep_force(contact, rolling, 1e-4) << " N, c11 = " << rolling.c11() << '\n';
}
