// The pictures of precision_study.
#pragma once

#include <vector>

#include "front.hpp"
#include "scene.hpp"
#include "support/csv.hpp"
#include "support/plot.hpp"

namespace precision {

/// Panels for up to three quantities; of more, those of c11, c11_z5 and friction_force that are there. Each shows the
/// error of every scheme over its time, and the front of `points`.
study::Plot pictures(const std::vector<Quantity>& quantities, const std::vector<study::Row>& rows,
                     const std::vector<Point>& points);

}  // namespace precision
