// rollbem/adhesion/frequency.hpp
#include <complex>
#include <limits>

#include <rollbem/compiled/frequency.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

// c11 by the sweep, compared with the direct solution to the round-off of the type.
template <class Scalar>
std::complex<long double> c11(long double z) {
    const Mesh<Scalar> mesh = cosine_mesh<Scalar>(40);
    const RollingSystem<Scalar> system = rolling_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                                                        PlaneKernel<Scalar>(1000, Scalar(0.75), Scalar(0.25)));
    const FrequencySweep<Scalar> sweep(system);
    const SweepPoint<Scalar> point = sweep(static_cast<Scalar>(z));
    const HarmonicSolution<Scalar> plain = solve_harmonic(system, static_cast<Scalar>(z));
    CHECK(sweep.reduced());
    CHECK(point.status == Status::ok);
    CHECK(plain.status == Status::ok);
    CHECK(std::abs(point.c11 / plain.c11 - Scalar(1)) < 100 * std::numeric_limits<Scalar>::epsilon());
    return {point.c11.real(), point.c11.imag()};
}

TEST_CASE("Sweeps are accurate to round-off in float and in long double", "[frequency]") {
    for (const long double z : {0.125L, 1.0L, 5.0L}) {
        const auto difference = static_cast<double>(std::abs(c11<float>(z) / c11<long double>(z) - 1.0L));
        CAPTURE(z, difference * 1e6);
        CHECK(difference < 100 * std::numeric_limits<float>::epsilon());
        CHECK(difference > 0);  // two types, not one
    }
}

}  // namespace
