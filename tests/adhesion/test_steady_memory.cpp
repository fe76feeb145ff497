// rollbem/adhesion/steady.hpp: a large problem holds one matrix.
// A program of its own, because it replaces malloc.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/steady.hpp>

#include "support/catch.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

#include <malloc.h>

namespace {

std::atomic<long> held{0}, peak{0};  // bytes

void* counted(void* memory) {
    if (memory != nullptr) {
        const long now = held += static_cast<long>(malloc_usable_size(memory));
        peak = std::max(peak.load(), now);
    }
    return memory;
}

}  // namespace

// Eigen and operator new take their memory from malloc.
extern "C" {
void* __libc_malloc(std::size_t size);                     // NOLINT: glibc's own names
void* __libc_calloc(std::size_t count, std::size_t size);  // NOLINT
void* __libc_realloc(void* memory, std::size_t size);      // NOLINT
void __libc_free(void* memory);                            // NOLINT

void* malloc(std::size_t size) { return counted(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return counted(__libc_calloc(count, size)); }
void* realloc(void* memory, std::size_t size) {
    if (memory != nullptr) held -= static_cast<long>(malloc_usable_size(memory));
    return counted(__libc_realloc(memory, size));
}
void free(void* memory) {
    if (memory != nullptr) held -= static_cast<long>(malloc_usable_size(memory));
    __libc_free(memory);
}
}

namespace {

using namespace rollbem;

/// Doubles that `call` holds at its peak.
template <class Call>
double peak_doubles(const Call& call) {
    const long before = held;
    peak = before;
    call();
    return static_cast<double>(peak - before) / sizeof(double);
}

TEST_CASE("The counter sees the memory of a matrix", "[steady]") {
    const double doubles = peak_doubles([] { CHECK(MatrixX<double>::Ones(100, 100).eval().sum() == 10000); });
    CHECK(doubles >= 10000);
    CHECK(doubles < 20000);
}

TEST_CASE("A steady problem of 2000 elements holds one matrix and O(n) more", "[steady]") {
    const PlaneKernel<double> kernel(1000, 0.72, 0.28);
    const Collocation halves{.alpha_L = 0.5, .alpha_T = 0.5};
    Response<double> solution;
    for (const bool uniform : {true, false}) {
        for (const double n : {1200.0, 2000.0}) {
            const Mesh<double> mesh =
                uniform ? uniform_mesh(static_cast<Eigen::Index>(n)) : cosine_mesh(static_cast<Eigen::Index>(n));
            const double doubles = peak_doubles([&] { solution = solve_steady(mesh, halves, kernel); });
            CAPTURE(uniform, n, (doubles - n * n) / n);
            CHECK(doubles >= n * n);
            CHECK(doubles < n * n + 300 * n);  // LU copies blocks of up to 256 columns
            CHECK(solution.status == Status::ok);
            CHECK(solution.residual < 1e-14);
            CHECK(solution.residual > 0);
            const double error = solution.c11() / steady_c11(0.28) - 1;
            CHECK(std::abs(error / (uniform ? 0.1507 / n : 0.1672 / (n * n)) - 1) < 0.01);
        }
    }
}

TEST_CASE("The product for the residual of a large problem agrees with the assembled G'", "[steady]") {
    const StripKernel<double> kernel(20, 0.72, 0.28);
    const Mesh<double> uniform = uniform_mesh(70);
    for (const auto& [mesh, scheme] : {
             std::pair<Mesh<double>, AnyScheme>{uniform, Collocation{.alpha_L = 0.5, .alpha_T = 0.5}},
             {uniform, Collocation{0, 0.63}},
             {cosine_mesh(70), Collocation{0.5, 0.5, Derivative::analytic}},
             {uniform, KnotheBoundary{}},
             {uniform, NodeDifference{}},  // Toeplitz but for the last row, which belongs to a block of its own kind
         }) {
        const VectorX<double> p = VectorX<double>::Random(unknown_count(scheme, mesh));
        const VectorX<double> product = detail::influence_product<double>(
            mesh, scheme_rows(scheme, Quantity::slope, mesh), detail::KernelView<double>(kernel), Quantity::slope, p);
        CHECK((product - assemble_G_prime(mesh, scheme, kernel) * p).cwiseAbs().maxCoeff() < 1e-12);
    }
}

}  // namespace

#else

TEST_CASE("Memory is counted only with glibc", "[steady]") { SUCCEED(); }

#endif
