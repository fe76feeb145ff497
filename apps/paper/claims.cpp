#include "claims.hpp"

#include "claims/lists.hpp"

namespace paper {

std::vector<Claim> claims() {
    return all_of(
        {claims_of_collocation, claims_of_galerkin, claims_of_meshes, claims_of_stability, claims_of_frequency});
}

}  // namespace paper
