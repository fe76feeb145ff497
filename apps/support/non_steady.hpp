// What studies of problems in time share: scenes whose model is stable before any discretisation, and whether the exact
// solutions of the plane model exist for a contact.
#pragma once

#include <cmath>
#include <variant>
#include <vector>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/elasticity/line_kernel.hpp>
#include <rollbem/scene/contact.hpp>

#include "csv.hpp"
#include "errors.hpp"
#include "options.hpp"
#include "scenes.hpp"

namespace study {

/// Whether all modes of the plane model decay, Lambda = ln(4b/a) + nu/(1-nu) > 0. Its exact solutions need that.
inline bool plane_model_decays(const rollbem::Contact<double>& contact) {
    return rollbem::plane_lambda(contact.poisson_ratio(), contact.aspect()) > 0;
}

/// Throws BadInput unless plane_model_decays.
inline void require_plane_model(const Options& options, const rollbem::Contact<double>& contact) {
    if (plane_model_decays(contact)) return;
    const double nu = contact.poisson_ratio();
    throw BadInput(options.said("aspect") +
                   " must be larger than exp(-nu/(1-nu))/4 = " + Cell(std::exp(-nu / (1 - nu)) / 4).text(4) +
                   " for the plane model: below, Lambda = ln(4b/a) + nu/(1-nu) is not positive and the model itself, "
                   "before any discretisation, is unstable in time; --kernel strip has no such limit");
}

/// All cases of a problem in time. Throws BadInput as make_scenes and require_plane_model do.
inline std::vector<Scene> make_non_steady_scenes(const Options& options) {
    std::vector<Scene> scenes = make_scenes(options, Problem::non_steady);
    const Scene& any = scenes.front();  // all have the same contact and kernel
    if (std::holds_alternative<rollbem::PlaneKernel<double>>(any.kernel)) require_plane_model(options, any.contact);
    return scenes;
}

}  // namespace study
