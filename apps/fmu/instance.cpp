// An instance of an FMU.
#include "instance.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "description.hpp"

namespace fmu {

namespace {

/// The path of a URI file://HOST/PATH with an empty host or localhost, in which %XX is a character; any other text is a
/// path already.
std::string path_of(std::string_view uri) {
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

}  // namespace

Instance::Instance(std::string name, std::string_view resources, const fmi2CallbackFunctions& callbacks)
    : name_(std::move(name)), resources_(path_of(resources)), callbacks_(callbacks) {
    make();
}

void Instance::make() {
    model_ = make_model();
    model_->resources = resources_;
}

void Instance::log(fmi2Status status, const std::string& message) const {
    const bool warning = status == fmi2Warning, discard = status == fmi2Discard;
    const bool wanted = warning ? log_warnings_ : discard ? log_discards_ : log_errors_;
    if (callbacks_.logger == nullptr || !wanted) return;
    callbacks_.logger(callbacks_.componentEnvironment, name_.c_str(), status,
                      warning   ? "logStatusWarning"
                      : discard ? "logStatusDiscard"
                                : "logStatusError",
                      "%s", message.c_str());
}

void Instance::set_logging(std::span<const fmi2String> categories) {
    bool warnings = categories.empty(), discards = warnings, errors = warnings;
    for (const fmi2String category : categories) {
        const std::string_view wanted = category == nullptr ? "" : category;
        if (wanted == "logStatusWarning") {
            warnings = true;
        } else if (wanted == "logStatusDiscard") {
            discards = true;
        } else if (wanted == "logStatusError") {
            errors = true;
        } else {
            throw std::invalid_argument("there is no log category " + std::string(wanted));
        }
    }
    log_warnings_ = warnings;
    log_discards_ = discards;
    log_errors_ = errors;
}

fmi2Status Instance::warn() {
    if (model_->warning.empty()) return fmi2OK;
    log(fmi2Warning, model_->warning);
    model_->warning.clear();
    return fmi2Warning;
}

void Instance::reset() {
    make();
    built_ = false;
    refused = false;
    time = 0;
    mode = instantiated;
}

void Instance::refuse_reference(fmi2ValueReference reference) const {
    throw std::invalid_argument("there is no variable of this type with the value reference " +
                                std::to_string(reference));
}

void Instance::before_setting(const Variable& found) {
    const bool before = (mode & (instantiated | initialization)) != 0;
    if (found.causality != Causality::input && !(found.causality == Causality::parameter && before)) {
        throw std::invalid_argument(found.name + (found.causality == Causality::parameter
                                                      ? " is fixed once the simulation runs"
                                                      : " is calculated and cannot be set"));
    }
    if (before) built_ = false;
}

void Instance::build() {
    if (built_) return;
    model_->settle_enumerations();
    model_->initialise();
    built_ = true;
}

fmi2Status Instance::tell(Outcome outcome, std::string message) const {
    message += outcome == Outcome::refused ? " is refused" : " needs finite numbers";
    const char* separator = ": ";
    for (const Variable& variable : variables()) {
        const bool status = variable.causality == Causality::output && variable.items != nullptr;
        if (variable.causality != Causality::input && !status) continue;
        message += separator + variable.name + " = ";
        separator = ", ";
        if (status) {
            message += variable.items->item(variable.integer()).name;
        } else {
            message += text_of(variable.real()) + ' ' + variable.unit;
        }
    }
    const fmi2Status result = outcome == Outcome::refused ? fmi2Discard : fmi2Error;
    log(result, message);
    return result;
}

void Instance::refresh() {
    if (mode == initialization) build();
}

fmi2Status Instance::step(double start, double duration) {
    // a refused step has not been done: later steps would lose the distance rolled in it
    if (refused && start - refused_from_ > 1e-6 * duration) {
        throw std::invalid_argument("a step from t = " + text_of(start) + " s, but the one from t = " +
                                    text_of(refused_from_) + " s was refused; it must be repeated or the run must end");
    }
    const Outcome outcome = model_->step(duration);
    refused = outcome != Outcome::ok;
    refused_from_ = start;
    if (outcome != Outcome::ok) {
        return tell(outcome, "a step of " + text_of(duration) + " s from t = " + text_of(start) + " s");
    }
    time = start + duration;
    return warn();
}

double Instance::partial(fmi2ValueReference unknown, fmi2ValueReference known) {
    return model_->partial(variable<double>(unknown), variable<double>(known));
}

bool Instance::keep_variables(Archive& archive) {
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

void Instance::save(std::vector<std::byte>& bytes) {
    Archive archive(bytes);
    Header header{.mode = mode, .built = built_, .time = time};
    guid().copy(header.guid.data(), header.guid.size());
    archive.keep(header);
    keep_variables(archive);
    if (built_) model_->archive(archive);
}

void Instance::restore(std::span<const std::byte> bytes) {
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

}  // namespace fmu
