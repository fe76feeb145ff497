// Quantities and the places at which they are judged: an error is the largest over what a quantity stands for, so that
// no creepage or frequency that suits a mesh passes for precision.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "support/csv.hpp"

namespace precision {

/// A problem is computed, and timed, as a whole.
enum class Problem { steady, harmonic, transient, friction, combined_friction, varying_load, patch, patch_friction };

/// Numbers that a quantity consists of; all but c11 under harmonic creepage are real.
using Values = std::vector<std::complex<double>>;

/// A value of each parameter that a quantity depends on, by its name in worst_at; none where nothing is varied.
struct Place {
    std::vector<std::pair<std::string_view, double>> values{};

    /// The value of a parameter that the place has.
    double operator[](std::string_view name) const {
        return std::find_if(values.begin(), values.end(), [=](const auto& one) { return one.first == name; })->second;
    }
    /// The cell of worst_at, as "creepage_ratio=0.25 angle=45".
    std::string text() const {
        std::string text;
        for (const auto& [name, value] : values) {
            text += (text.empty() ? "" : " ") + std::string(name) + "=" + study::Cell(value).text();
        }
        return text;
    }
};
using Places = std::vector<Place>;

/// The places of all combinations; the last parameter is the innermost loop.
inline Places combined(const std::vector<std::pair<std::string_view, std::vector<double>>>& parameters) {
    Places all{{}};
    for (const auto& [name, values] : parameters) {
        Places longer;
        for (const Place& place : all) {
            for (const double value : values) {
                longer.push_back(place);
                longer.back().values.emplace_back(name, value);
            }
        }
        all = std::move(longer);
    }
    return all;
}

/// What is compared, and the places over which its error is the largest.
struct Quantity {
    std::string name;
    Problem problem;
    /// relative_error as the study defines it, of the values that were found at one place and those that should be.
    std::function<double(const Values& found, const Values& exact)> error;
    Places places{{}};

    /// The number of computations for the values at all places, which a run in time passes one after the other.
    std::size_t runs() const { return problem == Problem::transient ? 1 : places.size(); }

    /// Whether its errors by a scheme count on the front.
    bool competes(const std::string& scheme) const {
        const bool friction = problem >= Problem::friction && problem != Problem::patch;
        return !(friction && scheme.rfind("richardson:", 0) == 0);
    }
};

/// The error that is largest, as it is signed, and its place. Each place has its part of the values, all of one length.
/// An error that is not a number is the largest.
inline std::pair<double, const Place*> worst(const Quantity& quantity, const Values& found, const Values& exact) {
    const std::ptrdiff_t count = std::ssize(quantity.places), length = std::ssize(exact) / count;
    std::pair<double, const Place*> result{0, &quantity.places.front()};
    for (std::ptrdiff_t k = 0; k < count; ++k) {
        const auto part = [&](const Values& of) {
            return Values(of.begin() + k * length, of.begin() + (k + 1) * length);
        };
        const double error = quantity.error(part(found), part(exact));
        if (k == 0 || !(std::abs(error) <= std::abs(result.first))) {
            result = {error, &quantity.places[std::size_t(k)]};
        }
        if (std::isnan(error)) break;
    }
    return result;
}

}  // namespace precision
