// What studies of problems in the time domain share: scenes whose model itself is stable, whether the plane model has exact
// solutions for a contact, which schemes can be stepped, and the options for that.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/adhesion/integrator.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/scene/contact.hpp>
#include <rollbem/status.hpp>

#include "options.hpp"
#include "scenes.hpp"

namespace study {

/// Whether all modes of the plane model decay, Lambda = ln(4b/a) + nu/(1-nu) > 0. Its exact solutions need that.
bool plane_model_decays(const rollbem::Contact<double>& contact);

/// Throws BadInput unless plane_model_decays.
void require_plane_model(const rollbem::Contact<double>& contact);

/// All cases of a problem in the time domain. Throws BadInput if make_scenes or require_plane_model does.
std::vector<Scene> make_non_steady_scenes(const Options& options, Methods methods = Methods::elements);

/// A sinusoidal creepage: amplitude * sin(omega q), omega in V/a.
struct Sine {
    double amplitude, omega;
};

/// Whether steps of dq follow a sine: omega dq <= 1, six steps a period.
inline bool resolves(double omega, double dq) { return omega * dq <= 1; }

/// --sine AMP,OMEGA. Throws BadInput unless both are finite, AMP is not 0 and OMEGA is positive.
Sine read_sine(const Options& options);

/// Declares --dq and --until, and reads them as 1 to 1e7 steps of dq, in units of a. With `mode`, only that option
/// makes steps. Throws BadInput.
struct Steps {
    double dq;
    std::size_t count;
};
void add_steps(Options& options, const std::string& mode = "");
Steps read_steps(const Options& options);

/// The name of an integrator in options and columns.
std::string word(rollbem::Integrator integrator);

/// --integrator, one of those `allowed`. Throws BadInput.
rollbem::Integrator read_integrator(const Options& options, const std::vector<rollbem::Integrator>& allowed);

/// Of elements or Chebyshev states; nothing if a matrix has entries that are not finite, as for b/a near the limits of
/// double.
std::optional<rollbem::RollingSystem<double>> system_if_finite(const Scene& scene);

/// The same, but throws BadInput, naming --aspect, if there is none.
rollbem::RollingSystem<double> system_of(const Scene& scene);

/// Further words of columns called status.
inline constexpr const char* unresolved = "unresolved";        ///< a sine with fewer than six steps in a period
inline constexpr const char* after_failure = "after_failure";  ///< of a run in time: a step before has failed
inline constexpr const char* unchecked = "unchecked";  ///< ok, except for the checks that --unchecked leaves out

/// steady_status of a scene's `system`.
std::string steady_status(const Scene& scene, const rollbem::RollingSystem<double>& system);

/// `status` or, if that is ok, the flaw that the scene's `system` shows in steady rolling: assists_creepage, coarse, or
/// not_converged for Chebyshev states.
std::string status_of(rollbem::Status status, const Scene& scene, const rollbem::RollingSystem<double>& system);

/// The flaw that the scene's discretisation shows in steady rolling, worded to follow "the scheme"; empty if there is
/// none.
std::string flaw_in_steady_rolling(const Scene& scene, const rollbem::RollingSystem<double>& system);

/// Throws BadInput unless --unchecked is given or steps of the scene's `system` tend to steady rolling: no eigenvalue
/// is unstable or uncertain, and steady rolling shows no flaw.
void require_steppable(const Options& options, const Scene& scene, const rollbem::RollingSystem<double>& system);

}  // namespace study
