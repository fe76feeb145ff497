/* test_c TABLE: rollbem.h as a C program uses it. Prints what it gets, in full digits, and fails where identities
   do. */
#include <math.h>
#include <rollbem.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* isnan of some C libraries converts to float. */
static int is_nan(double x) { return x != x; }

static void expect(int true_, const char *what) {
    if (true_) return;
    fprintf(stderr, "failed: %s (%s)\n", what, rollbem_last_error());
    exit(1);
}

/* The largest difference of the tangent by x from a central difference of forces under solve(x), over |f|. */
static double tangent_error(void (*solve)(double x, double *force), double x, double h, const double *tangent) {
    double up[3], down[3], error = 0, size = 0;
    solve(x + h, up);
    solve(x - h, down);
    for (int i = 0; i < 3; ++i) {
        if (is_nan(tangent[i])) return NAN;
        error = fmax(error, fabs((up[i] - down[i]) / (2 * h) - tangent[i]));
        size = fmax(size, fabs(tangent[i]));
    }
    return error / size;
}

static rollbem_table *table;
static double contact[9] = {6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 1e-3, 5e-4, 0.1};
static int varied;

static void look_up(double x, double *force) {
    double other[9];
    memcpy(other, contact, sizeof other);
    other[varied] = x;
    expect(rollbem_table_forces(table, 1, other, force, NULL) == ROLLBEM_OK, "look-up");
}

static void test_table(const char *path) {
    expect(rollbem_table_open("no such file") == NULL, "a table that does not exist");
    expect(strstr(rollbem_last_error(), "no such file") != NULL, "its name in the message");
    table = rollbem_table_open(ODD_TABLE);
    expect(table != NULL, "a table whose path has spaces, an umlaut and a percent sign");
    rollbem_table_close(table);
    table = rollbem_table_open(path);
    expect(table != NULL, "table");
    double contacts[8 * 9], forces[8 * 3], tangents[8 * 21];
    for (int i = 0; i < 8; ++i) {
        memcpy(contacts + 9 * i, contact, sizeof contact);
        contacts[9 * i + 5] *= 1 + 0.1 * i;
    }
    expect(rollbem_table_forces(table, 8, contacts, forces, tangents) == ROLLBEM_OK, "8 look-ups");
    printf("table %.17g %.17g %.17g\n", forces[0], forces[1], forces[2]);
    /* columns of the contact behind the parts of the tangent */
    static const int columns[7] = {6, 7, 8, 5, 4, 0, 1};
    for (int k = 0; k < 7; ++k) {
        varied = columns[k];
        const double x = contact[varied];
        expect(tangent_error(look_up, x, 1e-5 * x, tangents + 3 * k) < 1e-6, "a tangent of the table");
    }
    /* beyond a/b = 10 forces equal the forces of a/b = 10 and the same area */
    double alike[2 * 9], border[2 * 3];
    for (int i = 0; i < 2; ++i) {
        memcpy(alike + 9 * i, contact, sizeof contact);
        alike[9 * i] = 5e-3 * sqrt(i == 0 ? 20 : 10);
        alike[9 * i + 1] = 25e-6 / alike[9 * i];
    }
    memcpy(contacts + 9 * 2, alike, sizeof contact);
    memcpy(contacts + 9 * 6, alike, sizeof contact);
    expect(rollbem_table_forces(table, 2, alike, border, NULL) == ROLLBEM_OFF_TABLE, "a contact off the table");
    expect(rollbem_table_forces(table, 1, alike + 9, border, NULL) == ROLLBEM_OK, "one on its border");
    expect(rollbem_table_forces(table, 8, contacts, forces, tangents) == ROLLBEM_OFF_TABLE,
           "two contacts off the table");
    expect(strstr(rollbem_last_error(), "a/b = 20 ") && strstr(rollbem_last_error(), "(contact 2)"),
           "the first of them");
    for (int i = 0; i < 3; ++i) {
        expect(fabs(forces[6 + i] - border[i]) < 1e-9 * fabs(border[0]), "the forces of the border");
    }
    contacts[9 * 3 + 5] = NAN;
    contacts[9 * 5] = -1;
    expect(rollbem_table_forces(table, 8, contacts, forces, tangents) == ROLLBEM_FAILED, "a load that is no number");
    expect(strstr(rollbem_last_error(), "(contact 3)") != NULL, "the first that failed, not the first off the table");
    expect(is_nan(forces[9]) && is_nan(forces[15]) && is_nan(tangents[21 * 5]) && !is_nan(forces[12]),
           "results beside those that failed");
    rollbem_table_close(table);
}

static void test_hertz(void) {
    const double radii[4] = {0.46, 0.46, INFINITY, INFINITY}, bodies[4] = {2.1e11, 0.28, 2.1e11, 0.28};
    double sphere[5];
    expect(rollbem_hertz(1e5, radii, 0, bodies, sphere) == ROLLBEM_OK, "Hertz");
    const double a = cbrt(3 * 1e5 * 0.46 * 2 * (1 - 0.28 * 0.28) / 2.1e11 / 4); /* a sphere on a plane */
    expect(fabs(sphere[0] / a - 1) < 1e-14 && fabs(sphere[1] / a - 1) < 1e-14, "semi-axes of a sphere");
    expect(fabs(sphere[2] / (a * a / 0.46) - 1) < 1e-13, "approach of a sphere");
    expect(rollbem_hertz(-1, radii, 0, bodies, sphere) == ROLLBEM_INVALID, "a negative load");
    expect(strstr(rollbem_last_error(), "load = -1") != NULL, "name and value in the message");
    double c[5];
    expect(rollbem_kalker(1, 0.25, 16, c) == ROLLBEM_OK, "Kalker's coefficients");
    printf("kalker %.17g %.17g %.17g %.17g %.17g\n", c[0], c[1], c[2], c[3], c[4]);
    expect(fabs(c[0] / 4.12 - 1) < 0.01 && fabs(c[1] / 3.67 - 1) < 0.01 && fabs(c[2] / 1.47 - 1) < 0.02,
           "Kalker's table at a/b = 1"); /* Kalker 1990, Appendix E: two decimals */
    expect(rollbem_kalker(50, 0.28, 12, c) != ROLLBEM_OK && c[0] > 0 && is_nan(c[4]), "what few elements do not give");
}

static rollbem_patch *patch;
static int steadily;

static void roll(double x, double *force) {
    double at[4] = {1e-3, 5e-4, 0.1, 8.2e4};
    at[varied] = x;
    expect((steadily ? rollbem_patch_steady(patch, at, at[3], force, NULL, NULL)
                     : rollbem_patch_step(patch, 1e-3, at, at[3], force, NULL, NULL)) == ROLLBEM_OK,
           "rolling");
}

static void test_patch(void) {
    expect(rollbem_patch_new(6e-3, 4e-3, 8.2e10, 0.7, 0.3, 8e4, 6, 6) == NULL, "a wrong Poisson's ratio");
    patch = rollbem_patch_new(6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 6, 6);
    expect(patch != NULL, "patch");
    const double creepage[3] = {1e-3, 5e-4, 0.1};
    double force[3], again[3], settled[3], tangent[12], heat;
    for (int i = 0; i < 10; ++i) {
        expect(rollbem_patch_step(patch, 1e-3, creepage, 8e4, force, NULL, &heat) == ROLLBEM_OK && heat >= 0, "step");
        rollbem_patch_accept(patch);
    }
    double *const state = malloc(rollbem_patch_state_size(patch) * sizeof(double));
    if (state == NULL) abort();
    rollbem_patch_get_state(patch, state);
    const double at[4] = {creepage[0], creepage[1], creepage[2], 8.2e4};
    for (steadily = 1; steadily >= 0; --steadily) {
        expect((steadily ? rollbem_patch_steady(patch, creepage, at[3], force, tangent, NULL)
                         : rollbem_patch_step(patch, 1e-3, creepage, at[3], force, tangent, NULL)) == ROLLBEM_OK,
               "forces with tangents");
        for (varied = 0; varied < 4; ++varied) {
            expect(tangent_error(roll, at[varied], 1e-5 * at[varied], tangent + 3 * varied) < 1e-5,
                   steadily ? "a tangent of rolling" : "a tangent of a step");
        }
    }
    rollbem_patch *const copy = rollbem_patch_new(6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 6, 6);
    expect(copy != NULL && rollbem_patch_set_state(copy, state) == ROLLBEM_OK, "a copy");
    expect(rollbem_patch_step(copy, 1e-3, creepage, 8.2e4, again, NULL, NULL) == ROLLBEM_OK, "its step");
    expect(memcmp(force, again, sizeof force) == 0, "a copy goes on with the same bits");
    printf("patch %.17g %.17g %.17g\n", force[0], force[1], force[2]);
    for (int i = 0; i < 40; ++i) {
        expect(rollbem_patch_step(copy, 2e-3, creepage, 8e4, again, NULL, NULL) == ROLLBEM_OK, "step");
        rollbem_patch_accept(copy);
    }
    expect(rollbem_patch_steady(copy, creepage, 8e4, settled, NULL, &heat) == ROLLBEM_OK, "steady rolling");
    for (int i = 0; i < 3; ++i) {
        expect(fabs(again[i] - settled[i]) < 1e-6 * fabs(settled[0]), "steps that settle at steady rolling");
    }
    expect(rollbem_patch_step(copy, 1e-3, creepage, -1, again, NULL, NULL) == ROLLBEM_FAILED && is_nan(again[0]),
           "a negative load");
    free(state);
    rollbem_patch_free(copy);
    rollbem_patch_free(patch);
}

static void test_wheel(void) {
    rollbem_wheel *const wheel = rollbem_wheel_new(NULL, 0, NULL, 0, NULL);
    expect(wheel != NULL, "wheel");
    double patches[2 * 12];
    size_t count;
    expect(rollbem_wheel_carry(wheel, 1e-3, 0, 0, 1e5, 2, patches, &count) == ROLLBEM_OK && count >= 1, "contact");
    printf("wheel");
    for (int i = 0; i < 12; ++i) printf(" %.10g", patches[i]);
    printf("\n");
    expect(fabs(patches[5] * cos(patches[3]) / 1e5 - 1) < 1e-3 || count > 1, "the vertical load is carried");
    for (int i = 0; i < 2; ++i) {
        expect(rollbem_wheel_carry(wheel, 0, 0, 0, -i, 2, patches, &count) == ROLLBEM_INVALID && count == 0 &&
                   strstr(rollbem_last_error(), "load") != NULL,
               "a load that is not positive");
    }
    expect(rollbem_wheel_carry(wheel, 1, 0, 0, 1e5, 2, patches, &count) == ROLLBEM_FAILED && count == 0,
           "a wheel beside the rail");
    rollbem_wheel_free(wheel);
    const double points[8] = {0, 0, 1, 0, 0, 0, 1, 1};
    expect(rollbem_wheel_new(points, 4, NULL, 0, NULL) == NULL, "a profile that turns back");
}

/* Points of profiles [mm], z down but of the sphere's. */
static double sphere_z(double y) { return 100 - sqrt(1e4 - y * y); }
static double plane_z(double y) { return 0 * y; }
static double crowns_z(double y) { return (fabs(y) - 10) * (fabs(y) - 10) / 600; }

static void write_profile(const char *path, double (*z)(double)) {
    FILE *const file = fopen(path, "w");
    if (file == NULL) abort();
    fprintf(file, "# y z\n");
    for (double y = -20; y <= 20; y += 0.5) fprintf(file, "%.17g %.17g\n", y, z(y));
    fclose(file);
}

/* A sphere and a plane or a roller from files against Hertz. */
static void test_files(void) {
    const char *const sphere = "test_c sphere.txt", *const plane = "test_c plane.txt",
               *const crowns = "test_c crowns.txt";
    write_profile(sphere, sphere_z);
    write_profile(plane, plane_z);
    rollbem_wheel_options options;
    expect(rollbem_wheel_defaults(&options, sizeof options) == ROLLBEM_OK, "defaults");
    options.per_metre = 1000;
    options.wheel_mirror = ROLLBEM_MIRROR_Z;
    options.any_shape = options.by_origin = 1;
    options.rail_origin[0] = 0.75;
    options.rail_origin[1] = 0.002;
    options.radius = 0.1;
    options.cant = 0;
    const double bodies[4] = {2.0992e11, 0.28, 2.0992e11, 0.28}, load = 1e4;
    for (int roller = 0; roller < 2; ++roller) {
        if (roller) options.roller_radius = 0.3;
        const double radii[4] = {0.1, 0.1, roller ? 0.3 : INFINITY, INFINITY};
        double hertz[5], found[12], again[12], position[6] = {0};
        size_t n;
        rollbem_wheel *const wheel = rollbem_wheel_open(sphere, plane, &options);
        expect(wheel != NULL, "a sphere on a plane from files");
        expect(strcmp(rollbem_wheel_notes(wheel), "wheel: z mirrored\n") == 0, "what was done with the files");
        expect(rollbem_hertz(load, radii, 0, bodies, hertz) == ROLLBEM_OK, "Hertz");
        expect(rollbem_wheel_solve_for_load(wheel, position, load, 1, found, &n) == ROLLBEM_OK && n == 1, "its patch");
        expect(fabs(found[1] - 0.75) < 1e-6 && fabs(found[5] / load - 1) < 1e-5, "its place and load");
        expect(fabs(found[6] / hertz[2] - 1) < 2e-3 && fabs(found[7] / hertz[3] - 1) < 2e-3, "as by Hertz");
        expect(fabs(found[11] - 0.002 - found[6]) < 1e-7, "the height, from the rail's origin down");
        position[1] = found[11];
        expect(rollbem_wheel_solve_at_height(wheel, position, 1, again, &n) == ROLLBEM_OK, "the same height");
        expect(n == 1 && fabs(again[5] / load - 1) < 1e-3, "has the same load");
        position[1] = -1e-3;
        expect(rollbem_wheel_solve_at_height(wheel, position, 1, again, &n) == ROLLBEM_FAILED && n == 0,
               "a lifted wheel");
        expect(strstr(rollbem_last_error(), "no_contact") != NULL, "its status");
        rollbem_wheel_free(wheel);
    }
    /* two crowns displace each other, so that the wheel goes down further */
    double height[2];
    write_profile(crowns, crowns_z);
    for (int on = 0; on < 2; ++on) {
        double both[2 * 12];
        const double position[6] = {0};
        size_t n;
        options.interaction = on;
        rollbem_wheel *const wheel = rollbem_wheel_open(plane, crowns, &options);
        expect(wheel != NULL, "two crowns");
        expect(rollbem_wheel_solve_for_load(wheel, position, load, 2, both, &n) == ROLLBEM_OK && n == 2, "two patches");
        height[on] = both[11];
        rollbem_wheel_free(wheel);
    }
    expect(height[1] > height[0] + 5e-7, "their interaction");
    options.any_shape = 0;
    options.roller_radius = 0;
    expect(rollbem_wheel_open(sphere, plane, &options) == NULL && strstr(rollbem_last_error(), "width of the wheel"),
           "a sphere is no wheel");
    options.wheel_mirror = 4;
    expect(rollbem_wheel_open(sphere, plane, &options) == NULL, "a mirror that there is not");
    expect(rollbem_wheel_defaults(&options, 8) == ROLLBEM_INVALID, "a structure of another size");
    options.size = 8;
    expect(rollbem_wheel_open(NULL, NULL, &options) == NULL && strstr(rollbem_last_error(), "options.size = 8"),
           "options of another size");
    expect(rollbem_wheel_open("no such file", NULL, NULL) == NULL && strstr(rollbem_last_error(), "no such file"),
           "a profile that does not exist");
    remove(sphere);
    remove(plane);
    remove(crowns);
}

/* NULL, where none is allowed, is refused by name; every pointer in turn. */
static void refused(int code, const char *function, const char *argument) {
    char what[80];
    snprintf(what, sizeof what, "%s: %s = NULL must not be NULL", function, argument);
    expect(code == ROLLBEM_INVALID && strcmp(rollbem_last_error(), what) == 0, what);
}

static void test_null(const char *path) {
    rollbem_table *const open = rollbem_table_open(path);
    rollbem_patch *const whole = rollbem_patch_new(6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 4, 4);
    rollbem_wheel *const wheel = rollbem_wheel_new(NULL, 0, NULL, 0, NULL);
    double n[12] = {1, 1, 1, 1, 2e11, 0.3, 2e11, 0.3, 0, 0, 0, 0};
    size_t count;
    refused(rollbem_table_open(NULL) == NULL, "rollbem_table_open", "path");
    refused(rollbem_table_forces(NULL, 0, n, n, n), "rollbem_table_forces", "table");
    refused(rollbem_table_forces(open, 1, NULL, n, n), "rollbem_table_forces", "contacts");
    refused(rollbem_table_forces(open, 1, n, NULL, n), "rollbem_table_forces", "forces");
    expect(rollbem_table_forces(open, 0, NULL, NULL, NULL) == ROLLBEM_OK, "no contact needs no numbers");
    refused(rollbem_hertz(1, NULL, 0, n + 4, n), "rollbem_hertz", "radii");
    refused(rollbem_hertz(1, n, 0, NULL, n), "rollbem_hertz", "bodies");
    refused(rollbem_hertz(1, n, 0, n + 4, NULL), "rollbem_hertz", "result");
    refused(rollbem_kalker(1, 0.25, 4, NULL), "rollbem_kalker", "coefficients");
    refused(rollbem_patch_step(NULL, 1e-3, n, 8e4, n, n, n), "rollbem_patch_step", "patch");
    refused(rollbem_patch_step(whole, 1e-3, NULL, 8e4, n, n, n), "rollbem_patch_step", "creepage");
    refused(rollbem_patch_step(whole, 1e-3, n, 8e4, NULL, n, n), "rollbem_patch_step", "force");
    refused(rollbem_patch_steady(NULL, n, 8e4, n, n, n), "rollbem_patch_steady", "patch");
    refused(rollbem_patch_steady(whole, NULL, 8e4, n, n, n), "rollbem_patch_steady", "creepage");
    refused(rollbem_patch_steady(whole, n, 8e4, NULL, n, n), "rollbem_patch_steady", "force");
    rollbem_patch_accept(NULL);
    refused(ROLLBEM_INVALID, "rollbem_patch_accept", "patch");
    refused(rollbem_patch_state_size(NULL) == 0, "rollbem_patch_state_size", "patch");
    rollbem_patch_get_state(NULL, n);
    refused(ROLLBEM_INVALID, "rollbem_patch_get_state", "patch");
    rollbem_patch_get_state(whole, NULL);
    refused(ROLLBEM_INVALID, "rollbem_patch_get_state", "state");
    refused(rollbem_patch_set_state(NULL, n), "rollbem_patch_set_state", "patch");
    refused(rollbem_patch_set_state(whole, NULL), "rollbem_patch_set_state", "state");
    refused(rollbem_wheel_carry(NULL, 0, 0, 0, 1e5, 1, n, &count), "rollbem_wheel_carry", "wheel");
    refused(rollbem_wheel_carry(wheel, 0, 0, 0, 1e5, 1, NULL, &count), "rollbem_wheel_carry", "patches");
    refused(rollbem_wheel_carry(wheel, 0, 0, 0, 1e5, 1, n, NULL), "rollbem_wheel_carry", "count");
    expect(rollbem_wheel_carry(wheel, 0, 0, 0, 1e5, 0, NULL, &count) == ROLLBEM_OK && count == 1, "patches to count");
    expect(rollbem_wheel_new(NULL, 5, NULL, 0, NULL) == NULL &&
               strstr(rollbem_last_error(), "wheel_points = 5 must be 0"),
           "points of a wheel that are missing");
    expect(rollbem_wheel_new(NULL, 0, NULL, 5, NULL) == NULL &&
               strstr(rollbem_last_error(), "rail_points = 5 must be 0"),
           "points of a rail that are missing");
    rollbem_wheel *const standard = rollbem_wheel_open(NULL, NULL, NULL);
    refused(rollbem_wheel_solve_for_load(NULL, n, 1e5, 1, n, &count), "rollbem_wheel_solve_for_load", "wheel");
    refused(rollbem_wheel_solve_for_load(wheel, NULL, 1e5, 1, n, &count), "rollbem_wheel_solve_for_load", "position");
    refused(rollbem_wheel_solve_at_height(NULL, n, 1, n, &count), "rollbem_wheel_solve_at_height", "wheel");
    refused(rollbem_wheel_solve_at_height(wheel, NULL, 1, n, &count), "rollbem_wheel_solve_at_height", "position");
    refused(rollbem_wheel_solve_at_height(wheel, n, 1, n, NULL), "rollbem_wheel_solve_at_height", "count");
    refused(rollbem_wheel_defaults(NULL, sizeof(rollbem_wheel_options)), "rollbem_wheel_defaults", "options");
    double same[2][12];
    rollbem_wheel *const fresh = rollbem_wheel_new(NULL, 0, NULL, 0, NULL);
    expect(rollbem_wheel_carry(fresh, 1e-3, 0, 0, 1e5, 1, same[0], &count) == ROLLBEM_OK, "profiles by NULL");
    expect(rollbem_wheel_carry(standard, 1e-3, 0, 0, 1e5, 1, same[1], &count) == ROLLBEM_OK, "profiles by name");
    expect(memcmp(same[0], same[1], sizeof same[0]) == 0, "are the same");
    rollbem_wheel_free(fresh);
    rollbem_wheel_free(standard);
    rollbem_table_close(NULL);
    rollbem_patch_free(NULL);
    rollbem_wheel_free(NULL);
    rollbem_table_close(open);
    rollbem_patch_free(whole);
    rollbem_wheel_free(wheel);
}

static rollbem_contact_table *contacts_of_wheels;
static double motion[11] = {2e-3, 1e-3, 20, -43.5, 0.01, 0, 0, 0.02, 8e4, 0.3, 0};

/* Wheelsets by look-up: balance, tangents, and what lies beyond the table. */
static void test_contact_table(const char *path, const char *creep_path) {
    double force[6], other[6], tangent[66], points[40], heat, height[5], roll[5];
    const double loads[2] = {8e4, 9e4};
    expect(rollbem_contact_table_open("no such file") == NULL, "a contact table that does not exist");
    contacts_of_wheels = rollbem_contact_table_open(path);
    rollbem_table *const creep = rollbem_table_open(creep_path);
    expect(contacts_of_wheels != NULL, "contact table");
    expect(rollbem_contact_table_on_rails(contacts_of_wheels, 1, 0, loads, height, roll) == ROLLBEM_INVALID &&
           strstr(rollbem_last_error(), "lateral position = 1 must lie within +-") != NULL, "a position off the table");
    expect(rollbem_contact_table_on_rails(contacts_of_wheels, 2e-3, 1e-3, loads, height, roll) == ROLLBEM_OK,
           "on rails");
    double range[4], load[4];
    expect(rollbem_contact_table_range(contacts_of_wheels, range) == ROLLBEM_OK && range[0] > 8e-3 && range[2] < 8e4 &&
           range[3] > 9e4, "what the table covers");
    expect(rollbem_contact_table_on_rails(contacts_of_wheels, range[0], range[1], loads, other, points) == ROLLBEM_OK,
           "its border");
    const double equal[2] = {9e4, 9e4};
    expect(rollbem_contact_table_on_rails(contacts_of_wheels, 2e-3, 1e-3, equal, other, points) == ROLLBEM_OK,
           "equal loads");
    expect(rollbem_contact_table_support(contacts_of_wheels, ROLLBEM_RIGHT, 2e-3, 1e-3, other[0] + 0.75 * points[0],
                                         load) == ROLLBEM_OK && fabs(load[0] / equal[1] - 1) < 1e-9,
           "the right wheel carries its load at its height");
    expect(rollbem_contact_table_support(contacts_of_wheels, ROLLBEM_LEFT, 2e-3, 1e-3, other[0] - 0.75 * points[0],
                                         load) == ROLLBEM_OK && fabs(load[0] / equal[0] - 1) < 1e-9 && load[1] > 1e8,
           "and the left one, stiffly");
    expect(rollbem_contact_table_support(contacts_of_wheels, ROLLBEM_LEFT, 2e-3, 1e-3, -1e-2, load) == ROLLBEM_OK &&
           load[0] == 0, "a lifted wheel carries nothing");
    expect(rollbem_contact_table_support(contacts_of_wheels, ROLLBEM_LEFT, 2e-3, 1e-3, NAN, load) == ROLLBEM_INVALID,
           "no height");
    motion[10] = roll[0];
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_RIGHT, motion, force, tangent, points,
                                         &heat) == ROLLBEM_OK, "a wheel");
    expect(fabs(force[2] + motion[8]) < 1e-6 * motion[8] && heat > 0, "a wheel carries its load");
    printf("rolls");  /* for the other languages */
    for (int i = 0; i < 6; ++i) printf(" %.17g", force[i]);
    printf(" %.17g\n", height[0]);
    double share = 0;
    for (int i = 0; i < 4; ++i) share += points[10 * i];
    expect(fabs(share - 1) < 1e-12, "shares of zones");
    const double h = 1e-3;  /* of the pitch rate */
    motion[3] += h;
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_RIGHT, motion, other, NULL, NULL, NULL) ==
           ROLLBEM_OK, "another pitch rate");
    motion[3] -= h;
    expect(fabs((other[0] - force[0]) / h / tangent[18] - 1) < 0.01, "a tangent by the pitch rate");
    motion[10] = NAN;
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_LEFT, motion, other, tangent, NULL, NULL) ==
           ROLLBEM_OK && tangent[60] == 0, "without a roll");
    const double half[4] = {0.5, 0.5, 0.5, 0.5}, one[4] = {1, 1, 1, 1}, negative[4] = {1, 1, -1, 1};
    const double mu = motion[9];
    motion[9] = mu / 2;
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_LEFT, motion, force, NULL, NULL, NULL) ==
           ROLLBEM_OK, "half the friction");
    motion[9] = mu;
    expect(rollbem_contact_table_set_friction(contacts_of_wheels, ROLLBEM_LEFT, half) == ROLLBEM_OK &&
           rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_LEFT, motion, other, NULL, NULL, NULL) ==
           ROLLBEM_OK, "half the friction in all zones");
    for (int i = 0; i < 6; ++i) expect(other[i] == force[i], "forces with half the friction");
    expect(rollbem_contact_table_set_friction(contacts_of_wheels, ROLLBEM_LEFT, negative) == ROLLBEM_INVALID,
           "negative friction");
    expect(rollbem_contact_table_set_friction(contacts_of_wheels, ROLLBEM_LEFT, one) == ROLLBEM_OK, "as before");
    motion[0] = 1;
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, ROLLBEM_LEFT, motion, other, NULL, NULL, NULL) ==
           ROLLBEM_FAILED && is_nan(other[0]), "off the table");
    expect(strstr(rollbem_last_error(), "lateral position = 1 must lie within +-") != NULL, "which input, its range");
    expect(rollbem_contact_table_look_up(contacts_of_wheels, creep, 2, motion, other, NULL, NULL, NULL) ==
           ROLLBEM_INVALID, "no such side");
    rollbem_contact_table_close(contacts_of_wheels);
    rollbem_table_close(creep);
}

int main(int count, char **arguments) {
    if (count != 2) return 2;
    test_table(arguments[1]);
    test_hertz();
    test_patch();
    test_wheel();
    test_contact_table(CONTACT_TABLE, arguments[1]);  /* before files: other languages' tests need what it prints */
    test_files();
    test_null(arguments[1]);
    printf("rollbem %s\n", rollbem_version());
    return 0;
}
