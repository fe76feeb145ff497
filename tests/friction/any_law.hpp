// Any law of friction as one type, so that tests of several laws share one instance of the models, in any_model.cpp.
#pragma once

#include <functional>

#include <rollbem/compiled/friction.hpp>

namespace falling_tests {

using AnyLaw = std::function<double(double)>;

}  // namespace falling_tests

namespace rollbem::detail {

extern template class FrictionCore<falling_tests::AnyLaw, 1, double>;
extern template class FrictionCore<falling_tests::AnyLaw, 2, double>;

}  // namespace rollbem::detail
