// What patch_study --help says below the options.
#pragma once

#include <string>

#include "patch.hpp"

namespace patch {

/// With the columns of the coefficients.
inline std::string help(const std::string& columns) {
    return R"(Examples: Kalker's creep coefficients over a/b, beside the values of his table; a triangle, pointed in front
  patch_study --a-over-b 0.1,0.2,0.5,1,2,5,10 --poisson 0,0.25,0.5 --n 16 --output c.csv --plot c.svg
  printf 'y,x_trailing,x_leading\n-1,-1,-1\n0,-1,2\n1,-1,-1\n' > triangle.csv
  patch_study --n 12 --outline triangle.csv --strips 12
Whether all modes decay; creep curves with and without spin; one patch from above; a load that varies by half
  patch_study --a-over-b 0.2,1,5 --n 8,12 --stability
  patch_study --n 12 --longitudinal 0,0.1,0.2,0.3,0.4,0.5 --spin 0,0.3 --plot curves.svg
  patch_study --n 12 --a-over-b 2 --lateral 0.1 --spin 0.3 --tractions t.csv --plot patch.svg
  patch_study --n 12 --longitudinal 0.1 --spin 0.2 --transient --load-sine 0.5,8 --breathing --until 24

x is the rolling direction, y lies across it, z points into body 2 (the rail). Creepages xi, eta along x and y,
spin phi about z: F_x = -G a b (c11 xi + c12 eta + c13 c phi), F_y = -G a b (c21 xi + c22 eta + c23 c phi),
M_z = -G a b c (c31 xi + c32 eta + c33 c phi), c = sqrt(a b), about the origin of the outline; c32 = -c23 in the limit
of small elements if x -> -x leaves the patch unchanged. Bodies are equal half-spaces.
The patch is cut into strips along x, each with --n elements (rectangles) on a cosine mesh that ends on the
outline. With n = strips = 12 and a/b from 0.1 to 10 c11 and c22 are 0.5 % off, c23 1.4 %, c33 0.8 % (2.5 % at
nu = 0.5 or a/b >= 5). Four times as many elements as strips suit patches more than ten times longer than wide,
--n 48 --strips 12; c33 at nu = 0.5 takes more.
)" + columns +
           R"(--state-space: d x/d(q/a) = A x + B (xi, eta, phi c), (-F_x, -F_y, -M_z/c)/(G a b) = C x + D (xi, eta, phi c).
--outline: a row is a line y = const, which cuts the patch from x_trailing to x_leading; only the first and the last row
may have x_trailing = x_leading. a, b and c are sqrt(area/pi), and creepages, spin and moment refer to the origin of x
and y: put it where the bodies' motion is known. --strip-edges FILE puts edges of strips on corners of the outline.
--pressure: a grid of x and y, of an ellipse in a and b, of an outline in its unit; bilinear, outside zero. It must cover
nine tenths of the patch; element means are exact and scaled so that all of them carry N, so its unit does not matter,
nor a part of it that lies outside the patch, up to half. An outline needs it, an ellipse has Hertz's without it.

--longitudinal, --lateral, --spin: a row for every combination of the creepages, each solved from rest:
)" + friction_help() +
           R"(Errors of 12 x 12 elements: 1e-3 of mu N without spin, 6e-3 with spin in the mean and 2e-2 under large spin.
--plot draws up to three patches at one creepage from above, with y down: z points away from who looks. At the pole of
spin the rigid slip vanishes.

--transient: creepages are constant, have one value each, and are as above with N_0, a_0 and b_0: those of load_ratio 1.
p_0 is 3 N/(2 pi a b) always. One row for each step:
)" + transient_help() +
           R"(With --breathing, the default where --load has a_ratio,b_ratio and never vanishes, the mesh follows the ellipse,
also where a/b changes (second order in 1/n); where a changes by as much as the step rolls, status is needs_fixed_mesh
and the run ends. Otherwise the mesh covers the largest ellipse of the run: first order, and the load may vanish. Steps
are divided where --load has a row, and in halves, up to six times, where they have no solution. If a step fails, the
run has no more results, and the exit code is 1. A patch whose modes grow in time is refused (--stability shows them).
)";
}

}  // namespace patch
