// rollbem/assembly/detail/influence_rows.hpp
#include <cmath>
#include <numbers>
#include <type_traits>
#include <vector>

#include <rollbem/assembly/detail/influence_rows.hpp>

#include "support/brute_force.hpp"
#include "support/catch.hpp"

namespace {

using namespace rollbem;
using brute_force::Real;

// Rows of a fine mesh against long double; a naive second difference errs by 8e-8 on 10^4 elements.
void check_rows(const Mesh<double>& mesh, const Mesh<Real>& exact, const brute_force::Kernel& kernel, int averages,
                bool slope, double limit) {
    const Eigen::Index n = mesh.size();
    const std::vector<Eigen::Index> picked{0, n / 3, n - 1};
    const Eigen::Index count = static_cast<Eigen::Index>(picked.size());
    const double alpha = 0.625;
    detail::RowPoints<double> rows{ArrayX<double>(count), ArrayX<double>(count), ArrayX<double>(count),
                                   ArrayX<double>(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Index l = picked[static_cast<std::size_t>(i)];
        rows.from_trailing[i] = mesh.from_trailing()[l];
        rows.from_leading[i] = mesh.from_leading()[l];
        rows.offset[i] = alpha * mesh.widths()[l];
        rows.half[i] = mesh.widths()[l] / 2;
    }
    const detail::ColumnElements<double> columns{mesh.from_trailing(), mesh.from_leading(), mesh.widths() / 2};
    MatrixX<double> matrix(count, n);
    brute_force::with_library_kernel<double>(kernel, [&](const auto& k) {
        detail::LineIntegrals<typename std::decay_t<decltype(k)>::Scalar>(
            k, slope ? Quantity::slope : Quantity::displacement, averages, rows, columns)
            .fill(matrix);
    });
    const brute_force::Rows scheme{.alpha_L = alpha, .alpha_T = alpha, .averages = averages, .guard = false};
    double largest = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        std::vector<Real> scales;
        const std::vector<Real> row =
            brute_force::row(kernel, exact, scheme, slope, picked[static_cast<std::size_t>(i)], &scales);
        for (std::size_t m = 0; m < row.size(); ++m) {
            const Real error =
                std::abs(static_cast<Real>(matrix(i, static_cast<Eigen::Index>(m))) - row[m]) / scales[m];
            if (!(error <= static_cast<Real>(largest)))
                largest = std::isnan(error) ? 1e300 : static_cast<double>(error);
        }
    }
    CAPTURE(mesh.is_uniform(), kernel.plane, static_cast<double>(kernel.b), averages, slope, largest);
    CHECK(largest < limit);
}

TEST_CASE("Rows of 3000 elements keep ten digits", "[line_integrals]") {
    const Eigen::Index n = 3000;
    const Mesh<double> uniform = uniform_mesh(n), cosine = cosine_mesh(n);
    const Mesh<Real> exact_uniform = uniform_mesh<Real>(n), exact_cosine = cosine_mesh<Real>(n);
    for (const brute_force::Kernel& kernel :
         {brute_force::Kernel{true, 1000, 0.75L, 0.25L}, brute_force::Kernel{false, 1000, 0.75L, 0.25L},
          brute_force::Kernel{false, 1, 0.75L, 0.25L}}) {
        for (const bool slope : {true, false}) {
            for (const int averages : {0, 1}) {
                if (!slope && averages == 1) continue;
                check_rows(uniform, exact_uniform, kernel, averages, slope, 1e-10);
                check_rows(cosine, exact_cosine, kernel, averages, slope, 1e-10);
            }
        }
    }
}

TEST_CASE("The series of far entries is truncated below round-off", "[line_integrals]") {
    const brute_force::Kernel kernel{true, 1000, 0.75L, 0.25L};
    for (const Eigen::Index n : {32, 64, 128}) {  // powers of two: distances on uniform meshes are exact
        for (const int averages : {0, 1}) {
            check_rows(uniform_mesh(n), uniform_mesh<Real>(n), kernel, averages, true, 1e-13);
        }
    }
}

TEST_CASE("The slope of one element is accurate at any distance", "[line_integrals]") {
    // for any number of terms: ln((d + h)/(d - h)) = 2 atanh(h/d)
    const PlaneKernel<double> kernel(100, 0.75, 0.25);
    const double strength = 1.5 / std::numbers::pi, half = 0.125;
    for (double ratio = 0.005; ratio < 1.0 / 3; ratio *= 1.01) {
        const double d = half / ratio;
        const auto one = [](double value) { return ArrayX<double>::Constant(1, value); };
        MatrixX<double> entry(1, 1);
        detail::LineIntegrals<double>(kernel, Quantity::slope, 0, {one(d), one(-d), one(0), one(half)},
                                      {one(0), one(0), one(half)})
            .fill(entry);
        CAPTURE(ratio, entry(0, 0));
        CHECK(std::abs(entry(0, 0) / (-2 * strength * std::atanh(half / d)) - 1) < 2e-15);
    }
}

}  // namespace
