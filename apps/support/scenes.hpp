// Scenes: what the common options ask for, as a list of contact, mesh and scheme or Chebyshev states, and kernel to
// compute with. n is the outermost loop, then lambda, alpha_L and alpha_T.
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
#include <rollbem/spectral/chebyshev.hpp>

#include "options.hpp"

namespace study {

/// Whether b/a may be infinite: a problem in time needs G, which has no such limit.
enum class Problem { steady, non_steady };

/// What a study can compute with. Chebyshev states are for full adhesion.
enum class Methods { elements, elements_and_states };

/// One case to compute, and its names as they stand in the columns.
struct Scene {
    std::string method, derivative{}, mesh_name{};         ///< the latter two empty for Chebyshev states
    std::optional<double> alpha_L{}, alpha_T{}, lambda{};  ///< [-]; empty where the method has none
    rollbem::Contact<double> contact;                      ///< a = G = 1
    std::optional<rollbem::Chebyshev> chebyshev{};         ///< in place of mesh and scheme
    std::shared_ptr<const rollbem::Mesh<double>> mesh{};
    std::variant<rollbem::Collocation, rollbem::Galerkin, rollbem::KnotheBoundary> scheme{};
    std::variant<rollbem::StripKernel<double>, rollbem::PlaneKernel<double>> kernel;

    Eigen::Index n() const { return chebyshev ? chebyshev->states : mesh->size(); }

    /// What n counts, for the axis of a plot.
    std::string n_label() const { return std::string("number of ") + (chebyshev ? "states" : "elements") + " n"; }

    /// function(mesh, scheme, kernel) with their own types. Of elements only.
    template <class Function>
    decltype(auto) visit(const Function& function) const {
        return std::visit([&](const auto& s, const auto& k) -> decltype(auto) { return function(*mesh, s, k); }, scheme,
                          kernel);
    }

    /// The same of elements, and states(Chebyshev, kernel) of Chebyshev states; both return the same type.
    template <class Elements, class States>
    auto visit(const Elements& elements, const States& states) const {
        if (!chebyshev) return visit(elements);
        return std::visit([&](const auto& k) { return states(*chebyshev, k); }, kernel);
    }
};

/// The contact of --aspect and --poisson, with a = G = 1.
rollbem::Contact<double> make_contact(const Options& options, Problem problem);

/// Says in --help that --method takes chebyshev, too, and further methods of the study's own.
void offer_chebyshev(Options& options, const std::string& further = "");

/// All cases the common options ask for. Throws BadInput for values out of range and for options that would be ignored.
std::vector<Scene> make_scenes(const Options& options, Problem problem, Methods methods = Methods::elements);

}  // namespace study
