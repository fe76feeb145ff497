"""rollbem_friction.fmu: test_friction.py FMU REFERENCE, the program that takes the same steps with the library."""
import math
import sys

import numpy as np
from fmpy.validation import validate_fmu

from support import Fmu, Instance, close_to, discard, error, library_steps, ok, run, status_of

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


def test_validation():
    assert validate_fmu(file) == []


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


def test_what_a_step_refuses():
    duration = 0.1 * a / V
    for parameters, values, status in (
            (follows_load, {"normal_load": 2 * N}, "needs_fixed_mesh"),
            (follows_load, {"rolling_speed": 0.0, "normal_load": 1.01 * N}, "needs_fixed_mesh"),
            (follows_load, {"normal_load": 0.0}, "invalid_load"),
            (fixed, {"normal_load": 2.1e5}, "invalid_load"),
            (fixed, {"normal_load": -1.0}, "invalid_load"),
            (fixed, {"rolling_speed": -1.0}, "invalid_step")):
        instance = Instance(fmu).start(**parameters, longitudinal_slip_velocity=0.5 * sliding * V)
        for i in range(5):
            assert instance.step(i * duration, duration) == ok
        before = outcome(instance)
        kept = {name: instance.get(name) for name in values}
        instance.set(**values)
        assert instance.step(5 * duration, duration) == discard, values
        assert status in instance.messages[-1] and "refused" in instance.messages[-1], instance.messages
        assert all(f"{name} = " in instance.messages[-1] for name in inputs)
        variable = next(v for v in fmu.description.modelVariables if v.name == "status")
        names = [item.name for item in variable.declaredType.items]
        assert names[instance.get("status")] == status
        assert instance.last_successful_time() == 5 * duration and instance.wants_to_stop()
        assert outcome(instance) == before
        # the next step is as if nothing had been asked
        instance.set(**kept)
        assert instance.step(5 * duration, duration) == ok
        other = Instance(fmu).start(**parameters, longitudinal_slip_velocity=0.5 * sliding * V)
        for i in range(6):
            assert other.step(i * duration, duration) == ok
        assert outcome(other) == outcome(instance)
        other.close()
        # an importing program that goes on all the same would lose the distance of a step
        instance.set(**values)
        assert instance.step(6 * duration, duration) == discard
        instance.set(**kept)
        assert instance.step(7 * duration, duration) == error
        # FMPy hands the messages of both instances to the one made last
        assert any("was refused" in message for message in instance.messages + other.messages)
        instance.close()


def test_what_is_not_a_number():
    for name in inputs:
        for value in (math.nan, math.inf):
            instance = Instance(fmu).start()
            before = outcome(instance)
            state = instance.calls.getFMUstate()
            instance.set(**{name: value})
            assert instance.step(0.0, 1e-5) == error
            assert "needs finite numbers" in instance.messages[-1]
            assert status_of(lambda: instance.set(**{name: 1.0})) == error  # until a state is restored or a reset
            instance.calls.setFMUstate(state)
            assert outcome(instance) == before and instance.step(0.0, 1e-5) == ok
            instance.calls.freeFMUstate(state)
            instance.close()


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


def test_derivatives():
    duration = 0.2 * a / V
    for parameters in (follows_load, fixed):
        base = {"longitudinal_slip_velocity": 0.4 * sliding * V, "lateral_slip_velocity": 0.3 * sliding * V,
                "rolling_speed": V, "normal_load": 1.03 * N}

        def after(changes, derivative=None):
            instance = Instance(fmu).start(**parameters, **{**base, "normal_load": N})
            for i in range(6):
                assert instance.step(i * duration, duration) == ok
            instance.set(**{**base, **changes})
            assert instance.step(6 * duration, duration) == ok, instance.messages
            result = ([instance.derivative(name, derivative) for name in ("longitudinal_force", "lateral_force")]
                      if derivative else outcome(instance)[:2])
            instance.close()
            return np.array(result)

        for known in inputs:
            change = 1e-6 * base[known]
            difference = (after({known: base[known] + change}) - after({known: base[known] - change})) / (2 * change)
            exact = after({}, known)
            distance = np.abs(exact - difference).max() / np.abs(difference).max()
            print(f"    by {known}: {exact}, differences {difference}, error {distance:.1e}")
            # by creepage and load it leaves out how the angles by which slip turns follow
            assert distance < (1e-5 if known == "rolling_speed" else 1e-2)
    instance = Instance(fmu).start()
    assert status_of(lambda: instance.derivative("slip_work", "normal_load")) == discard
    assert instance.derivative("lateral_force", "normal_load") == 0  # at rest
    instance.close()
    instance = Instance(fmu).start(initial_state=2, lateral_slip_velocity=1e-3)
    assert status_of(lambda: instance.derivative("lateral_force", "normal_load")) == discard
    assert "before the first step" in instance.messages[-1]
    assert instance.step(0.0, 1e-5) == ok and instance.derivative("lateral_force", "normal_load") < 0
    instance.close()


def test_saved_in_one_instance_and_restored_in_another():
    rows = make_run(False)
    for parameters in (follows_load, fixed):
        instance = Instance(fmu).start(**parameters, friction_coefficient=0.4)
        for row in rows[:40]:
            set_inputs(instance, row[1:])
            assert instance.step(0.0, row[0]) == ok
        state = instance.calls.getFMUstate()
        saved = instance.calls.serializeFMUstate(state)
        other = Instance(fmu)
        copy = other.calls.deSerializeFMUstate(saved)
        other.calls.setFMUstate(copy)
        assert outcome(other) == outcome(instance)
        for row in rows[40:80]:
            for one in (instance, other):
                set_inputs(one, row[1:])
                assert one.step(0.0, row[0]) == ok
            assert outcome(other) == outcome(instance)
        for one, which in ((instance, state), (other, copy)):
            one.calls.freeFMUstate(which)
            one.close()


def test_two_instances_at_once():
    rows = make_run(False)[:40]

    def roll(instances):
        forces = [[] for _ in instances]
        for row in rows:
            for list_of_them, instance in zip(forces, instances):
                set_inputs(instance, row[1:])
                assert instance.step(0.0, row[0]) == ok
                list_of_them.append(outcome(instance))
        for instance in instances:
            instance.close()
        return forces

    def make(mu_of_it):
        return Instance(fmu).start(friction_coefficient=mu_of_it)

    alone = [roll([make(value)])[0] for value in (0.2, 0.5)]
    assert alone[0] != alone[1] and roll([make(0.2), make(0.5)]) == alone


def test_wrong_parameters():
    for parameters, message in [
        ({"friction_coefficient": -0.1}, "friction_coefficient = -0.1 must be finite and not negative"),
        ({"poisson_ratio": 0.7}, "poisson_ratio = 0.7 must lie in [0, 0.5]"),
        ({"elements": 0}, "elements = 0 must lie in [1, 1000]"),
        ({"elements": 1001}, "elements = 1001 must lie in [1, 1000]"),
        ({"mesh": 3}, "mesh = 3 must lie in [1, 2]"),
        ({"mesh_length": 0}, "mesh_length = 0 must lie in [1, 2]"),
        ({"kernel": 2}, "mesh_length = 1 must be 2 (fixed) where kernel is strip"),
        ({"normal_load": 0.0}, "normal_load = 0 must be positive where mesh_length is follows_load"),
        ({**fixed, "normal_load": 3e5}, "normal_load = 300000 must be at most largest_load"),
        ({**fixed, "largest_load": math.nan}, "largest_load = nan must be positive and finite"),
        ({"nominal_load": 0.0}, "nominal_load = 0 must be positive and finite"),
        ({"initial_state": 2, "rolling_speed": 0.0}, "rolling_speed = 0 must be positive"),
        ({"half_width": 1e-4}, "Lambda"),
    ]:
        instance = Instance(fmu)
        instance.calls.setupExperiment()
        instance.set(**parameters)
        instance.calls.enterInitializationMode()
        assert status_of(instance.calls.exitInitializationMode) == error, parameters
        assert message in instance.messages[-1], instance.messages
        instance.close()


def test_co_simulation_alone():
    assert fmu.description.modelExchange is None
    assert not any(hasattr(Instance(fmu).calls.dll, name) for name in ("fmi2GetDerivatives", "fmi2SetTime"))


try:
    run(globals())
finally:
    fmu.close()
