"""forces.py LIBRARY TABLE [A]: creep forces by ctypes; prints the forces of a contact of half-length A, and a patch."""
import ctypes
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
rollbem.rollbem_table_close(table)


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
