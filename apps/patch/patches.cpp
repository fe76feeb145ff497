#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <Eigen/Core>

#include "patch.hpp"
#include "support/errors.hpp"
#include "support/input.hpp"

namespace patch {

namespace {

using study::Numbers;
using Contact = rollbem::PatchContact<double>;
using Mesh = rollbem::Mesh<double>;
using Outline = rollbem::Outline<double>;

constexpr std::ptrdiff_t most_elements = 10000;

Eigen::ArrayXd array(const Numbers& numbers) {
    return Eigen::Map<const Eigen::ArrayXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

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

/// The strips across the height low ... high: --strip-edges, or one mesh for each of `counts`.
std::vector<Mesh> make_strips(const study::Options& options, double low, double high,
                              const std::vector<std::ptrdiff_t>& counts) {
    if (options.given("strip-edges")) {
        const auto end = [](double y, const char* which) { return study::Cell(y).text(12) + ", the " + which + " y"; };
        const Numbers edges =
            study::read_edges(options, "strip-edges", low, high, end(low, "smallest"), end(high, "largest"));
        return {rollbem::mesh_from_edges(array(edges))};
    }
    const bool cosine = options.choice("strip-grading", {"cosine", "uniform"}) == "cosine";
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
                "ellipses of these ratios of semi-axes, a along the rolling direction, above 0 (dimensionless)", "1");
    options.add_input("outline",
                      "instead: any patch, as CSV y,x_trailing,x_leading in any unit of length, y increasing, straight "
                      "between the lines; a, b and c below are then sqrt(area/pi)");
    options.not_with({"a-over-b"}, "outline");
    options.add("strips", "LIST", "strips along the rolling direction, 1 to 10000 (dimensionless); default: --n");
    options.add("strip-grading", "NAME", "edges of strips at -cos(pi j/m) of the half height: cosine; or uniform",
                "cosine");
    options.add_input("strip-edges",
                      "instead of --strips: edges of strips, one per line, y/b from -1 to 1, or y of the outline");
    options.not_with({"strips", "strip-grading"}, "strip-edges");

    options.set_default("n", "8,12,16");
    options.set_help("n", "number of elements of each strip, 1 to 10000 (dimensionless)");
    options.set_default("method", "nodes");
    options.set_help("method", "nodes: differences between the --nodes of neighbouring elements");
    options.set_default("nodes", "chebyshev");
    options.set_help("nodes", "chebyshev, or centres of elements");
    options.refuse_group("Discretisation", "each strip has the cosine mesh, and rows between nodes",
                         {"n", "method", "nodes"});
    options.refuse("kernel", "the bodies are half-spaces");
    options.refuse("aspect", "a patch is wide and long: --a-over-b");
}

std::vector<Patch> make_patches(const study::Options& options) {
    options.choice("method", {"nodes"});
    const bool chebyshev = options.choice("nodes", {"centres", "chebyshev"}) == "chebyshev";
    const rollbem::NodeDifference scheme{chebyshev ? rollbem::Nodes::chebyshev : rollbem::Nodes::centres};
    const Numbers poisson = options.numbers("poisson", study::between(0, 0.5));
    std::optional<Outline> outline;
    std::vector<Contact> contacts;
    if (options.given("outline")) {
        outline = read_outline(options);
    }
    for (const double ratio : outline ? Numbers{1} : options.numbers("a-over-b", study::between(1e-6, 1e6))) {
        for (const double nu : poisson) {
            contacts.push_back(outline ? Contact(*outline, 1, nu) : Contact::dimensionless(ratio, nu));
        }
    }
    const std::vector<std::ptrdiff_t> numbers = options.integers("n", 1, most_elements);
    std::vector<std::ptrdiff_t> counts;
    if (options.given("strips")) counts = options.integers("strips", 1, most_elements);
    std::vector<Patch> patches;
    const double low = outline ? outline->low() : -1, high = outline ? outline->high() : 1;
    for (const std::ptrdiff_t n : numbers) {
        for (const Mesh& across : make_strips(options, low, high, counts.empty() ? std::vector{n} : counts)) {
            if (n * across.size() > most_elements) {
                throw study::BadInput("--n = " + std::to_string(n) + " times " + std::to_string(across.size()) +
                                      " strips must be at most " + std::to_string(most_elements));
            }
            for (const Contact& contact : contacts) {
                patches.push_back(
                    {contact, rollbem::patch_mesh(contact, rollbem::cosine_mesh(n), across), across, scheme});
            }
        }
    }
    return patches;
}

study::Cell scene_cell(const Patch& patch, const std::string& column) {
    if (column == "poisson") return patch.contact.poisson_ratio();
    if (column == "n") return patch.mesh.elements_per_strip();
    if (column == "strips") return patch.mesh.strip_count();
    if (column == "nodes") return patch.scheme.nodes == rollbem::Nodes::chebyshev ? "chebyshev" : "centres";
    return patch.contact.outline() ? study::Cell() : study::Cell(patch.contact.a_over_b());
}

}  // namespace patch
