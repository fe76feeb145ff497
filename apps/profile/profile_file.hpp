// Profiles by name or from files: CSV of y and z, and the .prw and .prr text of multibody programs.
#pragma once

#include <string>

#include <rollbem/normal/profile.hpp>

#include "support/options.hpp"

namespace profile {

/// Declares --wheel, --rail, --length-unit, --cant and --smooth.
void add_profile_options(study::Options& options);

/// --wheel: z = 0 on the tape circle, as the file says.
rollbem::Profile read_wheel(const study::Options& options);

/// --rail, canted and moved down or up so that its highest point has z = 0. Throws BadInput, as read_wheel does.
rollbem::Profile read_rail(const study::Options& options);

}  // namespace profile
