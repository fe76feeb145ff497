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

const study::Rule turn = study::between(-0.3, 0.3), sideways = study::between(-0.1, 0.1);

/// Positions of the wheelset, loads, and how its contacts are solved.
void add_position_options(study::Options& options) {
    options.add("side", "NAME", "wheels to study: left, right or both", "right");
    options.add("shift", "LIST", "lateral shift of the wheelset to the right [m], -0.1 to 0.1", "0");
    options.add("yaw", "LIST", "yaw angle of the wheelset, clockwise from above [rad], -0.3 to 0.3", "0");
    options.add_input("positions",
                      "CSV file of positions, with the columns shift [m], yaw [rad] and, if given, roll [rad], "
                      "pitch_rate [rad/s], x [m], pitch [rad], height [m], load [N], speed [m/s], friction "
                      "[dimensionless], each in place of its option; distance [m] rolled in a position, 0 or more, and "
                      "passages [dimensionless] of wheels over the rail make both wear");
    options.not_with({"shift", "yaw"}, "positions");
    options.add(
        "roll", "X",
        "roll angle of the wheelset [rad], -0.3 to 0.3; without it the one at which both wheels carry the load");
    options.add("x", "LIST", "position of the wheelset along the track [m], for rails with sections; 0 without it");
    options.add("pitch", "LIST", "pitch angle of wheels with sections [rad], -pi to pi; 0 without it");
    options.add("load", "N", "vertical load on each wheel [N], above 0", "1e5");
    options.add("height", "LIST",
                "height z_ws of the wheelset, positive downwards [m], in place of --load: 0 where the tape circle "
                "touches z = 0 of the track; the roll is then 0 unless --roll is given");
    options.not_with({"load"}, "height");
    options.add("interaction", "NAME",
                "displacement of one patch of a wheel by the pressures of another: on, or off as in CONTACT; patches "
                "of one region displace each other always",
                "on");
    options.add("cells", "NX,NS",
                "numbers of cells across the region that touches, along x and s [dimensionless], 10 to 1000 each; "
                "more where pressures have several maxima",
                "40,20");
}

/// Declares the options that need --friction.
void add_friction_options(study::Options& options) {
    options.group("Friction");
    options.add("friction", "MU|FILE",
                "coefficient of friction [dimensionless], 0 or more, or CSV file of it with the columns angle [rad],mu "
                "or y [m],mu over the rail's surface; adds creepages and forces; no friction without it");
    const std::vector<std::string> with_friction{"friction", "positions"};
    options.add("speed", "V", "velocity of the wheelset [m/s], not 0, negative when rolling backwards", "1")
        .only_with(with_friction);
    options
        .add("pitch-rate", "LIST",
             "angular velocity about the axle [rad/s], negative when rolling forward; without it the one at which the "
             "longitudinal creepages of the wheels that touch add up to 0")
        .only_with(with_friction);
    options
        .add("force", "F",
             "longitudinal force of friction on the wheelset [N], in place of the pitch rate, which is found")
        .only_with(with_friction);
    options.not_with({"pitch-rate"}, "force");
    options.add("layer", "L", "compliance of a layer between wheel and rail [m/Pa], 0 or more", "0")
        .only_with(with_friction);
    options
        .add("load-of", "NAME",
             "forces that carry --load: normal, as in CONTACT, or all, with the vertical share of friction, as in the "
             "library",
             "normal")
        .only_with(with_friction);
    options.not_with({"load-of"}, "height");
    options
        .add("strips", "M",
             "number of strips of a patch [dimensionless], 1 to 100; fewer where rolling would gain energy; default: "
             "13, up to 25 where pressures have several maxima")
        .only_with(with_friction);
    options
        .add("slip", "NAME",
             "rigid slip: curved, of both surfaces in each row of cells, or linear, of three creepages alone, as in "
             "CONTACT",
             "linear")
        .only_with(with_friction);
    options.add("shear-yield", "K", "yield stress in shear [Pa], above 0, for the fatigue index", "3e8")
        .only_with(with_friction);
    options.add_flag("temperature", "peak flash temperature of each patch, in the column peak_temperature")
        .only_with(with_friction);
    options.add("conductivity", "K", "thermal conductivity of wheel and rail [W/(m K)], above 0", "50")
        .only_with({"temperature"});
    options.add("heat-capacity", "RHO_C", "heat capacity of wheel and rail per volume [J/(m^3 K)], above 0", "3.53e6")
        .only_with({"temperature"});
    options
        .add("hot-friction", "MU_1,T_0,T_1",
             "friction of hot surfaces: linear from its value at T_0 to MU_1 [dimensionless] at T_1, T_0 and T_1 [K "
             "above ambient]; the same at all temperatures without it")
        .only_with({"temperature"});
}

/// The friction of a file of angle,mu or y,mu. Throws BadInput.
rollbem::RollingFriction::OnRail read_rail_friction(const study::Options& options) {
    using Over = rollbem::RollingFriction::OnRail::Over;
    const std::vector<study::Numbers> columns = study::read_columns(options, "friction", "mu", "angle;y");
    const study::Numbers &mu = columns[0], &angle = columns[1], &y = columns[2];
    options.require(angle.empty() || y.empty(), "friction", "have one of the columns angle [rad] and y [m], not both");
    options.require(!mu.empty() && angle.empty() != y.empty(), "friction",
                    "have a row, and a column angle [rad] or y [m]");
    return study::blame(options.said("friction"), [&] {
        return rollbem::RollingFriction::OnRail(y.empty() ? Over::angle : Over::y, y.empty() ? angle : y, mu);
    });
}

/// Throws BadInput.
std::optional<rollbem::RollingFriction::Heating> read_heating(const study::Options& options) {
    if (!options.flag("temperature")) return {};
    rollbem::RollingFriction::Heating heating{options.number("conductivity", study::positive()),
                                              options.number("heat-capacity", study::positive())};
    if (!options.given("hot-friction")) return heating;
    const std::vector<double> hot = options.row("hot-friction", 3);
    options.require(hot.size() == 3 && hot[0] >= 0 && hot[1] >= 0 && hot[2] > hot[1], "hot-friction",
                    "be MU_1,T_0,T_1 with MU_1 >= 0 and 0 <= T_0 < T_1");
    heating.friction = {hot[0], hot[1], hot[2]};
    return heating;
}

/// Throws BadInput.
std::optional<rollbem::RollingFriction> read_friction(const study::Options& options, bool by_positions) {
    if (!options.given("friction") && !by_positions) {
        for (const char* name : {"speed", "pitch-rate", "force", "layer", "load-of", "strips", "slip", "shear-yield",
                                 "temperature", "n", "wear", "stress"}) {
            options.ignored(name, "without --friction, or a column friction in --positions");
        }
        return {};
    }
    rollbem::RollingFriction friction{
        .elements = Eigen::Index(options.integer("n", 1, 100)),
        .strips = options.given("strips") ? Eigen::Index(options.integer("strips", 1, 100)) : 0,
        .curved_slip = options.choice("slip", {"curved", "linear"}) == "curved",
        .heating = read_heating(options),
        .layer = options.number("layer", study::not_negative())};
    if (by_positions) return friction;
    if (study::detail::parse_number<double>(options.text("friction"))) {
        friction.coefficient = options.number("friction", study::not_negative());
    } else {
        friction.rail = read_rail_friction(options);
    }
    return friction;
}

}  // namespace

void add_options(study::Options& options) {
    for (const char* mode : {"virtual-penetration", "conicity"}) {
        options.not_with({"side",        "yaw",    "positions", "roll",      "x",           "pitch",    "height",
                          "interaction", "cells",  "friction",  "speed",     "pitch-rate",  "force",    "layer",
                          "load-of",     "n",      "strips",    "slip",      "shear-yield", "outline",  "wear",
                          "temperature", "stress", "wear-law",  "wear-step", "worn-wheel",  "worn-rail"},
                         mode);
    }
    options.not_with({"left-wheel", "left-rail", "left-radius", "conicity"}, "virtual-penetration");
    options.refuse_group("Discretisation", "patches have strips along x, with the cosine mesh and rows between nodes",
                         {"n"});
    options.set_default("n", "12");
    options.set_help("n", "number of elements in each strip [dimensionless], 1 to 100");
    study::Options::Added{options, "n"}.only_with({"friction", "positions"});
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is as wide as profiles and load make it");
    add_profile_options(options);
    add_track_options(options);
    add_position_options(options);
    add_friction_options(options);
    options.group("Result");
    options.add_folder(
        "outline",
        "folder for CSV files of the outline and the pressures of each patch, for patch_study; none without it");
    options.add_output("wear", "CSV file of the frictional work over both profiles; none without it")
        .only_with({"friction", "positions"});
    options.add_output("stress", "CSV file of the largest stress below each strip; none without it")
        .only_with({"friction", "positions"});
    add_wear_options(options);
    add_conicity_options(options);
    add_method_options(options);
    options.set_conventions(
        "axes = track axes: x forward, y to the right, z down; patches: x, s along y turned by the angle, n into the "
        "rail\n"
        "signs = creepages are CONTACT's CKSI, CETA, CPHI; forces and moment act on the wheel\n"
        "units = m, rad, s, N, Pa, W; columns ending in _us in microseconds\n"
        "cells = the shortest text that is read back exactly; an undefined value is an empty cell\n");
}

namespace {

/// A column of --positions beside shift and yaw.
struct PositionColumn {
    std::string name;
    std::vector<std::string> options;  ///< that it replaces
    study::Rule rule;
    void (*set)(Case& at, double value);
};

const std::vector<PositionColumn>& position_columns() {
    const study::Rule not_0{[](double v) { return v != 0; }, "differ from 0: creepage is slip over the velocity"};
    static const std::vector<PositionColumn> all{
        {"roll", {"roll"}, turn, [](Case& at, double v) { at.roll = v; }},
        {"pitch_rate", {"pitch-rate", "force"}, study::finite(), [](Case& at, double v) { at.pitch_rate = v; }},
        {"x", {"x"}, study::finite(), [](Case& at, double v) { at.along = v; }},
        {"pitch",
         {"pitch"},
         study::between(-std::numbers::pi, std::numbers::pi),
         [](Case& at, double v) { at.pitch = v; }},
        {"height", {"height", "load", "load-of"}, study::finite(), [](Case& at, double v) { at.height = v; }},
        {"load", {"load", "height"}, study::positive(), [](Case& at, double v) { at.load = v; }},
        {"speed", {"speed"}, not_0, [](Case& at, double v) { at.speed = v; }},
        {"friction", {"friction"}, study::not_negative(), [](Case& at, double v) { at.friction = v; }},
        {"distance", {}, study::not_negative(), [](Case& at, double v) { at.distance = v; }},
        {"passages", {}, study::not_negative(), [](Case& at, double v) { at.passages = v; }}};
    return all;
}

/// The positions, and the columns that the file has.
struct Positions {
    std::vector<Case> cases{};
    std::vector<std::string> columns{};

    bool has(const std::string& column) const { return study::contains(columns, column); }
};

Positions read_positions(const study::Options& options) {
    std::string further;
    for (const PositionColumn& column : position_columns()) further += (further.empty() ? "" : ";") + column.name;
    const auto check = [&](const std::vector<study::Numbers>& columns, const std::string& where) {
        const auto require = [&](const std::string& name, const study::Numbers& column, const study::Rule& rule) {
            if (column.empty() || rule.holds(column.back())) return;
            throw study::BadInput(where + ": " + name + " must " + rule.text);
        };
        require("shift", columns[0], sideways);
        require("yaw", columns[1], turn);
        for (std::size_t k = 0; k < position_columns().size(); ++k) {
            require(position_columns()[k].name, columns[k + 2], position_columns()[k].rule);
        }
    };
    const std::vector<study::Numbers> numbers = study::read_columns(options, "positions", "shift,yaw", further, check);
    options.require(!numbers[0].empty(), "positions", "have a row below its header");
    Positions read;
    for (std::size_t i = 0; i < numbers[0].size(); ++i) read.cases.push_back({numbers[0][i], numbers[1][i], {}, {}});
    for (std::size_t k = 0; k < position_columns().size(); ++k) {
        const PositionColumn& column = position_columns()[k];
        if (numbers[k + 2].empty()) continue;
        read.columns.push_back(column.name);
        for (const std::string& name : column.options) {
            options.ignored(name, "with a column " + column.name + " in --positions");
        }
        for (std::size_t i = 0; i < read.cases.size(); ++i) column.set(read.cases[i], numbers[k + 2][i]);
    }
    options.require(!(read.has("load") && read.has("height")), "positions",
                    "have one of the columns load and height, not both");
    return read;
}

Positions read_cases(const study::Options& options) {
    Positions read;
    std::vector<Case>& cases = read.cases;
    if (options.given("positions")) {
        read = read_positions(options);
    } else {
        for (const double shift : options.numbers("shift", sideways)) {
            for (const double yaw : options.numbers("yaw", turn)) cases.push_back({shift, yaw, {}, {}});
        }
    }
    // the sweep combines each case with each value of an option
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
    sweep("height", study::finite(), [](Case& at, double height) { at.height = height; });
    for (Case& at : cases) {
        if (at.height) at.roll = at.roll.value_or(0);
    }
    sweep("pitch-rate", study::finite(), [](Case& at, double rate) { at.pitch_rate = rate; });
    return read;
}

/// Refuses what needs sections, and what needs that there are none.
void check_surfaces(const study::Options& options, const rollbem::WheelsetOnTrack& wheelset,
                    const Positions& positions) {
    bool round = true, straight = true;
    for (const Side side : rollbem::WheelsetOnTrack::sides) {
        round = round && wheelset.wheel(side).geometry().wheel().is_round();
        straight = straight && !wheelset.wheel(side).geometry().rail().has_sections();
    }
    const std::string no_sections = "without sections along the track (--rail FILE.slcs)",
                      no_flats = "with round wheels (--wheel FILE.slcw has sections)";
    if (straight) options.ignored("x", no_sections);
    if (round) options.ignored("pitch", no_flats);
    options.require(!straight || !positions.has("x"), "positions", "have no column x " + no_sections);
    options.require(!round || !positions.has("pitch"), "positions", "have no column pitch " + no_flats);
    if (round && straight) return;
    const std::string reason = "with sections: it needs a round wheel on a rail of one profile";
    options.ignored("wear", reason);
    for (const char* column : {"distance", "passages"}) {
        options.require(!positions.has(column), "positions", std::string("have no column ") + column + " " + reason);
    }
    if (positions.cases.size() > 1) options.ignored("plot", reason + ", or a single position");
}

}  // namespace

Settings read_settings(const study::Options& options) {
    Positions positions = read_cases(options);
    const auto positive = [&](const char* name) { return options.number(name, study::positive()); };
    const rollbem::WheelOnRail::Dimensions track = read_dimensions(options);
    const auto cells = options.pair("cells");
    const auto fits = [](double count) { return count >= 10 && count <= 1000 && count == std::floor(count); };
    options.require(cells && fits(cells->first) && fits(cells->second), "cells",
                    "be two integers from 10 to 1000 with a comma between them");
    const std::string side = options.choice("side", {"left", "right", "both"});
    std::vector<Side> sides;
    if (side != "right") sides.push_back(Side::left);
    if (side != "left") sides.push_back(Side::right);
    const std::optional<rollbem::RollingFriction> friction = read_friction(options, positions.has("friction"));
    for (const std::string column : {"speed", "pitch_rate"}) {
        options.require(friction.has_value() || !positions.has(column), "positions",
                        "have a column friction for its column " + column + ", or --friction");
    }
    std::optional<WearPlan> wear =
        read_wear(options, positions.cases, positions.has("distance"), positions.has("passages"));
    const double load = positive("load"), speed = options.number("speed", study::finite());
    options.require(speed != 0, "speed", "differ from 0: creepage is slip over the velocity of rolling");
    rollbem::WheelsetOnTrack wheelset = read_wheelset(options, track);
    check_surfaces(options, wheelset, positions);
    if (wear && !wear->worn_rail.empty()) {
        const rollbem::WheelOnRail::Dimensions::Origin origin = wheelset.wheel(sides[0]).geometry().rail_origin();
        const auto text = [](double length) { return study::Cell(std::round(1e12 * length) / 1e12 + 0.0).text(); };
        options.note("--worn-rail: stays where it was with --rail-origin " + text(origin.y) + "," + text(origin.z));
    }
    const auto swept = [&](const char* name) { return options.given(name) || positions.has(name); };
    return {std::move(positions.cases),
            std::string("shift, yaw") + (swept("x") ? ", track_x" : "") + (swept("pitch") ? ", pitch" : ""),
            std::move(wheelset),
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
            options.text("outline"),
            options.text("wear"),
            options.text("stress"),
            study::has_times(options),
            std::move(wear)};
}

rollbem::WheelsetForces forces_at(const Settings& settings, const rollbem::WheelsetOnTrack& wheelset, const Case& at) {
    rollbem::WheelsetOnTrack::Workspace workspace;
    using Free = rollbem::WheelsetOnTrack::Free;
    const double load = at.load.value_or(settings.load);
    const rollbem::WheelsetRolling rolling{
        .position = {at.shift, at.height.value_or(0), at.roll.value_or(0), at.yaw, at.along, at.pitch},
        .loads = {load, load},
        .free = at.height ? Free::nothing
                : at.roll ? Free::height
                          : Free::height_and_roll,
        .speeds = {.forward = settings.speed_of(at), .pitch_rate = at.pitch_rate.value_or(0)},
        .free_pitch = !at.pitch_rate,
        .force = settings.force,
        .loads_include_friction = settings.loads_include_friction};
    if (!settings.friction) {
        rollbem::WheelsetForces found;
        found.contacts = wheelset.solve(rolling.position, rolling.loads, workspace, rolling.free, settings.grid);
        return found;
    }
    rollbem::RollingFriction friction = *settings.friction;
    friction.coefficient = at.friction.value_or(friction.coefficient);
    return rolling_forces(wheelset, rolling, friction, workspace, settings.grid);
}

}  // namespace profile
