// Scenes: the cases that the common options ask for, each a contact, a mesh and a scheme or Chebyshev states, and a
// kernel. n is the outermost loop, then lambda, alpha_L, alpha_T, the mesh's grading, the aspect and Poisson's ratio.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/scene/contact.hpp>
#include <rollbem/spectral/chebyshev.hpp>
#include <rollbem/status.hpp>

#include "csv.hpp"
#include "named_scheme.hpp"
#include "options.hpp"
#include "plot.hpp"

namespace study {

/// Whether b/a may be infinite: a problem in the time domain needs G, which has no such limit.
enum class Problem { steady, non_steady };

/// The methods of a study besides elements on one mesh.
struct Methods {
    bool states = false;                     ///< Chebyshev's, which are for full adhesion
    bool closed = false;                     ///< polynomials and the closed form, which have a c11 alone
    std::string_view not_extrapolated = "";  ///< why there is no richardson:; empty where there is
};

/// One case to compute, and its names in the columns.
struct Scene : NamedScheme {
    rollbem::Contact contact;  ///< a = G = 1
    rollbem::AnyKernel<double> kernel;
    std::optional<rollbem::Chebyshev> chebyshev{};  ///< in place of mesh and equations
    std::shared_ptr<const rollbem::Mesh<double>> mesh{};
    std::shared_ptr<const rollbem::Mesh<double>> coarse{};  ///< of half as many elements, to extrapolate from
    rollbem::AnyScheme scheme{};
    Eigen::Index degree = 0;  ///< of a polynomial

    Eigen::Index n() const { return chebyshev ? chebyshev->states : mesh ? mesh->size() : degree; }
    /// The scene on each of its meshes alone, the coarse one last.
    std::vector<Scene> meshes() const;

    /// The label of the progress line.
    std::string label() const { return "n = " + std::to_string(n()); }

    bool is_plane() const { return kernel.model() == rollbem::LineModel::plane; }
};

/// The cell under a column: method, derivative, mesh, n, alpha_L, alpha_T, lambda or a column of `settings`.
Cell scene_cell(const Scene& scene, const std::string& column);

/// The columns that tell scenes apart behind the others, separated by commas; the gradings' names are among them.
inline const std::string distinctions = [] {
    std::string names = "kernel,aspect,poisson";
    for (const rollbem::TopologyInfo::Grading& grading : rollbem::gradings) names += std::string(",") + grading.name;
    return names + ",quadrature,nodes";
}();

/// The distinctions, and the scheme in one word.
inline const std::string settings = distinctions + ",scheme";

/// The names in a text that commas separate.
std::vector<std::string> columns_of(const std::string& text);

/// b/a, "inf" if it is infinite.
Cell aspect_cell(const rollbem::Contact& contact);

/// The contacts of --aspect and --poisson, with a = G = 1; the latter is the inner loop.
std::vector<rollbem::Contact> make_contacts(const Options& options, Problem problem);

/// The reason why studies of steady rolling refuse --lambda.
inline constexpr const char* no_lambda = "a steady problem builds no G, the only matrix lambda acts on";

/// Says in --help that --method takes chebyshev, too, and further methods of the study's own.
void offer_chebyshev(Options& options, const std::string& further = "");

/// Says in --help of --scheme which schemes the study takes besides elements.
void offer_schemes(Options& options, const Methods& methods);

/// A case of n elements or states, or of the order n of a polynomial; the plane alone knows cases without either.
/// Throws BadInput if they are too few for the mesh.
Scene make_scene(const NamedScheme& scheme, Eigen::Index n, const rollbem::Contact& contact, rollbem::LineModel model);

/// All cases that the common options ask for. Throws BadInput if a value is out of range or an option would be ignored.
std::vector<Scene> make_scenes(const Options& options, Problem problem, const Methods& methods);

/// Tractions on the coarse mesh of a scene, extrapolated from tractions on each of its meshes alone: a pair of fine
/// elements is a coarse one, on uniform and cosine meshes.
Eigen::ArrayXd extrapolate_tractions(const Scene& scene, const Eigen::ArrayXd& fine, const Eigen::ArrayXd& rough);

/// The words of columns called status in addition to the library's names.
inline constexpr const char* ok = "ok";
inline constexpr const char* coarse = "coarse";  ///< few elements, and an error of c11 above 50 %

/// What --help says of status where steady rolling tells that a scheme is of no use.
inline const std::string steady_flaws =
    "assists_creepage if tractions of steady rolling assist the creepage, so that the scheme does not converge to full "
    "adhesion (alpha at or below 0, near 0 on coarse meshes, or above 1); coarse if the steady c11 of fewer than 10 "
    "elements is wrong by more than half (plane kernel, or strip with b/a >= 10)";

/// The status of a solution in steady rolling: coarse if fewer than 10 elements give a c11 that differs by more than 50
/// % from the plane's exact one, with a wide kernel (plane, or strip with b/a >= 10).
std::string steady_status(const Scene& scene, rollbem::Status status, double c11);

/// Whichever of n, alpha_T, alpha_L and lambda the scenes vary most, for the x axis of a picture.
struct Axis {
    std::string column, label;
    std::vector<std::string> same{};  ///< columns that follow it

    bool is_n() const { return column == "n"; }
};
Axis most_varied(const std::vector<Scene>& scenes);

}  // namespace study
