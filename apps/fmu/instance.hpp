// An instance of an FMU: a model, its place in the order of calls that FMI prescribes, and the importing program's
// logger.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmi2Functions.h>

#include <rollbem/detail/finite.hpp>
#include <rollbem/status.hpp>

#include "description.hpp"
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

/// The path of a URI file://HOST/PATH with an empty host or localhost, in which %XX is a character; any other text is a
/// path already.
inline std::string path_of(std::string_view uri) {
    if (!uri.starts_with("file:")) return std::string(uri);
    uri.remove_prefix(5);
    if (uri.starts_with("//")) uri.remove_prefix(std::min(uri.find('/', 2), uri.size()));
    const bool drive = uri.size() > 2 && uri[2] == ':';
    if (drive) uri.remove_prefix(1);  // the slash in /C:/
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned char byte = 0;
        const char* const end = uri.data() + std::min(i + 3, uri.size());
        if (uri[i] == '%' && std::from_chars(uri.data() + i + 1, end, byte, 16).ptr == uri.data() + i + 3) {
            path += static_cast<char>(byte);
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// The beginning of a saved state.
struct Header {
    std::array<char, 38> guid{};
    Mode mode{};
    bool built = false;
    double time = 0;
};

class Instance {
public:
    /// `resources` is the folder of the files packed with the FMU, as a URI.
    Instance(std::string name, std::string_view resources, const fmi2CallbackFunctions& callbacks)
        : name_(std::move(name)), resources_(path_of(resources)), callbacks_(callbacks) {
        reset();
    }

    /// Sends a message to the importing program.
    void log(fmi2Status status, const std::string& message) const {
        const auto category = static_cast<std::size_t>(status - fmi2Warning);
        if (callbacks_.logger == nullptr || !logged_[category]) return;
        callbacks_.logger(callbacks_.componentEnvironment, name_.c_str(), status, log_categories[category], "%s",
                          message.c_str());
    }
    /// Chooses the categories to log, all of them if none is named. Throws std::invalid_argument for an unknown one.
    void set_logging(std::span<const fmi2String> names) {
        std::array<bool, 3> logged;
        logged.fill(names.empty());
        for (const fmi2String one : names) {
            const std::string_view wanted = one == nullptr ? "" : one;
            const auto found =
                std::ranges::find(log_categories, wanted, [](const char* name) { return std::string_view(name); });
            if (found == log_categories.end())
                throw std::invalid_argument("there is no log category " + std::string(wanted));
            logged[static_cast<std::size_t>(found - log_categories.begin())] = true;
        }
        logged_ = logged;
    }

    /// Back to the state after instantiation.
    void reset() {
        model_ = make_model();
        model_->resources = resources_;
        built_ = false;
        refused = false;
        time = 0;
        mode = instantiated;
    }

    /// A variable, for reading. Throws std::invalid_argument if there is no such variable of that type. Outputs are
    /// brought up to date with the inputs during initialization.
    template <class Value>
    const Variable& variable(fmi2ValueReference reference) {
        if (reference >= variables().size() || !variables()[reference].is<Value>()) {
            throw std::invalid_argument("there is no variable of this type with the value reference " +
                                        std::to_string(reference));
        }
        const Variable& found = variables()[reference];
        if (found.causality == Causality::output && mode == initialization) build();
        return found;
    }
    /// The variable's value, for writing. Throws std::invalid_argument if the variable may not be set in this mode.
    template <class Value>
    Value& settable(fmi2ValueReference reference) {
        const Variable& found = variable<Value>(reference);
        before_setting(found);
        return *std::get<Value*>(found.value);
    }

    /// Builds the model unless it is built for the present parameters and initial inputs. Throws std::invalid_argument.
    void build() {
        if (!built_) model_->begin();
        built_ = true;
    }
    fmi2Status step(double start, double duration) {
        // a refused step has not been done: later steps would lose the distance rolled in it
        if (refused && start - refused_from_ > 1e-6 * duration) {
            throw std::invalid_argument("a step from t = " + text_of(start) +
                                        " s, but the one from t = " + text_of(refused_from_) +
                                        " s was refused; it must be repeated or the run must end");
        }
        const rollbem::Status status = model_->step(duration);
        refused = status != rollbem::Status::ok;
        refused_from_ = start;
        if (!refused) {
            time = start + duration;
            return warn();
        }
        const fmi2Status result = status == rollbem::Status::not_finite ? fmi2Error : fmi2Discard;
        log(result, "a step of " + text_of(duration) + " s from t = " + text_of(start) +
                        (result == fmi2Error ? " s needs finite numbers: " : " s is refused: ") + inputs_and_status());
        return result;
    }
    /// Logs the model's warning once.
    fmi2Status warn() {
        if (model_->warning.empty()) return fmi2OK;
        log(fmi2Warning, std::exchange(model_->warning, {}));
        return fmi2Warning;
    }
    /// Throws NoDerivative if there is none.
    double partial(const Variable& unknown, const Variable& known) {
        if (unknown.causality != Causality::output || known.causality != Causality::input) throw NoDerivative{};
        const double value = model_->partial(unknown.index, known.index);
        if (!rollbem::detail::is_finite(value)) throw NoDerivative{" here"};
        return value;
    }

    void save(std::vector<std::byte>& bytes) {
        Archive archive(bytes);
        Header header{.mode = mode, .built = built_, .time = time};
        guid().copy(header.guid.data(), header.guid.size());
        archive.keep(header);
        keep_variables(archive);
        if (built_) model_->archive(archive);
    }
    /// Throws std::invalid_argument if the bytes are not a state of this FMU.
    void restore(std::span<const std::byte> bytes) {
        Archive archive(bytes);
        Header header;
        archive.keep(header);
        if (std::string_view(header.guid.data(), header.guid.size()) != guid()) {
            throw std::invalid_argument("the saved state is of another FMU");
        }
        const std::span<const std::byte> variables = bytes.last(archive.left());
        const bool same_parameters = keep_variables(archive);
        built_ = built_ && same_parameters;
        if (header.built && !built_) {
            build();  // sets variables
            model_->warning.clear();
            Archive again(variables);
            keep_variables(again);
        }
        built_ = header.built;
        if (built_) model_->archive(archive);
        if (archive.left() != 0) throw std::invalid_argument("the saved state is too long");
        mode = header.mode;
        time = header.time;
        refused = false;
    }

    Mode mode = instantiated;
    double time = 0;       ///< the end of the last step that succeeded [s]
    bool refused = false;  ///< the last step

private:
    const std::vector<Variable>& variables() const { return model_->variables(); }
    void before_setting(const Variable& found) {
        const bool before = (mode & (instantiated | initialization)) != 0;
        if (found.causality == Causality::output)
            throw std::invalid_argument(found.name + " is calculated and cannot be set");
        if (found.causality == Causality::parameter && !before) {
            throw std::invalid_argument(found.name + " is fixed once the simulation runs");
        }
        if (before) built_ = false;
    }
    std::string inputs_and_status() const {
        std::string text;
        for (const Variable& variable : variables()) {
            const bool status = variable.causality == Causality::output && variable.items != nullptr;
            if (variable.causality != Causality::input && !status) continue;
            text += (text.empty() ? "" : ", ") + variable.name + " = ";
            text +=
                status ? variable.items->item(variable.integer()).name : text_of(variable.real()) + ' ' + variable.unit;
        }
        return text;
    }
    // Returns whether reading left the parameters unchanged.
    bool keep_variables(Archive& archive) {
        bool same = true;
        for (const Variable& variable : variables()) {
            std::visit(
                [&](auto* value) {
                    const auto before = *value;
                    archive.keep(*value);
                    same = same && (variable.causality != Causality::parameter || *value == before);
                },
                variable.value);
            if (variable.rate) archive.keep(*variable.rate);
        }
        return same;
    }

    std::string name_;
    std::string resources_;  // a path
    fmi2CallbackFunctions callbacks_;
    std::array<bool, 3> logged_{true, true, true};  // warnings, discarded calls, errors
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
