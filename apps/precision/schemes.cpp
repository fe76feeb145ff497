#include "schemes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/compiled/polynomial.hpp>
#include <rollbem/compiled/stability.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

#include "discretisations.hpp"
#include "norms.hpp"
#include "support/csv.hpp"
#include "support/non_steady.hpp"
#include "support/scenes.hpp"

namespace precision {

using rollbem::ArrayX;
using rollbem::Chebyshev;
using rollbem::Mesh;
using Complex = std::complex<double>;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// --- the polynomial approach and the closed form

Forces inverted_forces(const std::function<std::complex<long double>(std::complex<long double>)>& c11) {
    Forces forces{};
    for (std::size_t k = 0; k < steps; ++k) {
        forces[k] = rollbem::reference::invert_laplace([&](std::complex<long double> s) { return c11(s) / s; },
                                                       static_cast<double>(k + 1));
    }
    return forces;
}

Forces polynomial_forces(double poisson_ratio, double aspect, long order) {
    return inverted_forces([=](std::complex<long double> s) {
        return rollbem::polynomial_c11<long double>(s, poisson_ratio, aspect, order).c11;
    });
}

Forces closed_form_forces(double poisson_ratio, double aspect) {
    Forces forces{};
    for (std::size_t k = 0; k < steps; ++k) {
        forces[k] = rollbem::reference::step_response_de_hoog(static_cast<double>(k + 1), poisson_ratio, aspect);
    }
    return forces;
}

// b/a for the closed forms; steady results of the plane model do not depend on it
double finite_aspect(const Scene& scene) {
    return std::isfinite(scene.contact.aspect()) ? scene.contact.aspect() : 1000;
}

std::optional<double> if_finite(double value) { return std::isfinite(value) ? std::optional(value) : std::nullopt; }

Complex exact_c11(const Scene& scene, const Quantity& quantity) {
    return rollbem::reference::plane_c11({0, quantity.frequency}, scene.contact.poisson_ratio(), finite_aspect(scene));
}

double element_error(const Scene& scene, const Elements& elements, long n, const Quantity& quantity) {
    const double nu = scene.contact.poisson_ratio();
    switch (quantity.problem) {
        case Problem::steady: {
            if (quantity.name == "traction") {
                const Tractions found = tractions(scene, elements, n);
                const ArrayX<double> exact = rollbem::carter_mean_tractions(found.mesh, nu);
                return weighted_norm(found.mesh, found.values - exact) / weighted_norm(found.mesh, exact);
            }
            const auto c11 = [&](const Mesh<double>& mesh) { return steady_c11(scene, elements, mesh); };
            return evaluate(scene, elements, n, c11) / rollbem::steady_c11(nu) - 1;
        }
        case Problem::harmonic: {
            const auto c11 = [&](const Mesh<double>& mesh) {
                return harmonic_c11(system_of(scene, elements, mesh), quantity.frequency);
            };
            return std::abs(evaluate(scene, elements, n, c11) / exact_c11(scene, quantity) - 1.0);
        }
        case Problem::step: return largest_difference(all_step_forces(scene, elements, n), scene.step_forces);
        case Problem::combined_friction:
            return vector_error(all_combined_forces(scene, elements, n), scene.both_forces);
        case Problem::varying_load: return series_error(all_load_forces(scene, elements, n), scene.load_forces);
        default: break;
    }
    const auto force = [&](const Mesh<double>& mesh) { return friction_force(scene, elements, mesh); };
    return evaluate(scene, elements, n, force) / rollbem::carter_force_ratio(creepage_ratio) - 1;
}

double states_error(const Scene& scene, const Chebyshev& method, const Quantity& quantity) {
    const double nu = scene.contact.poisson_ratio();
    if (quantity.problem == Problem::step) {
        return largest_difference(step_forces(scene, system_of(scene, method)), scene.step_forces);
    }
    if (quantity.problem == Problem::harmonic) {
        return std::abs(harmonic_c11(system_of(scene, method), quantity.frequency) / exact_c11(scene, quantity) - 1.0);
    }
    const rollbem::ChebyshevSteadySolution<double> solution = steady(scene, method);
    if (solution.status != rollbem::Status::ok) return nan;
    return quantity.name == "traction" ? traction_error(nu, solution.traction)
                                       : solution.c11 / rollbem::steady_c11(nu) - 1;
}

double run_states(const Scene& scene, const Chebyshev& method, const Quantity& quantity) {
    if (quantity.problem == Problem::step) return step_forces(scene, system_of(scene, method))[0];
    if (quantity.problem == Problem::harmonic) {
        return harmonic_c11(system_of(scene, method), quantity.frequency).real();
    }
    const rollbem::ChebyshevSteadySolution<double> solution = steady(scene, method);
    return quantity.name == "traction" ? solution.traction(0.5) : solution.c11;
}

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

std::optional<double> Case::relative_error(const Quantity& quantity) const {
    if (const auto found = elements(scheme_)) return if_finite(element_error(scene_, *found, n_, quantity));
    if (scheme_ == "chebyshev-states") return if_finite(states_error(scene_, Chebyshev{n_}, quantity));
    const double nu = scene_.contact.poisson_ratio(), aspect = finite_aspect(scene_);
    const Complex s(0, quantity.frequency);
    if (scheme_ == "closed-form") {  // against a second closed form, if there is one
        if (quantity.problem == Problem::step) {
            return if_finite(largest_difference(closed_form_forces(nu, aspect), scene_.step_forces));
        }
        if (quantity.problem != Problem::harmonic) return 0;
        const Complex other = rollbem::polynomial_c11(s, nu, aspect).c11;
        return if_finite(std::abs(exact_c11(scene_, quantity) / other - 1.0));
    }
    if (quantity.name == "traction") {
        const auto solution = rollbem::solve_polynomial(Complex(0), nu, aspect, n_);
        return if_finite(traction_error(nu, [&](double x) { return solution.traction(x); }));
    }
    if (quantity.problem == Problem::step) {
        return if_finite(largest_difference(polynomial_forces(nu, aspect, n_), scene_.step_forces));
    }
    const Complex c11 = rollbem::polynomial_c11(s, nu, aspect, n_).c11;
    if (quantity.problem == Problem::steady) return if_finite(c11.real() / rollbem::steady_c11(nu) - 1);
    return if_finite(std::abs(c11 / exact_c11(scene_, quantity) - 1.0));
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
    const double nu = scene_.contact.poisson_ratio(), aspect = finite_aspect(scene_);
    const Complex s(0, quantity.frequency);
    if (const auto found = elements(scheme_)) {
        if (quantity.name == "traction") return tractions(scene_, *found, n_).values[0];
        switch (quantity.problem) {
            case Problem::steady:
                return evaluate(scene_, *found, n_, [&](const auto& mesh) { return steady_c11(scene_, *found, mesh); });
            case Problem::harmonic:
                return evaluate(scene_, *found, n_,
                                [&](const auto& mesh) {
                                    return harmonic_c11(system_of(scene_, *found, mesh), quantity.frequency);
                                })
                    .real();
            case Problem::step: return all_step_forces(scene_, *found, n_)[0];
            case Problem::combined_friction: return all_combined_forces(scene_, *found, n_)[0];
            case Problem::varying_load: return all_load_forces(scene_, *found, n_)[0];
            default: break;
        }
        return evaluate(scene_, *found, n_, [&](const auto& mesh) { return friction_force(scene_, *found, mesh); });
    }
    if (scheme_ == "chebyshev-states") return run_states(scene_, Chebyshev{n_}, quantity);
    const bool closed = scheme_ == "closed-form";
    switch (quantity.problem) {
        case Problem::step: return closed ? closed_form_forces(nu, aspect)[0] : polynomial_forces(nu, aspect, n_)[0];
        case Problem::friction: return rollbem::carter_force_ratio(creepage_ratio);
        case Problem::harmonic:
            return closed ? rollbem::reference::plane_c11({0, quantity.frequency}, nu, aspect).real()
                          : rollbem::polynomial_c11(s, nu, aspect, n_).c11.real();
        default: break;
    }
    if (quantity.name == "traction") {
        return closed ? rollbem::carter_traction(0.5, nu)
                      : rollbem::solve_polynomial(s, nu, aspect, n_).traction(0.5).real();
    }
    return closed ? rollbem::steady_c11(nu) : rollbem::polynomial_c11(s, nu, aspect, n_).c11.real();
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
