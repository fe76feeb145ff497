// A user who compiles the library's units in a project of his own: steady rolling of a line.
#include <cmath>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/steady/steady.hpp>

#ifndef ROLLBEM_COMPILED
#error "the bodies come from the headers"
#endif

int main() {
    using namespace rollbem;
    const auto kernel = PlaneKernel<double>::longitudinal(Contact::dimensionless(100, 0.25));
    const auto solution = solve_steady(cosine_mesh(20), Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel);
    return solution.status == Status::ok && std::abs(solution.c11() / steady_c11(0.25) - 1) < 1e-2 ? 0 : 1;
}
