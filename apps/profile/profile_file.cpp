#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "profile.hpp"
#include "support/csv.hpp"
#include "support/input.hpp"

namespace profile {

namespace {

/// Points in the unit of the file, and where they stand in it, for messages.
struct Points {
    std::vector<double> y, z;
    std::vector<std::string> where;
};

Points read_csv(const study::Options& options, const std::string& name) {
    Points points;
    std::vector<study::Numbers> columns = study::read_columns(
        options, name, "y,z", "", [&](const auto&, const std::string& where) { points.where.push_back(where); });
    points.y = std::move(columns[0]);
    points.z = std::move(columns[1]);
    return points;
}

/// The points between point.begin and point.end, and what the lines "name = value" above them say of these. `!` begins
/// a comment.
Points read_simpack(const study::Options& options, const std::string& name) {
    // what changes points; what else there may be does not, or only with values that are not 0
    std::map<std::string, double> settings{
        {"mirror.y", 0},    {"mirror.z", 0},    {"shift.y", 0},       {"shift.z", 0},        {"units.len.f", 1000},
        {"inversion", 0},   {"rotate", 0},      {"approx.smooth", 0}, {"point.dist.min", 0}, {"bound.y.min", 1},
        {"bound.y.max", 0}, {"bound.z.min", 1}, {"bound.z.max", 0}};
    Points points;
    bool inside = false, ended = false;
    study::Lines lines(options, name);
    while (lines.next() && !ended) {
        std::string text = lines.text().substr(0, lines.text().find('!'));
        const std::string where = lines.where() + " = " + lines.text();
        if (const std::size_t equals = text.find('='); !inside && equals != std::string::npos) {
            std::istringstream words(text.substr(0, equals));
            std::string key;
            words >> key;
            const auto setting = settings.find(key);
            if (setting == settings.end()) continue;
            const std::vector<std::string> cells = study::cells_of(text.substr(equals + 1), ',');
            const auto value = study::number_of(cells.front(), ',');
            if (!value || !std::isfinite(*value))
                throw study::BadInput(where + ": " + key + " must be a finite number");
            setting->second = *value;
            for (const char* unknown : {"rotate", "approx.smooth", "point.dist.min"}) {
                if (key == unknown && *value != 0) throw study::BadInput(where + ": " + key + " must be 0");
            }
            if (key == "units.len.f" && !(*value > 0)) throw study::BadInput(where + ": units.len.f must be positive");
            continue;
        }
        std::istringstream words(text);
        std::string y, z;
        if (!(words >> y)) continue;
        if (y == "point.begin" || y == "point.end") {
            ended = inside;
            inside = y == "point.begin";
            continue;
        }
        if (!inside) continue;
        words >> z;
        const auto read_y = study::number_of(y, ','), read_z = study::number_of(z, ',');
        if (!read_y || !read_z || !std::isfinite(*read_y) || !std::isfinite(*read_z)) {
            throw study::BadInput(where + " must begin with y and z, two finite numbers");
        }
        points.y.push_back((*read_y + settings["shift.y"]) * (settings["mirror.y"] != 0 ? -1 : 1));
        points.z.push_back((*read_z + settings["shift.z"]) * (settings["mirror.z"] != 0 ? -1 : 1));
        points.where.push_back(where);
    }
    for (const std::string of : {"bound.y", "bound.z"}) {
        if (settings[of + ".min"] < settings[of + ".max"]) {
            throw study::BadInput(options.said(name) + ": " + of + ".min must not be below " + of +
                                  ".max: cut the points instead");
        }
    }
    options.require(!points.y.empty(), name, "have points after a line point.begin");
    options.require(ended, name, "have a line point.end after its points");
    // the factor is of lengths in the file over metres, so that the order of the lines above does not matter
    for (std::vector<double>* of : {&points.y, &points.z}) {
        for (double& value : *of) value /= settings["units.len.f"];
    }
    return points;
}

/// A profile that an option may name, and the ending of its files that are not CSV.
struct Kind {
    std::string option, known, ending;
};
const Kind of_wheel{"wheel", "s1002", ".prw"}, of_rail{"rail", "60e1", ".prr"};

/// Whether the profile is a file of CSV. Throws BadInput unless it is the known one or ends as a file of one.
bool is_csv(const study::Options& options, const Kind& kind) {
    if (options.text(kind.option) == kind.known) return false;
    std::string ending = std::filesystem::path(options.text(kind.option)).extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    options.require(ending == ".csv" || ending == kind.ending, kind.option,
                    "be " + kind.known + " or a file that ends in .csv or " + kind.ending);
    return ending == ".csv";
}

rollbem::Profile read(const study::Options& options, const Kind& kind) {
    const std::string& name = kind.option;
    Points points;
    const bool csv = is_csv(options, kind);
    if (csv) {
        points = read_csv(options, name);
        const double per_metre = options.choice("length-unit", {"m", "mm"}) == "mm" ? 1000 : 1;
        for (std::vector<double>* of : {&points.y, &points.z}) {
            for (double& value : *of) value /= per_metre;
        }
    } else {
        points = read_simpack(options, name);
    }
    std::optional<rollbem::Profile> profile;
    try {
        profile.emplace(study::array(points.y), study::array(points.z));
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what(),
                          of_point = "number of the point = ", rule = "must be that of a point that ";
        const std::size_t found = text.find(of_point);
        if (found == std::string::npos) throw study::BadInput(options.said(name) + ": " + text);
        throw study::BadInput(points.where[std::stoul(text.substr(found + of_point.size())) - 1] + " " +
                              text.substr(text.find(rule) + rule.size()));
    }
    const auto [least, largest] = std::minmax_element(points.y.begin(), points.y.end());
    const double width = *largest - *least;
    if (width > 1 || width < 1e-3) {
        throw study::BadInput(options.said(name) + ": width of the profile = " + study::Cell(width).text(4) +
                              " m must lie in [0.001, 1]" + (csv ? ": is --length-unit right?" : ""));
    }
    return *std::move(profile);
}

/// Worn or measured profiles without their noise.
rollbem::Profile smoothed(const study::Options& options, const rollbem::Profile& profile) {
    return options.given("smooth") ? profile.smoothed(options.number("smooth", study::between(1e-7, 1e-3))) : profile;
}

}  // namespace

void add_profile_options(study::Options& options) {
    options.group("Profiles");
    options.add_input(
        "wheel",
        "s1002 (default), or a file .csv (columns y,z, y to the right, z down, flange of the right wheel at "
        "negative y, z = 0 on the tape circle at y = 0) or .prw");
    options.set_default("wheel", "s1002");
    options.add_input("rail", "60e1 (default), or a file .csv (inner side of the right rail at negative y) or .prr");
    options.set_default("rail", "60e1");
    options.add("length-unit", "NAME", "of CSV profiles: m or mm", "m");
    options.add("cant", "X", "by which the rail is turned inwards [rad]; 0 for a profile that is canted already",
                "0.02499479361892016");
    options.add("smooth", "X",
                "root mean square, 1e-7 to 1e-3 [m], by which smoothed profiles from files may leave their points");
}

rollbem::Profile read_wheel(const study::Options& options) {
    options.choice("length-unit", {"m", "mm"});
    const bool csv_wheel = is_csv(options, of_wheel), csv_rail = is_csv(options, of_rail);
    if (!csv_wheel && !csv_rail) options.ignored("length-unit", "without a .csv profile");
    const bool known = options.text("wheel") == of_wheel.known;
    if (known && options.text("rail") == of_rail.known) options.ignored("smooth", "without a profile from a file");
    return known ? rollbem::s1002() : smoothed(options, read(options, of_wheel));
}

rollbem::Profile read_rail(const study::Options& options) {
    const double cant = options.number("cant", study::between(-0.5, 0.5));
    if (options.text("rail") == of_rail.known) return rollbem::rail_60e1(cant);
    const rollbem::Profile rail = smoothed(options, read(options, of_rail));
    const rollbem::Profile canted = cant == 0 ? rail : rail.moved(-cant, 0, 0);
    return canted.moved(0, 0, -canted.z().minCoeff());
}

}  // namespace profile
