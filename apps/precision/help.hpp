// What precision_study --help says below the options.
#pragma once

namespace precision {

inline constexpr const char* help = R"(Example: everything, with the cheapest schemes and a picture
  precision_study --output precision.csv --cheapest cheapest.csv --plot precision.svg

One row for each scheme, n and quantity. n counts elements, those of the finer mesh where two (n/2 and n) are
extrapolated; for chebyshev-states it is the number of states (1 to 48 without --n), for polynomial, the paper's
approach, the order; the closed form has none. relative_error is measured against the closed forms of the plane
model. traction: the norm of the differences from Carter's mean traction of each element over the norm of those
mean tractions, both with the weight sqrt(1 - x^2/a^2). Without the weight, Carter's traction, singular at the
trailing edge, has no such norm; with it, the norm bounds the error of the force.
step_force: the largest relative error at q/a = 1, 2, ... 10 after a step of creepage, exact in time.
friction_force: creepage ratio 0.5. closed-form: the difference of two closed forms where there are two.
combined_force: creepage ratio 0.5 at 45 degrees to the rolling direction; the error of the force as a vector,
|F - reference| over |reference|. load_force: creepage ratio 0.5 from steady rolling over a period of a load
N = N_0 (1 + 0.5 sin(2 pi q/(8 a_0))), in 160 steps of sdirk2; the largest error of F/(mu N_0). Collocation
and node differences on graded meshes breathe with the half-length where the kernel is plane; all other meshes
cover the largest contact. Neither force has a closed form: references are extrapolated from cosine meshes of 320
and 640 elements (160 and 320 that breathe, in 640 steps), to about 1e-6 and 4e-6.
time_us: from the mesh to the result, the median of at least 5 runs; all schemes take turns. stable: no
eigenvalue grows, as computed. on_front: no other scheme is both as fast and as precise; a scheme's error counts
as the largest at this and every larger n, so that a change of sign does not pass for precision. on_front is
empty for polynomial and closed-form, and with --shard or --jobs above 1, where times are missing: concatenate
the shards and use --front. model_error is the error that the strip kernel alone makes.
--plot draws up to three quantities; of more, those of c11, c11_z5 and friction_force that are there.
status: ok, or why relative_error is empty, by the library's names; in the file of --cheapest none where no
scheme reaches the tolerance. size_ratio and epsilon are empty except for geometric and knothe.
patch_c11 ... patch_c33: Kalker's creep coefficients of an ellipse between half-spaces, by n elements in each of as
many strips (--strips: others) along the rolling direction, with nodes-chebyshev or richardson-nodes (n/2 and
strips/2 as well); two more columns, a_over_b and strips. They have no closed form: the reference is extrapolated
from 24 x 24 and 48 x 48 elements; from 32 x 32 and 64 x 64 it differs by 2e-4 (a/b = 0.5, 1) and 6e-4 (a/b = 5, 20).
uniform-strips: strips of equal width, without --strips as many as recommended_patch gives (a/b from 0.1 to 25).
patch_force: -F_x and -F_y under Hertz's pressure for three creepages, xi with eta, spin alone, all three. Alone, each
would make 0.7, 2.5 and 0.6 mu N without slip (by Kalker's c11, c22, c23). relative_error is the largest
difference over mu N from strips of equal width, at most 500 elements, extrapolated from a third of them in each
direction; that reference is good to about 1e-3. time_us is that of all three from the mesh to the forces.
Times of patches are measured one after another. stable is empty above 256 elements. Without --n, n is 4 to 24, with
patch_force to 16.
Without --n, c11_z* stop at n = 320, step_force and the forces with friction at 160: two to three minutes in all.
)";

}  // namespace precision
