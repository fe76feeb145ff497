// What studies of problems in time share: scenes whose model is stable before any discretisation, whether the exact
// solutions of the plane model exist for a contact, which schemes are fit to be stepped, and the options that say how.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <rollbem/adhesion/integrator.hpp>
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
std::vector<Scene> make_non_steady_scenes(const Options& options, Methods methods = Methods::elements);

/// A sinusoidal creepage: amplitude * sin(omega q), omega in V/a.
struct Sine {
    double amplitude, omega;
};

/// --sine AMP,OMEGA. Throws BadInput unless OMEGA is positive and finite and AMP fulfils the rule, whose text follows
/// "must be AMP,OMEGA with AMP".
Sine read_sine(const Options& options, const Rule& amplitude);

/// Declares --dq and --until, and reads them as so many steps of dq in units of a: from 1 to 1e7. `when` stands before
/// the text of --help. Throws BadInput.
struct Steps {
    double dq;
    std::size_t count;
};
void add_steps(Options& options, const std::string& when);
Steps read_steps(const Options& options);

/// How options and columns name an integrator.
std::string word(rollbem::Integrator integrator);

/// --integrator, one of those `allowed`. Throws BadInput.
rollbem::Integrator read_integrator(const Options& options, const std::vector<rollbem::Integrator>& allowed);

/// Of elements or Chebyshev states.
rollbem::RollingSystem<double> system_of(const Scene& scene);

/// What steady rolling holds against the scene's discretisation in full adhesion, to follow "the scheme"; empty where
/// that is nothing.
std::string flaw_in_steady_rolling(const Scene& scene, const rollbem::RollingSystem<double>& system);

/// Throws BadInput unless --unchecked is given or steps of the scene's `system` tend to steady rolling: no eigenvalue is
/// unstable or uncertain, and steady rolling has no flaw.
void require_steppable(const Options& options, const Scene& scene, const rollbem::RollingSystem<double>& system);

/// The system of a scene with elements, which friction asks for. Throws BadInput as require_steppable does.
rollbem::ElementSystem<double> steppable_system(const Options& options, const Scene& scene);

}  // namespace study
