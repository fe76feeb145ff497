#include "any_law.hpp"

namespace rollbem::detail {

template class FrictionCore<falling_tests::AnyLaw, 1, double>;
template class FrictionCore<falling_tests::AnyLaw, 2, double>;

}  // namespace rollbem::detail
