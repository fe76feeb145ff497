// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in the time
// domain from rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include "friction/law.hpp"
#include "friction/steady.hpp"
#include "support/options.hpp"
#include "support/runs.hpp"

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
)" + friction::creep_help() +
           R"(
--pressure: p0 = 2 N/(pi a) is the peak of Hertz's pressure of the same load, and exact is empty.
--fit-border, for pressures that leave one slip zone at the trailing edge, as Hertz's does: mesh is fitted, and the
force is exact to round-off, or to 1e-6 mu N under a --pressure without jumps, whatever n is, which sets the rows of
--tractions alone. rounds counts the borders tried. Elsewhere mesh is cosine, and n elements with alpha = 0.5 are used.
--lateral-ratio, --spin-ratio: the inner loops of the rows. exact and lateral_exact are Carter's, where Poisson's ratio is
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

/// What steady rolling and that in the time domain share: creepages, pressure, a layer and the law of friction.
void add_contact_options(study::Options& options) {
    options.set_default("mesh", "cosine");
    options.set_default("alpha-L", "0.5");
    options.set_default("alpha-T", "0.5");
    options.add("creepage-ratio", "LIST",
                "creepage ratio delta = xi G/(2 (1-nu) mu p0) [dimensionless], any finite: Carter's contact slides as "
                "a whole from 1 on; with --transient one value, constant, and none by default",
                "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1");
    options.add("force", "F",
                "given force -F_x/(mu N), in time -F_x/(mu N_0) [dimensionless], any finite, in place of "
                "--creepage-ratio, which is found; in time a shift from rest reaches it before the contact rolls");
    options.not_with({"creepage-ratio"}, "force");
    options.add_input("pressure",
                      "CSV file of the normal pressure, with the columns x_over_a [dimensionless], pressure [any "
                      "unit]: linear between its rows, zero before the first and after the last; two rows at one "
                      "x_over_a make a jump; Hertz's pressure without it");
    options.add("lateral-ratio", "LIST",
                "lateral creepage ratio eta G/(2 (1-nu) mu p0) [dimensionless], any finite, for friction in both "
                "directions; with --transient one value, constant; friction along x alone without it");
    options
        .add("spin-ratio", "LIST",
             "spin ratio phi a G/(2 (1-nu) mu p0) [dimensionless] of a rigid lateral slip phi x, any finite; with "
             "--transient one value, constant; no spin without it")
        .only_with({"lateral-ratio"});
    options.add("layer", "L", "compliance of an elastic layer between the bodies [a/G], 0 or more", "0");
    friction::add_law_options(options);
}

/// What steady rolling alone has: sweeps, tractions and the exact border of stick.
void add_steady_options(study::Options& options) {
    options
        .add("sweep", "up|down",
             "order of the creepage ratios in which each solution starts from the one before, separately for each "
             "lateral ratio and spin; each starts from rest without it")
        .only_with(friction::law_options())
        .not_with("transient");
    options
        .add_table("tractions",
                   "CSV file of the tractions, one row per element of every scheme and creepage, with FILE.toml beside "
                   "it; none without it")
        .not_with("transient");
    options
        .add_flag("fit-border", "exact border between slip and stick, by series; n elements are used where that fails")
        .not_with("transient");
    for (const std::string& law : friction::law_options()) {
        options.not_with({"fit-border"}, law, ", which is solved by elements");
    }
    options.not_with({"mesh", "edges", "method", "derivative", "alpha-L", "alpha-T", "alpha"}, "fit-border",
                     ", which needs no elements");
    options.not_with({"sweep", "fit-border"}, "force");
    options.not_with({"lateral-ratio", "spin-ratio", "layer"}, "fit-border",
                     ", which is for one direction and no layer");
}

void add_rolling_options(study::Options& options) {
    options.add_flag("transient", "rolling in time, one row per step, in place of steady rolling");
    study::add_history_options(options, friction::history_columns, "transient");
    options.not_with({"step", "ramp", "sine"}, "force");
    options.add("shift", "W", "rigid shift [mu p0 a/G] before the contact rolls, any finite; none without it")
        .only_with({"transient"});
    study::add_run_options(options, "",
                           "mesh that follows the half-length of the contact, with --kernel plane; without it the mesh "
                           "covers the largest contact");
    options.not_with({"from"}, "shift", ", which starts from rest");
    options.only_with({"lambda"}, {"transient"}, ": a steady problem builds no G, the only matrix lambda acts on");
    for (const char* way : {"step", "ramp", "sine"}) options.not_with({"creepage-ratio"}, way);
    options
        .add_flag(
            "unchecked",
            "no check of the schemes: those that are unstable, may be unstable or do not converge are stepped, too")
        .only_with({"transient"});
}

}  // namespace

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("friction_study",
                           "Rolling with Coulomb friction: steady, against Carter's creep curve, or in time.");
    add_contact_options(options);
    add_steady_options(options);
    add_rolling_options(options);
    study::offer_schemes(options, friction::methods);
    options.footer(help());

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. Rows, tractions and pictures: friction/steady.cpp, friction/transient.cpp.
        (given.flag("transient") ? friction::run_transient : friction::run_steady)(given);
        return study::exit_ok;
    });
}
