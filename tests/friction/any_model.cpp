#include "friction/any_model.hpp"

namespace any_model {

FrictionModel make(const Setup& setup, bool steady) {
    const Friction::Law chosen = setup.any     ? Friction::Law(*setup.any)
                                 : setup.falls ? Friction::Law(setup.falling)
                                               : Friction::Law(setup.constant);
    const Friction friction{chosen, setup.pressure(), {setup.distance, setup.least}, setup.with_tangents};
    const Contact contact = setup.contact();
    if (setup.directions == 2) {
        const ElementSystem both(setup.system(false, steady), setup.system(true, steady));
        return {contact, both, setup.checks, friction, setup.integrator};
    }
    const auto along = setup.system(setup.across, steady);
    return {contact, along, setup.checks, friction, setup.integrator, setup.across ? 1 : 0};
}

}  // namespace any_model
