// The checks that studies of non-steady problems share: whether the model itself is stable, whether the plane model has
// exact solutions for a contact, and which discretisations can be trusted and stepped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rollbem/scene/contact.hpp>
#include <rollbem/status.hpp>

#include "options.hpp"
#include "scenes.hpp"

namespace study {

/// Whether all modes of the plane model decay, Lambda = ln(4b/a) + nu/(1-nu) > 0. Its exact solutions need that.
bool plane_model_decays(const rollbem::Contact& contact);

/// Throws BadInput unless plane_model_decays.
void require_plane_model(const rollbem::Contact& contact);

/// All cases of a problem in the time domain. Throws BadInput if make_scenes or require_plane_model does.
std::vector<Scene> make_non_steady_scenes(const Options& options, const Methods& methods);

/// The system of elements or Chebyshev states; nothing if a matrix has entries that are not finite, as for b/a near the
/// limits of double.
std::optional<rollbem::RollingSystem<double>> system_if_finite(const Scene& scene);

/// The system; throws BadInput, naming --aspect, if there is none.
rollbem::RollingSystem<double> system_of(const Scene& scene);

/// `status` or, if that is ok, the flaw that the scene's `system` shows in steady rolling: assists_creepage, coarse, or
/// not_converged for Chebyshev states.
std::string status_of(rollbem::Status status, const Scene& scene, const rollbem::RollingSystem<double>& system);

/// The flaw that the scene's discretisation shows in steady rolling, worded to follow "the scheme"; empty if there is
/// none.
std::string flaw_in_steady_rolling(const Scene& scene, const rollbem::RollingSystem<double>& system);

/// Throws BadInput, which names --unchecked, unless steps of the scene's `system` tend to steady rolling: no eigenvalue
/// is unstable or uncertain, and steady rolling shows no flaw.
void require_steppable(const Scene& scene, const rollbem::RollingSystem<double>& system);

}  // namespace study
