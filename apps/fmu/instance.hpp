// An instance of an FMU: a model, its place in the order of calls that FMI prescribes, and the importing program's
// logger.
#pragma once

#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmi2Functions.h>

#include "model.hpp"

namespace fmu {

/// The place of an instance in the order of calls; sets of them tell when a function may be called.
enum Mode : unsigned {
    instantiated = 1,
    initialization = 2,
    stepping = 4,  // between steps
    terminated = 8,
    failed = 16,  // after an error; left by a saved state or a reset
    any = 31,
};

class Instance {
public:
    /// `resources` is the folder of the files packed with the FMU, as a URI.
    Instance(std::string name, std::string_view resources, const fmi2CallbackFunctions& callbacks);

    /// Sends a message to the importing program.
    void log(fmi2Status status, const std::string& message) const;
    /// Chooses the categories to log, all of them if none is named. Throws std::invalid_argument for an unknown one.
    void set_logging(std::span<const fmi2String> categories);

    /// Back to the state after instantiation.
    void reset();

    const std::vector<Variable>& variables() const { return model_->variables(); }
    /// Throws std::invalid_argument if there is no such variable of that type.
    template <class Value>
    const Variable& variable(fmi2ValueReference reference) const {
        if (reference >= variables().size() || !variables()[reference].is<Value>()) refuse_reference(reference);
        return variables()[reference];
    }
    /// The variable's value, for writing. Throws std::invalid_argument if the variable may not be set in this mode.
    template <class Value>
    Value& settable(fmi2ValueReference reference) {
        const Variable& found = variable<Value>(reference);
        before_setting(found);
        return *std::get<Value*>(found.value);
    }

    /// Builds the model unless it is built for the present parameters and initial inputs. Throws std::invalid_argument.
    void build();
    /// Brings outputs up to date with the inputs during initialization.
    void refresh();
    fmi2Status step(double time, double duration);
    /// Logs the model's warning once.
    fmi2Status warn();
    double partial(fmi2ValueReference unknown, fmi2ValueReference known);

    void save(std::vector<std::byte>& bytes);
    /// Throws std::invalid_argument if the bytes are not a state of this FMU.
    void restore(std::span<const std::byte> bytes);

    Mode mode = instantiated;
    double time = 0;       ///< the end of the last step that succeeded [s]
    bool refused = false;  ///< the last step

private:
    [[noreturn]] void refuse_reference(fmi2ValueReference reference) const;
    void before_setting(const Variable& variable);
    void make();                                                  // a new model
    fmi2Status tell(Outcome outcome, std::string message) const;  // for an outcome that is not ok
    bool keep_variables(Archive& archive);                        // whether reading left the parameters unchanged

    std::string name_;
    std::string resources_;  // a path
    fmi2CallbackFunctions callbacks_;
    bool log_warnings_ = true, log_discards_ = true, log_errors_ = true;
    std::unique_ptr<Model> model_;
    bool built_ = false;
    double refused_from_ = 0;  // where the last step began, if it was refused [s]
};

/// Calls body(instance) for a function of the C interface that is allowed in the given modes. A body without a result
/// means fmi2OK; an exception becomes a message and an error.
template <class Body>
fmi2Status call(fmi2Component component, const char* function, unsigned allowed, const Body& body) noexcept {
    auto* const instance = static_cast<Instance*>(component);
    if (instance == nullptr) return fmi2Error;
    fmi2Status status = fmi2Error;
    try {
        if ((instance->mode & allowed) == 0) {
            instance->log(fmi2Error, std::string(function) + " must not be called now");
        } else if constexpr (std::is_void_v<decltype(body(*instance))>) {
            body(*instance);
            status = fmi2OK;
        } else {
            status = body(*instance);
        }
    } catch (const std::exception& error) {
        try {
            instance->log(fmi2Error, std::string(function) + ": " + error.what());
        } catch (...) {
        }
    } catch (...) {
    }
    if (status == fmi2Error) instance->mode = failed;
    return status;
}

}  // namespace fmu
