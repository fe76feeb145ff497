/* rollbem.h: creep forces for programs in C, Fortran, Python and other languages that call C. Link librollbem
   (rollbem.dll).

   SI units; x is the rolling direction, forces act on the wheel, and a positive creepage (wheel against rail) gives a
   negative force. Vectors of creepage are (longitudinal [-], lateral [-], spin [1/m]), of forces (F_x [N], F_y [N], M_z
   [N m] about the middle of the contact). Functions that return int return ROLLBEM_OK or the kind of failure; functions
   that return a handle return NULL on failure. rollbem_last_error() then has one line about it. No exception leaves the
   library. A table may be shared by threads; a patch or a wheel belongs to one thread at a time. */
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
    ROLLBEM_OFF_TABLE = 3 /* forces are taken at the table's border: their error is unknown */
};

/* Message of the last call that failed in this thread; empty before the first one. */
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
     tangents  count x 21, or NULL: the derivatives of the 3 forces with respect to each of the 3 creepages, the load,
               the coefficient of friction, a and b, exact for the interpolation
   All contacts are computed. ROLLBEM_FAILED or ROLLBEM_INVALID if one of them has no forces (NaN); else
   ROLLBEM_OFF_TABLE if a/b of one lies beyond the table, where the nearest ellipse of the table with the same area
   replaces it. The message names the first such contact. */
ROLLBEM_API int rollbem_table_forces(const rollbem_table *table, size_t count, const double *contacts, double *forces,
                                     double *tangents);

/* --- wheelsets by look-up ----------------------------------------------------------------------------------------- */

typedef struct rollbem_contact_table rollbem_contact_table;

/* A file of the program contact_table, such as share/rollbem/s1002_60e1.contact; the path in UTF-8. */
ROLLBEM_API rollbem_contact_table *rollbem_contact_table_open(const char *path);
ROLLBEM_API void rollbem_contact_table_close(rollbem_contact_table *table);

enum { ROLLBEM_LEFT = 0, ROLLBEM_RIGHT = 1 };

/* Forces of the rail on one wheel of a wheelset, in track axes: x forward, y to the right, z down.
     creep    the table of creep forces
     inputs   11: lateral position of the middle of the axle [m], yaw [rad]; its speeds along x [m/s], about the axle
              (negative when rolling forward [rad/s]), along y and z [m/s], about x and z [rad/s]; vertical load of the
              wheel [N], coefficient of friction, roll of the wheelset [rad] (NaN: under equal loads)
     force    6: F_x, F_y, F_z [N], M_x, M_y, M_z about the middle of the axle [N m]
     tangent  66, or NULL, which takes less time: the derivatives of the 6 with respect to each of the 11 inputs, exact
              for the interpolation; by the roll 0 where it is NaN
     points   4 x 10, or NULL, a row for each zone of the rail: share of the load (0: no contact), place from the middle
              of the axle [m], angle [rad], rolling radius [m], normal force [N], peak pressure [Pa], place y in the
              profiles of rail and wheel [m]; as on the right wheel
     heat     1, or NULL: heat of friction [W]
   ROLLBEM_FAILED beyond the table's shift or yaw (NaN), also where a roll amounts to such a shift, and where the wheel
   does not roll: then forces follow from its normal load alone. ROLLBEM_OFF_TABLE if the load lies beyond the table's
   loads: contacts are taken at its border, with an unknown error. */
ROLLBEM_API int rollbem_contact_table_look_up(const rollbem_contact_table *table, const rollbem_table *creep, int side,
                                              const double inputs[11], double force[6], double tangent[66],
                                              double points[40], double *heat);

/* Sets the friction of the zones of one wheel's rail over the coefficient of subsequent look-ups, such as 0.5 for a
   lubricated gauge face; 1 for each after opening. Zones have the order of `points`. No look-up may run meanwhile. */
ROLLBEM_API int rollbem_contact_table_set_friction(rollbem_contact_table *table, int side, const double factors[4]);

/* Height (positive down) and roll of a wheelset whose wheels carry vertical loads, left and right [N], and the
   derivatives of both with respect to lateral position, yaw and both loads. */
ROLLBEM_API int rollbem_contact_table_on_rails(const rollbem_contact_table *table, double lateral, double yaw,
                                               const double loads[2], double height[5], double roll[5]);

/* Load [N] of a wheel by normal forces at a height of its own, the wheelset's height plus 0.75 m times its roll (left:
   minus) [m], and its derivatives with respect to height, lateral position and yaw. 0 where the wheel does not touch.
   Profiles are assumed to meet as they do under equal loads. */
ROLLBEM_API int rollbem_contact_table_support(const rollbem_contact_table *table, int side, double lateral, double yaw,
                                              double height, double load[4]);

/* Range of a table: the largest lateral position [m] and yaw [rad], in both directions, the smallest and the largest
   load [N]. */
ROLLBEM_API int rollbem_contact_table_range(const rollbem_contact_table *table, double range[4]);

/* --- Hertz and Kalker --------------------------------------------------------------------------------------------- */

/* Two smooth bodies under a load [N].
     radii   4: the wheel's along and across the rolling direction, then the rail's [m]; positive if convex,
             infinite if flat
     angle   turn of the rail's planes about z [rad]
     bodies  4: Young's modulus [Pa] and Poisson's ratio of the wheel, then of the rail
     result  5: semi-axes a, b [m], approach [m], peak pressure [Pa], angle of the axis a from the rolling direction
             [rad] */
ROLLBEM_API int rollbem_hertz(double load, const double radii[4], double angle, const double bodies[4],
                              double result[5]);

/* Kalker's coefficients c11, c22, c23, c32, c33 of an ellipse in full adhesion, by n x n elements; with c = sqrt(a b):
   F_x = -G a b c11 xi, F_y = -G a b (c22 eta + c c23 phi), M_z = -G a b c (c32 eta + c c33 phi). Coefficients that
   n x n elements do not give are NaN, and the result is not ROLLBEM_OK. */
ROLLBEM_API int rollbem_kalker(double a_over_b, double poisson_ratio, int n, double coefficients[5]);

/* --- a patch in the time domain ----------------------------------------------------------------------------------- */

typedef struct rollbem_patch rollbem_patch;

/* An ellipse with Coulomb friction under Hertz's pressure, at rest: semi-axes [m] under the load [N]; they vary with
   the cube root of the load; `strips` strips of `elements` elements. */
ROLLBEM_API rollbem_patch *rollbem_patch_new(double half_length, double half_width, double shear_modulus,
                                             double poisson_ratio, double friction_coefficient, double load,
                                             int elements, int strips);
ROLLBEM_API void rollbem_patch_free(rollbem_patch *patch);

/* Rolls on by a distance [m] under a load [N] at its end, from the present state; rollbem_patch_accept() makes the
   result the present state. Steps of one distance and load are cheapest.
     force      3
     tangent    12, or NULL: the derivatives of the 3 forces with respect to each of the 3 creepages and the load
     slip_work  1, or NULL: frictional heat of the step [J] */
ROLLBEM_API int rollbem_patch_step(rollbem_patch *patch, double distance, const double creepage[3], double load,
                                   double force[3], double tangent[12], double *slip_work);
/* Steady rolling under a load [N]; slip_work is per distance rolled [J/m]. */
ROLLBEM_API int rollbem_patch_steady(rollbem_patch *patch, const double creepage[3], double load, double force[3],
                                     double tangent[12], double *slip_work);
ROLLBEM_API void rollbem_patch_accept(rollbem_patch *patch);

/* The present state as numbers, from which a patch made with the same arguments can continue. */
ROLLBEM_API size_t rollbem_patch_state_size(const rollbem_patch *patch);
ROLLBEM_API void rollbem_patch_get_state(const rollbem_patch *patch, double *state);
ROLLBEM_API int rollbem_patch_set_state(rollbem_patch *patch, const double *state);

/* --- a wheel on a rail, by their profiles ------------------------------------------------------------------------- */

typedef struct rollbem_wheel rollbem_wheel;

/* The right wheel of a wheelset on the right rail; for a left one, y, roll, yaw and lateral quantities are reversed.
     wheel, rail  points of the profiles, y to the right and z down [m] in turn, the wheel's from the tape circle, the
                  rail's from its top and canted; NULL and 0 points: S1002, 60E1 canted by 1:40
     dimensions   NULL, or 7: gauge, depth at which it is measured, distance of the flanges' backs, tape circle from the
                  flange's back, radius of the tape circle [m], shear modulus [Pa], Poisson's ratio */
ROLLBEM_API rollbem_wheel *rollbem_wheel_new(const double *wheel, size_t wheel_points, const double *rail,
                                             size_t rail_points, const double dimensions[7]);
ROLLBEM_API void rollbem_wheel_free(rollbem_wheel *wheel);

enum { ROLLBEM_MIRROR_Y = 1, ROLLBEM_MIRROR_Z = 2 };

/* Options for reading and placing profiles; rollbem_wheel_defaults() sets all of them. */
typedef struct rollbem_wheel_options {
    size_t size;              /* of this structure, as the program knows it [bytes]: later versions append to it */
    int wheel_mirror;         /* 0, or a sum of ROLLBEM_MIRROR_Y and _Z: coordinates of the wheel's file to reverse */
    int rail_mirror;          /* the same for the rail's file */
    int any_shape;            /* 1: pieces, planes and rollers, not checked to look like wheel and rail; else 0 */
    int by_origin;            /* 1: the rail is placed by rail_origin; 0: by gauge and gauge_depth */
    int interaction;          /* 1: patches of the wheel displace each other; 0: only those of one region do */
    double per_metre;         /* units of length in a metre, of files with two columns: 1 (default) or 1000 */
    double smooth;            /* wave length [m] that is halved, shorter ones vanish; 0 (default): none */
    double cant;              /* inward turn of the rail [rad]; default atan(1/40), 0 for canted profiles */
    double gauge;             /* distance between the rails, 1.435 [m] */
    double gauge_depth;       /* depth below their tops, down to which the gauge is the least distance, 0.014 [m] */
    double flange_back;       /* distance between the backs of the flanges, 1.36 [m] */
    double tape_offset;       /* distance of the wheel profile's origin from the flange's back, 0.07 [m] */
    double radius;            /* radius of the tape circle, 0.46 [m] */
    double rail_origin[2];    /* origin y, z of the rail's profile in track axes [m], about which it is canted */
    double roller_radius;     /* radius of a roller, from its axle to z = 0 [m], with by_origin; 0: a rail */
    double shear_modulus;     /* shear modulus of wheel and rail, 8.2e10 [Pa] */
    double poisson_ratio;     /* 0.28 [-] */
} rollbem_wheel_options;

/* Sets `size` bytes, sizeof(rollbem_wheel_options), to the defaults; the other members' default is 0,
   interaction's 1. */
ROLLBEM_API int rollbem_wheel_defaults(rollbem_wheel_options *options, size_t size);

/* The right wheel on the right rail, by the names of standard profiles or from files.
     wheel_path  "s1002" (NULL), or a file: two columns y, z, SIMPACK's .prw, MiniProf's .whl, or .slcw, sections round
                 the wheel; the path in UTF-8
     rail_path   "60e1" (NULL), "uic60", "54e1", or a file: two columns, .prr, .ban, or .slcs, sections along the track
     options     NULL: the defaults
   Profiles are checked to look like wheel and rail; messages name the remedy by the options of profile_study, which
   correspond to rollbem_wheel_options: --wheel-mirror, --length-unit mm (per_metre), --any-shape. */
ROLLBEM_API rollbem_wheel *rollbem_wheel_open(const char *wheel_path, const char *rail_path,
                                              const rollbem_wheel_options *options);

/* Notes of cleaning, turning and mirroring in the files, and of signs that they are not meant as they are read, a line
   each; the text lives as long as the wheel. */
ROLLBEM_API const char *rollbem_wheel_notes(const rollbem_wheel *wheel);

/* The patches that carry a vertical load [N] at a lateral position [m], roll and yaw [rad] of the wheelset.
     patches  `most` x 12, NULL if `most` is 0, by decreasing load: x, y, z of the reference point in track axes, x from
              the wheelset [m], angle of the plane [rad], rolling radius [m], normal force [N], approach [m], peak
              pressure [Pa], area [m2], half-length, half-width [m], height of the wheelset [m]
     count    the number of patches, which may be above `most` */
ROLLBEM_API int rollbem_wheel_carry(rollbem_wheel *wheel, double lateral, double roll, double yaw, double load,
                                    size_t most, double *patches, size_t *count);

/* The patches at a position on a track and of a wheel that change along the way, under a load [N] or at a given height.
     position  6: lateral, height [m] (positive down; not used under a load), roll, yaw [rad], x along the track [m],
               pitch about the axle [rad] */
ROLLBEM_API int rollbem_wheel_solve_for_load(rollbem_wheel *wheel, const double position[6], double load, size_t most,
                                             double *patches, size_t *count);
ROLLBEM_API int rollbem_wheel_solve_at_height(rollbem_wheel *wheel, const double position[6], size_t most,
                                              double *patches, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
