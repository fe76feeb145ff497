#include "polynomial_instances.hpp"
#include "strip_instances.hpp"

namespace rollbem {

template decltype(detail::solve_monomial_once<double>) detail::solve_monomial_once<double>;
template decltype(reference::detail::strip_c11_once<double>) reference::detail::strip_c11_once<double>;
template decltype(reference::detail::strip_c11_once<std::complex<double>>)
    reference::detail::strip_c11_once<std::complex<double>>;

}  // namespace rollbem
