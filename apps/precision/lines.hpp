// The schemes of a line contact that precision_study compares, and what they compute.
#pragma once

#include <string>

#include <rollbem/compiled/steady.hpp>

#include "comparison.hpp"
#include "support/named_scheme.hpp"
#include "support/scenes.hpp"

namespace precision {

inline constexpr double peak = 1e-3;  ///< mu p0 / G
inline constexpr int steps = 10;      ///< of the response to a step, each by dq

/// What the schemes are applied to besides a contact.
struct Settings {
    double dq = 1;                ///< [a]
    double creepage_ratio = 0.5;  ///< of the problems with friction
    int load_parts = 1;           ///< of each step under a load that varies
    bool may_breathe = true;      ///< whether a mesh may follow that load
};

/// Whether a scheme has n elements, states or the order n of polynomials; 0 is that of the closed form.
bool exists(const study::NamedScheme& scheme, long n);

/// Whether it solves the problem: Coulomb's law takes elements.
bool solves(const study::NamedScheme& scheme, Problem problem);

/// In steady rolling, on one mesh or by states.
rollbem::Response<double> steady(const study::Scene& scene);

/// The values of a quantity, and those that they should have if these are not the reference.
struct Found {
    Values values, exact{};
};

/// The values of a scheme; not numbers if the status is not ok. `reference` holds those of the closed form.
Found evaluate(const study::Scene& scene, const Settings& settings, const Quantity& quantity, const Values& reference);

}  // namespace precision
