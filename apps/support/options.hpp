// Options: the command line of a study. Declares the options all studies share, lets a study add its own, change
// defaults and refuse what it would ignore, and reads values strictly. CLI11 splits the words and writes the help.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <rollbem/detail/text_table.hpp>

namespace CLI {  // compiling CLI11's headers takes seconds, so only options.cpp sees them
class App;
class Option;
}  // namespace CLI

namespace study {

// --- how a study ends: exceptions that stand for its exit codes; anything else that is thrown is a defect: 1

enum ExitCode : int {
    exit_ok = 0,
    exit_failed = 1,
    exit_bad_input = 2,
    exit_no_plot = 3,
    exit_write_error = 4,
};

/// The input cannot be used, or the output cannot be written to: nothing was computed.
class BadInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// Writing failed after it had begun.
class WriteError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Nobody reads what is left to compute; no error.
class Unread : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The rows are written, the plot is not.
class PlotError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The result of call(); a refusal by the library becomes BadInput that begins with `said`.
template <class Call>
auto blame(const std::string& said, const Call& call) {
    try {
        return call();
    } catch (const BadInput&) {
        throw;
    } catch (const std::invalid_argument& error) {
        throw BadInput(said + ": " + error.what());
    }
}

// --- what it is asked for

/// A condition on a number, and its wording after "must".
struct Rule {
    std::function<bool(double)> holds;
    std::string text;
};

Rule between(double low, double high);
/// Values that can be meant in this unit, where one in another unit would lie outside.
Rule in_unit(const std::string& unit, double low, double high);
Rule shear_modulus();  ///< [Pa]
Rule finite();
Rule positive();
Rule not_negative();
Rule positive_or_infinite();

namespace detail {

using rollbem::detail::parse_number;

/// The number of letters to add, remove or change to turn `from` into `to`.
std::size_t edit_distance(const std::string& from, const std::string& to);

}  // namespace detail

/// Breaks lines at blanks so that none is longer than `width`, unless a word is.
std::string wrap(const std::string& text, std::size_t width);

bool contains(const std::vector<std::string>& words, const std::string& word);

/// The words joined by `separator`.
std::string join(const std::vector<std::string>& words, const std::string& separator);

/// "a, b or c" with last = "or".
std::string listed(const std::vector<std::string>& words, const std::string& last);

/// The values of --mesh.
std::vector<std::string> mesh_names();

/// The option that sets what a column of this name shows: "size-ratio" for size_ratio.
std::string option_of(std::string column);

/// An option that was given.
struct Given {
    std::string name, value;  ///< the value as typed, of a flag true or false
    bool repeats;             ///< it belongs to what --config repeats: it names no file that is written, nor --jobs
};

class Options {
public:
    /// Declares the options all studies share. `purpose` is the first line of --help.
    Options(std::string program, const std::string& purpose);
    Options(Options&&) noexcept;
    ~Options();

    /// Heading in --help of the options added next.
    void group(const std::string& heading) { group_ = heading; }

    /// An option that was declared, to say in which modes of the study it has an effect. A mode is the name of another
    /// option that is given, or NAME=VALUE.
    struct Added {
        Options& options;
        std::string name;

        /// The option has an effect with one of these modes only: --help says so, and without them it is bad input.
        /// `why` follows the message.
        const Added& only_with(const std::vector<std::string>& modes, const std::string& why = "") const;

        /// The option has no effect with that mode. Where one of the two stands in a configuration file, the one on the
        /// command line takes its place.
        const Added& not_with(const std::string& mode, const std::string& why = "") const;
    };

    /// Declares --name VALUE. Say the unit in `help`, or that the value is dimensionless.
    Added add(const std::string& name, const std::string& value, const std::string& help,
              const std::string& default_text = "");

    /// Declares --name FILE, a file that is read. No output may be the same file.
    Added add_input(const std::string& name, const std::string& help) { return add(name, "FILE", help, Kind::input); }

    /// Declares --name FILE, a file that is written. No other file of the run may be the same.
    Added add_output(const std::string& name, const std::string& help) { return add(name, "FILE", help, Kind::output); }

    /// Declares a file that is read, --name FILE or FILE alone.
    Added add_argument(const std::string& name, const std::string& help) {
        return add(name, "FILE", help, Kind::argument);
    }

    /// Declares --name FILE, a table that is written, with a file beside it, FILE.toml. No other file may be the same.
    Added add_table(const std::string& name, const std::string& help) { return add(name, "FILE", help, Kind::table); }

    /// Declares --name DIR, a folder that files are written to.
    Added add_folder(const std::string& name, const std::string& help) { return add(name, "DIR", help, Kind::folder); }

    /// Declares --name, which takes no value.
    Added add_flag(const std::string& name, const std::string& help);

    void set_default(const std::string& name, const std::string& default_text);

    /// Replaces the text that add() gave for --help, and its VALUE unless that is empty.
    void set_help(const std::string& name, const std::string& help, const std::string& value = "");

    /// Makes --name bad input for this study, for a reason that the message gives; --help does not list it.
    void refuse(const std::string& name, const std::string& reason);

    /// Refuses all options under a heading except `allowed`.
    void refuse_group(const std::string& heading, const std::string& reason,
                      const std::vector<std::string>& allowed = {});

    /// Added::not_with for several options.
    void not_with(const std::vector<std::string>& names, const std::string& mode, const std::string& why = "") {
        for (const std::string& name : names) limits_.push_back({name, {mode}, false, why});
    }

    /// Added::only_with for several options, but without a word in --help.
    void only_with(const std::vector<std::string>& names, const std::vector<std::string>& modes,
                   const std::string& why = "") {
        for (const std::string& name : names) limits_.push_back({name, modes, true, why});
    }

    /// Text below the options in --help, exactly as given; the exit codes follow it.
    void footer(const std::string& text);

    /// Replaces what the file beside the results says of axes, signs and units: lines, each NAME = TEXT.
    void set_conventions(std::string text) { conventions_ = std::move(text); }
    const std::string& conventions() const { return conventions_; }

    std::string version() const;  ///< program, version and git revision

    /// Reads the command line. Returns a text to print instead of running (--help, --version); throws BadInput.
    std::optional<std::string> parse(int argc, const char* const* argv);

    const std::string& program() const { return program_; }
    const std::vector<std::string>& words() const { return words_; }  ///< the command line as typed

    /// Whether the study has the option.
    bool has(const std::string& name) const { return entries_.count(name) > 0; }

    /// Whether the option was given, on the command line or in the configuration file.
    bool given(const std::string& name) const;

    /// "--name = value" as typed, for messages.
    std::string said(const std::string& name) const;

    /// Throws BadInput unless `holds`: "--name = value must `rule`".
    void require(bool holds, const std::string& name, const std::string& rule) const {
        if (!holds) throw BadInput(said(name) + " must " + rule);
    }

    /// Throws BadInput if `name` was given: "--name = value has no effect `reason`".
    void ignored(const std::string& name, const std::string& reason) const;

    /// A flag's state. In a configuration file a flag is true or false.
    bool flag(const std::string& name) const;

    /// The one value of an option, or its default.
    std::string text(const std::string& name) const;

    /// The one value, which must be among `names`.
    std::string choice(const std::string& name, const std::vector<std::string>& names) const;

    /// A list of some of `known`, or of all where one item is "all"; in the order of `known`.
    std::vector<std::string> choices(const std::string& name, const std::vector<std::string>& known) const;

    /// A list of texts.
    std::vector<std::string> texts(const std::string& name) const;

    double number(const std::string& name, const Rule& rule) const;

    /// FIRST,SECOND,... as so many finite numbers; empty where the one value is something else.
    std::vector<double> row(const std::string& name, std::size_t count) const;
    /// A row of two numbers; nothing where the value is something else.
    std::optional<std::pair<double, double>> pair(const std::string& name) const;

    std::ptrdiff_t integer(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const;

    /// A list: comma-separated, given several times, or both. No item may be empty or appear twice.
    std::vector<double> numbers(const std::string& name, const Rule& rule) const;
    std::vector<std::ptrdiff_t> integers(const std::string& name, std::ptrdiff_t low, std::ptrdiff_t high) const;

    /// Every option given except --config, in the order of their names.
    std::vector<Given> given() const;

    /// A line for the sidecar on what was done with the input, once.
    void note(const std::string& line) const {
        if (!contains(notes_, line)) notes_.push_back(line);
    }
    /// A note on input that may not be meant as it is read; say_doubts() says it where there is no sidecar.
    void doubt(const std::string& line) const {
        note(line);
        if (!contains(doubts_, line)) doubts_.push_back(line);
    }
    const std::vector<std::string>& notes() const { return notes_; }

    /// Says all doubts on standard error.
    void say_doubts() const;

private:
    enum class Kind { value, flag, input, argument, output, table, folder };

    struct Entry {
        CLI::Option* option = nullptr;
        std::string help, default_text;
        Kind kind = Kind::value;
        std::vector<std::string> configured{};  ///< by the configuration file
        std::string refusal{};                  ///< why the study does not take it
        std::string condition{};                ///< the modes in which it has an effect, for --help

        bool typed() const;
    };

    /// The modes without any of which an option has no effect, or the one with which it has none.
    struct Limit {
        std::string name;
        std::vector<std::string> modes;
        bool needs;
        std::string why;
    };

    Added add(const std::string& name, const std::string& value, const std::string& help, Kind kind);

    bool is_on(const std::string& mode) const;

    /// Lets the command line take precedence, and throws BadInput for an option that its limits exclude.
    void apply_limits();

    void read_config();

    /// Throws BadInput if two files of this run are the same.
    void check_files() const;

    /// "; did you mean --name?" if an option has a similar name.
    std::string suggestion(const std::string& word) const;

    const Entry& entry(const std::string& name) const { return entries_.at(name); }

    std::vector<std::string> raw(const std::string& name) const;

    template <class Number, class Read>
    std::vector<Number> list(const std::string& name, const Read& read) const;

    std::string program_, group_, conventions_;
    std::unique_ptr<CLI::App> app_;
    std::map<std::string, Entry> entries_;
    std::vector<Limit> limits_;
    std::vector<std::string> words_;
    bool replays_ = false;  ///< --config is the file beside a CSV file
    mutable std::vector<std::string> notes_, doubts_;
};

/// body(), which returns the exit code of a program; exceptions become exit codes and one line on standard error.
int run_guarded(const std::string& program, const std::function<int()>& body);

/// The frame of every study's main(): reads the command line and runs body(options), guarded.
int run_program(Options& options, int argc, const char* const* argv, const std::function<int(const Options&)>& body);

}  // namespace study
