// Histories: what is imposed on a run over the distance rolled, by the names of columns: constant from the start on, a
// ramp, a sine, or a table of --history.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "input.hpp"
#include "options.hpp"

namespace study {

/// A sinusoidal quantity: amplitude * sin(omega q), omega in V/a.
struct Sine {
    double amplitude, omega;
};

/// --sine AMP,OMEGA. Throws BadInput unless both are finite, AMP is not 0 and OMEGA is positive.
Sine read_sine(const Options& options);

/// Whether steps of dq follow a sine: omega dq <= 1, six steps a period.
inline bool resolves(double omega, double dq) { return omega * dq <= 1; }

/// The value at q between places that ascend, linear, and constant beyond them. At two equal places, which make a jump,
/// that before it unless `behind`.
double interpolate(const Numbers& places, const Numbers& values, double q, bool behind = true);

/// Quantities over q [a], 0 where nothing is imposed and before it is.
class History {
public:
    bool has(const std::string& column) const { return signals_.count(column) > 0; }
    /// Just before (or at) q, or `behind` it: they differ at a jump only.
    double at(const std::string& column, double q, bool behind) const;
    double jump(const std::string& column, double q) const { return at(column, q, true) - at(column, q, false); }

    /// From q = 0 on.
    void set(const std::string& column, double value);
    void set(const std::string& column, const Sine& sine);
    void set_ramp(const std::string& column, double rate);
    /// Linear between ascending places, of which two equal ones make a jump.
    void set(Numbers places, std::map<std::string, Numbers> columns);

    /// Where steps have to end: the places of a table.
    const Numbers& places() const { return places_; }
    /// The values of a column of a table there; empty where it has none.
    const Numbers& values(const std::string& column) const;

    /// Whether steps of dq follow what is imposed.
    bool resolved(double dq) const { return !omega_ || resolves(*omega_, dq); }

private:
    std::map<std::string, std::function<double(double q, bool behind)>> signals_;
    std::optional<double> omega_{};
    Numbers places_;
    std::map<std::string, Numbers> tables_;
};

/// What a study imposes: the column that --step, --ramp and --sine set, and those that a table may have besides.
struct HistoryColumns {
    std::string main;
    std::vector<std::string> others{};

    std::vector<std::string> all() const;
};

/// Declares --step, --ramp, --sine and --history, of which one may be given; with `mode`, only that option takes them.
void add_history_options(Options& options, const HistoryColumns& columns, const std::string& mode = "");

/// What they impose; nothing where none is given. Throws BadInput.
std::optional<History> read_history(const Options& options, const HistoryColumns& columns);

}  // namespace study
