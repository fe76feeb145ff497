"""rollbem_adhesion.fmu: test_adhesion.py FMU REFERENCE, the program that prints the exact step response."""
import math
import subprocess
import sys

import numpy as np
from fmpy import simulate_fmu
from fmpy.sundials import CVodeSolver

from support import Fmu, Instance, close_to, discard, error, ok, run, status_of

file, reference = sys.argv[1:3]
fmu = Fmu(file)

# b/a = 100, nu = 0.25, as in the reference results
a, b, G, nu, V = 5e-3, 0.5, 8e10, 0.25, 20.0
scene = {"half_length": a, "half_width": b, "shear_modulus": G, "poisson_ratio": nu}
force_unit = 2 * b * a * G  # [N]; a force is c11 times this times the creepage
creepage = 1e-4


def exact_step(distances):
    """-F/(a G xi) at q/a after a step of creepage."""
    lines = subprocess.run([reference, str(nu), str(b / a), *map(repr, distances)], capture_output=True, text=True,
                           check=True).stdout.split()
    return [float(line) for line in lines]


def bessel(n, z):
    """J_n(z) by its integral, for which the trapezoidal rule converges faster than any power."""
    angle = 2 * math.pi * np.arange(64) / 64
    return float(np.mean(np.cos(n * angle - z * np.sin(angle))))


def exact_c11(z):
    """c11 under a creepage e^{i z q/a}."""
    compliance = math.log(4 * b / a) + nu / (1 - nu)
    J = bessel(0, z) + 1j * bessel(1, z)
    return math.pi / (2 * (1 - nu)) * J / (bessel(0, z) + 1j * z * compliance * J)


def history(times, slip):
    """Slip velocities at speed V as FMPy's input."""
    inputs = {"time": times, "slip_velocity": slip, "rolling_speed": V, "normal_load": 1e5, "normal_load_rate": 0}
    columns = [np.broadcast_to(np.asarray(values, float), len(times)) for values in inputs.values()]
    return np.rec.fromarrays(columns, names=",".join(inputs))


def amplitude(q_over_a, response, z):
    """c11 from the last rows of the response to sin(z q/a), by least squares."""
    waves = np.column_stack([np.sin(z * q_over_a), np.cos(z * q_over_a)])
    (in_phase, quadrature), *_ = np.linalg.lstsq(waves, response, rcond=None)
    return complex(in_phase, quadrature)


def test_step_response():
    distances = [0.5, 1, 2, 3, 5, 10, 20]
    exchange = {"solver": "CVode", "relative_tolerance": 1e-10}
    for kind, arguments in (("ModelExchange", exchange), ("CoSimulation", {})):
        result = simulate_fmu(file, fmi_type=kind, stop_time=20 * a / V, output_interval=0.05 * a / V,
                              start_values=scene, input=history([0, 1], [creepage * V] * 2), output=["force"],
                              **arguments)
        for q, exact in zip(distances, exact_step(distances)):
            row = result[round(q / 0.05)]
            close_to(row["time"] * V / a, q, 1e-12, "q/a")
            close_to(-row["force"] / force_unit / creepage, exact, 1e-4 if q < 3 else 1e-6, f"{kind}, q/a = {q}")


def by_model_exchange(distances, set_inputs, **parameters):
    """Forces at q/a by FMPy's CVode, with the inputs of every instant at which it evaluates the model, set by
    set_inputs(instance, q/a); simulate_fmu would hold them between communication points."""
    instance = Instance(fmu, True).start(**scene, rolling_speed=V, **parameters)
    calls = instance.calls
    calls.enterContinuousTimeMode()
    solver = CVodeSolver(nx=fmu.states, nz=0, get_x=calls.getContinuousStates, set_x=calls.setContinuousStates,
                         get_dx=calls.getDerivatives, get_z=calls.getEventIndicators,
                         get_nominals=calls.getNominalsOfContinuousStates,
                         set_time=lambda t: set_inputs(instance, t * V / a),
                         startTime=0.0, maxStep=a / V, relativeTolerance=1e-10, input=None)
    forces, time = [], 0.0
    for q in distances:
        _, _, time = solver.step(time, q * a / V)
        set_inputs(instance, time * V / a)
        forces.append(instance.get("force"))
    instance.close()
    return np.array(forces)


def sine_by_model_exchange(z, distances):
    return by_model_exchange(distances, lambda instance, q: instance.set(slip_velocity=creepage * V * math.sin(z * q)))


def sine_by_co_simulation(z, distances):
    """Forces at q/a, evenly spaced from 0, with the slip velocity at the middle of each step held constant."""
    instance = Instance(fmu).start(**scene, rolling_speed=V)
    forces = []
    for q, following in zip(np.append(0, distances), distances):
        instance.set(slip_velocity=creepage * V * math.sin(z * (q + following) / 2))
        assert instance.step(q * a / V, (following - q) * a / V) == ok
        forces.append(instance.get("force"))
    instance.close()
    return np.array(forces)


def test_sine():
    for z in (0.1, 0.5, 1.0):
        period, settled = 2 * math.pi / z, 100  # in a; by then the slowest mode has decayed to 3e-8
        for method, spacing in ((sine_by_model_exchange, 0.05), (sine_by_co_simulation, 1e-3)):
            spacing /= z
            q = spacing * np.arange(1, math.ceil((settled + period) / spacing))
            forces = method(z, q)
            late = q > settled
            c11 = amplitude(q[late], -forces[late] / force_unit / creepage, z)
            distance = abs(c11 - exact_c11(z)) / abs(exact_c11(z))
            print(f"    {method.__name__}, omega a/V = {z}: {c11:.9f}, exact {exact_c11(z):.9f}, error {distance:.1e}")
            assert distance < 1e-6


def test_steps_of_any_length():
    # exact for constant inputs, so the steps are arbitrary
    instance = Instance(fmu).start(**scene, rolling_speed=V, slip_velocity=creepage * V)
    forces, time = {}, 0.0
    for length in (0.3, 0.3, 0.6, 1.2, 0.1, 0.5):
        assert instance.step(time * a / V, length * a / V) == ok
        time += length
        forces[round(time, 1)] = instance.get("force")
    instance.close()
    for q in (0.6, 1.2, 2.4, 3.0):
        at_once = Instance(fmu).start(**scene, rolling_speed=V, slip_velocity=creepage * V)
        assert at_once.step(0.0, q * a / V) == ok
        close_to(forces[q], at_once.get("force"), 1e-12, f"q/a = {q}")
        at_once.close()


def test_shift_without_rolling():
    shift = 2e-6
    instance = Instance(fmu).start(**scene, rolling_speed=0.0, slip_velocity=shift / 0.3)
    for i in range(3):
        assert instance.step(0.1 * i, 0.1) == ok
    rigid = 2 * ((1 - nu) * math.log(4 * b / a) + nu)  # displacement over a, per T_0 coefficient of the traction over G
    close_to(instance.get("force"), -2 * b * G * math.pi * shift / rigid, 1e-13, "force of a rigid shift")
    instance.close()


def test_beginning_in_steady_rolling():
    for exchange in (False, True):
        instance = Instance(fmu, exchange).start(**scene, rolling_speed=V, slip_velocity=creepage * V, initial_state=2)
        exact = -math.pi / (2 * (1 - nu)) * force_unit * creepage
        close_to(instance.get("force"), exact, 1e-13, "force")
        if exchange:
            assert max(map(abs, instance.rates())) < 1e-12 * V
        else:
            assert status_of(lambda: instance.derivative("force", "slip_velocity")) == discard  # no step led here
            close_to(instance.roll(0.3 * a / V, 10)[-1], exact, 1e-12, "force after 3 a")
        instance.close()


def test_half_length_of_a_load():
    load, radius, width = 8e4, 0.45, 0.04
    instance = Instance(fmu).start(half_length_from=2, nominal_load=load, combined_radius=radius, half_width=width,
                                   shear_modulus=G, poisson_ratio=nu)
    close_to(instance.get("contact_half_length"),
             math.sqrt(4 / math.pi * load / (2 * width) * radius * (1 - nu) / G), 1e-14, "half-length")
    instance.close()


def test_directions_and_kernels():
    for direction, c1, c2 in ((1, 1 - nu, nu), (2, 1.0, -nu)):
        for kernel, narrowness in ((1, 0.0), (2, (0.5 - c2 / c1) * (a / b) ** 2)):
            instance = Instance(fmu).start(**scene, direction=direction, kernel=kernel, rolling_speed=V,
                                           slip_velocity=creepage * V, initial_state=2)
            exact = -math.pi / 2 / c1 * force_unit * creepage * (1 + narrowness)
            close_to(instance.get("force"), exact, 1e-7, f"direction {direction}, kernel {kernel}")
            instance.close()


def test_derivatives_of_model_exchange():
    names = [f"displacement[{k}]" for k in range(fmu.states)]
    for length, first in ((1, {}), (2, {"normal_load": 1.7e5, "normal_load_rate": 2e8})):
        base = {"slip_velocity": creepage * V, "rolling_speed": V, "normal_load": 1e5, "normal_load_rate": 0.0, **first}
        instance = Instance(fmu, True).start(**scene, contact_length=length, **base)
        states = list(1e-6 * np.sin(1.0 + np.arange(fmu.states)))
        instance.set_states(states)
        unknowns = [f"der({name})" for name in names] + ["force", "contact_half_length"]
        scales = np.array([1e-3] * fmu.states + [1e3, 1e-3])
        largest = 0
        for known in names + list(base):
            def move(change):
                if known in names:
                    moved = list(states)
                    moved[names.index(known)] += change
                    instance.set_states(moved)
                else:
                    instance.set(**{known: base[known] + change})
                return np.array(instance.rates() + [instance.get(name) for name in unknowns[-2:]])

            # linear in each input except the load
            change = 1e-6 if known in names else {"slip_velocity": 1e-3, "rolling_speed": 1.0, "normal_load": 20.0,
                                                  "normal_load_rate": 1e6}[known]
            difference = (move(change) - move(-change)) / 2
            move(0)
            exact = change * np.array([instance.derivative(unknown, known) for unknown in unknowns])
            scale = max(np.abs(difference / scales).max(), 1e-9)
            largest = max(largest, np.abs((exact - difference) / scales).max() / scale)
        print(f"    contact_length {length}: largest difference {largest:.1e}")
        assert largest < 1e-7
        instance.close()


def load_at(q):
    """A load that varies by 50 % with a period of 8 half-lengths, and its derivative by q/a."""
    return 1e5 * (1 + 0.5 * math.sin(2 * math.pi * q / 8)), 1e5 * 0.5 * 2 * math.pi / 8 * math.cos(2 * math.pi * q / 8)


def test_load_that_varies():
    # model exchange and the library's steps in co-simulation have different equations and integrators
    def set_load(instance, q):
        load, by_distance = load_at(q)
        instance.set(normal_load=load, normal_load_rate=by_distance * V / a)

    exact = by_model_exchange(np.arange(1, 17) / 2, set_load, contact_length=2, slip_velocity=creepage * V)
    errors = []
    for steps in (20, 40, 80):  # per half of the half-length
        instance = Instance(fmu).start(**scene, contact_length=2, rolling_speed=V, slip_velocity=creepage * V)
        duration, forces = 0.5 * a / V / steps, []
        for i in range(16 * steps):
            instance.set(normal_load=load_at((i + 1) * 0.5 / steps)[0])
            assert instance.step(i * duration, duration) == ok, instance.messages
            if (i + 1) % steps == 0:
                forces.append(instance.get("force"))
        errors.append(np.abs(np.array(forces) / exact - 1).max())
        instance.close()
    fixed = Instance(fmu).start(**scene, rolling_speed=V, slip_velocity=creepage * V)
    effect = np.abs(np.array(fixed.roll(0.5 * a / V, 16)) / exact - 1).max()
    fixed.close()
    print(f"    errors {errors}; a fixed length differs by {effect:.1e}")
    assert errors[0] < 1e-3 and errors[2] < errors[1] / 3.4 < errors[0] / 11 and effect > 0.05


def test_model_exchange_state_is_saved():
    instance = Instance(fmu, True).start(**scene, rolling_speed=V, slip_velocity=creepage * V)
    states = [1e-6 * (k + 1) for k in range(fmu.states)]
    instance.set_states(states)
    rates = instance.rates()
    state = instance.calls.getFMUstate()
    instance.set_states([0.0] * fmu.states)
    instance.set(slip_velocity=0.0)
    assert instance.rates() != rates
    instance.calls.setFMUstate(state)
    assert instance.states() == states and instance.rates() == rates
    instance.calls.freeFMUstate(state)
    instance.close()


def test_what_model_exchange_refuses():
    for values, status in (({"rolling_speed": -1.0}, "invalid_step"), ({"normal_load": 0.0}, "invalid_load"),
                           ({"normal_load_rate": 1e10}, "needs_fixed_mesh"),
                           ({"normal_load_rate": -1e10}, "needs_fixed_mesh"), ({"normal_load": 1e12}, "invalid_load")):
        instance = Instance(fmu, True).start(**scene, contact_length=2, rolling_speed=V)
        instance.rates()
        instance.set(**values)
        assert status_of(instance.rates) == discard
        assert f"status = {status}" in instance.messages[-1], instance.messages
        instance.set(rolling_speed=V, normal_load=1e5, normal_load_rate=0.0)
        instance.rates()
        assert status_of(lambda: (instance.set_states([math.nan] * fmu.states), instance.rates())) == error
        instance.close()


run(globals(), fmu)
