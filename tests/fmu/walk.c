/* walk LIBRARY DESCRIPTION: calls an FMU in every way that allocates memory, so that the address sanitizer can check
   that all of it is freed: two instances, saved and serialised states, rejected calls, errors, a reset. Prints forces, which are the same on all platforms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmu.h"

/* Of a patch: itself, then by table. */
static int mode = 1;

/* The first of the slip velocities; of a wheelset its lateral velocity. */
static const char *slip(const Fmu *fmu) {
    return has_variable(fmu, "lateral_velocity") ? "lateral_velocity" : "longitudinal_slip_velocity";
}

static const char *const force = "longitudinal_force";

static void start(const Fmu *fmu, fmi2Component instance) {
    expect(fmu->setup_experiment(instance, fmi2False, 0, 0, fmi2False, 0), fmi2OK, "fmi2SetupExperiment");
    if (has_variable(fmu, "mode")) set_integer(fmu, instance, "mode", mode);
    set_real(fmu, instance, slip(fmu), 1e-3);
    expect(fmu->enter_initialization_mode(instance), fmi2OK, "fmi2EnterInitializationMode");
    expect(fmu->exit_initialization_mode(instance), fmi2OK, "fmi2ExitInitializationMode");
}

static void roll(const Fmu *fmu, fmi2Component instance, int steps) {
    for (int i = 0; i < steps; ++i) {
        set_real(fmu, instance, "rolling_speed", 20 + i % 3);
        expect(fmu->do_step(instance, i * 1e-5, 1e-5, fmi2True), fmi2OK, "fmi2DoStep");
    }
}

static void walk(const Fmu *fmu) {
    fmi2Component instances[2];
    for (int k = 0; k < 2; ++k) {
        instances[k] = instantiate(fmu, "contact");
        start(fmu, instances[k]);
        roll(fmu, instances[k], 20);
    }
    fmi2FMUstate state = NULL, copy = NULL;
    expect(fmu->get_state(instances[0], &state), fmi2OK, "fmi2GetFMUstate");
    expect(fmu->get_state(instances[0], &state), fmi2OK, "fmi2GetFMUstate into the same");
    size_t size = 0;
    expect(fmu->serialized_size(instances[0], state, &size), fmi2OK, "fmi2SerializedFMUstateSize");
    char *const bytes = malloc(size);
    if (bytes == NULL) abort();
    expect(fmu->serialize(instances[0], state, bytes, size), fmi2OK, "fmi2SerializeFMUstate");
    expect(fmu->deserialize(instances[1], bytes, size, &copy), fmi2OK, "fmi2DeSerializeFMUstate");
    roll(fmu, instances[0], 5);
    expect(fmu->set_state(instances[1], copy), fmi2OK, "fmi2SetFMUstate");
    roll(fmu, instances[1], 5);
    if (get_real(fmu, instances[0], force) != get_real(fmu, instances[1], force)) {
        fprintf(stderr, "failed: a copy goes on in another way\n");
        exit(1);
    }

    printf("%.12g\n", get_real(fmu, instances[0], force));

    const fmi2ValueReference unknown = reference_of(fmu, force), known[2] = {reference_of(fmu, slip(fmu)),
                                                                                 reference_of(fmu, "rolling_speed")};
    const double seeds[2] = {1, 1};
    double derivative = 0;
    expect(fmu->directional_derivative(instances[0], &unknown, 1, known, 2, seeds, &derivative), fmi2OK,
           "fmi2GetDirectionalDerivative");
    const int before = messages;
    set_real(fmu, instances[0], "rolling_speed", -1);
    expect(fmu->do_step(instances[0], 0, 1e-5, fmi2True), fmi2Discard, "a step backwards");
    set_real(fmu, instances[0], "rolling_speed", (double)NAN);
    expect(fmu->do_step(instances[0], 0, 1e-5, fmi2True), fmi2Error, "a step at a speed that is no number");
    expect(fmu->do_step(instances[0], 0, 1e-5, fmi2True), fmi2Error, "a step after an error");
    expect(fmu->set_state(instances[0], state), fmi2OK, "fmi2SetFMUstate after an error");
    roll(fmu, instances[0], 5);
    bytes[size / 2] ^= 1;
    expect(fmu->deserialize(instances[0], bytes, size, &copy), fmi2Error, "a damaged state");
    if (messages != before + 4) {
        fprintf(stderr, "failed: %d messages in place of 4\n", messages - before);
        exit(1);
    }
    free(bytes);

    expect(fmu->reset(instances[0]), fmi2OK, "fmi2Reset");
    if (has_variable(fmu, "poisson_ratio")) {
        set_real(fmu, instances[0], "poisson_ratio", 0.7);
    } else {
        set_real(fmu, instances[0], "friction_coefficient", -1);
    }
    expect(fmu->enter_initialization_mode(instances[0]), fmi2OK, "fmi2EnterInitializationMode");
    expect(fmu->exit_initialization_mode(instances[0]), fmi2Error, "a wrong parameter");
    expect(fmu->reset(instances[0]), fmi2OK, "fmi2Reset");
    start(fmu, instances[0]);
    expect(fmu->terminate(instances[0]), fmi2OK, "fmi2Terminate");
    expect(fmu->free_state(instances[0], &copy), fmi2OK, "fmi2FreeFMUstate");
    expect(fmu->free_state(instances[0], &state), fmi2OK, "fmi2FreeFMUstate");
    for (int k = 0; k < 2; ++k) fmu->free_instance(instances[k]);
}

int main(int count, char **arguments) {
    if (count != 3) return 2;
    const Fmu fmu = load_fmu(arguments[1], arguments[2]);
    walk(&fmu);
    mode = 2;
    if (has_variable(&fmu, "mode")) walk(&fmu);
    free(fmu.description);
    printf("done\n");
    return 0;
}
