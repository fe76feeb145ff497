/* An FMU as a C program loads it: the functions of its shared library, and variables by the names in its
   modelDescription.xml. */
#ifndef ROLLBEM_TESTS_FMU_H
#define ROLLBEM_TESTS_FMU_H

#include <fmi2FunctionTypes.h>

typedef struct {
    char *description; /* the text of modelDescription.xml */
    char resources[1024]; /* beside it, as a URI */
    char guid[64];
    fmi2InstantiateTYPE *instantiate;
    fmi2FreeInstanceTYPE *free_instance;
    fmi2SetupExperimentTYPE *setup_experiment;
    fmi2EnterInitializationModeTYPE *enter_initialization_mode;
    fmi2ExitInitializationModeTYPE *exit_initialization_mode;
    fmi2TerminateTYPE *terminate;
    fmi2ResetTYPE *reset;
    fmi2SetRealTYPE *set_real;
    fmi2GetRealTYPE *get_real;
    fmi2SetIntegerTYPE *set_integer;
    fmi2DoStepTYPE *do_step;
    fmi2GetRealStatusTYPE *get_real_status;
    fmi2GetFMUstateTYPE *get_state;
    fmi2SetFMUstateTYPE *set_state;
    fmi2FreeFMUstateTYPE *free_state;
    fmi2SerializedFMUstateSizeTYPE *serialized_size;
    fmi2SerializeFMUstateTYPE *serialize;
    fmi2DeSerializeFMUstateTYPE *deserialize;
    fmi2GetDirectionalDerivativeTYPE *directional_derivative;
    /* null where the FMU has no model exchange */
    fmi2NewDiscreteStatesTYPE *new_discrete_states;
    fmi2EnterContinuousTimeModeTYPE *enter_continuous_time_mode;
    fmi2SetTimeTYPE *set_time;
    fmi2GetContinuousStatesTYPE *get_states;
    fmi2SetContinuousStatesTYPE *set_states;
    fmi2GetDerivativesTYPE *get_derivatives;
} Fmu;

/* Ends the program with a message if something is missing. */
Fmu load_fmu(const char *library, const char *description);
fmi2ValueReference reference_of(const Fmu *fmu, const char *variable);
int has_variable(const Fmu *fmu, const char *variable);
fmi2Component instantiate(const Fmu *fmu, const char *name, fmi2Type type);

/* Ends the program with a message unless the status is the expected one. */
void expect(fmi2Status status, fmi2Status expected, const char *what);
void set_integer(const Fmu *fmu, fmi2Component instance, const char *variable, int value);
void set_real(const Fmu *fmu, fmi2Component instance, const char *variable, double value);
double get_real(const Fmu *fmu, fmi2Component instance, const char *variable);

extern int messages; /* logged by all instances */

#endif
