// The templates of rollbem/compiled/*.hpp, instantiated here for float: tests in double take theirs from
// rollbem::compiled, and see no header that is newer than that library.
#include <cmath>
#include <utility>

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
    CHECK(relative(FrequencySweep(system)(0).c11().real(), c11) < 1e-5F);
    const StateSpace space = state_space(system);
    const MatrixX<float> rates = space.A.inverse();
    CHECK(relative((space.D - space.C * rates * space.B)(0, 0), c11) < 1e-3F);

    const float expected = -contact.half_length() * contact.shear_modulus() * contact.width() * c11;
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        const AdhesionModel<1, float> model(contact, RollingSystem<float>(system), unchecked, integrator);
        CHECK(relative(model.force(model.steady(1e-4F)), 1e-4F * expected) < 1e-5F);
        auto now = model.at_rest(), next = now;
        auto workspace = model.workspace();
        for (int k = 0; k < 40; ++k) {
            REQUIRE(model.advance(now, {1.0F, 1e-4F}, next, workspace).status == Status::ok);
            std::swap(now, next);
        }
        CHECK(relative(model.force(now), 1e-4F * expected) < 1e-4F);
    }
}

TEST_CASE("templates: a patch rolls as steady rolling says", "[templates]") {
    const PatchContact patch(
        {.half_length = 6e-3F, .half_width = 5e-3F, .shear_modulus = 8e10F, .poisson_ratio = 0.28F});
    const PatchMesh<float> elements = patch_mesh(patch, 6, 6);
    const HalfSpace<float> half_space(0.28F);
    const auto steady = solve_steady(patch, elements, scheme);
    const auto force = creep_force(patch, steady, {1e-4F, 2e-4F, 0.01F});
    const ElementSystem<float, 2> system = rolling_system(elements, scheme, half_space);
    const AdhesionModel<2, float> model(patch, system, unchecked);
    const auto found = model.force(model.steady(Creepage{1e-4F, 2e-4F, 0.01F}));
    CHECK(relative(found.longitudinal, force.longitudinal) < 1e-4F);
    CHECK(relative(found.lateral, force.lateral) < 1e-4F);
    CHECK(relative(found.moment, force.moment) < 1e-3F);
}

}  // namespace
