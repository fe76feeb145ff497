// modelDescription.xml and the documentation of an FMU, written from the table of its variables.
#pragma once

#include <string>

namespace fmu {

/// The text of modelDescription.xml.
std::string model_description();

/// The GUID in it: a hash of everything else in it, so that a library and a description match if and only if they say
/// the same.
const std::string& guid();

/// The variables as a table in Markdown.
std::string table_of_variables();

}  // namespace fmu
