// The pictures of patch_study.
#pragma once

#include <string>
#include <vector>

#include "friction.hpp"
#include "friction/tractions.hpp"
#include "support/plot.hpp"

namespace patch {

/// Creep coefficients over a/b with Kalker's table as points; over n if there is one a/b.
study::Plot draw_coefficients(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Real and imaginary parts over the frequency.
study::Plot draw_responses(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Forces and moment over the creepage, or else a/b or n, that varies most.
study::Plot draw_friction(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Each patch at one creepage, side by side: outline, stick and slip, tractions as arrows, pole of spin.
study::Plot draw_from_above(const std::vector<Patch>& patches, const CreepPoint& point,
                            const friction::Tractions& tractions);

/// Forces and moment over the distance rolled, with the load if that varies: in one panel if there is one patch.
study::Plot draw_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                         bool load_varies);

}  // namespace patch
