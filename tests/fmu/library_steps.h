/* Steps of the library, timed by cost.c: `count` of them at 20 m/s with a slip velocity of 1 mm/s. Returns the
   force [N]. */
#ifdef __cplusplus
extern "C" {
#endif
double library_adhesion(double duration, int count);
double library_friction(double duration, int count);
double library_patch(double duration, int count);
#ifdef __cplusplus
}
#endif
