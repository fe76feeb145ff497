#include "claims.hpp"

namespace paper {

std::vector<Chapter> chapters() {
    return {{kernel_and_alpha},
            {convergence},
            {analytic_derivative},
            {tractions_of_collocation},
            {galerkin_claims},
            {costs_of_galerkin, true},
            {gradings},
            {tractions_on_meshes},
            {conclusions_on_steady_rolling},
            {stability_of_collocation},
            {stability_of_galerkin},
            {split_points},
            {claims_on_frequency}};
}

}  // namespace paper
