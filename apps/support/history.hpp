// Histories: what is imposed on a run over the distance rolled, by the names of columns: constant from the start on, a
// ramp, a sine, or a table.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "input.hpp"
#include "options.hpp"

namespace study {

/// A sinusoidal quantity: amplitude * sin(omega q), omega in V/a.
struct Sine {
    double amplitude, omega;
};

/// Quantities over q [a], 0 where nothing is imposed and before it is.
class History {
public:
    History() = default;
    /// The places of tables: ascending, of which two equal ones make a jump.
    explicit History(Numbers places) : places_(std::move(places)) {}

    bool has(const std::string& column) const { return signals_.count(column) > 0; }
    /// The value just before (or at) q, or `behind` it: both differ at a jump only.
    double at(const std::string& column, double q, bool behind = true) const;
    /// The largest value of a sine or a table.
    double largest(const std::string& column) const { return signals_.at(column).largest; }

    /// A column has the value from q = 0 on.
    void set(const std::string& column, double value);
    void set(const std::string& column, const Sine& sine, double mean = 0);
    void set_ramp(const std::string& column, double rate);
    /// A column is linear between the places of this history.
    void set(const std::string& column, Numbers values);
    /// Adds another history's columns and places.
    void add(const History& other);

    /// The places at which steps have to end: the places of all tables.
    const Numbers& places() const { return places_; }
    /// The values of a column of a table at its own places; empty where it has none.
    const Numbers& values(const std::string& column) const;

    /// Whether steps of dq follow all sines: omega dq <= 1, six steps a period.
    bool resolved(double dq) const { return omega_ * dq <= 1; }

private:
    struct Signal {
        std::function<double(double q, bool behind)> at;
        double largest = 0;
        Numbers values{};
    };

    std::map<std::string, Signal> signals_;
    double omega_ = 0;  // the largest
    Numbers places_;
};

/// The names of the columns that a study imposes; empty where it has none.
struct HistoryColumns {
    std::array<std::string, 3> creepage;  ///< along x, which --step, --ramp and --sine set, along y, and spin
    std::array<std::string, 2> shift{};
    std::vector<std::string> load{};  ///< of friction, which takes a force, too: load_ratio, and further ones of --load
    std::vector<std::string> others{};

    bool friction() const { return !load.empty(); }
    const std::string& main() const { return creepage[0]; }
    std::vector<std::string> all() const;
};

}  // namespace study
