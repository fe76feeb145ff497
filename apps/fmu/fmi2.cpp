// The functions of FMI 2.0 for co-simulation.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmi2Functions.h>

#include "description.hpp"
#include "instance.hpp"

namespace {

using fmu::call;
using fmu::Instance;

using References = const fmi2ValueReference*;
using Bytes = std::vector<std::byte>;

void require(bool holds, const char* message) {
    if (!holds) throw std::invalid_argument(message);
}

constexpr unsigned before_and_between_steps = fmu::instantiated | fmu::initialization | fmu::stepping,
                   can_tell = fmu::stepping | fmu::terminated | fmu::failed;

template <class Held, class Value>
fmi2Status get(fmi2Component component, const char* function, References references, std::size_t count,
               Value values[]) {
    return call(component, function, fmu::any, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            const Held& held = *std::get<Held*>(instance.variable<Held>(references[i]).value);
            if constexpr (std::is_pointer_v<Value>) {
                values[i] = held.c_str();
            } else {
                values[i] = held;
            }
        }
    });
}

template <class Held, class Value>
fmi2Status set(fmi2Component component, const char* function, References references, std::size_t count,
               const Value values[]) {
    return call(component, function, before_and_between_steps, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            if constexpr (std::is_pointer_v<Value>) require(values[i] != nullptr, "there is no text");
            instance.settable<Held>(references[i]) = static_cast<Held>(values[i]);
        }
    });
}

/// The answer of functions that always have the same one.
fmi2Status refuse(fmi2Component component, const char* function, const char* reason) {
    return call(component, function, fmu::any, [&](Instance&) { require(false, reason); });
}
fmi2Status nothing_in_background(fmi2Component component, const char* function) {
    return call(component, function, can_tell, [](Instance&) { return fmi2Discard; });
}

/// A saved state in the memory of the importing program, made if there is none.
Bytes& bytes_of(fmi2FMUstate state) {
    require(state != nullptr, "there is no state");
    return *static_cast<Bytes*>(state);
}
Bytes& made(fmi2FMUstate* state) {
    if (*state == nullptr) *state = new Bytes;
    return *static_cast<Bytes*>(*state);
}

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() { return fmi2TypesPlatform; }
const char* fmi2GetVersion() { return fmi2Version; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* functions, fmi2Boolean /*visible*/,
                              fmi2Boolean /*logging_on*/) {
    if (functions == nullptr) return nullptr;
    try {
        require(name != nullptr && *name != 0, "the instance needs a name");
        require(guid != nullptr && fmu::guid() == guid,
                "modelDescription.xml and the library do not belong together (GUID)");
        require(type == fmi2CoSimulation, "this FMU is for co-simulation only");
        return std::make_unique<Instance>(name, resources == nullptr ? "" : resources, *functions).release();
    } catch (const std::exception& error) {
        if (functions->logger != nullptr) {
            functions->logger(functions->componentEnvironment, name == nullptr ? "" : name, fmi2Error, "logStatusError",
                              "fmi2Instantiate: %s", error.what());
        }
        return nullptr;
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
        require(std::isfinite(start) && (!stop_defined || stop > start),
                "the experiment must start at a finite time and stop later");
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

fmi2Status fmi2GetReal(fmi2Component component, References references, std::size_t count, fmi2Real values[]) {
    return get<double>(component, __func__, references, count, values);
}

fmi2Status fmi2GetInteger(fmi2Component component, References references, std::size_t count, fmi2Integer values[]) {
    return get<int>(component, __func__, references, count, values);
}

fmi2Status fmi2GetBoolean(fmi2Component component, References references, std::size_t count, fmi2Boolean values[]) {
    return get<bool>(component, __func__, references, count, values);
}

fmi2Status fmi2GetString(fmi2Component component, References references, std::size_t count, fmi2String values[]) {
    return get<std::string>(component, __func__, references, count, values);
}

fmi2Status fmi2SetReal(fmi2Component component, References references, std::size_t count, const fmi2Real values[]) {
    return set<double>(component, __func__, references, count, values);
}

fmi2Status fmi2SetInteger(fmi2Component component, References references, std::size_t count,
                          const fmi2Integer values[]) {
    return set<int>(component, __func__, references, count, values);
}

fmi2Status fmi2SetBoolean(fmi2Component component, References references, std::size_t count,
                          const fmi2Boolean values[]) {
    return set<bool>(component, __func__, references, count, values);
}

fmi2Status fmi2SetString(fmi2Component component, References references, std::size_t count, const fmi2String values[]) {
    return set<std::string>(component, __func__, references, count, values);
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance& instance) { instance.save(made(state)); });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
    return call(component, __func__, fmu::any, [&](Instance& instance) { instance.restore(bytes_of(state)); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        if (state != nullptr) delete static_cast<Bytes*>(std::exchange(*state, nullptr));
    });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, std::size_t* size) {
    return call(component, __func__, fmu::any,
                [&](Instance&) { *size = bytes_of(state).size() + sizeof(std::uint64_t); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte serialized[], std::size_t size) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        const Bytes& bytes = bytes_of(state);
        const std::uint64_t hash = fmu::hash_of(bytes);  // because the file that keeps them may get damaged
        require(size >= bytes.size() + sizeof hash, "the serialised state needs more room");
        std::memcpy(serialized, bytes.data(), bytes.size());
        std::memcpy(serialized + bytes.size(), &hash, sizeof hash);
    });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte serialized[], std::size_t size,
                                   fmi2FMUstate* state) {
    return call(component, __func__, fmu::any, [&](Instance&) {
        std::uint64_t hash = 0;
        require(size >= sizeof hash, "the serialised state is too short");
        const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(serialized), size - sizeof hash);
        std::memcpy(&hash, serialized + bytes.size(), sizeof hash);
        require(hash == fmu::hash_of(bytes), "the serialised state is damaged");
        made(state).assign(bytes.begin(), bytes.end());
    });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, References unknowns, std::size_t unknown_count,
                                        References knowns, std::size_t known_count, const fmi2Real seeds[],
                                        fmi2Real derivatives[]) {
    return call(component, __func__, fmu::stepping, [&](Instance& instance) {
        for (std::size_t i = 0; i < unknown_count; ++i) {
            derivatives[i] = 0;
            for (std::size_t j = 0; j < known_count; ++j) {
                const fmu::Variable& unknown = instance.variable<double>(unknowns[i]);
                const fmu::Variable& known = instance.variable<double>(knowns[j]);
                try {
                    derivatives[i] += instance.partial(unknown, known) * seeds[j];
                } catch (const fmu::NoDerivative& none) {
                    instance.log(fmi2Discard, "fmi2GetDirectionalDerivative: there is no derivative of " +
                                                  unknown.name + " by " + known.name + none.reason);
                    return fmi2Discard;
                }
            }
        }
        return fmi2OK;
    });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, References references, std::size_t count,
                                       const fmi2Integer orders[], const fmi2Real values[]) {
    return call(component, __func__, before_and_between_steps, [&](Instance& instance) {
        for (std::size_t i = 0; i < count; ++i) {
            const fmu::Variable& variable = instance.variable<double>(references[i]);
            require(variable.rate != nullptr, (variable.name + " is no input").c_str());
            require(orders[i] == 1, "inputs have first derivatives only");
            *variable.rate = values[i];
        }
    });
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, References, std::size_t, const fmi2Integer[],
                                        fmi2Real[]) {
    return refuse(component, __func__, "outputs have no derivatives by time");
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real time, fmi2Real duration, fmi2Boolean /*no_state_before*/) {
    return call(component, __func__, fmu::stepping, [&](Instance& instance) {
        require(std::isfinite(time) && std::isfinite(duration) && duration > 0, "the step must be positive and finite");
        return instance.step(time, duration);
    });
}

fmi2Status fmi2CancelStep(fmi2Component component) {
    return refuse(component, __func__, "no step goes on in the background");
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
    return nothing_in_background(component, __func__);
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, const fmi2StatusKind, fmi2Integer*) {
    return nothing_in_background(component, __func__);
}

fmi2Status fmi2GetStringStatus(fmi2Component component, const fmi2StatusKind, fmi2String*) {
    return nothing_in_background(component, __func__);
}

}  // extern "C"
