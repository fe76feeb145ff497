#include "named_scheme.hpp"

#include <algorithm>

#include "csv.hpp"
#include "input.hpp"

namespace study {

namespace {

using detail::parse_number;

const std::vector<std::string> without_elements{"chebyshev", "polynomial", "closed-form"};
const std::vector<std::string> method_words{"collocation", "galerkin", "knothe-bc", "nodes", "nodes-chebyshev"};
constexpr const char* meshes = "uniform, cosine, geometric-RATIO, knothe-EPSILON, modified-knothe-EPSILON";

bool is_between(const std::optional<double>& value, double low, double high) {
    return value && *value >= low && *value <= high;
}

/// A word on its way to a scheme, part by part.
struct Reader {
    std::string word;
    bool of_patch;
    NamedScheme scheme{};

    void require(bool holds, const std::string& part, const std::string& rule) const {
        if (!holds) throw BadInput("--scheme = " + word + ": " + (part.empty() ? "''" : part) + " must " + rule);
    }

    /// Reads a mesh: uniform, or knothe-0.3.
    void read_mesh(const std::string& part) {
        for (const rollbem::TopologyInfo& known : rollbem::topologies) {
            scheme.mesh_name = known.name;
            if (known.grading.empty() && part == known.name) return;
            const std::string start = scheme.mesh_name + "-";
            if (known.grading.empty() || part.rfind(start, 0) != 0) continue;
            scheme.grading = parse_number<double>(part.substr(start.size()));
            return require(is_between(scheme.grading, 1e-12, 1e12), part, "have a number from 1e-12 to 1e12");
        }
        require(false, part,
                std::string("be a mesh, one of ") + meshes + (of_patch ? "" : ", or the whole ") +
                    (of_patch ? "" : listed(without_elements, "or")));
    }

    void read_method(const std::string& part) {
        require(contains(method_words, part), part, "be a method, one of " + join(method_words, ", "));
        const bool at_chebyshev = part == "nodes-chebyshev";
        scheme.method = at_chebyshev ? "nodes" : part;
        if (scheme.method == "nodes") scheme.nodes = at_chebyshev ? "chebyshev" : "centres";
        require(!at_chebyshev || scheme.mesh_name == "cosine", part, "be on the mesh cosine");
        require(!of_patch || (scheme.method == "nodes" && scheme.mesh_name == "cosine"), scheme.mesh_name + ":" + part,
                "be cosine:nodes or cosine:nodes-chebyshev on a patch");
    }

    /// Reads the alphas: 0/0.63.
    void read_alphas(const std::string& part) {
        const std::vector<std::string> both = cells_of(part, '/');
        scheme.alpha_L = parse_number<double>(both.front());
        scheme.alpha_T = parse_number<double>(both.back());
        require(both.size() == 2 && is_between(scheme.alpha_L, -2, 2) && is_between(scheme.alpha_T, -2, 2), part,
                "be ALPHA_L/ALPHA_T, both in [-2, 2]");
    }

    /// The parameters that may follow the method and the alphas, in any order and each once.
    void read_parameter(const std::string& part) {
        std::vector<std::string> known = derivative_names(scheme.method);
        if (scheme.derivative.empty() && contains(known, part)) return void(scheme.derivative = part);
        if (scheme.alpha_L) known.emplace_back("lambda-L with L from 0 to 1");
        if (scheme.alpha_L && !scheme.lambda && part.rfind("lambda-", 0) == 0) {
            scheme.lambda = parse_number<double>(part.substr(7));
            if (is_between(scheme.lambda, 0, 1)) return;
        }
        if (scheme.method == "galerkin") {
            known = joined<std::string>({"exact", "qN with N from 1 to 1000"}, known);
            const auto points = parse_number<int>(part.substr(std::min<std::size_t>(part.size(), 1)));
            const bool fits = part == "exact" || (part[0] == 'q' && points && *points >= 1 && *points <= 1000);
            if (scheme.quadrature.empty() && fits)
                return void(scheme.quadrature = part == "exact" ? part : part.substr(1));
        }
        if (of_patch) {
            known = {"cosine-strips", "uniform-strips"};
            if (scheme.strips.empty() && contains(known, part))
                return void(scheme.strips = part.substr(0, part.find('-')));
        }
        require(false, part,
                known.empty() ? "not follow " + scheme.method : "be one of " + join(known, ", ") + ", once");
    }
};

}  // namespace

std::vector<std::string> derivative_names(const std::string& method) {
    if (method == "nodes") return {};
    return method == "galerkin" ? std::vector<std::string>{"fd", "analytic"}
                                : std::vector<std::string>{"fd", "fd4", "analytic"};
}

rollbem::AnyScheme NamedScheme::equations() const {
    using rollbem::Derivative;
    const Derivative d = derivative == "fd"    ? Derivative::finite_difference
                         : derivative == "fd4" ? Derivative::fourth_order
                                               : Derivative::analytic;
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

NamedScheme scheme_named(const std::string& word, bool of_patch) {
    if (!of_patch && contains(without_elements, word)) return NamedScheme{.method = word};
    std::vector<std::string> parts = cells_of(word, ':');
    Reader reader{word, of_patch};
    NamedScheme& scheme = reader.scheme;
    scheme.richardson = parts.front() == "richardson";
    if (scheme.richardson) parts.erase(parts.begin());
    parts.resize(std::max<std::size_t>(parts.size(), 2));  // what is missing is refused as empty
    reader.read_mesh(parts[0]);
    reader.read_method(parts[1]);
    const bool has_alphas = scheme.method == "collocation" || scheme.method == "galerkin";
    if (has_alphas) reader.read_alphas(parts.size() > 2 ? parts[2] : "");
    for (std::size_t k = has_alphas ? 3 : 2; k < parts.size(); ++k) reader.read_parameter(parts[k]);
    if (scheme.method == "galerkin" && scheme.quadrature.empty()) scheme.quadrature = "exact";
    if (has_alphas && !scheme.lambda) scheme.lambda = 1;
    if (of_patch && scheme.strips.empty()) scheme.strips = "cosine";
    if (scheme.derivative.empty()) scheme.derivative = usual_derivative(scheme);
    return scheme;
}

std::string scheme_help(const std::string& further) {
    return "names of schemes, as in the column scheme, MESH:METHOD[:PARAMETERS], in place of the options above, e.g. "
           "uniform:collocation:0/0.63, cosine:nodes-chebyshev, uniform:galerkin:0/0.75:q7. MESH: " +
           std::string(meshes) +
           ". METHOD: collocation:ALPHA_L/ALPHA_T, galerkin:ALPHA_L/ALPHA_T, knothe-bc, nodes, nodes-chebyshev (mesh "
           "cosine). Further PARAMETERS: fd, fd4 or analytic as of --derivative, qN or exact as of --quadrature, "
           "lambda-L as of --lambda" +
           further;
}

std::vector<NamedScheme> named_schemes(const std::vector<std::string>& words, bool of_patch) {
    std::vector<NamedScheme> schemes;
    std::vector<std::string> known;
    for (const std::string& word : words) {
        schemes.push_back(scheme_named(word, of_patch));
        known.push_back(schemes.back().word());
        if (std::count(known.begin(), known.end(), known.back()) == 1) continue;
        throw BadInput("--scheme = " + word + " must not be given twice");
    }
    return schemes;
}

}  // namespace study
