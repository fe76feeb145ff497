// The functions of FMI 2.0 for co-simulation.
#include <cmath>
#include <stdexcept>

#include <fmi2Functions.h>

#include "instance.hpp"

namespace {

using fmu::call;
using fmu::Instance;

constexpr unsigned can_tell = fmu::stepping | fmu::terminated | fmu::failed;

/// What is asked about steps that run in the background, of which there are none.
fmi2Status nothing_to_tell(fmi2Component component, const char* function) {
    return call(component, function, can_tell, [](Instance&) { return fmi2Discard; });
}

}  // namespace

extern "C" {

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference references[],
                                       std::size_t count, const fmi2Integer orders[], const fmi2Real values[]) {
    return call(component, __func__, fmu::instantiated | fmu::initialization | fmu::stepping, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            const fmu::Variable& variable = instance.variable<double>(references[i]);
            if (variable.rate == nullptr) throw std::invalid_argument(variable.name + " is no input");
            if (orders[i] != 1) throw std::invalid_argument("inputs have first derivatives only");
            *variable.rate = values[i];
        }
        return fmi2OK;
    });
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[], std::size_t,
                                        const fmi2Integer[], fmi2Real[]) {
    return call(component, __func__, fmu::any,
                [](Instance&) -> fmi2Status { throw std::invalid_argument("outputs have no derivatives by time"); });
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real duration, fmi2Boolean /*no_state_before*/) {
    return call(component, __func__, fmu::stepping, [&](Instance& instance) {
        if (!std::isfinite(time) || !std::isfinite(duration) || duration <= 0) {
            throw std::invalid_argument("the step must be positive and finite");
        }
        return instance.step(time, duration);
    });
}

fmi2Status fmi2CancelStep(fmi2Component component) {
    return call(component, __func__, fmu::any,
                [](Instance&) -> fmi2Status { throw std::invalid_argument("no step goes on in the background"); });
}

fmi2Status fmi2GetRealStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Real* value) {
    return call(component, __func__, can_tell, [&](Instance& instance) {
        if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
        *value = instance.time;
        return fmi2OK;
    });
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, const fmi2StatusKind kind, fmi2Boolean* value) {
    return call(component, __func__, can_tell, [&](Instance& instance) {
        if (kind != fmi2Terminated) return fmi2Discard;
        // after a refused step, as some importing programs would otherwise repeat it for ever
        *value = instance.refused ? fmi2True : fmi2False;
        return fmi2OK;
    });
}

fmi2Status fmi2GetStatus(fmi2Component component, const fmi2StatusKind, fmi2Status*) {
    return nothing_to_tell(component, __func__);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind, fmi2Integer*) {
    return nothing_to_tell(component, __func__);
}

fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind, fmi2String*) {
    return nothing_to_tell(component, __func__);
}

}  // extern "C"
