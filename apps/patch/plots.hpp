// The pictures of patch_study.
#pragma once

#include <string>
#include <vector>

#include "support/csv.hpp"
#include "support/plot.hpp"

namespace patch {

/// Creep coefficients over a/b with Kalker's table as points; over n if there is one a/b.
study::Plot draw_coefficients(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

/// Real and imaginary parts over the frequency.
study::Plot draw_responses(const std::vector<std::string>& columns, const std::vector<study::Row>& rows);

}  // namespace patch
