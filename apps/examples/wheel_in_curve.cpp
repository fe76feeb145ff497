// A wheel on the outer rail of a curve, in SI units: ellipse, spin and creep forces while it shifts across the rail.
// Its tread is hollow, an arc little flatter than the head of the rail, so that the contact angle grows with the shift,
// and with it spin and the larger radius that drives the wheel on.
//
//     ./examples/wheel_in_curve
//
//     shift mm  a mm  b mm  spin 1/m      F_x N      F_y N    M_z N m   of mu N
//          0.0  4.87 11.99    -0.107     -16112      11996       17.6      0.84
//          3.0  4.88 11.98    -0.215      -9274      14597       54.2      0.72
//          6.0  4.89 11.97    -0.323      -1437      15770       79.6      0.66
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <rollbem/rollbem.hpp>

namespace {

using namespace rollbem;

constexpr double load = 8e4, mu = 0.3;                     // N [N], [-]
constexpr double radius = 0.46, tread = 0.36, head = 0.3;  // of the wheel, of both profiles [m]
constexpr double curve = 500, gauge = 1.5, attack = 1e-3;  // [m], [m], angle between wheelset and track [rad]
constexpr double modulus = 2.1e11, poisson = 0.28;         // of steel
constexpr double infinite = std::numeric_limits<double>::infinity();

/// The contact angle [rad] after a shift towards the flange [m], from 1/20 in the middle of the tread.
double contact_angle(double shift) { return 0.05 + shift / (tread - head); }

/// Creepages of the outer wheel. A larger rolling radius drives it on; the longer way round the curve takes it back. A
/// wheel on a cone of the contact angle turns about the normal.
Creepage creepages(double shift) {
    const double larger_radius = shift * (0.05 + shift / (tread - head) / 2);
    const double angle = contact_angle(shift);
    return {.longitudinal = gauge / 2 / curve - larger_radius / radius,
            .lateral = -attack / std::cos(angle),
            .spin = std::cos(angle) / curve - std::sin(angle) / radius};
}

}  // namespace

int main() {
    const ElasticBody steel{modulus, poisson};
    std::printf("shift mm  a mm  b mm  spin 1/m      F_x N      F_y N    M_z N m   of mu N\n");
    bool right = true;
    for (int step = 0; step <= 6; ++step) {
        const double shift = 1e-3 * step;
        // 1. Hertz's ellipse; the plane of the wheel's rolling is tilted by the contact angle
        const HertzEllipse hertz({.load = load,
                                  .radii_1 = {radius / std::cos(contact_angle(shift)), -tread},
                                  .radii_2 = {infinite, head},
                                  .body_1 = steel,
                                  .body_2 = steel});
        const PatchContact contact = hertz.contact();
        // 2. Stick and slip in steady rolling
        const PatchMesh<double> mesh = patch_mesh(contact, 12, 12);
        const FrictionModel model(contact,
                                  steady_system(mesh, NodeDifference{Nodes::chebyshev}, HalfSpace<double>(poisson)),
                                  {mu, hertz_pressures(contact, mesh, load)});
        auto workspace = model.workspace();
        const auto rest = model.at_rest();
        auto state = rest;
        const Creepage creepage = creepages(shift);
        const FrictionStep outer = model.steady(rest, {.motion = creepage}, state, workspace);
        const double share = std::hypot(outer.force.longitudinal, outer.force.lateral) / (mu * load);
        std::printf("%8.1f %5.2f %5.2f %9.3f %10.0f %10.0f %10.1f %9.2f\n", 1e3 * shift, 1e3 * hertz.half_length(),
                    1e3 * hertz.half_width(), creepage.spin, outer.force.longitudinal, outer.force.lateral,
                    outer.force.moment, share);
        // 3. The mirror image of the wheel has the mirrored forces, and friction takes energy
        const FrictionStep mirrored = model.steady(
            rest, {.motion = {creepage.longitudinal, -creepage.lateral, -creepage.spin}}, state, workspace);
        const double difference = std::hypot(outer.force.longitudinal - mirrored.force.longitudinal,
                                             outer.force.lateral + mirrored.force.lateral);
        const double taken = outer.force.longitudinal * creepage.longitudinal + outer.force.lateral * creepage.lateral +
                             outer.force.moment * creepage.spin;
        right = right && outer.status == Status::ok && share <= 1 && difference < 1e-9 * mu * load && taken < 0;
    }
    return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
