"""test_importers.py FMU...: libcosim, which knows no enumerations, gets from each FMU what FMPy gets."""
import math
import sys

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from support import Fmu, Instance, discard, error, ok, run, status_of

duration = 25  # us
# by FMU: enumerations, each at another value than its start
choices = {
    "rollbem_patch": [{"mesh_size": 2, "initial_state": 2}, {"mode": 2}],
    "rollbem_wheelset": [{}],
}
slips = {"longitudinal_slip_velocity": 4e-3, "lateral_slip_velocity": -3e-3, "spin_rate": 1.0,
         "lateral_shift": 3e-3, "yaw": 1e-3, "lateral_velocity": 0.02}


class Cosim:
    """An instance in libcosim, with the variables by name that it sees."""

    def __init__(self, file):
        self.execution = CosimExecution.from_step_size(step_size=1000 * duration)  # ns
        self.slave = CosimLocalSlave(fmu_path=file, instance_name="contact")
        self.index = self.execution.add_local_slave(self.slave)
        self.override, self.observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
        assert self.execution.add_manipulator(self.override) and self.execution.add_observer(self.observer)
        self.variables = {v.name.decode(): v for v in self.execution.slave_variables(self.index)}

    def is_real(self, name):
        return self.variables[name].type == CosimVariableType.REAL.value

    def start(self, **values):
        for name, value in values.items():
            write = self.execution.real_initial_value if self.is_real(name) else self.execution.integer_initial_value
            assert write(self.index, self.variables[name].reference, value), name

    def set(self, name, value):
        assert self.override.slave_real_values(self.index, [self.variables[name].reference], [value])

    def get(self, name):
        read = self.observer.last_real_values if self.is_real(name) else self.observer.last_integer_values
        return read(self.index, [self.variables[name].reference])[0]


def test_enumerations_have_twins():
    for fmu in fmus:
        seen = Cosim(fmu.file).variables
        names = [v.name for v in fmu.description.modelVariables if v.type == "Enumeration"]
        print(f"    {fmu.description.modelName}: {names}")
        assert "status" in names and ("initial_state" in names or fmu.description.modelName == "rollbem_wheelset")
        assert not any(name in seen for name in names) and all(f"{name}_code" in seen for name in names)
        # nothing else is lost
        assert len(seen) + len(names) == len(fmu.description.modelVariables)


def test_steps_equal_those_in_fmpy():
    for fmu, chosen in [(fmu, chosen) for fmu in fmus for chosen in choices[fmu.description.modelName]]:
        inputs = {name: value for name, value in slips.items() if name in fmu.references}
        cosim, fmpy = Cosim(fmu.file), Instance(fmu).start(**chosen, **inputs)
        cosim.start(**{f"{name}_code": value for name, value in chosen.items()}, **inputs)
        outputs = [v.name for v in fmu.description.modelVariables
                   if v.causality == "output" and v.type != "Enumeration"]
        different = set()
        for i in range(40):
            load = "normal_load" if "normal_load" in fmu.references else "left_load"
            values = {"rolling_speed": 20.0 + i % 3, load: 1e5 * (1 + 0.002 * i)}
            for name, value in values.items():
                cosim.set(name, value)
            fmpy.set(**values)
            assert cosim.execution.step() and fmpy.step(i * 1e-6 * duration, 1e-6 * duration) == ok
            here, there = [cosim.get(name) for name in outputs], [fmpy.get(name) for name in outputs]
            # libcosim's steps are differences of times
            assert all(math.isclose(x, y, rel_tol=1e-12) for x, y in zip(here, there)), (i, outputs, here, there)
            different.add(tuple(here))
        assert len(different) == 40
        # a refused step ends the run there
        cosim.set("rolling_speed", -1.0)
        fmpy.set(rolling_speed=-1.0)
        assert fmpy.step(40e-6 * duration, 1e-6 * duration) == discard and not cosim.execution.step()
        assert fmpy.get("status_code") == fmpy.get("status") != 1
        fmpy.close()


def test_twin_or_enumeration():
    for fmu in (fmu for fmu in fmus if "initial_state" in fmu.references):
        for values, expected in (({}, 1), ({"initial_state": 2}, 2), ({"initial_state_code": 2}, 2),
                                 ({"initial_state": 2, "initial_state_code": 1}, 1)):
            instance = Instance(fmu).start(**values)
            assert instance.get("initial_state") == expected, values
            instance.close()
        for name, value, least in (("initial_state_code", 3, 0), ("initial_state_code", -1, 0),
                                   ("initial_state", 3, 1)):
            instance = Instance(fmu)
            instance.set(**{name: value})
            instance.calls.enterInitializationMode()
            assert status_of(instance.calls.exitInitializationMode) == error, (name, value)
            assert f"{name} = {value} must lie in [{least}, 2]" in instance.messages[-1], instance.messages
            instance.close()


log_output_level(CosimLogLevel.FATAL)
fmus = [Fmu(file) for file in sys.argv[1:]]
run(globals(), *fmus)
