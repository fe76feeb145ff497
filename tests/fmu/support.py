"""Shared by the tests of the FMUs: an instance with variables by name, and a runner for test functions."""
import shutil
import sys
import traceback
from ctypes import byref, c_double, c_int

import fmpy
from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from fmpy.logging import addLoggerProxy

ok, discard, error = fmi2.fmi2OK, fmi2.fmi2Discard, fmi2.fmi2Error


class Fmu:
    """An unpacked FMU."""

    def __init__(self, file, folder=None):
        self.file = file
        self.description = fmpy.read_model_description(file)
        self.folder = fmpy.extract(file, folder)
        self.references = {v.name: v.valueReference for v in self.description.modelVariables}
        self.types = {v.name: v.type for v in self.description.modelVariables}

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)


class Instance:
    """An instance called through FMI, with variables by name. `messages` are those that it logged."""

    def __init__(self, fmu, guid=None):
        self.fmu, self.messages = fmu, []
        self.calls = fmi2.FMU2Slave(guid=guid or fmu.description.guid, unzipDirectory=fmu.folder,
                                    modelIdentifier=fmu.description.coSimulation.modelIdentifier, instanceName="test")
        self.callbacks = fmi2.fmi2CallbackFunctions()
        self.callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(
            lambda environment, name, status, category, message: self.messages.append(message.decode()))
        addLoggerProxy(byref(self.callbacks))
        self.calls.instantiate(callbacks=self.callbacks)

    def reference(self, name):
        return self.fmu.references[name]

    def set(self, **values):
        setters = {"Real": self.calls.setReal, "String": self.calls.setString}
        for name, value in values.items():
            setters.get(self.fmu.types[name], self.calls.setInteger)([self.reference(name)], [value])

    def get(self, name):
        if self.fmu.types[name] == "String":
            return self.calls.getString([self.reference(name)])[0].decode()
        getter = self.calls.getReal if self.fmu.types[name] == "Real" else self.calls.getInteger
        return getter([self.reference(name)])[0]

    def start(self, **values):
        self.calls.setupExperiment(startTime=0.0)
        self.set(**values)
        self.calls.enterInitializationMode()
        self.calls.exitInitializationMode()
        return self

    def step(self, time, duration):
        """The status of the step."""
        return status_of(lambda: self.calls.fmi2DoStep(self.calls.component, time, duration, 0))

    def rate(self, name, value):
        """Sets the time derivative of an input."""
        reference = (fmi2.fmi2ValueReference * 1)(self.reference(name))
        self.calls.fmi2SetRealInputDerivatives(self.calls.component, reference, 1, (fmi2.fmi2Integer * 1)(1),
                                               (c_double * 1)(value))

    def last_successful_time(self):
        time = c_double()
        self.calls.fmi2GetRealStatus(self.calls.component, fmi2.fmi2LastSuccessfulTime, byref(time))
        return time.value

    def wants_to_stop(self):
        wanted = c_int()
        self.calls.fmi2GetBooleanStatus(self.calls.component, fmi2.fmi2Terminated, byref(wanted))
        return wanted.value != 0

    def derivative(self, unknown, known):
        return self.calls.getDirectionalDerivative([self.reference(unknown)], [self.reference(known)], [1.0])[0]

    def close(self):
        self.calls.freeInstance()


def status_of(action):
    """The status of an FMI function, which FMPy turns into an exception if it is worse than a warning."""
    try:
        action()
    except FMICallException as exception:
        return exception.status
    return ok


def close_to(value, expected, tolerance, what=""):
    error = abs(value - expected) / max(abs(expected), 1e-300)
    print(f"    {what} {value:.10g}, expected {expected:.10g}, relative error {error:.2e} (at most {tolerance:.0e})")
    assert error <= tolerance, what


def run(functions, *fmus):
    """Runs the functions whose names begin with test_ with these FMUs, and exits with 1 if one fails."""
    failed = []
    tests = [f for name, f in functions.items() if name.startswith("test_")]
    for test in tests:
        print(test.__name__, flush=True)
        try:
            test()
        except Exception:
            traceback.print_exc()
            failed.append(test.__name__)
    for fmu in fmus:
        fmu.close()
    print(f"{len(tests) - len(failed)} of {len(tests)} tests passed", *(f"FAILED: {name}" for name in failed), sep="\n")
    sys.exit(1 if failed or not tests else 0)
