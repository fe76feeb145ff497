// Matrices of a scene for friction: in either direction, under a layer, on a mesh that may cover more than the contact
// under the reference load.
#pragma once

#include <Eigen/Core>

#include <rollbem/assembly/rolling_system.hpp>
#include <rollbem/compiled/friction.hpp>
#include <rollbem/friction/model.hpp>
#include <rollbem/scene/contact.hpp>

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

    /// G'.
    Eigen::MatrixXd gradient(Direction direction) const;

    template <int directions, class Law>
    rollbem::FrictionModel<Law, directions> steady_model(const rollbem::Friction<Law>& friction) const;
};

/// --layer. Throws BadInput, also if a scene's scheme needs a derivative that does not exist with a layer.
double read_layer(const study::Options& options);

}  // namespace friction
