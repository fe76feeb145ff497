// Line kernels: their concepts, StripKernel for a finite half-width b and PlaneKernel for the limit b >> a. They are
// independent of any mesh.
#pragma once

#include "kernel_concepts.hpp"
#include "plane_kernel.hpp"
#include "strip_kernel.hpp"
