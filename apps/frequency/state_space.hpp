// --state-space: the contact by one scheme as linear ordinary differential equations.
#pragma once

#include <memory>
#include <vector>

#include "support/options.hpp"
#include "support/scenes.hpp"
#include "support/state_space_files.hpp"

namespace frequency {

/// The files, still without their names; reduced to --states, if given. Throws BadInput unless there is one scene,
/// whose G is regular, whose tractions converge to full adhesion, and which decays where it is to be reduced, and if
/// the folder cannot be written; throws WriteError.
std::unique_ptr<study::StateSpaceFiles> state_space_files(const study::Options& options,
                                                          const std::vector<study::Scene>& scenes);

}  // namespace frequency
