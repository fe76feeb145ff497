#include "friction/any_model.hpp"

namespace any_model {

FrictionContact make(const Setup& setup, bool steady) {
    const auto of = [&]<class Own>(const Own& own) -> FrictionContact {
        const Friction<Own> friction{own, setup.pressure(), {setup.distance, setup.least}, setup.with_tangents};
        const auto model = [&](const auto& systems) {
            return FrictionModel(setup.contact(), systems, setup.checks, friction, setup.integrator);
        };
        if (setup.directions == 1) return {model(setup.system(setup.across, steady)), setup.across ? 1 : 0};
        return model(ElementSystem(setup.system(false, steady), setup.system(true, steady)));
    };
    if (setup.any) return of(*setup.any);
    return setup.falls ? of(setup.falling) : of(ConstantFriction{setup.constant});
}

}  // namespace any_model
