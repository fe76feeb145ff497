#include "non_steady.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <variant>

#include <rollbem/adhesion/steady.hpp>
#include <rollbem/closed_form/carter.hpp>

#include "csv.hpp"
#include "errors.hpp"

namespace study {

bool plane_model_decays(const rollbem::Contact<double>& contact) {
    return rollbem::plane_lambda(contact.poisson_ratio(), contact.aspect()) > 0;
}

void require_plane_model(const Options& options, const rollbem::Contact<double>& contact) {
    if (plane_model_decays(contact)) return;
    const double nu = contact.poisson_ratio();
    throw BadInput(options.said("aspect") +
                   " must be larger than exp(-nu/(1-nu))/4 = " + Cell(std::exp(-nu / (1 - nu)) / 4).text(4) +
                   " for the plane model: below, Lambda = ln(4b/a) + nu/(1-nu) is not positive and the model itself, "
                   "before any discretisation, is unstable in time; --kernel strip has no such limit");
}

std::vector<Scene> make_non_steady_scenes(const Options& options) {
    std::vector<Scene> scenes = make_scenes(options, Problem::non_steady);
    const Scene& any = scenes.front();  // all have the same contact and kernel
    if (std::holds_alternative<rollbem::PlaneKernel<double>>(any.kernel)) require_plane_model(options, any.contact);
    return scenes;
}

Sine read_sine(const Options& options, const Rule& rule) {
    const std::string text = options.text("sine");
    const std::size_t comma = text.find(',');
    const auto amplitude = detail::parse_number<double>(text.substr(0, comma));
    const auto omega = comma == std::string::npos ? std::nullopt : detail::parse_number<double>(text.substr(comma + 1));
    if (!amplitude || !omega || !rule.holds(*amplitude) || !(*omega > 0) || !std::isfinite(*omega)) {
        throw BadInput(options.said("sine") + " must be AMP,OMEGA with AMP " + rule.text + " and OMEGA > 0");
    }
    return {*amplitude, *omega};
}

void require_steppable(const Scene& scene, const rollbem::StabilityVerdict& verdict,
                       const rollbem::ElementSystem<double>& system) {
    const std::string scheme = "n = " + std::to_string(scene.n()) + ": the scheme ";
    if (verdict.status != rollbem::Status::ok) {
        throw BadInput(scheme + "has eigenvalues that were not found; they must be, or --unchecked be given");
    }
    if (!verdict.stable()) {
        throw BadInput(scheme + "has " + std::to_string(verdict.unstable_count) + " unstable and " +
                       std::to_string(verdict.uncertain_count) +
                       " uncertain eigenvalues; it must be stable, or --unchecked be given");
    }
    if (rollbem::solve_steady<double>(system.G_prime(), system.weights()).status == rollbem::Status::inconsistent) {
        throw BadInput(scheme +
                       "does not converge to full adhesion (alpha near or below 0, or above 1): its steady tractions "
                       "must oppose the creepage, or --unchecked be given");
    }
}

}  // namespace study
