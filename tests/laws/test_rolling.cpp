// rollbem/vehicle/wheelset_forces.hpp: the laws of force elements.
#include "laws/reaction.hpp"
#include "laws/refusals.hpp"
#include "laws/rolling.hpp"
#include "laws/symmetry.hpp"

namespace laws {

TEST_CASE("laws: a wheelset that rolls on its patches", "[profiles]") {
    const ForceElement of = rolling_wheelset(GENERATE(false, true));
    is_symmetric(of, 1e-5, 2);
    reacts(of, 1e-9, 2);
}

TEST_CASE("laws: a wheelset that rolls on its patches refuses what cannot be meant", "[profiles]") {
    refuses(rolling_wheelset(), 1);
}

}  // namespace laws
