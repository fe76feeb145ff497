// What the programs of friction assemble of a scene: in either direction, under a layer, on a mesh that covers more than
// the contact of the reference load.
#pragma once

#include <utility>

#include <Eigen/Core>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/combined_steady.hpp>
#include <rollbem/scene/contact.hpp>

#include "falling.hpp"
#include "support/options.hpp"
#include "support/scenes.hpp"

namespace friction {

enum class Direction { longitudinal, lateral };

struct Surface {
    const study::Scene& scene;
    double layer = 0;        ///< compliance L [a_0/G]
    double half_length = 1;  ///< that the mesh covers [a_0]

    /// With a_0 = G = 1.
    rollbem::Contact<double> contact() const;

    rollbem::ElementSystem<double> system(Direction direction) const;

    /// G' and the widths of its elements.
    std::pair<Eigen::MatrixXd, Eigen::ArrayXd> gradient(Direction direction) const;

    rollbem::SteadyFrictionModel<double> steady_model(const rollbem::CoulombFriction<double>& law) const;
    SteadyFalling falling_model(const FallingLaw& law, const Eigen::ArrayXd& pressure) const;
    rollbem::SteadyCombinedModel<double> combined_model(const rollbem::CoulombFriction<double>& law) const;
    SteadyCombinedFalling combined_falling_model(const FallingLaw& law, const Eigen::ArrayXd& pressure) const;
};

/// --layer. Throws BadInput, also where a scene's scheme takes a derivative that does not exist with a layer.
double read_layer(const study::Options& options);

}  // namespace friction
