#include "sidecar.hpp"

#include <fstream>
#include <sstream>

#include <gsl/gsl_version.h>
#include <toml++/toml.h>

#include "build_info.hpp"
#include "input.hpp"

namespace study {

namespace {

/// As the command line has it.
std::string text_of(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    std::ostringstream text;
    node.visit([&](const auto& value) { text << value; });
    return text.str();
}

Setting setting_of(const std::string& name, const toml::node& node, const std::string& said) {
    const std::string line = std::to_string(node.source().begin.line);
    Setting setting{name, {}, said + ": line " + line + ": " + name + " = " + printable(text_of(node))};
    const toml::array* list = node.as_array();
    if (list != nullptr && list->empty()) throw BadInput(setting.where + " must not be an empty list");
    const auto add = [&](const toml::node& value) {
        if (!value.is_string() && !value.is_number() && !value.is_boolean()) {
            throw BadInput(setting.where + " must be a text, a number, true or false, or a list of these");
        }
        setting.values.push_back(text_of(value));
    };
    if (list == nullptr) add(node);
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) add((*list)[i]);
    return setting;
}

/// A command line as a shell takes it.
std::string shell_quoted(const std::vector<std::string>& words) {
    std::string result;
    for (const std::string& word : words) {
        if (!result.empty()) result += ' ';
        const bool plain = !word.empty() && word.find_first_of(" \t\n\r'\"\\$`!*?[](){}<>|&;#~=^") == std::string::npos;
        std::string quoted;
        for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
        result += plain ? word : "'" + quoted + "'";
    }
    return result;
}

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line)) {
        if (line.rfind("model name", 0) == 0) return std::string(detail::trim(line.substr(line.find(':') + 1)));
    }
    return "unknown";
}

constexpr const char* conventions =
    R"toml(x = "rolling direction in units of the half-length a; leading edge at x/a = 1, trailing edge at x/a = -1"
elements = "numbered from the trailing edge to the leading edge"
signs = "traction acts on body 1 (the wheel); positive creepage gives negative traction and force"
c11 = """of a line: -force per width / (a G creepage); c11_exact = pi/(2(1-nu)), plane limit b >> a of a rectangle; \
of a patch: (F_x, F_y, M_z/c) = -G a b (c11 c12 c13; c21 c22 c23; c31 c32 c33) (xi, eta, phi c), c = sqrt(a b)"""
units = "dimensionless with a = G = V = 1; columns ending in _us in microseconds"
errors = "relative_error = value/exact - 1, signed, for real quantities; absolute value for complex ones"
cells = "the shortest text that is read back exactly; an undefined value is an empty cell"
)toml";

}  // namespace

Config read_config(const std::string& text, const std::string& said) {
    Config config;
    try {
        const toml::table all = toml::parse(text);
        const toml::table* given = all["given"].as_table();
        config.is_sidecar = given != nullptr;
        config.program = all["program"].value_or(std::string());
        for (const auto& [name, node] : config.is_sidecar ? *given : all) {
            config.settings.push_back(setting_of(std::string(name.str()), node, said));
        }
    } catch (const toml::parse_error& error) {
        throw BadInput(said + ": line " + std::to_string(error.source().begin.line) +
                       " must be TOML: " + printable(error.description()));
    }
    return config;
}

std::string sidecar_text(const Options& options) {
    toml::table given;
    for (const auto& [name, value] : options.given_values()) given.insert(name, value);
    toml::table all{{"program", options.program()},
                    {"command_line", shell_quoted(options.words())},
                    {"version", build_info::version},
                    {"git_revision", build_info::git_revision},
                    {"given", given},
                    {"build", toml::table{{"compiler", build_info::compiler},
                                          {"flags", build_info::flags},
                                          {"build_type", build_info::build_type},
                                          {"eigen", build_info::eigen},
                                          {"gsl", gsl_version}}},
                    {"machine", toml::table{{"cpu", cpu_name()}}}};
    toml::array notes;
    for (const std::string& note : options.notes()) notes.push_back(note);
    if (!notes.empty()) all.insert("notes", notes);
    std::ostringstream text;
    text << toml::toml_formatter(all, toml::format_flags::allow_unicode_strings) << "\n\n[conventions]\n"
         << (options.conventions().empty() ? conventions : options.conventions());
    return text.str();
}

}  // namespace study
