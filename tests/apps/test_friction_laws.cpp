// apps/support/friction_laws.hpp
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/friction_laws.hpp"

namespace friction_laws_tests {
namespace {

/// Parameters that are taken, and some that are not, of each law.
struct Example {
    std::string option;
    std::vector<double> taken;
    std::vector<std::vector<double>> refused;
};
const std::vector<Example> examples{{"falling", {0.6, 2}, {{-0.1, 2}, {0.6, 0}, {0.6, -1}}}};

TEST_CASE("Every law of friction begins at mu_0, is finite and not negative, and refuses bad parameters", "[law]") {
    std::set<std::string> columns;
    REQUIRE(study::friction_laws().size() == examples.size());
    for (const Example& example : examples) {
        for (const study::FrictionLawRow& row : study::friction_laws()) {
            if (row.option != example.option) continue;
            INFO(row.option);
            REQUIRE(row.parameters.size() == example.taken.size());
            CHECK(row.title.size() == row.parameters.size());
            for (const auto& parameter : row.parameters) CHECK(columns.insert(parameter.column).second);
            CHECK(row.holds(example.taken));
            for (const std::vector<double>& parameters : example.refused) CHECK_FALSE(row.holds(parameters));
            const rollbem::Friction::Law law = row.law(example.taken);
            REQUIRE_FALSE(law.is_constant());
            CHECK(law.at_rest() == 1);
            for (const double v : {0.0, 1e-9, 0.5, 2.0, 1e3, 1e300}) {
                CAPTURE(v);
                CHECK(std::isfinite(law.of_slip()(v)));
                CHECK(law.of_slip()(v) >= 0);
            }
        }
    }
}

TEST_CASE("The law that falls passes half its fall at the given velocity", "[law]") {
    const rollbem::Friction::Law law = study::friction_laws()[0].law({0.6, 2});
    CHECK(law.of_slip()(2) == Approx(0.8).epsilon(1e-15));
    CHECK(law.of_slip()(1e3) == Approx(0.6).epsilon(1e-15));
}

}  // namespace
}  // namespace friction_laws_tests
