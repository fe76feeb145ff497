// rollbem/adhesion/stability.hpp
#include "stability_of_scalars.hpp"

namespace {

using namespace rollbem;

TEST_CASE("Signs settled in float agree with double", "[stability]") {
    for (const int n : {5, 10, 20, 40}) {
        for (const double alpha_T : {0.5, 0.63, 0.95}) {
            const StabilityResult<float> working =
                solve_stability(recommended<float>(n, alpha_T), {.settle_signs = true});
            const StabilityResult<double> wide = solve_stability(recommended<double>(n, alpha_T));
            CAPTURE(n, alpha_T);
            CHECK(compare_settled(working, wide) >= n / 4);
        }
    }
}

TEST_CASE("The fast count agrees with QZ in float", "[stability]") {
    for (const double alpha_T : {0.5, 0.63, 1.0}) {
        const RollingSystem<float> system = recommended<float>(20, alpha_T);
        CHECK(count_unstable(system).status == Status::ok);
        CHECK(count_unstable(system).unstable_count == solve_stability(system).unstable_count);
    }
}

}  // namespace
