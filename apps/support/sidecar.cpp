#include "sidecar.hpp"

#include <fstream>
#include <string_view>

#include <gsl/gsl_version.h>

#include "build_info.hpp"
#include "input.hpp"

namespace study {

namespace {

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
        if (line.rfind("model name", 0) == 0)
            return std::string(rollbem::detail::trimmed(line.substr(line.find(':') + 1)));
    }
    return "unknown";
}

constexpr const char* conventions =
    R"(x = rolling direction in units of the half-length a; leading edge at x/a = 1, trailing edge at x/a = -1
elements = numbered from the trailing edge to the leading edge
signs = traction acts on body 1 (the wheel); positive creepage gives negative traction and force
c11 = of a line: -force per width / (a G creepage); c11_exact = pi/(2(1-nu)), plane limit b >> a of a rectangle
c_ij = of a patch: (F_x, F_y, M_z/c) = -G a b (c11 c12 c13; c21 c22 c23; c31 c32 c33) (xi, eta, phi c), c = sqrt(a b)
units = dimensionless with a = G = V = 1; columns ending in _us in microseconds
errors = relative_error = value/exact - 1, signed, for real quantities; absolute value for complex ones
cells = the shortest text that is read back exactly; an undefined value is an empty cell
)";

/// The lines of a text as comments.
std::string comments(const std::string& lines) {
    std::string text;
    for (const std::string& line : cells_of(lines, '\n')) {
        if (!line.empty()) text += "# " + line + "\n";
    }
    return text;
}

/// The text in quotes, as --config reads it.
std::string quoted(const std::string& name, const std::string& text) {
    const char mark = text.find('"') == std::string::npos ? '"' : '\'';
    if (text.find(mark) != std::string::npos || text.find_first_of("\n\r\\") != std::string::npos) {
        throw BadInput("--" + name + " = " + text + " must have no line break, backslash, or both \" and ', which " +
                       "the file next to the results cannot keep");
    }
    return mark + text + mark;
}

}  // namespace

std::string sidecar_text(const Options& options) {
    std::string text = sidecar_start + options.program() + "\n# The options are read by --config.\n";
    for (const Given& given : options.given()) {
        if (given.repeats) text += given.name + " = " + quoted(given.name, given.value) + "\n";
    }
    const auto add = [&](const std::string& name, std::string_view value) {
        text += "# " + name + " = " + printable(value) + "\n";
    };
    add("command_line", shell_quoted(options.words()));
    add("version", build_info::version);
    add("git_revision", build_info::git_revision);
    add("compiler", build_info::compiler);
    add("flags", build_info::flags);
    add("build_type", build_info::build_type);
    add("eigen", build_info::eigen);
    add("gsl", gsl_version);
    add("cpu", cpu_name());
    for (const std::string& note : options.notes()) add("note", note);
    return text + comments(options.conventions().empty() ? conventions : options.conventions());
}

}  // namespace study
