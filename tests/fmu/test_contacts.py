"""What the FMUs have in common: test_contacts.py LIBRARY_RUN TABLES FMU..., the program that takes the same steps with
the library, and the folder of the tables that wheelsets need."""
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field

import numpy as np
from fmpy.validation import validate_fmu

from support import Fmu, Instance, discard, error, ok, run, status_of

V, N, duration = 20.0, 1e5, 2.5e-5  # of start values; a step rolls by a tenth of the half-length
tables = sys.argv[2]


@dataclass
class Kind:
    """Steps and refusals of an FMU."""
    variants: list  # parameters
    slips: dict  # slip velocities, or positions and velocities, which vary during runs
    outputs: list  # forces, which have derivatives, and what else a step gives
    refused: list  # index of the variant, inputs, status of the step
    wrong: list  # parameters, words
    library: list  # variant, arguments of the program of the library
    line: tuple  # inputs in the order of its lines
    others: dict = field(default_factory=dict)  # further inputs, which vary by a fifth
    loads: tuple = ("normal_load",)

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
            instance.go(k * duration, duration, **self.row(k))
            found.append(self.outcome(instance))
        return found

    def by_library(self, arguments, rows):
        """Outcomes of rows of duration and inputs."""
        text = "".join(" ".join(float(value).hex() for value in (length, *(values[name] for name in self.line))) + "\n"
                       for length, values in rows)
        lines = subprocess.run([sys.argv[1], *arguments], input=text, capture_output=True, text=True,
                               check=True).stdout.splitlines()
        assert len(lines) == len(rows)
        return [[float.fromhex(number) for number in line.split()] for line in lines]


table = {"mode": 2}
given = {**table, "given_half_length": 6e-3, "given_half_width": 4e-3}
friction = ({"friction_coefficient": -0.1}, "friction_coefficient = -0.1 must be finite and not negative")
slips = {"longitudinal_slip_velocity": 0.04, "lateral_slip_velocity": 0.03, "spin_rate": 3.0}
motion = {"lateral_shift": 4e-3, "yaw": 4e-3, "pitch_rate": 0.3, "lateral_velocity": 0.1, "vertical_velocity": 0.02,
          "roll_rate": 0.02, "yaw_rate": 0.1}
kinds = {
    "rollbem_patch": Kind(
        variants=[{"mesh_size": 1}, {"mesh_size": 2}, table, given], others={"friction_factor": 1.0}, slips=slips,
        outputs=["longitudinal_force", "lateral_force", "spin_moment", "slip_work", "sticking_elements"],
        library=[({}, "patch", "follows", "rest"), ({"initial_state": 2}, "patch", "follows", "steady"),
                 ({"mesh_size": 2}, "patch", "fixed", "rest"), (table, "patch", tables + "/steel.creep", "steady")],
        line=(*slips, "rolling_speed", "normal_load", "friction_factor"),
        refused=[(0, {"normal_load": 2 * N}, "needs_fixed_mesh"), (0, {"normal_load": 0.0}, "invalid_load"),
                 (0, {"rolling_speed": 0.0, "normal_load": 1.3 * N}, "needs_fixed_mesh"),
                 (0, {"friction_factor": -0.1}, "invalid_load"), (0, {"given_half_length": 1e-3}, "invalid_load"),
                 (1, {"normal_load": 2.1 * N}, "invalid_load"), (1, {"rolling_speed": -1.0}, "invalid_step"),
                 (2, {"normal_load": -1.0}, "invalid_load"), (3, {"given_half_width": 0.0}, "invalid_load")],
        wrong=[friction, ({"poisson_ratio": 0.7}, "poisson_ratio = 0.7 must lie in [0, 0.5]"),
               ({"shear_modulus": -1.0}, "shear_modulus = -1 must be positive and finite"),
               ({"wheel_rolling_radius": 0.0}, "wheel_rolling_radius = 0 must be a number other than 0"),
               ({"rail_lateral_radius": -0.3}, "smaller principal curvature of the gap"),
               ({"elements": 0}, "elements = 0 must lie in [1, 32]"),
               ({"mesh_size_code": 3}, "mesh_size_code = 3 must lie in [0, 2]"),
               ({"initial_state": 3}, "initial_state = 3 must lie in [1, 2]"),
               ({"initial_state": 2, "rolling_speed": 0.0}, "rolling_speed = 0 must be positive"),
               ({"initial_state": 2, "spin_rate": math.inf}, "spin_rate = inf must be finite"),
               ({"normal_load": 3e5, "mesh_size": 2}, "normal_load = 300000 must be at most largest_load"),
               ({"normal_load": 0.0}, "normal_load = 0 must be positive where mesh_size"),
               ({"friction_factor": -0.1}, "friction_factor = -0.1 must be finite and not negative"),
               ({"given_half_width": 1e-3}, "given_half_width = 0.001 must be 0 where mode is patch"),
               ({**table, "poisson_ratio": 0.26999}, "poisson_ratio = 0.26999 must be within 0.01 of 0.28"),
               ({**table, "rail_lateral_radius": 0.002}, "must lie in [0.1"),
               ({**table, "normal_load": -1.0}, "normal_load = -1 must not be negative"),
               ({**table, "rolling_speed": -1.0}, "rolling_speed = -1 must not be negative"),
               ({**table, "spin_rate": math.inf}, "spin_rate = inf must be finite")]),
    "rollbem_wheelset": Kind(
        variants=[{}], loads=("left_load", "right_load"), slips=motion,
        outputs=[f"{side}{axis}_{kind}" for side in ("", "left_", "right_")
                 for kind, axes in (("force", ("longitudinal", "lateral", "vertical")),
                                    ("moment", ("roll", "pitch", "yaw"))) for axis in axes] + ["slip_work"],
        library=[({}, "wheelset", tables, "steady")],
        line=("lateral_shift", "yaw", "rolling_speed", *list(motion)[2:], "left_load", "right_load"),
        refused=[(0, {"lateral_shift": 9.1e-3}, "wrong_table"), (0, {"left_load": -1.0}, "invalid_load"),
                 (0, {"rolling_speed": -1.0}, "invalid_step")],
        wrong=[friction,
               ({"contact_table_file": "/none"},
                "contact_table_file = /none: ContactTable: /none must be a file that can be read"),
               ({"lateral_shift": 1.0}, "status of the tables at the first inputs = wrong_table"),
               ({"lateral_shift": math.nan}, "lateral_shift = nan must be finite")]),
}


def each():
    """FMU, what is asked of it, and each variant of its parameters."""
    for fmu in fmus:
        for variant in kinds[fmu.name].variants:
            print(f"    {fmu.name}, {variant}")
            yield fmu, kinds[fmu.name], variant


def test_validation():
    for fmu in fmus:
        assert validate_fmu(fmu.file) == []
        library = Instance(fmu).calls.dll._name
        exported = subprocess.run(["nm", "--dynamic", "--defined-only", library], capture_output=True, text=True,
                                  check=True).stdout.split()[2::3]
        assert "fmi2DoStep" in exported and all(name.startswith("fmi2") for name in exported), exported
        assert not {"fmi2GetDerivatives", "fmi2SetTime"} & set(exported)


def test_equals_the_library_over_rejected_steps():
    """Bit for bit, from rest and from steady rolling; on a fixed mesh the wheel lifts off and shifts at standstill."""
    for fmu, kind in ((fmu, kinds[fmu.name]) for fmu in fmus):
        for variant, *arguments in kind.library:
            print(f"    {fmu.name}, {arguments}")
            rows = [(duration * (1 if k % 7 else 1.5), kind.row(k)) for k in range(150)]
            if "fixed" in arguments:
                for k, (length, values) in enumerate(rows):
                    values["normal_load"] = min(2 * N, N * max(0, 1 + 1.2 * math.sin(0.08 * k)))
                    values["rolling_speed"] *= k not in range(100, 110)
            steady = "steady" in arguments
            instance = fmu.start(variant, **(rows[0][1] if steady else {}))
            time, different = 0.0, set()
            for k, ((length, values), exact) in enumerate(zip(rows, kind.by_library(arguments, rows))):
                if k % 5 == 1:  # a step that is rejected, and another in its place
                    state = instance.calls.getFMUstate()
                    instance.set(**kind.row(k + 1))
                    instance.step(time, 2 * length)
                    instance.calls.setFMUstate(state)
                    instance.calls.freeFMUstate(state)
                if k > 0 or not steady:
                    instance.go(time, length, **values)
                    time += length
                assert kind.outcome(instance) == exact, (k, kind.outcome(instance), exact)
                different.add(exact[3])
            assert len(different) > 100


def test_rates_of_inputs():
    """A step over which inputs vary linearly is one at the mean of velocities and the end of loads; by table, without
    memory, all at its end."""
    for fmu, kind, variant in each():
        at_end = variant.get("mode") == 2 or fmu.name == "rollbem_wheelset"
        told, by_rate = fmu.start(variant), fmu.start(variant)
        for k in range(3):
            now, then = kind.row(k), kind.row(k + 1)
            by_rate.set(**now)
            for name in now:
                by_rate.rate(name, (then[name] - now[name]) / duration)
            velocities = [] if at_end else [*kind.slips, "rolling_speed"]
            told.set(**{name: (now[name] + then[name]) / 2 if name in velocities else then[name] for name in now})
            for instance in (told, by_rate):
                instance.go(k * duration, duration)
            assert np.allclose(*([one.get(name) for name in kind.forces()] for one in (told, by_rate)), rtol=1e-9)


def test_derivatives_of_a_step():
    for fmu, kind, variant in each():
        def after(changes, known=None):
            instance = fmu.start(variant)
            kind.roll(instance, 0, 6)
            instance.go(6 * duration, 2 * duration, **{**kind.row(6), **changes})
            return np.array([instance.derivative(name, known) if known else instance.get(name)
                             for name in kind.forces()])

        for known in kind.inputs(variant):
            value = {**variant, **kind.row(6)}[known]
            found = after({}, known)
            distance = math.inf  # the better of two: the smaller change has less curvature, the larger less rounding
            for change in (size * abs(kind.slips.get(known, value)) for size in (3e-6, 3e-5)):
                difference = (after({known: value + change}) - after({known: value - change})) / (2 * change)
                distance = min(distance, np.abs(found - difference).max() / np.abs(difference).max())
            print(f"        by {known}: error {distance:.1e}")
            assert distance < 1e-6
        if "given_half_length" in fmu.variables and variant is not given:
            instance = fmu.start(variant)
            kind.roll(instance, 0, 1)
            assert status_of(lambda: instance.derivative("longitudinal_force", "given_half_length")) == discard


def test_saved_in_one_instance_and_restored_in_another():
    for fmu, kind, variant in each():
        instance, other = fmu.start(variant), Instance(fmu)  # never started
        kind.roll(instance, 0, 20)
        state = instance.calls.getFMUstate()

        def present(one):
            return kind.outcome(one), [one.derivative(kind.forces()[0], name) for name in kind.slips]

        before, once = present(instance), kind.roll(instance, 20, 15)
        instance.calls.setFMUstate(state)
        saved = instance.calls.serializeFMUstate(state)
        copy = other.calls.deSerializeFMUstate(saved)
        other.calls.setFMUstate(copy)
        for one in (instance, other):
            assert present(one) == before and kind.roll(one, 20, 15) == once
        other.calls.freeFMUstate(copy)
        for damaged in (saved[:100], saved[:200] + b"?" + saved[201:], b""):
            assert status_of(lambda: other.calls.deSerializeFMUstate(damaged)) == error
            other = Instance(fmu)
        instance.calls.freeFMUstate(state)


def test_two_instances_at_once():
    for fmu, kind, variant in each():
        def start():
            return [fmu.start(variant), fmu.start(variant, friction_coefficient=0.25)]

        alone = [kind.roll(instance, 0, 10) for instance in start()]
        assert alone[0] != alone[1]
        both = start()
        together = [[kind.roll(instance, k, 1)[0] for instance in both] for k in range(10)]
        assert [list(found) for found in zip(*together)] == alone


def test_what_a_step_refuses():
    for fmu, kind in ((fmu, kinds[fmu.name]) for fmu in fmus):
        statuses = [item.name for item in fmu.variables["status"].declaredType.items]
        for variant, values, status in ((kind.variants[k], *rest) for k, *rest in kind.refused):
            print(f"    {fmu.name}, {variant}: {values}")
            instance = fmu.start(variant)
            kind.roll(instance, 0, 5)
            before = kind.outcome(instance)
            instance.set(**values)
            assert instance.step(5 * duration, duration) == discard
            said = instance.messages[-1]
            assert all(words in said for words in (status, "refused", *(f"{name} = " for name in values))), said
            assert statuses[instance.get("status")] == statuses[instance.get("status_code")] == status
            assert instance.stopped() == (5 * duration, True) and kind.outcome(instance) == before
            # the next step is as if nothing had been asked
            instance.set(**{name: variant.get(name, 0.0) for name in values if name.startswith("given_")})
            after = kind.roll(instance, 5, 1)
            assert not instance.stopped()[1] and kind.roll(fmu.start(variant), 0, 6)[-1:] == after
            # an importing program that goes on all the same would lose the distance of a step
            instance.set(**values)
            assert instance.step(6 * duration, duration) == discard
            instance.set(**kind.row(7))
            assert instance.step(7 * duration, duration) == error


def test_what_is_not_a_number():
    for fmu, kind, variant in each():
        instance = fmu.start(variant)
        kind.roll(instance, 0, 3)
        before, state = kind.outcome(instance), instance.calls.getFMUstate()
        for name in kind.inputs(variant):
            instance.set(**{name: math.nan})
            instance.refuses(lambda: instance.step(3 * duration, duration), "needs finite numbers")
            assert status_of(lambda: instance.set(**{name: 1.0})) == error  # until a state is restored or a reset
            instance.calls.setFMUstate(state)
        for length in (0.0, -duration, math.nan, math.inf):
            assert instance.step(3 * duration, length) == error
            instance.calls.setFMUstate(state)
        assert kind.outcome(instance) == before
        kind.roll(instance, 3, 1)
        instance.calls.freeFMUstate(state)


def test_wrong_parameters():
    for fmu in fmus:
        for parameters, words in kinds[fmu.name].wrong:
            instance = Instance(fmu)
            instance.refuses(lambda: instance.start(**parameters), words)
            instance.calls.reset()  # the instance can then start again
            instance.start()


def test_order_of_calls():
    for fmu, kind, variant in each():
        instance = Instance(fmu)
        instance.refuses(lambda: instance.step(0.0, duration), "fmi2DoStep must not be called now")
        for name, words in (("friction_coefficient", "fixed"), (kind.forces()[0], "calculated")):
            instance.calls.reset()
            instance.start(**variant)
            instance.refuses(lambda: instance.set(**{name: 0.25}), words)
        assert status_of(lambda: instance.calls.getReal([9999])) == error
        try:
            Instance(fmu, guid="{00000000-0000-0000-0000-000000000000}")
            raise AssertionError("a wrong GUID was accepted")
        except Exception as exception:
            assert "instantiate" in str(exception)


def test_reset_is_as_new():
    for fmu, kind, variant in each():
        instance = fmu.start(variant, friction_coefficient=0.25)
        kind.roll(instance, 0, 5)
        instance.calls.reset()
        assert instance.get("friction_coefficient") == float(fmu.variables["friction_coefficient"].start)
        assert kind.roll(instance.start(**variant), 0, 5) == kind.roll(fmu.start(variant), 0, 5)


def test_debug_logging():
    for fmu in fmus:
        for on, categories, count in ((True, ["logStatusDiscard"], 0), (False, [], 1)):
            instance = Instance(fmu)
            instance.calls.setDebugLogging(on, categories)
            assert instance.step(0.0, duration) == error and len(instance.messages) == count
        assert status_of(lambda: instance.calls.setDebugLogging(True, ["none"])) == error


with tempfile.TemporaryDirectory() as folder:
    fmus = [Fmu(file, f"{folder}/{k}") for k, file in enumerate(sys.argv[3:])]
    run(globals())
