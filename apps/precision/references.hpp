// References of precision_study, and the error of the model.
#pragma once

#include <rollbem/scene/contact.hpp>

#include "scene.hpp"

namespace precision {

/// What a quantity other than the traction consists of in the plane model, by closed forms where there are any, none of
/// which depends on an infinite aspect. The force in both directions is extrapolated from cosine meshes of 320 and 640
/// elements; from 640 and 1280 it differs by 7e-6 of itself. Those under a load that varies are extrapolated from
/// cosine meshes of 160 and 320 elements that breathe, in steps of a quarter of those of the schemes; from 320 and 640
/// in steps half as long they differ by at most 4e-6.
Values reference(const rollbem::Contact<double>& contact, const Quantity& quantity);

/// The relative difference that the kernel of the scene makes to the plane limit: the model's error, on one mesh.
double model_error(const Scene& scene, const Quantity& quantity);

}  // namespace precision
