// The pictures of friction_study.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "steady.hpp"
#include "support/plot.hpp"

namespace friction {

/// What options say of pressure, law, layer, load and, in the time domain, creepage, for a title; empty for Hertz's
/// pressure and a constant mu. Begins with ", " otherwise.
std::string scene_in_title(const study::Options& options);

/// The creep curve, with the other branches of a sweep, and beside it the tractions at the creepage nearest to half of
/// full sliding, for the last mesh.
study::Plot creep_picture(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const Curve& curve, const Tractions& tractions,
                          const std::vector<std::vector<std::pair<double, double>>>& others);

/// Both forces over the creepage ratio, a panel each, one line for each lateral ratio.
study::Plot combined_creep(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                           const Curve& curve);

/// What a picture of a time-domain run shows in addition to the force.
struct TimePicture {
    bool creepage_changes, load_changes;
    bool falling;         ///< mu falls with slip
    bool carter;          ///< his force in steady rolling
    double ratio;         ///< largest creepage ratio
    double end;           ///< distance rolled in the run [a_0]
    std::string scene{};  ///< for the title
};

/// The forces over the distance, with the load if it changes; in a second panel over the creepage if that changes.
study::Plot force_in_time(const std::vector<std::string>& columns, const std::vector<study::Row>& rows,
                          const TimePicture& shown);

}  // namespace friction
