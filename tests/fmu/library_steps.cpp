// Steps of the library, timed by cost.c.
#include "library_steps.h"

#include "library.hpp"

double library_adhesion(double duration, int count) {
    static library::Adhesion contact(duration * 20);
    double force = 0;
    for (int i = 0; i < count; ++i) force = contact.step(duration * 1e-3);
    return force;
}

double library_friction(double duration, int count) {
    static auto contact = library::line(false);
    double force = 0;
    for (int i = 0; i < count; ++i) force = contact.step(duration, 1e-3, 0, 0, 20, 1e5).force.longitudinal;
    return force;
}

double library_patch(double duration, int count) {
    static auto contact = library::patch(false);
    double force = 0;
    for (int i = 0; i < count; ++i) force = contact.step(duration, 1e-3, 0, 0, 20, 1e5).force.longitudinal;
    return force;
}
