// What friction_study --help says below the options, and --help TOPIC.
#pragma once

#include <string>
#include <vector>

#include "steady.hpp"
#include "support/options.hpp"
#include "transient.hpp"

namespace friction {

inline constexpr const char* help = R"(Examples
  the creep curve, with the tractions drawn under their bound
    friction_study --n 20,40 --output curve.csv --tractions tractions.csv --plot curve.svg
  rolling from rest to the steady state, and a hysteresis loop
    friction_study --transient --n 40 --creepage-ratio 0.5 --plot rest.svg
    friction_study --transient --n 40 --sine 1.5,0.5 --until 40 --plot loop.svg

force_ratio is -F/(mu N). exact is Carter's force (plane model b >> a, whatever the kernel) in steady rolling
and Cattaneo's after a shift from rest (plane model of this b/a).
)";

inline std::vector<study::Topic> topics() {
    return {
        {"steady", "rows and columns of steady rolling, --tractions, --pressure",
         R"(friction_study --n 20,40 --output curve.csv --tractions tractions.csv --plot curve.svg

One row for each mesh, scheme and creepage, solved independently of the others.
)" + creep_help() +
             R"(
--tractions: traction and bound in mu p0, slip s/V in mu p0/G, stick 1 or 0; traction, stick and slip are empty
where status is not ok. lateral_traction and lateral_slip: the same across the rolling direction.

--pressure: p0 = 2 N/(pi a) is the peak of Hertz's pressure of the same load, and exact is empty.
    printf 'x_over_a,pressure\n-1,0\n0.3,1\n1,0\n' > pressure.csv
    friction_study --n 40 --pressure pressure.csv
)"},
        {"border", "--fit-border: the force to rounding",
         R"(friction_study --n 40 --creepage-ratio 0.2,0.5,0.8 --fit-border --kernel plane

For pressures that leave one slip zone at the trailing edge, as Hertz's does. Then mesh is fitted, and the force
is exact to round-off, or to 1e-6 mu N under a --pressure without jumps, whatever n is: n only sets where
--tractions has its rows, at the centres of a cosine mesh, with the values there; stick_count is the number of
those that stick. alpha_L and alpha_T are empty, rounds counts the borders tried, and complementarity_residual is
the largest violation at a separate set of points. With several slip zones, stick that ends before the leading
edge, or a pressure that jumps, mesh is cosine, and n elements with alpha = 0.5 are used instead. slip_work is
-F xi in either case.
)"},
        {"lateral", "--lateral-ratio: friction in both directions",
         R"(friction_study --n 40 --creepage-ratio 0,0.2,0.4,0.6,0.8,1 --lateral-ratio 0,0.3,0.6 --plot both.svg

Both directions are coupled by friction alone; --lateral-ratio is the inner loop of the lists. force_ratio and
lateral_force_ratio are -F_x/(mu N) and -F_y/(mu N), tangent_ratio and lateral_tangent_ratio their derivatives
with respect to the creepage ratio of the same direction. exact and lateral_exact are Carter's, where Poisson's
ratio is 0 or the creepage has a single direction (across: with the ratio times 1 - nu); otherwise empty.

--spin-ratio, the innermost loop, adds spin; moment_ratio is -M_z/(mu N a), about the middle of the contact:
    friction_study --n 40 --method nodes --nodes chebyshev --creepage-ratio 0.3 --lateral-ratio 0 \
        --spin-ratio 0,0.5,1
)"},
        {"layer", "--layer: an elastic layer between the bodies",
         R"(friction_study --mesh uniform --n 40,80,160 --layer 0.5 --creepage-ratio 0.25,1

--layer adds L p to the displacement, L = h_3/G_3 for a layer of thickness h_3 and shear modulus G_3. exact is
empty.
)"},
        {"falling", "--falling, --memory, --sweep: friction that falls with slip",
         R"(friction that falls by 40 % (mu_0 p0 = 150 MPa on steel at 45 m/s: 0.1 m/s, 2 um, 1 mm/s), and in time
    friction_study --falling 0.6,1.23 --memory 0.276,0.0123 --plot falling.svg
    friction_study --transient --n 80 --creepage-ratio 0.767 --falling 0.6,1.23 --memory 0.276,0.0123 \
        --integrator implicit-euler --dq 0.0125 --until 24 --plot sawtooth.svg

mu_0 takes the place of mu in all units; the law is K + (1 - K) 2^(-v/VH). With --memory, mu of a particle follows
d mu/dt = -(max(v, V0)/D) (mu - law(v)) and is mu_0 where the particle enters the contact. exact is empty. Where no
solution is found to round-off, status is no_solution, and complementarity_residual is the error of mu. Without
memory, a steep law has several steady solutions on a mesh: --sweep up and --sweep down then differ, the less the
finer the mesh, and --plot draws both (for one direction). rounds counts those of all solutions. --tractions: bound
is that of mu_0, friction_ratio is mu/mu_0. --shift takes the time of one step.
)"},
        {"transient", "--transient: rolling in time, from rest, a shift or steady rolling",
         R"(rolling from a shift to the steady state
    friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --aspect 100 --kernel plane

One row for each step:
)" + transient_help() +
             R"(creep_work = slip_work + jump_work + change of elastic_energy, which has the same unit, to the order of the scheme
in 1/n and of the integrator in dq.

A scheme that is not certainly stable, or whose steady tractions assist the creepage, is refused unless --unchecked is
given: friction bounds its tractions, but they are wrong. The check finds eigenvalues, in a time of order n^3. A step
without a solution is divided in halves, up to six times. If a step fails, the run has no more results, and the exit
code is 1.
)"},
        {"load", "--load-sine, --load, --breathing: a load that varies",
         R"(a load that varies by half, on a mesh that breathes with the contact
    friction_study --transient --n 40 --creepage-ratio 0.5 --load-sine 0.5,8 --breathing --kernel plane \
        --from steady --until 24 --plot load.svg

Forces are over mu N_0 and distances over a_0, where N_0 and a_0 belong to load_ratio 1; half_length_ratio is a/a_0,
Hertz's. With --breathing the mesh follows the contact (second order in 1/n); where it grows or shrinks as fast as
it rolls, status is needs_fixed_mesh and the run ends. Otherwise the mesh covers the largest contact (first order),
and the load may vanish. Steps are divided where the table of --load has a row. exact is empty.
)"}};
}

}  // namespace friction
