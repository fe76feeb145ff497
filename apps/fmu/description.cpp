// modelDescription.xml and the documentation of an FMU, written from the table of its variables.
#include "description.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model.hpp"

namespace fmu {

namespace {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

std::string attribute(const char* name, std::string_view value) {
    return std::string(" ") + name + "=\"" + escaped(value) + '"';
}

bool has_start(const Variable& variable) {
    return variable.causality == Causality::parameter || variable.causality == Causality::input;
}

const char* causality_of(const Variable& variable) {
    switch (variable.causality) {
        case Causality::parameter: return "parameter";
        case Causality::input: return "input";
        case Causality::output: break;
    }
    return "output";
}

const char* variability_of(const Variable& variable) {
    return variable.causality == Causality::parameter ? "fixed" : variable.is<double>() ? "continuous" : "discrete";
}

std::string start_of(const Variable& variable) {
    if (variable.is<std::string>()) return variable.text();
    return variable.is<double>() ? text_of(variable.real()) : text_of(variable.integer());
}

std::string units(const std::vector<Variable>& variables) {
    std::set<std::string> used;
    for (const Variable& variable : variables) used.insert(variable.unit);
    std::string text = "  <UnitDefinitions>\n";
    for (const Unit& unit : known_units()) {
        if (!used.contains(unit.name)) continue;
        text += "    <Unit" + attribute("name", unit.name) + "><BaseUnit";
        if (unit.kg != 0) text += attribute("kg", text_of(unit.kg));
        if (unit.m != 0) text += attribute("m", text_of(unit.m));
        if (unit.s != 0) text += attribute("s", text_of(unit.s));
        if (unit.rad != 0) text += attribute("rad", text_of(unit.rad));
        text += "/></Unit>\n";
    }
    return text + "  </UnitDefinitions>\n";
}

std::string types(const std::vector<Variable>& variables) {
    std::set<const Enumeration*> written;
    std::string text = "  <TypeDefinitions>\n";
    for (const Variable& variable : variables) {
        if (variable.items == nullptr || !written.insert(variable.items).second) continue;
        text += "    <SimpleType" + attribute("name", variable.items->name) + "><Enumeration>\n";
        int value = variable.items->first;
        for (const Enumeration::Item& item : variable.items->items) {
            text += "      <Item" + attribute("name", item.name) + attribute("value", text_of(value++));
            if (!item.description.empty()) text += attribute("description", item.description);
            text += "/>\n";
        }
        text += "    </Enumeration></SimpleType>\n";
    }
    return text + "  </TypeDefinitions>\n";
}

std::string scalar_variable(const Variable& variable, std::size_t place) {
    std::string text = "    <ScalarVariable" + attribute("name", variable.name) +
                       attribute("valueReference", text_of(place)) + attribute("description", variable.description) +
                       attribute("causality", causality_of(variable)) +
                       attribute("variability", variability_of(variable));
    // FMI takes an input's start value as exact
    if (variable.causality != Causality::input) {
        text += attribute("initial", has_start(variable) ? "exact" : "calculated");
    }
    text += '>';
    text += variable.is<double>()        ? "<Real"
            : variable.is<std::string>() ? "<String"
            : variable.items             ? "<Enumeration"
                                         : "<Integer";
    if (variable.items) text += attribute("declaredType", variable.items->name);
    if (!variable.unit.empty()) text += attribute("unit", variable.unit);
    if (std::isfinite(variable.min)) text += attribute("min", text_of(variable.min));
    if (std::isfinite(variable.max)) text += attribute("max", text_of(variable.max));
    if (has_start(variable)) text += attribute("start", start_of(variable));
    return text + "/></ScalarVariable>\n";
}

/// The outputs as a list of unknowns.
std::string unknowns(const char* name, const std::vector<Variable>& variables) {
    std::string text = std::string("    <") + name + ">\n";
    for (std::size_t i = 0; i < variables.size(); ++i) {
        if (!has_start(variables[i])) text += "      <Unknown" + attribute("index", text_of(i + 1)) + "/>\n";
    }
    return text + "    </" + name + ">\n";
}

/// All of modelDescription.xml, with a given GUID.
std::string description_with(std::string_view guid) {
    const std::unique_ptr<Model> model = make_model();
    const std::vector<Variable>& variables = model->variables();
    const std::string abilities =
        attribute("modelIdentifier", identity.identifier) + attribute("canNotUseMemoryManagementFunctions", "true") +
        attribute("canGetAndSetFMUstate", "true") + attribute("canSerializeFMUstate", "true") +
        attribute("providesDirectionalDerivative", "true");

    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription";
    text += attribute("fmiVersion", "2.0") + attribute("modelName", identity.identifier) + attribute("guid", guid) +
            attribute("description", identity.description) + attribute("version", ROLLBEM_VERSION) +
            attribute("license", "MIT") + attribute("generationTool", "rollbem " ROLLBEM_VERSION) +
            attribute("variableNamingConvention", "structured") + attribute("numberOfEventIndicators", "0") + ">\n";
    text += "  <CoSimulation" + abilities + attribute("canHandleVariableCommunicationStepSize", "true") +
            attribute("canInterpolateInputs", "true") + "/>\n";
    text += units(variables) + types(variables);
    text +=
        "  <LogCategories>\n    <Category name=\"logStatusWarning\"/>\n    <Category name=\"logStatusDiscard\"/>\n"
        "    <Category name=\"logStatusError\"/>\n"
        "  </LogCategories>\n";
    text += "  <DefaultExperiment" + attribute("startTime", "0") + attribute("stopTime", text_of(identity.stop_time)) +
            attribute("stepSize", text_of(identity.step_size)) + "/>\n";
    text += "  <ModelVariables>\n";
    for (std::size_t i = 0; i < variables.size(); ++i) text += scalar_variable(variables[i], i);
    text += "  </ModelVariables>\n  <ModelStructure>\n";
    text += unknowns("Outputs", variables) + unknowns("InitialUnknowns", variables);
    return text + "  </ModelStructure>\n</fmiModelDescription>\n";
}

}  // namespace

const std::string& guid() {
    static const std::string value = [] {
        const std::string contents = description_with("");
        const std::uint64_t high = hash_of(contents), low = hash_of(contents, high);
        char text[40];
        std::snprintf(text, sizeof text, "{%08x-%04x-%04x-%04x-%012llx}", static_cast<unsigned>(high >> 32),
                      static_cast<unsigned>(high >> 16 & 0xffff), static_cast<unsigned>(high & 0xffff),
                      static_cast<unsigned>(low >> 48), static_cast<unsigned long long>(low & 0xffffffffffff));
        return std::string(text);
    }();
    return value;
}

std::string model_description() { return description_with(guid()); }

std::string table_of_variables() {
    const std::unique_ptr<Model> model = make_model();
    std::string text = "| variable | causality | unit | start | meaning |\n|---|---|---|---|---|\n";
    for (const Variable& variable : model->variables()) {
        if (variable.is_code) continue;
        std::string start;
        if (has_start(variable)) {
            start = variable.items ? variable.items->item(variable.integer()).name : start_of(variable);
        }
        std::string meaning = variable.description;
        if (variable.items && variable.causality == Causality::parameter) {
            meaning += ':';
            int value = 0;
            for (const Enumeration::Item& item : variable.items->items) {
                meaning += (value == 0 ? " " : ", ") + text_of(value + 1) + " `" + item.name + '`';
                if (!item.description.empty()) meaning += " (" + item.description + ')';
                ++value;
            }
        }
        text += "| `" + variable.name + "` | " + causality_of(variable) + " | " + variable.unit + " | " + start +
                " | " + meaning + " |\n";
    }
    return text;
}

}  // namespace fmu
