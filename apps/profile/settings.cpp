#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "profile.hpp"
#include "support/input.hpp"

namespace profile {

namespace {

constexpr const char* help =
    R"(Example: contact points over the lateral shift, as every vehicle engineer draws them
  profile_study --shift -0.004,-0.002,0,0.002,0.004,0.006 --side both --output contacts.csv --plot contacts.svg

Track axes: x forward, y to the right, z down, the origin between the rails at the height of their tops. Positions are
--shift, --yaw, a roll, and where surfaces change along the way --x and --pitch; the wheelset's height, and without
--roll the roll, follow from the loads, or --height is given. A row for each position, wheel and patch, patches by
decreasing load: x, y, z of the reference point, on the rail, seen from the wheelset; rail_y and wheel_y of it in the
profiles of right wheel and canted right rail (of a left wheel in their mirror images); angle of the patch's
plane, in which s lies along y turned by it, and n points into the rail; load, the pressures over the plane, which act
along the normals of the rail's surface, so that --load is N cos angle only nearly; approach, the largest depth
of the undeformed surfaces in one another along n; half_length along x and half_width along s, half the extents;
iterations of the last solution for pressures; time_us of the whole position [microseconds], once; track_x and pitch are
the position's. Lengths in m, angles in rad, forces in N, pressures in Pa, all of them SI.

status, and what to do:
  ok
  doubtful_plane      surfaces turn by more than 0.2 rad over the patch: a plane errs by 1 to 2 % in pressures
  unbalanced          normal forces and friction did not come to carry the loads to 1e-6, or the wheel does not roll:
                      take another --pitch-rate, --speed or --shift
and without numbers:
  no_contact          wheel and rail do not touch: look at --shift, --roll, --height, --gauge or --rail-origin
  end_of_profile      contact reaches the end of a profile, which is not known beyond: take a longer one
  undefined_section   the wheel has no section there: take a smaller --yaw
  too_deep            the wheel lies more than 1 mm within the rail: a smaller --height or --load, or another place or
                      unit of a profile is meant
  load_not_reached    no height carries the load: another --load; with friction, which may hold the wheel up, --roll
  not_converged       pressures did not settle: other --cells, or --smooth for measured profiles
  few_cells           fewer than 7 cells touch: finer --cells, or --smooth for measured profiles
  not_finite          a number overflowed: look at the units
With --friction further ones, with the forces empty:
  invalid_step        the wheel does not roll, as V and -pitch_rate rolling_radius add up to 0: another --pitch-rate
  assists_creepage    rolling gains energy on these elements: other --strips or --n
  no_solution         tractions were not found to rounding: other --strips or --n; or friction cannot have --force

Profiles: files are cleaned of repeated points, zig-zags and folds at their ends; MiniProf's z is turned where the shape
says that it points up; what was done stands in the sidecar. A wheel must have its flange at y < 0, |z| < 2 mm on the
tape circle and a width of 90 to 180 mm, a rail its top within 10 mm of z = 0 and a width of 30 to 200 mm: else a line
names the remedy. --any-shape is for pieces, planes and rollers. The rail is placed by --gauge, its narrowest place down
to --gauge-depth below the top, or by --rail-origin, about which it is canted. --smooth is for measured profiles;
corners stay, and with less than the noise has, patches break up (few_cells).
  profile_study --wheel worn.whl --tape-offset 0 --rail worn.ban --rail-mirror y --cant 0 --smooth 0.007 --load 8e4
  profile_study --rail nose.slcs --length-unit mm --any-shape --rail-origin 0.75,0 --cant 0 --x 0,0.05,0.1 --roll 0

--friction: longitudinal_creepage, lateral_creepage and spin [1/m] are numbers as CONTACT's CKSI, CETA and CPHI, those
of the rail on the wheel, over the size of the mean of V and the circumferential speed -pitch_rate rolling_radius: a
wheel driven forward has a positive longitudinal creepage. longitudinal_force, lateral_force (along s) and spin_moment,
about n at the reference point, act on the wheel (CONTACT's FX, FS, MN on the rail are minus these). Slip is that of the
three creepages, or of the curved surfaces with --slip curved. slip_power [W] is what friction turns into heat; t_gamma
[N], for wear, minus the power of forces and moment on the creepages per metre rolled: the same on ever finer meshes, a
few per cent off on coarse ones, and not where next to nothing slips. fatigue_index is the force of friction over the
normal force, less --shear-yield over the peak pressure (surface fatigue where positive); elements are those of each
patch. With --temperature peak_temperature [K above ambient] is the largest flash temperature of a patch, by half of
the heat in each body; it is empty where the contact passes slowly, V half_length < 10 conductivity/heat capacity, or
creeps by more than 20 %, and with --hot-friction there is then no result (not_converged). In a FILE of --friction, mu
is linear over the angle of the rail's surface [rad] or y of its profile [m], as on the right rail, whose gauge corner
has negative angles, and constant beyond the rows. With --stress max_von_mises, max_tresca [Pa] are the largest
stresses in the rail below a patch and their depths [m]; max_tresca is a shear stress; shakedown_load is the peak
pressure over --shear-yield, shakedown_traction the force of friction over the normal force. Its FILE has, for each
strip of a patch (position counts rows of positions from 1), s, x, depth, von_mises and tresca where von Mises' stress
is largest. --wear FILE has, for right rail and right wheel (of left ones in their mirror images) of
each side, s, the length along the profile, y, z, and work [J/m^2]: frictional work per metre rolled and metre of
profile, the mean over all positions. --load-of normal: normal forces carry --load; all: they are found together with
the vertical share of friction. --force: the pitch rate is found at which friction has this longitudinal force on the
wheelset, positive along x; no_solution where none has, up to 20 % of creepage. --layer: a third body or roughness.
--conicity: a row for each amplitude, half of y_max - y_min, between which the wheelset's middle moves: tan_gamma of the
cone with the same wavelength, by integration of the wave; tan_gamma_linear by harmonic linearisation; the note
nonlinearity in the sidecar. status is ok, beyond_clearance (the wave leaves what both wheels reach without climbing
over a flange or an end of a profile) or unstable (Delta r falls: no wave passes the equilibrium), or why the wheelset
has no contact in the middle. With --rolling-radii delta_r is right_radius less left_radius; cells beyond the clearance
are empty.
  profile_study --conicity --wheel worn.whl --tape-offset 0 --rail worn.ban --cant 0 --plot conicity.svg
--virtual-penetration: rows for each shift of the right wheel, the height being that where 80 x 40 cells carry --load:
load, area and largest pressure by virtual penetration (share 0.55 of the approach) and by cells, and their relative
errors beside 80 x 40 cells; time_us is for all of it from the profiles. Where a contact has lobes it has more cells, so
that rows of two methods may be alike. load is the sum of normal forces.
--outline writes files P_SIDE_K.outline.csv and P_SIDE_K.pressure.csv of position P and patch K, e.g. for
  patch_study --n 12 --outline DIR/1_right_1.outline.csv --pressure DIR/1_right_1.pressure.csv --longitudinal 0.1
)";

const study::Rule turn = study::between(-0.3, 0.3), sideways = study::between(-0.1, 0.1);

/// Positions of the wheelset, loads, and how its contacts are solved.
void add_position_options(study::Options& options) {
    options.add("side", "NAME", "left, right or both", "right");
    options.add("shift", "LIST", "lateral shifts of the wheelset to the right, -0.1 to 0.1 [m]", "0");
    options.add("yaw", "LIST", "yaw angles, clockwise from above, -0.3 to 0.3 [rad]", "0");
    options.add_input("positions", "instead: CSV with the columns shift,yaw and, if given, roll and pitch_rate");
    options.not_with({"shift", "yaw"}, "positions");
    options.add("roll", "X", "roll angle, -0.3 to 0.3 [rad]; default: that in which both wheels carry the load");
    options.add("x", "LIST", "of the wheelset along the track, for rails with sections [m]");
    options.add("pitch", "LIST", "angles by which wheels with sections are turned, -pi to pi [rad]");
    options.add("load", "N", "vertical load on each wheel [N]", "1e5");
    options.add("height", "LIST",
                "instead of the load: z_ws of the wheelset, down [m]; 0 where the tape circle touches z = 0 of the "
                "track; without --roll the roll is 0");
    options.not_with({"load"}, "height");
    options.add("interaction", "NAME", "on: patches of a wheel displace each other; off: as in CONTACT", "on");
    options.add("cells", "NX,NS", "across what touches, 10 to 1000 each, more where it has lobes (dimensionless)",
                "40,20");
}

void add_friction_options(study::Options& options) {
    options.group("Friction");
    options.add("friction", "MU|FILE",
                "coefficient of friction: adds creepages and forces (dimensionless); or CSV with the columns angle,mu "
                "or y,mu of the rail's surface");
    options.add("speed", "V", "with --friction: of the wheelset, negative when rolling backwards [m/s]", "1");
    options.add("pitch-rate", "LIST",
                "with --friction: about the axle, negative when rolling forward [rad/s]; default: that in which the "
                "longitudinal creepages of the wheels that touch add up to 0");
    options.add("force", "F",
                "with --friction: longitudinal force of friction on the wheelset, in place of the pitch rate [N]");
    options.not_with({"pitch-rate"}, "force");
    options.add("layer", "L", "with --friction: compliance of a layer between wheel and rail [m/Pa]", "0");
    options.add("load-of", "NAME",
                "with --friction: normal, normal forces alone carry --load, or all, with friction's vertical share",
                "normal");
    options.not_with({"load-of"}, "height");
    options.add(
        "strips", "M",
        "with --friction: strips of a patch, 1 to 100; fewer where rolling would gain energy; default: 13, up to "
        "25 where a patch has lobes (dimensionless)");
    options.add(
        "slip", "NAME",
        "with --friction: curved, of both surfaces in each row of cells, or linear, of three creepages alone, as "
        "CONTACT has it",
        "linear");
    options.add("shear-yield", "K", "with --friction: yield stress in shear, for the fatigue index [Pa]", "3e8");
    options.add_flag("temperature", "with --friction: add the peak flash temperature of each patch, peak_temperature");
    options.add("conductivity", "K", "of wheel and rail [W/(m K)]", "50").only_with({"temperature"});
    options.add("heat-capacity", "RHO_C", "of their volume [J/(m^3 K)]", "3.53e6").only_with({"temperature"});
    options
        .add("hot-friction", "MU_1,T_0,T_1",
             "friction goes linearly from its value at T_0 to MU_1 at T_1 above ambient [K]")
        .only_with({"temperature"});
}

/// From a file of angle,mu or y,mu. Throws BadInput.
rollbem::RailFriction read_rail_friction(const study::Options& options) {
    using Over = rollbem::RailFriction::Over;
    const std::vector<study::Numbers> columns = study::read_columns(options, "friction", "mu", "angle;y");
    const study::Numbers &mu = columns[0], &angle = columns[1], &y = columns[2];
    options.require(angle.empty() != y.empty(), "friction", "have a row, and either a column angle [rad] or y [m]");
    return study::blame(options.said("friction"), [&] {
        return rollbem::RailFriction(y.empty() ? Over::angle : Over::y, y.empty() ? angle : y, mu);
    });
}

/// Throws BadInput.
std::optional<rollbem::Heating> read_heating(const study::Options& options) {
    if (!options.flag("temperature")) return {};
    rollbem::Heating heating{options.number("conductivity", study::positive()),
                             options.number("heat-capacity", study::positive())};
    if (!options.given("hot-friction")) return heating;
    const std::vector<double> hot = options.row("hot-friction", 3);
    options.require(hot.size() == 3 && hot[0] >= 0 && hot[1] >= 0 && hot[2] > hot[1], "hot-friction",
                    "be MU_1,T_0,T_1 with MU_1 >= 0 and 0 <= T_0 < T_1");
    heating.friction = {hot[0], hot[1], hot[2]};
    return heating;
}

/// Throws BadInput.
std::optional<rollbem::RollingFriction> read_friction(const study::Options& options) {
    if (!options.given("friction")) {
        for (const char* name : {"speed", "pitch-rate", "force", "layer", "load-of", "n", "strips", "slip",
                                 "shear-yield", "wear", "stress", "temperature"}) {
            options.ignored(name, "without --friction");
        }
        return {};
    }
    rollbem::RollingFriction friction{
        .elements = Eigen::Index(options.integer("n", 1, 100)),
        .strips = options.given("strips") ? Eigen::Index(options.integer("strips", 1, 100)) : 0,
        .curved_slip = options.choice("slip", {"curved", "linear"}) == "curved",
        .heating = read_heating(options),
        .layer = options.number("layer", study::not_negative())};
    if (study::detail::parse_number<double>(options.text("friction"))) {
        friction.coefficient = options.number("friction", study::positive());
    } else {
        friction.rail = read_rail_friction(options);
    }
    return friction;
}

}  // namespace

void add_options(study::Options& options) {
    options.refuse_group("Discretisation", "patches have strips along x, with the cosine mesh and rows between nodes",
                         {"n"});
    options.set_default("n", "12");
    options.set_help("n", "with --friction: elements of each strip, 1 to 100 (dimensionless)");
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is as wide as profiles and load make it");
    add_profile_options(options);
    add_track_options(options);
    add_position_options(options);
    add_friction_options(options);
    options.group("Result");
    options.add_folder("outline", "also write outlines and pressures of all patches into this folder, for patch_study");
    options.add_output("wear", "with --friction: also write frictional work over both profiles to this CSV file");
    options.add_output("stress", "with --friction: also write the largest stress below each strip to this CSV file");
    add_conicity_options(options);
    add_method_options(options);
    options.footer(help);
    options.set_conventions(
        "axes = track axes: x forward, y to the right, z down; patches: x, s along y turned by the angle, n into the "
        "rail\n"
        "signs = creepages are CONTACT's CKSI, CETA, CPHI; forces and moment act on the wheel\n"
        "units = m, rad, s, N, Pa, W; columns ending in _us in microseconds\n"
        "cells = the shortest text that is read back exactly; an undefined value is an empty cell\n");
}

namespace {

/// Shift, yaw and, by the file, roll and pitch rate.
std::vector<Case> read_positions(const study::Options& options) {
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
    for (const char* name : {"pitch-rate", "force"}) {
        if (!columns[3].empty()) options.ignored(name, "with a column pitch_rate in --positions");
    }
    const auto cell = [](const study::Numbers& column, std::size_t i) {
        return column.empty() ? std::nullopt : std::optional(column[i]);
    };
    std::vector<Case> cases;
    for (std::size_t i = 0; i < columns[0].size(); ++i) {
        cases.push_back({columns[0][i], columns[1][i], cell(columns[2], i), cell(columns[3], i)});
    }
    return cases;
}

}  // namespace

std::vector<Case> read_cases(const study::Options& options) {
    std::vector<Case> cases;
    if (options.given("positions")) {
        cases = read_positions(options);
    } else {
        for (const double shift : options.numbers("shift", sideways)) {
            for (const double yaw : options.numbers("yaw", turn)) cases.push_back({shift, yaw, {}, {}});
        }
    }
    // each case with each value of an option
    const auto sweep = [&](const char* name, const study::Rule& rule, const auto& set) {
        if (!options.given(name)) return;
        std::vector<Case> product;
        for (const Case& at : cases) {
            for (const double value : options.numbers(name, rule)) set(product.emplace_back(at), value);
        }
        cases = std::move(product);
    };
    if (options.given("roll")) {
        const double roll = options.number("roll", turn);
        for (Case& at : cases) at.roll = roll;
    }
    sweep("x", study::finite(), [](Case& at, double x) { at.along = x; });
    sweep("pitch", study::between(-std::numbers::pi, std::numbers::pi), [](Case& at, double p) { at.pitch = p; });
    sweep("height", study::finite(), [](Case& at, double height) {
        at.height = height;
        at.roll = at.roll.value_or(0);
    });
    sweep("pitch-rate", study::finite(), [](Case& at, double rate) { at.pitch_rate = rate; });
    return cases;
}

std::string case_columns(const study::Options& options) {
    return std::string("shift, yaw") + (options.given("x") ? ", track_x" : "") +
           (options.given("pitch") ? ", pitch" : "");
}

namespace {

/// Refuses what needs sections, and what needs that there are none.
void check_surfaces(const study::Options& options, const rollbem::WheelsetOnTrack& wheelset, bool several) {
    bool round = true, straight = true;
    for (const Side side : rollbem::WheelsetOnTrack::sides) {
        round = round && wheelset.wheel(side).geometry().wheel().is_round();
        straight = straight && !wheelset.wheel(side).geometry().rail().has_sections();
    }
    if (straight) options.ignored("x", "without sections along the track (--rail FILE.slcs)");
    if (round) options.ignored("pitch", "with round wheels (--wheel FILE.slcw has sections)");
    if (round && straight) return;
    const std::string reason = "with sections: it needs a round wheel on a rail of one profile";
    options.ignored("wear", reason);
    if (several) options.ignored("plot", reason + ", or a single position");
}

}  // namespace

Settings read_settings(const study::Options& options, bool several) {
    const auto positive = [&](const char* name) { return options.number(name, study::positive()); };
    const rollbem::TrackDimensions track = read_dimensions(options);
    const auto cells = options.pair("cells");
    const auto fits = [](double count) { return count >= 10 && count <= 1000 && count == std::floor(count); };
    options.require(cells && fits(cells->first) && fits(cells->second), "cells",
                    "be two integers from 10 to 1000 with a comma between them");
    const std::string side = options.choice("side", {"left", "right", "both"});
    std::vector<Side> sides;
    if (side != "right") sides.push_back(Side::left);
    if (side != "left") sides.push_back(Side::right);
    const std::optional<rollbem::RollingFriction> friction = read_friction(options);
    const double load = positive("load"), speed = options.number("speed", study::finite());
    options.require(speed != 0, "speed", "differ from 0: creepage is slip over the velocity of rolling");
    rollbem::WheelsetOnTrack wheelset = read_wheelset(options, track);
    check_surfaces(options, wheelset, several);
    return {std::move(wheelset),
            sides,
            load,
            {.cells_x = Eigen::Index(cells->first),
             .cells_s = Eigen::Index(cells->second),
             .interaction = options.choice("interaction", {"on", "off"}) == "on"},
            friction,
            speed,
            positive("shear-yield"),
            options.given("force") ? std::optional(options.number("force", study::finite())) : std::nullopt,
            options.choice("load-of", {"normal", "all"}) == "all",
            options.given("stress")};
}

}  // namespace profile
