#include "options.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <optional>
#include <sstream>

#include <CLI/CLI.hpp>
#include <gsl/gsl_errno.h>

#include <rollbem/discretisation/mesh.hpp>

#include "build_info.hpp"
#include "csv.hpp"
#include "input.hpp"
#include "named_scheme.hpp"
#include "output.hpp"
#include "sidecar.hpp"

namespace study {

namespace {

std::vector<std::string> grading_options() {
    std::vector<std::string> names;
    for (const rollbem::TopologyInfo::Grading& known : rollbem::gradings) names.push_back(option_of(known.name));
    return names;
}

/// "--one, --two or --three"; of NAME=VALUE "--name one or two".
std::string dashed(std::vector<std::string> modes, const std::string& last) {
    std::string name = "--";
    for (std::string& mode : modes) {
        const std::size_t equals = mode.find('=');
        if (equals != std::string::npos) name = "--" + mode.substr(0, equals) + " ";
        mode = equals == std::string::npos ? "--" + mode : mode.substr(equals + 1);
    }
    return (name == "--" ? "" : name) + listed(modes, last);
}

}  // namespace

std::vector<std::string> mesh_names() {
    std::vector<std::string> names;
    for (const rollbem::TopologyInfo& known : rollbem::topologies) names.emplace_back(known.name);
    return names;
}

std::string option_of(std::string column) {
    std::replace(column.begin(), column.end(), '_', '-');
    return column;
}

Options::Options(std::string program, const std::string& purpose)
    : program_(std::move(program)), app_(std::make_unique<CLI::App>(purpose, program_)) {
    const auto lay_out = [](auto& formatter) {
        formatter.column_width(28);
        // lines are wrapped here, also for a CLI11 (from 2.5 on) that would wrap them again
        if constexpr (requires { formatter.right_column_width(0); }) {
            constexpr std::size_t unlimited = 1 << 20;
            formatter.right_column_width(unlimited);
            formatter.description_paragraph_width(unlimited);
            formatter.footer_paragraph_width(unlimited);
        }
    };
    lay_out(*app_->get_formatter());
    app_->set_help_flag("-h,--help", "print this help and exit")->group("Program");
    app_->set_version_flag("--version", version())->group("Program");
    app_->get_option("--version")->description("print version and git revision and exit");
    group("Program");
    add_input("config",
              "file of options, one NAME = VALUE a line, e.g. alpha-T = 0.63, mesh = cosine or n = 10,20; a FILE.toml "
              "next to results repeats that run, without its outputs and --jobs. The command line takes precedence. "
              "Here, as for every FILE that is read but profiles, - is standard input");

    group("Discretisation");
    not_with(joined<std::string>(joined<std::string>({"mesh", "edges"}, grading_options()), {"derivative"}),
             "method=chebyshev", ", which has no elements");
    add("n", "LIST", "number of elements of the contact [dimensionless], 1 to 100000", "20,40,60").not_with("edges");
    add("mesh", "NAME", "mesh of the elements: " + listed(mesh_names(), "or"), "uniform").not_with("edges");
    add_input("edges",
              "file of the elements' edges x/a [dimensionless], ascending from -1 to 1, one per line, in place of "
              "--mesh and --n");
    for (const rollbem::TopologyInfo::Grading& grading : rollbem::gradings) {
        std::vector<std::string> meshes;
        for (const rollbem::TopologyInfo& known : rollbem::topologies) {
            if (known.grading == grading.name) meshes.push_back(std::string("mesh=") + known.name);
        }
        const std::string meaning = grading.meaning;
        add(option_of(grading.name), "LIST", meaning + " [dimensionless], 1e-12 to 1e12", Cell(grading.usual).text())
            .not_with("edges")
            .only_with(meshes);
    }
    add("method", "NAME",
        "method of discretisation: collocation, galerkin, knothe-bc (boundary conditions of Knothe and Gross-Thebing) "
        "or nodes (differences between the --nodes of neighbouring elements)",
        "collocation");
    add("nodes", "NAME", "positions of the nodes: centres of the elements, or chebyshev points of a --mesh cosine",
        "centres")
        .only_with({"method=nodes"});
    add("quadrature", "N|exact",
        "number of Gauss-Legendre points [dimensionless], 1 to 1000, or exact: the integrals in closed form", "exact")
        .only_with({"method=galerkin"});
    add("alpha-L", "LIST",
        "position of the leading element's point (galerkin: middle of its interval) ahead of the element's centre, "
        "over its width [dimensionless], -2 to 2",
        "0")
        .not_with("alpha");
    add("alpha-T", "LIST",
        "position of the trailing element's point, likewise [dimensionless], -2 to 2; alpha is linear in between",
        "0.63")
        .not_with("alpha");
    add("alpha", "LIST", "common value of alpha-L and alpha-T [dimensionless], -2 to 2");
    add("lambda", "LIST", "factor on all alphas where G is evaluated [dimensionless], 0 to 1", "1");
    only_with({"alpha-L", "alpha-T", "alpha", "lambda"}, {"method=collocation", "method=galerkin"});
    add("derivative", "NAME",
        "form of the derivative along x: fd (finite differences), fd4 (of fourth order; not for galerkin) or analytic; "
        "default fd, but analytic for galerkin with exact quadrature");
    not_with({"derivative"}, "method=nodes", ", which takes differences");
    add("scheme", "LIST", scheme_help());
    not_with(joined<std::string>({"mesh", "edges", "method", "nodes", "quadrature", "derivative", "alpha-L", "alpha-T",
                                  "alpha", "lambda"},
                                 grading_options()),
             "scheme");

    group("Contact");
    add("kernel", "NAME", "model of elasticity: strip (rectangle of half-width b) or plane (its limit b >> a)",
        "strip");
    add("aspect", "LIST",
        "ratio b/a of half-width and half-length [dimensionless], above 0, inf in steady problems; steady results of "
        "the plane kernel do not depend on it",
        "1000");
    add("poisson", "LIST", "Poisson's ratio [dimensionless], 0 to 0.5", "0.28");

    group("Output");
    add_table("output",
              "CSV file of the results, with FILE.toml next to it, which records how it was made and can be given to "
              "--config; - is standard output. Without it rows go to standard output, as CSV into files and pipes; on "
              "a terminal people get a table of what varies and its results");
    add_flag("csv", "CSV on standard output, also on a terminal");
    add_output("plot", "picture of the results, drawn by gnuplot; FILE ends in .svg or .png; none without it");
    add("jobs", "N",
        "number of rows computed at a time [dimensionless], 1 to 1024; above 1 the columns of times stay empty", "1");
    add("shard", "K/N",
        "block of rows to compute: the K-th of N [dimensionless], 1 <= K <= N <= 1000000; the files of all blocks, one "
        "after the other, are the whole table; all rows without it");
    add_flag("no-timing", "columns of times left empty, so that equal runs give equal files");
    add_flag("quiet", "no progress line");
    group("Study");
}

Options::Options(Options&&) noexcept = default;
Options::~Options() = default;

Options::Added Options::add(const std::string& name, const std::string& value, const std::string& help, Kind kind) {
    const std::string nothing;
    const std::string names = (kind == Kind::argument ? name + "," : "") + "--" + name;
    CLI::Option* option =
        kind == Kind::flag ? app_->add_flag(names) : app_->add_option(names, nothing)->type_name(value);
    // Every use of the option is kept; how many there may be is checked when its values are read.
    if (kind != Kind::flag) option->type_size(1)->expected(1);
    option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->group(group_);
    entries_[name] = {option, help, "", kind};
    set_default(name, "");
    return {*this, name};
}

Options::Added Options::add(const std::string& name, const std::string& value, const std::string& help,
                            const std::string& default_text) {
    add(name, value, help, Kind::value);
    set_default(name, default_text);
    return {*this, name};
}

Options::Added Options::add_flag(const std::string& name, const std::string& help) {
    return add(name, "", help, Kind::flag);
}

const Options::Added& Options::Added::only_with(const std::vector<std::string>& modes, const std::string& why) const {
    Entry& entry = options.entries_.at(name);
    entry.condition = "; only with " + dashed(modes, "or");
    options.set_default(name, entry.default_text);
    options.only_with({name}, modes, why);
    return *this;
}

const Options::Added& Options::Added::not_with(const std::string& mode, const std::string& why) const {
    options.not_with({name}, mode, why);
    return *this;
}

bool Options::is_on(const std::string& mode) const {
    const std::size_t equals = mode.find('=');
    if (equals != std::string::npos) return text(mode.substr(0, equals)) == mode.substr(equals + 1);
    return entry(mode).kind == Kind::flag ? flag(mode) : given(mode);
}

void Options::apply_limits() {
    for (const Limit& limit : limits_) {
        const auto mode = entries_.find(limit.modes.front());
        if (limit.needs || mode == entries_.end()) continue;
        Entry& own = entries_.at(limit.name);
        if (own.typed()) mode->second.configured.clear();
        if (mode->second.typed()) own.configured.clear();
    }
    for (const Limit& limit : limits_) {
        const std::string& first = limit.modes.front();
        const std::size_t equals = first.find('=');
        const std::string option = first.substr(0, equals);
        if (!entry(option).refusal.empty()) continue;  // the study has modes of its own
        const bool on =
            std::any_of(limit.modes.begin(), limit.modes.end(), [&](const auto& one) { return is_on(one); });
        if (on == limit.needs) continue;
        const bool by_value = limit.needs && equals != std::string::npos;
        ignored(limit.name,
                (by_value      ? "with --" + option + " " + text(option) + "; it is for " + dashed(limit.modes, "and")
                 : limit.needs ? "without " + dashed(limit.modes, "or")
                               : "with " + dashed(limit.modes, "or")) +
                    limit.why);
    }
}

void Options::set_default(const std::string& name, const std::string& default_text) {
    Entry& entry = entries_.at(name);
    entry.default_text = default_text;
    const std::string shown = default_text.empty() ? "" : "; default " + default_text;
    entry.option->description(wrap(entry.help + shown + entry.condition, 82));
}

void Options::set_help(const std::string& name, const std::string& help, const std::string& value) {
    Entry& entry = entries_.at(name);
    entry.help = help;
    if (!value.empty()) entry.option->type_name(value);
    set_default(name, entry.default_text);
}

void Options::refuse(const std::string& name, const std::string& reason) {
    entries_.at(name).option->group("");
    entries_.at(name).refusal = reason;
}

void Options::refuse_group(const std::string& heading, const std::string& reason,
                           const std::vector<std::string>& allowed) {
    for (const auto& [name, entry] : entries_) {
        if (entry.option->get_group() == heading && !contains(allowed, name)) refuse(name, reason);
    }
}

void Options::footer(const std::string& text) {
    app_->footer(
        text +
        "\nExit codes: 0 done; 1 a run or the program failed; 2 bad input or output that cannot be written; "
        "3 no picture, as gnuplot\nis missing or fails or no row has a point to draw (the CSV is written); 4 error "
        "while writing; 130 interrupted.");
}

std::optional<std::string> Options::parse(int argc, const char* const* argv) {
    words_.assign(argv, argv + argc);
    try {
        app_->parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::string help = app_->help();
        for (std::size_t i = 0; (i = help.find("\n\n\n", i)) != std::string::npos;) help.erase(i, 1);
        return help;
    } catch (const CLI::CallForVersion&) {
        return version() + "\n";
    } catch (const CLI::ExtrasError&) {
        std::string unknown;
        for (std::string word : app_->remaining()) {  // an unknown option leaves its value behind, too
            if (word.size() < 2 || word[0] != '-' || std::isdigit(static_cast<unsigned char>(word[1])) != 0) continue;
            word.erase(std::min(word.find('='), word.size()));
            unknown += (unknown.empty() ? "" : "; ") + word + " is not an option" + suggestion(word);
        }
        throw BadInput((unknown.empty() ? join(app_->remaining(), " ") + " was not expected" : unknown) +
                       "; see --help");
    } catch (const CLI::ParseError& error) {
        for (const auto& [name, entry] : entries_) {  // of an option that is not shown CLI11 does not say the name
            if (entry.refusal.empty() || !contains(words_, "--" + name)) continue;
            throw BadInput("--" + name + " cannot be used here: " + entry.refusal);
        }
        throw BadInput(std::string(error.what()) + "; see --help");
    }
    for (const auto& [name, entry] : entries_) {  // CLI11 takes the next word for a value that is missing
        for (const std::string& value : entry.option->results()) {
            if (value.rfind("--", 0) != 0) continue;
            throw BadInput("--" + name + " must have a value: " + value + " is another option");
        }
    }
    if (given("config")) read_config();
    for (const auto& [name, entry] : entries_) {
        if (entry.kind == Kind::flag) flag(name);  // is true or false
    }
    for (const auto& [name, entry] : entries_) {
        if (entry.refusal.empty() || !given(name)) continue;
        throw BadInput(said(name) + " cannot be used here: " + entry.refusal);
    }
    check_files();
    apply_limits();
    return std::nullopt;
}

namespace {

/// A line of a configuration file, NAME = VALUE, or a list that goes on over lines.
struct Setting {
    std::string name, where;          ///< `where` as Lines::where
    std::vector<std::string> values;  ///< none after a name alone
};

/// The next setting, read by CLI11, which passes over what it does not understand: that is refused here, by its line.
std::optional<Setting> next_setting(Lines& lines) {
    do {
        if (!lines.next()) return std::nullopt;
    } while (lines.text()[0] == ';');
    const std::string where = lines.where(), shown = where + " = " + lines.text();
    const auto require = [&](bool holds, const char* what) {
        if (!holds) throw BadInput(shown + " must " + what);
    };
    std::string text = lines.text();
    require(text[0] != '[', "not be there: a configuration file has no sections");
    const std::size_t equals = text.find('=');
    const bool is_name = equals == std::string::npos;
    require(is_name || equals + 1 < text.size(), "have a value");
    const bool is_list = !is_name && rollbem::detail::trimmed(std::string_view(text).substr(equals + 1))[0] == '[';
    while (is_list && text.find(']') == std::string::npos) {
        if (!lines.next()) throw BadInput(where + ": each [ must have its ]");
        const char last = text.back(), next = lines.text()[0];
        if (last != '[' && last != ',' && next != ']' && next != ',') {
            throw BadInput(lines.where() + " = " + lines.text() + " must follow a comma");
        }
        text += lines.text();
    }
    require(!is_list || text.find(']') + 1 == text.size(), "end with its ]");
    require(is_list || text.back() != ',', "be a list without empty items");
    CLI::ConfigBase format;
    format.comment('\0');  // a # within a value is no comment
    std::istringstream one(is_name ? text + " = true" : text);
    const CLI::ConfigItem item = format.from_config(one).at(0);
    require(item.parents.empty(), "name an option without a section");
    Setting setting{item.name, where, {}};
    if (is_name) return setting;
    for (const std::string& value : item.inputs) setting.values.emplace_back(rollbem::detail::trimmed(value));
    require(setting.values.size() < 2 || !contains(setting.values, ""), "be a list without empty items");
    if (!is_list && text.find(',', equals) < text.size()) setting.values = {join(setting.values, ",")};
    return setting;
}

}  // namespace

void Options::read_config() {
    const std::string text = contents(*this, "config");
    const auto malformed = [&](const std::string& what) { return BadInput(said("config") + ": " + what); };
    replays_ = text.rfind(sidecar_start, 0) == 0;
    if (replays_) {
        const std::size_t start = std::string(sidecar_start).size();
        const std::string program = text.substr(start, text.find_first_of("\r\n") - start);
        if (program != program_) throw malformed("program = " + program + " must be " + program_);
    }
    if (text.find("[given]") != std::string::npos) {
        throw malformed("must be of version 0.5 or later; give the command_line in it instead");
    }
    Lines lines(said("config"), text);
    while (const std::optional<Setting> setting = next_setting(lines)) {
        const auto found = entries_.find(setting->name);
        const std::string where = setting->where + ": " + setting->name, value = join(setting->values, ",");
        if (found == entries_.end() || setting->name == "config") {
            throw BadInput(where + " must be an option of " + program_ + suggestion(setting->name) + "; see --help");
        }
        const bool is_flag = found->second.kind == Kind::flag;
        if (value.empty() && !is_flag) throw BadInput(where + " must have a value");
        if (is_flag && value != "" && value != "true" && value != "false") {
            throw BadInput(where + " = " + value + " must be true or false");
        }
        std::vector<std::string>& values = found->second.configured;
        if (is_flag) values = {value == "false" ? "false" : "true"};
        if (!is_flag) values.insert(values.end(), setting->values.begin(), setting->values.end());
    }
}

void Options::say_doubts() const {
    for (const std::string& doubt : doubts_) {
        std::fprintf(stderr, "%s: note: %s\n", program_.c_str(), printable(doubt).c_str());
    }
}

std::string Options::version() const {
    return program_ + " " + std::string(build_info::version) + " (" + std::string(build_info::git_revision) + ")";
}

bool Options::Entry::typed() const { return option->count() > 0; }

std::vector<std::string> Options::raw(const std::string& name) const {
    if (entry(name).typed()) return entry(name).option->results();
    if (!entry(name).configured.empty()) return entry(name).configured;
    const std::string& default_text = entry(name).default_text;
    return default_text.empty() ? std::vector<std::string>{} : std::vector<std::string>{default_text};
}

int run_guarded(const std::string& program, const std::function<int()>& body) {
    const auto report = [&](const std::exception& error, ExitCode code) {
        std::fprintf(stderr, "%s: %s\n", program.c_str(), printable(error.what()).c_str());
        return code;
    };
    gsl_set_error_handler_off();  // the default handler aborts the program
    handle_signals();
    try {
        return body();
    } catch (const std::invalid_argument& error) {
        return report(error, exit_bad_input);
    } catch (const std::bad_alloc&) {
        return report(BadInput("not enough memory; --n must be smaller"), exit_bad_input);
    } catch (const Unread&) {
        return exit_ok;
    } catch (const PlotError& error) {
        return report(error, exit_no_plot);
    } catch (const WriteError& error) {
        return report(error, exit_write_error);
    } catch (const std::exception& error) {
        return report(error, exit_failed);
    }
}

int run_program(Options& options, int argc, const char* const* argv, const std::function<int(const Options&)>& body) {
    return run_guarded(options.program(), [&]() -> int {
        const std::optional<std::string> text = options.parse(argc, argv);
        if (!text) return body(options);
        OutputFile standard_output = OutputFile::standard_output();
        standard_output.write(*text);
        standard_output.commit();
        return exit_ok;
    });
}

}  // namespace study
