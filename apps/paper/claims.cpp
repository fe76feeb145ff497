#include "claims.hpp"

#include "claims/lists.hpp"

namespace paper {

std::vector<Claim> claims() {
    std::vector<Claim> all;
    for (const auto& list :
         {claims_of_collocation, claims_of_galerkin, claims_of_meshes, claims_of_stability, claims_of_frequency}) {
        for (Claim& claim : list()) all.push_back(std::move(claim));
    }
    return all;
}

}  // namespace paper
