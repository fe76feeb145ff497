// The functions of FMI 2.0 for co-simulation.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmi2Functions.h>

#include "description.hpp"
#include "instance.hpp"

namespace {

using fmu::call;
using fmu::Instance;

using Bytes = std::vector<std::byte>;

/// Whether any of the variables has to be calculated before it is read.
template <class Value>
bool calculated(const Instance& instance, const fmi2ValueReference references[], std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        if (instance.variable<Value>(references[i]).causality == fmu::Causality::output) return true;
    }
    return false;
}

fmi2Status no_such_type(fmi2Component component, const char* function, std::size_t count) {
    return call(component, function, fmu::any, [&](Instance&) {
        if (count > 0) throw std::invalid_argument("there are no variables of this type");
    });
}

template <class Held, class Value>
fmi2Status set(fmi2Component component, const char* function, const fmi2ValueReference references[], std::size_t count,
               const Value values[]) {
    constexpr unsigned before_and_between_steps = fmu::instantiated | fmu::initialization | fmu::stepping;
    return call(component, function, before_and_between_steps, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (std::is_pointer_v<Value>) {
                if (values[i] == nullptr) throw std::invalid_argument("there is no text");
            }
            instance.settable<Held>(references[i]) = values[i];
        }
    });
}

constexpr unsigned can_tell = fmu::stepping | fmu::terminated | fmu::failed;

/// Answers a question about steps that run in the background: there are none.
fmi2Status nothing_to_tell(fmi2Component component, const char* function) {
    return call(component, function, can_tell, [](Instance&) { return fmi2Discard; });
}

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() { return fmi2TypesPlatform; }
const char* fmi2GetVersion() { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean /*visible*/,
                              fmi2Boolean /*logging_on*/) {
    if (functions == nullptr) return nullptr;
    const auto refuse = [&](const char* message) -> fmi2Component {
        if (functions->logger != nullptr) {
            functions->logger(functions->componentEnvironment, name == nullptr ? "" : name, fmi2Error, "logStatusError",
                              "%s", message);
        }
        return nullptr;
    };
    try {
        if (name == nullptr || *name == 0) return refuse("fmi2Instantiate: the instance needs a name");
        if (guid == nullptr || fmu::guid() != guid) {
            return refuse("fmi2Instantiate: modelDescription.xml and the library do not belong together (GUID)");
        }
        if (type != fmi2CoSimulation) return refuse("fmi2Instantiate: this FMU is for co-simulation only");
        return std::make_unique<Instance>(name, resources == nullptr ? "" : resources, *functions).release();
    } catch (...) {
        return refuse("fmi2Instantiate: out of memory");
    }
}

void fmi2FreeInstance(fmi2Component component) { delete static_cast<Instance*>(component); }

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, std::size_t count,
                               const fmi2String categories[]) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        // messages about errors are not debugging output: without categories they stay on
        instance.set_logging(on ? std::span(categories, count) : std::span<const fmi2String>());
    });
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean /*tolerance_defined*/, fmi2Real /*tolerance*/,
                               fmi2Real start, fmi2Boolean stop_defined, fmi2Real stop) {
    return call(component, __func__, fmu::instantiated, [&](Instance& instance) {
        if (!std::isfinite(start) || (stop_defined && !(stop > start))) {
            throw std::invalid_argument("the experiment must start at a finite time and stop later");
        }
        instance.time = start;
    });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
    return call(component, __func__, fmu::instantiated,
                [](Instance& instance) { instance.mode = fmu::initialization; });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
    return call(component, __func__, fmu::initialization, [](Instance& instance) {
        instance.build();
        instance.mode = fmu::stepping;
        return instance.warn();
    });
}

fmi2Status fmi2Terminate(fmi2Component component) {
    return call(component, __func__, fmu::stepping, [](Instance& instance) { instance.mode = fmu::terminated; });
}

fmi2Status fmi2Reset(fmi2Component component) {
    return call(component, __func__, fmu::any, [](Instance& instance) { instance.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                       fmi2Real values[]) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        if (calculated<double>(instance, references, count)) instance.refresh();
        for (std::size_t i = 0; i < count; ++i) values[i] = instance.variable<double>(references[i]).real();
    });
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                          fmi2Integer values[]) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        if (calculated<int>(instance, references, count)) instance.refresh();
        for (std::size_t i = 0; i < count; ++i) values[i] = instance.variable<int>(references[i]).integer();
    });
}

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference[], std::size_t count, fmi2Boolean[]) {
    return no_such_type(component, __func__, count);
}

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                         fmi2String values[]) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            values[i] = instance.variable<std::string>(references[i]).text().c_str();
        }
    });
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                       const fmi2Real values[]) {
    return set<double>(component, __func__, references, count, values);
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                          const fmi2Integer values[]) {
    return set<int>(component, __func__, references, count, values);
}

fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference[], std::size_t count, const fmi2Boolean[]) {
    return no_such_type(component, __func__, count);
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference references[], std::size_t count,
                         const fmi2String values[]) {
    return set<std::string>(component, __func__, references, count, values);
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        if (*state == nullptr) *state = new Bytes;
        instance.save(*static_cast<Bytes*>(*state));
    });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
    return call(component, __func__, fmu::any, [&](Instance& instance) {
        if (state == nullptr) throw std::invalid_argument("there is no state");
        instance.restore(*static_cast<Bytes*>(state));
    });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        if (state != nullptr) {
            delete static_cast<Bytes*>(*state);
            *state = nullptr;
        }
    });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        if (state == nullptr) throw std::invalid_argument("there is no state");
        *size = static_cast<Bytes*>(state)->size() + sizeof(std::uint64_t);
    });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte serialized[], std::size_t size) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        if (state == nullptr) throw std::invalid_argument("there is no state");
        const Bytes& bytes = *static_cast<Bytes*>(state);
        const std::uint64_t hash = fmu::hash_of(bytes);  // because the file that keeps them may get damaged
        if (size < bytes.size() + sizeof hash) throw std::invalid_argument("the serialised state needs more room");
        std::memcpy(serialized, bytes.data(), bytes.size());
        std::memcpy(serialized + bytes.size(), &hash, sizeof hash);
    });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte serialized[], std::size_t size,
                                   fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        std::uint64_t hash = 0;
        if (size < sizeof hash) throw std::invalid_argument("the serialised state is too short");
        const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(serialized), size - sizeof hash);
        std::memcpy(&hash, serialized + bytes.size(), sizeof hash);
        if (hash != fmu::hash_of(bytes)) throw std::invalid_argument("the serialised state is damaged");
        if (*state == nullptr) *state = new Bytes;
        static_cast<Bytes*>(*state)->assign(bytes.begin(), bytes.end());
    });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknowns[],
                                        std::size_t unknown_count, const fmi2ValueReference knowns[],
                                        std::size_t known_count, const fmi2Real seeds[], fmi2Real derivatives[]) {
    return call(component, __func__, fmu::stepping, [&](Instance& instance) {
        try {
            for (std::size_t i = 0; i < unknown_count; ++i) {
                double sum = 0;
                for (std::size_t j = 0; j < known_count; ++j) {
                    sum += instance.partial(unknowns[i], knowns[j]) * seeds[j];
                }
                derivatives[i] = sum;
            }
            return fmi2OK;
        } catch (const fmu::NoDerivative& none) {
            instance.log(fmi2Discard, std::string("fmi2GetDirectionalDerivative: ") + none.what());
            return fmi2Discard;
        }
    });
}

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
