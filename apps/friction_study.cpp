// Rolling with Coulomb friction: the creep curve against Carter's, stick and slip along the contact, and in the time
// domain from rest or from a shift, under constant or sinusoidal creepage:
//
//     ./friction_study --n 20,40 --creepage-ratio 0.25,0.5,0.75,1 --plot curve.svg
//     ./friction_study --transient --n 40 --creepage-ratio 0.5 --shift 2 --until 10
#include "friction/help.hpp"
#include "friction/steady.hpp"
#include "support/options.hpp"
#include "support/runs.hpp"

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
    options
        .add("spin-ratio", "LIST",
             "spin, a rigid lateral slip phi x, with phi a by the same 2 (1-nu) mu p0/G, any "
             "finite; with --transient a single value, constant (dimensionless)")
        .only_with({"lateral-ratio"});
    options.add("layer", "L", "compliance of an elastic layer between the bodies, in a/G, 0 or more (dimensionless)",
                "0");
    options.add("falling", "K,VH",
                "friction that falls with slip from mu_0 to K mu_0, by half at a slip velocity VH in V mu_0 p0/G "
                "(dimensionless)");
    options
        .add("memory", "D,V0",
             "mu is forgotten within a distance D of slip, in a mu_0 p0/G, at a velocity of at "
             "least V0, in V mu_0 p0/G (dimensionless)")
        .only_with({"falling"});
    options
        .add("sweep", "up|down",
             "each point starts from its neighbour in the order of the creepage ratios, "
             "separately for each lateral one, not from rest")
        .only_with({"falling"})
        .not_with("transient");
    options
        .add_table("tractions",
                   "also write a CSV file with one row per element of every scheme and creepage, and FILE.toml")
        .not_with("transient");
    options
        .add_flag("fit-border",
                  "solve for the border between slip and stick exactly, by series; n elements are used where that "
                  "fails")
        .not_with("transient")
        .not_with("falling", ", which is solved by elements");
    options.not_with({"mesh", "edges", "method", "derivative", "alpha-L", "alpha-T", "alpha"}, "fit-border",
                     ", which needs no elements");
    options.not_with({"lateral-ratio", "spin-ratio", "layer"}, "fit-border",
                     ", which is for one direction and no layer");
    options.add_flag("transient", "roll in time from rest, one row per step");
    options
        .add("sine", "AMP,OMEGA",
             "creepage ratio AMP sin(OMEGA q/a), AMP finite and not 0, OMEGA in V/a above 0 "
             "(dimensionless)")
        .only_with({"transient"});
    options.add("shift", "W", "rigid shift in mu p0 a/G first, any finite, without rolling (dimensionless)")
        .only_with({"transient"});
    study::add_run_options(options,
                           ": N/N_0 over the distance rolled in a_0, linear between its rows, which must cover the run "
                           "(dimensionless)",
                           "the mesh follows the half-length of the contact, with --kernel plane; otherwise it covers "
                           "the largest contact");
    options.not_with({"from"}, "shift", ", which starts from rest");
    options.only_with({"lambda"}, {"transient"}, ": a steady problem builds no G, the only matrix lambda acts on");
    options.not_with({"creepage-ratio"}, "sine");
    options.add_flag("unchecked", "step even a scheme that is, or may be, unstable, or that does not converge")
        .only_with({"transient"});
    options.footer(friction::help());

    return study::run_program(options, argc, argv, [](const study::Options& given) {
        // 2. Rows, tractions and pictures: friction/steady.cpp, friction/transient.cpp.
        (given.flag("transient") ? friction::run_transient : friction::run_steady)(given);
        return study::exit_ok;
    });
}
