// The library's topologies for options and their help.
#pragma once

#include <string>
#include <vector>

#include <rollbem/discretisation/mesh.hpp>

namespace study {

/// Names of all topologies, in the library's order.
std::vector<std::string> mesh_names();

/// Names of those whose grading this is.
std::vector<std::string> mesh_names(rollbem::Grading grading);

/// "a, b or c" with last = "or".
std::string listed(const std::vector<std::string>& words, const std::string& last);

}  // namespace study
