// What studies of problems in time share: scenes whose model is stable before any discretisation, and whether the exact
// solutions of the plane model exist for a contact.
#pragma once

#include <vector>

#include <rollbem/scene/contact.hpp>

#include "options.hpp"
#include "scenes.hpp"

namespace study {

/// Whether all modes of the plane model decay, Lambda = ln(4b/a) + nu/(1-nu) > 0. Its exact solutions need that.
bool plane_model_decays(const rollbem::Contact<double>& contact);

/// Throws BadInput unless plane_model_decays.
void require_plane_model(const Options& options, const rollbem::Contact<double>& contact);

/// All cases of a problem in time. Throws BadInput as make_scenes and require_plane_model do.
std::vector<Scene> make_non_steady_scenes(const Options& options);

}  // namespace study
