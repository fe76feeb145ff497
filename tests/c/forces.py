"""forces.py LIBRARY TABLE [A]: creep forces by ctypes; prints the forces of a contact of half-length A, a patch, and the
forces of a wheel by the contact table beside TABLE."""
import ctypes
import os
import sys

rollbem = ctypes.CDLL(sys.argv[1])
rollbem.rollbem_table_open.restype = ctypes.c_void_p
rollbem.rollbem_last_error.restype = ctypes.c_char_p
table = ctypes.c_void_p(rollbem.rollbem_table_open(sys.argv[2].encode()))
if not table:
    sys.exit(rollbem.rollbem_last_error().decode())
# a, b, G, nu, mu, N, creepages
a = float(sys.argv[3]) if len(sys.argv) > 3 else 6e-3
contact = (ctypes.c_double * 9)(a, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 1e-3, 5e-4, 0.1)
forces = (ctypes.c_double * 3)()
ok, off_table = 0, 3  # ROLLBEM_OK, ROLLBEM_OFF_TABLE
code = rollbem.rollbem_table_forces(table, ctypes.c_size_t(1), contact, forces, None)
if code != ok:
    print(rollbem.rollbem_last_error().decode(), file=sys.stderr)
if code not in (ok, off_table):
    sys.exit(1)
print(*forces)


class WheelOptions(ctypes.Structure):
    """rollbem_wheel_options"""
    _fields_ = ([("size", ctypes.c_size_t)]
                + [(name, ctypes.c_int) for name in "wheel_mirror rail_mirror any_shape by_origin interaction".split()]
                + [(name, ctypes.c_double) for name in
                   "per_metre smooth cant gauge gauge_depth flange_back tape_offset radius".split()]
                + [("rail_origin", ctypes.c_double * 2)]
                + [(name, ctypes.c_double) for name in "roller_radius shear_modulus poisson_ratio".split()])


options = WheelOptions()
if rollbem.rollbem_wheel_defaults(ctypes.byref(options), ctypes.c_size_t(ctypes.sizeof(options))) != ok:
    sys.exit(rollbem.rollbem_last_error().decode())
rollbem.rollbem_wheel_open.restype = ctypes.c_void_p
wheel = ctypes.c_void_p(rollbem.rollbem_wheel_open(b"s1002", b"60e1", ctypes.byref(options)))
if not wheel:
    sys.exit(rollbem.rollbem_last_error().decode())
position = (ctypes.c_double * 6)(1e-3, 0, 0, 0, 0, 0)  # lateral, height, roll, yaw, x along the track, pitch
patch = (ctypes.c_double * 12)()
count = ctypes.c_size_t()
if rollbem.rollbem_wheel_solve_for_load(wheel, position, ctypes.c_double(1e5), ctypes.c_size_t(1), patch,
                                        ctypes.byref(count)) != ok:
    sys.exit(rollbem.rollbem_last_error().decode())
print("wheel", *patch)
rollbem.rollbem_wheel_free(wheel)

rollbem.rollbem_contact_table_open.restype = ctypes.c_void_p
rails = os.path.join(os.path.dirname(sys.argv[2]), "s1002_60e1.contact")
contacts = ctypes.c_void_p(rollbem.rollbem_contact_table_open(rails.encode()))
if not contacts:
    sys.exit(rollbem.rollbem_last_error().decode())
loads = (ctypes.c_double * 2)(8e4, 9e4)
height, roll = (ctypes.c_double * 5)(), (ctypes.c_double * 5)()
if rollbem.rollbem_contact_table_on_rails(contacts, ctypes.c_double(2e-3), ctypes.c_double(1e-3), loads, height,
                                          roll) != ok:
    sys.exit(rollbem.rollbem_last_error().decode())
# shift, yaw, forward speed, pitch rate, lateral and vertical speed, roll rate, yaw rate, load, mu, roll
inputs = (ctypes.c_double * 11)(2e-3, 1e-3, 20, -43.5, 0.01, 0, 0, 0.02, 8e4, 0.3, roll[0])
wrench = (ctypes.c_double * 6)()
right = 1  # ROLLBEM_RIGHT
if rollbem.rollbem_contact_table_look_up(contacts, table, right, inputs, wrench, None, None, None) != ok:
    sys.exit(rollbem.rollbem_last_error().decode())
print("rolls", *wrench, height[0])
rollbem.rollbem_contact_table_close(contacts)
rollbem.rollbem_table_close(table)
