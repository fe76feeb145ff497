// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in time from
// rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include "friction/pressure.hpp"
#include "friction/steady.hpp"
#include "friction/transient.hpp"
#include "support/non_steady.hpp"
#include "support/options.hpp"
#include "support/program.hpp"

int main(int argc, char** argv) {
    // 1. The command line.
    study::Options options("friction_study",
                           "Rolling with Coulomb friction: steady, against Carter's creep curve, or in time.");
    options.set_default("mesh", "cosine");
    options.set_default("alpha-L", "0.5");
    options.set_default("alpha-T", "0.5");
    options.add(
        "creepage-ratio", "LIST",
        "creepage as delta = xi G/(2 (1-nu) mu p0), any finite: Carter's contact slides as a whole from 1 on; with "
        "--transient a single value (dimensionless)",
        "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1");
    options.add_input(
        "pressure",
        "CSV file with the columns x_over_a,pressure instead of Hertz's pressure: any unit, linear between its "
        "rows, zero before the first and after the last; two rows at one x_over_a make a jump (dimensionless)");
    options.add("lateral-ratio", "LIST",
                "lateral creepage by the same 2 (1-nu) mu p0/G, any finite: friction in both directions; with "
                "--transient a single "
                "value, constant (dimensionless)");
    options.add("layer", "L", "compliance of an elastic layer between the bodies, in a/G, 0 or more (dimensionless)",
                "0");
    options.add("falling", "K,VH",
                "friction that falls with slip from mu_0 to K mu_0, by half at a slip velocity VH in V mu_0 p0/G "
                "(dimensionless)");
    options.add("memory", "D,V0",
                "with --falling: mu is forgotten within a distance D of slip, in a mu_0 p0/G, at a velocity of no less "
                "than V0, in V mu_0 p0/G (dimensionless)");
    options.add(
        "sweep", "up|down",
        "with --falling: each point starts from its neighbour in the order of the creepage ratios, of each lateral one "
        "by itself, not from rest");
    options.add_table("tractions",
                      "besides, a CSV file with one row per element of every scheme and creepage, and FILE.toml");
    options.add_flag(
        "fit-border",
        "solve for the border between slip and stick exactly, by series; n elements take over where that fails");
    options.add_flag("transient", "roll in time from rest, one row per step");
    options.add(
        "sine", "AMP,OMEGA",
        "with --transient: creepage ratio AMP sin(OMEGA q/a), AMP finite, OMEGA in V/a above 0 (dimensionless)");
    options.add("shift", "W",
                "with --transient: rigid shift in mu p0 a/G first, any finite, without rolling (dimensionless)");
    options.add("load-sine", "A,LENGTH",
                "with --transient: load N = N_0 (1 + A sin(2 pi q/LENGTH)), |A| up to 1, LENGTH in a_0 above 0 "
                "(dimensionless)");
    options.add_input("load",
                      "with --transient: CSV file with the columns q_over_a,load_ratio, N/N_0 over the distance rolled "
                      "in a_0, linear between its rows, which cover the run (dimensionless)");
    options.add_flag(
        "breathing",
        "with --load-sine or --load: the mesh follows the half-length of the contact, with --kernel plane; "
        "else it covers the largest contact");
    options.add("from", "rest|steady", "with --transient: what the run starts from", "rest");
    study::add_steps(options, "with --transient: ");
    options.add("integrator", "NAME", "with --transient: sdirk2 (second order) or implicit-euler (first)", "sdirk2");
    options.add_flag("unchecked",
                     "with --transient: step even a scheme that is unstable, or may be, or does not converge");
    options.footer(
        "Examples\n"
        "  the creep curve, with the tractions drawn under their bound\n"
        "    friction_study --n 20,40 --output curve.csv --tractions tractions.csv --plot curve.svg\n"
        "  the same force to rounding\n"
        "    friction_study --n 40 --creepage-ratio 0.2,0.5,0.8 --fit-border --kernel plane\n"
        "  under a pressure of one's own\n"
        "    printf 'x_over_a,pressure\\n-1,0\\n0.3,1\\n1,0\\n' > pressure.csv\n"
        "    friction_study --n 40 --pressure pressure.csv\n"
        "  rolling from rest, and from a shift, to the steady state\n"
        "    friction_study --transient --n 40 --creepage-ratio 0.5 --plot rest.svg\n"
        "    friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --aspect 100 --kernel plane\n"
        "  a hysteresis loop\n"
        "    friction_study --transient --n 40 --sine 1.5,0.5 --until 40 --plot loop.svg\n"
        "  longitudinal and lateral creepage together\n"
        "    friction_study --n 40 --creepage-ratio 0,0.2,0.4,0.6,0.8,1 --lateral-ratio 0,0.3,0.6 --plot both.svg\n"
        "  friction that falls by 40 % (mu_0 p0 = 150 MPa on steel at 45 m/s: 0.1 m/s, 2 um, 1 mm/s), and in time\n"
        "    friction_study --falling 0.6,1.23 --memory 0.276,0.0123 --plot falling.svg\n"
        "    friction_study --transient --n 80 --creepage-ratio 0.767 --falling 0.6,1.23 --memory 0.276,0.0123 \\\n"
        "        --integrator implicit-euler --dq 0.0125 --until 24 --plot sawtooth.svg\n"
        "  under a load that varies by half, on a mesh that breathes with the contact\n"
        "    friction_study --transient --n 40 --creepage-ratio 0.5 --load-sine 0.5,8 --breathing --kernel plane \\\n"
        "        --from steady --until 24 --plot load.svg\n"
        "\n"
        "force_ratio is -F/(mu N). exact is Carter's (plane model b >> a, whatever the kernel) for steady rolling\n"
        "and Cattaneo's for a shift from rest (plane model of this b/a). With --pressure, p0 = 2 N/(pi a) is the\n"
        "peak of Hertz's pressure of the same load, and exact is empty.\n"
        "\n"
        "Steady: one row per mesh, scheme and creepage, each solved from scratch. stick_count: elements that\n"
        "stick; rounds: of the active set; pivots: of the fallback where the rounds did not settle;\n"
        "complementarity_residual: largest violation of |p| <= mu p_n (over mu p0) and of the slip's direction\n"
        "(over |xi|); time_us and assembly_us [microseconds]: medians of at least 5 runs of the solution and of\n"
        "G' before it; tangent_ratio: d force_ratio/d creepage_ratio; slip_work: per distance a rolled, in mu N\n"
        "mu p0 a/G, summed over the elements (of second order in 1/n). Where status is not ok, these two and\n"
        "force_ratio are empty; it is inconsistent where in full adhesion tractions of the same scheme push with the\n"
        "creepage, so that the scheme does not converge there: alpha at or below 0 (near 0 on coarse meshes), or\n"
        "above 1. (With friction alpha = 0 does, of first order, where several elements slip.)\n"
        "--tractions: traction and bound in mu p0, slip s/V in mu p0/G, stick 1 or 0; traction, stick and slip are\n"
        "empty where status is not ok. lateral_traction and lateral_slip: the same across the rolling direction.\n"
        "\n"
        "--lateral-ratio: both directions, coupled by friction alone; the inner loop of a list. force_ratio and\n"
        "lateral_force_ratio are -F_x/(mu N) and -F_y/(mu N), tangent_ratio and lateral_tangent_ratio their\n"
        "derivatives by the creepage ratio of the same direction. exact and lateral_exact: Carter's, along the\n"
        "creepage for a Poisson ratio of 0, and for a single direction (across, by the ratio times 1 - nu); else "
        "empty.\n"
        "--layer adds L p to the displacement, L = h_3/G_3 for a layer of thickness h_3; there is no exact force.\n"
        "\n"
        "--falling: mu_0 takes the place of mu in all units; the law is K + (1 - K) 2^(-v/VH). With --memory mu of a\n"
        "particle follows d mu/dt = -(max(v, V0)/D) (mu - law(v)) and is mu_0 where it enters. exact is empty. Where "
        "no\n"
        "solution is found to rounding, status is no_solution, and complementarity_residual tells what mu is off by.\n"
        "Without memory a steep law has several steady solutions on a mesh: --sweep up and --sweep down differ there,\n"
        "the less the finer the mesh, and --plot draws both (in one direction). rounds: of all solutions. "
        "--tractions:\n"
        "bound is that of mu_0, friction_ratio mu/mu_0. --shift takes the time of a step.\n"
        "\n"
        "--fit-border is for pressures that leave one slip zone at the trailing edge, as Hertz's does. Where that\n"
        "holds, mesh = fitted: the force is exact to rounding, or to 1e-6 mu N under a --pressure without jumps, and\n"
        "owes nothing to n, which only sets the places of --tractions: the centres of a cosine mesh, with the values\n"
        "there, and stick_count the number of those that stick. alpha_L and alpha_T are empty, rounds counts the\n"
        "borders tried, and complementarity_residual is the largest violation at points of its own. Where it does not\n"
        "hold (several zones, stick that ends before the leading edge) or the pressure jumps, mesh = cosine and n\n"
        "elements with alpha = 0.5 take over. slip_work = -F xi in either case.\n"
        "\n"
        "--load-sine, --load: force_ratio by mu N_0, distances by a_0, where N_0 and a_0 are those of load_ratio 1;\n"
        "half_length_ratio is a/a_0, Hertz's. --breathing: the mesh follows the contact, of second order in 1/n;\n"
        "status is needs_fixed_mesh where the contact grows or shrinks by as much as it rolls. Else the mesh covers\n"
        "the largest contact, of first order, and the load may vanish. Steps are divided where a table has a row.\n"
        "creep_work = -int F.xi dq from the forces at both ends of a step (at its end with implicit-euler), "
        "cumulative,\n"
        "in the unit of slip_work; what the two differ by is elastic energy. exact is empty.\n"
        "\n"
        "--transient: one row per step, from q = dq on; with --shift, a row at q = 0 before. shift: imposed in\n"
        "this row, in mu p0 a/G. slip_work: cumulative, in mu N mu p0 a/G. creepage is linear over a step (its\n"
        "end value with implicit-euler). rounds: of all solutions of a step, two with sdirk2.\n"
        "A scheme that is not certainly stable, or that steady rolling shows as inconsistent, is refused unless\n"
        "--unchecked is given: friction bounds its tractions, but they are wrong. Then status is unchecked where it\n"
        "would be ok. The check finds eigenvalues, in time of order n^3. Where OMEGA --dq > 1, fewer than six steps in "
        "a\n"
        "period of --sine, status is unresolved and the forces are empty.\n");

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. The pressure.
        const friction::Pressure pressure = friction::make_pressure(given);

        // 3. Rows, tractions and pictures: friction/steady.cpp, friction/transient.cpp.
        (given.flag("transient") ? friction::run_transient : friction::run_steady)(given, pressure);
        return study::exit_ok;
    });
}
