#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <rollbem/normal/profile_file.hpp>
#include <rollbem/normal/profile_wear.hpp>

#include "profile.hpp"
#include "support/input.hpp"

namespace profile {

namespace {

using Use = rollbem::Profile::Use;

/// The options of one side; the names of the left side's options begin with "left-".
struct SideOptions {
    const study::Options& options;
    std::string left;

    std::string own(const char* name) const { return left + name; }
    /// The option that names the profile: the right side's option where the left side has none.
    std::string source(const char* name) const { return options.given(own(name)) ? own(name) : name; }
};

rollbem::ProfileFile::Options file_options(const study::Options& options, const std::string& source) {
    std::string mirror;
    if (options.given(source + "-mirror")) mirror = options.choice(source + "-mirror", {"y", "z", "yz"});
    rollbem::ProfileFile::Options how{.per_metre = options.choice("length-unit", {"m", "mm"}) == "mm" ? 1000.0 : 1.0,
                                      .mirror_y = mirror.find('y') != std::string::npos,
                                      .mirror_z = mirror.find('z') != std::string::npos,
                                      .tape_offset = options.number("tape-offset", study::finite())};
    if (options.given("smooth")) how.smooth = options.number("smooth", study::between(1e-4, 0.1));
    return how;
}

bool is_standard(const study::Options& options, const std::string& source, Use use) {
    return rollbem::is_standard_profile(options.text(source), use);
}

/// The surface that open() makes, its notes in the sidecar. Throws BadInput.
template <class Open>
auto opened(const study::Options& options, const std::string& source, Use use, const Open& open) {
    const bool standard = is_standard(options, source, use);
    if (standard) options.ignored(source + "-mirror", "with a standard profile");
    rollbem::ProfileFile::Options how = file_options(options, source);
    if (standard) how.smooth = 0;  // the option smooths the other profile, which is from a file
    auto file = study::blame("--" + source, [&] { return open(options.text(source), how); });
    for (const std::string& note : file.notes) options.note("--" + source + ": " + note);
    for (const std::string& doubt : file.doubts) options.doubt("--" + source + ": " + doubt);
    return std::move(file.surface);
}

/// Ranges of y, Y1:Y2,... Throws BadInput.
std::vector<std::array<double, 2>> read_parts(const study::Options& options) {
    std::vector<std::array<double, 2>> parts;
    for (const std::string& text : options.texts("align-parts")) {
        const std::vector<std::string> ends = study::cells_of(text, ':');
        const auto from = study::number_of(ends.front()), to = study::number_of(ends.back());
        options.require(ends.size() == 2 && from && to && *from < *to, "align-parts",
                        "be ranges Y1:Y2 of y [m] with Y1 < Y2, and commas between them");
        parts.push_back({*from, *to});
    }
    return parts;
}

/// The option that names a reference for profiles of this use.
std::string reference_option(Use use) { return use == Use::wheel ? "align-wheel" : "align-rail"; }

/// The profile of the option, in the axes of measured ones, and its unworn parts. Throws BadInput.
std::pair<rollbem::Profile, std::vector<std::array<double, 2>>> read_reference(const study::Options& options, Use use) {
    const std::string name = reference_option(use);
    const bool standard = is_standard(options, name, use);
    const double offset = options.number("tape-offset", study::finite()), tape = 0.07 - offset;
    return study::blame("--" + name, [&]() -> std::pair<rollbem::Profile, std::vector<std::array<double, 2>>> {
        rollbem::ProfileFile::Options how{.per_metre = options.text("length-unit") == "mm" ? 1000.0 : 1.0,
                                          .tape_offset = offset};
        const auto only = [&](const auto& surface, bool has_sections) {
            if (has_sections) throw study::BadInput(options.said(name) + " must be one profile, without sections");
            return surface.profile();
        };
        const auto read = [&] {
            if (use == Use::wheel) {
                const auto wheel = rollbem::open_wheel(options.text(name), how).surface;
                return only(wheel, !wheel.is_round());
            }
            const auto rail = rollbem::open_rail(options.text(name), how, {.cant = 0}).surface;
            return only(rail, rail.has_sections());
        };
        rollbem::Profile reference = read();
        if (standard && use == Use::wheel) reference = reference.moved(0, tape, 0);
        if (standard && use == Use::rail) reference = extended(reference, 15e-3);
        std::vector<std::array<double, 2>> parts =
            options.given("align-parts") ? read_parts(options) : unworn_parts(reference, use, tape);
        return {std::move(reference), std::move(parts)};
    });
}

/// The profile of a file moved onto the reference, the motion in the sidecar. Throws BadInput.
rollbem::Profile aligned(const study::Options& options, const std::string& source, Use use, const rollbem::Profile& raw,
                         bool any_shape) {
    const auto [reference, parts] = read_reference(options, use);
    return study::blame("--" + source, [&, &onto = reference, &fixed = parts] {
        const rollbem::Profile::Alignment found = align(raw, onto, fixed, options.flag("align-angle"));
        const auto in_mm = [](double length) { return study::Cell(1e3 * length).text(5) + " mm"; };
        const std::string motion =
            "aligned with " + options.text(reference_option(use)) + ": moved by dy = " + in_mm(found.dy) +
            ", dz = " + in_mm(found.dz) +
            (options.flag("align-angle") ? ", angle = " + study::Cell(1e3 * found.angle).text(5) + " mrad" : "") +
            "; residual " + in_mm(found.residual) + " on " + study::Cell(100 * found.share).text(3) +
            " % of the unworn parts";
        if (found.residual > 0.1e-3 || found.share < 0.5) {
            options.doubt("--" + source + ": " + motion + ": does it fit this reference and --align-parts?");
        } else {
            options.note("--" + source + ": " + motion);
        }
        const rollbem::Profile moved = raw.moved(found.angle, found.dy, found.dz);
        return rollbem::Profile(moved.y(), moved.z(), any_shape ? Use::piece : use);
    });
}

/// A message of the library that names options of the right side, for the left one.
std::string of_side(std::string text, const std::string& left) {
    for (const char* name : {"--wheel-mirror", "--rail-mirror"}) {
        const std::size_t at = text.find(name);
        if (!left.empty() && at != std::string::npos) text.insert(at + 2, left);
    }
    return text;
}

/// A message on a wheel and its rail, with the option to blame before it and quantities called as their options.
std::string in_options(const study::Options& options, const SideOptions& side, std::string text) {
    std::string blamed = side.source("rail");
    for (const char* start : {"WheelOnRail: ", "wheel: "}) {
        if (text.rfind(start, 0) != 0) continue;
        text.erase(0, std::string_view(start).size());
        if (start[0] == 'w') blamed = side.source("wheel");
    }
    const std::array<std::array<std::string, 3>, 3> names{
        {{"gauge_depth", "--gauge-depth", "gauge-depth"},
         {"rail_origin", "--rail-origin", "rail-origin"},
         {"(1 - poisson_ratio) / shear_modulus", "(1 - nu)/G", "shear-modulus"}}};
    for (const auto& [name, shown, option] : names) {
        const std::size_t at = text.find(name);
        if (at == std::string::npos) continue;
        text.replace(at, name.size(), shown);
        if (blamed == side.source("rail") && options.given(option)) blamed = option;
    }
    return options.said(blamed) + ": " + text;
}

/// Of wheels and rails in metres; of any shape all that are positive.
study::Rule length(const study::Options& options, double low, double high) {
    return options.flag("any-shape") ? study::positive() : study::in_unit("m", low, high);
}

rollbem::WheelOnRail read_side(const study::Options& options, const std::string& left,
                               rollbem::WheelOnRail::Dimensions dimensions) {
    const SideOptions side{options, left};
    const bool any_shape = options.flag("any-shape");
    if (options.given(side.own("radius"))) {
        dimensions.radius = options.number(side.own("radius"), length(options, 0.02, 5));
    }
    rollbem::ProfileFile::Placing placing{.by_origin = dimensions.rail_origin.has_value()};
    if (options.given("cant")) placing.cant = options.number("cant", study::between(-0.5, 0.5));
    if (options.given("roller-radius")) placing.roller_radius = options.number("roller-radius", study::positive());
    try {
        const std::string wheel_source = side.source("wheel"), rail_source = side.source("rail");
        const bool aligns_wheel = options.given("align-wheel") && !is_standard(options, wheel_source, Use::wheel),
                   aligns_rail = options.given("align-rail") && !is_standard(options, rail_source, Use::rail);
        auto wheel = opened(options, wheel_source, Use::wheel, [&](const auto& name, const auto& how) {
            return rollbem::open_wheel(name, how, any_shape || aligns_wheel);
        });
        auto rail = opened(options, rail_source, Use::rail, [&](const auto& name, const auto& how) {
            return rollbem::open_rail(name, how, placing, any_shape || aligns_rail);
        });
        if (aligns_wheel && wheel.is_round()) {
            wheel = aligned(options, wheel_source, Use::wheel, wheel.profile(), any_shape);
        }
        if (aligns_rail && !rail.has_sections()) {
            const double cant = options.number("cant", study::between(-0.5, 0.5));
            const rollbem::Profile raw = rail.profile().moved(cant, 0, 0);
            rollbem::Profile own = aligned(options, rail_source, Use::rail, raw, any_shape).moved(-cant, 0, 0);
            rail = placing.roller_radius > 0 ? rollbem::RailSurface::roller(std::move(own), placing.roller_radius)
                                             : rollbem::RailSurface(std::move(own));
        }
        if ((aligns_wheel && !wheel.is_round()) || (aligns_rail && rail.has_sections())) {
            const char* const name = aligns_wheel && !wheel.is_round() ? "align-wheel" : "align-rail";
            throw study::BadInput(options.said(name) + " has no effect with sections: align their profiles one by one");
        }
        if (rail.has_sections() && !dimensions.rail_origin) {
            throw study::BadInput(options.said(side.source("rail")) +
                                  " must be placed by --rail-origin, as it changes along the track");
        }
        try {
            return {wheel, rail, dimensions};
        } catch (const std::invalid_argument& error) {
            throw study::BadInput(in_options(options, side, error.what()));
        }
    } catch (const std::invalid_argument& error) {
        throw study::BadInput(of_side(error.what(), left));
    }
}

}  // namespace

void add_profile_options(study::Options& options) {
    options.set_help("poisson", "Poisson's ratio of wheel and rail [dimensionless], 0 to 0.5", "NU");
    options.add("shear-modulus", "G", "shear modulus of wheel and rail [Pa], 1e7 to 1e13", "8.2e10");
    options.group("Profiles");
    options.add_input(
        "wheel",
        "profile of the right wheel: s1002, or a file of two columns y, z (y to the right, z down, flange at negative "
        "y, z = 0 on the tape circle), .prw, .whl, or .slcw with sections round the wheel");
    options.set_default("wheel", "s1002");
    options.add_input("rail",
                      "profile of the right rail: 60e1, uic60, 54e1, or a file of two columns y, z (inner side at "
                      "negative y), .prr, .ban, or .slcs with sections along the track");
    options.set_default("rail", "60e1");
    options.add("length-unit", "NAME", "unit of length in files of two columns: m or mm", "m");
    options.add("wheel-mirror", "NAME",
                "coordinates that change sign in the wheel's file: y (of a left wheel), z or yz; none without it");
    options.add("rail-mirror", "NAME",
                "coordinates that change sign in the rail's file: y (of a left rail), z or yz; none without it");
    options.add_flag("any-shape",
                     "no check that the profiles look like a wheel and a rail, for pieces, rollers and planes");
    options.add("cant", "X",
                "angle by which the rail is turned inwards [rad], -0.5 to 0.5, 0 for a profile that is canted already",
                "0.02499479361892016");
    options.add("smooth", "X",
                "wave length [m], 1e-4 to 0.1, of the waves in files' profiles that smoothing halves; it damps shorter "
                "ones more; no smoothing without it");
    options.add_input(
        "align-wheel",
        "s1002 or a file of the wheel, in the axes of --tape-offset, that wheels from files are moved onto "
        "where they do not wear: back of the flange, and tread beyond y = 35 mm; not moved without it");
    options.add_input("align-rail",
                      "60e1, uic60, 54e1 or a file, upright as files before --cant, that rails from files are moved "
                      "onto where they do not wear: sides from 20 mm below the top on; not moved without it");
    options.add_flag("align-angle", "alignment by an angle, too").only_with({"align-wheel", "align-rail"});
    options
        .add("align-parts", "LIST",
             "ranges Y1:Y2 of y of the reference [m] that do not wear, in place of those of --align-wheel or "
             "--align-rail")
        .only_with({"align-wheel", "align-rail"});
    options.group("Profiles of the left side, given as a right wheel on a right rail");
    options.add_input("left-wheel", "profile of the left wheel, as --wheel takes it; default: --wheel");
    options.add_input("left-rail", "profile of the left rail, as --rail takes it; default: --rail");
    options
        .add("left-wheel-mirror", "NAME",
             "coordinates that change sign in the file of --left-wheel: y, z or yz; none without it")
        .only_with({"left-wheel"});
    options
        .add("left-rail-mirror", "NAME",
             "coordinates that change sign in the file of --left-rail: y, z or yz; none without it")
        .only_with({"left-rail"});
    options.add("left-radius", "R", "radius of the left wheel's tape circle [m], 0.02 to 5; default: --radius");
}

rollbem::WheelsetOnTrack read_wheelset(const study::Options& options,
                                       const rollbem::WheelOnRail::Dimensions& dimensions) {
    bool all_standard = true;
    for (const auto& [name, use] :
         {std::pair{"wheel", Use::wheel}, {"rail", Use::rail}, {"left-wheel", Use::wheel}, {"left-rail", Use::rail}}) {
        all_standard = all_standard && (options.text(name).empty() || is_standard(options, name, use));
    }
    options.choice("length-unit", {"m", "mm"});
    options.require(!options.given("align-parts") || !(options.given("align-wheel") && options.given("align-rail")),
                    "align-parts",
                    "be given with one of --align-wheel and --align-rail: they are parts of its reference");
    for (const auto& [name, left, use] :
         {std::tuple{"wheel", "left-wheel", Use::wheel}, {"rail", "left-rail", Use::rail}}) {
        const bool from_file =
            !is_standard(options, name, use) || (!options.text(left).empty() && !is_standard(options, left, use));
        if (!from_file) options.ignored(reference_option(use), std::string("with a standard ") + name);
    }
    for (const char* name : {"length-unit", "smooth", "any-shape"}) {
        if (all_standard) options.ignored(name, "without a profile from a file");
    }
    rollbem::WheelOnRail right = read_side(options, "", dimensions);
    for (const char* name : {"left-wheel", "left-rail", "left-radius"}) {
        if (options.given(name)) return {read_side(options, "left-", dimensions), std::move(right)};
    }
    return rollbem::WheelsetOnTrack(right);
}

void add_track_options(study::Options& options) {
    options.group("Track and wheelset");
    options.add("radius", "R", "radius of the wheels' tape circle [m], 0.02 to 5, or above 0 with --any-shape", "0.46");
    options.add("gauge", "X", "distance between the rails [m], 0.1 to 5, or above 0 with --any-shape", "1.435");
    options.add(
        "gauge-depth", "X",
        "depth below the tops of the rails [m], above 0, down to which the gauge is measured where they are narrowest",
        "0.014");
    options.add("flange-back", "X",
                "distance between the backs of the flanges [m], 0.05 to 5, or at least 0 with --any-shape", "1.36");
    options.add("tape-offset", "X",
                "distance of the wheel profile's origin from the back of its flange [m]: 0.07 on the tape circle, 0 "
                "for profiles measured from the back",
                "0.07");
    options.add("rail-origin", "Y,Z", "place of the right rail's profile in track axes [m], in place of --gauge");
    options.not_with({"gauge", "gauge-depth"}, "rail-origin");
    options
        .add("roller-radius", "R",
             "radius of a roller in place of the rail [m], above 0: its axle's depth below z = 0 of the profile; a "
             "straight rail without it")
        .only_with({"rail-origin"});
}

rollbem::WheelOnRail::Dimensions read_dimensions(const study::Options& options) {
    rollbem::WheelOnRail::Dimensions track{
        .gauge = options.number("gauge", length(options, 0.1, 5)),
        .gauge_depth = options.number("gauge-depth", study::positive()),
        .flange_back =
            options.number("flange-back", options.flag("any-shape") ? study::not_negative() : length(options, 0.05, 5)),
        .tape_offset = options.number("tape-offset", study::finite()),
        .radius = options.number("radius", length(options, 0.02, 5)),
        .shear_modulus = options.number("shear-modulus", study::shear_modulus()),
        .poisson_ratio = options.number("poisson", study::between(0, 0.5))};
    if (options.given("rail-origin")) {
        const auto origin = options.pair("rail-origin");
        options.require(origin.has_value(), "rail-origin", "be two numbers with a comma between them");
        track.rail_origin = rollbem::WheelOnRail::Dimensions::Origin{origin->first, origin->second};
    }
    return track;
}

}  // namespace profile
