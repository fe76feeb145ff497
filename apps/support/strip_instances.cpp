#include "strip_instances.hpp"

namespace rollbem::reference {

template decltype(detail::strip_c11_once<double>) detail::strip_c11_once<double>;
template decltype(detail::strip_c11_once<std::complex<double>>) detail::strip_c11_once<std::complex<double>>;

}  // namespace rollbem::reference
