// The templates of rollbem/compiled/*.hpp, instantiated here for float: tests in double take theirs from
// rollbem::compiled, and see no header that is newer than that library.
#include <cmath>

#include <rollbem/rollbem.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

const Contact contact({.half_length = 5e-3F, .half_width = 50e-3F, .shear_modulus = 8e10F, .poisson_ratio = 0.28F});
const Mesh<float> mesh = cosine_mesh<float>(20);
const NodeDifference scheme{};
const auto kernel = PlaneKernel<float>::longitudinal(contact);

float relative(float value, float expected) { return std::abs(value / expected - 1); }

TEST_CASE("templates: a line in full adhesion has one c11", "[templates]") {
    const float c11 = solve_steady(mesh, scheme, kernel).c11();
    CHECK(relative(c11, steady_c11(0.28F)) < 1e-2F);
    CHECK(relative(solve_steady(Chebyshev{8}, kernel).c11(), steady_c11(0.28F)) < 1e-5F);
    const ElementSystem<float> system = rolling_system(mesh, scheme, kernel);
    const float from_matrices = solve_steady<float>(system.G_prime(), ArrayX<float>(system.weights())).c11();
    CHECK(relative(from_matrices, c11) < 1e-5F);
    CHECK(relative(solve_response(static_cast<const RollingSystem<float>&>(system), 0).c11().real(), c11) < 1e-5F);
}

TEST_CASE("templates: a patch rolls as steady rolling says", "[templates]") {
    const PatchContact patch(
        {.half_length = 6e-3F, .half_width = 5e-3F, .shear_modulus = 8e10F, .poisson_ratio = 0.28F});
    const PatchMesh<float> elements = patch_mesh(patch, cosine_mesh<float>(6), cosine_mesh<float>(6));
    const HalfSpace<float> half_space(0.28F);
    const auto steady = solve_steady(patch, elements, scheme);
    const ElementSystem<float, 2> system = rolling_system(elements, scheme, half_space);
    const Response<float> joined = solve_steady(system.joined());
    CHECK((joined.coefficients - steady.coefficients).cwiseAbs().maxCoeff() < 1e-3F);
}

}  // namespace
