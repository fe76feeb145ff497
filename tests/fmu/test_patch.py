"""rollbem_patch.fmu: test_patch.py FMU: sizes, and forces by table."""
import math
import os
import shutil
import sys
import tempfile

import numpy as np

from support import Fmu, Instance, discard, ok, run

# start values of the FMU and of the program
G, nu, mu, V, N = 8e10, 0.28, 0.3, 20.0, 1e5
table = {"mode": 2}
inputs = ("longitudinal_slip_velocity", "lateral_slip_velocity", "spin_rate", "rolling_speed", "normal_load")
forces = ("longitudinal_force", "lateral_force", "spin_moment")
values = dict(zip(inputs, (0.02, -0.03, 1.0, V, N)))


def force(instance):
    return np.array([instance.get(name) for name in forces])


def axes(instance):
    return np.array([instance.get(f"contact_half_{name}") for name in ("length", "width")])


def derivatives(instance, known):
    return np.array([instance.derivative(name, known) for name in forces])


def test_size_follows_hertz():
    radius = (3 * N * 0.5 * (1 - nu) / (4 * G)) ** (1 / 3)
    for variant in ({"mesh_size": 1}, {"mesh_size": 2}, table):
        instance = fmu.start(variant, wheel_rolling_radius=0.5, wheel_lateral_radius=0.5, rail_lateral_radius=1e9)
        assert np.allclose(axes(instance), radius, rtol=1e-8)
        instance.go(0.0, 2.5e-4, normal_load=1.331 * N)
        assert np.allclose(axes(instance), 1.1 * radius, rtol=1e-8)
    long, wide = fmu.start(wheel_rolling_radius=0.8), fmu.start(
        wheel_rolling_radius=1e9, wheel_lateral_radius=0.8, rail_rolling_radius=0.3, rail_lateral_radius=1e9)
    assert axes(long)[0] > 1.5 * axes(long)[1] and np.allclose(axes(wide)[::-1], axes(long), rtol=1e-14)


def test_table_is_near_the_patch():
    for radii, most_in_mean, most in (({}, 3e-3, 2e-2), ({"rail_lateral_radius": 5.0}, 7e-3, 7e-2)):  # a/b = 1.3, 0.2
        random = np.random.default_rng(1)
        instance, errors = fmu.start(table, radii), []
        a, b = axes(instance)
        c = math.sqrt(a * b)
        for i in range(40):
            direction = random.normal(size=3)
            level = 0.02 * 1000 ** random.random() * mu * N / (G * c * c)
            slip = direction / np.linalg.norm(direction) * level * V / np.array([4.5, 4, 3 * c])
            here = dict(zip(inputs, [*slip, V, N]))
            instance.go(float(i), 1.0, **here)
            patch = fmu.start(here, radii, initial_state=2, elements=12, strips=12)
            errors.append(np.abs((force(instance) - force(patch)) / (mu * N * np.array([1, 1, c]))).max())
        print(f"    a/b = {a / b:.2f}: differences over mu N: mean {np.mean(errors):.1e}, largest {max(errors):.1e}")
        assert np.mean(errors) < most_in_mean and max(errors) < most


def test_given_semi_axes_act_as_those_by_hertz():
    by_load = fmu.start(table)
    given = fmu.start(table, dict(zip(("given_half_length", "given_half_width"), axes(by_load))))
    for instance in (by_load, given):
        instance.go(0.0, 1e-3, **values)
    assert np.abs(force(given) - force(by_load)).max() < 1e-11 * mu * N


def test_work_by_table_is_the_mean_power_of_both_ends():
    other = dict(zip(inputs, (-0.01, 0.02, 0.5, 1.1 * V, 1.2 * N)))
    duration, instance = 1e-3, fmu.start(table, values)
    for name in inputs:
        instance.rate(name, (other[name] - values[name]) / duration)
    first, last = ((force(fmu.start(table, end)), [end[name] for name in inputs[:3]]) for end in (values, other))
    instance.go(0.0, duration)
    assert np.abs(force(instance) - last[0]).max() < 1e-6
    assert math.isclose(instance.get("slip_work"), -(np.dot(*first) + np.dot(*last)) / 2 * duration, rel_tol=1e-9)


def test_table_without_load():
    # The first load slides: mu times the direction of the slip, no moment, at standstill, too. Spin alone, where the
    # share of the contact that slides is the same under any load, gives the lateral force over any load. Nothing by
    # other inputs.
    by_spin = force(fmu.start(table, spin_rate=2.0))[1] / (mu * N)
    assert abs(by_spin) > 0.1
    for slip, expected in (((0.3, -0.4, 2.0, V), (-0.6, 0.8, 0)), ((3e-9, 4e-9, 0.0, 0.0), (-0.6, -0.8, 0)),
                           ((0.0, 0.0, 2.0, V), (0, by_spin, 0)), ((0.0, 0.0, 0.0, V), (0, 0, 0))):
        instance = fmu.start(table)
        for load in (0.0, 5e-324, 1e-310, 1e-290, 1e-9):
            instance.go(0.0, 1e-3, **dict(zip(inputs, (*slip, load))))
            least = load < 1e-300
            distance = np.abs(derivatives(instance, "normal_load") - mu * np.array(expected)).max()
            assert distance < (1e-15 if least else 1e-4), (load, distance)  # error of the table
            by_others = np.array([derivatives(instance, known) for known in inputs[:4]])
            assert np.isfinite(by_others).all() and not (least and np.any(by_others))
            assert np.abs(force(instance)).max() <= (0 if least else mu * load * (1 + 1e-4))
        # what has none leaves the instance as it is
        for name in ("contact_half_length", "slip_work"):
            instance.refuses(lambda: instance.derivative(name, "normal_load"),
                             f"there is no derivative of {name} by normal_load", discard)
        instance.go(0.0, 1e-3, normal_load=N)
        assert axes(instance)[0] > 0


def test_derivatives_before_the_first_step():
    # a table has the derivatives of the forces shown, as after a step, and none at rest; steady rolling refuses them
    instance = fmu.start(table, values)
    first = np.array([derivatives(instance, known) for known in inputs])
    instance.go(0.0, 1e-3)
    after = np.array([derivatives(instance, known) for known in inputs])
    assert np.all(np.abs(first - after) <= 1e-12 * np.abs(after)) and np.all(first)
    instance = fmu.start(values)
    assert not np.any(force(instance)) and not np.any([derivatives(instance, known) for known in inputs])
    instance = fmu.start(values, initial_state=2)
    instance.refuses(lambda: derivatives(instance, inputs[0]),
                     f"there is no derivative of {forces[0]} by {inputs[0]} before the first step", discard)
    instance.go(0.0, 1e-5)
    assert instance.derivative(forces[0], inputs[0]) < 0


def test_semi_axes_beyond_the_table():
    # a step warns where a/b leaves the table, an output tells while it is beyond; forces stay at the border
    def given(a_over_b):
        return {"given_half_length": 5e-3 * math.sqrt(a_over_b), "given_half_width": 5e-3 / math.sqrt(a_over_b)}

    warning = 1
    border = force(fmu.start(table, values, given(10)))
    instance = fmu.start(table, values, given(2))
    for k, (a_over_b, *expected) in enumerate(((2, ok, 0, 0), (25, warning, 1, 1), (25, ok, 1, 1), (10, ok, 0, 1),
                                               (0.05, warning, 1, 2))):  # what has been said is not said again
        instance.set(**given(a_over_b))
        status = instance.calls.dll.fmi2DoStep(instance.calls.component, k * 1e-3, 1e-3, 0)  # FMPy hides warnings
        assert [status, instance.get("off_table"), len(instance.messages)] == expected, (k, instance.messages)
        assert a_over_b < 10 or np.abs(force(instance) - border).max() < 1e-9 * mu * N
    assert instance.messages[0].startswith("a/b = 25 of the contact lies beyond the table, 0.1 to 10")
    instance.set(given_half_width=0.0)
    assert instance.step(5e-3, 1e-3) == discard and instance.get("off_table") == 1
    begins = fmu.start(table, values, given(25))
    assert begins.get("off_table") == 1 and len(begins.messages) == 1


def test_table_of_another_file():
    # a path with spaces; the packed table is found in one as well
    with tempfile.TemporaryDirectory(prefix="a table % ") as elsewhere:
        copy = os.path.join(elsewhere, "of forces.bin")
        shutil.copy(os.path.join(fmu.folder, "resources", "steel.creep"), copy)
        here, there = fmu.start(table, values), fmu.start(table, values, table_file=copy)
        moved = Fmu(fmu.file, os.path.join(elsewhere, "folder")).start(table, values)
        assert (force(here) == force(there)).all() and (force(here) == force(moved)).all()
        # a state knows its table
        state, other = there.calls.getFMUstate(), Instance(fmu)
        restored = other.calls.deSerializeFMUstate(there.calls.serializeFMUstate(state))
        other.calls.setFMUstate(restored)
        for one in (there, other):
            one.go(0.0, 1e-3, spin_rate=2.0)
            assert one.get("table_file") == copy
        assert (force(there) == force(other)).all()
        there.calls.freeFMUstate(state)
        other.calls.freeFMUstate(restored)
        damaged = shutil.copy(copy, copy + "2")
        with open(damaged, "r+b") as bytes_of:
            bytes_of.seek(1000)
            bytes_of.write(b"x")
        missing = elsewhere + "/none"
        for name, message in ((damaged, "checksum"), (fmu.file, "must begin with"), (missing, "can be read")):
            instance = Instance(fmu)
            instance.refuses(lambda: instance.start(**table, table_file=name), f"table_file = {name}")
            assert message in instance.messages[-1]


with tempfile.TemporaryDirectory() as folder:
    fmu = Fmu(sys.argv[1], folder + "/fmu")
    run(globals())
