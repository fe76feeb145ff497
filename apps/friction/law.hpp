// The laws that friction_study takes by name, mu/mu_0 of the slip velocity, and their memory. All that a law is stands
// in its row in law.cpp.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <rollbem/friction/law.hpp>

#include "support/input.hpp"
#include "support/options.hpp"

namespace friction {

/// Distances in a mu_0 p0/G, velocities in V mu_0 p0/G.
struct NamedLaw {
    std::string option, value, help;                        ///< of the program
    std::vector<std::string> columns;                       ///< of its parameters
    study::Numbers (*read)(const study::Options& options);  ///< its parameters; throws BadInput
    std::function<double(double)> (*mu)(const study::Numbers& parameters);
    std::string before, between;  ///< the first parameter and the second in titles
};
const std::vector<NamedLaw>& laws();

/// Declares the options of laws and --memory.
void add_law_options(study::Options& options);

/// The options of the laws, without --memory.
std::vector<std::string> law_options();

/// The law of a run.
struct SlipLaw {
    const NamedLaw& named;
    study::Numbers parameters;
    rollbem::FrictionMemory<> memory{};

    std::function<double(double)> mu() const { return named.mu(parameters); }
};

/// The law that is given; nothing where mu is constant. Throws BadInput.
std::optional<SlipLaw> read_law(const study::Options& options);

}  // namespace friction
