"""forces.py LIBRARY TABLE: creep forces by ctypes; prints the forces of a contact."""
import ctypes
import sys

rollbem = ctypes.CDLL(sys.argv[1])
rollbem.rollbem_table_open.restype = ctypes.c_void_p
rollbem.rollbem_last_error.restype = ctypes.c_char_p
table = ctypes.c_void_p(rollbem.rollbem_table_open(sys.argv[2].encode()))
if not table:
    sys.exit(rollbem.rollbem_last_error().decode())
# a, b, G, nu, mu, N, creepages
contact = (ctypes.c_double * 9)(6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 1e-3, 5e-4, 0.1)
forces = (ctypes.c_double * 3)()
if rollbem.rollbem_table_forces(table, ctypes.c_size_t(1), contact, forces, None):
    sys.exit(rollbem.rollbem_last_error().decode())
print(*forces)
rollbem.rollbem_table_close(table)
