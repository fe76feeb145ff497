// rollbem/adhesion/transient.hpp, rollbem/friction/model.hpp, vehicle/creep_force_table.hpp: no step and no look-up
// touches the heap.
// A program of its own, because it replaces operator new and, where it can, malloc.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <utility>
#include <vector>

#include <rollbem/assembly/patch_shapes.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/compiled/patch.hpp>
#include <rollbem/compiled/transient.hpp>
#include <rollbem/normal/hertz_patch_load.hpp>

#include "support/catch.hpp"
#include "support/draw.hpp"
#include "vehicle/creep_force_scene.hpp"

namespace {

std::atomic<long> allocations{0};

}  // namespace

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

// Eigen takes its memory from malloc, not from operator new.
extern "C" {
void* __libc_malloc(std::size_t size);                     // NOLINT: glibc's own names
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT
void* __libc_realloc(void* memory, std::size_t size);      // NOLINT

void* malloc(std::size_t size) {
    ++allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    ++allocations;
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    ++allocations;
    return __libc_realloc(memory, size);
}
}

#endif

void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using namespace rollbem;

AdhesionModel<> make_model(Eigen::Index n, Integrator integrator) {
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
    return {contact, rolling_system(cosine_mesh<double>(n), scheme, PlaneKernel<double>::longitudinal(contact)),
            unchecked, integrator};
}

/// Heap requests made by 60 steps with all kinds of motion, of which the first of every `repeats` has a new distance;
/// -1 where a step failed.
template <class Model>
long count(const Model& model, int repeats) {
    using Motion = typename Model::Motion;
    typename Model::State state = model.at_rest(), next = state;
    typename Model::Workspace workspace = model.workspace();
    bool ok = true;
    const long before = allocations;
    for (int k = 0; k < 60; ++k) {
        typename Model::Value value{};
        if constexpr (Model::inputs == 1) {
            value = 1;
        } else {
            value = {1, 0.5, 0.1};
        }
        const Motion motion = k % 3 == 0   ? Motion(value)
                              : k % 3 == 1 ? Motion::linear({}, value)
                                           : Motion::shift(value);
        ok = model.advance(state, 0.01 * (1 + k / repeats), motion, next, workspace).status == StepStatus::ok && ok;
        std::swap(state, next);
    }
    ok = model.steady(state, {}, next, workspace).status == StepStatus::ok && ok;
    ok = model.advance(state, -1, typename Model::Value{}, next, workspace).status == StepStatus::invalid_step && ok;
    return ok ? allocations - before : -1;
}

TEST_CASE("The counters see new and malloc", "[transient]") {
    long before = allocations;
    int* volatile number = new int(1);  // volatile: the compiler may leave out a pair of new and delete
    delete number;
    CHECK(allocations > before);
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)
    before = allocations;
    const VectorX<double> vector = VectorX<double>::Ones(100);
    CHECK(allocations > before);
    CHECK(vector.sum() == 100);
#endif
}

TEST_CASE("A step in full adhesion does not allocate, whatever the size", "[transient]") {
    for (const Integrator integrator :
         {Integrator::implicit_euler, Integrator::sdirk2, Integrator::matrix_exponential}) {
        for (const Eigen::Index n : {1, 2, 40, 129, 400}) {
            if (n == 400 && integrator != Integrator::sdirk2) continue;
            const AdhesionModel<> model = make_model(n, integrator);
            CAPTURE(n, name(integrator));
            CHECK(count(model, n == 400 ? 60 : 20) == 0);
            if (n <= 40) CHECK(count(model, 1) == 0);
        }
    }
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    const auto along =
        rolling_system(cosine_mesh<double>(70), Collocation{}, PlaneKernel<double>::longitudinal(contact));
    const auto across = rolling_system(cosine_mesh<double>(70), Collocation{}, PlaneKernel<double>::lateral(contact));
    CHECK(count(AdhesionModel(contact, ElementSystem(along, across), unchecked), 20) == 0);
}

TEST_CASE("A step to another half-length does not allocate", "[transient]") {
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        for (const Eigen::Index n : {1, 2, 40, 128}) {
            const AdhesionModel<> model = make_model(n, integrator);
            AdhesionWorkspace<> workspace = model.workspace();
            AdhesionState<> now = model.at_rest(), next = now;
            bool ok = true, refused = true;
            const long before = allocations;
            for (int k = 1; k <= 20; ++k) {
                ok = model.advance(now, 0.1, 1.0, 1 + 0.01 * k, next, workspace).status == StepStatus::ok && ok;
                std::swap(now, next);
                ok = model.advance(now, 0.1, 1.0, next, workspace).status == StepStatus::ok && ok;
                ok = model.advance(next, 0.1, 1.0, now, workspace).status == StepStatus::ok && ok;
                refused = refused &&
                          model.advance(now, 0.1, 1.0, 5.0, next, workspace).status == StepStatus::needs_fixed_mesh;
            }
            const long after = allocations;
            CAPTURE(n, name(integrator));
            CHECK(ok);
            CHECK(refused);
            CHECK(after == before);
        }
    }
}

FrictionModel<> make_friction_model(Eigen::Index n, double alpha_L, double alpha_T, Integrator integrator) {
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    const Mesh<double> mesh = cosine_mesh<double>(n);
    const Collocation scheme{.alpha_L = alpha_L, .alpha_T = alpha_T};
    return {contact,
            rolling_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact)),
            unchecked,
            {0.3, mean_hertz_pressure(mesh)},
            integrator};
}

TEST_CASE("A step with friction does not allocate, whatever the size", "[friction]") {
    struct Case {
        Eigen::Index n;
        double alpha_L, alpha_T;
        int steps;
    };
    int fallbacks = 0;
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        for (const Case& c : {Case{1, 0.5, 0.5, 200}, Case{40, 0.5, 0.5, 200}, Case{40, 0, 0.5, 200},
                              Case{100, 0.5, 0.5, 200}, Case{40, 0, 0.63, 200}, Case{200, 0.5, 0.5, 20}}) {
            const FrictionModel<> model = make_friction_model(c.n, c.alpha_L, c.alpha_T, integrator);
            FrictionState<> now = model.at_rest(), next = now;
            FrictionWorkspace<> workspace = model.workspace();
            bool ok = true;
            int changes = 0, cheap = 0;
            const long before = allocations;
            // zones and dq change from the first step; at the end there are enough unchanged steps for cheap ones
            for (int k = 0; k < c.steps; ++k) {
                const FrictionStep<> step =
                    k >= 130 && k < 198 ? model.advance(now, 0.4, 0.2, next, workspace)
                    : k % 50 == 49      ? model.shift(now, 0.2, next, workspace)
                    : c.alpha_L == 0 && k % 50 == 30
                        ? model.steady(now, 1.5 * 0.3 * 0.95, next, workspace)
                        : model.advance(now, k % 20 < 15 ? 0.1 : 0.3, (k % 13 - 6) * 0.15, next, workspace);
                ok = ok && step.status == StepStatus::ok;
                changes += step.rounds > 2 ? 1 : 0;
                fallbacks += step.pivots > 0 ? 1 : 0;
                cheap += now.solver.unchanged_steps > 1 + c.n / 2 ? 1 : 0;
                std::swap(now, next);
            }
            const long after = allocations;
            CAPTURE(c.n, c.alpha_L, c.alpha_T, name(integrator), changes, cheap);
            CHECK(ok);
            CHECK((changes >= (c.steps == 200 ? 15 : 3) || c.n == 1));
            CHECK((cheap > 5 || c.n > 40 || c.alpha_L == 0));
            CHECK(after == before);
        }
        // rejections and copies do not allocate either
        const FrictionModel<> model = make_friction_model(300, 0.5, 0.5, integrator);
        const FrictionState<> now = model.at_rest();
        FrictionState<> next = now;
        FrictionWorkspace<> workspace = model.workspace(),
                            other = make_friction_model(2, 0.5, 0.5, integrator).workspace();
        const long before = allocations;
        const bool refused = model.advance(now, 0.1, 1e-9, next, other).status == StepStatus::wrong_state &&
                             model.advance(now, -0.1, 1e-9, next, workspace).status == StepStatus::invalid_step;
        next = now;
        const long after = allocations;
        CHECK(refused);
        CHECK(after == before);
    }
    CAPTURE(fallbacks);
    CHECK(fallbacks >= 4);
}

TEST_CASE("A step under a varying load does not allocate", "[friction]") {
    const HertzLine<double> line(
        {.load_per_width = 1, .combined_radius = 1, .body_1 = {1e3, 0.25}, .body_2 = {1e3, 0.25}});
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        for (const bool breathing : {true, false}) {
            for (const Eigen::Index n : {1, 40, 100}) {
                const double a = line.half_length() * (breathing ? 1 : 1.5);
                const Contact<double> contact(
                    {.half_length = a, .half_width = 100, .shear_modulus = 400, .poisson_ratio = 0.25});
                const Mesh<double> mesh = cosine_mesh<double>(n);
                const HertzLoad<double> hertz =
                    breathing ? HertzLoad<double>::breathing(line, mesh) : HertzLoad<double>::fixed(line, mesh, a);
                NormalLoad<double> load = hertz.at(1);
                const FrictionModel<> model(contact,
                                            rolling_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5},
                                                           PlaneKernel<double>::longitudinal(contact)),
                                            unchecked, {0.3, load.normal_pressure}, integrator);
                FrictionState<> now = model.at_rest(), next = now;
                FrictionWorkspace<> workspace = model.workspace();
                bool ok = true;
                const long before = allocations;
                for (int k = 0; k < 100; ++k) {
                    const double P = breathing ? 1 + 0.5 * std::sin(0.3 * k) : std::max(0.0, 0.8 + std::sin(0.3 * k));
                    ok = hertz.set(P, load) == StepStatus::ok && ok;
                    const double dq = a * (k % 20 < 15 ? 0.3 : 0.4);
                    const FrictionStep<> step = model.advance(now, dq, (k % 13 - 6) * 1e-3, load, next, workspace);
                    ok = ok && step.status == StepStatus::ok;
                    std::swap(now, next);
                }
                ok = ok && model.steady(now, 1e-3, load, next, workspace).status == StepStatus::ok;
                load.half_length *= 3;
                ok = ok && model.advance(now, a, 1e-3, load, next, workspace).status == StepStatus::needs_fixed_mesh;
                load.normal_pressure[0] = -1;
                ok = ok && model.advance(now, a, 1e-3, load, next, workspace).status == StepStatus::invalid_load;
                const long after = allocations;
                CAPTURE(n, breathing, name(integrator));
                CHECK(ok);
                CHECK(after == before);
            }
        }
    }
}

TEST_CASE("A step of a patch of varying size and shape does not allocate", "[friction]") {
    const HertzEllipse<double> ellipse({.load = 1e4,
                                        .radii_1 = {.rolling = 0.5, .lateral = 0.5},
                                        .radii_2 = {.rolling = INFINITY, .lateral = INFINITY},
                                        .body_1 = {2e11, 0.3},
                                        .body_2 = {2e11, 0.3}});
    const double a = ellipse.half_length();
    const PatchContact<double> contact = ellipse.contact();
    const PatchMesh<double> mesh = patch_mesh(contact, 5, 5);
    const NodeDifference scheme{Nodes::chebyshev};
    const HalfSpace<double> kernel(0.3);
    const PatchShapes<double> shapes(5, 5, scheme, kernel, {.least = 0.5, .largest = 2, .factor = 1.5});
    const auto breathing = HertzPatchLoad<double>::breathing(ellipse, contact, mesh),
               fixed = HertzPatchLoad<double>::fixed(ellipse, contact, mesh);
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        for (const bool moves : {true, false}) {
            const HertzPatchLoad<double>& hertz = moves ? breathing : fixed;
            NormalLoad<double> load = hertz.at(1e4);
            const FrictionModel model(contact, moves ? shapes.system(1) : rolling_system(mesh, scheme, kernel),
                                      unchecked, {0.3, load.normal_pressure}, integrator);
            const AdhesionModel<3> adhesion(contact, shapes.system(1), unchecked, integrator);
            FrictionState<2> now = model.at_rest(), next = now;
            AdhesionState<> stuck = adhesion.at_rest(), stuck_next = stuck;
            auto workspace = model.workspace();
            auto stuck_workspace = adhesion.workspace();
            bool ok = true;
            const long before = allocations;
            for (int k = 0; k < 40; ++k) {
                ok = hertz.set(1e4 * (0.8 - 0.19 * std::cos(0.3 * k)), load) == StepStatus::ok && ok;
                if (moves) load.half_width *= 1 + 0.1 * std::sin(0.2 * k);
                const Creepage<double> creepage{1e-3, (k % 7 - 3) * 1e-3, 0.2};
                ok = ok && model.advance(now, 0.3 * a, creepage, load, next, workspace).status == StepStatus::ok;
                ok = ok && model.steady(next, creepage, load, now, workspace).status == StepStatus::ok;
                std::swap(now, next);
                const SemiAxes<double> axes{load.half_length, load.half_width};
                ok = ok && adhesion.advance(stuck, 0.3 * a, creepage, axes, stuck_next, stuck_workspace).status ==
                               StepStatus::ok;
                ok = ok && adhesion.steady(stuck_next, creepage, stuck, stuck_workspace).status == StepStatus::ok;
                std::swap(stuck, stuck_next);
            }
            const long after = allocations;
            CAPTURE(name(integrator), moves);
            CHECK(ok);
            CHECK(after == before);
        }
    }
}

TEST_CASE("A step with friction that falls with slip does not allocate, however long the search", "[friction]") {
    using Law = ExponentialFall<double>;
    for (const double distance : {0.0, 2e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            for (const Eigen::Index n : {1, 40, 80}) {
                const Contact<double> contact(
                    {.half_length = 4e-3, .half_width = 4, .shear_modulus = 82e9, .poisson_ratio = 0.28});
                const Mesh<double> mesh = cosine_mesh<double>(n);
                const PlaneKernel<double> kernel = PlaneKernel<double>::longitudinal(contact);
                const FrictionModel<Law> model(
                    contact, rolling_system(mesh, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}, kernel), unchecked,
                    {{0.3, 0.18, 0.1}, 495e6 * mean_hertz_pressure(mesh), {distance, 1e-3}}, integrator);
                FrictionState<> now = model.at_rest(), next = now;
                FrictionWorkspace<> workspace = model.workspace();
                NormalLoad<double> load{now.normal_pressure, now.half_length, now.normal_pressure};
                bool ok = true;
                int most_rounds = 0;
                const long before = allocations;
                for (int k = 0; k < 120; ++k) {
                    load.half_length = 4e-3 * (1 + 0.01 * std::sin(0.1 * k));
                    const double dq = k % 40 == 39 ? 0 : 4e-4, duration = 4e-4 / 45, creepage = k < 60 ? 2e-3 : 5e-3;
                    const auto motion = dq == 0 ? RigidMotion<double>::shift(1e-6) : RigidMotion<double>(creepage);
                    const FrictionStep<> step = k % 30 == 20 ? model.steady(now, creepage, 45, next, workspace)
                                                : k % 3 == 0 && dq > 0
                                                    ? model.advance(now, {dq, duration}, motion, load, next, workspace)
                                                    : model.advance(now, {dq, duration}, motion, next, workspace);
                    ok = ok && step.status == StepStatus::ok;
                    most_rounds = std::max(most_rounds, step.rounds);
                    std::swap(now, next);
                }
                int cheap = 0;  // steps in which nothing changes any more
                for (int k = 0; k < 120 && distance > 0; ++k) {
                    const double dq = 0.4 * 4e-3;
                    const FrictionStep<> step = model.advance(now, {dq, dq / 45}, 1e-3, load, next, workspace);
                    ok = ok && step.status == StepStatus::ok;
                    cheap += now.solver.unchanged_steps > 1 + n / 2 ? 1 : 0;
                    std::swap(now, next);
                }
                const long after = allocations;
                CAPTURE(distance, name(integrator), n, most_rounds, cheap);
                CHECK(ok);
                CHECK((cheap > 20 || n > 40 || distance == 0));
                CHECK((most_rounds > 20 || n == 1));
                CHECK(after == before);
            }
        }
    }
}

TEST_CASE("A steady solution with friction does not allocate, even in its fallback", "[friction]") {
    const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
    for (const Eigen::Index n : {20, 200}) {
        const Mesh<double> mesh = cosine_mesh<double>(n);
        const FrictionModel<> model(
            contact,
            steady_system(mesh, Collocation{.alpha_L = 0, .alpha_T = 0.5}, PlaneKernel<double>::longitudinal(contact)),
            unchecked, {1, mean_hertz_pressure(mesh)});
        const FrictionState<> rest = model.at_rest();
        FrictionState<> state = rest;
        FrictionWorkspace<> workspace = model.workspace();
        const long before = allocations;
        const FrictionStep<> point = model.steady(rest, 1.5 * 0.95, state, workspace);
        const long after = allocations;
        CAPTURE(n);
        CHECK(point.status == StepStatus::ok);
        CHECK((point.pivots > 0 || n != 20));
        CHECK(after == before);
    }
}

TEST_CASE("A step with friction in two directions does not allocate, even in its fallbacks", "[friction]") {
    struct Case {
        Eigen::Index n;
        double alpha_L, alpha_T;
    };
    for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
        int hard = 0;
        for (const Case& c : {Case{1, 0.5, 0.5}, Case{40, 0.5, 0.5}, Case{40, 0, 0.5}, Case{200, 0.5, 0.5}}) {
            const Contact<double> contact = Contact<double>::dimensionless(100, 0.25);
            const Mesh<double> mesh = cosine_mesh<double>(c.n);
            const Collocation scheme{.alpha_L = c.alpha_L, .alpha_T = c.alpha_T};
            const FrictionModel<ConstantFriction<>, 2> model(
                contact,
                {rolling_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact)),
                 rolling_system(mesh, scheme, PlaneKernel<double>::lateral(contact))},
                unchecked, {0.3, mean_hertz_pressure(mesh)}, integrator);
            FrictionState<2> now = model.at_rest(), next = now;
            const FrictionWorkspace<2> made = model.workspace();
            FrictionWorkspace<2> workspace = made;  // a copy serves as well
            NormalLoad<double> load{now.normal_pressure, 1, now.normal_pressure};
            bool ok = true;
            const long before = allocations;
            for (int k = 0; k < (c.n == 200 ? 12 : 80); ++k) {
                const Creepage<double> creepage{(k % 13 - 6) * 0.08, (k % 7 - 3) * 0.15};
                const double a = k % 8 < 4 ? 1 + 0.01 * (k % 4) : 1.04 - 0.01 * (k % 4);
                load.normal_pressure = a * (load.pressure_rate);
                load.half_length = a;
                FrictionStep<2> step;
                if (k % 5 == 4) step = model.steady(now, creepage, load, next, workspace);
                if (k % 5 == 3) step = model.advance(now, 0.1, creepage, next, workspace);
                if (k % 5 < 3) step = model.advance(now, 0.1 + 0.1 * (k % 2), creepage, load, next, workspace);
                ok = ok && step.status == StepStatus::ok;
                hard += step.rounds > 16 ? 1 : 0;
                std::swap(now, next);
            }
            const long after = allocations;
            CAPTURE(c.n, c.alpha_L, name(integrator));
            CHECK(ok);
            CHECK(after == before);
        }
        CAPTURE(name(integrator), hard);
        CHECK(hard > 0);
    }
}

TEST_CASE("The combined solver does not allocate, whether it follows a path or fails", "[friction]") {
    constexpr Eigen::Index n = 6;
    detail::CombinedSolver<double> uncoupled(n), coupled(n, true);
    const std::vector<Eigen::Index> behind{-1, 0, 1, -1, 3, 4};
    const std::vector<Zone> zones(n, Zone::stick);
    const ElementVectors<double> start = ElementVectors<double>::Zero(n, 2);
    support::Draw draw(11);
    int several = 0, unsolved = 0;
    for (int problem = 0; problem < 300; ++problem) {
        detail::CombinedSolver<double>& solver = problem % 2 == 0 ? uncoupled : coupled;
        for (const std::size_t slip : {0, 1}) {
            for (const std::size_t by : {0, 1}) {
                if (slip != by && !solver.coupled()) continue;
                for (double& entry : solver.new_matrix(slip, by).reshaped()) entry = draw.normal();
            }
        }
        for (double& entry : solver.constant().reshaped()) entry = draw.normal();
        if (problem % 50 == 0) solver.constant()(0, 0) = std::numeric_limits<double>::infinity();
        VectorX<double> bound(n);
        for (double& entry : bound) entry = std::abs(draw.normal());
        const long before = allocations;
        if (problem % 4 > 1) solver.turn_slip(behind);
        const auto outcome = solver.solve(bound, {start, zones});
        solver.turn_slip({});
        const long after = allocations;
        CAPTURE(problem, outcome.rounds);
        CHECK(after == before);
        several += outcome.rounds > 60 ? 1 : 0;  // more than before the path is followed
        unsolved += outcome.status == StepStatus::ok ? 0 : 1;
    }
    CHECK(several > 50);
    CHECK(unsolved > 0);
}

TEST_CASE("Friction that falls with slip in two directions does not allocate, wherever its search leads",
          "[friction]") {
    using Law = ExponentialFall<double>;
    using Motion = RigidMotion<Creepage<double>>;
    for (const double distance : {0.0, 2e-6}) {
        for (const Integrator integrator : {Integrator::implicit_euler, Integrator::sdirk2}) {
            for (const Eigen::Index n : {1, 40, 80}) {
                const Contact<double> contact(
                    {.half_length = 4e-3, .half_width = 4, .shear_modulus = 82e9, .poisson_ratio = 0.28});
                const Mesh<double> mesh = cosine_mesh<double>(n);
                const Collocation scheme{.alpha_L = 0.5, .alpha_T = 0.5};
                const FrictionModel<Law, 2> model(
                    contact,
                    {rolling_system(mesh, scheme, PlaneKernel<double>::longitudinal(contact)),
                     rolling_system(mesh, scheme, PlaneKernel<double>::lateral(contact))},
                    unchecked, {{0.3, 0.18, 0.1}, 495e6 * mean_hertz_pressure(mesh), {distance, 1e-3}}, integrator);
                FrictionState<2> now = model.at_rest(), next = now;
                FrictionWorkspace<2> workspace = model.workspace();
                NormalLoad<double> load{now.normal_pressure, now.half_length, now.normal_pressure};
                bool ok = true;
                int most_rounds = 0;
                const long before = allocations;
                for (int k = 0; k < (n == 80 ? 24 : 60); ++k) {
                    load.half_length = 4e-3 * (1 + 0.01 * std::sin(0.1 * k));
                    const double dq = k % 20 == 19 ? 0 : 4e-4, duration = 4e-4 / 45, size = k < 15 ? 2e-3 : 5e-3;
                    const Creepage<double> creepage{0.8 * size, 0.6 * size};
                    const Motion motion = dq == 0 ? Motion::shift({1e-6, 1e-6}) : Motion(creepage);
                    FrictionStep<2> step;
                    if (k % 15 == 10) {
                        step = model.steady(now, creepage, 45, next, workspace);
                    } else if (k % 3 == 0 && dq > 0) {
                        step = model.advance(now, {dq, duration}, motion, load, next, workspace);
                    } else {
                        step = model.advance(now, {dq, duration}, motion, next, workspace);
                    }
                    ok = ok && step.status == StepStatus::ok;
                    most_rounds = std::max(most_rounds, step.rounds);
                    std::swap(now, next);
                }
                const long after = allocations;
                CAPTURE(distance, name(integrator), n, most_rounds);
                CHECK(ok);
                CHECK((most_rounds > 30 || n == 1));
                CHECK(after == before);
            }
        }
    }
}

TEST_CASE("A look-up in a table of creep forces does not allocate") {
    const CreepForceTable table = creep_forces::table(5, 4);
    const PatchContact<double> contact({5e-3, 6e-3, 8e10, 0.28});
    double sum = 0;
    const long before = allocations;
    for (int k = 0; k < 100; ++k) {
        const TabulatedForce at = table.look_up(contact, 0.3, 8e4, {1e-4 * k, 2e-5 * (k - 50), 0.01 * k});
        sum += at.force.lateral + at.tangent.by_spin.moment;
    }
    CHECK(allocations == before);
    CHECK(std::isfinite(sum));
}

}  // namespace
