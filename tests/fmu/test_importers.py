"""test_importers.py FMU...: libcosim, which knows no enumerations, gets from each FMU what FMPy gets."""
import math
import sys
import tempfile

from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

from support import Fmu, discard, run

duration = 25  # us
# by FMU: enumerations, each at another value than its start
choices = {"rollbem_patch": [{"mesh_size": 2, "initial_state": 2}, {"mode": 2}], "rollbem_wheelset": [{}]}
inputs = {"longitudinal_slip_velocity": 4e-3, "lateral_slip_velocity": -3e-3, "spin_rate": 1.0,
          "lateral_shift": 3e-3, "yaw": 1e-3, "lateral_velocity": 0.02}


class Cosim:
    """An instance in libcosim, with the variables by name that it sees."""

    def __init__(self, file):
        self.execution = CosimExecution.from_step_size(step_size=1000 * duration)  # ns
        self.index = self.execution.add_local_slave(CosimLocalSlave(fmu_path=file, instance_name="contact"))
        self.override, self.observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
        assert self.execution.add_manipulator(self.override) and self.execution.add_observer(self.observer)
        self.variables = {v.name.decode(): v for v in self.execution.slave_variables(self.index)}

    def by_type(self, name, real, integer):
        return real if self.variables[name].type == CosimVariableType.REAL.value else integer

    def start(self, **values):
        for name, value in values.items():
            write = self.by_type(name, self.execution.real_initial_value, self.execution.integer_initial_value)
            assert write(self.index, self.variables[name].reference, value), name

    def set(self, **values):
        for name, value in values.items():
            assert self.override.slave_real_values(self.index, [self.variables[name].reference], [value])

    def get(self, name):
        read = self.by_type(name, self.observer.last_real_values, self.observer.last_integer_values)
        return read(self.index, [self.variables[name].reference])[0]


def test_enumerations_have_twins():
    for fmu in fmus:
        seen = Cosim(fmu.file).variables
        names = [name for name, v in fmu.variables.items() if v.type == "Enumeration"]
        assert "status" in names and not any(name in seen for name in names)
        # nothing else is lost
        assert all(f"{name}_code" in seen for name in names) and len(seen) + len(names) == len(fmu.variables)


def test_steps_equal_those_in_fmpy():
    for fmu, chosen in [(fmu, chosen) for fmu in fmus for chosen in choices[fmu.name]]:
        given = {name: value for name, value in inputs.items() if name in fmu.variables}
        cosim, fmpy = Cosim(fmu.file), fmu.start(chosen, given)
        cosim.start(**{f"{name}_code": value for name, value in chosen.items()}, **given)
        outputs = [name for name, v in fmu.variables.items() if v.causality == "output" and v.type != "Enumeration"]
        load = "normal_load" if "normal_load" in fmu.variables else "left_load"
        different = set()
        for i in range(40):
            values = {"rolling_speed": 20.0 + i % 3, load: 1e5 * (1 + 0.002 * i)}
            cosim.set(**values)
            assert cosim.execution.step()
            fmpy.go(i * 1e-6 * duration, 1e-6 * duration, **values)
            here, there = [cosim.get(name) for name in outputs], [fmpy.get(name) for name in outputs]
            # libcosim's steps are differences of times
            assert all(math.isclose(x, y, rel_tol=1e-12) for x, y in zip(here, there)), (i, outputs, here, there)
            different.add(tuple(here))
        assert len(different) == 40
        # a refused step ends the run there
        cosim.set(rolling_speed=-1.0)
        fmpy.set(rolling_speed=-1.0)
        assert fmpy.step(40e-6 * duration, 1e-6 * duration) == discard and not cosim.execution.step()


def test_twin_or_enumeration():
    fmu = fmus[0]
    for values, expected in (({}, 1), ({"initial_state": 2}, 2), ({"initial_state_code": 2}, 2),
                             ({"initial_state": 2, "initial_state_code": 1}, 1)):
        assert fmu.start(**values).get("initial_state") == expected, values


log_output_level(CosimLogLevel.FATAL)
with tempfile.TemporaryDirectory() as folder:
    fmus = [Fmu(file, f"{folder}/{k}") for k, file in enumerate(sys.argv[1:])]
    run(globals())
