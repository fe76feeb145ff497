// The pictures of friction_study.
#pragma once

#include <string>
#include <vector>

#include "pressure.hpp"
#include "profiles.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace friction {

/// The creep curve, and beside it the tractions at the creepage nearest to half of full sliding, for the last mesh.
study::Plot creep_curve(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                        const Profiles& profiles, const Pressure& pressure, const std::vector<double>& ratios);

/// What a picture of a run in time shows beside the force.
struct TimePicture {
    bool creepage_changes, load_changes;
    bool carter;   ///< his force, that of steady rolling
    double ratio;  ///< largest creepage ratio
    double end;    ///< of the run [a_0]
};

/// The forces over the distance, with the load where it changes; beside them over the creepage where that changes.
study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const TimePicture& shown);

}  // namespace friction
