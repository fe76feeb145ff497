#include <stdexcept>
#include <string>
#include <variant>

#include <rollbem/normal/profile_file.hpp>
#include <rollbem/normal/standard_profiles.hpp>

#include "profile.hpp"

namespace profile {

namespace {

bool is_built_in(const std::string& name) {
    return name == "s1002" || name == "60e1" || name == "uic60" || name == "54e1";
}

rollbem::Profile read(const study::Options& options, const std::string& name, rollbem::Profile::Use use) {
    rollbem::ProfileFileOptions how;
    how.per_metre = options.choice("length-unit", {"m", "mm"}) == "mm" ? 1000 : 1;
    if (options.given("smooth")) how.smooth = options.number("smooth", study::between(1e-4, 0.1));
    if (options.given("tape-offset")) how.tape_offset = options.number("tape-offset", study::finite());
    try {
        rollbem::ProfileFile file = rollbem::read_profile(options.text(name), use, how);
        if (auto* profile = std::get_if<rollbem::Profile>(&file.curve)) return std::move(*profile);
    } catch (const std::invalid_argument& error) {
        throw study::BadInput("--" + name + ": " + error.what());
    }
    throw study::BadInput(options.said(name) + ": one profile is expected, no sections");
}

}  // namespace

void add_profile_options(study::Options& options) {
    options.group("Profiles");
    options.add_input(
        "wheel",
        "s1002 (default), or a file .csv (columns y,z, y to the right, z down, flange of the right wheel at "
        "negative y, z = 0 on the tape circle at y = 0) or .prw");
    options.set_default("wheel", "s1002");
    options.add_input(
        "rail", "60e1 (default), uic60, 54e1, or a file .csv (inner side of the right rail at negative y) or .prr");
    options.set_default("rail", "60e1");
    options.add("length-unit", "NAME", "of CSV profiles: m or mm", "m");
    options.add("cant", "X", "by which the rail is turned inwards [rad]; 0 for a profile that is canted already",
                "0.02499479361892016");
    options.add(
        "smooth", "X",
        "wave length, 1e-4 to 0.1 [m]: of profiles from files, waves of this length are halved, shorter ones vanish");
}

rollbem::Profile read_wheel(const study::Options& options) {
    const std::string wheel = options.text("wheel"), rail = options.text("rail");
    options.choice("length-unit", {"m", "mm"});
    if (is_built_in(wheel) && is_built_in(rail)) {
        options.ignored("length-unit", "without a profile from a file");
        options.ignored("smooth", "without a profile from a file");
    }
    return wheel == "s1002" ? rollbem::s1002() : read(options, "wheel", rollbem::Profile::Use::wheel);
}

rollbem::Profile read_rail(const study::Options& options) {
    const double cant = options.number("cant", study::between(-0.5, 0.5));
    const std::string rail = options.text("rail");
    if (rail == "60e1") return rollbem::rail_60e1(cant);
    if (rail == "uic60") return rollbem::rail_uic60(cant);
    if (rail == "54e1") return rollbem::rail_54e1(cant);
    const rollbem::Profile of_file = read(options, "rail", rollbem::Profile::Use::rail);
    const rollbem::Profile canted = cant == 0 ? of_file : of_file.moved(-cant, 0, 0);
    return canted.moved(0, 0, -canted.z().minCoeff());
}

}  // namespace profile
