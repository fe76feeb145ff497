#include <cmath>
#include <cstddef>
#include <stdexcept>

#include "profile.hpp"
#include "support/input.hpp"

namespace profile {

namespace {

constexpr const char* help =
    R"(Example: contact points over the lateral shift, as every vehicle engineer draws them
  profile_study --shift -0.004,-0.002,0,0.002,0.004,0.006 --side both --output contacts.csv --plot contacts.svg

Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. Positions are
--shift, --yaw and a roll; height, the wheelset's, and without --roll the roll follow from the loads. A row for each
position, wheel and patch, patches by decreasing load: x, y, z of the reference point, on the rail; rail_y and wheel_y
of it in the profiles of right wheel and right rail (of a left wheel in their mirror images); angle of the patch's
plane, in which s lies along y turned by it, and n points into the rail; normal force load; approach, from where the
undeformed surfaces would touch; half_length along x and half_width along s, half the extents; iterations of the last
solution for pressures; time_us of the whole position [microseconds], once. Lengths in m, angles in rad, forces in N,
pressures in Pa, all of them SI. status: ok; doubtful_plane, surfaces turn by more than 0.2 rad over the patch;
unbalanced, normal forces and friction did not come to carry the loads to 1e-6; and without numbers: no_contact, end_of_profile, undefined_section, load_not_reached, not_converged, few_cells, not_finite.
--friction: longitudinal_creepage, lateral_creepage and spin [1/m] are numbers as CONTACT's CKSI, CETA and CPHI, those
of the rail on the wheel, over the size of the mean of V and the circumferential speed -pitch_rate rolling_radius: a
wheel driven forward has a positive longitudinal creepage. longitudinal_force, lateral_force (along s) and spin_moment,
about n at the reference point, act on the wheel (CONTACT's FX, FS, MN on the rail are minus these). Slip is that of the three creepages, or of the curved surfaces with
--slip curved. slip_power [W] is what friction turns into heat, minus the power of
forces and moment on the creepages; t_gamma [N] that power per metre rolled, for wear; fatigue_index the force of
friction over the normal force, less --shear-yield over the peak pressure (surface fatigue where positive); elements
those of each patch. --wear FILE has, for right rail and right wheel (of left ones in their mirror images) of each side,
s, the length along the profile, y, z, and work [J/m^2]: frictional work per metre rolled and metre of profile, the mean
over all positions. The loads are vertical: the normal forces are found
together with those of friction. Status may then be that of friction, with the forces empty; invalid_step: the wheel
does not roll, as that mean is 0.
--outline writes files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P and patch K, e.g. for
  patch_study --n 12 --outline DIR/1_right_1.outline.csv --pressure DIR/1_right_1.pressure.csv --longitudinal 0.1
--positions: a row for each position. --smooth is for worn or measured profiles: the smoothest curve that leaves the
points by that root mean square, in y and z together, which should be the noise of the device: with less, patches break
up (few_cells).
)";

}  // namespace

void add_options(study::Options& options) {
    options.refuse_group("Discretisation", "patches have strips along x, with the cosine mesh and rows between nodes",
                         {"n"});
    options.set_default("n", "12");
    options.set_help("n", "with --friction: elements of each strip, 1 to 100 (dimensionless)");
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is as wide as profiles and load make it");
    options.set_help("poisson", "Poisson's ratio of wheel and rail, 0 to 0.5 (dimensionless)");
    options.add("shear-modulus", "G", "shear modulus of wheel and rail [Pa]", "8.2e10");
    add_profile_options(options);
    options.group("Track and wheelset");
    options.add("radius", "R", "of the wheel's tape circle [m]", "0.46");
    options.add("gauge", "X", "between the rails [m]", "1.435");
    options.add("gauge-depth", "X", "below their tops, where the gauge is measured [m]", "0.014");
    options.add("flange-back", "X", "between the backs of the flanges [m]", "1.36");
    options.add("tape-offset", "X", "of the tape circle from the flange's back [m]", "0.07");
    options.add("side", "NAME", "left, right or both", "right");
    options.add("shift", "LIST", "lateral shifts of the wheelset to the right, -0.1 to 0.1 [m]", "0");
    options.add("yaw", "LIST", "yaw angles, clockwise from above, -0.3 to 0.3 [rad]", "0");
    options.add_input("positions", "instead: CSV with the columns shift,yaw and, if given, roll and pitch_rate");
    options.not_with({"shift", "yaw"}, "positions");
    options.add("roll", "X", "roll angle, -0.3 to 0.3 [rad]; default: that in which both wheels carry the load");
    options.add("load", "N", "vertical load on each wheel [N]", "1e5");
    options.add("cells", "NX,NS", "across what touches, 10 to 1000 each, more where it has lobes (dimensionless)",
                "40,20");
    options.group("Friction");
    options.add("friction", "MU", "coefficient of friction: adds creepages and forces (dimensionless)");
    options.add("speed", "V", "with --friction: of the wheelset, negative when rolling backwards [m/s]", "1");
    options.add("pitch-rate", "LIST",
                "with --friction: about the axle, negative when rolling forward [rad/s]; default: that in which the "
                "longitudinal creepages of the wheels that touch add up to 0");
    options.add("strips", "M",
                "with --friction: strips of a patch, 1 to 100; fewer where rolling would gain energy (dimensionless)",
                "13");
    options.add(
        "slip", "NAME",
        "with --friction: curved, of both surfaces in each row of cells, or linear, of three creepages alone, as "
        "CONTACT has it",
        "linear");
    options.add("shear-yield", "K", "with --friction: yield stress in shear, for the fatigue index [Pa]", "3e8");
    options.group("Result");
    options.add_folder("outline", "also write outlines and pressures of all patches into this folder, for patch_study");
    options.add_output("wear", "with --friction: also write frictional work over both profiles to this CSV file");
    options.footer(help);
    options.set_conventions(
        "axes = \"track axes: x forward, y to the right, z down; patches: x, s along y turned by the angle, n into the "
        "rail\"\n"
        "signs = \"creepages are CONTACT's CKSI, CETA, CPHI; forces and moment act on the wheel\"\n"
        "units = \"m, rad, s, N, Pa, W; columns ending in _us in microseconds\"\n"
        "cells = \"the shortest text that is read back exactly; an undefined value is an empty cell\"\n");
}

std::vector<Case> read_cases(const study::Options& options) {
    const study::Rule turn = study::between(-0.3, 0.3), sideways = study::between(-0.1, 0.1);
    std::optional<double> roll;
    if (options.given("roll")) roll = options.number("roll", turn);
    std::vector<std::optional<double>> rates{std::nullopt};
    if (options.given("pitch-rate")) {
        rates.clear();
        for (const double rate : options.numbers("pitch-rate", study::finite())) rates.emplace_back(rate);
    }
    std::vector<Case> cases;
    if (options.given("positions")) {
        const auto check = [&](const std::vector<study::Numbers>& columns, const std::string& where) {
            for (const auto& [k, name] : {std::pair<std::size_t, const char*>{0, "shift"}, {1, "yaw"}, {2, "roll"}}) {
                const study::Rule& rule = k == 0 ? sideways : turn;
                if (columns[k].empty() || rule.holds(columns[k].back())) continue;
                throw study::BadInput(where + ": " + name + " must " + rule.text);
            }
        };
        const std::vector<study::Numbers> columns =
            study::read_columns(options, "positions", "shift,yaw", "roll;pitch_rate", check);
        options.require(!columns[0].empty(), "positions", "have a row below its header");
        if (!columns[2].empty()) options.ignored("roll", "with a column roll in --positions");
        if (!columns[3].empty()) options.ignored("pitch-rate", "with a column pitch_rate in --positions");
        for (std::size_t i = 0; i < columns[0].size(); ++i) {
            for (const std::optional<double>& rate : rates) {
                cases.push_back({columns[0][i], columns[1][i], columns[2].empty() ? roll : columns[2][i],
                                 columns[3].empty() ? rate : columns[3][i]});
            }
        }
        return cases;
    }
    for (const double shift : options.numbers("shift", sideways)) {
        for (const double yaw : options.numbers("yaw", turn)) {
            for (const std::optional<double>& rate : rates) cases.push_back({shift, yaw, roll, rate});
        }
    }
    return cases;
}

Settings read_settings(const study::Options& options) {
    const auto positive = [&](const char* name) { return options.number(name, study::positive()); };
    const rollbem::TrackDimensions track{.gauge = positive("gauge"),
                                         .gauge_depth = positive("gauge-depth"),
                                         .flange_back = positive("flange-back"),
                                         .tape_offset = options.number("tape-offset", study::finite()),
                                         .radius = positive("radius"),
                                         .shear_modulus = positive("shear-modulus"),
                                         .poisson_ratio = options.number("poisson", study::between(0, 0.5))};
    const auto cells = options.pair("cells");
    const auto fits = [](double count) { return count >= 10 && count <= 1000 && count == std::floor(count); };
    options.require(cells && fits(cells->first) && fits(cells->second), "cells",
                    "be two integers from 10 to 1000 with a comma between them");
    const std::string side = options.choice("side", {"left", "right", "both"});
    std::vector<Side> sides;
    if (side != "right") sides.push_back(Side::left);
    if (side != "left") sides.push_back(Side::right);
    std::optional<rollbem::RollingFriction> friction;
    if (options.given("friction")) {
        friction = {positive("friction"), Eigen::Index(options.integer("n", 1, 100)),
                    Eigen::Index(options.integer("strips", 1, 100)),
                    options.choice("slip", {"curved", "linear"}) == "curved"};
    } else {
        for (const char* name : {"speed", "pitch-rate", "n", "strips", "slip", "shear-yield", "wear"})
            options.ignored(name, "without --friction");
    }
    const double load = positive("load"), speed = options.number("speed", study::finite());
    options.require(speed != 0, "speed", "differ from 0: creepage is slip over the velocity of rolling");
    const rollbem::Profile wheel = read_wheel(options), rail = read_rail(options);
    try {
        return {rollbem::WheelsetOnTrack(rollbem::WheelOnRail(wheel, rail, track)),
                sides,
                load,
                {.cells_x = Eigen::Index(cells->first), .cells_s = Eigen::Index(cells->second)},
                friction,
                speed,
                positive("shear-yield")};
    } catch (const std::invalid_argument& error) {
        throw study::BadInput(options.said("rail") + ": " + error.what());
    }
}

}  // namespace profile
