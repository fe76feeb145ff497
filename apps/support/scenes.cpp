#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "input.hpp"

namespace study {

namespace {

constexpr std::ptrdiff_t largest_n = 100000, most_states = 10000;
constexpr double narrowest_for_states = 0.001;  // b/a; the library's bounds

/// Like `common` for every n, with a mesh of each grading or Chebyshev states.
std::vector<std::vector<Scene>> discretised(const Options& options, const Scene& common) {
    std::vector<std::vector<Scene>> scenes;
    if (common.method == "chebyshev") {
        for (const Eigen::Index n : options.integers("n", 1, most_states)) {
            scenes.emplace_back(1, common)[0].chebyshev = rollbem::Chebyshev{n};
        }
        return scenes;
    }
    if (options.given("edges")) {
        const Eigen::ArrayXd edges = array(read_edges(options, "edges"));
        scenes.emplace_back(1, common)[0].mesh =
            std::make_shared<rollbem::Mesh<double>>(rollbem::mesh_from_edges<double>(edges));
        return scenes;
    }
    const std::string name = options.choice("mesh", mesh_names());
    const rollbem::Topology topology = *rollbem::topology_named(name);
    const rollbem::TopologyInfo& info = rollbem::topology_info(topology);
    std::vector<double> gradings{0};  // without effect if the mesh has none
    const bool graded = !info.grading.empty();
    if (graded) gradings = options.numbers(option_of(std::string(info.grading)), between(1e-12, 1e12));
    for (const Eigen::Index n : options.integers("n", 1, largest_n)) {
        if (n < info.least_n) {
            throw BadInput("--n = " + std::to_string(n) + " must be at least " + std::to_string(info.least_n) +
                           " with --mesh " + name);
        }
        scenes.emplace_back();
        for (const double grading : gradings) {
            Scene& scene = scenes.back().emplace_back(common);
            scene.mesh = std::make_shared<rollbem::Mesh<double>>(rollbem::make_mesh(topology, n, grading));
            if (graded) scene.grading = grading;
        }
    }
    return scenes;
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

}  // namespace

rollbem::AnyScheme scheme_of(const Scene& scene) {
    using rollbem::Derivative;
    const Derivative d = scene.derivative == "fd" ? Derivative::finite_difference : Derivative::analytic;
    const double alpha_L = scene.alpha_L.value_or(0), alpha_T = scene.alpha_T.value_or(0);
    const double lambda = scene.lambda.value_or(1);
    if (scene.method == "collocation") return rollbem::Collocation{alpha_L, alpha_T, d, lambda};
    if (scene.method == "knothe-bc") return rollbem::KnotheBoundary{d};
    if (scene.method == "nodes") {
        return rollbem::NodeDifference{scene.nodes == "centres" ? rollbem::Nodes::centres : rollbem::Nodes::chebyshev};
    }
    const int points = scene.quadrature == "exact" ? rollbem::exact_quadrature : std::stoi(scene.quadrature);
    return rollbem::Galerkin{alpha_L, alpha_T, d, lambda, points};
}

std::vector<std::string> columns_of(const std::string& text) {
    return text.empty() ? std::vector<std::string>{} : cells_of(text);
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
        {"quadrature", [](const Scene& s) { return Cell(s.quadrature); }},
        {"nodes", [](const Scene& s) { return Cell(s.nodes); }}};
    const auto found = cells.find(column);
    if (found != cells.end()) return found->second(scene);
    const std::optional<rollbem::Topology> topology = rollbem::topology_named(scene.mesh_name);
    return topology && rollbem::topology_info(*topology).grading == column ? Cell(scene.grading) : Cell();
}

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
    options.require(
        methods != Methods::elements || options.text("method") != "chebyshev", "method",
        "be one of " + join(names, ", ") + ": friction bounds the traction of elements, which chebyshev does not have");
    // 1. What does not vary.
    const std::string method = options.choice("method", names);
    const bool has_alphas = method == "collocation" || method == "galerkin", has_elements = method != "chebyshev";
    const std::vector<rollbem::Contact<double>> contacts = make_contacts(options, problem);
    Scene common{.method = method, .contact = contacts[0], .kernel = make_kernel(options, contacts[0])};
    if (has_elements) common.mesh_name = options.given("edges") ? "edges" : options.text("mesh");
    if (method == "galerkin") common.quadrature = options.text("quadrature");
    if (method == "galerkin" && common.quadrature != "exact") options.integer("quadrature", 1, 1000);
    if (options.given("derivative")) {
        common.derivative = options.choice("derivative", {"fd", "analytic"});
    } else if (has_elements && method != "nodes") {
        common.derivative = common.quadrature == "exact" ? "analytic" : "fd";
    }
    if (method == "nodes") common.nodes = options.choice("nodes", {"centres", "chebyshev"});
    options.require(common.nodes != "chebyshev" || common.mesh_name == "cosine", "nodes",
                    "be centres unless --mesh is cosine");

    // 2. What does, n in the outermost loop.
    const std::vector<double> lambdas = has_alphas ? options.numbers("lambda", between(0, 1)) : std::vector<double>{1};
    const std::vector<std::pair<double, double>> alphas =
        has_alphas ? make_alphas(options) : std::vector<std::pair<double, double>>{{0, 0}};
    std::vector<Scene> scenes;
    const auto add = [&](Scene scene, double lambda, double alpha_L, double alpha_T) {
        const std::string too_few = (options.given("edges") ? options.said("edges") + ": n = " : "--n = ") +
                                    std::to_string(scene.n()) + " must be at least 2 ";
        if (method == "knothe-bc" && scene.n() < 2) throw BadInput(too_few + "with --method knothe-bc");
        if (scene.n() < 2 && alpha_L != alpha_T) throw BadInput(too_few + "where alpha-L and alpha-T differ");
        if (has_alphas) {
            scene.alpha_L = alpha_L;
            scene.alpha_T = alpha_T;
            scene.lambda = lambda;
        }
        if (has_elements) scene.scheme = scheme_of(scene);
        for (const rollbem::Contact<double>& contact : contacts) {
            scene.contact = contact;
            scene.kernel = make_kernel(options, contact);
            options.require(has_elements || scene.is_plane() || contact.aspect() >= narrowest_for_states, "aspect",
                            "be at least 0.001 with --method chebyshev: so narrow a strip needs elements");
            scenes.push_back(scene);
        }
    };
    for (const std::vector<Scene>& graded : discretised(options, common)) {
        for (const double lambda : lambdas) {
            for (const auto& [alpha_L, alpha_T] : alphas) {
                for (const Scene& one : graded) add(one, lambda, alpha_L, alpha_T);
            }
        }
    }
    return scenes;
}

std::string steady_status(const Scene& scene, rollbem::Status status, double c11) {
    constexpr double wide = 10;  // b/a; for wider contacts the plane's c11 is within 1 % of the strip's
    const bool compares = scene.mesh && scene.n() < 10 && (scene.is_plane() || scene.contact.aspect() >= wide);
    const double exact = rollbem::steady_c11(scene.contact.poisson_ratio());
    const bool is_coarse = status == rollbem::Status::ok && compares && std::abs(c11 / exact - 1) > 0.5;
    return is_coarse ? coarse : name(status);
}

Axis most_varied(const std::vector<Scene>& scenes) {
    std::string most;
    std::size_t count = 0;
    for (const char* column : {"n", "alpha_T", "alpha_L", "lambda"}) {
        std::set<std::string> values;
        for (const Scene& scene : scenes) values.insert(scene_cell(scene, column).text());
        if (values.size() > count) most = column;
        count = std::max(count, values.size());
    }
    const bool equal =
        std::all_of(scenes.begin(), scenes.end(), [](const Scene& scene) { return scene.alpha_L == scene.alpha_T; });
    if (most == "n") return {most, scenes.front().chebyshev ? "number of states n" : "number of elements n"};
    if (most == "alpha_T" && equal) return {most, "α_L = α_T", {"alpha_L"}};
    return {most, shown_name(most)};
}

}  // namespace study
