// Elements and Chebyshev states as precision_study compares them, and their results for each of its problems: not a
// number if the status is not ok.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/accuracy/richardson.hpp>
#include <rollbem/adhesion/steady.hpp>
#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/discretisation/any_scheme.hpp>
#include <rollbem/discretisation/mesh.hpp>
#include <rollbem/spectral/chebyshev.hpp>

#include "scene.hpp"

namespace precision {

inline constexpr double creepage_ratio = 0.5;  ///< of the problems with friction
inline constexpr std::size_t steps = 10;       ///< of the response to a step, at q/a = 1 ... 10

/// A scheme with elements: a mesh for every n, and how its equations are set up.
struct Elements {
    rollbem::Topology topology;
    rollbem::AnyScheme scheme;
    double order = 0;  ///< of the extrapolation from n/2 and n; 0: none
};

const std::vector<std::pair<std::string, Elements>>& element_schemes();

/// The scheme of that name; nothing if it is not one of elements.
std::optional<Elements> elements(const std::string& name);

rollbem::Mesh<double> make_mesh(const Scene& scene, rollbem::Topology topology, long n);

rollbem::ElementSystem<double> system_of(const Scene& scene, const Elements& elements,
                                         const rollbem::Mesh<double>& mesh);
rollbem::RollingSystem<double> system_of(const Scene& scene, const rollbem::Chebyshev& method);

rollbem::Response<double> steady(const Scene& scene, const Elements& elements, const rollbem::Mesh<double>& mesh);
rollbem::Response<double> steady(const Scene& scene, const rollbem::Chebyshev& method);

/// A mesh that breathes with the contact, or that covers the largest one.
enum class Cover { breathing, largest };

/// -F/(mu N_0) after each of 160 steps in a period of the load, made of `parts` steps each.
Values load_forces(Scene scene, const Elements& elements, const rollbem::Mesh<double>& mesh, Cover cover,
                   std::size_t parts = 1);

/// What a quantity other than the traction consists of: c11; or the forces -F/(a G xi) at q/a = 1, 2, ... after a step
/// of creepage, exact in the time domain, -F/(mu N) at the creepage ratio, the same along and across at 45 degrees, or
/// load_forces().
Values values(const Scene& scene, const Elements& elements, const rollbem::Mesh<double>& mesh, Cover cover,
              const Quantity& quantity);
/// The same for n elements, extrapolated from two meshes if the scheme does so.
Values values(const Scene& scene, const Elements& elements, long n, const Quantity& quantity);
Values values(const Scene& scene, const rollbem::Chebyshev& method, const Quantity& quantity);

/// of(mesh), extrapolated from two meshes if the scheme does so.
template <class OfMesh>
Values extrapolated(const Scene& scene, const Elements& elements, long n, const OfMesh& of) {
    Values fine = of(make_mesh(scene, elements.topology, n));
    if (elements.order == 0) return fine;
    const Values coarse = of(make_mesh(scene, elements.topology, n / 2));
    for (std::size_t k = 0; k < fine.size(); ++k) fine[k] = rollbem::richardson(coarse[k], fine[k], elements.order);
    return fine;
}

/// Tractions of the elements of a mesh; if they are extrapolated, of pairs of elements, which form the coarser mesh.
struct Tractions {
    rollbem::Mesh<double> mesh;
    rollbem::ArrayX<double> values;
};
Tractions tractions(const Scene& scene, const Elements& elements, long n);

}  // namespace precision
