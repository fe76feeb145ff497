/* Creep forces from C: forces TABLE [A] prints the forces of a contact of half-length A. */
#include <rollbem.h>
#include <stdio.h>
#include <stdlib.h>

static int fail(const char *why) {
    fprintf(stderr, "%s\n", why);
    return 1;
}

int main(int count, char **arguments) {
    rollbem_table *table = rollbem_table_open(count > 1 ? arguments[1] : NULL);
    if (table == NULL) return fail(rollbem_last_error());
    /* a, b, G, nu, mu, N, then longitudinal and lateral creepage and spin */
    double contact[9] = {6e-3, 4e-3, 8.2e10, 0.28, 0.3, 8e4, 1e-3, 5e-4, 0.1};
    double force[3], tangent[21];
    if (count > 2) contact[0] = atof(arguments[2]);
    int code = rollbem_table_forces(table, 1, contact, force, tangent);
    if (code == ROLLBEM_OFF_TABLE) fprintf(stderr, "warning: %s\n", rollbem_last_error());
    else if (code != ROLLBEM_OK) return fail(rollbem_last_error());
    printf("%.17g %.17g %.17g\n", force[0], force[1], force[2]);
    rollbem_table_close(table);
    return 0;
}
