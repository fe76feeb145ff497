"""Shared by the tests of the FMUs: an instance with variables by name, and a runner for test functions."""
import sys
import traceback
from ctypes import byref, c_double, c_int

import fmpy
from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from fmpy.logging import addLoggerProxy

ok, discard, error = fmi2.fmi2OK, fmi2.fmi2Discard, fmi2.fmi2Error

logs = {}  # by instance; FMPy's proxy knows one logger for all
logger = fmi2.fmi2CallbackLoggerTYPE(
    lambda instance, name, status, category, message: logs[instance].append(message.decode()))


class Fmu:
    """An unpacked FMU."""

    def __init__(self, file, folder):
        self.file, self.folder = file, fmpy.extract(file, folder)
        self.description = fmpy.read_model_description(file)
        self.name = self.description.modelName
        self.variables = {v.name: v for v in self.description.modelVariables}

    def start(self, *variants, **values):
        """An instance after its initialisation with these values, the later ones first."""
        instance = Instance(self)
        for variant in variants:
            values = {**variant, **values}
        return instance.start(**values)


class Instance:
    """An instance called through FMI, with variables by name. `messages` are those that it logged."""

    def __init__(self, fmu, guid=None):
        self.variables, self.messages = fmu.variables, logs.setdefault(len(logs) + 1, [])
        calls = fmi2.FMU2Slave(guid=guid or fmu.description.guid, unzipDirectory=fmu.folder,
                               modelIdentifier=fmu.description.coSimulation.modelIdentifier, instanceName="test")
        self.callbacks = fmi2.fmi2CallbackFunctions()
        self.callbacks.logger, self.callbacks.componentEnvironment = logger, len(logs)
        addLoggerProxy(byref(self.callbacks))
        calls.instantiate(callbacks=self.callbacks)
        self.calls = calls

    def __del__(self):
        if hasattr(self, "calls"):
            self.calls.freeInstance()

    def references(self, name):
        return [self.variables[name].valueReference]

    def set(self, **values):
        setters = {"Real": self.calls.setReal, "String": self.calls.setString}
        for name, value in values.items():
            setters.get(self.variables[name].type, self.calls.setInteger)(self.references(name), [value])

    def get(self, name):
        if self.variables[name].type == "String":
            return self.calls.getString(self.references(name))[0].decode()
        getter = self.calls.getReal if self.variables[name].type == "Real" else self.calls.getInteger
        return getter(self.references(name))[0]

    def start(self, **values):
        self.calls.setupExperiment(startTime=0.0)
        self.set(**values)
        self.calls.enterInitializationMode()
        self.calls.exitInitializationMode()
        return self

    def step(self, time, duration):
        """The status of the step."""
        return status_of(lambda: self.calls.fmi2DoStep(self.calls.component, time, duration, 0))

    def go(self, time, duration, **values):
        """A step with these inputs, which must be ok."""
        self.set(**values)
        assert self.step(time, duration) == ok, self.messages

    def rate(self, name, value):
        """Sets the time derivative of an input."""
        reference = (fmi2.fmi2ValueReference * 1)(*self.references(name))
        self.calls.fmi2SetRealInputDerivatives(self.calls.component, reference, 1, (fmi2.fmi2Integer * 1)(1),
                                               (c_double * 1)(value))

    def stopped(self):
        """The last successful time, and whether the instance wants to stop."""
        time, wanted = c_double(), c_int()
        self.calls.fmi2GetRealStatus(self.calls.component, fmi2.fmi2LastSuccessfulTime, byref(time))
        self.calls.fmi2GetBooleanStatus(self.calls.component, fmi2.fmi2Terminated, byref(wanted))
        return time.value, wanted.value != 0

    def derivative(self, unknown, known):
        return self.calls.getDirectionalDerivative(self.references(unknown), self.references(known), [1.0])[0]

    def refuses(self, action, words, status=error):
        """The action has this status, and the last message has the words."""
        assert status_of(action) == status and words in self.messages[-1], (words, self.messages)


def status_of(action):
    """The status of an FMI function, which FMPy turns into an exception if it is worse than a warning."""
    try:
        return action() or ok
    except FMICallException as exception:
        return exception.status


def run(functions):
    """Runs the functions whose names begin with test_, and exits with 1 if one fails."""
    failed = []
    tests = [f for name, f in functions.items() if name.startswith("test_")]
    for test in tests:
        print(test.__name__, flush=True)
        try:
            test()
        except Exception:
            traceback.print_exc()
            failed.append(test.__name__)
    print(f"{len(tests) - len(failed)} of {len(tests)} tests passed", *(f"FAILED: {name}" for name in failed), sep="\n")
    sys.exit(1 if failed or not tests else 0)
