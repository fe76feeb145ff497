// Steady rolling of a line contact: the creep coefficient c11 by 10, 40 and 160 elements.
#include <cstdio>

#include <rollbem/steady/steady.hpp>

int main() {
    using namespace rollbem;
    const Contact contact(  // b >> a
        {.half_length = 5e-3, .half_width = 5.0, .shear_modulus = 8.2e10, .poisson_ratio = 0.28});
    const auto kernel = StripKernel<double>::longitudinal(contact);
    for (const int n : {10, 40, 160}) {
        const auto rolling = solve_steady(uniform_mesh(n), Collocation{0, 0.63}, kernel);
        std::printf("n = %d: c11 = %.6f\n", n, rolling.c11());
    }
}
