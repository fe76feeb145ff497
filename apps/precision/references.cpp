#include "references.hpp"

#include <cmath>
#include <complex>
#include <cstddef>

#include <rollbem/reference/step_response.hpp>

#include "discretisations.hpp"
#include "norms.hpp"

namespace precision {

using rollbem::ArrayX;
using rollbem::Contact;
using rollbem::Mesh;

std::vector<double> exact_step_forces(const Contact<double>& contact) {
    const rollbem::reference::StepResponse response(contact.poisson_ratio(), contact.aspect());
    std::vector<double> forces;
    for (std::size_t k = 0; k < steps; ++k) forces.push_back(response.step(static_cast<double>(k + 1)));
    return forces;
}

std::vector<double> combined_reference(const Contact<double>& contact) {
    const Scene scene{contact, true, 1, 1};
    const Elements cosine = *elements("richardson-cosine");
    return all_combined_forces(scene, cosine, 640);
}

std::vector<double> load_reference(const Contact<double>& contact) {
    const Scene scene{contact, true, 1, 1};
    const Elements cosine = *elements("richardson-cosine");
    return evaluate_all(scene, cosine, 320, [&](const Mesh<double>& mesh) {
        return load_forces(scene, cosine, mesh, Cover::breathing, 4);
    });
}

double model_error(const Scene& scene, const Quantity& quantity) {
    if (scene.plane) return 0;
    const Elements cosine = *elements("cosine");
    const Mesh<double> mesh = rollbem::cosine_mesh(60);
    Scene plane = scene;
    plane.plane = true;
    switch (quantity.problem) {
        case Problem::harmonic:
            return std::abs(harmonic_c11(system_of(scene, cosine, mesh), quantity.frequency) /
                                harmonic_c11(system_of(plane, cosine, mesh), quantity.frequency) -
                            1.0);
        case Problem::step:
            return largest_difference(step_forces(scene, system_of(scene, cosine, mesh)),
                                      step_forces(plane, system_of(plane, cosine, mesh)));
        case Problem::friction: return friction_force(scene, cosine, mesh) / friction_force(plane, cosine, mesh) - 1;
        case Problem::combined_friction:
            return vector_error(combined_force(scene, cosine, mesh), combined_force(plane, cosine, mesh));
        case Problem::varying_load:
            return series_error(load_forces(scene, cosine, mesh, Cover::largest),
                                load_forces(plane, cosine, mesh, Cover::largest));
        default: break;
    }
    const ArrayX<double> own = steady(scene, cosine, mesh).traction, other = steady(plane, cosine, mesh).traction;
    if (quantity.name == "traction") return weighted_norm(mesh, own - other) / weighted_norm(mesh, other);
    return (own * mesh.widths()).sum() / (other * mesh.widths()).sum() - 1;
}

}  // namespace precision
