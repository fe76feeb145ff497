#include "references.hpp"

#include <cstddef>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/closed_form/friction.hpp>
#include <rollbem/reference/bessel.hpp>
#include <rollbem/reference/step_response.hpp>

#include "discretisations.hpp"
#include "norms.hpp"

namespace precision {

using rollbem::ArrayX;
using rollbem::Contact;
using rollbem::Mesh;

Values reference(const Contact<double>& contact, const Quantity& quantity) {
    const double nu = contact.poisson_ratio();
    switch (quantity.problem) {
        case Problem::steady: break;
        case Problem::harmonic: return {rollbem::reference::plane_c11({0, quantity.frequency}, nu, contact.aspect())};
        case Problem::step: {
            const rollbem::reference::StepResponse response(nu, contact.aspect());
            Values forces;
            for (std::size_t k = 0; k < steps; ++k) forces.emplace_back(response.step(static_cast<double>(k + 1)));
            return forces;
        }
        case Problem::friction: return {rollbem::carter_force_ratio(creepage_ratio)};
        case Problem::combined_friction:
            return values({contact, true, 1, 1}, *elements("richardson-cosine"), 640, quantity);
        case Problem::varying_load: {
            const Scene scene{contact, true, 1, 1};
            const Elements cosine = *elements("richardson-cosine");
            return extrapolated(scene, cosine, 320, [&](const Mesh<double>& mesh) {
                return load_forces(scene, cosine, mesh, Cover::breathing, 4);
            });
        }
    }
    return {rollbem::steady_c11(nu)};
}

double model_error(const Scene& scene, const Quantity& quantity) {
    if (scene.plane) return 0;
    const Elements cosine = *elements("cosine");
    const Mesh<double> mesh = rollbem::cosine_mesh(60);
    Scene plane = scene;
    plane.plane = true;
    if (quantity.problem != Problem::steady) {
        return error_of(quantity.problem, values(scene, cosine, mesh, Cover::largest, quantity),
                        values(plane, cosine, mesh, Cover::largest, quantity));
    }
    const ArrayX<double> own = steady(scene, cosine, mesh).unknowns.col(0),
                         other = steady(plane, cosine, mesh).unknowns.col(0);
    if (quantity.name == "traction") return weighted_norm(mesh, own - other) / weighted_norm(mesh, other);
    return (own * mesh.widths()).sum() / (other * mesh.widths()).sum() - 1;
}

}  // namespace precision
