/* rollbem.h: creep forces for programs in C, Fortran, Python and whatever else calls C. Link librollbem (rollbem.dll).

   SI units; x is the rolling direction, forces act on the wheel, and a positive creepage (wheel against rail) gives a
   negative force. Vectors of creepage are (longitudinal [-], lateral [-], spin [1/m]), of forces (F_x [N], F_y [N], M_z
   [N m] about the middle of the contact). Functions that return int return ROLLBEM_OK, or what went wrong, which
   rollbem_last_error() says in one line; those that return a handle return NULL then. No exception leaves the library.
   A table may be shared by threads; a patch or a wheel belongs to one thread at a time. */
#ifndef ROLLBEM_H
#define ROLLBEM_H

#include <stddef.h>

#if !defined(_WIN32)
#define ROLLBEM_API __attribute__((visibility("default")))
#elif defined(ROLLBEM_BUILDING)
#define ROLLBEM_API __declspec(dllexport)
#else
#define ROLLBEM_API __declspec(dllimport)
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
    ROLLBEM_OK = 0,
    ROLLBEM_INVALID = 1,  /* an argument breaks its rule, or a file could not be read */
    ROLLBEM_FAILED = 2,   /* the computation has no result; results are NaN */
    ROLLBEM_OFF_TABLE = 3 /* forces are those of the table's border: their error is unknown */
};

/* What the last call that failed in this thread had to say; empty before the first one. */
ROLLBEM_API const char *rollbem_last_error(void);
ROLLBEM_API const char *rollbem_version(void);

/* --- creep forces by look-up -------------------------------------------------------------------------------------- */

typedef struct rollbem_table rollbem_table;

/* A file of creep_table, such as share/rollbem/steel.creep; the path in UTF-8. */
ROLLBEM_API rollbem_table *rollbem_table_open(const char *path);
ROLLBEM_API void rollbem_table_close(rollbem_table *table);

/* Forces of `count` elliptic contacts.
     contacts  count x 9: semi-axes a, b [m], shear modulus [Pa], Poisson's ratio, coefficient of friction, load [N],
               creepages
     forces    count x 3
     tangents  count x 21, or NULL: the derivatives of the 3 forces with respect to each of the 3 creepages, the load, the
               coefficient of friction, a and b, exact ones of the interpolation
   All contacts are computed. ROLLBEM_FAILED or ROLLBEM_INVALID if one of them has no forces (NaN); else
   ROLLBEM_OFF_TABLE if a/b of one lies beyond the table, where the nearest ellipse of the table with the same area
   stands for it. The message names the first such contact. */
ROLLBEM_API int rollbem_table_forces(const rollbem_table *table, size_t count, const double *contacts, double *forces,
                                     double *tangents);

/* --- Hertz and Kalker --------------------------------------------------------------------------------------------- */

/* Two smooth bodies under a load [N].
     radii   4: of the wheel along and across the rolling direction, of the rail likewise [m]; positive if convex,
             infinite if flat
     angle   by which the rail's planes are turned about z [rad]
     bodies  4: Young's modulus [Pa] and Poisson's ratio of the wheel, of the rail
     result  5: semi-axes a, b [m], approach [m], peak pressure [Pa], angle of the axis a from the rolling direction
             [rad] */
ROLLBEM_API int rollbem_hertz(double load, const double radii[4], double angle, const double bodies[4],
                              double result[5]);

/* Kalker's coefficients c11, c22, c23, c32, c33 of an ellipse in full adhesion, by n x n elements; with c = sqrt(a b):
   F_x = -G a b c11 xi, F_y = -G a b (c22 eta + c c23 phi), M_z = -G a b c (c32 eta + c c33 phi). */
ROLLBEM_API int rollbem_kalker(double a_over_b, double poisson_ratio, int n, double coefficients[5]);

/* --- a patch in the time domain ----------------------------------------------------------------------------------- */

typedef struct rollbem_patch rollbem_patch;

/* An ellipse with Coulomb friction under Hertz's pressure, at rest: semi-axes [m] under the load [N], from which they vary
   with its cube root; `strips` strips of `elements` elements. */
ROLLBEM_API rollbem_patch *rollbem_patch_new(double half_length, double half_width, double shear_modulus,
                                             double poisson_ratio, double friction_coefficient, double load,
                                             int elements, int strips);
ROLLBEM_API void rollbem_patch_free(rollbem_patch *patch);

/* Rolls on by a distance [m] under a load [N] at its end, from the present state; rollbem_patch_accept() makes the result
   the present state. Steps of one distance and load are cheapest.
     force      3
     tangent    12, or NULL: the derivatives of the 3 forces with respect to each of the 3 creepages and the load
     slip_work  1, or NULL: frictional heat of the step [J] */
ROLLBEM_API int rollbem_patch_step(rollbem_patch *patch, double distance, const double creepage[3], double load,
                                   double force[3], double tangent[12], double *slip_work);
/* The same of steady rolling, whose heat is per distance rolled [J/m]. */
ROLLBEM_API int rollbem_patch_steady(rollbem_patch *patch, const double creepage[3], double load, double force[3],
                                     double tangent[12], double *slip_work);
ROLLBEM_API void rollbem_patch_accept(rollbem_patch *patch);

/* The present state as numbers, which a patch of the same arguments goes on from. */
ROLLBEM_API size_t rollbem_patch_state_size(const rollbem_patch *patch);
ROLLBEM_API void rollbem_patch_get_state(const rollbem_patch *patch, double *state);
ROLLBEM_API int rollbem_patch_set_state(rollbem_patch *patch, const double *state);

/* --- a wheel on a rail, by their profiles ------------------------------------------------------------------------- */

typedef struct rollbem_wheel rollbem_wheel;

/* The right wheel of a wheelset on the right rail; for a left one, y, roll, yaw and lateral quantities are reversed.
     wheel, rail  points of the profiles, y to the right and z down [m] in turn, the wheel's from the tape circle, the
                  rail's from its top and canted; NULL and 0 points: S1002, UIC 60 canted by 1:40
     dimensions   NULL, or 7: gauge, depth at which it is measured, distance of the flanges' backs, tape circle from the
                  flange's back, radius of the tape circle [m], shear modulus [Pa], Poisson's ratio */
ROLLBEM_API rollbem_wheel *rollbem_wheel_new(const double *wheel, size_t wheel_points, const double *rail,
                                             size_t rail_points, const double dimensions[7]);
ROLLBEM_API void rollbem_wheel_free(rollbem_wheel *wheel);

/* The patches that carry a vertical load [N] at a lateral position [m], roll and yaw [rad] of the wheelset.
     patches  `most` x 12, NULL if `most` is 0, by decreasing load: x, y, z of the reference point in track axes [m], angle of the plane [rad],
              rolling radius [m], normal force [N], approach [m], peak pressure [Pa], area [m2], half-length, half-width
              [m], height of the wheelset [m]
     count    the number of patches, which may be above `most` */
ROLLBEM_API int rollbem_wheel_carry(rollbem_wheel *wheel, double lateral, double roll, double yaw, double load,
                                    size_t most, double *patches, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
