// Const models shared by threads: each thread gets, bit for bit, what a single thread gets.
// The thread sanitizer checks all shared accesses.
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include <rollbem/friction/law.hpp>
#include <rollbem/line.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;
using Numbers = std::vector<double>;

constexpr double nu = 0.28;

/// Compares the results of `work` in one thread with those in each of four concurrent threads.
void check_shared(const std::function<Numbers()>& work) {
    const Numbers alone = work();
    REQUIRE(!alone.empty());
    REQUIRE(std::all_of(alone.begin(), alone.end(), [](double x) { return std::isfinite(x); }));
    std::vector<Numbers> found(4);
    {
        std::vector<std::thread> threads;
        for (Numbers& numbers : found) threads.emplace_back([&numbers, &work] { numbers = work(); });
        for (std::thread& thread : threads) thread.join();
    }
    for (const Numbers& numbers : found) CHECK(numbers == alone);
}

TEST_CASE("Threads may share kernels and meshes for assembly and steady rolling", "[threads]") {
    const Contact contact = Contact::dimensionless(10, nu);
    const Mesh<double> mesh = cosine_mesh(20);
    const auto strip = StripKernel<double>::longitudinal(contact);
    const auto plane = PlaneKernel<double>::longitudinal(contact);
    const Galerkin galerkin{.quadrature = 3};
    check_shared([&] {
        return Numbers{solve_steady(mesh, Collocation{}, strip).c11(), solve_steady(mesh, Collocation{}, plane).c11(),
                       solve_steady(mesh, galerkin, strip).c11(), assemble_G(mesh, galerkin, strip).sum(),
                       solve_steady(mesh, KnotheBoundary{}, strip).c11()};
    });
}

TEST_CASE("Threads may share a transient model for repeated and new distances", "[threads]") {
    const Contact contact = Contact::dimensionless(10, nu);
    const AdhesionModel<> model(
        contact, rolling_system(cosine_mesh(20), Collocation{}, StripKernel<double>::longitudinal(contact)), unchecked);
    check_shared([&] {
        Run run(model);
        Numbers forces;
        for (int k = 0; k < 20; ++k) {
            forces.push_back(run.advance({0.1, 1e-3}).force);
            const double dq = k % 3 == 0 ? 0.05 : 0.1;
            forces.push_back(run.advance({dq, RigidMotion<double>::linear(1e-3, 2e-3)}).tangent);
        }
        return forces;
    });
}

TEST_CASE("Threads may share models of Coulomb friction, steady and in time", "[threads]") {
    const Contact contact = Contact::dimensionless(1e4, nu);
    const Mesh<double> mesh = cosine_mesh(20);
    const auto plane = PlaneKernel<double>::longitudinal(contact);
    const Friction friction{0.3, 1e-3 * mean_hertz_pressure(mesh)};
    const FrictionModel steady(contact, steady_system(mesh, Collocation{}, plane), friction);
    const FrictionModel model(contact, rolling_system(mesh, Collocation{}, plane), unchecked, friction);
    check_shared([&] {
        Numbers forces;
        auto now = steady.at_rest(), next = now;
        auto workspace = steady.workspace();  // of this thread, for both models in turn
        for (const double creepage : {1e-4, 3e-4, 1e-3}) {
            forces.push_back(steady.steady(now, {.motion = Creepage{creepage}}, next, workspace).force.longitudinal);
            std::swap(now, next);
        }
        auto rolling = model.at_rest(), after = rolling;
        for (int k = 0; k < 10; ++k) {
            forces.push_back(model.advance(rolling, {0.1, Creepage{3e-4}}, after, workspace).force.longitudinal);
            std::swap(rolling, after);
        }
        return forces;
    });
}

TEST_CASE("Threads may share frequency sweeps and the polynomial approach", "[threads]") {
    const PlaneKernel<double> plane(1000, 1 - nu, nu);
    const FrequencySweep reduced(rolling_system(cosine_mesh(20), Collocation{}, plane));
    MatrixX<double> weak = assemble_G_prime(cosine_mesh(20), Collocation{}, plane);
    weak.row(3) *= 1e-9;  // too ill-conditioned to reduce, but valid input
    const FrequencySweep full(
        ElementSystem<double>(assemble_G(cosine_mesh(20), Collocation{}, plane), weak, cosine_mesh(20).widths()));
    REQUIRE(reduced.reduced());
    REQUIRE(!full.reduced());
    check_shared([&] {
        Numbers numbers;
        for (const double z : {1e-3, 1.0, 30.0}) {
            for (const std::complex<double> c11 :
                 {reduced(z).c11(), full(z).c11(), polynomial_c11<double>({0, z}, nu, 1000).c11}) {
                numbers.push_back(c11.real());
                numbers.push_back(c11.imag());
            }
        }
        const PolynomialSolution<double> solution = solve_polynomial<double>({0, 1}, nu, 1000);
        numbers.push_back(solution.traction(0.3).real());
        return numbers;
    });
}

}  // namespace
