#include "scenes.hpp"

#include <cmath>
#include <utility>

#include "errors.hpp"
#include "files.hpp"

namespace study {

namespace {

using MeshPointer = std::shared_ptr<const rollbem::Mesh<double>>;

constexpr std::ptrdiff_t largest_n = 100000;

MeshPointer mesh_from_file(const Options& options) {
    Lines lines(options, "edges");
    std::vector<double> edges;
    while (lines.next()) {
        const std::string& text = lines.text();
        const std::string where = lines.where() + " = " + text;
        const std::optional<double> edge = detail::parse_number<double>(text);
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

/// The mesh of every n, and its name in the columns.
std::pair<std::string, std::vector<MeshPointer>> make_meshes(const Options& options) {
    const std::vector<std::string> names{"uniform", "geometric", "knothe", "modified-knothe", "cosine"};
    const bool from_file = options.given("edges");
    if (from_file) {
        options.ignored("mesh", "with --edges");
        options.ignored("n", "with --edges");
    }
    const std::string name = from_file ? "edges" : options.choice("mesh", names);
    const std::string used = from_file ? "with --edges" : "with --mesh " + name;
    const bool knothe = name == "knothe" || name == "modified-knothe";
    const double size_ratio = options.number("size-ratio", between(1e-12, 1e12));
    const double epsilon = options.number("epsilon", between(1e-12, 1e12));
    if (name != "geometric") options.ignored("size-ratio", used + "; it is for --mesh geometric");
    if (!knothe) options.ignored("epsilon", used + "; it is for --mesh knothe and modified-knothe");
    if (from_file) return {name, {mesh_from_file(options)}};

    const Eigen::Index least = name == "knothe" ? 3 : name == "geometric" || name == "modified-knothe" ? 2 : 1;
    std::vector<MeshPointer> meshes;
    for (const Eigen::Index n : options.integers("n", 1, largest_n)) {
        if (n < least) {
            throw BadInput("--n = " + std::to_string(n) + " must be at least " + std::to_string(least) + " " + used);
        }
        const auto make = [&]() {
            if (name == "geometric") return rollbem::geometric_mesh(n, size_ratio);
            if (name == "knothe") return rollbem::knothe_mesh(n, epsilon);
            if (name == "modified-knothe") return rollbem::modified_knothe_mesh(n, epsilon);
            if (name == "cosine") return rollbem::cosine_mesh(n);
            return rollbem::uniform_mesh(n);
        };
        meshes.push_back(std::make_shared<rollbem::Mesh<double>>(make()));
    }
    return {name, meshes};
}

/// The pairs (alpha_L, alpha_T) in the order of the rows.
std::vector<std::pair<double, double>> make_alphas(const Options& options) {
    const Rule rule = between(-2, 2);
    std::vector<std::pair<double, double>> alphas;
    if (options.given("alpha")) {
        options.ignored("alpha-L", "with --alpha");
        options.ignored("alpha-T", "with --alpha");
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

rollbem::Contact<double> make_contact(const Options& options, Problem problem) {
    const Rule aspect = problem == Problem::steady ? positive_or_infinite() : positive();
    return rollbem::Contact<double>::dimensionless(options.number("aspect", aspect),
                                                   options.number("poisson", between(0, 0.5)));
}

std::vector<Scene> make_scenes(const Options& options, Problem problem) {
    using rollbem::Derivative;
    const std::string method = options.choice("method", {"collocation", "galerkin", "knothe-bc"});
    const bool has_alphas = method != "knothe-bc";
    if (method != "galerkin") options.ignored("quadrature", "with --method " + method + "; it is for galerkin");
    if (!has_alphas) {
        for (const char* name : {"alpha-L", "alpha-T", "alpha", "lambda"}) {
            options.ignored(name, "with --method knothe-bc, which takes the centres of the elements");
        }
    }
    const int quadrature =
        options.text("quadrature") == "exact" ? rollbem::exact_quadrature : int(options.integer("quadrature", 1, 1000));
    const std::string usual = method == "galerkin" && quadrature == rollbem::exact_quadrature ? "analytic" : "fd";
    const std::string derivative_name =
        options.given("derivative") ? options.choice("derivative", {"fd", "analytic"}) : usual;
    const Derivative derivative = derivative_name == "fd" ? Derivative::finite_difference : Derivative::analytic;

    const rollbem::Contact<double> contact = make_contact(options, problem);
    const std::string kernel = options.choice("kernel", {"strip", "plane"});
    const std::vector<double> lambdas = has_alphas ? options.numbers("lambda", between(0, 1)) : std::vector<double>{1};
    const std::vector<std::pair<double, double>> alphas =
        has_alphas ? make_alphas(options) : std::vector<std::pair<double, double>>{{0, 0}};
    const auto [mesh_name, meshes] = make_meshes(options);

    std::vector<Scene> scenes;
    for (const MeshPointer& mesh : meshes) {
        for (const double lambda : lambdas) {
            for (const auto& [alpha_L, alpha_T] : alphas) {
                Scene scene{.method = method,
                            .derivative = derivative_name,
                            .mesh_name = mesh_name,
                            .contact = contact,
                            .mesh = mesh,
                            .scheme = rollbem::KnotheBoundary{derivative},
                            .kernel = rollbem::PlaneKernel<double>::longitudinal(contact)};
                const std::string n = (options.given("edges") ? options.said("edges") + ": n = " : "--n = ") +
                                      std::to_string(mesh->size()) + " must be at least 2 ";
                if (!has_alphas && mesh->size() < 2) throw BadInput(n + "with --method knothe-bc");
                if (has_alphas) {
                    if (mesh->size() < 2 && alpha_L != alpha_T) throw BadInput(n + "where alpha-L and alpha-T differ");
                    scene.alpha_L = alpha_L;
                    scene.alpha_T = alpha_T;
                    scene.lambda = lambda;
                }
                if (method == "collocation") scene.scheme = rollbem::Collocation{alpha_L, alpha_T, derivative, lambda};
                if (method == "galerkin") {
                    scene.scheme = rollbem::Galerkin{alpha_L, alpha_T, derivative, lambda, quadrature};
                }
                // the strip of infinite width is the plane
                if (kernel == "strip" && std::isfinite(contact.aspect())) {
                    scene.kernel = rollbem::StripKernel<double>::longitudinal(contact);
                }
                scenes.push_back(std::move(scene));
            }
        }
    }
    return scenes;
}

}  // namespace study
