#include "polynomial.hpp"

namespace rollbem {

template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;

}  // namespace rollbem
