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

/* POSIX lets an object pointer be converted to a function pointer; ISO C has no cast for it. */
#define LOAD(type, member)                                 \
    *(void **)&fmu.member = dlsym(library, "fmi2" #type);  \
    if (fmu.member == NULL) fail(#type);

Fmu load_fmu(const char *path, const char *description) {
    Fmu fmu;
    void *const library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) fail(dlerror());
    FMU_FUNCTIONS(LOAD)

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

fmi2Component instantiate(const Fmu *fmu, const char *name) {
    static const fmi2CallbackFunctions callbacks = {count_message, NULL, NULL, NULL, NULL};
    const fmi2Component instance =
        fmu->instantiate(name, fmi2CoSimulation, fmu->guid, fmu->resources, &callbacks, fmi2False, fmi2False);
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
