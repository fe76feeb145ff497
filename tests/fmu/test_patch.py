"""rollbem_patch.fmu: test_patch.py FMU: forces by table, and sizes."""
import math
import os
import shutil
import sys
import tempfile

import numpy as np

from support import Fmu, Instance, close_to, discard, error, ok, run, status_of

file = sys.argv[1]
fmu = Fmu(file)

# start values of the FMU and of the program
G, nu, mu, V, N = 8e10, 0.28, 0.3, 20.0, 1e5
follows_load, fixed, by_table = {"mesh_size": 1}, {"mesh_size": 2}, {"mode": 2}
inputs = ("longitudinal_slip_velocity", "lateral_slip_velocity", "spin_rate", "rolling_speed", "normal_load")
forces = ("longitudinal_force", "lateral_force", "spin_moment")
circle = {"wheel_rolling_radius": 0.5, "wheel_lateral_radius": 0.5}
radius = (3 * N * 0.5 * (1 - nu) / (4 * G)) ** (1 / 3)  # of its contact with a flat rail, rail_lateral_radius = 1e9
a = 6e-3  # about the half-length at the start values
limit = mu * N / (G * a * a)  # creepage at which much of the contact slips


def outcome(instance):
    return tuple(instance.get(name) for name in (*forces, "slip_work", "sticking_elements"))


def force(instance):
    return np.array([instance.get(name) for name in forces])


def set_inputs(instance, values):
    instance.set(**dict(zip(inputs, values)))


def test_size_follows_hertz():
    for parameters in (follows_load, fixed):
        instance = Instance(fmu).start(**parameters, **circle, rail_lateral_radius=1e9)
        close_to(instance.get("contact_half_length"), radius, 1e-8, "circle, half-length")
        close_to(instance.get("contact_half_width"), radius, 1e-8, "half-width")
        instance.close()
    long, wide = Instance(fmu).start(wheel_rolling_radius=0.8), Instance(fmu).start(
        wheel_rolling_radius=1e9, wheel_lateral_radius=0.8, rail_rolling_radius=0.3, rail_lateral_radius=1e9)
    assert long.get("contact_half_length") > 1.5 * long.get("contact_half_width")
    close_to(wide.get("contact_half_width"), long.get("contact_half_length"), 1e-14, "axes exchanged")
    long.close()
    wide.close()


def test_table_is_near_the_patch():
    for radii, most_in_mean, most in (({}, 3e-3, 2e-2), ({"rail_lateral_radius": 5.0}, 7e-3, 7e-2)):  # a/b = 1.3, 0.2
        random = np.random.default_rng(1)
        table, errors = Instance(fmu).start(**by_table, **radii), []
        a, b = (table.get(name) for name in ("contact_half_length", "contact_half_width"))
        c = math.sqrt(a * b)
        for i in range(40):
            direction = random.normal(size=3)
            level = 0.02 * 1000 ** random.random() * mu * N / (G * c * c)
            values = [*(direction / np.linalg.norm(direction) * level * V / np.array([4.5, 4, 3 * c])), V, N]
            set_inputs(table, values)
            assert table.step(float(i), 1.0) == ok
            patch = Instance(fmu).start(initial_state=2, elements=12, strips=12, **radii, **dict(zip(inputs, values)))
            errors.append(np.abs((force(table) - force(patch)) / (mu * N * np.array([1, 1, c]))).max())
            patch.close()
        table.close()
        print(f"    a/b = {a / b:.2f}: differences over mu N: mean {np.mean(errors):.1e}, largest {max(errors):.1e}")
        assert np.mean(errors) < most_in_mean and max(errors) < most


def test_table_at_its_limits():
    table = Instance(fmu).start(**by_table)
    assert (force(table) == 0).all() and table.get("sticking_elements") == 0
    # full sliding, by rolling and at standstill; no load, no force
    for speed in (V, 0.0):
        set_inputs(table, (0.3 * 1e3, 0.4 * 1e3, 0.0, speed, N))
        assert table.step(0.0, 1e-3) == ok
        assert np.abs(force(table) / (mu * N) - [-0.6, -0.8, 0]).max() < 1e-4, force(table)
    set_inputs(table, (1e-3, 1e-3, 1.0, V, 0.0))
    assert table.step(0.0, 1e-3) == ok and (force(table) == 0).all() and table.get("contact_half_length") == 0
    # small creepages: forces proportional to them
    small = []
    for factor in (1e-4, 2e-4):
        set_inputs(table, (factor * limit * V, 0.0, factor * limit / a * V, V, N))
        assert table.step(0.0, 1e-3) == ok
        small.append(force(table))
    assert np.abs(small[1] / small[0] - 2).max() < 1e-3, small
    table.close()


def test_table_does_not_know_the_past():
    # the forces belong to the inputs at the end of the step, and the work is the mean power over the step
    values, other = (0.02, -0.03, 1.0, V, N), (-0.01, 0.02, 0.5, 1.1 * V, 1.2 * N)
    here, there = Instance(fmu).start(**by_table), Instance(fmu).start(**by_table)
    first = Instance(fmu).start(**by_table, **dict(zip(inputs, values)))
    duration = 1e-3
    set_inputs(here, other)
    set_inputs(there, values)
    assert here.step(0.0, duration) == there.step(0.0, duration) == ok
    powers = [-np.dot(force(here), other[:3]), -np.dot(force(there), values[:3])]
    close_to(here.get("slip_work"), powers[0] * duration, 1e-12, "work")
    set_inputs(here, values)
    for name, value, end in zip(inputs, values, other):
        there.rate(name, (end - value) / duration)
    assert here.step(duration, duration) == there.step(duration, duration) == ok
    assert np.abs(force(here) - force(first)).max() < 1e-9
    again = Instance(fmu).start(**by_table, **dict(zip(inputs, other)))
    assert np.abs(force(there) - force(again)).max() < 1e-6
    close_to(there.get("slip_work"), (powers[1] + (powers[0] + powers[1]) / 2) * duration, 1e-9, "work by rates")
    for instance in (here, there, first, again):
        instance.close()


def test_derivatives_by_table_without_load():
    # The first load slides: mu times the direction of the slip, no moment. Spin alone, where the share of the contact
    # that slides is the same under any load, gives the lateral force over any load. Nothing by other inputs.
    instance = Instance(fmu).start(**by_table, spin_rate=2.0)
    by_spin = instance.get("lateral_force") / (mu * N)
    assert abs(by_spin) > 0.1
    instance.close()
    for values, expected in (((0.3, -0.4, 2.0, V), (-0.6, 0.8, 0)), ((3e-9, 4e-9, 0.0, 0.0), (-0.6, -0.8, 0)),
                             ((0.0, 0.0, 2.0, V), (0, by_spin, 0)), ((0.0, 0.0, 0.0, V), (0, 0, 0))):
        instance = Instance(fmu).start(**by_table)
        for load in (0.0, 5e-324, 1e-310, 1e-290, 1e-9):
            set_inputs(instance, (*values, load))
            assert instance.step(0.0, 1e-3) == ok, instance.messages
            by_load = np.array([instance.derivative(name, "normal_load") for name in forces])
            assert np.abs(by_load - mu * np.array(expected)).max() < 1e-4, (load, by_load)  # error of the table
            by_others = [instance.derivative(name, known) for name in forces for known in inputs[:4]]
            assert np.isfinite(by_others).all() and (load > 1e-300 or not np.any(by_others))
            assert np.abs(force(instance)).max() <= mu * load * (1 + 1e-4)
            if load < 1e-300:
                assert (force(instance) == 0).all() and np.abs(by_load - mu * np.array(expected)).max() < 1e-15
        # what has none leaves the instance as it is
        for name in ("contact_half_length", "contact_half_width", "slip_work"):
            assert status_of(lambda: instance.derivative(name, "normal_load")) == discard
            assert f"there is no derivative of {name} by normal_load" in instance.messages[-1]
        set_inputs(instance, (*values, N))
        assert instance.step(0.0, 1e-3) == ok and instance.get("contact_half_length") > 0
        instance.close()


def test_loads_too_small_for_a_contact():
    for load in (5e-324, 1e-310, 1e-290):
        for parameters in (by_table, fixed):
            instance = Instance(fmu).start(**parameters, normal_load=load, lateral_slip_velocity=0.1)
            for i in range(3):
                assert instance.step(i * 1e-4, 1e-4) == ok, instance.messages
                assert np.abs(force(instance)).max() <= mu * load * (1 + 1e-4)
            instance.close()


def test_derivatives_before_the_first_step():
    # a table has the derivatives of the forces shown, as after a step, and none at rest; steady rolling refuses them
    values = dict(zip(inputs, (0.04, 0.03, 1.0, V, N)))
    instance = Instance(fmu).start(**by_table, **values)
    first = [instance.derivative(name, known) for name in forces for known in inputs]
    assert instance.step(0.0, 1e-3) == ok
    after = [instance.derivative(name, known) for name in forces for known in inputs]
    assert np.all(np.abs(np.array(first) - after) <= 1e-12 * np.abs(after)) and np.all(first)
    instance.close()
    instance = Instance(fmu).start(**values)
    assert not np.any(force(instance)) and not np.any([instance.derivative(forces[0], known) for known in inputs])
    instance.close()
    instance = Instance(fmu).start(**values, initial_state=2)
    assert status_of(lambda: instance.derivative(forces[0], inputs[0])) == discard
    assert f"there is no derivative of {forces[0]} by {inputs[0]} before the first step" in instance.messages[-1]
    assert instance.step(0.0, 1e-5) == ok and instance.derivative(forces[0], inputs[0]) < 0
    instance.close()


def test_poisson_ratio_beside_the_table():
    for value in (0.27, 0.29):
        instance = Instance(fmu).start(**by_table, poisson_ratio=value, lateral_slip_velocity=0.1)
        assert instance.step(0.0, 1e-3) == ok and force(instance)[1] < 0
        instance.close()


def test_semi_axes_beyond_the_table():
    # a step warns where a/b leaves the table, an output tells while it is beyond; forces stay at the border
    def axes(a_over_b):
        return {"given_half_length": 5e-3 * math.sqrt(a_over_b), "given_half_width": 5e-3 / math.sqrt(a_over_b)}

    def step(instance, k):  # FMPy hides warnings
        status = instance.calls.dll.fmi2DoStep(instance.calls.component, k * 1e-3, 1e-3, 0)
        return status, instance.get("off_table"), len(instance.messages)

    ok_status, warning = 0, 1
    values = dict(zip(inputs, (0.02, -0.03, 1.0, V, N)))
    border = Instance(fmu).start(**by_table, **values, **axes(10))
    instance = Instance(fmu).start(**by_table, **values, **axes(2))
    assert step(instance, 0) == (ok_status, 0, 0) and step(border, 0) == (ok_status, 0, 0)
    instance.set(**axes(25))
    assert step(instance, 1) == (warning, 1, 1)
    said = "a/b = 25 of the contact lies beyond the table, 0.1 to 10"
    assert instance.messages[0].startswith(said), instance.messages
    assert np.abs(force(instance) - force(border)).max() < 1e-9 * mu * N
    assert step(instance, 2) == (ok_status, 1, 1)  # it has been said
    instance.set(**axes(10))
    assert step(instance, 3) == (ok_status, 0, 1)
    instance.set(**axes(0.05))
    assert step(instance, 4) == (warning, 1, 2)
    instance.set(given_half_width=0.0)
    assert instance.step(5e-3, 1e-3) == discard and instance.get("off_table") == 1
    for one in (border, instance):
        one.close()
    begins = Instance(fmu).start(**by_table, **values, **axes(25))
    assert begins.get("off_table") == 1 and len(begins.messages) == 1 and step(begins, 0) == (ok_status, 1, 1)
    begins.close()


def test_table_of_another_file():
    # a path with spaces; the packed table is found in one as well
    with tempfile.TemporaryDirectory(prefix="a table ") as folder:
        copy = os.path.join(folder, "of forces.bin")
        shutil.copy(os.path.join(fmu.folder, "resources", "steel.creep"), copy)
        values = dict(zip(inputs, (0.02, -0.03, 1.0, V, N)))
        here = Instance(fmu).start(**by_table, **values)
        there = Instance(fmu).start(**by_table, **values, table_file=copy)
        assert outcome(here) == outcome(there) and there.get("table_file") == copy
        state = there.calls.getFMUstate()
        other = Instance(fmu)
        restored = other.calls.deSerializeFMUstate(there.calls.serializeFMUstate(state))
        other.calls.setFMUstate(restored)
        for one in (there, other):
            one.set(spin_rate=2.0)
            assert one.step(0.0, 1e-3) == ok
        assert outcome(there) == outcome(other) != outcome(here) and other.get("table_file") == copy
        there.calls.freeFMUstate(state)
        other.calls.freeFMUstate(restored)
        for one in (here, there, other):
            one.close()
        moved = Fmu(file, os.path.join(folder, "spaced % folder"))
        instance = Instance(moved).start(**by_table, **values)
        instance.close()
        with open(copy, "r+b") as damaged:
            damaged.seek(1000)
            damaged.write(b"x")
        for name, message in ((copy, "checksum"), (file, "must begin with"), (folder + "/none", "can be read")):
            instance = Instance(fmu)
            instance.set(**by_table, table_file=name)
            instance.calls.enterInitializationMode()
            assert status_of(instance.calls.exitInitializationMode) == error
            said = instance.messages[-1]
            assert f"table_file = {name}" in said and message in said, instance.messages
            instance.close()


run(globals(), fmu)
