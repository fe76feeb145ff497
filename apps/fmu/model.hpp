// The model of an FMU, as the FMI functions see it: a table of variables, and steps.
// The table is the only list of variables: modelDescription.xml and the documentation are written from it.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <rollbem/detail/require.hpp>
#include <rollbem/status.hpp>

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
    using Value = std::variant<double*, int*, bool*, std::string*>;
    /// A check that throws std::invalid_argument, naming the quantity whose value breaks its rule.
    using Rule = void (*)(const char* who, const char* quantity, double value);

    std::string name;
    Value value;
    std::string unit = "";  ///< one of known_units(); empty: a pure number
    std::string description = "";
    Causality causality = Causality::parameter;
    const Enumeration* items = nullptr;  ///< of an int that is one of them
    double* rate = nullptr;              ///< of an input: its time derivative during the next step
    double min = -std::numeric_limits<double>::infinity(), max = std::numeric_limits<double>::infinity();
    Rule rule = nullptr;     ///< of a parameter, besides min and max
    bool is_code = false;    ///< the integer twin of the enumeration before it in the table, see Model::add
    Eigen::Index index = 0;  ///< number of variables of the same causality before it

    template <class Value>
    bool is() const {
        return std::holds_alternative<Value*>(value);
    }
    void lies_in(double low, double high) {
        min = low;
        max = high;
    }
    void is_not_negative() {
        min = 0;
        if (causality == Causality::parameter) rule = rollbem::detail::require_not_negative<double>;
    }
    double& real() const { return *std::get<double*>(value); }
    int& integer() const { return *std::get<int*>(value); }
    std::string& text() const { return *std::get<std::string*>(value); }
    double number() const { return is<double>() ? real() : integer(); }
};

/// A unit in terms of kilogram, metre, second and radian.
struct Unit {
    const char* name;
    int kg, m, s, rad = 0;
};
std::span<const Unit> known_units();

/// The statuses of a step: 0 none, 1 ok.
extern const Enumeration step_statuses;

/// The memory of an instance as bytes. One function names the values to keep, for writing and for reading.
class Archive {
public:
    /// Writes; the contents of `bytes` are lost.
    explicit Archive(std::vector<std::byte>& bytes) : bytes_(&bytes) { bytes.clear(); }
    /// Reads. keep() throws std::invalid_argument if fewer bytes are left than it needs.
    explicit Archive(std::span<const std::byte> source) : source_(source) {}

    template <class Value>
    void keep(Value& value) {
        if constexpr (requires { value.data(); }) {  // of a vector, an array or a matrix, whose size the model knows
            keep(value.data(), sizeof(*value.data()) * static_cast<std::size_t>(value.size()));
        } else {
            static_assert(std::is_trivially_copyable_v<Value>);
            keep(&value, sizeof value);
        }
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

/// Thrown where there is no derivative, with the reason. The instance goes on.
struct NoDerivative {
    const char* reason = ": the forces have some by the inputs";
};

/// One contact, or all contacts of a wheelset. The FMI functions construct it, set variables and call begin(), then
/// step(), and archive() at any time.
class Model {
public:
    Model() = default;
    virtual ~Model() = default;
    Model(const Model&) = delete;
    Model& operator=(const Model&) = delete;

    const std::vector<Variable>& variables() const { return variables_; }

    /// Folder of the files packed with the FMU.
    std::string resources;

    /// The warning of begin() or step(); empty: none.
    std::string warning;

    /// Builds the contact that the parameters describe and its first state at the present inputs. Throws
    /// std::invalid_argument, naming the parameter.
    void begin();

    /// Advances by `duration` > 0 [s] and sets the outputs, or changes nothing but the status.
    rollbem::Status step(double duration);

    /// The derivative of an output at the end of the last step by an input during it, both by their index. Throws
    /// NoDerivative if there is none, or returns NaN.
    virtual double partial(Eigen::Index output, Eigen::Index input) = 0;

    /// Names the values that an instance keeps besides the variables.
    virtual void archive(Archive& archive) = 0;

protected:
    /// An input and its time derivative during the next step.
    struct Input {
        double value;
        double rate = 0;
        double after(double duration) const { return value + duration * rate; }
    };
    /// Values of inputs after a part of the next step.
    template <std::size_t count>
    static auto after(double duration, const std::array<Input, count>& inputs) {
        Eigen::Array<double, static_cast<int>(count), 1> values;
        for (std::size_t i = 0; i < count; ++i) values[static_cast<Eigen::Index>(i)] = inputs[i].after(duration);
        return values;
    }

    /// begin() with parameters that have been checked. Returns the status, nothing if nothing has been computed.
    virtual std::optional<rollbem::Status> build() = 0;
    /// step() without the status.
    virtual rollbem::Status advance(double duration) = 0;

    /// Throws std::invalid_argument unless `holds`: "FMU: parameter = value must rule".
    template <class Value>
    static void require(bool holds, const char* parameter, Value value, const std::string& rule) {
        rollbem::detail::require(holds, identity.identifier, parameter, value, rule.c_str());
    }
    /// Throws std::invalid_argument unless all inputs are finite and in their range, naming the first that is not.
    void require_inputs() const { check(Causality::input); }

    /// Returns the variable in the table; the reference is valid until the next variable is added. An enumeration NAME
    /// gets an integer twin NAME_code, because some importing programs know no enumerations: the twin of an output has
    /// the same value, the twin of a parameter sets it unless the twin is 0, its start.
    Variable& add(Variable variable);
    Variable& add_parameter(Variable::Value value, std::string name, const char* unit, std::string description,
                            const Enumeration* items = nullptr) {
        return add({std::move(name), value, unit, std::move(description), Causality::parameter, items});
    }
    Variable& add_input(Input& input, std::string name, const char* unit, std::string description) {
        return add(
            {std::move(name), &input.value, unit, std::move(description), Causality::input, nullptr, &input.rate});
    }
    Variable& add_output(Variable::Value value, std::string name, const char* unit, std::string description,
                         const Enumeration* items = nullptr) {
        return add({std::move(name), value, unit, std::move(description), Causality::output, items});
    }
    void add_slip_work() { add_output(&slip_work_, "slip_work", "J", "Heat by slip since the start"); }
    void add_status() { add_output(&status_, "status", "", "Status of the last step", &step_statuses); }

    double slip_work_ = 0;

private:
    static void check_range(const Variable& variable, double least, double most);
    void check(Causality causality) const;
    void settle_enumerations();

    std::vector<Variable> variables_;
    std::deque<int> codes_;  // twins of parameters
    int status_ = 0;
};

std::unique_ptr<Model> make_model();  // each FMU defines it

}  // namespace fmu
