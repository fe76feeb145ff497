#include "config_file.hpp"

#include <sstream>

#include <toml++/toml.h>

#include "csv.hpp"
#include "errors.hpp"
#include "files.hpp"

namespace study {

namespace {

/// A value as the command line has it.
std::string text_of(const toml::node& node, const std::string& where) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    if (const auto number = node.value_exact<double>()) {
        std::ostringstream odd;  // inf and nan
        odd << *number;
        const std::string text = Cell(*number).text();
        return text.empty() ? odd.str() : text;
    }
    if (const auto number = node.value_exact<std::int64_t>()) return std::to_string(*number);
    if (const auto truth = node.value_exact<bool>()) return *truth ? "true" : "false";
    throw BadInput(where + " must be a text, a number, true or false, or a list of these");
}

Setting setting_of(const std::string& name, const toml::node& node, const std::string& said) {
    std::ostringstream shown;
    node.visit([&](const auto& value) { shown << value; });
    Setting setting{
        name,
        {},
        said + ": line " + std::to_string(node.source().begin.line) + ": " + name + " = " + printable(shown.str())};
    const toml::array* list = node.as_array();
    if (list != nullptr && list->empty()) throw BadInput(setting.where + " must not be an empty list");
    if (list == nullptr) {
        setting.values.push_back(text_of(node, setting.where));
    } else {
        for (const toml::node& item : *list) setting.values.push_back(text_of(item, setting.where));
    }
    return setting;
}

}  // namespace

Config read_config(const std::string& text, const std::string& said) {
    Config config;
    try {
        const toml::table all = toml::parse(text);
        const toml::table* given = all["given"].as_table();
        config.is_sidecar = given != nullptr;
        config.program = all["program"].value_or(std::string());
        if (const toml::table* inputs = config.is_sidecar ? all["inputs"].as_table() : nullptr) {
            for (const auto& [name, checksum] : *inputs) {
                config.inputs[std::string(name.str())] = checksum.value_or(std::string());
            }
        }
        for (const auto& [name, node] : config.is_sidecar ? *given : all) {
            config.settings.push_back(setting_of(std::string(name.str()), node, said));
        }
    } catch (const toml::parse_error& error) {
        throw BadInput(said + ": line " + std::to_string(error.source().begin.line) +
                       " must be TOML: " + printable(error.description()));
    }
    return config;
}

}  // namespace study
