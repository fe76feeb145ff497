#include "non_steady.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <rollbem/adhesion/stability.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/closed_form/detail/plane_lambda.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/steady/steady.hpp>

namespace study {

bool plane_model_decays(const rollbem::Contact& contact) {
    return rollbem::plane_lambda(contact.poisson_ratio(), contact.aspect()) > 0;
}

void require_plane_model(const rollbem::Contact& contact) {
    if (plane_model_decays(contact)) return;
    const double nu = contact.poisson_ratio();
    throw BadInput("--aspect = " + Cell(contact.aspect()).text(6) +
                   " must be larger than exp(-nu/(1-nu))/4 = " + Cell(std::exp(-nu / (1 - nu)) / 4).text(4) +
                   " for the plane model: below, Lambda = ln(4b/a) + nu/(1-nu) is not positive and the model itself, "
                   "before any discretisation, is unstable in time; --kernel strip has no such limit");
}

std::vector<Scene> make_non_steady_scenes(const Options& options, const Methods& methods) {
    std::vector<Scene> scenes = make_scenes(options, Problem::non_steady, methods);
    for (const Scene& scene : scenes) {
        if (scene.is_plane()) require_plane_model(scene.contact);
    }
    return scenes;
}

std::optional<rollbem::RollingSystem<double>> system_if_finite(const Scene& scene) {
    try {
        if (scene.chebyshev) return rolling_system(*scene.chebyshev, scene.kernel);
        return rolling_system(*scene.mesh, scene.scheme, scene.kernel);
    } catch (const std::invalid_argument&) {  // all else has been checked with the options
        return std::nullopt;
    }
}

rollbem::RollingSystem<double> system_of(const Scene& scene) {
    if (std::optional<rollbem::RollingSystem<double>> system = system_if_finite(scene)) return *std::move(system);
    throw BadInput("--aspect = " + aspect_cell(scene.contact).text() + " must be such that G and G' are finite");
}

std::string status_of(rollbem::Status status, const Scene& scene, const rollbem::RollingSystem<double>& system) {
    if (status != rollbem::Status::ok) return name(status);
    if (scene.chebyshev) return name(solve_steady(*scene.chebyshev, scene.kernel).status);
    const rollbem::Response<double> solution = rollbem::solve_steady(system);
    const std::string steady = steady_status(scene, solution.status, solution.c11());
    // a singular G' shows elsewhere, as an eigenvalue 0 or at the frequency 0
    return steady == coarse || steady == name(rollbem::Status::assists_creepage) ? steady : ok;
}

std::string flaw_in_steady_rolling(const Scene& scene, const rollbem::RollingSystem<double>& system) {
    const std::string status = status_of(rollbem::Status::ok, scene, system);
    if (status == ok) return "";
    if (scene.chebyshev) {
        return "has too few states for so narrow a strip: their error in steady rolling must be at most 1e-2";
    }
    if (status == coarse) return "has too few elements: the force of steady rolling is off by more than half";
    return "does not converge to full adhesion (alpha near or below 0, or above 1): its steady tractions must oppose "
           "the creepage";
}

void require_steppable(const Scene& scene, const rollbem::RollingSystem<double>& system) {
    const rollbem::StabilityVerdict verdict = rollbem::judge_stability(system);
    const std::string scheme = "n = " + std::to_string(scene.n()) + ": the scheme ";
    if (verdict.status != rollbem::Status::ok) {
        throw BadInput(scheme + "has eigenvalues that were not found; they must be, or --unchecked be given");
    }
    if (!verdict.stable()) {
        throw BadInput(scheme + "has " + std::to_string(verdict.unstable_count) + " unstable and " +
                       std::to_string(verdict.uncertain_count) +
                       " uncertain eigenvalues; it must be stable, or --unchecked be given");
    }
    const std::string flaw = flaw_in_steady_rolling(scene, system);
    if (!flaw.empty()) throw BadInput(scheme + flaw + ", or --unchecked be given");
}

}  // namespace study
