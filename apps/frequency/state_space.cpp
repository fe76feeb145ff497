#include "state_space.hpp"

#include <stdexcept>
#include <string>

#include <rollbem/adhesion/state_space.hpp>

#include "support/non_steady.hpp"

namespace frequency {

std::unique_ptr<study::StateSpaceFiles> state_space_files(const study::Options& options,
                                                          const std::vector<study::Scene>& scenes) {
    const std::string said = options.said("state-space");
    const study::Scene& scene = scenes.front();
    if (scenes.size() != 1) {
        throw study::BadInput(said +
                              " must go with one scheme; the values of --n, --alpha-L, --alpha-T and --lambda make " +
                              std::to_string(scenes.size()));
    }
    const auto space_of = [&](const auto& system) {
        const std::string flaw = study::flaw_in_steady_rolling(scene, system);
        if (flaw.empty()) return rollbem::state_space(system);
        throw study::BadInput(said + " must go with another scheme: that of n = " + std::to_string(scene.n()) + " " +
                              flaw);
    };
    rollbem::StateSpace<double> space;
    try {
        space = scene.chebyshev ? space_of(rolling_system(*scene.chebyshev, scene.kernel))
                                : space_of(rolling_system(*scene.mesh, scene.scheme, scene.kernel));
    } catch (const study::BadInput&) {
        throw;
    } catch (const std::invalid_argument& singular) {
        throw study::BadInput(said + " must go with a scheme that has one: " + singular.what());
    }
    return std::make_unique<study::StateSpaceFiles>(
        options, std::move(space),
        "equations = \"d x/d(q/a) = A x + B xi, -F/(a G) = C x + D xi; q = V t, F per unit width\"\n"
        "response = \"c11(s) = C (s I - A)^-1 B + D, s in V/a\"\n",
        "by elements: their tractions p/G, trailing to leading; chebyshev: coefficients of T_0, T_1, ... in u/a",
        "c11");
}

}  // namespace frequency
