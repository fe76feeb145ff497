// Line kernels: what they are, StripKernel for a finite half-width b and PlaneKernel for its limit b >> a.
// None of them knows a mesh.
#pragma once

#include "../detail/language.hpp"

#include "kernel_concepts.hpp"
#include "plane_kernel.hpp"
#include "strip_kernel.hpp"
