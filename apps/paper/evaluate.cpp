// The library calls behind the figures and claims of the paper.
#include "evaluate.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/adhesion.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/compiled/steady.hpp>
#include <rollbem/discretisation/any_scheme.hpp>

namespace paper {

namespace {

using Mesh = rollbem::Mesh<double>;

Mesh mesh_of(const Case& c) { return rollbem::make_mesh(c.mesh, c.n, c.grading); }

rollbem::AnyScheme scheme_of(const Case& c) {
    if (c.method == Method::collocation) return rollbem::Collocation{c.alpha_L, c.alpha_T, c.derivative, c.lambda};
    const int quadrature = c.method == Method::galerkin_7 ? 7 : rollbem::exact_quadrature;
    return rollbem::Galerkin{c.alpha_L, c.alpha_T, c.derivative, c.lambda, quadrature};
}

}  // namespace

rollbem::StripKernel<double> strip() {
    return rollbem::StripKernel<double>::longitudinal(rollbem::Contact<double>::dimensionless(aspect, poisson_ratio));
}

rollbem::ElementSystem<double> system_of(const Case& c) {
    return rollbem::rolling_system(mesh_of(c), scheme_of(c), strip());
}

std::string name(Method method) {
    switch (method) {
        case Method::collocation: break;
        case Method::galerkin_7: return "galerkin-7";
        case Method::galerkin_exact: return "galerkin-exact";
    }
    return "collocation";
}

std::string name(Derivative derivative) { return derivative == Derivative::analytic ? "analytic" : "fd"; }

ElementField element_field(double x_over_width) {
    const double width = 2.0 / 40, ahead = width * (x_over_width + 0.5), behind = width * (x_over_width - 0.5);
    const double c1 = 1 - poisson_ratio, c2 = poisson_ratio, b = aspect, scale = 2 / std::numbers::pi;
    const auto g = [&](double x) { return scale * (c1 * std::asinh(b / std::abs(x)) + c2 * b / std::hypot(x, b)); };
    const auto integral = [&](double x) {
        return x == 0 ? 0 : scale * (c1 * x * std::asinh(b / std::abs(x)) + (c1 + c2) * b * std::asinh(x / b));
    };
    return {integral(ahead) - integral(behind), g(ahead) - g(behind)};
}

// Whether the equations are solved. The paper shows schemes that do not converge to full adhesion, too, such as all
// with alpha_T = 0: their trailing traction has the wrong sign, but their force may be close.
static bool is_solved(rollbem::Status status) {
    return status == rollbem::Status::ok || status == rollbem::Status::assists_creepage;
}

rollbem::Response<double> steady(const Case& c) { return rollbem::solve_steady(mesh_of(c), scheme_of(c), strip()); }

double c11_ratio(const Case& c) {
    const rollbem::Response<double> solution = steady(c);
    return is_solved(solution.status) ? solution.c11() / rollbem::steady_c11(poisson_ratio)
                                      : std::numeric_limits<double>::quiet_NaN();
}

Tractions tractions(const Case& c) {
    const Mesh mesh = mesh_of(c);
    const rollbem::Response<double> solution = steady(c);
    Tractions result{mesh.centres(), solution.unknowns.col(0), Eigen::ArrayXd(c.n),
                     rollbem::carter_mean_tractions(mesh, poisson_ratio), solution.status};
    if (!is_solved(solution.status)) result.value.setConstant(std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index i = 0; i < c.n; ++i) {
        result.carter[i] = rollbem::carter_traction(
            rollbem::EdgeDistances<double>{mesh.from_trailing()[i], mesh.from_leading()[i]}, poisson_ratio);
    }
    return result;
}

Eigen::Index unstable_count(const Case& c) {
    const rollbem::ElementSystem<double> system = system_of(c);
    const rollbem::UnstableCount<double> fast = rollbem::count_unstable<double>(system);
    if (fast.status == rollbem::Status::ok) return fast.unstable_count;
    const rollbem::StabilityResult<double> slow = rollbem::solve_stability<double>(system);
    if (slow.status != rollbem::Status::ok) throw std::runtime_error("the eigenvalues of Eq. (33) were not found");
    return slow.unstable_count;
}

std::vector<HarmonicResponse> harmonic_responses(const Case& c, const std::vector<double>& z) {
    const rollbem::FrequencySweep<double> sweep(system_of(c));
    std::vector<HarmonicResponse> result;
    for (const double frequency : z) {
        const rollbem::Response<std::complex<double>> point = sweep(frequency);
        const double nothing = std::numeric_limits<double>::quiet_NaN();
        result.push_back({is_solved(point.status) ? point.c11() : std::complex(nothing, nothing), point.status});
    }
    return result;
}

}  // namespace paper
