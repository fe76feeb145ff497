#include "recommend.hpp"

#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>

#include <rollbem/accuracy/recommendation.hpp>
#include <rollbem/accuracy/recommended_patch.hpp>

#include "support/csv.hpp"

namespace precision {

void print_recommendations(const study::Options& options) {
    const study::Rule open{[](double value) { return value > 0 && value < 1; }, "be above 0 and below 1"};
    const double tolerance = options.number("recommend", open);
    for (const auto& [name, value] : options.given_values()) {
        if (name != "recommend" && name != "a-over-b") options.ignored(name, "with --recommend");
    }
    const double a_over_b = options.number("a-over-b", study::between(0.1, 25));
    const auto print = [&](const char* purpose, const auto& line) {
        std::cout << "# " << purpose << "\n";
        try {
            std::cout << line() << "\n";
        } catch (const std::invalid_argument&) {
            std::cout << "# none: so small an error was not measured\n";
        }
    };
    const auto states = [&](rollbem::Purpose::Adhesion purpose) {
        return "--method chebyshev --n " +
               std::to_string(rollbem::recommended_scheme(tolerance, purpose).method.states);
    };
    const auto elements = [&](auto purpose) {
        return std::to_string(rollbem::recommended_elements(tolerance, purpose).n);
    };
    using rollbem::Purpose;
    print("steady rolling, c11", [&] { return "steady_study --kernel plane " + states(Purpose::steady); });
    print("the same by elements, extrapolated from half as many and all",
          [&] { return "precision_study --quantity c11 --schemes richardson-nodes --n " + elements(Purpose::steady); });
    print("c11 at frequencies omega a/V up to 5",
          [&] { return "frequency_study --kernel plane " + states(Purpose::frequency) + " --omega 5"; });
    print("the same by elements", [&] {
        return "precision_study --quantity c11_z5 --schemes richardson-nodes --n " + elements(Purpose::frequency);
    });
    const std::string after_step = "transient_study --step 1 --dq 1 --integrator exponential --kernel plane ";
    print("force in time, from q/a = 1 on after a step", [&] { return after_step + states(Purpose::time_loop); });
    print("the same by elements",
          [&] { return after_step + "--mesh cosine --alpha 0.5 --n " + elements(Purpose::time_loop); });
    print("friction, creepage ratios from 0.05", [&] {
        return "friction_study --kernel plane --method nodes --nodes chebyshev --n " + elements(Purpose::friction);
    });
    const std::string ratio = study::Cell(a_over_b).text();
    const auto patch = [&](double spin) {
        const rollbem::RecommendedPatch best = rollbem::recommended_patch(tolerance, a_over_b, spin);
        return "patch_study --a-over-b " + ratio + " --n " + std::to_string(best.n) + " --strips " +
               std::to_string(best.strips) + " --strip-grading uniform --longitudinal 0.2 --lateral 0.2" +
               (spin > 0 ? " --spin 0.5" : "");
    };
    const double any = std::numeric_limits<double>::infinity();
    print("friction on a patch, any creepages and spin, forces over mu N", [&] { return patch(any); });
    print("the same without spin", [&] { return patch(0); });
}

}  // namespace precision
