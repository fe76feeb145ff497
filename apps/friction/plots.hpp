// What the pictures of friction_study share.
#pragma once

#include <string>
#include <vector>

#include "support/options.hpp"
#include "support/plot.hpp"

namespace friction {

inline constexpr int line_points = 400;  ///< of an exact curve
inline const std::vector<std::string> scheme_columns{"method", "derivative", "mesh", "n", "alpha_L", "alpha_T"};

/// Carter's creep curve between two ratios, 0 included.
study::Series carter_curve(double from, double to);

/// Range of forces up to full sliding, for the signs that occur.
study::PlotRange force_range(const study::Plot& plot);

/// What forces and tractions are drawn in units of.
std::string coefficient(bool falling);
std::string creepage_label(bool falling, const std::string& ratio);
std::string force_label(bool falling, const std::string& force = "-F", const std::string& load = "N");

/// What options say of pressure, law, layer, load and, in the time domain, creepage, for a title; empty for Hertz's
/// pressure and a constant mu. Begins with ", " otherwise.
std::string scene_in_title(const study::Options& options);

}  // namespace friction
