// rollbem/scene/contact.hpp
#include <limits>

#include <rollbem/scene/contact.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

TEMPLATE_TEST_CASE("A contact keeps its parameters", "[contact]", SCALARS) {
    using Scalar = TestType;
    const Contact contact({.half_length = Scalar(0.005),
                           .half_width = Scalar(0.02),
                           .shear_modulus = Scalar(8.2e10),
                           .poisson_ratio = Scalar(0.28)});
    CHECK(contact.half_length() == Scalar(0.005));
    CHECK(contact.half_width() == Scalar(0.02));
    CHECK(contact.shear_modulus() == Scalar(8.2e10));
    CHECK(contact.poisson_ratio() == Scalar(0.28));
    CHECK(std::abs(contact.aspect() - 4) <= 4 * std::numeric_limits<Scalar>::epsilon());

    const Contact simple = Contact::dimensionless(Scalar(100), Scalar(0.5));
    CHECK(simple.half_length() == 1);
    CHECK(simple.shear_modulus() == 1);
    CHECK(simple.aspect() == 100);
    CHECK(simple.poisson_ratio() == Scalar(0.5));

    const Contact plane({.half_length = 2, .shear_modulus = 1, .poisson_ratio = 0});
    CHECK(plane.aspect() == std::numeric_limits<Scalar>::infinity());
}

}  // namespace
