// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in time from
// rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include "friction/help.hpp"
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
    options.add("creepage-ratio", "LIST",
                "creepage as delta = xi G/(2 (1-nu) mu p0), any finite: Carter's contact slides as a whole for "
                "delta >= 1; with --transient a single value (dimensionless)",
                "0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9,1,1.1");
    options.add_input("pressure",
                      "CSV file with the columns x_over_a,pressure instead of Hertz's pressure: any unit, linear "
                      "between its rows, zero before the first and after the last; two rows at one x_over_a make a "
                      "jump (dimensionless)");
    options.add("lateral-ratio", "LIST",
                "lateral creepage by the same 2 (1-nu) mu p0/G, any finite: friction in both directions; with "
                "--transient a single value, constant (dimensionless)");
    options.add("spin-ratio", "LIST",
                "with --lateral-ratio: spin, a rigid lateral slip phi x, with phi a by the same 2 (1-nu) mu p0/G, any "
                "finite; with --transient a single value, constant (dimensionless)");
    options.add("layer", "L", "compliance of an elastic layer between the bodies, in a/G, 0 or more (dimensionless)",
                "0");
    options.add("falling", "K,VH",
                "friction that falls with slip from mu_0 to K mu_0, by half at a slip velocity VH in V mu_0 p0/G "
                "(dimensionless)");
    options.add("memory", "D,V0",
                "with --falling: mu is forgotten within a distance D of slip, in a mu_0 p0/G, at a velocity of at "
                "least V0, in V mu_0 p0/G (dimensionless)");
    options.add("sweep", "up|down",
                "with --falling: each point starts from its neighbour in the order of the creepage ratios, "
                "separately for each lateral one, not from rest");
    options.add_table("tractions",
                      "also write a CSV file with one row per element of every scheme and creepage, and FILE.toml");
    options.add_flag("fit-border",
                     "solve for the border between slip and stick exactly, by series; n elements are used where that "
                     "fails");
    options.add_flag("transient", "roll in time from rest, one row per step");
    options.add("sine", "AMP,OMEGA",
                "with --transient: creepage ratio AMP sin(OMEGA q/a), AMP finite and not 0, OMEGA in V/a above 0 "
                "(dimensionless)");
    options.replaces("creepage-ratio", {"sine"});
    options.add("shift", "W",
                "with --transient: rigid shift in mu p0 a/G first, any finite, without rolling (dimensionless)");
    options.add("load-sine", "A,LENGTH",
                "with --transient: load N = N_0 (1 + A sin(2 pi q/LENGTH)), |A| up to 1, LENGTH in a_0 above 0 "
                "(dimensionless)");
    options.add_input("load",
                      "with --transient: CSV file with the columns q_over_a,load_ratio: N/N_0 over the distance rolled "
                      "in a_0, linear between its rows, which must cover the run (dimensionless)");
    options.replaces("load-sine", {"load"});
    options.add_flag("breathing",
                     "with --load-sine or --load: the mesh follows the half-length of the contact, with --kernel "
                     "plane; otherwise it covers the largest contact");
    options.add("from", "rest|steady", "with --transient: the state that the run starts from", "rest");
    study::add_steps(options, "with --transient: ");
    options.add("integrator", "NAME", "with --transient: sdirk2 (second order) or implicit-euler (first)", "sdirk2");
    options.add_flag("unchecked",
                     "with --transient: step even a scheme that is, or may be, unstable, or that does not converge");
    options.footer(friction::help, friction::topics);

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. The pressure.
        const friction::Pressure pressure = friction::make_pressure(given);

        // 3. Rows, tractions and pictures: friction/steady.cpp, friction/transient.cpp.
        (given.flag("transient") ? friction::run_transient : friction::run_steady)(given, pressure);
        return study::exit_ok;
    });
}
