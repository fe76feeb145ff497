#include "history.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "csv.hpp"

namespace study {

namespace {

/// The value at q between places that ascend, linear, and constant beyond them. Two equal places make a
/// jump, where the value is the one before it unless `behind`.
double interpolate(const Numbers& places, const Numbers& values, double q, bool behind) {
    const auto next =
        behind ? std::upper_bound(places.begin(), places.end(), q) : std::lower_bound(places.begin(), places.end(), q);
    const auto j = static_cast<std::size_t>(next - places.begin());
    if (j == 0) return values.front();
    if (j == places.size()) return values.back();
    const double part = (q - places[j - 1]) / (places[j] - places[j - 1]);
    return values[j - 1] + part * (values[j] - values[j - 1]);
}

}  // namespace

double History::at(const std::string& column, double q, bool behind) const {
    const auto found = signals_.find(column);
    return found == signals_.end() ? 0 : found->second.at(q, behind);
}

void History::set(const std::string& column, double value) {
    signals_[column] = {[=](double q, bool behind) { return q > 0 || behind ? value : 0; }};
}

void History::set(const std::string& column, const Sine& sine, double mean) {
    signals_[column] = {[=](double q, bool) { return mean + sine.amplitude * std::sin(sine.omega * q); },
                        mean + std::abs(sine.amplitude)};
    omega_ = std::max(omega_, sine.omega);
}

void History::set_ramp(const std::string& column, double rate) {
    signals_[column] = {[=](double q, bool) { return rate * q; }};
}

void History::set(const std::string& column, Numbers values) {
    const auto at = [places = places_, values](double q, bool behind) {
        if (behind ? q < places.front() : q <= places.front()) return 0.0;
        return interpolate(places, values, q, behind);
    };
    const double largest = *std::max_element(values.begin(), values.end());
    signals_[column] = {at, largest, std::move(values)};
}

void History::add(const History& other) {
    signals_.insert(other.signals_.begin(), other.signals_.end());
    omega_ = std::max(omega_, other.omega_);
    Numbers all;
    std::merge(places_.begin(), places_.end(), other.places_.begin(), other.places_.end(), std::back_inserter(all));
    places_ = std::move(all);
}

const Numbers& History::values(const std::string& column) const {
    static const Numbers none;
    const auto found = signals_.find(column);
    return found == signals_.end() ? none : found->second.values;
}

std::vector<std::string> HistoryColumns::all() const {
    std::vector<std::string> names(creepage.begin(), creepage.end());
    names.insert(names.end(), shift.begin(), shift.end());
    if (friction()) names.emplace_back("force");
    std::erase(names, "");
    return joined(joined(std::move(names), load), others);
}

}  // namespace study
