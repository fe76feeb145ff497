#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "errors.hpp"
#include "files.hpp"
#include "mesh_names.hpp"

namespace study {

namespace {

using MeshPointer = std::shared_ptr<const rollbem::Mesh<double>>;

/// A mesh and what graded it.
struct GradedMesh {
    MeshPointer mesh;
    std::optional<double> size_ratio{}, epsilon{};
};

constexpr std::ptrdiff_t largest_n = 100000, most_states = 10000;
constexpr double narrowest_for_states = 0.001;  // b/a; the library's bounds

MeshPointer mesh_from_file(const Options& options) {
    Lines lines(options, "edges");
    std::vector<double> edges;
    while (lines.next()) {
        const std::string& text = lines.text();
        const std::string where = lines.where() + " = " + text;
        const std::vector<std::string> cells = cells_of(text, separator_of(text));
        const std::optional<double> edge = cells.size() == 1 ? detail::parse_number<double>(cells[0]) : std::nullopt;
        if (!edge || !(*edge >= -1 && *edge <= 1)) throw BadInput(where + " must be a number in [-1, 1]");
        if (edges.empty() && *edge != -1) throw BadInput(where + " must be -1, the trailing edge");
        if (!edges.empty() && !(*edge > edges.back())) throw BadInput(where + " must be larger than the line before");
        edges.push_back(*edge);
        if (std::ptrdiff_t(edges.size()) > largest_n + 1) {
            throw BadInput(options.said("edges") + " must have at most " + std::to_string(largest_n + 1) + " lines");
        }
    }
    if (edges.size() < 2 || edges.back() != 1) {
        throw BadInput(options.said("edges") + " must end with 1, the leading edge");
    }
    const Eigen::Map<const Eigen::ArrayXd> values(edges.data(), Eigen::Index(edges.size()));
    return std::make_shared<rollbem::Mesh<double>>(rollbem::mesh_from_edges<double>(values));
}

/// The name of the mesh in the columns and, for every n, its gradings.
std::pair<std::string, std::vector<std::vector<GradedMesh>>> make_meshes(const Options& options) {
    const bool from_file = options.given("edges");
    const std::string name = from_file ? "edges" : options.choice("mesh", mesh_names());
    const std::string used = from_file ? "with --edges" : "with --mesh " + name;
    const auto topology = rollbem::topology_named(name);  // none with --edges
    std::vector<double> gradings{0};                      // without effect if the mesh has none
    for (const auto& [option, grading] :
         {std::pair{"size-ratio", rollbem::Grading::size_ratio}, {"epsilon", rollbem::Grading::epsilon}}) {
        const std::vector<double> values = options.numbers(option, between(1e-12, 1e12));
        if (topology && rollbem::topology_info(*topology).grading == grading) {
            gradings = values;
        } else {
            options.ignored(option, used + "; it is for --mesh " + listed(mesh_names(grading), "and"));
        }
    }
    if (!topology) return {name, {{{.mesh = mesh_from_file(options)}}}};

    const rollbem::TopologyInfo& info = rollbem::topology_info(*topology);
    const Eigen::Index least = info.least_n;
    std::vector<std::vector<GradedMesh>> meshes;
    for (const Eigen::Index n : options.integers("n", 1, largest_n)) {
        if (n < least) {
            throw BadInput("--n = " + std::to_string(n) + " must be at least " + std::to_string(least) + " " + used);
        }
        std::vector<GradedMesh>& graded = meshes.emplace_back();
        for (const double grading : gradings) {
            graded.push_back(
                {.mesh = std::make_shared<rollbem::Mesh<double>>(rollbem::make_mesh({*topology, n, grading}))});
            if (info.grading == rollbem::Grading::size_ratio) graded.back().size_ratio = grading;
            if (info.grading == rollbem::Grading::epsilon) graded.back().epsilon = grading;
        }
    }
    return {name, meshes};
}

/// The pairs (alpha_L, alpha_T) in the order of the rows.
std::vector<std::pair<double, double>> make_alphas(const Options& options) {
    const Rule rule = between(-2, 2);
    std::vector<std::pair<double, double>> alphas;
    if (options.given("alpha")) {
        for (const double alpha : options.numbers("alpha", rule)) alphas.emplace_back(alpha, alpha);
        return alphas;
    }
    const std::vector<double> trailing = options.numbers("alpha-T", rule);
    for (const double alpha_L : options.numbers("alpha-L", rule)) {
        for (const double alpha_T : trailing) alphas.emplace_back(alpha_L, alpha_T);
    }
    return alphas;
}

rollbem::AnyKernel<double> make_kernel(const Options& options, const rollbem::Contact<double>& contact) {
    const bool plane = options.choice("kernel", {"strip", "plane"}) == "plane";
    return rollbem::AnyKernel<double>::longitudinal(plane ? rollbem::LineModel::plane : rollbem::LineModel::strip,
                                                    contact);
}

std::vector<Scene> make_chebyshev_scenes(const Options& options,
                                         const std::vector<rollbem::Contact<double>>& contacts) {
    options.ignored_group("Discretisation", "with --method chebyshev, which has no elements", {"method", "n"});
    std::vector<Scene> scenes;
    for (const Eigen::Index n : options.integers("n", 1, most_states)) {
        for (const rollbem::Contact<double>& contact : contacts) {
            Scene& scene = scenes.emplace_back(Scene{.method = "chebyshev",
                                                     .contact = contact,
                                                     .chebyshev = rollbem::Chebyshev{n},
                                                     .kernel = make_kernel(options, contact)});
            if (!scene.is_plane() && contact.aspect() < narrowest_for_states) {
                throw BadInput(options.said("aspect") +
                               " must be at least 0.001 with --method chebyshev: so narrow a strip needs elements");
            }
        }
    }
    return scenes;
}

using rollbem::Derivative;

/// A scheme by its names, but for alphas and lambda.
struct Equations {
    std::string method, derivative{}, nodes{};  ///< the latter two empty where the method has none
    int quadrature = rollbem::exact_quadrature;

    bool has_alphas() const { return method == "collocation" || method == "galerkin"; }

    rollbem::AnyScheme scheme(double alpha_L, double alpha_T, double lambda) const {
        const Derivative d = derivative == "fd" ? Derivative::finite_difference : Derivative::analytic;
        if (method == "collocation") return rollbem::Collocation{alpha_L, alpha_T, d, lambda};
        if (method == "galerkin") return rollbem::Galerkin{alpha_L, alpha_T, d, lambda, quadrature};
        if (method == "knothe-bc") return rollbem::KnotheBoundary{d};
        return rollbem::NodeDifference{nodes == "centres" ? rollbem::Nodes::centres : rollbem::Nodes::chebyshev};
    }
};

/// All but the nodes, which depend on the mesh.
Equations read_equations(const Options& options, const std::string& method) {
    Equations result{.method = method};
    const bool by_nodes = method == "nodes";
    if (method != "galerkin") options.ignored("quadrature", "with --method " + method + "; it is for galerkin");
    if (!result.has_alphas()) {
        for (const char* name : {"alpha-L", "alpha-T", "alpha", "lambda"}) {
            options.ignored(name, by_nodes ? "with --method nodes, which takes differences between --nodes"
                                           : "with --method knothe-bc, which takes the centres of the elements");
        }
    }
    if (by_nodes) {
        options.ignored("derivative", "with --method nodes, which takes differences");
    } else {
        options.ignored("nodes", "with --method " + method + "; it is for nodes");
    }
    if (options.text("quadrature") != "exact") result.quadrature = int(options.integer("quadrature", 1, 1000));
    if (options.given("derivative")) {
        result.derivative = options.choice("derivative", {"fd", "analytic"});
    } else if (!by_nodes) {
        result.derivative = method == "galerkin" && result.quadrature == rollbem::exact_quadrature ? "analytic" : "fd";
    }
    return result;
}

}  // namespace

const std::vector<std::string>& setting_columns() {
    static const std::vector<std::string> columns{"kernel",  "aspect",     "poisson", "size_ratio",
                                                  "epsilon", "quadrature", "nodes"};
    return columns;
}

const std::vector<std::string>& all_setting_columns() {
    static const std::vector<std::string> columns = joined({"method", "derivative", "mesh"}, setting_columns());
    return columns;
}

Cell scene_cell(const Scene& scene, const std::string& column) {
    static const std::map<std::string, Cell (*)(const Scene&)> cells{
        {"method", [](const Scene& s) { return Cell(s.method); }},
        {"derivative", [](const Scene& s) { return Cell(s.derivative); }},
        {"mesh", [](const Scene& s) { return Cell(s.mesh_name); }},
        {"n", [](const Scene& s) { return s.n() > 0 ? Cell(s.n()) : Cell(); }},
        {"alpha_L", [](const Scene& s) { return Cell(s.alpha_L); }},
        {"alpha_T", [](const Scene& s) { return Cell(s.alpha_T); }},
        {"lambda", [](const Scene& s) { return Cell(s.lambda); }},
        {"kernel", [](const Scene& s) { return Cell(s.is_plane() ? "plane" : "strip"); }},
        {"aspect", [](const Scene& s) { return aspect_cell(s.contact); }},
        {"poisson", [](const Scene& s) { return Cell(s.contact.poisson_ratio()); }},
        {"size_ratio", [](const Scene& s) { return Cell(s.size_ratio); }},
        {"epsilon", [](const Scene& s) { return Cell(s.epsilon); }},
        {"quadrature", [](const Scene& s) { return Cell(s.quadrature); }},
        {"nodes", [](const Scene& s) { return Cell(s.nodes); }}};
    return cells.at(column)(scene);
}

Row scene_cells(const Scene& scene, const std::vector<std::string>& columns) {
    Row row;
    for (const std::string& column : columns) row.push_back(scene_cell(scene, column));
    return row;
}

Row setting_cells(const Scene& scene) { return scene_cells(scene, setting_columns()); }

Row all_setting_cells(const Scene& scene) { return scene_cells(scene, all_setting_columns()); }

Cell aspect_cell(const rollbem::Contact<double>& contact) {
    return std::isfinite(contact.aspect()) ? Cell(contact.aspect()) : Cell("inf");
}

std::vector<rollbem::Contact<double>> make_contacts(const Options& options, Problem problem) {
    const Rule rule = problem == Problem::steady ? positive_or_infinite() : positive();
    const std::vector<double> aspects = options.numbers("aspect", rule);
    const std::vector<double> poisson_ratios = options.numbers("poisson", between(0, 0.5));
    std::vector<rollbem::Contact<double>> contacts;
    for (const double aspect : aspects) {
        for (const double poisson_ratio : poisson_ratios) {
            contacts.push_back(rollbem::Contact<double>::dimensionless(aspect, poisson_ratio));
        }
    }
    return contacts;
}

std::vector<rollbem::Contact<double>> contacts_of(const std::vector<Scene>& scenes) {
    std::vector<rollbem::Contact<double>> contacts;
    for (const Scene& scene : scenes) {
        const auto same = [&](const rollbem::Contact<double>& other) {
            return other.aspect() == scene.contact.aspect() && other.poisson_ratio() == scene.contact.poisson_ratio();
        };
        if (std::none_of(contacts.begin(), contacts.end(), same)) contacts.push_back(scene.contact);
    }
    return contacts;
}

rollbem::Contact<double> make_contact(const Options& options, Problem problem) {
    const Rule aspect = problem == Problem::steady ? positive_or_infinite() : positive();
    return rollbem::Contact<double>::dimensionless(options.number("aspect", aspect),
                                                   options.number("poisson", between(0, 0.5)));
}

void offer_chebyshev(Options& options, const std::string& further) {
    options.set_help(
        "n", "number of elements of the contact, 1 to 100000, or of Chebyshev states, 1 to 10000 (dimensionless)");
    options.set_help("method",
                     "collocation, galerkin, knothe-bc (Knothe and Gross-Thebing's boundary conditions), nodes "
                     "(differences between the --nodes of neighbouring elements), or chebyshev: n states in place of "
                     "elements, to which no other option of this group applies" +
                         further);
}

std::vector<Scene> make_scenes(const Options& options, Problem problem, Methods methods) {
    std::vector<std::string> names{"collocation", "galerkin", "knothe-bc", "nodes"};
    if (methods == Methods::elements_and_states) names.emplace_back("chebyshev");
    if (methods == Methods::elements && options.text("method") == "chebyshev") {
        throw BadInput(options.said("method") + " must be one of " + join(names, ", ") +
                       ": friction bounds the traction of elements, which chebyshev does not have");
    }
    const std::string method = options.choice("method", names);
    if (method == "chebyshev") return make_chebyshev_scenes(options, make_contacts(options, problem));
    Equations equations = read_equations(options, method);
    const bool has_alphas = equations.has_alphas();
    const std::vector<rollbem::Contact<double>> contacts = make_contacts(options, problem);
    const std::vector<double> lambdas = has_alphas ? options.numbers("lambda", between(0, 1)) : std::vector<double>{1};
    const std::vector<std::pair<double, double>> alphas =
        has_alphas ? make_alphas(options) : std::vector<std::pair<double, double>>{{0, 0}};
    const auto named_meshes = make_meshes(options);
    const std::string& mesh_name = named_meshes.first;  // clang 14 captures no structured bindings
    if (method == "nodes") equations.nodes = options.choice("nodes", {"centres", "chebyshev"});
    if (equations.nodes == "chebyshev" && mesh_name != "cosine") {
        throw BadInput(options.said("nodes") + " must be centres unless --mesh is cosine");
    }

    std::vector<Scene> scenes;
    const auto add = [&](const std::vector<GradedMesh>& graded, double lambda, double alpha_L, double alpha_T) {
        const Eigen::Index n = graded.front().mesh->size();
        const std::string too_few = (options.given("edges") ? options.said("edges") + ": n = " : "--n = ") +
                                    std::to_string(n) + " must be at least 2 ";
        if (method == "knothe-bc" && n < 2) throw BadInput(too_few + "with --method knothe-bc");
        if (n < 2 && alpha_L != alpha_T) throw BadInput(too_few + "where alpha-L and alpha-T differ");
        const auto if_any = [&](double value) { return has_alphas ? std::optional(value) : std::nullopt; };
        for (const GradedMesh& one : graded) {
            for (const rollbem::Contact<double>& contact : contacts) {
                scenes.push_back({.method = method,
                                  .derivative = equations.derivative,
                                  .mesh_name = mesh_name,
                                  .alpha_L = if_any(alpha_L),
                                  .alpha_T = if_any(alpha_T),
                                  .lambda = if_any(lambda),
                                  .size_ratio = one.size_ratio,
                                  .epsilon = one.epsilon,
                                  .quadrature = method == "galerkin" ? options.text("quadrature") : "",
                                  .nodes = equations.nodes,
                                  .contact = contact,
                                  .mesh = one.mesh,
                                  .scheme = equations.scheme(alpha_L, alpha_T, lambda),
                                  .kernel = make_kernel(options, contact)});
            }
        }
    };
    for (const std::vector<GradedMesh>& graded : named_meshes.second) {
        for (const double lambda : lambdas) {
            for (const auto& [alpha_L, alpha_T] : alphas) add(graded, lambda, alpha_L, alpha_T);
        }
    }
    return scenes;
}

std::string steady_status(const Scene& scene, rollbem::Status status, double c11) {
    if (status != rollbem::Status::ok) return name(status);
    constexpr double wide = 10;  // b/a; for wider contacts the plane's c11 is within 1 % of the strip's
    if (scene.chebyshev || scene.n() >= 10 || !(scene.is_plane() || scene.contact.aspect() >= wide)) {
        return name(status);
    }
    const double exact = rollbem::steady_c11(scene.contact.poisson_ratio());
    return std::abs(c11 / exact - 1) > 0.5 ? coarse : name(status);
}

void add_model_differences(
    Plot& plot, const std::vector<Scene>& scenes,
    const std::function<std::vector<std::pair<double, double>>(
        const rollbem::Chebyshev&, const rollbem::StripKernel<double>&, const rollbem::Contact<double>&)>& difference) {
    constexpr Eigen::Index states = 64;  // exact to rounding for b/a down to 0.3
    double least = HUGE_VAL;
    for (const Series& series : plot.series) {
        for (const auto& [x, error] : series.points) least = error > 0 ? std::min(least, error) : least;
    }
    std::vector<Scene> strips;
    std::copy_if(scenes.begin(), scenes.end(), std::back_inserter(strips),
                 [](const Scene& scene) { return !scene.is_plane() && scene.contact.aspect() >= 0.3; });
    const std::vector<rollbem::Contact<double>> contacts = contacts_of(strips);
    for (const rollbem::Contact<double>& contact : contacts) {
        const auto kernel = rollbem::StripKernel<double>::longitudinal(contact);
        Series line{.label = "strip against plane", .markers = false, .reference = true};
        if (contacts.size() > 1) {
            line.label +=
                ", b/a = " + Cell(contact.aspect()).text(6) + ", ν = " + Cell(contact.poisson_ratio()).text(6);
        }
        line.points = difference(rollbem::Chebyshev{states}, kernel, contact);
        const auto is_near = [&](const auto& point) { return point.second > least / 10; };
        if (std::any_of(line.points.begin(), line.points.end(), is_near)) plot.series.push_back(std::move(line));
    }
}

}  // namespace study
