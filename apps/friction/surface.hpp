// Matrices of a scene for friction: in either direction, under a layer, on a mesh that may cover more than the contact
// under the reference load.
#pragma once

#include <utility>

#include <Eigen/Core>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/steady.hpp>
#include <rollbem/scene/contact.hpp>

#include "falling.hpp"
#include "support/options.hpp"
#include "support/scenes.hpp"

namespace friction {

enum class Direction { longitudinal, lateral };

struct Surface {
    const study::Scene& scene;
    double layer = 0;        ///< compliance L [a_0/G]
    double half_length = 1;  ///< of the mesh [a_0]

    /// With a_0 = G = 1.
    rollbem::Contact<double> contact() const;

    rollbem::ElementSystem<double> system(Direction direction) const;

    /// G' and the widths of its elements.
    std::pair<Eigen::MatrixXd, Eigen::ArrayXd> gradient(Direction direction) const;

    rollbem::SteadyFrictionModel<> steady_model(const rollbem::Friction<>& law) const;
    SteadyFalling falling_model(const FallingLaw& law, const Eigen::ArrayXd& pressure) const;
    rollbem::SteadyFrictionModel<ConstantFriction<>, 2> combined_model(const rollbem::Friction<>& law) const;
    SteadyCombinedFalling combined_falling_model(const FallingLaw& law, const Eigen::ArrayXd& pressure) const;
};

/// --layer. Throws BadInput, also if a scene's scheme needs a derivative that does not exist with a layer.
double read_layer(const study::Options& options);

}  // namespace friction
