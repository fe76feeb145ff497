#include "schemes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/reference/step_response.hpp>
#include <rollbem/spectral/polynomial.hpp>

#include "discretisations.hpp"
#include "norms.hpp"
#include "references.hpp"
#include "support/csv.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"

namespace precision {

using rollbem::ArrayX;
using rollbem::Chebyshev;
using rollbem::Mesh;
using Complex = std::complex<double>;

namespace {

/// The forces of a response to a step, by force(q/a).
template <class Force>
Values forces_of(const Force& force) {
    Values forces;
    for (std::size_t k = 0; k < steps; ++k) forces.emplace_back(force(static_cast<double>(k + 1)));
    return forces;
}

// b/a for the closed forms; steady results of the plane model do not depend on it
double finite_aspect(const Scene& scene) {
    return std::isfinite(scene.contact.aspect()) ? scene.contact.aspect() : 1000;
}

std::optional<double> if_finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

}  // namespace

const std::vector<Quantity>& quantities() {
    static const std::vector<Quantity> all{{"c11", Problem::steady},
                                           {"traction", Problem::steady},
                                           {"c11_z0.1", Problem::harmonic, 0.1},
                                           {"c11_z1", Problem::harmonic, 1},
                                           {"c11_z5", Problem::harmonic, 5},
                                           {"step_force", Problem::step},
                                           {"friction_force", Problem::friction},
                                           {"combined_force", Problem::combined_friction},
                                           {"load_force", Problem::varying_load}};
    return all;
}

const std::vector<std::string>& scheme_names() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> names;
        for (const auto& [name, elements] : element_schemes()) names.push_back(name);
        names.insert(names.end(), {"chebyshev-states", "polynomial", "closed-form"});
        return names;
    }();
    return all;
}

Case::Case(const Scene& scene, std::string scheme, long n) : scene_(scene), scheme_(std::move(scheme)), n_(n) {}

bool Case::exists(const std::string& scheme, long n) {
    if (scheme == "closed-form") return n == 0;
    if (scheme == "chebyshev-states") return n >= 1 && n <= 10000;
    if (scheme == "polynomial") return n >= 1;
    const Elements found = *elements(scheme);
    const long least = std::max(2l, long(rollbem::info(found.topology).least_n));
    return found.order > 0 ? n % 2 == 0 && n / 2 >= least : n >= least;
}

bool Case::has(const std::string& scheme, const Quantity& quantity) {
    if (scheme == "closed-form") return !has_friction(quantity.problem) || quantity.problem == Problem::friction;
    return elements(scheme) || !has_friction(quantity.problem);
}

Values Case::values(const Quantity& quantity) const {
    if (const auto found = elements(scheme_)) return precision::values(scene_, *found, n_, quantity);
    if (scheme_ == "chebyshev-states") return precision::values(scene_, Chebyshev{n_}, quantity);
    const double nu = scene_.contact.poisson_ratio(), aspect = finite_aspect(scene_);
    if (scheme_ == "closed-form") {
        if (quantity.problem != Problem::step) return reference(scene_.contact, quantity);
        return forces_of([&](double q) { return rollbem::reference::step_response_de_hoog(q, nu, aspect); });
    }
    if (quantity.problem != Problem::step) {
        return {rollbem::polynomial_c11(Complex(0, quantity.frequency), nu, aspect, n_).c11};
    }
    const auto transform = [&](std::complex<long double> s) {
        return rollbem::polynomial_c11<long double>(s, nu, aspect, n_).c11 / s;
    };
    return forces_of([&](double q) { return rollbem::reference::invert_laplace(transform, q); });
}

double Case::traction_error() const {
    const double nu = scene_.contact.poisson_ratio();
    if (scheme_ == "closed-form") return 0;
    if (const auto found = elements(scheme_)) {
        const Tractions computed = tractions(scene_, *found, n_);
        const ArrayX<double> exact = rollbem::carter_mean_tractions(computed.mesh, nu);
        return weighted_norm(computed.mesh, computed.values - exact) / weighted_norm(computed.mesh, exact);
    }
    if (scheme_ == "polynomial") {
        const auto solution = rollbem::solve_polynomial(Complex(0), nu, finite_aspect(scene_), n_);
        return precision::traction_error(nu, [&](double x) { return solution.traction(x); });
    }
    const rollbem::Response<double> solution = steady(scene_, Chebyshev{n_});
    if (solution.status != rollbem::Status::ok) return std::numeric_limits<double>::quiet_NaN();
    return precision::traction_error(nu, rollbem::ChebyshevTraction<double>{solution.unknowns.col(0)});
}

std::optional<double> Case::relative_error(const Quantity& quantity) const {
    if (quantity.name == "traction") return if_finite(traction_error());
    const Values& exact = scene_.references->at(quantity.name);
    if (scheme_ != "closed-form" || quantity.problem == Problem::step) {
        return if_finite(error_of(quantity.problem, values(quantity), exact));
    }
    if (quantity.problem != Problem::harmonic) return 0;
    // against a second closed form
    const Complex s(0, quantity.frequency);
    return if_finite(error_of(quantity.problem, exact,
                              {rollbem::polynomial_c11(s, scene_.contact.poisson_ratio(), finite_aspect(scene_)).c11}));
}

std::string Case::status(const Quantity& quantity) const {
    using rollbem::Status;
    if (relative_error(quantity)) return name(Status::ok);
    Status status = Status::not_finite;
    if (const auto found = elements(scheme_)) {
        for (const long n : found->order > 0 ? std::vector{n_ / 2, n_} : std::vector{n_}) {
            const Status at_n = steady(scene_, *found, make_mesh(scene_, found->topology, n)).status;
            if (at_n != Status::ok) status = at_n;
        }
    } else if (scheme_ == "chebyshev-states") {
        const Status of_states = steady(scene_, Chebyshev{n_}).status;
        if (of_states != Status::ok) status = of_states;
    }
    return name(status);
}

std::vector<std::string> Case::setting() const {
    const bool strip = !scene_.plane && scheme_ != "polynomial" && scheme_ != "closed-form";
    const study::Cell aspect = study::aspect_cell(scene_.contact), none;
    const auto found = elements(scheme_);
    const auto grading = [&](rollbem::Grading kind, double value) {
        return found && rollbem::info(found->topology).grading == kind ? study::Cell(value) : none;
    };
    return {strip ? "strip" : "plane", aspect.text(), study::Cell(scene_.contact.poisson_ratio()).text(),
            grading(rollbem::Grading::size_ratio, scene_.size_ratio).text(),
            grading(rollbem::Grading::epsilon, scene_.epsilon).text()};
}

double Case::run(const Quantity& quantity) const {
    if (quantity.name != "traction") return values(quantity)[0].real();
    const double nu = scene_.contact.poisson_ratio();
    if (const auto found = elements(scheme_)) return tractions(scene_, *found, n_).values[0];
    if (scheme_ == "chebyshev-states")
        return rollbem::ChebyshevTraction<double>{steady(scene_, Chebyshev{n_}).unknowns.col(0)}(0.5);
    if (scheme_ == "closed-form") return rollbem::carter_traction(0.5, nu);
    return rollbem::solve_polynomial(Complex(0), nu, finite_aspect(scene_), n_).traction(0.5).real();
}

std::optional<bool> Case::stable() const {
    const double aspect = scene_.contact.aspect();
    if (!std::isfinite(aspect)) return std::nullopt;
    const bool plane_decays = study::plane_model_decays(scene_.contact);
    const auto found = elements(scheme_);
    const bool states = scheme_ == "chebyshev-states";
    if (!found && !states) return plane_decays;  // of the model itself
    if (scene_.plane && !plane_decays) return std::nullopt;
    for (const long n : found && found->order > 0 ? std::vector{n_ / 2, n_} : std::vector{n_}) {
        const auto count =
            rollbem::count_unstable<double>(states ? system_of(scene_, Chebyshev{n})
                                                   : system_of(scene_, *found, make_mesh(scene_, found->topology, n)));
        if (count.status != rollbem::Status::ok) return std::nullopt;
        if (count.unstable_count > 0) return false;
    }
    return true;
}

}  // namespace precision
