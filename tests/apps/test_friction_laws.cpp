// apps/support/friction_laws.hpp
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/friction_laws.hpp"

namespace friction_laws_tests {
namespace {

TEST_CASE("The law that falls begins at mu_0, is finite and not negative, and refuses bad parameters", "[law]") {
    REQUIRE(study::friction_laws().size() == 1);
    const study::FrictionLawRow& row = study::friction_laws()[0];
    CHECK(row.option == std::string("falling"));
    REQUIRE(row.parameters.size() == 2);
    CHECK(row.title.size() == 2);
    CHECK(row.parameters[0].column != row.parameters[1].column);
    CHECK(row.holds({0.6, 2}));
    for (const auto& refused : {std::vector{-0.1, 2.0}, {0.6, 0.0}, {0.6, -1.0}}) CHECK_FALSE(row.holds(refused));
    const rollbem::Friction::Law law = row.law({0.6, 2});
    REQUIRE_FALSE(law.is_constant());
    CHECK(law.at_rest() == 1);
    for (const double v : {0.0, 1e-9, 0.5, 2.0, 1e3, 1e300}) {
        CAPTURE(v);
        CHECK(std::isfinite(law.of_slip()(v)));
        CHECK(law.of_slip()(v) >= 0);
    }
}

TEST_CASE("The law that falls passes half its fall at the given velocity", "[law]") {
    const rollbem::Friction::Law law = study::friction_laws()[0].law({0.6, 2});
    CHECK(law.of_slip()(2) == Approx(0.8).epsilon(1e-15));
    CHECK(law.of_slip()(1e3) == Approx(0.6).epsilon(1e-15));
}

}  // namespace
}  // namespace friction_laws_tests
