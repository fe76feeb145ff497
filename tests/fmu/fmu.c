/* An FMU as a C program loads it. */
#include "fmu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <windows.h>
#define dlopen(path, how) (void *)LoadLibraryA(path)
#define dlerror() "no such library"

static void *dlsym(void *library, const char *name) {
    const FARPROC function = GetProcAddress((HMODULE)library, name);
    void *address;
    memcpy(&address, &function, sizeof address);
    return address;
}
#else
#include <dlfcn.h>
#endif

int messages = 0;

static void fail(const char *what) {
    fprintf(stderr, "failed: %s\n", what);
    exit(1);
}

static void *function(void *library, const char *name) {
    void *const address = dlsym(library, name);
    if (address == NULL) fail(name);
    return address;
}

/* POSIX lets an object pointer be converted to a function pointer; ISO C has no cast for it. */
#define LOAD(member, name) *(void **)&fmu.member = function(library, name)
#define LOAD_IF_THERE(member, name) *(void **)&fmu.member = dlsym(library, name)

Fmu load_fmu(const char *path, const char *description) {
    Fmu fmu;
    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) fail(dlerror());
    LOAD(instantiate, "fmi2Instantiate");
    LOAD(free_instance, "fmi2FreeInstance");
    LOAD(setup_experiment, "fmi2SetupExperiment");
    LOAD(enter_initialization_mode, "fmi2EnterInitializationMode");
    LOAD(exit_initialization_mode, "fmi2ExitInitializationMode");
    LOAD(terminate, "fmi2Terminate");
    LOAD(reset, "fmi2Reset");
    LOAD(set_real, "fmi2SetReal");
    LOAD(get_real, "fmi2GetReal");
    LOAD(set_integer, "fmi2SetInteger");
    LOAD(do_step, "fmi2DoStep");
    LOAD(get_real_status, "fmi2GetRealStatus");
    LOAD(get_state, "fmi2GetFMUstate");
    LOAD(set_state, "fmi2SetFMUstate");
    LOAD(free_state, "fmi2FreeFMUstate");
    LOAD(serialized_size, "fmi2SerializedFMUstateSize");
    LOAD(serialize, "fmi2SerializeFMUstate");
    LOAD(deserialize, "fmi2DeSerializeFMUstate");
    LOAD(directional_derivative, "fmi2GetDirectionalDerivative");
    LOAD_IF_THERE(new_discrete_states, "fmi2NewDiscreteStates");
    LOAD_IF_THERE(enter_continuous_time_mode, "fmi2EnterContinuousTimeMode");
    LOAD_IF_THERE(set_time, "fmi2SetTime");
    LOAD_IF_THERE(get_states, "fmi2GetContinuousStates");
    LOAD_IF_THERE(set_states, "fmi2SetContinuousStates");
    LOAD_IF_THERE(get_derivatives, "fmi2GetDerivatives");

    FILE *const file = fopen(description, "rb");
    if (file == NULL) fail(description);
    const size_t room = 1 << 20;
    fmu.description = malloc(room);
    if (fmu.description == NULL) fail("memory");
    const size_t length = fread(fmu.description, 1, room - 1, file);
    fmu.description[length] = 0;
    fclose(file);
    const char *const end = strrchr(description, '/');
    snprintf(fmu.resources, sizeof fmu.resources, "file://%.*s/resources", end == NULL ? 0 : (int)(end - description),
             description);
    const char *const guid = strstr(fmu.description, "guid=\"");
    if (guid == NULL || sscanf(guid, "guid=\"%63[^\"]", fmu.guid) != 1) fail("guid");
    return fmu;
}

static const char *find(const Fmu *fmu, const char *variable) {
    char text[128];
    snprintf(text, sizeof text, "name=\"%s\" valueReference=\"", variable);
    const char *const found = strstr(fmu->description, text);
    return found == NULL ? NULL : found + strlen(text);
}

int has_variable(const Fmu *fmu, const char *variable) { return find(fmu, variable) != NULL; }

fmi2ValueReference reference_of(const Fmu *fmu, const char *variable) {
    const char *const number = find(fmu, variable);
    if (number == NULL) fail(variable);
    return (fmi2ValueReference)strtoul(number, NULL, 10);
}

static void count_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                          fmi2String category, fmi2String message, ...) {
    (void)environment;
    (void)instance;
    (void)status;
    (void)category;
    (void)message;
    ++messages;
}

fmi2Component instantiate(const Fmu *fmu, const char *name, fmi2Type type) {
    static const fmi2CallbackFunctions callbacks = {count_message, NULL, NULL, NULL, NULL};
    const fmi2Component instance =
        fmu->instantiate(name, type, fmu->guid, fmu->resources, &callbacks, fmi2False, fmi2False);
    if (instance == NULL) fail("fmi2Instantiate");
    return instance;
}

void expect(fmi2Status status, fmi2Status expected, const char *what) {
    if (status == expected) return;
    fprintf(stderr, "failed: %s answers %d in place of %d\n", what, (int)status, (int)expected);
    exit(1);
}

void set_integer(const Fmu *fmu, fmi2Component instance, const char *variable, int value) {
    const fmi2ValueReference reference = reference_of(fmu, variable);
    expect(fmu->set_integer(instance, &reference, 1, &value), fmi2OK, variable);
}

void set_real(const Fmu *fmu, fmi2Component instance, const char *variable, double value) {
    const fmi2ValueReference reference = reference_of(fmu, variable);
    expect(fmu->set_real(instance, &reference, 1, &value), fmi2OK, variable);
}

double get_real(const Fmu *fmu, fmi2Component instance, const char *variable) {
    const fmi2ValueReference reference = reference_of(fmu, variable);
    double value = 0;
    expect(fmu->get_real(instance, &reference, 1, &value), fmi2OK, variable);
    return value;
}
