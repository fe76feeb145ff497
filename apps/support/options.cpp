#include "options.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <sstream>

#include <CLI/CLI.hpp>

#include "build_info.hpp"
#include "config_file.hpp"
#include "files.hpp"
#include "mesh_names.hpp"
#include "nearest_name.hpp"

namespace study {

namespace {

// `what` is expected: "a number" of a list, or "one number".
double to_number(const std::string& name, const std::string& text, const std::string& what, const Rule& rule) {
    const std::optional<double> value = detail::parse_number<double>(text);
    if (!value) throw BadInput("--" + name + " = " + text + " must be " + what + ", and it must " + rule.text);
    if (!rule.holds(*value)) throw BadInput("--" + name + " = " + text + " must " + rule.text);
    return *value;
}

std::ptrdiff_t to_integer(const std::string& name, const std::string& text, std::ptrdiff_t low, std::ptrdiff_t high) {
    const std::optional<std::ptrdiff_t> value = detail::parse_number<std::ptrdiff_t>(text);
    if (!value || *value < low || *value > high) {
        throw BadInput("--" + name + " = " + text + " must be an integer in [" + std::to_string(low) + ", " +
                       std::to_string(high) + "]");
    }
    return *value;
}

/// "--one, --two or --three"
std::string dashed(std::vector<std::string> names) {
    for (std::string& name : names) name.insert(0, "--");
    return listed(names, "or");
}

}  // namespace

Rule between(double low, double high) {
    std::ostringstream text;
    text.precision(12);
    text << "lie in [" << low << ", " << high << "]";
    return {[=](double value) { return value >= low && value <= high; }, text.str()};
}

Rule finite() {
    return {[](double value) { return std::isfinite(value); }, "be finite"};
}

Rule positive() {
    return {[](double value) { return value > 0 && std::isfinite(value); }, "be positive and finite"};
}

Rule positive_or_infinite() {
    return {[](double value) { return value > 0; }, "be positive (inf is allowed)"};
}

std::string_view detail::trim(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string checksum(std::string_view text) {
    std::uint64_t hash = 14695981039346656037u;  // FNV-1a
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    std::array<char, 32> result;
    std::snprintf(result.data(), result.size(), "fnv1a64:%016llx", static_cast<unsigned long long>(hash));
    return result.data();
}

std::string wrap(const std::string& text, std::size_t width) {
    std::istringstream words(text);
    std::string word, result;
    std::size_t column = 0;
    while (words >> word) {
        if (column > 0) {
            const bool breaks = column + 1 + word.size() > width;
            result += breaks ? '\n' : ' ';
            column = breaks ? 0 : column + 1;
        }
        result += word;
        column += word.size();
    }
    return result;
}

std::string join(const std::vector<std::string>& words, const std::string& separator) {
    return CLI::detail::join(words, separator);
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
              "read options from a TOML file, e.g. alpha-T = 0.63, mesh = \"cosine\" or n = [10, 20]; or from a "
              "FILE.toml beside results, to repeat that run without its outputs and --jobs. The command line takes "
              "precedence. Every input FILE may be -, standard input");

    group("Discretisation");
    add("n", "LIST", "number of elements of the contact, 1 to 100000 (dimensionless)", "20,40,60");
    add("mesh", "NAME", listed(mesh_names(), "or"), "uniform");
    add_input("edges", "instead of --mesh and --n: edges x/a from -1 to 1, one per line (dimensionless)");
    add("size-ratio", "LIST",
        join(mesh_names(rollbem::Grading::size_ratio), ", ") +
            " mesh: dx_trailing / dx_leading, 1e-12 to 1e12 (dimensionless)",
        "2");
    add("epsilon", "LIST",
        join(mesh_names(rollbem::Grading::epsilon), ", ") +
            " mesh: size of the end element over that of an inner one, 1e-12 to 1e12 (dimensionless)",
        "0.4");
    add("method", "NAME",
        "collocation, galerkin, knothe-bc (Knothe and Gross-Thebing's boundary conditions) or nodes (differences "
        "between the --nodes of neighbouring elements)",
        "collocation");
    add("nodes", "NAME", "with --method nodes: centres of elements, or chebyshev with --mesh cosine", "centres");
    add("quadrature", "N|exact", "galerkin: 1 to 1000 Gauss-Legendre points (dimensionless) or closed form", "exact");
    add("alpha-L", "LIST",
        "position of the leading element's point ahead of its centre, in widths of the element, -2 to 2 "
        "(dimensionless)",
        "0");
    add("alpha-T", "LIST", "the same at the trailing element, -2 to 2; linear in between (dimensionless)", "0.63");
    add("alpha", "LIST", "sets alpha-L and alpha-T to the same values, -2 to 2 (dimensionless)");
    add("lambda", "LIST", "G is taken at lambda times these alphas, 0 to 1 (dimensionless)", "1");
    add("derivative", "NAME", "fd or analytic; default: fd, but analytic for galerkin with exact quadrature");

    replaces("alpha", {"alpha-L", "alpha-T"});
    replaces("edges", {"n", "mesh", "size-ratio", "epsilon"});
    not_with({"alpha-L", "alpha-T"}, "alpha");
    not_with({"mesh", "n"}, "edges");

    group("Contact");
    add("kernel", "NAME", "strip (half-width b) or plane (its limit b >> a)", "strip");
    add("aspect", "LIST",
        "b/a, above 0; inf in steady problems (dimensionless). With the plane kernel no steady result depends on it",
        "1000");
    add("poisson", "LIST", "Poisson's ratio, 0 to 0.5 (dimensionless)", "0.28");

    group("Output");
    add_table("output",
              "CSV file; FILE.toml beside it says how it was made, for people and for --config. Default, and -: "
              "standard output");
    add_output("plot", "draw the result with gnuplot; FILE ends in .svg or .png");
    add("jobs", "N", "rows computed at a time, 1 to 1024; above 1 the columns of times stay empty (dimensionless)",
        "1");
    add("shard", "K/N",
        "only the K-th of N blocks of rows, 1 <= K <= N <= 1000000; the parts concatenate to the whole "
        "(dimensionless)");
    add_flag("no-timing", "leave the columns of times empty, so that equal runs give equal files");
    add_flag("quiet", "no progress line");
    group("Study");
}

Options::Options(Options&&) noexcept = default;
Options::~Options() = default;

void Options::group(const std::string& heading) { group_ = heading; }

Options::Added Options::add(const std::string& name, const std::string& value, const std::string& help,
                            const std::string& default_text) {
    const std::string nothing;
    CLI::Option* option = app_->add_option("--" + name, nothing);
    // Every use of the option is kept; how many there may be is checked when its values are read.
    option->type_name(value)->type_size(1)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    option->group(group_);
    entries_[name] = {option, help, ""};
    set_default(name, default_text);
    return {*this, name};
}

Options::Added Options::add_file(const std::string& name, const std::string& help, Kind kind) {
    add(name, "FILE", help);
    entries_[name].kind = kind;
    return {*this, name};
}

Options::Added Options::add_input(const std::string& name, const std::string& help) {
    return add_file(name, help, Kind::input);
}

Options::Added Options::add_output(const std::string& name, const std::string& help) {
    return add_file(name, help, Kind::output);
}

Options::Added Options::add_table(const std::string& name, const std::string& help) {
    return add_file(name, help, Kind::table);
}

Options::Added Options::add_folder(const std::string& name, const std::string& help, std::vector<std::string> files) {
    add(name, "DIR", help);
    entries_[name].kind = Kind::folder;
    entries_[name].files = std::move(files);
    return {*this, name};
}

Options::Added Options::add_flag(const std::string& name, const std::string& help) {
    CLI::Option* option = app_->add_flag("--" + name);
    option->group(group_);
    entries_[name] = {option, help, "", Kind::flag};
    set_default(name, "");
    return {*this, name};
}

const Options::Added& Options::Added::only_with(const std::vector<std::string>& modes, const std::string& why) const {
    const std::string shown = options_.entry(name_).help;
    options_.set_help(name_, "with " + dashed(modes) + ": " + shown);
    options_.only_with({name_}, modes, why);
    return *this;
}

const Options::Added& Options::Added::not_with(const std::string& mode, const std::string& why) const {
    options_.not_with({name_}, mode, why);
    return *this;
}

void Options::not_with(const std::vector<std::string>& names, const std::string& mode, const std::string& why) {
    for (const std::string& name : names) limits_.push_back({name, {mode}, false, why});
}

void Options::only_with(const std::vector<std::string>& names, const std::vector<std::string>& modes,
                        const std::string& why) {
    for (const std::string& name : names) limits_.push_back({name, modes, true, why});
}

void Options::check_limits() const {
    const auto is_on = [&](const std::string& mode) {
        return entry(mode).kind == Kind::flag ? flag(mode) : given(mode);
    };
    for (const Limit& limit : limits_) {
        const bool on = std::any_of(limit.modes.begin(), limit.modes.end(), is_on);
        if (on == limit.needs) continue;
        ignored(limit.name, (limit.needs ? "without " : "with ") + dashed(limit.modes) + limit.why);
    }
}

void Options::set_default(const std::string& name, const std::string& default_text) {
    Entry& entry = entries_.at(name);
    entry.default_text = default_text;
    const std::string shown = default_text.empty() ? "" : "; default " + default_text;
    entry.option->description(wrap(entry.help + shown, 82));
}

void Options::set_help(const std::string& name, const std::string& help) {
    Entry& entry = entries_.at(name);
    entry.help = help;
    set_default(name, entry.default_text);
}

void Options::refuse(const std::string& name, const std::string& reason) {
    entries_.at(name).option->group("");
    refused_.emplace_back(name, reason);
}

void Options::refuse_group(const std::string& heading, const std::string& reason,
                           const std::vector<std::string>& allowed) {
    for (const std::string& name : members(heading, allowed)) refuse(name, reason);
}

void Options::footer(const std::string& text, std::vector<Topic> topics) {
    topics_ = std::move(topics);
    std::string listed = topics_.empty() ? "" : "\nMore by --help TOPIC:\n";
    for (const Topic& topic : topics_) {
        listed += "  " + topic.name + std::string(topic.name.size() < 11 ? 11 - topic.name.size() : 1, ' ') +
                  topic.summary + "\n";
    }
    app_->footer(
        text + listed +
        "\nExit codes: 0 done; 1 a run or the program failed; 2 bad input or output that cannot be written; "
        "3 no picture, as gnuplot\nis missing or fails or no row has a point to draw (the CSV is written); 4 error "
        "while writing; 130 interrupted.");
}

void Options::replaces(const std::string& name, std::vector<std::string> others) {
    alternatives_.emplace_back(name, std::move(others));
}

std::optional<std::string> Options::parse(int argc, const char* const* argv) {
    words_.assign(argv, argv + argc);
    if (std::optional<std::string> text = topic()) return text;
    check_words();
    try {
        app_->parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        std::string help = app_->help();
        for (std::size_t i = 0; (i = help.find("\n\n\n", i)) != std::string::npos;) help.erase(i, 1);
        return help;
    } catch (const CLI::CallForVersion&) {
        return version() + "\n";
    } catch (const CLI::ExtrasError&) {
        throw BadInput(unexpected() + "; see --help");
    } catch (const CLI::ParseError& error) {
        // of an option that is not shown CLI11 does not say the name
        for (const auto& [name, reason] : refused_) {
            if (std::find(words_.begin(), words_.end(), "--" + name) != words_.end()) {
                throw BadInput("--" + name + " cannot be used here: " + reason);
            }
        }
        throw BadInput(std::string(error.what()) + "; see --help");
    }
    if (given("config")) {
        check_inputs();
        read_config();
        drop_replaced();
    }
    for (const auto& [name, reason] : refused_) {
        if (given(name)) throw BadInput(said(name) + " cannot be used here: " + reason);
    }
    check_files();
    check_limits();
    return std::nullopt;
}

const std::string& Options::program() const { return program_; }

const std::vector<std::string>& Options::words() const { return words_; }

bool Options::given(const std::string& name) const {
    return entry(name).option->count() > 0 || !entry(name).configured.empty();
}

std::string Options::said(const std::string& name) const {
    const std::string value = joined(name);
    return "--" + name + " = " + (value.empty() ? "''" : value);
}

void Options::ignored(const std::string& name, const std::string& reason) const {
    if (given(name)) throw BadInput(said(name) + " has no effect " + reason);
}

void Options::ignored_group(const std::string& heading, const std::string& reason,
                            const std::vector<std::string>& allowed) const {
    for (const std::string& name : members(heading, allowed)) ignored(name, reason);
}

bool Options::flag(const std::string& name) const {
    if (!given(name)) return false;
    const std::string value = raw(name).back();
    if (value != "true" && value != "false") throw BadInput("--" + name + " = " + value + " must be true or false");
    return value == "true";
}

std::string Options::text(const std::string& name) const {
    const std::vector<std::string> values = raw(name);
    if (values.size() > 1) throw BadInput(said(name) + " must be a single value");
    if (given(name) && values.front().empty()) throw BadInput(said(name) + " must not be empty");
    return values.empty() ? std::string() : values.front();
}

std::string Options::choice(const std::string& name, const std::vector<std::string>& names) const {
    const std::string value = text(name);
    if (std::find(names.begin(), names.end(), value) == names.end()) {
        throw BadInput(said(name) + " must be one of " + join(names, ", "));
    }
    return value;
}

double Options::number(const std::string& name, const Rule& rule) const {
    return to_number(name, text(name), "one number", rule);
}

std::optional<std::pair<double, double>> Options::pair(const std::string& name) const {
    const std::string value = text(name);
    const std::size_t comma = std::min(value.find(','), value.size());
    const auto read = [](std::string_view part) { return detail::parse_number<double>(detail::trim(part)); };
    const auto first = read(std::string_view(value).substr(0, comma));
    const auto second = comma < value.size() ? read(std::string_view(value).substr(comma + 1)) : std::nullopt;
    if (!first || !second || !std::isfinite(*first) || !std::isfinite(*second)) return std::nullopt;
    return std::pair(*first, *second);
}

std::ptrdiff_t Options::integer(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const {
    return to_integer(name, text(name), low, high);
}

template <class Number, class Read>
std::vector<Number> Options::list(const std::string& name, const Read& read) const {
    std::vector<Number> result;
    for (const std::string& text : raw(name)) {
        std::size_t begin = 0;
        while (begin <= text.size()) {
            const std::size_t end = std::min(text.find(',', begin), text.size());
            const std::string item(detail::trim(std::string_view(text).substr(begin, end - begin)));
            if (item.empty()) throw BadInput(said(name) + " must be a list without empty items");
            const Number value = read(item);
            if (std::find(result.begin(), result.end(), value) != result.end()) {
                throw BadInput(said(name) + " must be a list without repeated items: " + item + " is there twice");
            }
            result.push_back(value);
            begin = end + 1;
        }
    }
    return result;
}

std::vector<double> Options::numbers(const std::string& name, const Rule& rule) const {
    return list<double>(name, [&](const std::string& item) { return to_number(name, item, "a number", rule); });
}

std::vector<std::ptrdiff_t> Options::integers(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const {
    return list<std::ptrdiff_t>(name, [&](const std::string& item) { return to_integer(name, item, low, high); });
}

std::vector<std::string> Options::choices(const std::string& name, const std::vector<std::string>& known) const {
    const auto contains = [](const std::vector<std::string>& words, const std::string& word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    const std::vector<std::string> given = list<std::string>(name, [&](const std::string& item) {
        if (item == "all" || contains(known, item)) return item;
        throw BadInput("--" + name + " = " + item + " must be all, or some of " + join(known, ","));
    });
    std::vector<std::string> result;
    for (const std::string& word : known) {
        if (contains(given, "all") || contains(given, word)) result.push_back(word);
    }
    return result;
}

std::vector<std::pair<std::string, std::string>> Options::given_values() const {
    // in the order typed, and then those of the configuration file
    std::vector<std::string> names;
    for (const CLI::Option* option : app_->parse_order()) names.push_back(option->get_lnames().front());
    for (const auto& [name, entry] : entries_) {
        if (given(name)) names.push_back(name);
    }
    std::vector<std::pair<std::string, std::string>> result;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string& name = names[i];
        const bool before =
            std::find(names.begin(), names.begin() + std::ptrdiff_t(i), name) - names.begin() < std::ptrdiff_t(i);
        if (before || name == "config") continue;
        result.emplace_back(name, entry(name).kind == Kind::flag ? raw(name).back() : joined(name));
    }
    return result;
}

std::vector<std::pair<std::string, std::string>> Options::values() const {
    std::vector<std::pair<std::string, std::string>> result;
    for (const auto& [name, entry] : entries_) {
        if (name == "config") continue;  // what it says is listed under the other names
        const bool is_refused = entry.option->get_group().empty();
        if (!is_refused && !raw(name).empty()) result.emplace_back(name, joined(name));
    }
    return result;
}

void Options::note_input(const std::string& name, std::string_view contents) const {
    if (name == "config") return;
    const std::string text = checksum(contents);
    const auto expected = expected_.find(name);
    if (expected != expected_.end() && expected->second != text) {
        std::fprintf(stderr, "%s: %s is not as it was in the run that %s repeats\n", program_.c_str(),
                     said(name).c_str(), said("config").c_str());
    }
    inputs_[name] = text;
}

std::string Options::version() const {
    return program_ + " " + std::string(build_info::version) + " (" + std::string(build_info::git_revision) + ")";
}

void Options::read_config() {
    Config config = study::read_config(contents(*this, "config"), said("config"));
    replays_ = config.is_sidecar;
    expected_ = std::move(config.inputs);
    if (replays_ && !config.program.empty() && config.program != program_) {
        throw BadInput(said("config") + ": program = " + config.program + " must be " + program_ +
                       ", whose run this is to repeat");
    }
    for (Setting& setting : config.settings) {
        const auto found = entries_.find(setting.name);
        if (found == entries_.end() || setting.name == "config") {
            throw BadInput(setting.where + " must name an option of " + program_ + suggestion(setting.name) +
                           "; see --help");
        }
        const Kind kind = found->second.kind;
        const bool writes = kind == Kind::output || kind == Kind::table || kind == Kind::folder;
        if (replays_ && (writes || setting.name == "jobs")) continue;
        const bool is_truth =
            setting.values.size() == 1 && (setting.values[0] == "true" || setting.values[0] == "false");
        if (kind == Kind::flag && !is_truth) throw BadInput(setting.where + " must be true or false");
        found->second.configured = std::move(setting.values);
    }
}

std::optional<std::string> Options::topic() const {
    const auto help = std::find_if(words_.begin(), words_.end(), [](const std::string& word) {
        return word == "-h" || word == "--help" || word.rfind("--help=", 0) == 0;
    });
    if (topics_.empty() || help == words_.end()) return std::nullopt;
    const std::size_t equals = help->find('=');
    const bool follows = equals == std::string::npos && help + 1 != words_.end() && help[1].rfind('-', 0) != 0;
    if (equals == std::string::npos && !follows) return std::nullopt;
    const std::string name = follows ? help[1] : help->substr(equals + 1);
    std::vector<std::string> names;
    for (const Topic& topic : topics_) {
        if (topic.name == name) return topic.text;
        names.push_back(topic.name);
    }
    throw BadInput("--help = " + name + " must be one of " + join(names, ", "));
}

void Options::check_words() const {
    for (std::size_t i = 1; i < words_.size(); ++i) {
        const std::string& word = words_[i];
        const std::size_t equals = std::min(word.find('='), word.size());
        const auto found = word.rfind("--", 0) == 0 ? entries_.find(word.substr(2, equals - 2)) : entries_.end();
        if (found == entries_.end() || found->second.kind == Kind::flag) continue;
        if (equals + 1 == word.size()) throw BadInput(word.substr(0, equals) + " = '' must not be empty");
        if (equals < word.size() || i + 1 == words_.size()) continue;
        ++i;
        if (words_[i].rfind("--", 0) == 0) {
            throw BadInput(word + " must have a value: " + words_[i] + " is another option");
        }
    }
}

void Options::drop_replaced() {
    const auto typed = [&](const std::string& name) { return entry(name).option->count() > 0; };
    for (const auto& [name, others] : alternatives_) {
        const bool drops = std::any_of(others.begin(), others.end(), typed);
        for (const std::string& other : others) {
            if (typed(name)) entries_.at(other).configured.clear();
        }
        if (drops) entries_.at(name).configured.clear();
    }
}

std::string Options::suggestion(std::string word) const {
    word.erase(0, std::min(word.find_first_not_of('-'), word.size()));
    std::vector<std::string> names{"help", "version"};
    for (const auto& [name, entry] : entries_) {
        if (!entry.option->get_group().empty()) names.push_back(name);
    }
    const std::string name = nearest_name(word, names);
    return name.empty() ? "" : "; did you mean --" + name + "?";
}

std::string Options::unexpected() const {
    // an unknown option leaves its value behind, too
    const auto is_option = [](const std::string& word) {
        return word.size() > 1 && word[0] == '-' && std::isdigit(static_cast<unsigned char>(word[1])) == 0;
    };
    const std::vector<std::string> words = app_->remaining();
    std::vector<std::string> options;
    std::copy_if(words.begin(), words.end(), std::back_inserter(options), is_option);
    if (options.empty()) return join(words, " ") + " was not expected";
    for (std::string& option : options) {
        option.erase(std::min(option.find('='), option.size()));
        option += " is not an option" + suggestion(option);
    }
    return join(options, "; ");
}

void Options::check_inputs() const {
    std::string first;
    for (const auto& [name, entry] : entries_) {
        if (entry.kind != Kind::input || !given(name) || text(name) != "-") continue;
        if (!first.empty()) {
            throw BadInput(said(name) + " must be a file: standard input is read as " + first);
        }
        first = said(name);
    }
}

void Options::check_files() const {
    check_inputs();
    struct File {
        std::string said, path;
        bool is_sidecar = false;
    };
    std::vector<File> inputs, outputs;
    if (!given("output")) outputs.push_back({"standard output", "-"});
    for (const auto& [name, entry] : entries_) {
        if (!given(name) || entry.kind == Kind::value || entry.kind == Kind::flag) continue;
        const std::string path = text(name);
        if (entry.kind == Kind::input) {
            if (path != "-") inputs.push_back({said(name), path});
            continue;
        }
        for (const std::string& file : entry.files) outputs.push_back({file + " of " + said(name), path + "/" + file});
        if (entry.kind == Kind::folder) continue;
        outputs.push_back({said(name), path});
        if (entry.kind == Kind::table && path != "-" && !is_stream(path)) {
            outputs.push_back({said(name) + ".toml, written beside it,", path + ".toml", true});
        }
    }
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        for (const File& input : inputs) {
            // a repeated run may overwrite the file that describes it: it has been read by then
            if (replays_ && output->is_sidecar && input.said == said("config")) continue;
            if (!same_place(output->path, input.path)) continue;
            throw BadInput(output->said + " must not be a file that this run reads: " + input.said);
        }
        for (auto other = output + 1; other != outputs.end(); ++other) {
            if (!same_place(output->path, other->path)) continue;
            throw BadInput(other->said + " must not be written to as well as " + output->said);
        }
    }
}

const Options::Entry& Options::entry(const std::string& name) const { return entries_.at(name); }

std::vector<std::string> Options::members(const std::string& heading, const std::vector<std::string>& allowed) const {
    std::vector<std::string> names;
    for (const auto& [name, entry] : entries_) {
        const bool is_allowed = std::find(allowed.begin(), allowed.end(), name) != allowed.end();
        if (entry.option->get_group() == heading && !is_allowed) names.push_back(name);
    }
    return names;
}

std::vector<std::string> Options::raw(const std::string& name) const {
    if (entry(name).option->count() > 0) return entry(name).option->results();
    if (!entry(name).configured.empty()) return entry(name).configured;
    const std::string& default_text = entry(name).default_text;
    return default_text.empty() ? std::vector<std::string>{} : std::vector<std::string>{default_text};
}

std::string Options::joined(const std::string& name) const { return join(raw(name), ","); }

}  // namespace study
