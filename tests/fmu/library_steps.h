/* Look-ups of the library, timed by cost.c: `count` of them at 20 m/s with a slip velocity of 1 mm/s. Returns the force
   [N]. */
#ifdef __cplusplus
extern "C" {
#endif
double library_table(int count);
double library_wheelset(int count); /* of both wheels */
/* The folder of the tables. */
void library_resources(const char* folder);
#ifdef __cplusplus
}
#endif
