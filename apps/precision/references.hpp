// References of precision_study for quantities without a closed form, and the error of the model.
#pragma once

#include <vector>

#include <rollbem/scene/contact.hpp>

#include "scene.hpp"

namespace precision {

/// -F/(a G xi) of the plane model at q/a = 1, 2, ... 10 after a step of creepage.
std::vector<double> exact_step_forces(const rollbem::Contact<double>& contact);

/// -F/(mu N) in both directions at a creepage ratio of 0.5 at 45 degrees, of the plane model. There is no closed form:
/// it is extrapolated from cosine meshes of 320 and 640 elements; from 640 and 1280 it differs by 7e-6 of itself.
std::vector<double> combined_reference(const rollbem::Contact<double>& contact);

/// -F/(mu N_0) of the plane model after each step over a period of a load that varies by half, at a creepage ratio of
/// 0.5 from steady rolling: extrapolated from cosine meshes of 160 and 320 elements that breathe, in steps of a quarter
/// of those of the schemes. From 320 and 640 in steps half as long it differs by at most 4e-6.
std::vector<double> load_reference(const rollbem::Contact<double>& contact);

/// The relative difference that the kernel of the scene makes to the plane limit: the model's error, on one mesh.
double model_error(const Scene& scene, const Quantity& quantity);

}  // namespace precision
