/* walk LIBRARY DESCRIPTION: calls an FMU in every way that allocates memory, so that the address sanitizer can check
   that all of it is freed: two instances, saved and serialised states, rejected calls, errors, a reset, both
   interfaces. Prints forces, which are the same on all platforms. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmu.h"

/* Of a patch: itself, then by table. */
static int mode = 1;

/* The first of the slip velocities; of a wheelset its lateral velocity. */
static const char *slip(const Fmu *fmu) {
    return has_variable(fmu, "slip_velocity")      ? "slip_velocity"
           : has_variable(fmu, "lateral_velocity") ? "lateral_velocity"
                                                   : "longitudinal_slip_velocity";
}

static const char *force(const Fmu *fmu) { return has_variable(fmu, "force") ? "force" : "longitudinal_force"; }

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

static void walk_co_simulation(const Fmu *fmu) {
    fmi2Component instances[2];
    for (int k = 0; k < 2; ++k) {
        instances[k] = instantiate(fmu, "contact", fmi2CoSimulation);
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
    if (get_real(fmu, instances[0], force(fmu)) != get_real(fmu, instances[1], force(fmu))) {
        fprintf(stderr, "failed: a copy goes on in another way\n");
        exit(1);
    }

    printf("%.12g\n", get_real(fmu, instances[0], force(fmu)));

    const fmi2ValueReference unknown = reference_of(fmu, force(fmu)), known[2] = {reference_of(fmu, slip(fmu)),
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

static void walk_model_exchange(const Fmu *fmu) {
    enum { most = 100 };
    double states[most], rates[most];
    size_t count = 0;
    char name[32] = "displacement[0]";
    while (has_variable(fmu, name)) snprintf(name, sizeof name, "displacement[%d]", (int)++count);
    if (count == 0 || count > most) abort();
    const fmi2Component instance = instantiate(fmu, "contact", fmi2ModelExchange);
    start(fmu, instance);
    fmi2EventInfo info;
    expect(fmu->new_discrete_states(instance, &info), fmi2OK, "fmi2NewDiscreteStates");
    expect(fmu->enter_continuous_time_mode(instance), fmi2OK, "fmi2EnterContinuousTimeMode");
    expect(fmu->get_states(instance, states, count), fmi2OK, "fmi2GetContinuousStates");
    for (int i = 0; i < 100; ++i) {
        expect(fmu->set_time(instance, i * 1e-7), fmi2OK, "fmi2SetTime");
        expect(fmu->get_derivatives(instance, rates, count), fmi2OK, "fmi2GetDerivatives");
        for (size_t k = 0; k < count; ++k) states[k] += 1e-7 * rates[k];
        expect(fmu->set_states(instance, states, count), fmi2OK, "fmi2SetContinuousStates");
    }
    printf("%.12g\n", get_real(fmu, instance, force(fmu)));
    expect(fmu->set_states(instance, states, count + 1), fmi2Error, "one state too many");
    fmu->free_instance(instance);
}

int main(int count, char **arguments) {
    if (count != 3) return 2;
    const Fmu fmu = load_fmu(arguments[1], arguments[2]);
    walk_co_simulation(&fmu);
    mode = 2;
    if (has_variable(&fmu, "mode")) walk_co_simulation(&fmu);
    if (fmu.get_derivatives != NULL) walk_model_exchange(&fmu);
    free(fmu.description);
    printf("done\n");
    return 0;
}
