// A line contact as precision_study compares its schemes: references, errors, and what is computed.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

#include "lines.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"

namespace precision {

namespace {

using rollbem::Contact;
using rollbem::LineModel;

/// The relative error; of a complex number its absolute value, of tractions and of a force as a vector |difference|
/// over |exact|, of a response to a step the largest; of forces over mu N_0 under a load that varies the largest
/// difference.
double error_of(const Quantity& quantity, const Values& found, const Values& exact) {
    const auto real = [](const Values& of) -> Eigen::ArrayXd {
        return Eigen::ArrayXcd::Map(of.data(), std::ssize(of)).real();
    };
    const auto largest = [](const Eigen::ArrayXd& errors) { return errors.abs().maxCoeff<Eigen::PropagateNaN>(); };
    if (quantity.problem == Problem::harmonic) return std::abs(found[0] / exact[0] - 1.0);
    if (quantity.problem == Problem::transient) return largest(real(found) / real(exact) - 1);
    if (quantity.problem == Problem::varying_load) return largest(real(found) - real(exact));
    if (quantity.name == "traction" || quantity.problem == Problem::combined_friction) {
        double error = 0, size = 0;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            error += std::norm(found[k] - exact[k]);
            size += std::norm(exact[k]);
        }
        return std::sqrt(error / size);
    }
    return found[0].real() / exact[0].real() - 1;
}

/// What a quantity consists of in the plane model, by closed forms where there are any, none of which depends on an
/// infinite aspect. The force in both directions is extrapolated from cosine meshes of 320 and 640 elements; from 640
/// and 1280 it differs by 7e-6 of itself. Those under a load that varies are extrapolated from cosine meshes of 160 and
/// 320 elements that breathe, in steps of a quarter of those of the schemes; from 320 and 640 in steps half as long
/// they differ by at most 4e-6.
Values reference(const Contact<double>& contact, const Settings& settings, const Quantity& quantity) {
    const double nu = contact.poisson_ratio();
    switch (quantity.problem) {
        case Problem::harmonic: return {rollbem::reference::plane_c11({0, quantity.frequency}, nu, contact.aspect())};
        case Problem::transient: {
            const rollbem::reference::StepResponse response(nu, contact.aspect());
            Values forces;
            for (int k = 1; k <= steps; ++k) forces.emplace_back(response.step(k * settings.dq));
            return forces;
        }
        case Problem::friction: return {rollbem::carter_force_ratio(settings.creepage_ratio)};
        case Problem::combined_friction:
        case Problem::varying_load: {
            const long n = quantity.problem == Problem::varying_load ? 320 : 640;
            const study::Scene fine = study::make_scene(study::scheme_named("richardson:cosine:collocation:0.5/0.5"), n,
                                                        contact, LineModel::plane);
            return evaluate(fine, {.creepage_ratio = settings.creepage_ratio, .load_parts = 4}, quantity, {}).values;
        }
        default: break;
    }
    return {rollbem::steady_c11(nu)};
}

/// The relative difference that the strip makes to the plane limit: the model's error, on one mesh.
double model_error(const Contact<double>& contact, Settings settings, const Quantity& quantity) {
    settings.may_breathe = false;
    const auto on = [&](LineModel model) {
        const auto scene = study::make_scene(study::scheme_named("cosine:collocation:0.5/0.5"), 60, contact, model);
        return evaluate(scene, settings, quantity, {}).values;
    };
    return error_of(quantity, on(LineModel::strip), on(LineModel::plane));
}

std::string status_of(const study::Scene& scene) {
    rollbem::Status status = rollbem::Status::not_finite;
    if (!scene.is_discrete()) return name(status);
    for (const study::Scene& one : scene.meshes()) {
        const rollbem::Status own = steady(one).status;
        if (own != rollbem::Status::ok) status = own;
    }
    return name(status);
}

std::optional<bool> stable(const study::Scene& scene) {
    if (!std::isfinite(scene.contact.aspect())) return std::nullopt;
    const bool plane_decays = study::plane_model_decays(scene.contact);
    if (!scene.is_discrete()) return plane_decays;  // of the model itself
    if (scene.is_plane() && !plane_decays) return std::nullopt;
    for (const study::Scene& one : scene.meshes()) {
        const auto count = rollbem::count_unstable<double>(study::system_of(one));
        if (count.status != rollbem::Status::ok) return std::nullopt;
        if (count.unstable_count > 0) return false;
    }
    return true;
}

// --- the command line

/// Throws BadInput for an option that only other quantities than those asked for read.
void refuse_unread(const study::Options& options, const std::vector<Quantity>& quantities) {
    const auto asked = [&](const auto& reads) { return std::any_of(quantities.begin(), quantities.end(), reads); };
    const auto is_response = [](const Quantity& q) { return q.name == "response"; };
    const auto is_transient = [](const Quantity& q) { return q.problem == Problem::transient; };
    const auto has_friction = [](const Quantity& q) { return q.problem >= Problem::friction; };
    if (!asked(is_response)) options.ignored("omega", "without the quantity response");
    if (!asked(is_transient)) options.ignored("dq", "without the quantity transient");
    if (!asked(has_friction)) options.ignored("creepage-ratio", "without a quantity with friction");
}

/// Times and the front are those of one contact and one model of it.
std::pair<Contact<double>, LineModel> make_contact(const study::Options& options,
                                                   const std::vector<study::NamedScheme>& schemes,
                                                   const std::vector<Quantity>& quantities) {
    for (const char* name : {"kernel", "aspect", "poisson"}) {
        options.require(options.said(name).find(',') == std::string::npos, name,
                        "be a single value: schemes are compared for one contact; run the study once for each value");
    }
    refuse_unread(options, quantities);
    const bool has_states = std::any_of(schemes.begin(), schemes.end(),
                                        [](const study::NamedScheme& s) { return s.method == "chebyshev"; });
    const bool steady = std::none_of(quantities.begin(), quantities.end(), [](const Quantity& quantity) {
        return quantity.problem == Problem::harmonic || quantity.problem == Problem::transient ||
               quantity.problem == Problem::varying_load;
    });
    const Contact<double> contact =
        study::make_contacts(options, steady ? study::Problem::steady : study::Problem::non_steady).front();
    if (!steady) study::require_plane_model(contact);
    // the strip of infinite width is the plane
    const bool plane = options.choice("kernel", {"strip", "plane"}) == "plane" || !std::isfinite(contact.aspect());
    options.require(plane || !has_states || contact.aspect() >= 0.001, "aspect",
                    "be at least 0.001 for the scheme chebyshev");
    return {contact, plane ? LineModel::plane : LineModel::strip};
}

/// Without --n, costly problems stop at smaller n.
bool affordable(Problem problem, long n) {
    return n <= (problem == Problem::steady ? 640 : problem == Problem::harmonic ? 320 : 160);
}

/// Numbers of elements, states, or the order of the polynomial; 0 for the closed form, which has none.
std::vector<std::ptrdiff_t> sizes_of(const study::Options& options, const study::NamedScheme& scheme) {
    if (scheme.method == "closed-form") return {0};
    if (scheme.method == "chebyshev" && !options.given("n")) {
        return {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48};
    }
    return options.integers("n", 1, largest_n);
}

/// kernel, aspect, poisson, and size_ratio and epsilon if the scheme's mesh has them.
std::vector<std::string> setting(const study::Scene& scene) {
    std::vector<std::string> cells;
    for (const char* column : {"kernel", "aspect", "poisson", "size_ratio", "epsilon"}) {
        cells.push_back(scene_cell(scene, column).text());
    }
    return cells;
}

}  // namespace

std::vector<Quantity> line_quantities(const study::Options& options) {
    const double omega = options.number("omega", study::positive());
    return {{"c11", Problem::steady},
            {"traction", Problem::steady},
            {"c11_z0.1", Problem::harmonic, 0.1},
            {"c11_z1", Problem::harmonic, 1},
            {"response", Problem::harmonic, omega},
            {"transient", Problem::transient},
            {"friction", Problem::friction},
            {"combined_force", Problem::combined_friction},
            {"load_force", Problem::varying_load}};
}

Comparison compare_on_line(const study::Options& options) {
    const std::vector<study::NamedScheme> schemes =
        study::named_schemes(options.given("scheme") ? options.texts("scheme") : line_schemes);
    const std::vector<Quantity> quantities = chosen(options, line_quantities(options));
    const auto given = make_contact(options, schemes, quantities);
    const Contact<double> contact = given.first;
    const LineModel model = given.second;
    const Settings settings{options.number("dq", study::positive()),
                            options.number("creepage-ratio", study::positive())};
    const auto references = std::make_shared<std::map<std::string, Values>>();
    Comparison result{columns(), quantities, {}, {}, {}};
    for (const study::NamedScheme& scheme : schemes) {
        for (const long n : sizes_of(options, scheme)) {
            if (!exists(scheme, n)) continue;
            Task task{scheme.word(), n > 0 ? std::optional(n) : std::nullopt, {}, {}};
            for (const Quantity& quantity : quantities) {
                const bool wanted = options.given("n") || affordable(quantity.problem, n);
                if (wanted && solves(scheme, quantity.problem)) task.quantities.push_back(quantity);
            }
            if (task.quantities.empty()) continue;
            const study::Scene scene = study::make_scene(scheme, n, contact, model);
            task.setting = setting(scene);
            task.error = [=](const Quantity& quantity) {
                const Values& exact = references->at(quantity.name);
                const Found found = evaluate(scene, settings, quantity, exact);
                return error_of(quantity, found.values, found.exact.empty() ? exact : found.exact);
            };
            task.status = [=](const Quantity&) { return status_of(scene); };
            task.run = [=](const Quantity& quantity) {  // from the mesh on
                const study::Scene again = study::make_scene(scheme, n, contact, model);
                return evaluate(again, settings, quantity, references->at(quantity.name)).values[0].real();
            };
            task.stable = [=] { return stable(scene); };
            result.tasks.push_back(std::move(task));
        }
    }
    options.require(!result.tasks.empty(), "n", "fit at least one of the schemes and quantities");
    // by n, as given or increasing, and within it in the order of the schemes; what has no n comes last
    const std::vector<std::ptrdiff_t> numbers = options.integers("n", 1, largest_n);
    const auto place = [&](const Task& task) {
        if (!task.n) return std::numeric_limits<std::ptrdiff_t>::max();
        return options.given("n") ? std::find(numbers.begin(), numbers.end(), *task.n) - numbers.begin() : *task.n;
    };
    std::stable_sort(result.tasks.begin(), result.tasks.end(),
                     [&](const Task& one, const Task& other) { return place(one) < place(other); });
    result.prepare = [=] {
        for (const Quantity& quantity : quantities)
            (*references)[quantity.name] = reference(contact, settings, quantity);
    };
    result.model_error = [=](const Quantity& quantity) {
        return model == LineModel::plane ? std::nullopt : std::optional(model_error(contact, settings, quantity));
    };
    return result;
}

}  // namespace precision
