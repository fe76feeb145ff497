/* cost LIBRARY DESCRIPTION: prints the times of fmi2DoStep and of the library's look-up. Fails if their forces differ.
 */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmu.h"
#include "library_steps.h"

enum { rounds = 1500 };
static const double duration = 2.5e-5; /* a tenth of the half-length at 20 m/s */

static double now_us(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e6 * (double)time.tv_sec + 1e-3 * (double)time.tv_nsec;
}

int main(int count, char **arguments) {
    if (count != 3) return 2;
    const Fmu fmu = load_fmu(arguments[1], arguments[2]);
    const int wheelset = !has_variable(&fmu, "spin_rate");
    double (*const library)(int) = wheelset ? library_wheelset : library_table;
    library_resources(fmu.resources + strlen("file://"));
    const fmi2Component instance = instantiate(&fmu, "contact");
    expect(fmu.setup_experiment(instance, fmi2False, 0, 0, fmi2False, 0), fmi2OK, "fmi2SetupExperiment");
    if (!wheelset) set_integer(&fmu, instance, "mode", 2);
    set_real(&fmu, instance, wheelset ? "lateral_velocity" : "longitudinal_slip_velocity", 1e-3);
    expect(fmu.enter_initialization_mode(instance), fmi2OK, "fmi2EnterInitializationMode");
    expect(fmu.exit_initialization_mode(instance), fmi2OK, "fmi2ExitInitializationMode");

    /* The shortest time of many short rounds, alternating: longer ones were interrupted. */
    const int steps = 100;
    double library_time = 1e30, fmu_time = 1e30, force = 0;
    for (int round = 0; round < rounds; ++round) {
        double start = now_us();
        force = library(steps);
        library_time = fmin(library_time, (now_us() - start) / steps);
        start = now_us();
        for (int i = 0; i < steps; ++i) {
            expect(fmu.do_step(instance, (round * steps + i) * duration, duration, fmi2True), fmi2OK, "fmi2DoStep");
        }
        fmu_time = fmin(fmu_time, (now_us() - start) / steps);
    }
    const double fmu_force = get_real(&fmu, instance, "longitudinal_force");
    printf("library %.3f us, fmi2DoStep %.3f us, difference %.3f us\n", library_time, fmu_time,
           fmu_time - library_time);
    printf("forces %.17g and %.17g N\n", force, fmu_force);
    fmu.free_instance(instance);
    free(fmu.description);
    return !(fabs(force - fmu_force) <= 1e-12 * fabs(force));
}
