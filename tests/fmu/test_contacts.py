"""What the FMUs have in common: test_contacts.py LIBRARY_RUN TABLES FMU..., the program that takes the same steps with
the library, and the folder of the tables that wheelsets need."""
import math
import subprocess
import sys
from dataclasses import dataclass, field

import numpy as np
from fmpy.validation import validate_fmu

from support import Fmu, Instance, discard, error, ok, run, status_of

V, N, duration = 20.0, 1e5, 2.5e-5  # of start values; a step rolls by a tenth of the half-length


@dataclass
class Kind:
    """Steps and refusals of an FMU."""
    variants: list  # parameters
    slips: dict  # slip velocities, or positions and velocities, which vary during runs
    outputs: list  # forces, which have derivatives, and what else a step gives
    refused: list  # index of the variant, inputs, status of the step
    wrong: list  # parameters, words
    others: dict = field(default_factory=dict)  # further inputs, which vary by a fifth
    loads: tuple = ("normal_load",)
    parameter: tuple = ("friction_coefficient", 0.25)  # one that changes forces, with another value than its start
    library: list = field(default_factory=list)  # arguments of the program of the library, for the first variants
    line: tuple = ()  # inputs in the order of its lines; a number stands for itself
    follows_load: bool = False  # the size of the contact, by Hertz

    def inputs(self, variant):
        """Those that forces depend on."""
        known = [*self.slips, "rolling_speed", *self.loads, *self.others]
        return known + [name for name in variant if name.startswith("given_")]

    def forces(self):
        return [name for name in self.outputs if name.endswith(("force", "moment"))]

    def row(self, k):
        """Inputs of step k."""
        waves = {name: size * math.cos(0.1 * (i + 1) * k) for i, (name, size) in enumerate(self.slips.items())}
        others = {name: size * (1 + 0.2 * math.sin(0.07 * k)) for name, size in self.others.items()}
        values = {**waves, **others, "rolling_speed": V * (1 + 0.1 * math.sin(0.04 * k)),
                  **{name: N * (1 + 0.5 * math.sin(0.04 * (i + 1) * k)) for i, name in enumerate(self.loads)}}
        if "pitch_rate" in self.slips:
            values["pitch_rate"] -= values["rolling_speed"] / 0.46
        return values

    def outcome(self, instance):
        return [instance.get(name) for name in self.outputs]

    def roll(self, instance, first, count):
        """Outcomes of `count` steps."""
        found = []
        for k in range(first, first + count):
            instance.set(**self.row(k))
            assert instance.step(k * duration, duration) == ok, instance.messages
            found.append(self.outcome(instance))
        return found

    def by_library(self, arguments, rows):
        """Outcomes of rows of duration and inputs."""
        text = "".join(" ".join(float(value).hex() for value in
                                (length, *(values.get(name, name) for name in self.line))) + "\n"
                       for length, values in rows)
        lines = subprocess.run([sys.argv[1], *arguments], input=text, capture_output=True, text=True,
                               check=True).stdout.splitlines()
        assert len(lines) == len(rows)
        return [[float.fromhex(number) for number in line.split()] for line in lines]


finite = [({"poisson_ratio": 0.7}, "poisson_ratio = 0.7 must lie in [0, 0.5]"),
          ({"shear_modulus": -1.0}, "shear_modulus = -1 must be positive and finite"),
          ({"initial_state": 3}, "initial_state = 3 must lie in [1, 2]"),
          ({"initial_state": 2, "rolling_speed": 0.0}, "rolling_speed = 0 must be positive")]
friction = [({"friction_coefficient": -0.1}, "friction_coefficient = -0.1 must be finite and not negative"),
            ({"largest_load": math.nan, "mesh_size": 2}, "largest_load = nan must be positive"),
            ({"normal_load": 3e5, "mesh_size": 2}, "normal_load = 300000 must be at most largest_load"),
            ({"normal_load": 0.0}, "normal_load = 0 must be positive where mesh_size"),
            ({"friction_factor": -0.1}, "friction_factor = -0.1 must be finite and not negative")]
table = {"mode": 2}
given = {**table, "given_half_length": 6e-3, "given_half_width": 4e-3}
factor = {"friction_factor": 1.0}
breathing = [(0, {"normal_load": 2 * N}, "needs_fixed_mesh"), (0, {"normal_load": 0.0}, "invalid_load"),
             (0, {"rolling_speed": 0.0, "normal_load": 1.3 * N}, "needs_fixed_mesh")]
fixed = [(1, {"normal_load": 2.1 * N}, "invalid_load"), (1, {"normal_load": -1.0}, "invalid_load"),
         (1, {"rolling_speed": -1.0}, "invalid_step")]
slippery = [(0, {"friction_factor": -0.1}, "invalid_load")]
kinds = {
    "rollbem_patch": Kind(
        variants=[{"mesh_size": 1}, {"mesh_size": 2}, table, given], others=factor,
        slips={"longitudinal_slip_velocity": 0.04, "lateral_slip_velocity": 0.03, "spin_rate": 3.0},
        outputs=["longitudinal_force", "lateral_force", "spin_moment", "slip_work", "sticking_elements"], follows_load=True,
        library=[("patch", "follows"), ("patch", "fixed")],
        line=("longitudinal_slip_velocity", "lateral_slip_velocity", "spin_rate", "rolling_speed", "normal_load",
              *factor),
        refused=[*breathing, *fixed, *slippery, (2, {"normal_load": -1.0}, "invalid_load"),
                 (0, {"given_half_length": 1e-3}, "invalid_load"), (3, {"given_half_width": 0.0}, "invalid_load"),
                 (2, {"rolling_speed": -1.0}, "invalid_step")],
        wrong=[*finite, *friction,
               ({"elements": 0}, "elements = 0 must lie in [1, 32]"),
               ({"strips": 33}, "strips = 33 must lie in [1, 32]"),
               ({"mesh_size_code": 3}, "mesh_size_code = 3 must lie in [0, 2]"),
               ({"wheel_rolling_radius": 0.0}, "wheel_rolling_radius = 0 must be a number other than 0"),
               ({"rail_lateral_radius": -0.3}, "smaller principal curvature of the gap"),
               ({**table, "poisson_ratio": 0.26999}, "poisson_ratio = 0.26999 must be within 0.01 of 0.28"),
               ({**table, "rail_lateral_radius": 0.002}, "must lie in [0.1"),
               ({"given_half_width": 1e-3}, "given_half_width = 0.001 must be 0 where mode is patch"),
               ({**table, "normal_load": -1.0}, "normal_load = -1 must not be negative"),
               ({**table, "rolling_speed": -1.0}, "rolling_speed = -1 must not be negative"),
               *(({**mode, name: math.inf}, f"{name} = inf must be finite")
                 for mode in (table, {"initial_state": 2}) for name in ("lateral_slip_velocity", "spin_rate"))]),
    "rollbem_wheelset": Kind(
        variants=[{}], loads=("left_load", "right_load"),
        slips={"lateral_shift": 4e-3, "yaw": 4e-3, "pitch_rate": 0.3, "lateral_velocity": 0.1,
               "vertical_velocity": 0.02, "roll_rate": 0.02, "yaw_rate": 0.1},
        outputs=[f"{side}{axis}_{kind}" for side in ("", "left_", "right_")
                 for kind, axes in (("force", ("longitudinal", "lateral", "vertical")),
                                    ("moment", ("roll", "pitch", "yaw"))) for axis in axes] + ["slip_work"],
        library=[("wheelset", sys.argv[2])],
        line=("lateral_shift", "yaw", "rolling_speed", "pitch_rate", "lateral_velocity", "vertical_velocity",
              "roll_rate", "yaw_rate", "left_load", "right_load"),
        refused=[(0, {"lateral_shift": 9.1e-3}, "wrong_table"), (0, {"yaw": 0.1}, "wrong_table"),
                 (0, {"left_load": -1.0}, "invalid_load"), (0, {"rolling_speed": -1.0}, "invalid_step"),
                 (0, {"rolling_speed": 0.0, "pitch_rate": 0.0}, "invalid_step")],
        wrong=[friction[0],
               ({"contact_table_file": "/none"},
                "contact_table_file = /none: ContactTable: /none must be a file that can be read"),
               ({"contact_table_file": sys.argv[2] + "/steel.creep"}, "contact_table_file = "),
               ({"lateral_shift": 1.0}, "status of the tables at the first inputs = wrong_table"),
               ({"rolling_speed": 0.0, "pitch_rate": 0.0}, "status of the tables at the first inputs = invalid_step")]),
}


def each():
    """FMU, what is asked of it, and each variant of its parameters."""
    for fmu in fmus:
        kind = kinds[fmu.description.modelName]
        for variant in kind.variants:
            print(f"    {fmu.description.modelName}, {variant}")
            yield fmu, kind, variant


def test_validation():
    for fmu in fmus:
        assert validate_fmu(fmu.file) == []
        assert not any(hasattr(Instance(fmu).calls.dll, name) for name in ("fmi2GetDerivatives", "fmi2SetTime"))


def test_equals_the_library_over_rejected_steps():
    """Bit for bit, from rest and from steady rolling; on a fixed mesh the wheel lifts off and shifts at standstill."""
    for fmu in fmus:
        kind = kinds[fmu.description.modelName]
        for variant, arguments in zip(kind.variants, kind.library):
            for start in ("rest", "steady") if kind.line[2] != "rolling_speed" else ("steady",):
                rows = [(duration * (1 if k % 7 else 1.5), kind.row(k)) for k in range(150)]
                if "fixed" in arguments:
                    for k, (length, values) in enumerate(rows):
                        values["normal_load"] = min(2 * N, N * max(0, 1 + 1.2 * math.sin(0.08 * k)))
                        values["rolling_speed"] *= k not in range(100, 110)
                expected = kind.by_library([*arguments, start], rows)
                steady = {"initial_state": 2} if "initial_state" in fmu.references else {}
                instance = Instance(fmu).start(**variant, **({**steady, **rows[0][1]} if start == "steady" else {}))
                time, different = 0.0, set()
                for k, ((length, values), exact) in enumerate(zip(rows, expected)):
                    if k % 5 == 1:  # a step that is rejected, and another in its place
                        state = instance.calls.getFMUstate()
                        instance.set(**kind.row(k + 1))
                        instance.step(time, 2 * length)
                        instance.calls.setFMUstate(state)
                        instance.calls.freeFMUstate(state)
                    if k > 0 or start == "rest":
                        instance.set(**values)
                        assert instance.step(time, length) == ok, instance.messages
                        time += length
                    assert kind.outcome(instance) == exact, (fmu.description.modelName, start, k)
                    different.add(exact[-1])
                print(f"    {fmu.description.modelName}, {variant}, {start}")
                assert len(different) > 10  # numbers of sticking elements, or heats
                instance.close()


def test_half_length_follows_the_load():
    for fmu, kind, variant in each():
        if not kind.follows_load or "given_half_length" in variant:
            continue
        instance = Instance(fmu).start(**variant)
        before = instance.get("contact_half_length")
        instance.set(normal_load=1.331 * N)
        assert instance.step(0.0, 10 * duration) == ok
        assert math.isclose(instance.get("contact_half_length"), 1.1 * before, rel_tol=1e-13)
        instance.close()


def test_rates_of_inputs():
    """A step over which inputs vary linearly is one at the mean of velocities and the end of loads; by table, without
    memory, all at its end."""
    for fmu, kind, variant in each():
        at_end = variant.get("mode") == 2 or fmu.description.modelName == "rollbem_wheelset"
        told, by_rate = (Instance(fmu).start(**variant) for _ in range(2))
        for k in range(3):
            now, then = kind.row(k), kind.row(k + 1)
            by_rate.set(**now)
            for name in now:
                by_rate.rate(name, (then[name] - now[name]) / duration)
            velocities = [] if at_end else [*kind.slips, "rolling_speed"]
            told.set(**{name: (now[name] + then[name]) / 2 if name in velocities else then[name] for name in now})
            for instance in (told, by_rate):
                assert instance.step(k * duration, duration) == ok, instance.messages
            assert np.allclose(*([one.get(name) for name in kind.forces()] for one in (told, by_rate)), rtol=1e-9)
        told.close()
        by_rate.close()


def test_derivatives_of_a_step():
    for fmu, kind, variant in each():
        def after(changes, known=None):
            instance = Instance(fmu).start(**variant)
            kind.roll(instance, 0, 6)
            instance.set(**{**kind.row(6), **changes})
            assert instance.step(6 * duration, 2 * duration) == ok, instance.messages
            found = [instance.derivative(name, known) if known else instance.get(name) for name in kind.forces()]
            instance.close()
            return np.array(found)

        for known in kind.inputs(variant):
            value = {**variant, **kind.row(6)}[known]
            found = after({}, known)
            distance = math.inf  # the better of two: the smaller change has less curvature, the larger less rounding
            for change in (size * abs(kind.slips.get(known, value)) for size in (3e-6, 3e-5)):
                difference = (after({known: value + change}) - after({known: value - change})) / (2 * change)
                distance = min(distance, np.abs(found - difference).max() / np.abs(difference).max())
            print(f"        by {known}: error {distance:.1e}")
            assert distance < 1e-6
        if "given_half_length" in fmu.references and "given_half_length" not in variant:
            instance = Instance(fmu).start(**variant)
            kind.roll(instance, 0, 1)
            assert status_of(lambda: instance.derivative("longitudinal_force", "given_half_length")) == discard
            instance.close()


def test_inputs_for_parameters():
    """A factor of mu acts as another mu; semi-axes by Hertz's formula, given, as those that follow the load."""
    for fmu, kind, variant in each():
        if not kind.others:
            continue
        ways = [dict(friction_coefficient=0.2), dict(friction_coefficient=0.4, friction_factor=0.5)]
        if variant is table:
            sizes = {f"given_{name}": Instance(fmu).start(**table).get(f"contact_{name}")
                     for name in ("half_length", "half_width")}
            ways.append({**ways[0], **sizes})
        found = []
        for way in ways:
            instance = Instance(fmu).start(**{**variant, **way})
            instance.set(**{name: size for name, size in kind.slips.items()})
            for k in range(20):
                assert instance.step(k * duration, duration) == ok, instance.messages
            found.append(np.array([kind.outcome(instance)]))
            instance.close()
        for other in found[1:]:
            assert np.abs(other - found[0]).max() < 1e-11 * np.abs(found[0]).max(), found


def test_saved_in_one_instance_and_restored_in_another():
    for fmu, kind, variant in each():
        instance = Instance(fmu).start(**variant)
        kind.roll(instance, 0, 20)
        state = instance.calls.getFMUstate()
        before = kind.outcome(instance)
        derivatives = [instance.derivative(kind.forces()[0], name) for name in kind.slips]
        once = kind.roll(instance, 20, 15)
        kind.roll(instance, 35, 5)
        instance.calls.setFMUstate(state)
        saved = instance.calls.serializeFMUstate(state)
        other = Instance(fmu)  # never started
        copy = other.calls.deSerializeFMUstate(saved)
        other.calls.setFMUstate(copy)
        for one in (instance, other):
            assert kind.outcome(one) == before
            assert [one.derivative(kind.forces()[0], name) for name in kind.slips] == derivatives
            assert kind.roll(one, 20, 15) == once
        for damaged in (saved[:100], saved[:200] + b"?" + saved[201:], b""):
            assert status_of(lambda: Instance(fmu).calls.deSerializeFMUstate(damaged)) == error
        for one, which in ((instance, state), (other, copy)):
            one.calls.freeFMUstate(which)
            one.close()


def test_two_instances_at_once():
    for fmu, kind, variant in each():
        def start():
            return [Instance(fmu).start(**variant, **other) for other in ({}, dict([kind.parameter]))]

        alone = [kind.roll(instance, 0, 10) for instance in start()]
        assert alone[0] != alone[1]
        both = start()
        together = [[kind.roll(instance, k, 1)[0] for instance in both] for k in range(10)]
        assert [list(found) for found in zip(*together)] == alone


def test_what_a_step_refuses():
    for fmu in fmus:
        kind = kinds[fmu.description.modelName]
        statuses = [item.name for item in next(v for v in fmu.description.modelVariables
                                               if v.name == "status").declaredType.items]
        for variant, values, status in kind.refused:
            print(f"    {fmu.description.modelName}, {kind.variants[variant]}: {values}")
            instance = Instance(fmu).start(**kind.variants[variant])
            kind.roll(instance, 0, 5)
            before = kind.outcome(instance)
            instance.set(**values)
            assert instance.step(5 * duration, duration) == discard
            assert status in instance.messages[-1] and "refused" in instance.messages[-1], instance.messages
            assert all(f"{name} = " in instance.messages[-1] for name in values), instance.messages
            assert statuses[instance.get("status")] == statuses[instance.get("status_code")] == status
            assert instance.last_successful_time() == 5 * duration and instance.wants_to_stop()
            assert kind.outcome(instance) == before
            given_axes = [name for name in values if name.startswith("given_")]
            instance.set(**{name: kind.variants[variant].get(name, 0.0) for name in given_axes})
            # the next step is as if nothing had been asked
            after = kind.roll(instance, 5, 1)
            assert not instance.wants_to_stop()
            other = Instance(fmu).start(**kind.variants[variant])
            assert kind.roll(other, 0, 6)[-1:] == after
            other.close()
            # an importing program that goes on all the same would lose the distance of a step
            instance.set(**values)
            assert instance.step(6 * duration, duration) == discard
            instance.set(**kind.row(7))
            assert instance.step(7 * duration, duration) == error
            instance.close()


def test_what_is_not_a_number():
    for fmu, kind, variant in each():
        instance = Instance(fmu).start(**variant)
        kind.roll(instance, 0, 3)
        before, state = kind.outcome(instance), instance.calls.getFMUstate()
        for name in kind.inputs(variant):
            for value in (math.nan, math.inf):
                instance.set(**{name: value})
                assert instance.step(3 * duration, duration) == error
                assert "needs finite numbers" in instance.messages[-1]
                assert status_of(lambda: instance.set(**{name: 1.0})) == error  # until a state is restored or a reset
                instance.calls.setFMUstate(state)
        for length in (0.0, -duration, math.nan, math.inf):
            assert instance.step(3 * duration, length) == error
            instance.calls.setFMUstate(state)
        assert kind.outcome(instance) == before
        kind.roll(instance, 3, 1)
        instance.calls.freeFMUstate(state)
        instance.close()


def test_wrong_parameters():
    for fmu in fmus:
        for parameters, words in kinds[fmu.description.modelName].wrong:
            parameters = {name: value for name, value in parameters.items() if name in fmu.references}
            instance = Instance(fmu)
            instance.calls.setupExperiment()
            instance.set(**parameters)
            instance.calls.enterInitializationMode()
            assert status_of(instance.calls.exitInitializationMode) == error, parameters
            assert words in instance.messages[-1], instance.messages
            instance.calls.reset()  # the instance can then start again
            instance.start()
            instance.close()


def test_order_of_calls():
    for fmu, kind, variant in each():
        instance = Instance(fmu)
        assert instance.step(0.0, duration) == error
        assert "fmi2DoStep must not be called now" in instance.messages[-1]
        instance.calls.reset()
        instance.start(**variant)
        for name, words in ((kind.parameter[0], "fixed"), (kind.forces()[0], "calculated")):
            assert status_of(lambda: instance.set(**{name: 0.25})) == error
            assert words in instance.messages[-1]
            instance.calls.reset()
            instance.start(**variant)
        assert status_of(lambda: instance.calls.getReal([9999])) == error
        instance.close()
        try:
            Instance(fmu, guid="{00000000-0000-0000-0000-000000000000}")
            raise AssertionError("a wrong GUID was accepted")
        except Exception as exception:
            assert "instantiate" in str(exception)


def test_reset_is_as_new():
    for fmu, kind, variant in each():
        name, value = kind.parameter
        instance = Instance(fmu).start(**variant, **{name: value})
        kind.roll(instance, 0, 5)
        instance.calls.reset()
        start = next(v.start for v in fmu.description.modelVariables if v.name == name)
        assert instance.get(name) == float(start) != value
        assert kind.roll(instance.start(**variant), 0, 5) == kind.roll(Instance(fmu).start(**variant), 0, 5)
        instance.close()


def test_debug_logging():
    for fmu in fmus:
        instance = Instance(fmu)
        instance.calls.setDebugLogging(True, ["logStatusDiscard"])
        assert instance.step(0.0, duration) == error and instance.messages == []
        instance.calls.reset()
        instance.calls.setDebugLogging(False, [])
        assert instance.step(0.0, duration) == error and len(instance.messages) == 1
        assert status_of(lambda: instance.calls.setDebugLogging(True, ["none"])) == error
        instance.close()


fmus = [Fmu(file) for file in sys.argv[3:]]
run(globals(), *fmus)
