// Simplified theories beside friction on a patch: FASTSIM (Kalker 1982), FaStrip (Sichani, Enblom and Berg 2016) and
// Kalker's linear theory with saturation (Shen, Hedrick and Elkins 1983). Forces over mu N on ellipses of nu = 0.28,
// over the longitudinal and the lateral creepage, the latter with the spin of a contact angle.
//
//     ./examples/simplified_theories [largest error of the patches, over mu N] > simplified_theories.csv
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <rollbem/rollbem.hpp>

using namespace rollbem;

namespace {

constexpr double nu = 0.28;
const NodeDifference scheme{Nodes::chebyshev};

/// |F| = |L| - |L|^2/3 + |L|^3/27 in the direction of Kalker's force L, in mu N, as long as |L| < 3.
TangentialForce saturated(double x, double y) {
    const double size = std::hypot(x, y), reached = size < 3 ? size - size * size / 3 + std::pow(size, 3) / 27 : 1;
    return size > 0 ? TangentialForce{-x / size * reached, -y / size * reached, 0} : TangentialForce{0, 0, 0};
}

/// Units: mu N = G = a = 1; a creepage of 1 would need mu N without slip.
class Ellipse {
public:
    static constexpr const char* names[] = {"FASTSIM", "FASTSIM, elliptic bound", "FaStrip", "linear, saturated"};
    using Forces = std::array<TangentialForce, 5>;  // of the patch and of the theories

    Ellipse(double a_over_b, double tolerance)
        : contact_(PatchContact::dimensionless(a_over_b, nu)), mesh_(patch_of(tolerance)), model_(friction()) {}

    Forces forces(double x, double y, double spin) {
        const double b = contact_.half_width(), c = contact_.c();
        const Creepage at{x / (b * kalker_.c11), y / (b * kalker_.c22), spin / (b * c * kalker_.c23)};
        const FrictionStep step = model_.steady(model_.at_rest(), {.motion = at}, state_, workspace_);
        if (step.status != Status::ok) std::exit(EXIT_FAILURE);
        constexpr int n = 40;
        const SimplifiedTheory theory(contact_, kalker_, 1, 1, {n, n}),
            elliptic(contact_, kalker_, 1, 1, {n, n, SimplifiedTheory::Bound::elliptic});
        return {step.force, theory.fastsim(at).force, elliptic.fastsim(at).force, theory.fastrip(at).force,
                saturated(x, y + spin)};
    }

private:
    PatchMesh<double> patch_of(double tolerance) const {
        return recommended_patch(tolerance, contact_.a_over_b()).mesh(contact_);
    }
    FrictionModel friction() const {
        return {contact_,
                steady_system(mesh_, scheme, HalfSpace<double>(nu)),
                {1.0, hertz_pressures(contact_, mesh_, 1.0)}};
    }

    PatchContact contact_;
    PatchMesh<double> mesh_;
    CreepCoefficients<double> kalker_ =
        creep_coefficients(contact_, solve_steady(contact_, patch_mesh(contact_, 16, 16), scheme));
    FrictionModel model_;
    FrictionState state_ = model_.at_rest();
    FrictionModel::Workspace workspace_ = model_.workspace();
};

double difference(const TangentialForce& one, const TangentialForce& other) {
    return std::max(std::abs(one.longitudinal - other.longitudinal), std::abs(one.lateral - other.lateral));
}

/// Mean and largest differences over creepages alone and together, without and with spin, of which some acts against
/// the lateral creepage. Returns the largest of FASTSIM.
double compare(double a_over_b, double tolerance) {
    Ellipse ellipse(a_over_b, tolerance);
    constexpr double half = 0.70710678, third = 0.57735027;
    constexpr double directions[][3] = {{1, 0, 0},       {0, 1, 0},       {half, half, 0},       {0, 0, 1},
                                        {half, 0, half}, {0, half, half}, {third, third, third}, {0, half, -half}};
    double mean[2][4] = {}, largest[2][4] = {};
    int counts[2] = {0, 0};
    for (const auto& [x, y, spin] : directions) {
        for (const double level : {0.4, 1.0, 2.5}) {
            const Ellipse::Forces found = ellipse.forces(level * x, level * y, level * spin);
            const std::size_t with = spin != 0;
            ++counts[with];
            for (std::size_t k = 0; k < 4; ++k) {
                const double error = difference(found[k + 1], found[0]);
                mean[with][k] += error;
                largest[with][k] = std::max(largest[with][k], error);
            }
        }
    }
    for (std::size_t k = 0; k < 4; ++k) {
        std::fprintf(stderr, "a/b = %-3g %-24s %.4f (%.4f); with spin %.4f (%.4f)\n", a_over_b, Ellipse::names[k],
                     mean[0][k] / counts[0], largest[0][k], mean[1][k] / counts[1], largest[1][k]);
    }
    return std::max(largest[0][0], largest[1][0]);
}

}  // namespace

int main(int argc, char** argv) {
    const double tolerance = argc > 1 ? std::atof(argv[1]) : 0.03;
    // 1. Curves for a picture
    Ellipse ellipse(1.5, tolerance);
    std::puts("spin,creepage,rollbem,fastsim,fastsim_elliptic,fastrip,saturated_linear");  // creepages as above
    for (const double spin : {0.0, 0.8}) {
        for (int k = spin == 0 ? 0 : -40; k <= 40; ++k) {
            const double level = k / 10.0;
            std::printf("%g,%g", spin, level);
            const auto found = spin == 0 ? ellipse.forces(level, 0, 0) : ellipse.forces(0, level, spin);
            for (const auto& force : found) std::printf(",%.6f", spin == 0 ? -force.longitudinal : -force.lateral);
            std::puts("");
        }
    }
    // 2. Differences
    double largest = 0;
    for (const double a_over_b : {0.2, 0.5, 1.0, 2.0, 5.0}) largest = std::max(largest, compare(a_over_b, tolerance));
    // CONTACT finds FASTSIM as far off, and further where spin acts against the lateral creepage
    return largest > 0.05 && largest < 0.2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
