// Scenes: what the common options ask for, as a list of contact, mesh, scheme and kernel to compute with.
// n is the outermost loop, then lambda, alpha_L and alpha_T.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/discretisation/scheme.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/scene/contact.hpp>

#include "options.hpp"

namespace study {

/// Whether b/a may be infinite: a problem in time needs G, which has no such limit.
enum class Problem { steady, non_steady };

/// One case to compute, and its names as they stand in the columns.
struct Scene {
    std::string method, derivative, mesh_name;
    std::optional<double> alpha_L{}, alpha_T{}, lambda{};  ///< [-]; empty where the method has none
    rollbem::Contact<double> contact;                      ///< a = G = 1
    std::shared_ptr<const rollbem::Mesh<double>> mesh;
    std::variant<rollbem::Collocation, rollbem::Galerkin, rollbem::KnotheBoundary> scheme;
    std::variant<rollbem::StripKernel<double>, rollbem::PlaneKernel<double>> kernel;

    Eigen::Index n() const { return mesh->size(); }

    /// function(mesh, scheme, kernel) with their own types.
    template <class Function>
    decltype(auto) visit(const Function& function) const {
        return std::visit([&](const auto& s, const auto& k) -> decltype(auto) { return function(*mesh, s, k); }, scheme,
                          kernel);
    }
};

/// The contact of --aspect and --poisson, with a = G = 1.
rollbem::Contact<double> make_contact(const Options& options, Problem problem);

/// All cases the common options ask for. Throws BadInput for values out of range and for options that would be ignored.
std::vector<Scene> make_scenes(const Options& options, Problem problem);

}  // namespace study
