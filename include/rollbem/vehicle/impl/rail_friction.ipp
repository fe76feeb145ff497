// Bodies of vehicle/rail_friction.hpp. Internal.
#pragma once

#include "../rail_friction.hpp"

#include <utility>

#include "../../detail/finite.hpp"
#include "../../detail/linear_between.hpp"
#include "../../detail/require.hpp"

namespace rollbem {

ROLLBEM_DECL RailFriction::RailFriction(Over over, std::vector<double> nodes, std::vector<double> coefficients)
    : over_(over), nodes_(std::move(nodes)), coefficients_(std::move(coefficients)) {
    constexpr const char* name = "RailFriction";
    detail::require(!nodes_.empty(), name, "number of nodes", nodes_.size(), "be at least 1");
    detail::require(nodes_.size() == coefficients_.size(), name, "number of coefficients", coefficients_.size(),
                    "be the number of nodes");
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        detail::require(detail::is_finite(nodes_[k]) && (k == 0 || nodes_[k] > nodes_[k - 1]), name, "node", nodes_[k],
                        "be finite and above the one before");
        constexpr double quarter = 1.5708;
        detail::require(
            std::abs(nodes_[k]) <= (over == Over::angle ? quarter : 1), name, "node", nodes_[k],
            over == Over::angle ? "lie within a quarter turn: angles are in rad" : "lie within +-1: places are in m");
        detail::require(detail::is_finite(coefficients_[k]) && coefficients_[k] >= 0, name, "coefficient",
                        coefficients_[k], "be finite and not negative");
    }
}

ROLLBEM_DECL double RailFriction::at(double angle, double y) const {
    const double place = over_ == Over::angle ? angle : y;
    return detail::linear_between(nodes_, coefficients_, place);
}

}  // namespace rollbem
