"""forces.py LIBRARY TABLE [A]: creep forces by ctypes; prints the forces of a contact of half-length A."""
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
