// rollbem/normal/profile_file.hpp
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <unistd.h>

#include <rollbem/normal/profile.hpp>
#include <rollbem/normal/profile_file.hpp>
#include <rollbem/normal/detail/profile_direction.hpp>
#include <rollbem/normal/detail/profile_doubts.hpp>

#include "extremes/drawn.hpp"
#include "support/catch.hpp"
#include "support/refusal.hpp"

namespace {

using namespace rollbem;
using Catch::Matchers::ContainsSubstring;
using Use = Profile::Use;

/// A folder of files, removed at the end.
class Folder {
public:
    Folder() : path_(std::filesystem::temp_directory_path() / ("rollbem_profiles_" + std::to_string(getpid()))) {
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name, std::ios::binary) << text;
        return path_ / name;
    }

private:
    std::filesystem::path path_;
};

const Folder& folder() {
    static const Folder of;
    return of;
}

ProfileFile read(const std::string& name, const std::string& text, Use use = Use::piece,
                 const ProfileFile::Options& options = {.per_metre = 1000}) {
    return read_profile(folder().write(name, text), use, options);
}
Profile profile_of(const std::string& name, const std::string& text, Use use = Use::piece,
                   const ProfileFile::Options& options = {.per_metre = 1000}) {
    return std::get<Profile>(read(name, text, use, options).curve);
}
std::string refused(const std::string& name, const std::string& text, Use use = Use::piece,
                    const ProfileFile::Options& options = {.per_metre = 1000}) {
    return refusal([&] { read(name, text, use, options); });
}

/// Lines "y z" [mm] of a profile, in this order of points and with these signs.
std::string lines(const Profile& profile, double sign_y = 1, double sign_z = 1, const char* separator = " ",
                  double unit = 1e3) {
    std::ostringstream text;
    text.precision(10);
    for (Eigen::Index i = 0; i < profile.size(); ++i) {
        text << sign_y * unit * profile.y()[i] << separator << sign_z * unit * profile.z()[i] << '\n';
    }
    return text.str();
}

double farthest(const Profile& one, const Profile& other) {
    if (one.size() != other.size()) return 1;
    return std::sqrt(((one.y() - other.y()).square() + (one.z() - other.z()).square()).maxCoeff());
}

/// Checks that a profile has the four points (0, 0), (3, 1), (6, 1) and (9, 0) mm.
void require_trapezium(const Profile& profile) {
    REQUIRE(profile.size() == 4);
    CHECK((profile.y() - Eigen::ArrayXd{{0, 3e-3, 6e-3, 9e-3}}).abs().maxCoeff() < 1e-15);
    CHECK((profile.z() - Eigen::ArrayXd{{0, 1e-3, 1e-3, 0}}).abs().maxCoeff() < 1e-15);
}

/// A straight line of 2 mm steps with other points in its middle.
std::string with_middle(const std::string& middle) { return "0 0\n2 0\n4 0\n6 0\n" + middle + "10 0\n12 0\n14 0\n"; }

TEST_CASE("profile_file: two columns, whatever an unknown ending", "[profiles]") {
    struct Scene {
        const char *what, *text;
    };
    const auto scene = GENERATE(values<Scene>({
        {"blanks", "0 0\n3 1\n6 1\n9 0\n"},
        {"comma", "0,0\n3,1\n6,1\n9,0\n"},
        {"comma and blanks", " 0 , 0\n3, 1\n  6 ,1\n9,0"},
        {"semicolon", "0;0\n3;1\n6;1\n9;0\n"},
        {"tabs", "0\t0\n3\t\t1\n6 \t1\n9\t0\n"},
        {"header", "y,z\n0,0\n3,1\n6,1\n9,0\n"},
        {"columns by name", "s;\"Z [mm]\";Y\n1;0;0\n2;1;3\n3;1;6\n4;0;9\n"},
        {"units in a header between blanks", "y [mm] z [mm]\n0 0\n3 1\n6 1\n9 0\n"},
        {"further columns and text", "0 0 7 8\n3 1 x\n6 1 nan\n9 0\n"},
        {"comments and blank lines", "\n% of\n# all\n!kinds\n0 0 % a\n\n3 1#b\n6 1 ! c\n9 0\n\n"},
        {"byte-order mark and CR LF", "\xef\xbb\xbfy,z\r\n0,0\r\n3,1\r\n6,1\r\n9,0\r\n"},
        {"CR alone", "0 0\r3 1\r6 1\r9 0"},
        {"decimal commas", "y;z\n0;0\n3,0;1,0\n6,0;1\n9;0,0\n"},
        {"decimal commas without a header", "0,0;0\n3,0;1,0\n6,0;1\n9;0,0\n"},
        {"decimal commas between tabs", "0,0\t0,0\n3,0\t\t1,0\n6,0\t1\n9\t0,0\n"},
        {"decimal commas between tabs below a header", "n\ty\tz\na\t0,0\t0\n\t3,0\t1\n\t6\t1,0\nb\t9\t0\n"},
        {"commas beside tabs", "0,\t0\n3.0,\t1\n6,\t1\n9,\t0\n"},
        {"quoted names and numbers", "\"y\",\"z\"\n\"0\",\"0\"\n\"3.0\",\"1\"\n6,1\n\"9\", 0\n"},
        {"quoted decimal commas", "\"y\";\"z\"\n\"0\";0\n\"3,0\";\"1,0\"\n6;1\n9;0\n"},
        {"a spreadsheet's separator", "sep=;\r\ny;z\r\n0;0\r\n3,0;1\r\n6;1,0\r\n9;0\r\n"},
        {"a quoted separator, a tab", "\xef\xbb\xbf\"sep=\t\"\ny\tz\n0\t0\n3,0\t1\n6\t1\n9\t0\n"},
        {"separators at the ends of lines", "y;z;;\n0;0;;\n3,0;1;\n6;1\n9;0;;;\n"},
        {"blanks below a header with commas", "y, z\n0 0\n3 1\n6 1\n9 0\n"},
        {"from the other end", "9 0\n6 1\n3 1\n0 0\n"},
        {"exponents and signs", "+0 0.\n3E0 1e+0\n.6e1 +1\n90e-1 -0\n"},
    }));
    const char* const name = GENERATE("a.csv", "a.dat", "a.rail", "a", "a.prr.csv");
    INFO(scene.what << ", " << name);
    require_trapezium(profile_of(name, scene.text));
}

TEST_CASE("profile_file: lines that cannot be meant are named", "[profiles]") {
    struct Scene {
        const char *name, *text, *message;
    };
    const auto scene = GENERATE(values<Scene>({
        {"a.csv", "1,5 0,2\n2,5 0,3\n",
         "a.csv, line 1 (1,5 0,2): y and z are expected, two numbers separated by a semicolon or a tab, or with "
         "decimal points by a comma or blanks"},
        {"a.csv", "y;z\n0;0\n1,5\n", "line 3 (1,5)"},
        {"a.csv", "y;z\n0;0\n1.234,5;0\n", "line 3 (1.234,5;0)"},
        {"a.csv", "n\ty\tz\nb\t3\t1\n\t6\n", "line 3 (6)"},
        {"a.csv", "0,0\nsep=;\n", "line 2 (sep=;)"},
        {"a.csv", "0 0\n1\n", "line 2 (1): y and z are expected"},
        {"a.csv", "0,0\n1,,2\n", "line 2 (1,,2)"},
        {"a.csv", "0 0\n1 nan\n", "line 2 (1 nan)"},
        {"a.csv", "0 0\ninf 1\n", "line 2 (inf 1)"},
        {"a.csv", "0 0\n1e999 1\n", "line 2 (1e999 1)"},
        {"a.csv", "0 0\n1.5mm 1\n", "line 2 (1.5mm 1)"},
        {"a.csv", "0 0\n+-1 1\n", "line 2 (+-1 1)"},
        {"a.csv", "x,z\n0,0\n",
         "line 1 (x,z): y and z are expected, two numbers separated by a semicolon or a tab, or with decimal points "
         "by a comma or blanks, or a header that names columns y and z"},
        {"a.csv", "y,y,z\n0,0,1\n", "one column y and one column z"},
        {"a.csv", "", "a.csv: at least 4 points are expected, found: 0"},
        {"a.csv", "y,z\n", "found: 0"},
        {"a.csv", "0 0\n", "found: 1"},
        {"a.csv", "0 0\n5 0\n10 1\n", "found: 3"},
        {"a.prr", "point.begin\n0 0\n1 0\n", "points are expected between a line point.begin and a line point.end"},
        {"a.prr", "0 0\n1 1\n", "points are expected between"},
        {"a.prw", "point.begin\n0 0 ! first\n1 x\npoint.end\n", "a.prw, line 3 (1 x): y and z are expected"},
        {"a.prr", "rotate = 0.1 ! [rad]\n", "line 1 (rotate = 0.1 ! [rad]): rotate is expected to be 0"},
        {"a.prr", "mirror.y = yes\n", "mirror.y is expected to be a finite number"},
        {"a.prr", "units.len.f = 0\n", "units.len.f is expected to be positive"},
        {"a.prr", "bound.y.max = 1\nbound.y.min = 0\npoint.begin\n0 0\npoint.end\n", "cut the points instead"},
        {"a.ban", "A=1\n\n0 0\n1 0\n2 0\n3 0\nB=2\n", "a.ban, line 7 (B=2): y and z are expected"},
        {"a.ban", "A=1\n\n0 0\n1,5 0,2\n", "line 4 (1,5 0,2)"},
    }));
    CHECK_THAT(refused(scene.name, scene.text), ContainsSubstring(scene.message));
}

TEST_CASE("profile_file: what is no text is refused", "[profiles]") {
    CHECK_THAT(refused("a.csv", std::string("0 0\n\0\1\2", 7)), ContainsSubstring("bytes of 0"));
    CHECK_THAT(refused("a.csv", "\x7f\x45\x4c\x46\x01\xff\n"), ContainsSubstring("line 1"));
    CHECK_THAT(refusal([] { read_profile(std::filesystem::temp_directory_path(), Use::rail); }),
               ContainsSubstring("the file cannot be read"));
    CHECK_THAT(refusal([] { read_profile("/no/such/file.prr", Use::rail); }),
               ContainsSubstring("/no/such/file.prr: the file cannot be read"));
}

TEST_CASE("profile_file: units that make a profile too short or too long are named", "[profiles]") {
    const Profile rail = rail_60e1();
    CHECK(profile_of("m.csv", lines(rail, 1, 1, ",", 1), Use::rail, {}).length() == Approx(rail.length()));
    CHECK_THAT(
        refused("mm.csv", lines(rail), Use::rail, {}),
        ContainsSubstring("mm.csv: length along the profile = 9.388e+04 mm must lie in 5 to 500 mm: these look like "
                          "millimetres read as metres: --length-unit mm"));
    CHECK_THAT(refused("m.csv", lines(rail, 1, 1, ",", 1)),
               ContainsSubstring("must lie in 5 to 500 mm: these look like metres read as millimetres: "
                                 "--length-unit m"));
    CHECK_THAT(refused("a.csv", "0 0\n1 0\n2 0\n4.9 0\n"), ContainsSubstring("length along the profile = 4.9 mm"));
    CHECK(refused("a.csv", "0 0\n1 0\n2 0\n5.1 0\n") == "");
    // units that no option names: the length along the profile, or the width of a wheel
    for (const auto& [looks, per_metre, read_as] : {std::tuple{"micrometres read as millimetres", 1e6, 1000.0},
                                                    std::tuple{"micrometres read as metres", 1e6, 1.0},
                                                    std::tuple{"inches or centimetres read as metres", 100.0, 1.0},
                                                    std::tuple{"inches or centimetres read as metres", 39.37, 1.0}}) {
        CHECK_THAT(refused("a.csv", lines(rail, 1, 1, ",", per_metre), Use::rail, {.per_metre = read_as}),
                   ContainsSubstring(std::string("these look like ") + looks + ": convert the file"));
    }
    CHECK_THAT(refused("cm.csv", lines(s1002(), 1, 1, " ", 100), Use::wheel),
               ContainsSubstring("these look like centimetres read as millimetres: convert the file"));
    CHECK_THAT(refused("inch.csv", lines(s1002(), 1, 1, " ", 1e3 / 25.4), Use::wheel),
               ContainsSubstring("width of the wheel = 0.005116 m must lie in 0.09 to 0.18 m: these look like inches"));
}

TEST_CASE("profile_file: SIMPACK's settings apply to all points", "[profiles]") {
    const auto scene = GENERATE(values<std::pair<std::string, std::string>>({
        {"", "0 0\n3 1 9\n% 4 1\n6 1 ! c\n\n9 0\n"},
        {"units.len.f = 1.0\nbound.z.max = -2\nbound.z.min = -1\n", "0 0\n.003 .001\n.006 .001\n.009 0\n"},
        {"mirror.y = 1 ! 5\n inversion = 1\n", "0 0\n-3 1\n-6 1\n-9 0\n"},
        {"mirror.z = 1\nshift.z = 1, 2\nshift.y = +1\n", "-1 -1\n2 -2\n5 -2\n8 -1\n"},
    }));
    require_trapezium(
        profile_of("a.PRR", "header.begin\n type = 0 ! of a rail\nheader.end\nspline.begin\n comment = 'a'\n" +
                                scene.first + "point.begin\n" + scene.second + "point.end\nspline.end\n7 7 x\n"));
}

TEST_CASE("profile_file: headers of MiniProf end where points begin", "[profiles]") {
    const std::string points = "0 0 0.1 2 9e9\n3 1 0 \n6 1 0 a\n9 0 0\n";
    struct Scene {
        const char* what;
        std::string head;
    };
    const auto scene = GENERATE_COPY(values<Scene>({
        {"keys and a blank line", "A=1\nB=\n\"RefPoint1=\"\nXoffset=\nYOffset=none\n\n"},
        {"keys alone", "A=1 2\nD=08/07/2015\nColumnDef=X,Y\nXYPoints=4\n"},
        {"free lines and a blank line", "MINIPROF 101 148 1994 3 24\navg.prd\nStock.......:\n1 2 3 (Sd/Sh/qR)\n\n"},
        {"free lines alone", "MINIPROF 2020\nStock.......: \n\" 32.58 37.11 14.71\n(Sd/Sh/qR)\n"},
        {"a pair without its quote", "MINIPROF 2020\n32.58 37.11 14.71\n(Sd/Sh/qR)\n"},
        {"keys after the first blank line", "A=1\n\nB=2\n"},
        {"a comment first", "#MINIWHEELPROF\nA.whl\nCar Number..:\n\n"},
        {"free lines with numbers and a blank line", "MINIPROF 2020\n32.58 37.11 14.71\n\n"},
        {"a blank line first", "\nMINIPROF 2020\n32.58 37.11 14.71\n\n"},
        {"three lines that look like points", "MINIPROF 2020\n1 2\n3 4\n5 6\nA=1\n"},
        {"none", ""},
    }));
    INFO(scene.what);
    const ProfileFile file = read("a.WHL", scene.head + points + "\n\n");
    CHECK(file.notes.empty());
    require_trapezium(std::get<Profile>(file.curve));
}

TEST_CASE("profile_file: MiniProf's offsets are added", "[profiles]") {
    const Profile profile = profile_of("a.ban", "Xoffset=1.5\nYOffset = -2\n\n0 0\n3 1\n6 1\n9 0\n");
    CHECK(profile.y()[0] == Approx(1.5e-3));
    CHECK(profile.z()[0] == Approx(-2e-3));
}

TEST_CASE("profile_file: no block of MiniProf's points is lost", "[profiles]") {
    // neither to a blank line between points nor to a second header
    CHECK(profile_of("a.ban", "A=1\n0 0\n3 0\n6 0\n9 0\n\n12 0\n15 0\n").size() == 6);
    CHECK(profile_of("a.ban", "A=1\n0 0\n3 0\n\n6 0\n9 0\n12 0\n15 0\n").size() == 6);
    CHECK_THAT(refused("a.ban", "A=1\n0 0\n3 0\n6 0\n9 0\nB=2\n12 0\n15 0\n18 0\n21 0\n"),
               ContainsSubstring("line 6 (B=2)"));
}

TEST_CASE("profile_file: MiniProf's z is turned where the shape says so", "[profiles]") {
    const Profile wheel = s1002(), rail = rail_60e1();
    const double up = GENERATE(-1.0, 1.0);
    const auto is_turned = [](const ProfileFile& file) {
        return std::any_of(file.notes.begin(), file.notes.end(),
                           [](const std::string& note) { return note.substr(0, 9) == "z turned:"; });
    };
    const ProfileFile of_rail = read("a.ban", "A=1\n\n" + lines(rail, 1, up), Use::rail);
    CHECK(farthest(std::get<Profile>(of_rail.curve), rail) < 1e-9);
    CHECK(is_turned(of_rail) == (up < 0));
    const ProfileFile of_wheel = read("a.whl", "A=1\n\n" + lines(wheel, 1, up), Use::wheel);
    CHECK(farthest(std::get<Profile>(of_wheel.curve), wheel) < 1e-9);
    CHECK(is_turned(of_wheel) == (up < 0));

    // mirroring turns it once, and nothing else does then
    const ProfileFile mirrored = read("a.ban", "A=1\n\n" + lines(rail, 1, up), Use::piece, {.mirror_z = true});
    CHECK(std::get<Profile>(mirrored.curve).z().maxCoeff() == Approx(up < 0 ? rail.z().maxCoeff() : 0).margin(1e-6));
    CHECK(mirrored.notes == std::vector<std::string>{"z mirrored"});
    // and other formats stay
    CHECK(read("a.csv", lines(rail, 1, up)).notes.empty());

    // a groove deeper than both ends says nothing
    const Eigen::ArrayXd y{{0, 15, 30, 31, 32, 36, 40, 41, 42, 60, 75, 80}},
        z{{3, 0, 0, 15, 30, 40, 30, 15, 0, 0, 0, 1}};
    CHECK_FALSE(is_turned(read("a.ban", "A=1\n\n" + lines({y, z}, 1, up, " ", 1))));
}

TEST_CASE("profile_file: a flange is twice as high as a crest on the other side", "[profiles]") {
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(300, 0, 0.12);
    const auto with_crests = [&](double up, double down) -> Eigen::ArrayXd {
        const auto hill = [&](double at) { return (1 - ((y - at) / 0.01).square()).max(0); };
        return down * hill(0.08) - up * hill(0.03);
    };
    CHECK(detail::flange_points_up(y, with_crests(20e-3, 9e-3)));
    CHECK_FALSE(detail::flange_points_up(y, with_crests(20e-3, 11e-3)));
    CHECK_FALSE(detail::flange_points_up(y, with_crests(9e-3, 0)));
}

TEST_CASE("profile_file: mirrors are applied and noted", "[profiles]") {
    const Profile wheel = s1002();
    ProfileFile::Options how{.per_metre = 1000};
    how.mirror_y = GENERATE(false, true);
    how.mirror_z = GENERATE(false, true);
    const ProfileFile file = read("a.csv", lines(wheel, how.mirror_y ? -1 : 1, how.mirror_z ? -1 : 1), Use::wheel, how);
    CHECK(farthest(std::get<Profile>(file.curve), wheel) < 1e-9);
    std::vector<std::string> notes;
    if (how.mirror_y) notes.push_back("y mirrored");
    if (how.mirror_z) notes.push_back("z mirrored");
    CHECK(file.notes == notes);
}

TEST_CASE("profile_file: artefacts of measurement are cleaned, with a note of each", "[profiles]") {
    struct Scene {
        const char *what, *middle;
        std::vector<double> y;  // mm, of what is left of the middle
        const char* note;
    };
    const auto scene = GENERATE(values<Scene>({
        {"a repeated point",
         "8 0\n8 0.00009\n",
         {8},
         "repeated points, nearer than 0.0001 mm to the one before: 1 dropped, the first in line 6"},
        {"points that are near, not repeated", "8 0\n8.00011 0\n", {8, 8.00011}, nullptr},
        {"a zig-zag",
         "8 0\n7.6 0.01\n",
         {7.8},
         "zig-zag of 0.4 mm at y = 8, z = 0 mm, lines 5 and 6: both points became their mean"},
        {"two in a row", "8 0\n7.6 0.01\n9 0\n8.6 0\n", {7.8, 8.8}, "zig-zag of 0.4 mm at y = 9"},
        {"one within another", "8 0\n7.8 0\n7.9 0\n7.7 0\n", {7.8}, "zig-zag"},
    }));
    INFO(scene.what);
    const ProfileFile file = read("a.csv", with_middle(scene.middle));
    const Profile& profile = std::get<Profile>(file.curve);
    REQUIRE(std::size_t(profile.size()) == 7 + scene.y.size());
    for (std::size_t i = 0; i < scene.y.size(); ++i)
        CHECK(1e3 * profile.y()[4 + Eigen::Index(i)] == Approx(scene.y[i]));
    std::string notes;
    for (const std::string& note : file.notes) notes += note + "\n";
    if (scene.note == nullptr) CHECK(notes == "");
    if (scene.note != nullptr) CHECK_THAT(notes, ContainsSubstring(scene.note));
}

TEST_CASE("profile_file: short folds at an end are cut off", "[profiles]") {
    struct Scene {
        const char *what, *text;
        double first;  // y of the first point that is left [mm]
    };
    const auto scene = GENERATE(values<Scene>({
        {"a hook", "0.4 0.01\n0 0\n2 0\n4 0\n6 0\n8 0\n", 0},
        {"a hook of several points", "0.4 0.01\n0.2 0.005\n0 0\n2 0\n4 0\n6 0\n8 0\n", 0},
        {"a step back inside", "0 0\n2 0\n1.7 0.1\n2 0.3\n4 0\n6 0\n8 0\n", 1.7},
    }));
    INFO(scene.what);
    std::string text = scene.text;
    const bool reversed = GENERATE(false, true);
    if (reversed) {
        std::istringstream in(text);
        text.clear();
        for (std::string line; std::getline(in, line);) text = line + "\n" + text;
    }
    const ProfileFile file = read("a.csv", text);
    CHECK(1e3 * std::get<Profile>(file.curve).y()[0] == Approx(scene.first).margin(1e-12));
    REQUIRE(file.notes.size() == 1);
    CHECK_THAT(file.notes[0], ContainsSubstring("end folded back at y = "));
}

TEST_CASE("profile_file: what folds back, crosses itself or has a gap is refused with its place", "[profiles]") {
    struct Scene {
        const char* what;
        std::string text;
        const char* message;
    };
    const auto scene = GENERATE(values<Scene>({
        {"a fold in the middle", with_middle("8 0\n7.4 0.01\n9 0.5\n"),
         "line 5 (8 0): the curve folds back at y = 8, z = 0 mm, over 0.6 mm"},
        {"a short fold far from both ends", with_middle("8 0\n7.7 0.1\n8 0.3\n"),
         "line 5 (8 0): the curve folds back at y = 8, z = 0 mm, over 0.32 mm"},
        {"a long hook", "0.6 0\n0 0\n2 0\n4 0\n6 0\n", "line 2 (0 0): the curve folds back at y = 0, z = 0 mm, over"},
        {"a gap", "0 0\n2 0\n4 0\n24.1 0\n26 0\n",
         "line 4 (24.1 0): the next point is expected within 20 mm; this one is 20.1 mm from the point of line 3"},
        {"a loop", "0 0\n5 0\n8 3\n5 6\n2 3\n5 -3\n9 -3\n", "the curve crosses itself at y = "},
        {"a loop of three steps", "0 0\n10 0\n5 3\n8 -3\n12 -3\n", "the curve crosses itself at y = "},
        {"a closed curve", "0 0\n5 0\n5 5\n0 5\n0 0\n", "the curve crosses itself"},
        {"all points the same", "1 1\n1 1\n1 1\n1 1\n1 1\n", "at least 4 points are expected, found: 1"},
    }));
    INFO(scene.what);
    CHECK_THAT(refused("a.csv", scene.text), ContainsSubstring(scene.message));
}

TEST_CASE("profile_file: a curve that turns about the end of a segment does not cross it", "[profiles]") {
    CHECK(refused("a.csv", "0 0\n4 4\n3.6 5\n3.9 5.5\n6.5 3.6\n9 3\n") == "");
}

TEST_CASE("profile_file: smoothing goes over folds that are short beside its waves, no others", "[profiles]") {
    std::string text;
    for (double y = 0; y < 60; y += 0.5) {
        text += std::to_string(y) + " 0\n";
        if (y == 30) text += "29.4 0.1\n";
    }
    CHECK_THAT(refused("a.csv", text), ContainsSubstring("folds back"));
    CHECK_THAT(refused("a.csv", text, Use::piece, {.per_metre = 1000, .smooth = 1e-3}),
               ContainsSubstring("folds back"));
    const ProfileFile file = read("a.csv", text, Use::piece, {.per_metre = 1000, .smooth = 8e-3});
    REQUIRE(file.notes.size() == 1);
    CHECK_THAT(file.notes[0], ContainsSubstring("smoothed over waves of 8 mm: points moved by at most "));
}

TEST_CASE("profile_file: smoothing equals a profile's smoothing", "[profiles]") {
    const Profile rail = rail_60e1();
    const Profile smooth = profile_of("a.csv", lines(rail), Use::rail, {.per_metre = 1000, .smooth = 8e-3});
    CHECK(farthest(smooth, rail.smoothed(8e-3)) < 1e-9);
    CHECK(farthest(smooth, rail) > 1e-6);
}

TEST_CASE("profile_check: what cannot be a wheel is refused with the remedy", "[profiles]") {
    struct Scene {
        const char* what;
        double sign_y, sign_z, shift_y, shift_z, scale;  // of S1002; mm
        double tape_offset;
        const char* message;
    };
    const auto scene = GENERATE(values<Scene>({
        {"z up", 1, -1, 0, 0, 1, 0.07,
         "wheel: z of the flange = -0.028 m must be positive: z seems to point up: --wheel-mirror z"},
        {"a left wheel", -1, 1, 0, 0, 1, 0.07,
         "wheel: y of the flange's crown (largest z) = 0.054976 m must lie in -0.065 to -0.025 m: this seems to be a "
         "left "
         "wheel: --wheel-mirror y"},
        {"from the flange's back", 1, 1, 70, 0, 1, 0.07, "y seems to begin at the flange's back: --tape-offset 0"},
        {"from the flange's back, z up", 1, -1, 70, 0, 1, 0.07, "--tape-offset 0 --wheel-mirror z"},
        {"from the tape circle, offset 0", 1, 1, 0, 0, 1, 0, "y seems to begin at the tape circle: --tape-offset 0.07"},
        {"z from elsewhere", 1, 1, 0, 2.1, 1, 0.07,
         "z on the tape circle = 0.0021 m must lie above -0.006 m and below 0.002 m: move or cut its points, or "
         "--any-shape"},
        {"z a little beside", 1, 1, 0, 1.9, 1, 0.07, ""},
        {"as hollow as treads wear", 1, 1, 0, -5.9, 1, 0.07, ""},
        {"more hollow", 1, 1, 0, -6.1, 1, 0.07, "z on the tape circle = -0.0061 m must lie above -0.006 m"},
        {"y from elsewhere", 1, 1, -11, 0, 1, 0.07, "must lie in -0.065 to -0.025 m: move or cut its points"},
        {"inches", 1, 1, 0, 0, 1 / 25.4, 0.07, "these look like inches"},
        {"too wide", 1, 1, 0, 0, 1.5, 0.07, "width of the wheel = 0.194925 m must lie in 0.09 to 0.18 m"},
        {"metres as millimetres", 1, 1, 0, 0, 1e-3, 0.07, "these look like metres read as millimetres"},
        {"millimetres as metres", 1, 1, 0, 0, 1e3, 0.07, "these look like millimetres read as metres"},
    }));
    INFO(scene.what);
    const Profile exact = s1002();
    const Eigen::ArrayXd y = scene.scale * (scene.sign_y * exact.y() + 1e-3 * scene.shift_y),
                         z = scene.scale * (scene.sign_z * exact.z() + 1e-3 * scene.shift_z);
    const std::string message = refusal([&] { require_wheel({y, z}, scene.tape_offset); });
    CHECK_THAT(message, ContainsSubstring(scene.message));
    CHECK(message.empty() == (*scene.message == '\0'));
    CHECK(refusal([&] { require_wheel({y, z, Use::piece}, scene.tape_offset); }) == "");
}

TEST_CASE("profile_check: a low flange and a rail cut at its top are refused, the rim's lower side is not",
          "[profiles]") {
    const Profile wheel = s1002(), rail = rail_60e1();
    const Profile low(wheel.y(), 0.35 * wheel.z());
    CHECK_THAT(refusal([&] { require_wheel(low, 0.07); }),
               ContainsSubstring("z of the flange's crown (largest z) = 0.0098 m must be at least 0.01 m"));
    Eigen::Index top = 0;
    rail.z().minCoeff(&top);
    const Eigen::ArrayXd wide = 1.2 * rail.y();
    const Profile before(wide.head(top + 1), rail.z().head(top + 1)),
        after(wide.tail(rail.size() - top), rail.z().tail(rail.size() - top));
    for (const Profile& half : {before, after}) {
        CHECK_THAT(refusal([&] { require_rail(half); }), ContainsSubstring("y of the rail's top (least z)"));
    }
    // 60 mm from the tread, which passes the tape circle a second time
    Eigen::ArrayXd y(wheel.size() + 3), z(y.size());
    y << 0.02, -0.06, wheel.y()[0] - 1e-3, wheel.y();
    z << -0.06, -0.06, -0.03, wheel.z();
    CHECK(refusal([&] { require_wheel({y, z}, 0.07); }) == "");
}

TEST_CASE("profile_check: a remedy for a wheel is one", "[profiles]") {
    const Profile exact = s1002();
    const double sign_y = GENERATE(1, -1), sign_z = GENERATE(1, -1), shift = GENERATE(0.0, 0.07);
    const bool back = GENERATE(false, true);  // --tape-offset 0 is given
    const Profile wheel(sign_y * (exact.y() + shift), sign_z * exact.z());
    const std::string message = refusal([&] { require_wheel(wheel, back ? 0 : 0.07); });
    const auto says = [&](const char* text) { return message.find(text) != std::string::npos; };
    const bool y = says("--wheel-mirror y"), z = says("--wheel-mirror z") || says("--wheel-mirror yz");
    const double offset = says("--tape-offset 0.07") ? 0.07 : says("--tape-offset 0") || back ? 0 : 0.07;
    CAPTURE(sign_y, sign_z, shift, back, message);
    const Profile mended((y ? -1 : 1) * wheel.y(), (z ? -1 : 1) * wheel.z());
    CHECK(refusal([&] { require_wheel(mended, offset); }) == "");
    CHECK(y == (sign_y < 0));
    CHECK(z == (sign_z < 0));
    CHECK(offset == (shift > 0 ? 0 : 0.07));
}

TEST_CASE("profile_check: what cannot be a rail is refused with the remedy", "[profiles]") {
    const Profile rail = rail_60e1();
    const auto of = [&](double scale, double sign_z, double shift_z, Use use = Use::rail) {
        return refusal([&] { require_rail({scale * rail.y(), scale * (sign_z * rail.z() + shift_z), use}); });
    };
    CHECK(of(1, 1, 0) == "");
    CHECK(of(1, 1, 9.9e-3) == "");
    CHECK(of(1, 1, -9.9e-3) == "");
    CHECK_THAT(of(1, 1, 10.1e-3),
               ContainsSubstring("rail: z of the rail's top (least z) = 0.0101 m must lie within 0.01 m of 0: move"));
    CHECK_THAT(of(1, -1, 0), ContainsSubstring("z seems to point up: --rail-mirror z"));
    CHECK(of(1, -1, 0, Use::piece) == "");
    CHECK_THAT(of(1 / 25.4, 1, 0), ContainsSubstring("these look like inches"));
    CHECK_THAT(of(3, 1, 0), ContainsSubstring("width of the rail = 0.217132 m must lie in 0.03 to 0.2 m"));
    // a crown alone, 1 mm high, z up
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(41, -0.02, 0.02), z = y.square() / 0.4;
    CHECK(refusal([&] { require_rail({y, z}); }) == "");
    CHECK_THAT(refusal([&] { require_rail({y, -z}); }), ContainsSubstring("z seems to point up"));
}

TEST_CASE("profile_file: wheels and rails are checked, pieces are not", "[profiles]") {
    const std::string up = lines(s1002(), 1, -1);
    CHECK_THAT(refused("a.csv", up, Use::wheel), ContainsSubstring("a.csv: wheel: z of the flange = -0.028 m"));
    CHECK_THAT(refused("a.csv", up, Use::rail), ContainsSubstring("a.csv: rail: "));
    CHECK(refused("a.csv", up, Use::piece) == "");
    CHECK(profile_of("a.csv", up).is_piece());
    CHECK_FALSE(profile_of("a.csv", lines(s1002()), Use::wheel).is_piece());
}

TEST_CASE("profile_file: a flange's back beside its place is doubted, where the file reaches it", "[profiles]") {
    struct Scene {
        const char* what;
        double shift, from, tape_offset;  // of S1002; its points from this y on; mm
        const char* doubt;
    };
    const auto scene = GENERATE(values<Scene>({
        {"S1002", 0, -100, 70, ""},
        {"a little beside", -1.9, -100, 70, ""},
        {"5 mm beside", -5, -100, 70,
         "y of the flange's back = -0.075 m, which --tape-offset 0.07 puts at -0.07 m: --tape-offset 0.075 where"},
        {"outwards", 3, -100, 70, "--tape-offset 0.067 where"},
        {"from the flange's back", 70, -100, 0, ""},
        {"5 mm from it", 75, -100, 0, "m, which --tape-offset 0 puts at 0 m: --tape-offset -0.005"},
        {"a part of the flange", -5, -72, 70, ""},
    }));
    INFO(scene.what);
    const Profile wheel = s1002().moved(0, 1e-3 * scene.shift, 0);
    const Eigen::Index n = (wheel.y() >= 1e-3 * scene.from).count();
    const std::string text = lines({wheel.y().tail(n), wheel.z().tail(n)});
    const ProfileFile::Options how{.per_metre = 1000, .tape_offset = 1e-3 * scene.tape_offset};
    const ProfileFile file = read("a.csv", text, Use::wheel, how);
    CHECK(file.notes.empty());
    REQUIRE(file.doubts.size() == (*scene.doubt != '\0'));
    if (!file.doubts.empty()) CHECK_THAT(file.doubts[0], ContainsSubstring(scene.doubt));
    CHECK(read("a.csv", text, Use::piece, how).doubts.empty());
}

TEST_CASE("profile_file: noise from point to point is doubted, with a wave length that smooths it", "[profiles]") {
    struct Scene {
        double noise, distance;  // of points [mm]
        bool doubted;
    };
    const auto [noise, distance, doubted] = GENERATE(values<Scene>({{0, 0.25, false},
                                                                    {5e-5, 0.25, false},
                                                                    {3e-3, 0.25, true},
                                                                    {3e-3, 0.5, true},
                                                                    {2e-3, 2, true},
                                                                    {1e-3, 8, false}}));
    CAPTURE(noise, distance);
    std::mt19937 random(5);
    std::normal_distribution<double> normal(0, 1e-3 * noise);
    const auto count = Eigen::Index(80 / distance) + 1;
    const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(count, -0.04, 0.04);
    const auto crown = [](double at) { return at * at / 0.6; };
    const Eigen::ArrayXd z = y.unaryExpr([&](double at) { return crown(at) + (noise > 0 ? normal(random) : 0); });
    const auto found = [&](Eigen::Index of) { return detail::median_noise(y.head(of), z.head(of)).size; };
    if (count > 100) CHECK(found(count) == Approx(1e-3 * noise).epsilon(0.25).margin(1e-12));
    CHECK(found(8) == 0);
    const std::string text = lines({y, z, Use::piece});
    const ProfileFile file = read("a.csv", text);
    CHECK(file.notes.empty());
    REQUIRE(file.doubts.size() == (doubted ? 1 : 0));
    if (!doubted) return;
    const std::string option = "--smooth ";
    const double wave_length = std::stod(file.doubts[0].substr(file.doubts[0].find(option) + option.size()));
    // what it leaves bends the curve by less than a rail's head is bent, half of it leaves more
    const auto bend = [&](double smooth) {
        const ProfileFile of = read("a.csv", text, Use::piece, {.per_metre = 1000, .smooth = smooth});
        CHECK((smooth < wave_length || of.doubts.empty()));
        const Eigen::ArrayXd off = std::get<Profile>(of.curve).z() - y.unaryExpr(crown);
        const Eigen::Index middle = count / 2, from = count / 4;
        const Eigen::ArrayXd bends =
            (off.segment(from + 1, middle) - 2 * off.segment(from, middle) + off.segment(from - 1, middle)) /
            std::pow(1e-3 * distance, 2);
        return std::sqrt(bends.square().mean());
    };
    CHECK(bend(wave_length) < 3);
    // waves of twice the distance of points are gone
    const double least = 4e-3 * distance;
    CHECK(wave_length > 0.999 * least);
    const bool is_least = wave_length < least + 1.001e-3;
    CHECK(is_least == (distance == 2));
    if (!is_least) CHECK(bend(wave_length / 2) > 3);
    // sections are read in the same way
    const ProfileFile sections = read_profile(
        folder().write("rough.slcs", "0 1\n2\n0\n1\n0 \"a.csv\"\n1000 \"a.csv\"\n"), Use::rail, {.per_metre = 1000});
    REQUIRE(sections.doubts.size() == 1);
    CHECK(sections.doubts[0] == "section 1: " + file.doubts[0]);
}

TEST_CASE("surface_file: a rail that is canted unasked is doubted", "[profiles]") {
    const auto path = folder().write("rail.csv", lines(rail_60e1(0), 1, 1, ",", 1));
    const ProfileFile::Rail usual = open_rail(path), asked = open_rail(path, {}, {.cant = 0.025});
    REQUIRE(usual.doubts.size() == 1);
    CHECK(usual.doubts[0] == "turned inwards by 1:40: --cant 0 if the profile is canted already");
    CHECK(asked.doubts.empty());
    CHECK(open_rail("60e1").doubts.empty());
    CHECK(usual.surface.profile().moved(std::atan(1 / 40.0), 0, 0).z().minCoeff() == Approx(0).margin(1e-8));
}

TEST_CASE("profile_file: sections and their features", "[profiles]") {
    folder().write("parts/flat.csv", "0 0\n5 0\n10 0\n15 0\n");
    folder().write("parts/low.csv", "0 2\n5 2\n10 2\n15 2\n");
    const std::string head = "% a ramp\n\n 5. 2  offset, scale\n 4 sections\n";
    const std::string files =
        " 0 'parts/flat.csv' ! first\n 10 \"parts\\low.csv\"\n20.0 'parts/flat.csv'\n30 'parts/flat.csv'\n";
    const ProfileFile file = read("a.slcs", head + "3 0 0 features, kinks\n1 through\n" + files +
                                                "0 0. 5 10\n10 -1 5\n999\n20 0 2.5 7.5\n30 0 2 7\n");
    const Sections& sections = std::get<Sections>(file.curve);
    REQUIRE(sections.parts() == 2);
    CHECK(sections.interpolation() == Sections::Interpolation::through);
    CHECK(sections.first() == Approx(10e-3));
    CHECK(sections.last() == Approx(70e-3));
    CHECK(sections.sections()[1].features == std::vector<double>{-1, 5e-3, 999e-3});
    CHECK_FALSE(sections.covers(0, 0.02));
    CHECK(sections.covers(0, 0.06));
    CHECK(sections.covers(1, 0.02));
    CHECK(sections.at(1, 0, 0.03).z == Approx(2e-3));

    const ProfileFile whole = read("a.slcw", "0 1\n2\n0\n2\n-0.1 'parts/flat.csv'\n0.3 'parts/low.csv'\n");
    CHECK(std::get<Sections>(whole.curve).parts() == 1);
    CHECK(std::get<Sections>(whole.curve).first() == Approx(-0.1));
    CHECK(std::get<Sections>(whole.curve).interpolation() == Sections::Interpolation::spline);
}

TEST_CASE("profile_file: features count from the first point, on a rail the point of least y after mirroring",
          "[profiles]") {
    folder().write("up.csv", "0 0\n5 0\n10 0\n15 1\n");
    folder().write("down.csv", "15 1\n10 0\n5 0\n0 0\n");
    const std::string name = GENERATE("up.csv", "down.csv");
    const bool rail = GENERATE(true, false), mirror = GENERATE(false, true);
    const std::string ending = rail ? "a.slcs" : "a.slcw";
    const auto file = read(ending, "0 1\n2\n2\n1\n0 '" + name + "'\n1 '" + name + "'\n0 0 4\n1 0 4\n", Use::piece,
                           {.per_metre = 1000, .mirror_y = mirror});
    const Sections& sections = std::get<Sections>(file.curve);
    const double begin = sections.at(0, 0, sections.first()).y,
                 end = sections.at(0, sections.length(0), sections.first()).y;
    const double least = mirror ? -15e-3 : 0, most = mirror ? 0 : 15e-3;
    const bool from_least = rail || (name == "up.csv") != mirror;
    CAPTURE(name, rail, mirror, begin, end);
    if (from_least) CHECK(begin == Approx(least).margin(1e-12));
    if (!from_least) CHECK(end == Approx(most).margin(1e-12));
    CHECK(begin < end);
}

TEST_CASE("profile_file: sections that cannot be meant are refused with the line", "[profiles]") {
    folder().write("s.csv", "0 0\n5 0\n10 0\n15 0\n");
    folder().write("bad.csv", "0 0\n5 x\n");
    struct Scene {
        const char *text, *message;
    };
    const auto scene = GENERATE(values<Scene>({
        {"", "offset and scale of u are expected, and the file has ended"},
        {"0 x\n", "line 1 (0 x): offset and scale of u are expected"},
        {"0 1\n1\n", "line 2 (1): at least 2 sections are expected"},
        {"0 1\n2.5\n", "at least 2 sections are expected"},
        {"0 1\n2\n-1\n", "line 3 (-1): the number of features is expected"},
        {"0 1\n2\n3 1 0\n", "no kinks and no accelerations are expected"},
        {"0 1\n2\n0\n3\n", "line 4 (3): the interpolation is expected, 1 (through sections) or 2 (B-spline)"},
        {"0 1\n2\n0\n1 1\n", "files with perturbations are not supported"},
        {"0 1\n2\n0\n1\n0 s.csv\n", "line 5 (0 s.csv): u of a section and the name of its file in quotes"},
        {"0 1\n2\n0\n1\n's.csv'\n", "line 5 ('s.csv'): u of a section"},
        {"0 1\n2\n0\n1\n0 's.csv'\n0 's.csv'\n", "line 6 (0 's.csv'): u is expected to increase"},
        {"0 -1\n2\n0\n1\n0 's.csv'\n1 's.csv'\n", "u is expected to increase"},
        {"0 1\n3\n0\n1\n0 's.csv'\n1 's.csv'\n", "in quotes are expected, and the file has ended"},
        {"0 1\n99999999999\n0\n1\n0 's.csv'\n1 's.csv'\n", "and the file has ended"},
        {"0 1\n2\n0\n1\n0 's.csv'\n1 's.csv'\n2 's.csv'\n", "line 7 (2 's.csv'): the end of the file is expected"},
        {"0 1\n2\n0\n1\n0 's.csv'\n1 'none.csv'\n", "none.csv: the file cannot be read"},
        {"0 1\n2\n0\n1\n0 's.csv'\n1 'bad.csv'\n", "bad.csv, line 2 (5 x)"},
        {"0 1\n2\n0\n1\n0 's.csv'\n1 'a.slcs'\n", "line 6 (1 'a.slcs'): a file with one profile is expected"},
        {"0 1\n2\n2\n1\n0 's.csv'\n1 's.csv'\n0 0 5\n", "and the file has ended"},
        {"0 1\n2\n2\n1\n0 's.csv'\n1 's.csv'\n0 0 5 6\n", "line 7 (0 0 5 6): u of a section and 2 lengths"},
        {"0 1\n2\n2\n1\n0 's.csv'\n1 's.csv'\n1 0 5\n0 0 5\n", "line 7 (1 0 5): features are expected in the order"},
        {"0 1\n2\n2\n1\n0 's.csv'\n1 's.csv'\n0 5 4\n1 0 5\n",
         "a.slcs: Sections: length of a feature of section 1 = 0.004"},
    }));
    CHECK_THAT(refused("a.slcs", scene.text), ContainsSubstring(scene.message));
    folder().write("up.ban", lines(rail_60e1(), 1, -1));
    folder().write("down.ban", lines(rail_60e1()));
    CHECK_THAT(refused("a.slcs", "0 1\n2\n0\n1\n0 'up.ban'\n1 'down.ban'\n", Use::rail),
               ContainsSubstring("line 6 (1 'down.ban'): sections with z in one direction are expected"));
    CHECK_THAT(refused("a.slcs", "", Use::wheel), ContainsSubstring("sections along the track are of a rail"));
    CHECK_THAT(refused("a.slcw", "", Use::rail), ContainsSubstring("sections round the wheel are of a wheel"));
}

// 1 s, so hidden
TEST_CASE("profile_file: a million lines are read", "[.][profiles]") {
    std::string text;
    for (int i = 0; i < 1000000; ++i) text += std::to_string(2e-4 * i) + " 0\n";
    CHECK(profile_of("long.csv", text).size() == 1000000);
}

/// Reads files with a few characters changed: each is a curve, or refused with one line that names the file.
void read_changed_files(int count) {
    folder().write("s.csv", "0 0\n5 0\n10 0\n15 0\n");
    const std::vector<std::pair<std::string, std::string>> files{
        {"f.csv", "y,z\n" + with_middle("8 0\n7.6 0.01\n8.5 2\n")},
        {"f.prr", "mirror.y = 1\nunits.len.f = 1000.\npoint.begin\n" + with_middle("8,1\n") + "point.end\n"},
        {"f.ban", "A=1\nXoffset=3\n\n" + with_middle("8 1 5\n")},
        {"f.whl", "MINIPROF 1\n1 2 (Sd/Sh/qR)\n" + with_middle("8 4\n")},
        {"f.slcs", "0 1\n3\n3 0\n1\n0 's.csv'\n1 's.csv'\n2.5 's.csv'\n0 0 5 10\n1 -1 5 10\n2.5 0 5 99\n"}};
    const std::string pieces[] = {"0",   "-", ".",  ",", ";", " ",  "\n",   "e9",
                                  "nan", "'", "\"", "%", "=", "\r", "\xff", "7 7\n"};
    drawn::Draw draw(std::getenv("ROLLBEM_SEED") != nullptr ? std::stoul(std::getenv("ROLLBEM_SEED")) : 55);
    int read_count = 0, refused_count = 0;
    for (int k = 0; k < count; ++k) {
        auto [name, text] = files[std::size_t(draw.integer(int(files.size())))];
        for (int change = 1 + draw.integer(4); change > 0; --change) {
            const std::size_t at = std::size_t(draw.integer(int(text.size()) + 1)),
                              length = std::size_t(draw.integer(4));
            if (draw.one_in(2)) text.insert(at, pieces[draw.integer(int(std::size(pieces)))]);
            if (draw.one_in(2)) text.erase(at, length);
            if (draw.one_in(4)) text.insert(at, text.substr(std::size_t(draw.integer(int(text.size()) + 1)), 12));
        }
        ProfileFile::Options how{.per_metre = 1000, .mirror_y = draw.one_in(2), .mirror_z = draw.one_in(2)};
        if (draw.one_in(3)) how.smooth = draw.decades(1e-5, 1);
        INFO(name << ":\n" << text);
        try {
            const ProfileFile file = read(name, text, Use::piece, how);
            if (const auto* profile = std::get_if<Profile>(&file.curve)) {
                REQUIRE(std::isfinite(profile->at(profile->length() / 2).z));
            } else {
                const Sections& sections = std::get<Sections>(file.curve);
                REQUIRE(std::isfinite(sections.at(0, sections.length(0) / 2, sections.first()).z));
            }
            ++read_count;
        } catch (const std::invalid_argument& error) {
            const std::string message = error.what();
            REQUIRE(message.find('\n') == std::string::npos);
            REQUIRE((message.find(name) != std::string::npos || message.find("s.csv") != std::string::npos ||
                     name == "f.slcs"));
            ++refused_count;
        }
    }
    CHECK(read_count > count / 10);
    CHECK(refused_count > count / 10);
}

TEST_CASE("profile_file: any change of a file is read or refused", "[profiles]") { read_changed_files(60); }
TEST_CASE("profile_file: many changes of files are read or refused", "[.][profiles]") { read_changed_files(20000); }

}  // namespace
