"""rollbem_friction.fmu: test_friction.py FMU REFERENCE, the program that takes the same steps with the library."""
import math
import sys

import numpy as np

from support import Fmu, Instance, close_to, discard, library_steps, ok, run, status_of

file, reference = sys.argv[1:3]
fmu = Fmu(file)

# start values of the FMU and of the program
a, b, G, nu, mu, V, N = 5e-3, 0.05, 8e10, 0.28, 0.3, 20.0, 1e5
follows_load, fixed = {"mesh_length": 1, "mesh": 1}, {"mesh_length": 2, "mesh": 2}
inputs = ("longitudinal_slip_velocity", "lateral_slip_velocity", "rolling_speed", "normal_load")
p0 = 2 * (N / (2 * b)) / (math.pi * a)
sliding = 2 * (1 - nu) * mu * p0 / G  # creepage of full sliding


def outcome(instance):
    return tuple(instance.get(name) for name in ("longitudinal_force", "lateral_force", "slip_work",
                                                 "sticking_elements"))


def set_inputs(instance, values):
    instance.set(**dict(zip(inputs, values)))


def make_run(lift_off):
    """Steps under a slip that turns from one direction to the other: durations and inputs."""
    rows = []
    for i in range(300):
        phase = 2 * math.pi * i / 150
        duration = 0.1 * a / V * (1 if i % 7 else 1.5)
        load = N * max(0, 1 + 1.2 * math.sin(phase)) if lift_off else N * (1 + 0.5 * math.sin(phase))
        rows.append((duration, 0.8 * sliding * V * math.cos(phase / 3), 0.6 * sliding * V * math.sin(phase / 2),
                     V * (1 + 0.1 * math.sin(phase)), min(load, 2e5)))
    if lift_off:
        rows[200:200] = [(1e-4, 1e-3, -1e-3, 0.0, N * (1 + 0.01 * i)) for i in range(10)]  # no rolling
    return rows


def by_library(mesh_length, rows):
    steps = library_steps(reference, "line", mesh_length, [(*row[:3], 0.0, *row[3:]) for row in rows])  # no spin
    return [(along, across, work, sticking) for along, across, _, work, sticking in steps]


def test_equals_the_library_over_rejected_steps():
    for name, parameters in (("follows", follows_load), ("fixed", fixed)):
        rows = make_run(name == "fixed")
        expected = by_library(name, rows)
        instance = Instance(fmu).start(**parameters)
        time, state, sticking = 0.0, None, set()
        for i, (row, exact) in enumerate(zip(rows, expected)):
            if i % 3 == 0:  # a step that is rejected, and another in its place
                state = instance.calls.getFMUstate()
                set_inputs(instance, (0.05, -0.02, 1.3 * V, row[4]))
                assert instance.step(time, 2 * row[0]) == ok
                instance.calls.setFMUstate(state)
                instance.calls.freeFMUstate(state)
            set_inputs(instance, row[1:])
            assert instance.step(time, row[0]) == ok, instance.messages
            assert outcome(instance) == exact, f"{name}, step {i}: {outcome(instance)} and {exact}"
            time += row[0]
            sticking.add(exact[3])
        print(f"    {name}: {len(rows)} steps, {len(sticking)} numbers of sticking elements")
        assert len(sticking) > 10
        instance.close()


def test_steady_rolling_under_both_creepages():
    # CONTACT's forces at delta = 0.5, 30 degrees, and at full sliding; 40 elements are accurate to 7e-4 of mu N
    for delta, angle, along, across in ((0.5, 30, 0.6575, 0.2868), (0.25, 45, 0.3128, 0.2296),
                                        (1.1, 45, 0.7645, 0.6371)):
        creepage = delta * sliding
        instance = Instance(fmu).start(
            initial_state=2, longitudinal_slip_velocity=creepage * V * math.cos(math.radians(angle)),
            lateral_slip_velocity=creepage * V * math.sin(math.radians(angle)), half_width=1.0, nominal_load=N * 20,
            normal_load=N * 20)
        forces = [-instance.get(name) / (mu * 20 * N) for name in ("longitudinal_force", "lateral_force")]
        print(f"    delta = {delta}, {angle} degrees: {forces[0]:.4f}, {forces[1]:.4f}, expected {along}, {across}")
        assert abs(forces[0] - along) < 7e-4 and abs(forces[1] - across) < 7e-4
        # steady rolling is a fixed point but for the angles by which slip turns, which are those of each step, and all
        # the work of the creepage becomes heat
        before = np.array(forces)
        for i in range(20):
            assert instance.step(i * 0.3 * a / V, 0.3 * a / V) == ok
        after = np.array([-instance.get(name) / (mu * 20 * N) for name in ("longitudinal_force", "lateral_force")])
        assert np.abs(after - before).max() < 1e-4
        direction = [math.cos(math.radians(angle)), math.sin(math.radians(angle))]
        work = mu * 20 * N * creepage * 20 * 0.3 * a * (after @ direction)
        close_to(instance.get("slip_work"), work, 1e-3 if delta >= 0.5 else 4e-3, "slip work")
        instance.close()


def test_half_length_follows_the_load():
    for parameters in (follows_load, fixed):
        instance = Instance(fmu).start(**parameters)
        close_to(instance.get("contact_half_length"), a, 1e-15, "under nominal_load")
        instance.set(normal_load=1.21 * N, rolling_speed=V)
        assert instance.step(0.0, 1.0 * a / V) == ok
        close_to(instance.get("contact_half_length"), 1.1 * a, 1e-15, "under 1.21 of it")
        instance.close()


def test_load_by_its_rate():
    # a load that grows linearly, given by its rate or step by step
    duration, growth = 0.2 * a / V, 0.02
    told = Instance(fmu).start(longitudinal_slip_velocity=0.5 * sliding * V)
    by_rate = Instance(fmu).start(longitudinal_slip_velocity=0.5 * sliding * V)
    for i in range(10):
        told.set(normal_load=N * (1 + growth * (i + 1)))
        by_rate.set(normal_load=N * (1 + growth * i))
        by_rate.rate("normal_load", N * growth / duration)
        assert told.step(i * duration, duration) == by_rate.step(i * duration, duration) == ok
    close_to(by_rate.get("longitudinal_force"), told.get("longitudinal_force"), 1e-12, "force")
    told.close()
    by_rate.close()


def test_lift_off_and_re_contact():
    instance = Instance(fmu).start(**fixed, longitudinal_slip_velocity=0.5 * sliding * V)
    duration = 0.1 * a / V
    assert instance.step(0.0, duration) == ok and instance.get("longitudinal_force") < 0
    instance.set(normal_load=0.0)
    assert instance.step(duration, duration) == ok
    assert outcome(instance)[:2] == (0, 0) and instance.get("contact_half_length") == 0
    instance.set(normal_load=N)
    for i in range(2, 200):
        assert instance.step(i * duration, duration) == ok
    # steady rolling again; the accuracy is that of the few loaded elements of the 40 that cover 1.41 a
    close_to(-instance.get("longitudinal_force") / (mu * N), 0.75, 2e-2, "force")
    instance.close()


def test_oblique_loading_without_rolling():
    # a tangential force k times the normal one from zero load, k < mu: everything sticks, and p = k p_n. Each increment
    # of the load adds a traction k/(pi sqrt(a^2 - x^2)), whose displacement is uniform; the shift is their integral.
    k = 0.2

    def shift(load):
        return k * load / (2 * b) * 2 / (math.pi * G) * ((1 - nu) * (math.log(4 * b / a * math.sqrt(N / load)) + 0.5) + nu)

    instance = Instance(fmu).start(**fixed, normal_load=0.0, rolling_speed=0.0)
    duration, before = 1e-3, 0.0
    for i in range(20):
        load = N * (i + 1) / 20
        instance.set(normal_load=load, longitudinal_slip_velocity=(shift(load) - before) / duration)
        before = shift(load)
        assert instance.step(i * duration, duration) == ok
    close_to(-instance.get("longitudinal_force") / N, k, 1e-2, "tangential over normal force")
    assert instance.get("slip_work") < 1e-2 * k * N * shift(N)
    instance.close()


def test_what_has_no_derivative():
    instance = Instance(fmu).start()
    assert status_of(lambda: instance.derivative("slip_work", "normal_load")) == discard
    assert instance.derivative("lateral_force", "normal_load") == 0  # at rest
    instance.close()
    instance = Instance(fmu).start(initial_state=2, lateral_slip_velocity=1e-3)
    assert status_of(lambda: instance.derivative("lateral_force", "normal_load")) == discard
    assert "before the first step" in instance.messages[-1]
    assert instance.step(0.0, 1e-5) == ok and instance.derivative("lateral_force", "normal_load") < 0
    instance.close()


try:
    run(globals())
finally:
    fmu.close()
