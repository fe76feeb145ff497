#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/vehicle/wheelset_on_track.hpp>

#include "profile.hpp"
#include "support/sheet.hpp"

namespace profile {

namespace {

using RadiusDifference = rollbem::WheelsetOnTrack::RadiusDifference;
using rollbem::Status;
using rollbem::WheelsetOnTrack;

const study::Plot difference_frame{"Difference of the rolling radii", {"y [mm]"}, {"Δr [mm]"}};
constexpr double mm = 1e-3;

/// A wave of the free wheelset.
struct Wave {
    double amplitude;
    RadiusDifference::Conicity found;

    bool exists() const { return found.status == Status::ok; }
};

template <class Value>
auto if_exists(const Value& value) {
    return study::where(&Wave::exists, [=](const Wave& wave) { return wave.found.*value; });
}

const study::Sheet<Wave, double> wave_sheet{
    "",
    {{"amplitude", "amplitude of the wave, half of y_max - y_min [m]", &Wave::amplitude},
     {"tan_gamma", "equivalent conicity: tan gamma of the cone with the same wavelength, by integration of the wave",
      if_exists(&RadiusDifference::Conicity::tan_gamma)},
     {"tan_gamma_linear", "equivalent conicity by harmonic linearisation",
      if_exists(&RadiusDifference::Conicity::tan_gamma_linear)},
     {"wavelength", "wave length [m]", if_exists(&RadiusDifference::Conicity::wavelength)},
     {"y_min", "ends of the lateral motion of the wheelset's middle [m]",
      if_exists(&RadiusDifference::Conicity::y_min)},
     {"y_max", "", if_exists(&RadiusDifference::Conicity::y_max)},
     {"status",
      "ok; beyond_clearance where the wave leaves the positions that both wheels reach without climbing over a flange "
      "or an end of a profile; unstable where Delta r falls, so that no wave passes the equilibrium; or why the "
      "wheelset has no contact in the middle",
      [](const Wave& wave) { return name(wave.found.status); }}},
    ""};

struct Radii {
    double y;
    WheelsetOnTrack::RollingRadii at;

    bool known() const { return at.status == Status::ok; }
};

template <class Value>
auto if_known(const Value& value) {
    return study::where(&Radii::known, value);
}

const study::Sheet<Radii, double> radii_sheet{
    "",
    {{"y", "lateral position of the wheelset [m]", &Radii::y},
     {"delta_r", "right_radius less left_radius [m]; empty beyond the clearance, like the following",
      if_known([](const Radii& r) { return r.at.difference(); })},
     {"right_radius", "rolling radii [m]", if_known([](const Radii& r) { return r.at.wheels[1].rolling_radius; })},
     {"left_radius", "", if_known([](const Radii& r) { return r.at.wheels[0].rolling_radius; })},
     {"right_angle", "angles of contact in track axes [rad]",
      if_known([](const Radii& r) { return r.at.wheels[1].angle; })},
     {"left_angle", "", if_known([](const Radii& r) { return -r.at.wheels[0].angle; })}},
    ""};

study::Table wave_table(const Conicity& conicity) {
    study::Table table = wave_sheet.table(conicity.places, [&](double amplitude) {
        Wave wave{amplitude, {.status = conicity.status}};
        if (conicity.radii) wave.found = equivalent_conicity(*conicity.radii, amplitude);
        return wave;
    });
    table.plot = [&](const study::Records& rows) {
        study::Plot difference = difference_frame, waves{"Equivalent conicity", {"amplitude [mm]"}, {"tan γ_e"}};
        study::Series& radii = difference.series.emplace_back(study::Series{"right less left"});
        for (Eigen::Index i = 0; conicity.radii && i < conicity.radii->lateral().size(); ++i) {
            radii.points.emplace_back(conicity.radii->lateral()[i] / mm, conicity.radii->difference()[i] / mm);
        }
        for (const auto& [column, label] :
             {std::pair{"tan_gamma", "kinematic wave"}, {"tan_gamma_linear", "harmonic"}}) {
            add_series(waves, rows, {.x = "amplitude", .y = column, .prefix = label, .x_unit = mm});
        }
        return study::Picture{difference, waves};
    };
    return table;
}

study::Table radii_table(const Conicity& conicity) {
    study::Table table = radii_sheet.table(conicity.places, [&](double y) {
        return Radii{y, rolling_radii(conicity.wheelset, y)};
    });
    table.plot = [](const study::Records& rows) {
        study::Plot difference = difference_frame, angles{"Angles of contact", {"y [mm]"}, {"δ [rad]"}};
        add_series(difference, rows, {.x = "y", .y = "delta_r", .x_unit = mm, .y_unit = mm});
        for (const std::string side : {"right", "left"}) {
            add_series(angles, rows, {.x = "y", .y = side + "_angle", .prefix = side, .x_unit = mm});
        }
        return study::Picture{difference, angles};
    };
    return table;
}

/// Multiples of a tenth of a millimetre around the middle at which both wheels have contact within the clearance.
std::vector<double> all_positions(const rollbem::WheelsetOnTrack& wheelset) {
    constexpr int most = 1000;
    std::vector<double> positions;
    const auto reached = [&](int k) {
        return std::abs(k) <= most && rolling_radii(wheelset, k / 1e4).status == Status::ok;
    };
    for (int k = 0; reached(k); ++k) positions.push_back(k / 1e4);
    for (int k = -1; !positions.empty() && reached(k); --k) positions.insert(positions.begin(), k / 1e4);
    return positions;
}

}  // namespace

void add_conicity_options(study::Options& options) {
    options.group("Equivalent conicity (EN 15302)");
    options.add_flag("conicity",
                     "table of the equivalent conicity of the free wheelset's kinematic wave over its amplitude (rigid "
                     "contact, no roll), in place of patches");
    options
        .add("amplitude", "LIST", "amplitude of the wave [m], 1e-6 or more",
             "0.001,0.0015,0.002,0.0025,0.003,0.0035,0.004,0.0045,0.005,0.0055,0.006,0.0065,0.007,0.0075,0.008")
        .only_with({"conicity"})
        .not_with("rolling-radii");
    options
        .add_flag("rolling-radii",
                  "table of rolling radii and angles of contact of both wheels over the lateral position, in place of "
                  "the conicity: at --shift, or by 0.1 mm within the clearance")
        .only_with({"conicity"});
    options.not_with({"load", "shear-modulus", "poisson"}, "conicity");
}

std::string conicity_help() {
    return "--conicity, one row for each amplitude; the sidecar notes the nonlinearity:\n" + wave_sheet.help() +
           "--conicity --rolling-radii, one row for each lateral position:\n" + radii_sheet.help();
}

Conicity read_conicity(const study::Options& options) {
    Conicity conicity{.wheelset = read_wheelset(options, read_dimensions(options)),
                      .of_radii = options.flag("rolling-radii")};
    if (!conicity.of_radii) options.ignored("shift", "with --conicity unless --rolling-radii is given");
    for (const Side side : rollbem::WheelsetOnTrack::sides) {
        if (conicity.wheelset.wheel(side).geometry().is_plain()) continue;
        throw study::BadInput("--conicity = true must have round wheels on straight rails of one profile");
    }
    const Status centred = rolling_radii(conicity.wheelset, 0).status;
    if (conicity.of_radii) {
        conicity.places = options.given("shift") ? options.numbers("shift", study::between(-0.1, 0.1))
                                                 : all_positions(conicity.wheelset);
        if (!conicity.places.empty()) return conicity;
        throw study::BadInput(std::string("--shift must be given with --rolling-radii: the wheelset has no contact in "
                                          "the middle, its status is ") +
                              name(centred));
    }
    conicity.radii = radius_difference(conicity.wheelset);
    if (!conicity.radii) {
        // where Delta r rises, its zero lies beyond the reach of the wheels
        const auto difference = [&](double lateral) { return rolling_radii(conicity.wheelset, lateral).difference(); };
        conicity.status = centred != Status::ok                  ? centred
                          : difference(1e-3) > difference(-1e-3) ? Status::beyond_clearance
                                                                 : Status::unstable;
    }
    const std::optional<double> nonlinearity = conicity.radii ? conicity_nonlinearity(*conicity.radii) : std::nullopt;
    options.note("nonlinearity (tan gamma at 4 mm - at 2 mm)/2 mm [1/m]: " +
                 (nonlinearity ? study::Cell(*nonlinearity).text(6) : "none, as one of them has no wave"));
    const study::Rule at_least_a_micrometre{[](double value) { return value >= 1e-6 && std::isfinite(value); },
                                            "be positive and finite, and at least 1e-6 m"};
    conicity.places = options.numbers("amplitude", at_least_a_micrometre);
    return conicity;
}

study::Table conicity_table(const Conicity& conicity) {
    return conicity.of_radii ? radii_table(conicity) : wave_table(conicity);
}

}  // namespace profile
