// modelDescription.xml and the documentation of an FMU, written from the table of its variables.
#include "description.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model.hpp"

namespace fmu {

namespace {

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    }
    return result;
}

std::string attribute(const char* name, std::string_view value) {
    return std::string(" ") + name + "=\"" + escaped(value) + '"';
}

bool has_start(const Variable& variable) { return variable.causality != Causality::output; }

const char* name_of(Causality causality) {
    return std::array{"parameter", "input", "output"}[static_cast<std::size_t>(causality)];
}

std::string start_of(const Variable& variable) {
    if (variable.is<std::string>()) return variable.text();
    return variable.is<double>() ? text_of(variable.real()) : text_of(variable.integer());
}

std::string units(const std::vector<Variable>& variables) {
    std::string text = "  <UnitDefinitions>\n";
    for (const Unit& unit : known_units()) {
        if (std::ranges::find(variables, unit.name, &Variable::unit) == variables.end()) continue;
        text += "    <Unit" + attribute("name", unit.name) + "><BaseUnit";
        for (const auto& [base, exponent] :
             {std::pair("kg", unit.kg), {"m", unit.m}, {"s", unit.s}, {"rad", unit.rad}}) {
            if (exponent != 0) text += attribute(base, text_of(exponent));
        }
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
                       attribute("causality", name_of(variable.causality)) +
                       attribute("variability", variable.causality == Causality::parameter ? "fixed"
                                                : variable.is<double>()                    ? "continuous"
                                                                                           : "discrete");
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
    text += "  <LogCategories>\n";
    for (const char* category : log_categories) text += "    <Category" + attribute("name", category) + "/>\n";
    text += "  </LogCategories>\n";
    text += "  <DefaultExperiment" + attribute("startTime", "0") + attribute("stopTime", text_of(identity.stop_time)) +
            attribute("stepSize", text_of(identity.step_size)) + "/>\n";
    std::string unknowns;
    text += "  <ModelVariables>\n";
    for (std::size_t i = 0; i < variables.size(); ++i) {
        text += scalar_variable(variables[i], i);
        if (!has_start(variables[i])) unknowns += "      <Unknown" + attribute("index", text_of(i + 1)) + "/>\n";
    }
    text += "  </ModelVariables>\n  <ModelStructure>\n    <Outputs>\n" + unknowns + "    </Outputs>\n";
    text += "    <InitialUnknowns>\n" + unknowns + "    </InitialUnknowns>\n";
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
        text += "| `" + variable.name + "` | " + name_of(variable.causality) + " | " + variable.unit + " | " + start +
                " | " + meaning + " |\n";
    }
    return text;
}

}  // namespace fmu
