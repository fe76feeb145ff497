#include "named_scheme.hpp"

#include <cmath>
#include <utility>

#include "csv.hpp"
#include "input.hpp"

namespace study {

namespace {

using detail::parse_number;

const std::vector<std::string> without_elements{"chebyshev", "polynomial", "closed-form"};

bool is_between(const std::optional<double>& value, double low, double high) {
    return value && *value >= low && *value <= high;
}

/// uniform, or knothe-0.3.
bool read_mesh(const std::string& word, NamedScheme& scheme) {
    for (const rollbem::TopologyInfo& known : rollbem::topologies) {
        scheme.mesh_name = known.name;
        if (known.grading.empty()) {
            if (word == known.name) return true;
            continue;
        }
        const std::string start = scheme.mesh_name + "-";
        if (word.rfind(start, 0) != 0) continue;
        scheme.grading = parse_number<double>(word.substr(start.size()));
        return is_between(scheme.grading, 1e-12, 1e12);
    }
    return false;
}

/// 0/0.63.
bool read_alphas(const std::string& word, NamedScheme& scheme) {
    const std::vector<std::string> both = cells_of(word, '/');
    scheme.alpha_L = parse_number<double>(both.front());
    scheme.alpha_T = parse_number<double>(both.back());
    return both.size() == 2 && is_between(scheme.alpha_L, -2, 2) && is_between(scheme.alpha_T, -2, 2);
}

/// What may follow the method and the alphas, in any order and each once.
bool read_parameter(const std::string& word, bool of_patch, NamedScheme& scheme) {
    const bool galerkin = scheme.method == "galerkin";
    if (of_patch && scheme.strips.empty() && (word == "cosine-strips" || word == "uniform-strips")) {
        scheme.strips = word.substr(0, word.find('-'));
        return true;
    }
    if (scheme.method != "nodes" && scheme.derivative.empty() && (word == "fd" || word == "analytic")) {
        scheme.derivative = word;
        return true;
    }
    if (scheme.alpha_L && !scheme.lambda && word.rfind("lambda-", 0) == 0) {
        scheme.lambda = parse_number<double>(word.substr(7));
        return is_between(scheme.lambda, 0, 1);
    }
    if (!galerkin || !scheme.quadrature.empty()) return false;
    scheme.quadrature = word == "exact" ? word : word.substr(1);
    const auto points = parse_number<int>(scheme.quadrature);
    return word == "exact" || (word[0] == 'q' && points && *points >= 1 && *points <= 1000);
}

}  // namespace

rollbem::AnyScheme NamedScheme::equations() const {
    using rollbem::Derivative;
    const Derivative d = derivative == "fd" ? Derivative::finite_difference : Derivative::analytic;
    const double leading = alpha_L.value_or(0), trailing = alpha_T.value_or(0), centre = lambda.value_or(1);
    if (method == "collocation") return rollbem::Collocation{leading, trailing, d, centre};
    if (method == "knothe-bc") return rollbem::KnotheBoundary{d};
    if (method == "nodes") {
        return rollbem::NodeDifference{nodes == "centres" ? rollbem::Nodes::centres : rollbem::Nodes::chebyshev};
    }
    const int points = quadrature == "exact" ? rollbem::exact_quadrature : std::stoi(quadrature);
    return rollbem::Galerkin{leading, trailing, d, centre, points};
}

std::string usual_derivative(const NamedScheme& scheme) {
    if (!scheme.has_elements() || scheme.method == "nodes") return "";
    return scheme.quadrature == "exact" ? "analytic" : "fd";
}

std::string NamedScheme::word() const {
    if (!has_elements()) return method;
    std::string text = (richardson ? "richardson:" : "") + mesh_name;
    if (grading) text += "-" + Cell(*grading).text();
    text += ":" + method;
    if (nodes == "chebyshev") text += "-chebyshev";
    if (alpha_L) text += ":" + Cell(*alpha_L).text() + "/" + Cell(*alpha_T).text();
    if (!quadrature.empty() && quadrature != "exact") text += ":q" + quadrature;
    if (derivative != usual_derivative(*this)) text += ":" + derivative;
    if (lambda.value_or(1) != 1) text += ":lambda-" + Cell(*lambda).text();
    return strips.empty() ? text : text + ":" + strips + "-strips";
}

std::optional<NamedScheme> scheme_named(const std::string& word, bool of_patch) {
    if (!of_patch && contains(without_elements, word)) return NamedScheme{.method = word};
    std::vector<std::string> parts = cells_of(word, ':');
    NamedScheme scheme;
    scheme.richardson = parts.front() == "richardson";
    if (scheme.richardson) parts.erase(parts.begin());
    if (parts.size() < 2 || !read_mesh(parts[0], scheme)) return std::nullopt;
    const bool nodes_at_chebyshev = parts[1] == "nodes-chebyshev";
    scheme.method = nodes_at_chebyshev ? "nodes" : parts[1];
    if (!contains({"collocation", "galerkin", "knothe-bc", "nodes"}, scheme.method)) return std::nullopt;
    const bool has_alphas = scheme.method == "collocation" || scheme.method == "galerkin";
    if (scheme.method == "nodes") scheme.nodes = nodes_at_chebyshev ? "chebyshev" : "centres";
    if (nodes_at_chebyshev && scheme.mesh_name != "cosine") return std::nullopt;
    if (of_patch && (scheme.method != "nodes" || scheme.mesh_name != "cosine")) return std::nullopt;
    if (has_alphas) {
        if (parts.size() < 3 || !read_alphas(parts[2], scheme)) return std::nullopt;
    }
    for (std::size_t k = has_alphas ? 3 : 2; k < parts.size(); ++k) {
        if (!read_parameter(parts[k], of_patch, scheme)) return std::nullopt;
    }
    if (scheme.method == "galerkin" && scheme.quadrature.empty()) scheme.quadrature = "exact";
    if (has_alphas && !scheme.lambda) scheme.lambda = 1;
    if (of_patch && scheme.strips.empty()) scheme.strips = "cosine";
    if (scheme.derivative.empty()) scheme.derivative = usual_derivative(scheme);
    return scheme;
}

void add_scheme_option(Options& options, const std::vector<std::string>& others, const std::string& further) {
    options.add("scheme", "LIST",
                "discretisations by name, in place of these options: MESH:METHOD[:PARAMETERS], e.g. "
                "uniform:collocation:0/0.63, cosine:nodes-chebyshev, uniform:galerkin:0/0.75:q7, as in the column "
                "scheme" +
                    further);
    options.not_with(others, "scheme");
}

std::vector<NamedScheme> named_schemes(const std::vector<std::string>& words, bool of_patch) {
    std::vector<NamedScheme> schemes;
    std::vector<std::string> known;
    for (const std::string& word : words) {
        const std::optional<NamedScheme> found = scheme_named(word, of_patch);
        if (!found && of_patch) {
            throw BadInput("--scheme = " + word +
                           " must be cosine:nodes or cosine:nodes-chebyshev, with :cosine-strips or :uniform-strips");
        }
        if (!found) {
            throw BadInput(
                "--scheme = " + word +
                " must be MESH:METHOD, of the meshes uniform, cosine, geometric-RATIO, knothe-EPSILON, "
                "modified-knothe-EPSILON and the methods collocation:ALPHA_L/ALPHA_T, galerkin:ALPHA_L/ALPHA_T with "
                ":exact or :qPOINTS, all with :fd, :analytic or :lambda-L, knothe-bc, nodes, nodes-chebyshev (cosine); "
                "or chebyshev, polynomial, closed-form, richardson:MESH:METHOD");
        }
        if (contains(known, found->word())) throw BadInput("--scheme = " + word + " must not be given twice");
        known.push_back(found->word());
        schemes.push_back(*found);
    }
    return schemes;
}

}  // namespace study
