/* An FMU as a C program loads it: the functions of its shared library, and variables by the names in its
   modelDescription.xml. */
#ifndef ROLLBEM_TESTS_FMU_H
#define ROLLBEM_TESTS_FMU_H

#include <fmi2FunctionTypes.h>

/* The functions called, by their names in FMI and here. */
#define FMU_FUNCTIONS(X) \
    X(Instantiate, instantiate) X(FreeInstance, free_instance) X(SetupExperiment, setup_experiment) \
    X(EnterInitializationMode, enter_initialization_mode) \
    X(ExitInitializationMode, exit_initialization_mode) X(Terminate, terminate) X(Reset, reset) \
    X(SetReal, set_real) X(GetReal, get_real) X(SetInteger, set_integer) X(DoStep, do_step) \
    X(GetRealStatus, get_real_status) X(GetFMUstate, get_state) X(SetFMUstate, set_state) \
    X(FreeFMUstate, free_state) X(SerializedFMUstateSize, serialized_size) X(SerializeFMUstate, serialize) \
    X(DeSerializeFMUstate, deserialize) X(GetDirectionalDerivative, directional_derivative)

typedef struct {
    char *description;    /* the text of modelDescription.xml */
    char resources[1024]; /* beside it, as a URI */
    char guid[64];
#define MEMBER(type, name) fmi2##type##TYPE *name;
    FMU_FUNCTIONS(MEMBER)
#undef MEMBER
} Fmu;

/* Ends the program with a message if something is missing. */
Fmu load_fmu(const char *library, const char *description);
fmi2ValueReference reference_of(const Fmu *fmu, const char *variable);
int has_variable(const Fmu *fmu, const char *variable);
fmi2Component instantiate(const Fmu *fmu, const char *name);

/* Ends the program with a message unless the status is the expected one. */
void expect(fmi2Status status, fmi2Status expected, const char *what);
void set_integer(const Fmu *fmu, fmi2Component instance, const char *variable, int value);
void set_real(const Fmu *fmu, fmi2Component instance, const char *variable, double value);
double get_real(const Fmu *fmu, fmi2Component instance, const char *variable);

extern int messages; /* logged by all instances */

#endif
