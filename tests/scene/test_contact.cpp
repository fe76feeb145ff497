// rollbem/scene/contact.hpp
#include <limits>

#include <rollbem/scene/contact.hpp>

#include "support/catch.hpp"
#include "support/scalars.hpp"

namespace {

using namespace rollbem;

TEMPLATE_TEST_CASE("A contact keeps its parameters", "[contact]", SCALARS) {
    using Scalar = TestType;
    const Contact<Scalar> contact({.half_length = Scalar(0.005),
                                   .half_width = Scalar(0.02),
                                   .shear_modulus = Scalar(8.2e10),
                                   .poisson_ratio = Scalar(0.28)});
    CHECK(contact.half_length() == Scalar(0.005));
    CHECK(contact.half_width() == Scalar(0.02));
    CHECK(contact.shear_modulus() == Scalar(8.2e10));
    CHECK(contact.poisson_ratio() == Scalar(0.28));
    CHECK(std::abs(contact.aspect() - 4) <= 4 * std::numeric_limits<Scalar>::epsilon());

    const Contact<Scalar> simple = Contact<Scalar>::dimensionless(Scalar(100), Scalar(0.5));
    CHECK(simple.half_length() == 1);
    CHECK(simple.shear_modulus() == 1);
    CHECK(simple.aspect() == 100);
    CHECK(simple.poisson_ratio() == Scalar(0.5));

    const Contact<Scalar> plane({.half_length = 2, .shear_modulus = 1, .poisson_ratio = 0});
    CHECK(plane.aspect() == std::numeric_limits<Scalar>::infinity());
}

TEST_CASE("A contact rejects invalid parameters and gives name and value", "[contact]") {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const auto with = [](double a, double b, double G, double nu) {
        return Contact<double>({.half_length = a, .half_width = b, .shear_modulus = G, .poisson_ratio = nu});
    };
    CHECK_NOTHROW(with(1, 1, 1, 0));
    CHECK_NOTHROW(with(1, 1, 1, 0.5));
    CHECK_THROWS_WITH(with(0, 1, 1, 0.3), "Contact: half_length = 0 must be positive and finite");
    CHECK_THROWS_WITH(with(infinity, 1, 1, 0.3), "Contact: half_length = inf must be positive and finite");
    CHECK_THROWS_WITH(with(nan, 1, 1, 0.3), "Contact: half_length = nan must be positive and finite");
    CHECK_THROWS_WITH(with(1, -2.5, 1, 0.3), "Contact: half_width = -2.5 must be positive");
    CHECK_THROWS_WITH(with(1, nan, 1, 0.3), "Contact: half_width = nan must be positive");
    CHECK_THROWS_WITH(with(1, 1, 0, 0.3), "Contact: shear_modulus = 0 must be positive and finite");
    CHECK_THROWS_WITH(with(1, 1, infinity, 0.3), "Contact: shear_modulus = inf must be positive and finite");
    CHECK_THROWS_WITH(with(1, 1, 1, 0.7), "Contact: poisson_ratio = 0.7 must lie in [0, 0.5]");
    CHECK_THROWS_WITH(with(1, 1, 1, -0.1), "Contact: poisson_ratio = -0.1 must lie in [0, 0.5]");
    CHECK_THROWS_WITH(with(1, 1, 1, nan), "Contact: poisson_ratio = nan must lie in [0, 0.5]");
    CHECK_THROWS_WITH(with(1e200, 1e-200, 1, 0.3), "Contact: half_width / half_length = 0 must be positive");
    CHECK_THROWS_WITH(Contact<double>::dimensionless(-1, 0.3), "Contact: aspect = -1 must be positive");
    CHECK_THROWS_AS(with(1, 1, 1, 0.7), std::invalid_argument);
}

}  // namespace
