// rollbem/adhesion/stability.hpp
#include "stability_of_scalars.hpp"

namespace {

using namespace rollbem;

TEST_CASE("Signs settled in double agree with long double", "[stability]") {
    for (const int n : {20, 40, 80, 160}) {
        const StabilityResult<double> working = solve_stability(recommended<double>(n), {.settle_signs = true});
        const StabilityResult<long double> wide = solve_stability(recommended<long double>(n), {.settle_signs = true});
        CAPTURE(n, *working.uncertain_count, *wide.uncertain_count);
        const Eigen::Index settled = compare_settled(working, wide);
        CHECK(settled >= n / 2);
        CHECK(*wide.uncertain_count <= *working.uncertain_count);
        CHECK(working.unstable_count == wide.unstable_count);
        CHECK(*working.settled_unstable_count == (n == 160 ? 2 : 0));
        if (n <= 40) CHECK(settled == n);
    }
}

TEST_CASE("The fast count agrees with QZ in long double", "[stability]") {
    for (const double alpha_T : {0.5, 0.63, 1.0}) {
        const RollingSystem<long double> system = recommended<long double>(20, alpha_T);
        CHECK(count_unstable(system).status == Status::ok);
        CHECK(count_unstable(system).unstable_count == solve_stability(system).unstable_count);
    }
}

}  // namespace
