// A contact that rolls in the time domain, in the units of the columns: one direction or both, a load that varies or not.
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <rollbem/adhesion/integrator.hpp>
#include <rollbem/friction/friction_contact.hpp>
#include <rollbem/normal/hertz_load.hpp>
#include <rollbem/rolling/run.hpp>
#include <rollbem/status.hpp>

#include "falling.hpp"
#include "load.hpp"
#include "pressure.hpp"
#include "support/options.hpp"
#include "support/scenes.hpp"

namespace friction {

/// Creepage ratios, or shifts in mu p0 a_0/G.
struct Ratios {
    double longitudinal = 0;
    std::optional<double> lateral{};  ///< nothing in one direction
    double spin = 0;                  ///< times a_0; of a shift an angle
};

/// What a step has come to, in the units of the columns.
struct Moment {
    double force_ratio = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> lateral_force_ratio{};  ///< nothing in one direction
    std::optional<double> moment_ratio{};         ///< by mu N_0 a_0; nothing in one direction
    double slip_work = 0, jump_work = 0;          ///< of the step
    double elastic_energy = 0;                    ///< at its end
    double complementarity_residual = std::numeric_limits<double>::quiet_NaN();
    std::ptrdiff_t stick_count = 0;
    int rounds = 0;
    std::optional<int> pivots{};
    rollbem::StepStatus status = rollbem::StepStatus::not_finite;
};

/// Starts at rest under the first load. What fails leaves it where it was. Lengths in a_0; load_ratio is N/N_0 at the
/// end of a step and has no effect where the load does not vary. At the rolling velocity 1; a rigid shift takes as long as
/// a step of `dq`.
class Rolling {
public:
    struct Units {
        double creepage, force;  ///< of full sliding
        double dq;
    };

    Rolling(const rollbem::FrictionContact& contact, const Units& units,
            const std::optional<rollbem::HertzLoad<double>>& hertz, double first_load_ratio);
    Rolling(const Rolling&) = delete;
    Rolling& operator=(const Rolling&) = delete;

    Moment settle(const Ratios& creepage);  ///< steady rolling under the present load
    Moment shift(const Ratios& shift);      ///< a rigid shift
    Moment advance(double dq, const Ratios& from, const Ratios& to, double load_ratio);

private:
    Moment read(const rollbem::FrictionStep<2>& step) const;

    rollbem::FrictionContact contact_;
    Units units_;
    std::optional<rollbem::HertzLoad<double>> hertz_;  // where the load varies
    rollbem::NormalLoad<double> load_;
    rollbem::Run<rollbem::FrictionContact> run_;
};

/// Begins a run, of a model that all runs share.
using StartRolling = std::function<std::unique_ptr<Rolling>()>;

/// For steps of `dq` [a_0], whose time a rigid shift takes where friction falls with slip. Throws BadInput where the
/// scene's scheme is not fit to be stepped, or to breathe.
StartRolling make_rolling(const study::Options& options, const study::Scene& scene, const Pressure& pressure,
                          const std::optional<study::LoadHistory>& load, bool both_directions,
                          const std::optional<FallingLaw>& falling, rollbem::Integrator integrator, double dq);

}  // namespace friction
