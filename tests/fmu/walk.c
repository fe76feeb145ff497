/* walk LIBRARY DESCRIPTION: an FMU as a C program loads it, with variables by the names in its modelDescription.xml,
   called in every way that allocates memory, so that the address sanitizer can check that all of it is freed: two
   instances, saved and serialised states, rejected calls, errors, a reset. Prints forces, which are the same on all
   platforms, and on stderr the time of a step. */
#include <fmi2FunctionTypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifdef _WIN32
#include <windows.h>
#define dlopen(path, how) (void*)LoadLibraryA(path)

static void* dlsym(void* library, const char* name) {
    const FARPROC function = GetProcAddress((HMODULE)library, name);
    void* address;
    memcpy(&address, &function, sizeof address);
    return address;
}
#else
#include <dlfcn.h>
#endif

/* The functions called, by their names in FMI and here. */
#define FMU_FUNCTIONS(X) \
    X(Instantiate, instantiate) X(FreeInstance, free_instance) X(SetupExperiment, setup_experiment) \
    X(EnterInitializationMode, enter_initialization_mode) \
    X(ExitInitializationMode, exit_initialization_mode) X(Terminate, terminate) X(Reset, reset) \
    X(SetReal, set_real) X(GetReal, get_real) X(SetInteger, set_integer) X(DoStep, do_step) \
    X(GetFMUstate, get_state) X(SetFMUstate, set_state) X(FreeFMUstate, free_state) \
    X(SerializedFMUstateSize, serialized_size) X(SerializeFMUstate, serialize) \
    X(DeSerializeFMUstate, deserialize) X(GetDirectionalDerivative, directional_derivative)
#define MEMBER(type, name) fmi2##type##TYPE* name;
static struct { FMU_FUNCTIONS(MEMBER) } fmu;

static char description[1 << 20], resources[1024], guid[64]; /* resources beside the description, as a URI */
static int messages = 0, mode = 1;                           /* of a patch: itself, then by table */

static void require(int holds, const char* what) {
    if (holds) return;
    fprintf(stderr, "failed: %s\n", what);
    exit(1);
}

static void expect(fmi2Status status, fmi2Status expected, const char* what) {
    if (status != expected) fprintf(stderr, "status %d in place of %d: ", (int)status, (int)expected);
    require(status == expected, what);
}

static void load_fmu(const char* path, const char* xml) {
    void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    require(library != NULL, path);
    /* POSIX lets an object pointer be converted to a function pointer; ISO C has no cast for it. */
#define LOAD(type, member)                               \
    *(void**)&fmu.member = dlsym(library, "fmi2" #type); \
    require(fmu.member != NULL, #type);
    FMU_FUNCTIONS(LOAD)
    FILE* const file = fopen(xml, "rb");
    require(file != NULL, xml);
    description[fread(description, 1, sizeof description - 1, file)] = 0;
    fclose(file);
    const char* const end = strrchr(xml, '/');
    snprintf(resources, sizeof resources, "file://%.*s/resources", end == NULL ? 0 : (int)(end - xml), xml);
    const char* const found = strstr(description, "guid=\"");
    require(found != NULL && sscanf(found, "guid=\"%63[^\"]", guid) == 1, "guid");
}

static int has_variable(const char* name, fmi2ValueReference* reference) {
    char text[128];
    snprintf(text, sizeof text, "name=\"%s\" valueReference=\"", name);
    const char* const found = strstr(description, text);
    if (found != NULL) *reference = (fmi2ValueReference)strtoul(found + strlen(text), NULL, 10);
    return found != NULL;
}

static fmi2ValueReference reference_of(const char* name) {
    fmi2ValueReference reference = 0;
    require(has_variable(name, &reference), name);
    return reference;
}

static void set_real(fmi2Component instance, const char* name, double value) {
    const fmi2ValueReference reference = reference_of(name);
    expect(fmu.set_real(instance, &reference, 1, &value), fmi2OK, name);
}

static double force_of(fmi2Component instance) {
    const fmi2ValueReference reference = reference_of("longitudinal_force");
    double value = 0;
    expect(fmu.get_real(instance, &reference, 1, &value), fmi2OK, "longitudinal_force");
    return value;
}

static void count_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                          fmi2String category, fmi2String message, ...) {
    (void)environment, (void)instance, (void)status, (void)category, (void)message;
    ++messages;
}

/* The first of the slip velocities; of a wheelset its lateral velocity. */
static const char* slip(void) {
    fmi2ValueReference unused;
    return has_variable("lateral_velocity", &unused) ? "lateral_velocity" : "longitudinal_slip_velocity";
}

static void start(fmi2Component instance) {
    expect(fmu.setup_experiment(instance, fmi2False, 0, 0, fmi2False, 0), fmi2OK, "fmi2SetupExperiment");
    fmi2ValueReference reference;
    if (has_variable("mode", &reference)) expect(fmu.set_integer(instance, &reference, 1, &mode), fmi2OK, "mode");
    set_real(instance, slip(), 1e-3);
    expect(fmu.enter_initialization_mode(instance), fmi2OK, "fmi2EnterInitializationMode");
    expect(fmu.exit_initialization_mode(instance), fmi2OK, "fmi2ExitInitializationMode");
}

static void roll(fmi2Component instance, int steps) {
    for (int i = 0; i < steps; ++i) {
        set_real(instance, "rolling_speed", 20 + i % 3);
        expect(fmu.do_step(instance, i * 1e-5, 1e-5, fmi2True), fmi2OK, "fmi2DoStep");
    }
}

/* Prints the shortest time of short rounds: longer ones were interrupted. */
static void print_time(fmi2Component instance) {
    const int rounds = 20, steps = 50;
    clock_t least = CLOCKS_PER_SEC;
    for (int round = 0; round < rounds; ++round) {
        const clock_t begin = clock();
        for (int i = 0; i < steps; ++i) {
            expect(fmu.do_step(instance, (5 + round * steps + i) * 1e-5, 1e-5, fmi2True), fmi2OK, "fmi2DoStep");
        }
        const clock_t time = clock() - begin;
        if (time < least) least = time;
    }
    fprintf(stderr, "fmi2DoStep %.2f us\n", 1e6 * (double)least / CLOCKS_PER_SEC / steps);
}

static void walk(void) {
    static const fmi2CallbackFunctions callbacks = {count_message, NULL, NULL, NULL, NULL};
    fmi2Component instances[2];
    for (int k = 0; k < 2; ++k) {
        instances[k] = fmu.instantiate("contact", fmi2CoSimulation, guid, resources, &callbacks, fmi2False, fmi2False);
        require(instances[k] != NULL, "fmi2Instantiate");
        start(instances[k]);
        roll(instances[k], 20);
    }
    fmi2FMUstate state = NULL, copy = NULL;
    expect(fmu.get_state(instances[0], &state), fmi2OK, "fmi2GetFMUstate");
    expect(fmu.get_state(instances[0], &state), fmi2OK, "fmi2GetFMUstate into the same");
    size_t size = 0;
    expect(fmu.serialized_size(instances[0], state, &size), fmi2OK, "fmi2SerializedFMUstateSize");
    char* const bytes = malloc(size);
    require(bytes != NULL, "memory");
    expect(fmu.serialize(instances[0], state, bytes, size), fmi2OK, "fmi2SerializeFMUstate");
    expect(fmu.deserialize(instances[1], bytes, size, &copy), fmi2OK, "fmi2DeSerializeFMUstate");
    roll(instances[0], 5);
    expect(fmu.set_state(instances[1], copy), fmi2OK, "fmi2SetFMUstate");
    roll(instances[1], 5);
    require(force_of(instances[0]) == force_of(instances[1]), "a copy goes on in the same way");
    printf("%.12g\n", force_of(instances[0]));

    const fmi2ValueReference unknown = reference_of("longitudinal_force"),
                             known[2] = {reference_of(slip()), reference_of("rolling_speed")};
    const double seeds[2] = {1, 1};
    double derivative = 0;
    expect(fmu.directional_derivative(instances[0], &unknown, 1, known, 2, seeds, &derivative), fmi2OK,
           "fmi2GetDirectionalDerivative");
    set_real(instances[0], "rolling_speed", -1);
    expect(fmu.do_step(instances[0], 0, 1e-5, fmi2True), fmi2Discard, "a step backwards");
    set_real(instances[0], "rolling_speed", (double)NAN);
    expect(fmu.do_step(instances[0], 0, 1e-5, fmi2True), fmi2Error, "a step at a speed that is no number");
    expect(fmu.set_state(instances[0], state), fmi2OK, "fmi2SetFMUstate after an error");
    roll(instances[0], 5);
    print_time(instances[0]);
    bytes[size / 2] ^= 1;
    expect(fmu.deserialize(instances[0], bytes, size, &copy), fmi2Error, "a damaged state");
    free(bytes);

    expect(fmu.reset(instances[0]), fmi2OK, "fmi2Reset");
    set_real(instances[0], "friction_coefficient", -1);
    expect(fmu.enter_initialization_mode(instances[0]), fmi2OK, "fmi2EnterInitializationMode");
    expect(fmu.exit_initialization_mode(instances[0]), fmi2Error, "a wrong parameter");
    expect(fmu.reset(instances[0]), fmi2OK, "fmi2Reset");
    start(instances[0]);
    expect(fmu.terminate(instances[0]), fmi2OK, "fmi2Terminate");
    expect(fmu.free_state(instances[0], &copy), fmi2OK, "fmi2FreeFMUstate");
    expect(fmu.free_state(instances[0], &state), fmi2OK, "fmi2FreeFMUstate");
    for (int k = 0; k < 2; ++k) fmu.free_instance(instances[k]);
}

int main(int count, char** arguments) {
    if (count != 3) return 2;
    load_fmu(arguments[1], arguments[2]);
    walk();
    mode = 2;
    fmi2ValueReference unused;
    if (has_variable("mode", &unused)) walk();
    require(messages == (has_variable("mode", &unused) ? 8 : 4), "a message of each refusal");
    printf("done\n");
    return 0;
}
