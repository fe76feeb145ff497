// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in the time
// domain from rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include "friction/steady.hpp"
#include "support/options.hpp"
#include "support/table.hpp"

namespace {

std::string help() {
    return R"(Examples
  the creep curve, with the tractions drawn under their bound; exact to rounding; in both directions; with spin
    friction_study --n 20,40 --output curve.csv --tractions tractions.csv --plot curve.svg
    friction_study --n 40 --creepage-ratio 0.2,0.5,0.8 --fit-border --kernel plane
    friction_study --n 40 --creepage-ratio 0,0.2,0.4,0.6,0.8,1 --lateral-ratio 0,0.3,0.6 --plot both.svg
    friction_study --n 40 --method nodes --nodes chebyshev --creepage-ratio 0.3 --lateral-ratio 0 --spin-ratio 0,1
  rolling from rest to the steady state, a hysteresis loop, and a load that varies on a mesh that breathes with it
    friction_study --transient --n 40 --creepage-ratio 0.5 --plot rest.svg
    friction_study --transient --n 40 --sine 1.5,0.5 --until 40 --plot loop.svg
    friction_study --transient --n 40 --creepage-ratio 0.5 --load-sine 0.5,8 --breathing --kernel plane \
        --from steady --until 24 --plot load.svg
  friction that falls by 40 % (mu_0 p0 = 150 MPa on steel at 45 m/s: 0.1 m/s, 2 um, 1 mm/s)
    friction_study --falling 0.6,1.23 --memory 0.276,0.0123 --plot falling.svg

Steady rolling, one row for each mesh, scheme and creepage, solved independently of the others:
)" + friction::curve_help() +
           R"(
--pressure: p0 = 2 N/(pi a) is the peak of Hertz's pressure of the same load, and exact is empty.
--fit-border, for pressures that leave one slip zone at the trailing edge, as Hertz's does: mesh is fitted, and the
force is exact to round-off, or to 1e-6 mu N under a --pressure without jumps, whatever n is, which sets the rows of
--tractions alone. rounds counts the borders tried. Elsewhere mesh is cosine, and n elements with alpha = 0.5 are used.
--lateral-ratio, --spin-ratio: inner loops of the rows. exact and lateral_exact are Carter's, where Poisson's ratio is
0 or the creepage has a single direction (across: with the ratio times 1 - nu).
--layer: an additional displacement L p, L = h_3/G_3 of a layer of thickness h_3 and shear modulus G_3. exact is empty.
--falling, --memory: mu_0 takes the place of mu in all units; the law is K + (1 - K) 2^(-v/VH), with --memory
d mu/dt = -(max(v, V0)/D) (mu - law(v)), mu_0 where a particle enters. exact is empty; where no solution is found to
round-off, status is no_solution, and complementarity_residual is the error of mu. Without memory, a steep law has
several steady solutions on a mesh: --sweep up and --sweep down then differ. --shift takes the time of one step. With
--falling a --history may have the column speed, the velocity of rolling over the V of these units.

--transient, one row for each step:
)" + friction::transient_help() +
           R"(creep_work = slip_work + jump_work + change of elastic_energy, which has the same unit, to the order of
the scheme in 1/n and of the integrator in dq. A scheme that is not certainly stable, or whose steady tractions assist
the creepage, is refused unless --unchecked is given; the check finds eigenvalues, in a time of order n^3. A step
without a solution is divided in halves, up to six times. If a step fails, the run has no more results, and the exit
code is 1. Under a load that varies, forces are over mu N_0 and distances over a_0, which belong to load_ratio 1. With
--breathing the mesh follows the contact (second order in 1/n); where it grows or shrinks as fast as it rolls, status
is needs_fixed_mesh and the run ends. Otherwise the mesh covers the largest contact (first order), and the load may
vanish. Steps are divided where the table of --load has a row. exact is empty.
)";
}

}  // namespace

int main(int argc, char** argv) {
    study::Options options("friction_study",
                           "Rolling with Coulomb friction: steady, against Carter's creep curve, or in time.");
    friction::add_options(options);
    options.footer(help());
    return study::run_program(options, argc, argv, [](const study::Options& given) {
        if (given.flag("transient")) {
            const friction::Scenario scenario = friction::read_scenario(given);
            study::write_table(given, friction::transient_table(scenario));
        } else {
            const friction::Curve curve = friction::read_curve(given);
            study::write_table(given, friction::curve_table(curve));
        }
        return study::exit_ok;
    });
}
