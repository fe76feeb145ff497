// rollbem/scene/contact.hpp
#include <limits>

#include <rollbem/scene/contact.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem;

TEST_CASE("A contact keeps its parameters", "[contact]") {
    const Contact contact({.half_length = 0.005, .half_width = 0.02, .shear_modulus = 8.2e10, .poisson_ratio = 0.28});
    CHECK(contact.half_length() == 0.005);
    CHECK(contact.half_width() == 0.02);
    CHECK(contact.shear_modulus() == 8.2e10);
    CHECK(contact.poisson_ratio() == 0.28);
    CHECK(std::abs(contact.aspect() - 4) <= 4 * std::numeric_limits<double>::epsilon());

    const Contact simple = Contact::dimensionless(100.0, 0.5);
    CHECK(simple.half_length() == 1);
    CHECK(simple.shear_modulus() == 1);
    CHECK(simple.aspect() == 100);
    CHECK(simple.poisson_ratio() == 0.5);

    const Contact plane({.half_length = 2, .shear_modulus = 1, .poisson_ratio = 0});
    CHECK(plane.aspect() == std::numeric_limits<double>::infinity());
}

}  // namespace
