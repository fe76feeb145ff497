// rollbem/adhesion/transient.hpp, rollbem/friction/model.hpp, vehicle/creep_force_table.hpp, vehicle/contact_table.hpp:
// no step and no look-up touches the heap. steady/steady.hpp: a large problem holds one matrix.
// A program of its own, because it replaces operator new and, where it can, malloc.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#include <rollbem/friction/detail/stick_slip.hpp>
#include <rollbem/line.hpp>
#include <rollbem/patch.hpp>
#include <rollbem/vehicle/creep_force_table.hpp>

#include "extremes/drawn.hpp"
#include "friction/any_model.hpp"
#include "laws/creep_forces.hpp"
#include "laws/hertz.hpp"
#include "laws/steps.hpp"
#include "laws/wheels.hpp"
#include "support/catch.hpp"

namespace allocation_tests {
namespace {

std::atomic<long> allocations{0}, held{0}, peak{0};  // held, at most: bytes

}  // namespace
}  // namespace allocation_tests

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <malloc.h>

namespace allocation_tests {
namespace {

constexpr bool counts_bytes = true;

void* counted(void* memory) {
    ++allocations;
    if (memory != nullptr) {
        const long now = held += static_cast<long>(malloc_usable_size(memory));
        peak = std::max(peak.load(), now);
    }
    return memory;
}
void released(void* memory) {
    if (memory != nullptr) held -= static_cast<long>(malloc_usable_size(memory));
}

}  // namespace
}  // namespace allocation_tests

// Eigen takes its memory from malloc, not from operator new.
extern "C" {
void* __libc_malloc(std::size_t size);                     // NOLINT: glibc's own names
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT
void* __libc_realloc(void* memory, std::size_t size);      // NOLINT
void __libc_free(void* memory);                            // NOLINT

void* malloc(std::size_t size) { return allocation_tests::counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return allocation_tests::counted(__libc_calloc(count, size)); }
void* realloc(void* memory, std::size_t size) {
    allocation_tests::released(memory);
    return allocation_tests::counted(__libc_realloc(memory, size));
}
void free(void* memory) {
    allocation_tests::released(memory);
    __libc_free(memory);
}
}

#else

namespace allocation_tests {
namespace {

constexpr bool counts_bytes = false;

}  // namespace
}  // namespace allocation_tests

#endif

void* operator new(std::size_t size) {
    ++allocation_tests::allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace allocation_tests {
namespace {

using namespace rollbem;

/// Heap requests made by 60 steps with all kinds of motion, of which the first of every `repeats` has a new distance;
/// -1 where a step failed.
template <class Model>
long count(const Model& model, int repeats) {
    using Motion = typename Model::Motion;
    typename Model::Value value{};
    if constexpr (Model::directions == 1) {
        value = 1;
    } else {
        value = {1, 0.5, 0.1};
    }
    Run run(model);
    bool ok = true;
    const long before = allocations;
    for (int k = 0; k < 60; ++k) {
        const Motion motion = k % 3 == 0   ? Motion(value)
                              : k % 3 == 1 ? Motion::linear({}, value)
                                           : Motion::shift(value);
        ok = run.advance({0.01 * (1 + k / repeats), motion}).status == Status::ok && ok;
    }
    ok = run.try_steady({.motion = Motion(value)}).status == Status::ok && ok;
    ok = run.try_advance({-1, Motion(value)}).status == Status::invalid_step && ok;
    return ok ? allocations - before : -1;
}

TEST_CASE("The counters see new and malloc", "[transient]") {
    long before = allocations;
    int* volatile number = new int(1);  // volatile: the compiler may leave out a pair of new and delete
    delete number;
    CHECK(allocations > before);
    if (!counts_bytes) return;
    before = allocations;
    const long bytes = held;
    const VectorX<double> vector = VectorX<double>::Ones(100);
    CHECK(allocations > before);
    CHECK(held - bytes >= 800);
    CHECK(held - bytes < 900);
    CHECK(vector.sum() == 100);
}

TEST_CASE("A steady problem of 1200 elements holds one matrix and O(n) more", "[steady]") {
    if (!counts_bytes) return;
    const PlaneKernel<double> kernel(1000, 0.72, 0.28);
    const double n = 1200;
    for (const bool uniform : {true, false}) {
        const Mesh<double> mesh = uniform ? uniform_mesh(1200) : cosine_mesh(1200);
        const long before = held;
        peak = before;
        const Response<double> solution = solve_steady(mesh, Collocation{}, kernel);
        const double doubles = static_cast<double>(peak - before) / sizeof(double);
        CAPTURE(uniform, (doubles - n * n) / n);
        CHECK(doubles >= n * n);
        CHECK(doubles < n * n + 300 * n);  // LU copies blocks of up to 256 columns
        CHECK(solution.status == Status::ok);
        CHECK(solution.residual < 1e-14);
        CHECK(solution.residual > 0);
        const double error = solution.c11() / steady_c11(0.28) - 1;
        CHECK(std::abs(error / (uniform ? 0.1507 / n : 0.1672 / (n * n)) - 1) < 0.01);
    }
}

TEST_CASE("A step in full adhesion does not allocate, whatever the size", "[transient]") {
    const Contact contact = Contact::dimensionless(100, 0.25);
    const auto along = [&](Eigen::Index n) {
        return rolling_system(cosine_mesh<double>(n), Collocation{}, PlaneKernel<double>::longitudinal(contact));
    };
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const Eigen::Index n : {1, 2, 40, 129, 400}) {
            if (n == 400 && integrator != Integrator::sdirk2) continue;
            const AdhesionModel<> model(contact, along(n), unchecked, integrator);
            CAPTURE(n, name(integrator));
            CHECK(count(model, n == 400 ? 60 : 20) == 0);
            if (n <= 40) CHECK(count(model, 1) == 0);
        }
    }
    const auto across = rolling_system(cosine_mesh<double>(70), Collocation{}, PlaneKernel<double>::lateral(contact));
    CHECK(count(AdhesionModel(contact, ElementSystem(along(70), across), unchecked), 20) == 0);
}

// Heap requests made by `ride` in `steps` of every kind, steady solutions and refusals: a mesh that breathes or a
// contact that lifts off, creepages that turn, and, in the end, steps in which nothing changes any more.
long count(any_model::Ride& ride, int steps) {
    using namespace any_model;
    const Setup& setup = ride.setup;
    const double turn = setup.directions == 1 ? 0 : 7;
    Load load{setup.pressure(), a, setup.pressure()};
    bool ok = true;
    const long before = allocations;
    for (int k = 0; k < steps; ++k) {
        const Creepage value = creepage(0.15 * (k % 13 - 6), turn * k);
        load.half_length = setup.strip ? a : a * (1 + 0.01 * std::sin(0.1 * k));
        if (setup.strip) load.normal_pressure = std::max(0.0, 0.6 + std::sin(0.3 * k)) * load.pressure_rate;
        const Step step = k % 10 == 9   ? ride.step(0, Motion::shift({a * value.longitudinal, a * value.lateral}))
                          : k % 10 == 5 ? ride.steady(creepage(1.5 * 0.95), &load)
                          : k % 3 == 0  ? ride.step(k % 20 < 15 ? 0.1 : 0.3, value, &load)
                                        : ride.step(0.1, Motion::linear(creepage(0.1), value));
        ok = ok && step.status == Status::ok;
    }
    load.normal_pressure = load.pressure_rate;
    for (int k = 0; k < steps; ++k) ok = ok && ride.step(0.4, creepage(0.3), &load).status == Status::ok;
    load.half_length = 3 * a;
    ok = ok && ride.try_step(0.1, creepage(0.3), &load).status == Status::needs_fixed_mesh;
    load.normal_pressure[0] = -1;
    ok = ok && ride.try_step(0.1, creepage(0.3), &load).status == Status::invalid_load;
    ok = ok && ride.try_step(-0.1, creepage(0.3)).status == Status::invalid_step;
    return ok ? allocations - before : -1;
}

TEST_CASE("A step with friction does not allocate, whatever the model, the load and the size", "[friction]") {
    for (any_model::Setup setup : any_model::every_setup_in_time(2e-6)) {
        for (const Eigen::Index n : {1, 24, 60}) {
            for (const bool strip : {false, true}) {
                setup.mesh = cosine_mesh<double>(n);
                setup.strip = strip;
                // where the search falls back on longer ways
                setup.scheme.alpha_L = !setup.falls && n == 24 && strip ? 0 : 0.5;
                INFO(any_model::words(setup));
                CAPTURE(n, strip, setup.scheme.alpha_L);
                any_model::Ride ride(setup);
                CHECK(count(ride, n == 60 ? 12 : 40) == 0);
            }
        }
    }
}

TEST_CASE("The combined solver does not allocate, whether it follows a path or fails", "[friction]") {
    constexpr Eigen::Index n = 6;
    detail::StickSlipSolver<2> uncoupled(n), coupled(n, true);
    detail::StageProblem<2> problem(n);
    detail::StageSolution<2> solution(n);
    const auto centres = detail::CentreValues<double>::in_strips({-1, 0, 1, -1, 3, 4});
    const std::vector<Zone> zones(n, Zone::stick);
    const ElementVectors rest = ElementVectors::Zero(n, 2);
    const std::array<ElementVectors, 2> start{rest, rest};
    drawn::Draw draw(11);
    int followed = 0, unsolved = 0;
    for (int trial = 0; trial < 300; ++trial) {
        detail::StickSlipSolver<2>& solver = trial % 2 == 0 ? uncoupled : coupled;
        for (const std::size_t slip : {0, 1}) {
            for (const std::size_t by : {0, 1}) {
                if (slip != by && !solver.matrix.coupled()) continue;
                for (double& entry : solver.matrix.renew(slip, by).reshaped()) entry = draw.normal();
            }
        }
        for (double& entry : problem.constant[0].reshaped()) entry = draw.normal();
        if (trial % 50 == 0) problem.constant[0](0, 0) = std::numeric_limits<double>::infinity();
        for (double& entry : problem.bound) entry = std::abs(draw.normal());
        const long before = allocations;
        solver.start(problem, start, zones, solution);
        solver.solve(problem, trial % 4 > 1 ? &centres : nullptr, true, solution);
        const long after = allocations;
        CAPTURE(trial, solution.rounds, solution.path_points);
        CHECK(after == before);
        followed += solution.path_points > 0 ? 1 : 0;
        unsolved += solution.status == Status::ok ? 0 : 1;
    }
    CHECK(followed > 50);
    CHECK(unsolved > 0);
}

TEST_CASE("No force element allocates, whether it answers or refuses") {
    using namespace laws;
    std::vector<ForceElement> all{creep_force_table(),     reduced_friction(), wheel_look_up(false, {}),
                                  wheel_look_up(true, {}), height_and_roll(),  load_at_height(),
                                  hertz_load(true),        hertz_load(false),  hertz_patch_load(true),
                                  hertz_patch_load(false)};
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const Stuck what : {Stuck::elements, Stuck::states}) all.push_back(adhesion_step<1>(what, integrator));
        all.push_back(adhesion_step<2>(Stuck::patch, integrator));
    }
    for (const By by : {By::steady, By::implicit_euler, By::sdirk2}) {
        for (const Law law : {Law::constant, Law::falling}) all.push_back(friction(Rolling::patch, by, law));
    }
    for (const ForceElement& of : all) {
        for_each_scene(of, 10, [&](const Numbers& x) {
            Numbers other = x, bad = x;
            other[0] *= 0.9;
            bad[0] = laws::nan;
            const long before = allocations;
            for (const Numbers& asked : {x, other, bad, x}) of.answer(asked);
            const long after = allocations;
            CHECK(after == before);
        });
    }
}

}  // namespace

}  // namespace allocation_tests
