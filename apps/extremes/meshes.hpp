// A mesh from its name, in any scalar type.
#pragma once

#include <string_view>

#include <rollbem/discretisation/mesh.hpp>

#include "long_double.hpp"

namespace extremes {

template <class Scalar>
rollbem::Mesh<Scalar> make_mesh(const MeshName& mesh) {
    const std::string_view maker = mesh.maker;
    const Scalar parameter = static_cast<Scalar>(mesh.parameter);
    if (maker == "geometric") return rollbem::geometric_mesh<Scalar>(mesh.n, parameter);
    if (maker == "knothe") return rollbem::knothe_mesh<Scalar>(mesh.n, parameter);
    if (maker == "modified-knothe") return rollbem::modified_knothe_mesh<Scalar>(mesh.n, parameter);
    if (maker == "cosine") return rollbem::cosine_mesh<Scalar>(mesh.n);
    return rollbem::uniform_mesh<Scalar>(mesh.n);
}

}  // namespace extremes
