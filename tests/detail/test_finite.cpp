// rollbem/detail/finite.hpp
#include <complex>
#include <limits>

#include <Eigen/Core>

#include <rollbem/detail/finite.hpp>

#include "support/catch.hpp"

namespace {

using namespace rollbem::detail;

TEMPLATE_TEST_CASE("Bits tell finite numbers, infinities and NaN apart", "[finite]", float, double, long double) {
    using Limits = std::numeric_limits<TestType>;
    for (const TestType value : {TestType(0), TestType(-1), Limits::min(), Limits::denorm_min(), Limits::max()}) {
        for (const TestType number : {value, -value}) {
            CAPTURE(static_cast<double>(number));
            CHECK(is_finite(number));
            CHECK_FALSE(is_nan(number));
        }
    }
    for (const TestType infinity : {Limits::infinity(), -Limits::infinity()}) {
        CHECK_FALSE(is_finite(infinity));
        CHECK_FALSE(is_nan(infinity));
        CHECK_FALSE(is_finite(std::complex<TestType>(0, infinity)));
    }
    for (const TestType none : {Limits::quiet_NaN(), -Limits::quiet_NaN()}) {
        CHECK_FALSE(is_finite(none));
        CHECK(is_nan(none));
        CHECK_FALSE(is_finite(std::complex<TestType>(none, 0)));
    }
}

TEMPLATE_TEST_CASE("A single number that is not finite is found among many", "[finite]", float, double, long double) {
    using Limits = std::numeric_limits<TestType>;
    Eigen::Array<TestType, Eigen::Dynamic, 1> values(9);
    values.setConstant(Limits::max());
    values[4] = -Limits::max();
    values[5] = Limits::denorm_min();
    CHECK(all_finite(values));
    CHECK(all_finite(values.head(0).eval()));
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        for (const TestType value : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
            auto spoilt = values;
            spoilt[i] = value;
            CHECK_FALSE(all_finite(spoilt));
            Eigen::Array<std::complex<TestType>, Eigen::Dynamic, 1> complex =
                values.template cast<std::complex<TestType>>();
            CHECK(all_finite(complex));
            complex[i] = {1, value};
            CHECK_FALSE(all_finite(complex));
        }
    }
}

}  // namespace
