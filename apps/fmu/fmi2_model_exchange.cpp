// The functions of FMI 2.0 for model exchange. There are no events: only inputs can jump.
#include <cmath>
#include <stdexcept>

#include <fmi2Functions.h>

#include "instance.hpp"

namespace {

using fmu::call;
using fmu::Causality;
using fmu::Instance;

/// Calls action(variable, place) for each variable of a causality. Throws std::invalid_argument unless there are
/// `count` of them.
template <class Action>
void for_each(const Instance& instance, Causality causality, std::size_t count, const Action& action) {
    std::size_t found = 0;
    for (const fmu::Variable& variable : instance.variables()) {
        if (variable.causality != causality) continue;
        if (found < count) action(variable, found);
        ++found;
    }
    if (found != count) throw std::invalid_argument("the number of continuous states is " + std::to_string(found));
}

constexpr unsigned in_time = fmu::event | fmu::continuous_time;
constexpr unsigned can_evaluate = fmu::initialization | in_time | fmu::terminated;

}  // namespace

extern "C" {

fmi2Status fmi2EnterEventMode(fmi2Component component) {
    return call(component, __func__, fmu::continuous_time, [](Instance& instance) { instance.mode = fmu::event; });
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo* info) {
    return call(component, __func__, fmu::event, [&](Instance&) { *info = {}; });
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component) {
    return call(component, __func__, fmu::event, [](Instance& instance) { instance.mode = fmu::continuous_time; });
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean /*no_state_before_this_point*/,
                                       fmi2Boolean* enter_event_mode, fmi2Boolean* terminate) {
    return call(component, __func__, fmu::continuous_time, [&](Instance&) {
        *enter_event_mode = fmi2False;
        *terminate = fmi2False;
    });
}

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time) {
    return call(component, __func__, in_time, [&](Instance& instance) {
        if (!std::isfinite(time)) throw std::invalid_argument("time must be finite");
        instance.time = time;  // nothing depends on it
    });
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real states[], std::size_t count) {
    return call(component, __func__, in_time, [&](Instance& instance) {
        for_each(instance, Causality::state, count,
                 [&](const fmu::Variable& variable, std::size_t i) { variable.real() = states[i]; });
        instance.stale = true;
    });
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real states[], std::size_t count) {
    return call(component, __func__, can_evaluate, [&](Instance& instance) {
        instance.build();
        for_each(instance, Causality::state, count,
                 [&](const fmu::Variable& variable, std::size_t i) { states[i] = variable.real(); });
    });
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real nominals[], std::size_t count) {
    return call(component, __func__, fmu::instantiated | can_evaluate, [&](Instance& instance) {
        for_each(instance, Causality::state, count,
                 [&](const fmu::Variable& variable, std::size_t i) { nominals[i] = variable.nominal; });
    });
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], std::size_t count) {
    return call(component, __func__, can_evaluate, [&](Instance& instance) {
        const fmi2Status status = instance.refresh();
        if (status != fmi2OK) return status;
        for_each(instance, Causality::derivative, count,
                 [&](const fmu::Variable& variable, std::size_t i) { derivatives[i] = variable.real(); });
        return fmi2OK;
    });
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real[], std::size_t count) {
    return call(component, __func__, can_evaluate, [&](Instance&) {
        if (count != 0) throw std::invalid_argument("there are no event indicators");
    });
}

}  // extern "C"
