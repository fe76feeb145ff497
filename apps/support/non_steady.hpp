// What studies of problems in time share: scenes whose model is stable before any discretisation, whether the exact
// solutions of the plane model exist for a contact, and which schemes are fit to be stepped.
#pragma once

#include <vector>

#include <rollbem/adhesion/stability_verdict.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/scene/contact.hpp>

#include "options.hpp"
#include "scenes.hpp"

namespace study {

/// Whether all modes of the plane model decay, Lambda = ln(4b/a) + nu/(1-nu) > 0. Its exact solutions need that.
bool plane_model_decays(const rollbem::Contact<double>& contact);

/// Throws BadInput unless plane_model_decays.
void require_plane_model(const Options& options, const rollbem::Contact<double>& contact);

/// All cases of a problem in time. Throws BadInput as make_scenes and require_plane_model do.
std::vector<Scene> make_non_steady_scenes(const Options& options);

/// A sinusoidal creepage: amplitude * sin(omega q), omega in V/a.
struct Sine {
    double amplitude, omega;
};

/// --sine AMP,OMEGA. Throws BadInput unless OMEGA is positive and finite and AMP fulfils the rule, whose text follows
/// "must be AMP,OMEGA with AMP".
Sine read_sine(const Options& options, const Rule& amplitude);

/// Throws BadInput unless steps of a scene's scheme tend to steady rolling: no eigenvalue is unstable or uncertain, and
/// steady rolling of its system is not inconsistent.
void require_steppable(const Scene& scene, const rollbem::StabilityVerdict& verdict,
                       const rollbem::ElementSystem<double>& system);

}  // namespace study
