// rollbem/rollbem.hpp: properties that every scene has, on random scenes from the whole domain.
// ROLLBEM_SCENES is their number (default 10000), ROLLBEM_SEED the seed of the generator.
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <limits>
#include <utility>

#include <rollbem/line.hpp>

#include "drawn_scenes.hpp"
#include "support/catch.hpp"
#include "support/dense.hpp"

namespace random_scenes_tests {
namespace {

using namespace rollbem;
using Matrix = MatrixX<double>;

constexpr double eps = std::numeric_limits<double>::epsilon();

using drawn_scenes::from_environment;

/// A scene, which the seed and its number reproduce in the same test case.
struct Scene {
    Mesh<double> mesh;
    AnyScheme scheme;
    double aspect, poisson_ratio;
    bool plane, lateral;
    bool modest;      // no end element far larger than the others, and alphas for which tractions converge
    double rounding;  // of G', relative to its largest entry

    double c1() const { return lateral ? 1 : 1 - poisson_ratio; }
    double c2() const { return lateral ? -poisson_ratio : poisson_ratio; }
    double carter() const { return steady_c11(lateral ? 0.0 : poisson_ratio); }  // the factor is 1/c1
    ArrayX<double> widths() const { return unknown_widths(mesh, scheme); }
};

using Kernel = AnyKernel<double>;
Kernel kernel_of(const Scene& scene) {
    return {scene.plane ? LineModel::plane : LineModel::strip, scene.aspect, scene.c1(), scene.c2()};
}

// as assemble_G() and assemble_G_prime(), also where G is not finite
Matrix assemble_one(const Mesh<double>& mesh, const AnyScheme& scheme, const Kernel& kernel, Quantity quantity) {
    return detail::influence_matrix<double>(mesh, scheme_rows(scheme, quantity, mesh),
                                            detail::KernelView<double>(kernel), quantity);
}
template <class System>
System system_of(const Scene& scene) {
    return System(assemble_one(scene.mesh, scene.scheme, kernel_of(scene), Quantity::displacement),
                  assemble_one(scene.mesh, scene.scheme, kernel_of(scene), Quantity::slope), scene.widths());
}
Response<double> steady_of(const Scene& scene, const Kernel& kernel) {
    return solve_steady<double>(assemble_one(scene.mesh, scene.scheme, kernel, Quantity::slope), scene.widths());
}

Scene drawn_scene(drawn::Draw& draw) {
    const Eigen::Index n = draw.integer(3, 14);
    double grading = 1;
    const auto mesh = [&]() -> Mesh<double> {
        switch (draw.integer(0, 5)) {
            case 0: return uniform_mesh(n);
            case 1: return cosine_mesh(n);
            case 2: return geometric_mesh(n, grading = draw.logarithmic(1e-6, 1e6));
            case 3: return knothe_mesh(n, grading = draw.logarithmic(1e-8, 10));
            case 4: return modified_knothe_mesh(n, grading = draw.logarithmic(1e-8, 10));
            default: {
                ArrayX<double> edges(n + 1);
                for (double& edge : edges) edge = draw.uniform(-1, 1);
                std::sort(edges.begin(), edges.end());
                edges[0] = -1, edges[n] = 1;
                grading = 0;
                return mesh_from_edges<double>(edges);
            }
        }
    }();
    const bool ordinary = draw.integer(0, 1) == 0;  // the intended range of schemes
    double alpha_L = ordinary ? draw.uniform(0, 0.7) : draw.uniform(-2, 2);
    double alpha_T = ordinary ? draw.uniform(0.3, 0.9) : draw.uniform(-2, 2);
    if (draw.integer(0, 3) == 0) alpha_L = alpha_T;
    const Derivative derivative = draw.integer(0, 1) == 0 ? Derivative::finite_difference : Derivative::analytic;
    const double lambda = draw.integer(0, 1) == 0 ? 1 : draw.uniform(0, 1);
    Scene scene{
        .mesh = mesh,
        .scheme = Collocation{alpha_L, alpha_T, derivative, lambda},
        .aspect = draw.logarithmic(0.01, 1e12),
        .poisson_ratio = std::clamp(draw.uniform(-0.1, 0.6), 0.0, 0.5),
        .plane = draw.integer(0, 2) == 0,
        .lateral = draw.integer(0, 3) == 0,
        .modest = grading >= 0.1 && grading <= 3 && ordinary && n >= 8 && derivative == Derivative::finite_difference,
        .rounding = 0};
    const int method = draw.integer(0, 5);
    if (method == 0) scene.scheme = Galerkin{alpha_L, alpha_T, derivative, lambda, draw.integer(0, 7)};
    if (method == 1) scene.scheme = KnotheBoundary{derivative};
    if (method == 2) scene.scheme = NodeDifference{};
    scene.modest = scene.modest && method != 1;  // in effect alpha = 1, which zigzags on graded meshes
    // The entry of a small element seen from a wide one is a difference of terms of the size of the wide one,
    // divided by the small width; a finite difference averaged in closed form divides once more.
    const double contrast = mesh.widths().maxCoeff() / mesh.widths().minCoeff();
    scene.rounding = 50 * eps * contrast;
    if (derivative == Derivative::analytic) scene.rounding *= 20;  // points 0.001 of a width off a singularity
    const auto* galerkin = scene.scheme.get_if<Galerkin>();
    if (galerkin != nullptr && galerkin->quadrature == exact_quadrature &&
        derivative == Derivative::finite_difference) {
        scene.rounding *= contrast;
    }
    return scene;
}

/// The mirrored scene: edges interchanged, alphas interchanged with opposite sign.
Mesh<double> mirrored(const Mesh<double>& mesh) {
    return Mesh<double>({.widths = mesh.widths().reverse(),
                         .edges_from_trailing = mesh.edges_from_leading().reverse(),
                         .edges_from_leading = mesh.edges_from_trailing().reverse(),
                         .uniform = mesh.is_uniform()});
}
AnyScheme mirrored(const AnyScheme& scheme) {
    const auto swapped = [](auto s) -> AnyScheme {
        s.alpha_L = -std::exchange(s.alpha_T, -s.alpha_L);
        return s;
    };
    if (const auto* collocation = scheme.get_if<Collocation>()) return swapped(*collocation);
    if (const auto* galerkin = scheme.get_if<Galerkin>()) return swapped(*galerkin);
    return scheme;
}

/// Largest difference of two matrices, relative to the largest entry of the first.
double difference(const Matrix& one, const Matrix& other) {
    return (one - other).cwiseAbs().maxCoeff() / one.cwiseAbs().maxCoeff();
}

/// Calls CHECK, which takes longer than a scene, only for what fails.
void at_most(double value, double limit) {
    if (!(value <= limit)) CHECK(value <= limit);
}

template <class Function>
void for_each_scene(const Function& function) {
    const std::uint64_t count = from_environment("ROLLBEM_SCENES", 10000);
    const std::uint64_t seed = from_environment("ROLLBEM_SEED", 20181205);
    CAPTURE(seed);
    drawn::Draw draw(seed);
    for (std::uint64_t k = 0; k < count; ++k) {
        const Scene scene = drawn_scene(draw);
        INFO("scene " << k);
        function(draw, scene);
    }
}

TEST_CASE("Matrices are finite, and mirrored scenes have mirrored matrices", "[property]") {
    std::uint64_t all = 0, compared = 0;
    for_each_scene([&](drawn::Draw&, const Scene& scene) {
        ++all;
        const Kernel kernel = kernel_of(scene);
        const Matrix G = assemble_one(scene.mesh, scene.scheme, kernel, Quantity::displacement),
                     G_prime = assemble_one(scene.mesh, scene.scheme, kernel, Quantity::slope);
        const bool finite = G.allFinite() && G_prime.allFinite();
        if (!finite) CHECK(finite);
        // Knothe's boundary conditions and rows that end on the leading edge are not symmetric
        if (scene.scheme.get_if<KnotheBoundary>() || scene.scheme.get_if<NodeDifference>()) return;
        const Mesh<double> back = mirrored(scene.mesh);
        const AnyScheme scheme = mirrored(scene.scheme);
        const Matrix G_back = assemble_one(back, scheme, kernel, Quantity::displacement),
                     G_prime_back = assemble_one(back, scheme, kernel, Quantity::slope);
        const double tolerance = 1e-12 + scene.rounding;
        at_most(difference(G, G_back.reverse()), tolerance);
        at_most(difference(G_prime, -G_prime_back.reverse()), tolerance);
        ++compared;
    });
    CHECK(compared > all / 4);
}

TEST_CASE("A steady solution has the properties that its status promises", "[property]") {
    std::uint64_t good = 0, modest = 0;
    for_each_scene([&](drawn::Draw& draw, const Scene& scene) {
        const Matrix G_prime = assemble_one(scene.mesh, scene.scheme, kernel_of(scene), Quantity::slope);
        const ArrayX<double> widths = scene.widths();
        const Response<double> solution = solve_steady<double>(G_prime, widths);
        if (scene.modest) {
            ++modest;
            if (solution.status != Status::ok) CHECK(solution.status == Status::ok);
        }
        if (solution.status != Status::ok) return;
        ++good;
        // the residual, computed independently
        const double n = static_cast<double>(widths.size());
        const double residual =
            (dense::product(G_prime, solution.unknowns) - VectorX<double>::Ones(widths.size())).cwiseAbs().maxCoeff() /
            (G_prime.cwiseAbs().rowwise().sum().maxCoeff() * solution.unknowns.cwiseAbs().maxCoeff() + 1);
        at_most(residual, 100 * n * eps);
        // friction opposes creepage
        if (!(solution.c11() > 0)) CHECK(solution.c11() > 0);
        if (scene.plane && scene.modest) {
            at_most(std::abs(solution.c11() / scene.carter() - 1.05), 0.3);
        }
        // Poisson's ratio only scales G' of the plane kernel
        const double tolerance = (1000 * eps + scene.rounding) / solution.rcond;
        if (scene.plane) {
            const double other = steady_of(scene, {LineModel::plane, 1, 1, draw.uniform(0, 1)}).c11();
            at_most(std::abs(solution.c11() / scene.carter() * (std::acos(-1.0) / 2) / other - 1), tolerance);
        }
        // A wider strip is less stiff. For nu above 1/3 the term of order (a/b)^2 has the other sign.
        if (!scene.plane && scene.modest && 2 * scene.c2() < scene.c1()) {
            const double wider = steady_of(scene, {LineModel::strip, 2 * scene.aspect, scene.c1(), scene.c2()}).c11();
            at_most(wider, solution.c11() * (1 + tolerance));
        }
    });
    // enough solutions are ok for the checks to mean something
    CHECK(good > modest);
    CHECK(modest > 0);
}

TEST_CASE("Harmonic responses are conjugate-symmetric and tend to the steady one", "[property]") {
    std::uint64_t drawn = 0, compared = 0;
    for_each_scene([&](drawn::Draw& draw, const Scene& scene) {
        ++drawn;
        const auto system = system_of<RollingSystem<double>>(scene);
        const FrequencySweep sweep(system);
        const double z = draw.logarithmic(1e-12, 1e6);
        const Response<std::complex<double>> up = sweep(z), down = sweep(-z);
        if (up.status != down.status) CHECK(up.status == down.status);
        if (up.status != Status::ok) return;
        at_most(std::abs(up.c11() / std::conj(down.c11()) - 1.0), 1e-13);
        const Response<std::complex<double>> full = solve_response(system, {0, z});
        if (full.status == Status::ok) {
            at_most(std::abs(up.c11() / full.c11() - 1.0), 1000 * eps / std::min(up.rcond, full.rcond));
        }
        const Response<double> steady = solve_steady<double>(system.G_prime(), system.weights());
        const Response<std::complex<double>> still = sweep(0);
        if (steady.status != Status::ok || still.status != Status::ok) return;
        ++compared;
        at_most(std::abs(still.c11() / steady.c11() - 1.0), 1000 * eps / steady.rcond);
    });
    CAPTURE(drawn, compared);
    CHECK(10 * compared > drawn);
}

TEST_CASE("Steps of any length are finite or reported, and long ones end in steady rolling", "[property]") {
    std::uint64_t drawn = 0, compared = 0;
    for_each_scene([&](drawn::Draw& draw, const Scene& scene) {
        ++drawn;
        using Model = AdhesionModel<>;
        if (scene.plane && plane_lambda(scene.poisson_ratio, scene.aspect) < 0.5) return;
        const Contact contact = Contact::dimensionless(scene.aspect, scene.poisson_ratio);
        const auto system = system_of<ElementSystem<double>>(scene);
        const Response<double> steady = solve_steady<double>(system.G_prime(), system.weights());
        const Matrix lengths = dense::solve(system.G_prime(), system.G());
        const double longest = lengths.cwiseAbs().rowwise().sum().maxCoeff();
        const Model model(contact, system, unchecked,
                          draw.integer(0, 1) == 0 ? Integrator::sdirk2 : Integrator::implicit_euler);
        Run run(model);
        const AdhesionModel<>::Step any = run.try_advance({draw.logarithmic(1e-9, 1e6), 1.0});
        const bool consistent = (any.status == Status::ok) == std::isfinite(any.force);
        if (!consistent) CHECK(consistent);
        if (steady.status != Status::ok) return;
        ++compared;
        // a step far longer than every mode forgets its initial state, even along growing modes, as it is L-stable;
        // |G'^-1 G| bounds the length of the slowest mode, which grows with the condition number of G'
        const double dq = std::max(1e9, 1e4 * longest);
        AdhesionModel<>::Step last;
        for (int k = 0; k < 4; ++k) last = run.advance({dq, 1.0});
        at_most(std::abs(-last.force_per_width / steady.c11() - 1), 1e-6 + 1000 * eps / steady.rcond);
    });
    CAPTURE(drawn, compared);
    CHECK(10 * compared > drawn);
}

}  // namespace
}  // namespace random_scenes_tests
