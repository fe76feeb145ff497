#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <rollbem/normal/hertz.hpp>
#include <rollbem/normal/pressure.hpp>
#include <rollbem/steady/creep_coefficients.hpp>

#include "patch.hpp"
#include "support/input.hpp"

namespace patch {

namespace {

using study::array, study::Numbers;
using Contact = rollbem::PatchContact;
using Mesh = rollbem::Mesh<double>;
using Outline = rollbem::PatchContact::Outline;

constexpr std::ptrdiff_t most_elements = 10000;

Outline read_outline(const study::Options& options) {
    std::vector<std::string> places;  // of rows in the file
    const std::vector<Numbers> columns =
        study::read_columns(options, "outline", "y,x_trailing,x_leading", "",
                            [&](const auto&, const std::string& where) { places.push_back(where); });
    try {
        return {array(columns[0]), array(columns[1]), array(columns[2])};
    } catch (const std::invalid_argument& error) {
        const std::string text = error.what(), of_line = " of line ";  // counted below the header
        const std::size_t found = text.find(of_line);
        if (found == std::string::npos) throw study::BadInput(options.said("outline") + ": " + text);
        throw study::BadInput(places[std::stoul(text.substr(found + of_line.size())) - 1] + ": " +
                              text.substr(0, found) + text.substr(text.find(" = ", found)));
    }
}

/// The schemes of --scheme, or of --method, --nodes and --strip-grading.
std::vector<study::NamedScheme> make_schemes(const study::Options& options) {
    if (options.given("scheme")) {
        std::vector<study::NamedScheme> schemes = study::named_schemes(options.texts("scheme"), true);
        for (const study::NamedScheme& scheme : schemes) {
            if (scheme.richardson)
                throw study::BadInput("--scheme = " + scheme.word() +
                                      " must be one mesh here: precision_study extrapolates on patches");
        }
        return schemes;
    }
    study::NamedScheme scheme{.method = options.choice("method", {"nodes"}), .mesh_name = "cosine"};
    scheme.nodes = options.choice("nodes", {"centres", "chebyshev"});
    const std::string grading = options.choice("strip-grading", {"cosine", "uniform"});
    scheme.strips = options.given("strip-edges") ? "edges" : grading;
    return {scheme};
}

/// The strips across the height low ... high: --strip-edges, or one mesh for each of `counts`.
std::vector<Mesh> make_strips(const study::Options& options, double low, double high, bool cosine,
                              const std::vector<std::ptrdiff_t>& counts) {
    if (options.given("strip-edges")) {
        const auto end = [](double y, const char* which) { return study::Cell(y).text(12) + ", the " + which + " y"; };
        const Numbers edges =
            study::read_edges(options, "strip-edges", low, high, end(low, "smallest"), end(high, "largest"));
        return {rollbem::mesh_from_edges(array(edges))};
    }
    std::vector<Mesh> strips;
    for (const std::ptrdiff_t m : counts) {
        strips.push_back(cosine ? rollbem::cosine_mesh(m) : rollbem::uniform_mesh(m));
    }
    return strips;
}

}  // namespace

std::string Patch::label() const {
    return "n = " + std::to_string(mesh.elements_per_strip()) + ", strips = " + std::to_string(mesh.strip_count());
}

void add_options(study::Options& options) {
    options.group("Patch");
    options.add("a-over-b", "LIST",
                "ratio of an ellipse's semi-axes [dimensionless], a along the rolling direction, 1e-6 to 1e6", "1");
    options.add_input(
        "outline",
        "CSV file of the outline of any patch, in place of an ellipse, with the columns y,x_trailing,x_leading [any "
        "unit of length], y increasing, straight between the rows; a, b and c are then sqrt(area/pi)");
    options.not_with({"a-over-b"}, "outline");
    options.add(
        "layer", "L",
        "compliance h_3/G_3 of an elastic layer between the bodies (thickness over shear modulus) [c/G], 0 or more",
        "0");
    options.add("strips", "LIST",
                "number of strips along the rolling direction [dimensionless], 1 to 10000; default: --n");
    options.add("strip-grading", "NAME",
                "spacing of the strips' edges: cosine, at -cos(pi j/m) of the half height, or uniform", "cosine");
    options.add_input("strip-edges",
                      "file of the strips' edges, one per line, in place of --strips: y/b [dimensionless] from -1 to "
                      "1, or y of the outline [its unit]");
    options.not_with({"strips", "strip-grading"}, "strip-edges");

    options.set_default("n", "8,12,16");
    options.set_help("n", "number of elements in each strip [dimensionless], 1 to 10000");
    options.set_default("method", "nodes");
    options.set_help("method",
                     "method of discretisation: nodes (differences between the --nodes of neighbouring elements)");
    options.set_default("nodes", "chebyshev");
    options.set_help("nodes", "positions of the nodes: chebyshev points, or centres of the elements");
    options.refuse_group("Discretisation", "each strip has the cosine mesh, and rows between nodes",
                         {"n", "method", "nodes", "scheme"});
    options.set_help("scheme",
                     "names of schemes, MESH:METHOD[:STRIPS], in place of --method, --nodes and --strip-grading: "
                     "cosine:nodes or cosine:nodes-chebyshev, then :cosine-strips (default) or :uniform-strips");
    options.not_with({"strip-grading", "strip-edges"}, "scheme");
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is wide and long: --a-over-b");
}

namespace {

/// One ellipse in SI units.
struct SiScene {
    double load, mu, a, b, shear_modulus;
    std::vector<double> creepage;
};

/// Throws BadInput.
SiScene read_si(const study::Options& options) {
    for (const char* name : {"normal-load", "friction", "half-length", "half-width", "shear-modulus"}) {
        options.require(options.given(name), "creepage", std::string("go with --") + name);
    }
    const auto positive = [&](const char* name) { return options.number(name, study::positive()); };
    SiScene scene{positive("normal-load"),
                  positive("friction"),
                  positive("half-length"),
                  positive("half-width"),
                  options.number("shear-modulus", study::shear_modulus()),
                  options.row("creepage", 3)};
    options.require(!scene.creepage.empty(), "creepage",
                    "be three numbers with commas between them: xi, eta, phi [1/m]");
    options.require(study::between(1e-6, 1e6).holds(scene.a / scene.b), "half-length",
                    "be 1e-6 to 1e6 times --half-width");
    const double pressure = 1.5 * scene.load / (std::numbers::pi * scene.a * scene.b);
    options.require(pressure < scene.shear_modulus, "normal-load",
                    "be in N, --half-length and --half-width in m: the largest pressure, " +
                        study::Cell(pressure).text(3) + " Pa, is above --shear-modulus");
    return scene;
}

Numbers read_ratios(const study::Options& options) {
    if (!options.given("creepage")) return options.numbers("a-over-b", study::between(1e-6, 1e6));
    const SiScene scene = read_si(options);
    return {scene.a / scene.b};
}

}  // namespace

std::vector<Patch> read_patches(const study::Options& options) {
    const std::vector<study::NamedScheme> schemes = make_schemes(options);
    const Numbers poisson = options.numbers("poisson", study::between(0, 0.5));
    const double layer = options.number("layer", study::not_negative());
    std::optional<Outline> outline;
    std::vector<Contact> contacts;
    if (options.given("outline")) {
        outline = read_outline(options);
    }
    for (const double ratio : outline ? Numbers{1} : read_ratios(options)) {
        for (const double nu : poisson) {
            contacts.push_back(outline ? Contact(*outline, 1, nu) : Contact::dimensionless(ratio, nu));
        }
    }
    const std::vector<std::ptrdiff_t> numbers = options.integers("n", 1, most_elements);
    std::vector<std::ptrdiff_t> counts;
    if (options.given("strips")) counts = options.integers("strips", 1, most_elements);
    std::vector<Patch> patches;
    const double low = outline ? outline->low() : -1, high = outline ? outline->high() : 1;
    const auto add = [&](std::ptrdiff_t n, const study::NamedScheme& scheme, const Mesh& across) {
        if (n * across.size() > most_elements) {
            throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(across.size()) +
                                  " strips must be at most " + std::to_string(most_elements));
        }
        for (const Contact& contact : contacts) {
            patches.push_back({contact, rollbem::patch_mesh(contact, rollbem::cosine_mesh(n), across), across,
                               *scheme.equations().get_if<rollbem::NodeDifference>(), scheme, layer});
        }
    };
    for (const std::ptrdiff_t n : numbers) {
        for (const study::NamedScheme& scheme : schemes) {
            const std::vector<std::ptrdiff_t> strips = counts.empty() ? std::vector{n} : counts;
            for (const Mesh& across : make_strips(options, low, high, scheme.strips == "cosine", strips)) {
                add(n, scheme, across);
            }
        }
    }
    return patches;
}

study::Cell scene_cell(const Patch& patch, const std::string& column) {
    if (column == "poisson") return patch.contact.poisson_ratio();
    if (column == "n") return patch.mesh.elements_per_strip();
    if (column == "strips") return patch.mesh.strip_count();
    if (column == "nodes") return patch.named.nodes;
    if (column == "scheme") return patch.named.word();
    if (column == "layer") return patch.layer;
    return patch.contact.outline() ? study::Cell() : study::Cell(patch.contact.a_over_b());
}

// --- pressures

namespace {

/// The grid of --pressure, whose rows may have any order.
rollbem::PressureGrid read_grid(const study::Options& options) {
    std::map<std::pair<double, double>, double> points;
    const std::vector<study::Numbers> columns =
        study::read_columns(options, "pressure", "x,y,pressure", "", [&](const auto& read, const std::string& where) {
            if (read[2].back() < 0) throw study::BadInput(where + ": pressure must not be negative");
            if (!points.emplace(std::pair(read[0].back(), read[1].back()), read[2].back()).second) {
                throw study::BadInput(where + " must not be the second row at this place");
            }
        });
    const auto different = [](study::Numbers numbers) {
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
        return array(numbers);
    };
    const Eigen::ArrayXd x = different(columns[0]), y = different(columns[1]);
    Eigen::MatrixXd pressures(x.size(), y.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        for (Eigen::Index j = 0; j < y.size(); ++j) {
            const auto point = points.find({x[i], y[j]});
            options.require(point != points.end(), "pressure",
                            "have a row at x = " + study::Cell(x[i]).text(6) + ", y = " + study::Cell(y[j]).text(6) +
                                ": its points must make a grid");
            pressures(i, j) = point->second;
        }
    }
    return study::blame(options.said("pressure"), [&] { return rollbem::PressureGrid(x, y, std::move(pressures)); });
}

/// The mean pressures on the elements by a grid that the options `said`, which measures an ellipse in a
/// and b, an outline in its own unit.
Eigen::ArrayXd means_of(const rollbem::PressureGrid& grid, const std::string& said, const Patch& patch) {
    const double a = patch.contact.half_length(), b = patch.contact.half_width();
    const bool outline = patch.contact.outline() != nullptr;
    std::vector<rollbem::PatchMesh<double>::Rectangle> elements = patch.mesh.rectangles(a);
    for (rollbem::PatchMesh<double>::Rectangle& element : elements) {
        if (!outline) element = {element.x_1 / a, element.x_2 / a, element.y_1 / b, element.y_2 / b};
    }
    const Eigen::ArrayXd means = grid(elements);
    double load = 0, area = 0, covered = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        const auto& [x_1, x_2, y_1, y_2] = elements[i];
        const auto overlap = [](double low, double high, const Eigen::ArrayXd& places) {
            return std::max(0.0, std::min(high, places[places.size() - 1]) - std::max(low, places[0]));
        };
        load += means[Eigen::Index(i)] * (x_2 - x_1) * (y_2 - y_1);
        area += (x_2 - x_1) * (y_2 - y_1);
        covered += overlap(x_1, x_2, grid.x()) * overlap(y_1, y_2, grid.y());
    }
    const auto require = [&](const std::string& what, double share, double least) {
        if (share >= least) return;
        throw study::BadInput(said + ": the share of " + what + " = " + study::Cell(share).text(3) +
                              " must be at least " + study::Cell(least).text() + "; x and y are " +
                              (outline ? "in the unit of the outline" : "in a and b, from -1 to 1"));
    };
    require("its load on the patch", load / grid.integral(), 0.5);
    require("the patch that it covers", covered / area, 0.9);
    return means * (outline ? a * b : 1) / load;
}

/// Throws BadInput, also if an outline has no --pressure.
Pressure read_pressure(const study::Options& options) {
    const std::string said = options.said("pressure");
    if (options.given("pressure")) {
        return [said, grid = read_grid(options)](const Patch& patch) { return means_of(grid, said, patch); };
    }
    options.require(!options.given("outline"), "outline",
                    "go with --pressure for friction: Hertz's contact is an ellipse");
    return [](const Patch& patch) { return rollbem::hertz_pressures(patch.contact, patch.mesh, mu_N(patch)); };
}

/// Throws BadInput if a patch would gain energy from rolling with spin.
void require_no_gain(const study::Options& options, const std::vector<Patch>& patches) {
    for (const Patch& patch : patches) {
        // moments take the tractions at the middles of elements, slip is taken elsewhere in them: creep work
        // without slip, a quadratic form, may become negative where elements are few
        const auto steady = rollbem::solve_steady(patch.mesh, patch.scheme, patch.kernel());
        const Eigen::Matrix3d C = steady.coefficients;
        options.require(steady.status != rollbem::Status::ok ||
                            Eigen::LLT<Eigen::Matrix3d>(C + C.transpose()).info() == Eigen::Success,
                        options.given("spin")       ? "spin"
                        : options.given("creepage") ? "creepage"
                                                    : "history",
                        "go with more elements or strips than " + patch.label() + ": rolling could gain energy");
    }
}

/// All creepages, longitudinal outermost.
std::vector<CreepPoint> read_points(const study::Options& options, const std::vector<Patch>& patches) {
    const study::Rule rule = study::between(-1e6, 1e6);
    std::vector<CreepPoint> points;
    for (const double longitudinal : options.numbers("longitudinal", rule)) {
        for (const double lateral : options.numbers("lateral", rule)) {
            for (const double spin : options.numbers("spin", rule)) points.push_back({longitudinal, lateral, spin});
        }
    }
    const auto spins = [](const CreepPoint& point) { return point.spin != 0; };
    if (std::any_of(points.begin(), points.end(), spins)) require_no_gain(options, patches);
    return points;
}

}  // namespace

// --- friction

void add_friction_options(study::Options& options) {
    options.group("Friction");
    options.add("longitudinal", "LIST",
                "longitudinal creepage xi G a b/(mu N) [dimensionless], -1e6 to 1e6, for friction in place of creep "
                "coefficients",
                "0");
    options.add("lateral", "LIST", "lateral creepage eta G a b/(mu N) [dimensionless], -1e6 to 1e6, for friction", "0");
    options.add("spin", "LIST", "spin phi G a b c/(mu N) [dimensionless], -1e6 to 1e6, for friction", "0");
    study::add_force(options, history_columns);
    options.add_input("pressure",
                      "CSV file of the normal pressure under friction, with the columns x,y,pressure [any unit], whose "
                      "rows make a grid in any order: bilinear between them, zero outside; x and y in a and b, of an "
                      "outline in its unit; Hertz's pressure without it, of an ellipse");
    study::add_friction_laws(options);
    options.set_help(
        "memory",
        "memory of friction: distance D of slip [c mu_0 p_0/G], above 0, within which mu follows its law, "
        "passed at a velocity of at least V0 [V mu_0 p_0/G], 0 or more; mu follows its law at once without "
        "it");
    options.add_table("tractions",
                      "CSV file of the tractions of steady friction, one row per element, with FILE.toml next to it; "
                      "none without it");
}

std::vector<std::string> ways_of_friction() {
    return {"longitudinal", "lateral", "spin", "step", "ramp", "sine", "history", "force", "creepage"};
}

/// Declares one ellipse in SI units, in place of ratios.
void add_si_options(study::Options& options) {
    options.group("One ellipse in SI units");
    options.add("creepage", "XI,ETA,PHI",
                "creepages [dimensionless] and spin [1/m] for friction, in place of ratios; the forces in N and N m");
    for (const char* ratio : {"a-over-b", "outline", "longitudinal", "lateral", "spin", "step", "ramp", "sine",
                              "history", "force", "transient", "stability", "omega", "state-space"}) {
        options.not_with({ratio}, "creepage");
    }
    const std::vector<std::string> with{"creepage"};
    options.add("normal-load", "N", "load of the ellipse [N], above 0").only_with(with);
    options
        .add("friction", "MU",
             "coefficient of friction [dimensionless], above 0; mu_0 with " + study::friction_law_flags())
        .only_with(with);
    options.add("half-length", "A", "semi-axis along the rolling direction [m], above 0").only_with(with);
    options.add("half-width", "B", "semi-axis across it [m], above 0").only_with(with);
    options.add("shear-modulus", "G", "shear modulus of both bodies [Pa], 1e7 to 1e13").only_with(with);
}

void add_transient_options(study::Options& options) {
    options.add_flag("transient",
                     "friction in time, one row per step, under one value of each creepage or a history, in place of "
                     "steady friction; N, a and b are those at load_ratio 1");
    study::add_run_options(
        options, history_columns, "transient",
        " and, if known, a_ratio = a/a_0, b_ratio = b/b_0 [dimensionless], by default the cube root of load_ratio",
        "mesh that follows the ellipse, the default where a table has a_ratio,b_ratio and the load never vanishes; "
        "without it, and with --breathing=false, the mesh covers the largest ellipse");
}

namespace {

/// The law of friction. Throws BadInput if it has a memory, which belongs to particles, on patches of several strips.
std::optional<study::ChosenLaw> read_law(const study::Options& options, const std::vector<Patch>& patches) {
    std::optional<study::ChosenLaw> law = study::read_friction_law(options);
    const bool several =
        std::any_of(patches.begin(), patches.end(), [](const Patch& patch) { return patch.mesh.strip_count() > 1; });
    options.require(!law || law->memory.distance == 0 || !several, "memory",
                    "go with --strips 1: the library follows the memory of particles along one strip only");
    return law;
}

}  // namespace

Friction read_friction(const study::Options& options, const std::vector<Patch>& patches) {
    std::vector<CreepPoint> points = read_points(options, patches);
    std::optional<SiUnits> si;
    if (options.given("creepage")) {
        const SiScene given = read_si(options);
        const double full = given.mu * given.load, c = std::sqrt(given.a * given.b),
                     unit = given.shear_modulus * given.a * given.b / full;
        const std::vector<double>& creepage = given.creepage;
        points = {{unit * creepage[0], unit * creepage[1], unit * c * creepage[2]}};
        for (const double ratio : {points[0].longitudinal, points[0].lateral, points[0].spin}) {
            options.require(std::abs(ratio) <= 1e6, "creepage",
                            "be at most 1e6 mu N/(G a b), spin over sqrt(a b), in size: do the units fit?");
        }
        if (points[0].spin != 0) require_no_gain(options, patches);
        const double own = mu_N(patches.front());
        si = SiUnits{full / own, full * c / (own * patches.front().contact.c())};
    }
    Friction scene{.patches = patches,
                   .points = std::move(points),
                   .pressure = read_pressure(options),
                   .timed = study::has_times(options),
                   .from_above = options.given("plot"),
                   .keeps_tractions = options.given("tractions")};
    if (options.given("force")) scene.force = options.number("force", study::finite());
    scene.law = read_law(options, patches);
    scene.si = si;
    for (const Patch& patch : patches) scene.pressure(patch);  // before anything is written
    scene.from_above = scene.from_above && scene.points.size() == 1 && !scene.force && patches.size() <= 3;
    scene.keeps_tractions = scene.keeps_tractions || scene.from_above;
    return scene;
}

TimeScene read_time_scene(const study::Options& options, const std::vector<Patch>& patches) {
    for (const char* name : {"longitudinal", "lateral", "spin"}) {
        if (options.numbers(name, study::between(-1e6, 1e6)).size() == 1) continue;
        throw study::BadInput("--longitudinal, --lateral and --spin must have one value each with --transient");
    }
    TimeScene scene{patches, read_pressure(options),
                    study::read_run(options, history_columns, study::between(-1e6, 1e6)), read_law(options, patches)};
    const study::History& imposed = scene.run.imposed;
    if (imposed.has("spin")) require_no_gain(options, patches);
    if (!imposed.has("a_ratio") && !imposed.has("b_ratio")) return scene;
    const std::string said = options.said(options.given("load") ? "load" : "history");
    if (!scene.run.load_varies() || !imposed.has("a_ratio") || !imposed.has("b_ratio")) {
        throw study::BadInput(said + " must have load_ratio with a_ratio and b_ratio");
    }
    const study::Rule rule = study::between(1e-3, 1e3);
    for (const char* column : {"a_ratio", "b_ratio"}) {
        for (const double ratio : imposed.values(column)) {
            if (rule.holds(ratio)) continue;
            throw study::BadInput(said + ": a_ratio and b_ratio must " + rule.text + ", not " +
                                  study::Cell(ratio).text(6));
        }
    }
    const study::Numbers& loads = imposed.values("load_ratio");
    // of a shape of its own, which need not shrink with the load
    if (!options.given("breathing")) scene.run.breathing = *std::min_element(loads.begin(), loads.end()) > 0;
    return scene;
}

}  // namespace patch
