// The files of precision_study: its rows, read again for --front, and those of --cheapest.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "front.hpp"
#include "scene.hpp"
#include "support/csv.hpp"
#include "support/options.hpp"

namespace precision {

inline constexpr std::ptrdiff_t largest_n = 100000;

const std::vector<std::string>& columns();

study::Row row(const Point& point);

/// The rows of this program's earlier output for the chosen quantities. Throws BadInput if they are malformed or do not
/// have one kernel, aspect, poisson, size_ratio and epsilon.
std::vector<Point> read_points(const study::Options& options, const std::vector<Quantity>& quantities);

/// The fastest scheme for every quantity and tolerance. Throws WriteError.
void write_cheapest(study::OutputFile& file, const std::vector<Point>& points, const std::vector<Quantity>& quantities);

}  // namespace precision
