// The model of an FMU, as the FMI functions see it: a table of variables, and steps.
// The table is the only list of variables: modelDescription.xml and the documentation are written from it.
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <rollbem/detail/require.hpp>
#include <rollbem/status.hpp>
#include <rollbem/types.hpp>

namespace fmu {

/// Values of an enumeration.
struct Enumeration {
    struct Item {
        std::string name;
        std::string description = "";
    };
    std::string name;
    std::vector<Item> items;
    int first = 1;  ///< the number of the first item

    const Item& item(int value) const { return items[static_cast<std::size_t>(value - first)]; }
};

/// The causalities of FMI that models use.
enum class Causality { parameter, input, output };

/// One variable. Its value reference is its place in the table, its start value the value when it enters the table.
struct Variable {
    using Value = std::variant<double*, int*, std::string*>;

    std::string name;
    Value value;
    std::string unit = "";  ///< one of known_units(); empty: a pure number
    std::string description = "";
    Causality causality = Causality::parameter;
    const Enumeration* items = nullptr;  ///< of an int that is one of them
    double* rate = nullptr;              ///< of an input: its time derivative during the next step
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    bool is_code = false;  ///< the integer twin of the enumeration before it in the table, see Model::add

    template <class Value>
    bool is() const {
        return std::holds_alternative<Value*>(value);
    }
    void lies_in(double low, double high) {
        min = low;
        max = high;
    }
    double& real() const { return *std::get<double*>(value); }
    int& integer() const { return *std::get<int*>(value); }
    std::string& text() const { return *std::get<std::string*>(value); }
};

/// A unit in terms of kilogram, metre, second and radian.
struct Unit {
    const char* name;
    int kg, m, s, rad = 0;
};
std::span<const Unit> known_units();

/// Result of a step.
enum class Outcome {
    ok,
    refused,       ///< outside the model's domain: another step or other inputs may be possible
    not_a_number,  ///< an input is infinite or not a number
};

Outcome outcome_of(rollbem::Status status);

/// The statuses of a step: 0 none, 1 ok.
extern const Enumeration step_statuses;

/// The value of a variable of that enumeration.
inline int value_of(rollbem::Status status) { return static_cast<int>(status) + 1; }

/// The memory of an instance as bytes. One function names the values to keep, for writing and for reading.
class Archive {
public:
    /// Writes; the contents of `bytes` are lost.
    explicit Archive(std::vector<std::byte>& bytes) : bytes_(&bytes) { bytes.clear(); }
    /// Reads. keep() throws std::invalid_argument if fewer bytes are left than it needs.
    explicit Archive(std::span<const std::byte> source) : source_(source) {}

    template <class Value>
    requires std::is_trivially_copyable_v<Value>
    void keep(Value& value) { keep(&value, sizeof value); }
    /// All numbers of a vector, an array or a matrix that owns them. The model knows their count.
    template <class Derived>
    void keep(Eigen::PlainObjectBase<Derived>& values) {
        keep(values.data(), sizeof(*values.data()) * static_cast<std::size_t>(values.size()));
    }
    template <class Value>
    void keep(std::vector<Value>& values) {
        keep(values.data(), sizeof(Value) * values.size());
    }
    void keep(std::string& text);

    bool reads() const { return bytes_ == nullptr; }
    std::size_t left() const { return source_.size(); }  ///< bytes not yet read

private:
    void keep(void* data, std::size_t size);

    std::vector<std::byte>* bytes_ = nullptr;
    std::span<const std::byte> source_;
};

/// The properties of an FMU besides its variables.
struct Identity {
    const char* identifier;  ///< name of the file and the shared library
    const char* description;
    double stop_time, step_size;  ///< of the default experiment [s]
};
extern const Identity identity;  // each FMU defines it

/// The reason why a derivative cannot be given. The instance goes on.
class NoDerivative : public std::invalid_argument {
public:
    NoDerivative(const Variable& unknown, const Variable& known, const std::string& reason)
        : std::invalid_argument("there is no derivative of " + unknown.name + " by " + known.name + reason) {}
};

/// One contact, or all contacts of a wheelset. The FMI functions construct it, set variables and call initialise(),
/// then step(), and archive() at any time.
class Model {
public:
    Model() = default;
    virtual ~Model() = default;
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    const std::vector<Variable>& variables() const { return variables_; }

    /// Folder of the files packed with the FMU.
    std::string resources;

    /// The warning of initialise() or step(); empty: none.
    std::string warning;

    /// Gives enumerations the values of their integer twins. Throws std::invalid_argument if an enumeration among the
    /// parameters has none of its values.
    void settle_enumerations();

    /// Builds the contact that the parameters describe and its first state at the present inputs. Throws
    /// std::invalid_argument, naming the parameter.
    virtual void initialise() = 0;

    /// Advances by `duration` > 0 [s] and sets the outputs, or changes nothing but the status.
    virtual Outcome step(double duration) = 0;

    /// The derivative of an output at the end of the last step by an input during it. Throws NoDerivative if there is
    /// none.
    virtual double partial(const Variable& unknown, const Variable& known) = 0;

    /// Names the values that an instance keeps besides the variables.
    virtual void archive(Archive& archive) = 0;

    /// Returns the variable in the table; the reference is valid until the next variable is added. An enumeration NAME
    /// gets an integer twin NAME_code, because some importing programs know no enumerations: the twin of an output has
    /// the same value, the twin of a parameter sets it unless the twin is 0, its start.
    Variable& add(Variable variable);
    Variable& add_parameter(Variable::Value value, std::string name, const char* unit, std::string description,
                            const Enumeration* items = nullptr) {
        return add({std::move(name), value, unit, std::move(description), Causality::parameter, items});
    }

protected:
    /// An input and its time derivative during the next step.
    struct Input {
        double value;
        double rate = 0;
        double after(double duration) const { return value + duration * rate; }
    };

    /// Throws std::invalid_argument unless `holds`: "FMU: parameter = value must rule".
    template <class Value>
    static void require(bool holds, const char* parameter, Value value, const char* rule) {
        rollbem::detail::require(holds, identity.identifier, parameter, value, rule);
    }

    /// Throws std::invalid_argument unless the inputs are finite, naming the first that is not.
    void require_finite_inputs() const;

    Variable& add_input(Input& input, std::string name, const char* unit, std::string description) {
        return add(
            {std::move(name), &input.value, unit, std::move(description), Causality::input, nullptr, &input.rate});
    }
    Variable& add_output(Variable::Value value, std::string name, const char* unit, std::string description,
                         const Enumeration* items = nullptr) {
        return add({std::move(name), value, unit, std::move(description), Causality::output, items});
    }

private:
    std::vector<Variable> variables_;
    std::deque<int> codes_;  // twins of parameters
};

std::unique_ptr<Model> make_model();  // each FMU defines it

}  // namespace fmu
