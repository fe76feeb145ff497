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

/// The force over the distance; beside it over the creepage where that changes, or with the line `steady` given.
study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          bool creepage_changes, const study::Series* steady);

}  // namespace friction
