"""test_wheelset.py FMU REFERENCE CREEP_TABLE CONTACT_TABLE: rollbem_wheelset beside the library's look-up."""
import math
import random
import subprocess
import sys

import numpy as np
from fmpy.validation import validate_fmu

from support import Fmu, Instance, discard, error, ok, run, status_of

duration = 1e-3
inputs = {"lateral_shift": 5e-3, "yaw": 5e-3, "rolling_speed": 2.0, "pitch_rate": 0.5, "lateral_velocity": 0.1,
          "vertical_velocity": 0.02, "roll_rate": 0.02, "yaw_rate": 0.1, "left_load": 4e4, "right_load": 4e4}
middle = {"rolling_speed": 30.0, "pitch_rate": -30.0 / 0.46, "left_load": 1e5, "right_load": 1e5}
names = [f"{axis}_{kind}" for kind, axes in (("force", ("longitudinal", "lateral", "vertical")),
                                             ("moment", ("roll", "pitch", "yaw"))) for axis in axes]
wheels = [f"{side}_{name}" for side in ("left", "right") for name in names]


def row(seed):
    draw = random.Random(seed)
    return {name: middle.get(name, 0.0) + draw.uniform(-size, size) for name, size in inputs.items()}


def forces(instance):
    return [instance.get(name) for name in wheels]


def library(rows):
    text = "".join(" ".join(float(r[name]).hex() for name in inputs) + "\n" for r in rows)
    lines = subprocess.run(sys.argv[2:], input=text, capture_output=True, text=True, check=True).stdout.splitlines()
    return [[float.fromhex(number) for number in line.split()] for line in lines]


def test_validation():
    assert validate_fmu(fmu.file) == []


def test_steps_equal_the_library():
    rows = [row(k) for k in range(50)]
    instance, work, before = Instance(fmu).start(**rows[0]), 0.0, None
    for k, (values, found) in enumerate(zip(rows, library(rows))):
        if k > 0:
            instance.set(**values)
            assert instance.step(k * duration, duration) == ok, instance.messages
            work += duration * (before + found[-1]) / 2
        before = found[-1]
        assert forces(instance) == found[:-1], k
        assert [instance.get(name) for name in names] == [x + y for x, y in zip(found[:6], found[6:12])]
        assert math.isclose(instance.get("slip_work"), work, rel_tol=1e-12)
    assert work > 0
    instance.close()


def test_input_derivatives_lead_to_the_end_of_the_step():
    instance = Instance(fmu).start(**row(1))
    for name, value in row(1).items():
        instance.rate(name, (row(2)[name] - value) / duration)
    assert instance.step(0.0, duration) == ok
    assert np.allclose(forces(instance), library([row(2)])[0][:-1], rtol=1e-9)
    instance.close()


def test_directional_derivatives():
    for seed in range(5):
        instance = Instance(fmu).start(**row(seed))
        first = instance.derivative("yaw_moment", "yaw_rate")
        time = 0.0
        for known, size in inputs.items():
            change, found = 1e-5 * size, []
            for sign in (1, -1):
                instance.set(**{**row(seed), known: row(seed)[known] + sign * change})
                assert instance.step(time, duration) == ok
                time += duration
                found.append(np.array(forces(instance) + [instance.get(name) for name in names]))
            instance.set(**row(seed))
            assert instance.step(time, duration) == ok
            time += duration
            exact = np.array([instance.derivative(name, known) for name in wheels + names])
            error_of = np.abs((found[0] - found[1]) / (2 * change) - exact).max() / np.abs(exact).max()
            print(f"    {seed}, {known}: {error_of:.1e}")
            assert error_of < 1e-3
        assert instance.derivative("yaw_moment", "yaw_rate") == first  # those at the first inputs
        assert status_of(lambda: instance.derivative("roll", "yaw")) == discard
        instance.close()


def test_saved_and_restored():
    instance = Instance(fmu).start(**row(3))
    assert instance.step(0.0, duration) == ok
    state = instance.calls.getFMUstate()
    before, slope = forces(instance), instance.derivative("yaw_moment", "yaw")
    saved = instance.calls.serializeFMUstate(state)

    def go_on(one):
        one.set(**row(4))
        assert one.step(duration, duration) == ok
        return forces(one), one.get("slip_work")

    once = go_on(instance)
    other = Instance(fmu)  # never started
    copy = other.calls.deSerializeFMUstate(saved)
    other.calls.setFMUstate(copy)
    instance.calls.setFMUstate(state)
    for one in (instance, other):
        assert forces(one) == before and one.derivative("yaw_moment", "yaw") == slope
        assert go_on(one) == once
    for one, which in ((instance, state), (other, copy)):
        one.calls.freeFMUstate(which)
        one.close()


def test_what_is_refused():
    statuses = [item.name for item in next(v for v in fmu.description.modelVariables
                                           if v.name == "status").declaredType.items]
    for values, status in (({"lateral_shift": 9.1e-3}, "wrong_table"), ({"yaw": 0.1}, "wrong_table"),
                           ({"left_load": -1.0}, "invalid_load"), ({"rolling_speed": -1.0}, "invalid_step")):
        instance = Instance(fmu).start(**row(5))
        before = forces(instance)
        instance.set(**values)
        assert instance.step(0.0, duration) == discard
        assert statuses[instance.get("status")] == status and forces(instance) == before
        instance.set(**row(6))
        assert instance.step(0.0, duration) == ok
        assert forces(instance) == library([row(6)])[0][:-1]
        instance.close()
    for name in inputs:
        instance = Instance(fmu).start(**row(5))
        instance.set(**{name: math.nan})
        assert instance.step(0.0, duration) == error and "needs finite numbers" in instance.messages[-1]
        instance.close()
    for parameters, words in (({"friction_coefficient": -0.1}, "friction_coefficient = -0.1 must be finite"),
                              ({"contact_table_file": "/none"}, "contact_table_file = /none must be a file"),
                              ({"contact_table_file": sys.argv[3]}, "contact_table_file = "),
                              ({"lateral_shift": 1.0}, "status of the tables at the first inputs = wrong_table")):
        instance = Instance(fmu)
        instance.calls.setupExperiment()
        instance.set(**parameters)
        instance.calls.enterInitializationMode()
        assert status_of(instance.calls.exitInitializationMode) == error, parameters
        assert words in instance.messages[-1], instance.messages
        instance.close()


fmu = Fmu(sys.argv[1])
try:
    run(globals())
finally:
    fmu.close()
