#include "scenes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <rollbem/accuracy/recommendation.hpp>

#include "input.hpp"

namespace study {

namespace {

constexpr std::ptrdiff_t largest_n = 100000, most_states = 10000;
constexpr double narrowest_for_states = 0.001;  // b/a; the library's bounds

/// The scheme's mesh of n elements.
std::shared_ptr<const rollbem::Mesh<double>> make_mesh(const NamedScheme& scheme, Eigen::Index n) {
    const rollbem::TopologyInfo& info = rollbem::topology_info(scheme.topology());
    const std::string where = "--n = " + std::to_string(n) + " must be at least ";
    if (n < info.least_n) {
        throw BadInput(where + std::to_string(info.least_n) + " with --mesh " + scheme.mesh_name);
    }
    return std::make_shared<rollbem::Mesh<double>>(
        rollbem::make_mesh(scheme.topology(), n, scheme.grading.value_or(0)));
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

}  // namespace

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
        {"nodes", [](const Scene& s) { return Cell(s.nodes); }},
        {"scheme", [](const Scene& s) { return Cell(s.word()); }}};
    const auto found = cells.find(column);
    if (found != cells.end()) return found->second(scene);
    return scene.graded_by(column) ? Cell(scene.grading) : Cell();
}

Cell aspect_cell(const rollbem::Contact& contact) {
    return std::isfinite(contact.aspect()) ? Cell(contact.aspect()) : Cell("inf");
}

std::vector<rollbem::Contact> make_contacts(const Options& options, Problem problem) {
    const Rule rule = problem == Problem::steady ? positive_or_infinite() : positive();
    const std::vector<double> aspects = options.numbers("aspect", rule);
    const std::vector<double> poisson_ratios = options.numbers("poisson", between(0, 0.5));
    std::vector<rollbem::Contact> contacts;
    for (const double aspect : aspects) {
        for (const double poisson_ratio : poisson_ratios) {
            contacts.push_back(rollbem::Contact::dimensionless(aspect, poisson_ratio));
        }
    }
    return contacts;
}

void offer_chebyshev(Options& options, const std::string& further) {
    options.set_help(
        "n", "number of elements of the contact, 1 to 100000, or of Chebyshev states, 1 to 10000 [dimensionless]");
    options.set_help("method",
                     "method of discretisation: collocation, galerkin, knothe-bc (boundary conditions of Knothe and "
                     "Gross-Thebing), nodes (differences between the --nodes of neighbouring elements) or chebyshev (n "
                     "states in place of elements; no other option of this group applies to them)" +
                         further);
}

void offer_schemes(Options& options, const Methods& methods) {
    options.set_help(
        "scheme",
        scheme_help(
            std::string(methods.states ? ". Without elements: chebyshev (n states)" : "") +
            (methods.closed ? ", polynomial (of the order n), closed-form, the last two of --kernel plane" : "") +
            (methods.not_extrapolated.empty() ? ". richardson:MESH:METHOD[:PARAMETERS]: extrapolation from n/2 and n "
                                                "elements, n even, on a uniform or cosine mesh"
                                              : "")));
}

namespace {

/// The schemes of the options of the command line, lambda outermost, then alpha_L, alpha_T and the mesh's grading.
std::vector<NamedScheme> listed_schemes(const Options& options, const std::vector<std::string>& methods) {
    NamedScheme common{.method = options.choice("method", methods)};
    if (common.method == "chebyshev") return {common};
    const bool has_edges = options.given("edges");
    const bool has_alphas = common.method == "collocation" || common.method == "galerkin";
    common.mesh_name = has_edges ? "edges" : options.choice("mesh", mesh_names());
    if (common.method == "galerkin") common.quadrature = options.text("quadrature");
    if (common.method == "galerkin" && common.quadrature != "exact") options.integer("quadrature", 1, 1000);
    common.derivative = options.given("derivative") ? options.choice("derivative", derivative_names(common.method))
                                                    : usual_derivative(common);
    if (common.method == "nodes") common.nodes = options.choice("nodes", {"centres", "chebyshev"});
    options.require(common.nodes != "chebyshev" || common.mesh_name == "cosine", "nodes",
                    "be centres unless --mesh is cosine");
    std::vector<NamedScheme> graded{common};
    const std::string grading(has_edges ? "" : rollbem::topology_info(common.topology()).grading);
    if (!grading.empty()) {
        graded.clear();
        for (const double value : options.numbers(option_of(grading), between(1e-12, 1e12))) {
            graded.emplace_back(common).grading = value;
        }
    }
    if (!has_alphas) return graded;
    std::vector<NamedScheme> schemes;
    const std::vector<std::pair<double, double>> alphas = make_alphas(options);
    for (const double lambda : options.numbers("lambda", between(0, 1))) {
        for (const auto& [alpha_L, alpha_T] : alphas) {
            for (NamedScheme scheme : graded) {
                scheme.lambda = lambda;
                scheme.alpha_L = alpha_L;
                scheme.alpha_T = alpha_T;
                schemes.push_back(scheme);
            }
        }
    }
    return schemes;
}

/// The schemes that a study of elements takes.
std::vector<NamedScheme> make_schemes(const Options& options, Problem problem, const Methods& methods) {
    std::vector<std::string> names{"collocation", "galerkin", "knothe-bc", "nodes"};
    if (methods.states) names.emplace_back("chebyshev");
    const std::string no_states = "friction bounds the traction of elements, which chebyshev does not have";
    options.require(methods.states || options.text("method") != "chebyshev", "method",
                    "be one of " + join(names, ", ") + ": " + no_states);
    if (!options.given("scheme")) return listed_schemes(options, names);
    std::vector<NamedScheme> schemes = named_schemes(options.texts("scheme"));
    for (const NamedScheme& scheme : schemes) {
        const auto require = [&](bool holds, const std::string& rule) {
            if (!holds) throw BadInput("--scheme = " + scheme.word() + " must " + rule);
        };
        require(!scheme.richardson || methods.not_extrapolated.empty(),
                "be on one mesh: " + std::string(methods.not_extrapolated));
        require(scheme.is_discrete() || methods.closed, "have elements or states: polynomials have a c11 alone");
        require(!scheme.is_discrete() || contains(names, scheme.method), "be one of elements: " + no_states);
        require(problem == Problem::non_steady || scheme.lambda.value_or(1) == 1,
                std::string("have no lambda: ") + no_lambda);
        require(scheme.is_discrete() || !options.given("kernel") || options.text("kernel") == "plane",
                "go with --kernel plane, whose model alone it solves");
    }
    const bool has_n =
        std::any_of(schemes.begin(), schemes.end(), [](const auto& s) { return s.method != "closed-form"; });
    if (!has_n) options.ignored("n", "with --scheme closed-form, which has no elements");
    return schemes;
}

}  // namespace

std::vector<Scene> Scene::meshes() const {
    std::vector<Scene> all{*this};
    all[0].coarse.reset();
    if (!coarse) return all;
    all.push_back(all[0]);
    all[1].mesh = coarse;
    return all;
}

Eigen::ArrayXd extrapolate_tractions(const Scene& scene, const Eigen::ArrayXd& fine, const Eigen::ArrayXd& rough) {
    const Eigen::ArrayXd forces = fine * scene.mesh->widths();
    Eigen::ArrayXd tractions = rough;
    for (Eigen::Index i = 0; i < tractions.size(); ++i) {
        const double mean = forces.segment(2 * i, 2).sum() / scene.coarse->widths()[i];
        tractions[i] = rollbem::richardson(tractions[i], mean, scene.order());
    }
    return tractions;
}

Scene make_scene(const NamedScheme& scheme, Eigen::Index n, const rollbem::Contact& contact, rollbem::LineModel model) {
    if (!scheme.is_discrete()) model = rollbem::LineModel::plane;
    Scene scene{scheme, contact, rollbem::AnyKernel<double>::longitudinal(model, contact)};
    if (scheme.has_elements()) {
        scene.mesh = make_mesh(scheme, n);
        scene.scheme = scheme.equations();
    } else if (scheme.method == "chebyshev") {
        scene.chebyshev = rollbem::Chebyshev{n};
    } else if (scheme.method == "polynomial") {
        scene.degree = n;
    }
    if (scheme.richardson) scene.coarse = make_mesh(scheme, n / 2);
    return scene;
}

std::vector<Scene> make_scenes(const Options& options, Problem problem, const Methods& methods) {
    const std::vector<NamedScheme> schemes = make_schemes(options, problem, methods);
    const std::vector<rollbem::Contact> contacts = make_contacts(options, problem);
    const bool plane = options.choice("kernel", {"strip", "plane"}) == "plane";
    const rollbem::LineModel model = plane ? rollbem::LineModel::plane : rollbem::LineModel::strip;
    std::shared_ptr<const rollbem::Mesh<double>> given;
    if (options.given("edges")) {
        const Eigen::ArrayXd edges = array(read_edges(options, "edges"));
        given = std::make_shared<rollbem::Mesh<double>>(rollbem::mesh_from_edges<double>(edges));
    }
    const bool has_elements =
        std::any_of(schemes.begin(), schemes.end(), [](const auto& s) { return s.has_elements(); });
    const std::vector<std::ptrdiff_t> numbers = given
                                                    ? std::vector<std::ptrdiff_t>{given->size()}
                                                    : options.integers("n", 1, has_elements ? largest_n : most_states);
    const std::string few = given ? options.said("edges") + ": n = " : "--n = ";
    std::vector<Scene> scenes;
    for (const std::ptrdiff_t n : numbers) {
        for (const NamedScheme& scheme : schemes) {
            if (scheme.method == "closed-form" && n != numbers.front()) continue;  // it has no n
            const auto require = [&](bool holds, const std::string& rule) {
                if (!holds) throw BadInput(few + std::to_string(n) + " must be " + rule);
            };
            require(!scheme.richardson || n % 2 == 0, "even to extrapolate from its half");
            Scene scene{scheme, contacts[0], rollbem::AnyKernel<double>::longitudinal(model, contacts[0])};
            scene.mesh = given;
            scene.scheme = given ? scheme.equations() : rollbem::AnyScheme{};
            if (!given) scene = make_scene(scheme, n, contacts[0], model);
            const std::string least = "at least " + std::string(scheme.richardson ? "4" : "2");
            const std::string halves = scheme.richardson ? ", as richardson: halves it" : "";
            const bool enough = n >= (scheme.richardson ? 4 : 2);
            require(enough || scheme.method != "knothe-bc", least + " with --method knothe-bc" + halves);
            require(enough || scheme.alpha_L == scheme.alpha_T, least + " where alpha-L and alpha-T differ" + halves);
            for (const rollbem::Contact& contact : contacts) {
                scene.contact = contact;
                scene.kernel = rollbem::AnyKernel<double>::longitudinal(scene.kernel.model(), contact);
                options.require(!scene.chebyshev || scene.is_plane() || contact.aspect() >= narrowest_for_states,
                                "aspect",
                                "be at least 0.001 with --method chebyshev: so narrow a strip needs elements");
                scenes.push_back(scene);
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
