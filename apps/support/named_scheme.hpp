// Schemes by name: the discretisation of a contact in one word, MESH:METHOD[:PARAMETERS], as --scheme takes it and the
// columns `scheme` show it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>

#include "options.hpp"

namespace study {

/// A scheme by what its columns show. Texts are empty where the method has none.
struct NamedScheme {
    std::string method;  ///< of elements as --method; chebyshev, polynomial or closed-form
    std::string derivative{}, mesh_name{}, quadrature{}, nodes{};
    std::optional<double> alpha_L{}, alpha_T{}, lambda{};  ///< [-]; empty where the method has none
    std::optional<double> grading{};                       ///< [-]; empty where the mesh has none
    std::string strips{};                                  ///< of a patch: cosine or uniform, elsewhere empty
    bool richardson = false;                               ///< extrapolated from n/2 and n elements

    bool has_elements() const { return !mesh_name.empty(); }
    bool is_discrete() const { return has_elements() || method == "chebyshev"; }
    /// The topology of a named mesh.
    rollbem::Topology topology() const { return *rollbem::topology_named(mesh_name); }
    bool graded_by(std::string_view name) const {
        return grading.has_value() && rollbem::topology_info(topology()).grading == name;
    }
    /// The order of convergence, which extrapolation takes for granted.
    double order() const { return mesh_name == "cosine" ? 2 : 1; }
    /// The equations of elements.
    rollbem::AnyScheme equations() const;

    /// The shortest word for it.
    std::string word() const;
};

/// The values of --derivative with a method of elements.
std::vector<std::string> derivative_names(const std::string& method);

/// The default of --derivative: fd, but analytic for galerkin with exact quadrature, and none with nodes.
std::string usual_derivative(const NamedScheme& scheme);

/// The scheme of a word of --scheme; strips are for schemes of patches. Throws BadInput, which says what the wrong part
/// of the word may be.
NamedScheme scheme_named(const std::string& word, bool of_patch = false);

/// What --help says of --scheme; `further` continues it.
std::string scheme_help(const std::string& further = "");

/// The schemes of several words. Throws BadInput, also for a scheme that is there twice.
std::vector<NamedScheme> named_schemes(const std::vector<std::string>& words, bool of_patch = false);

}  // namespace study
