// A user of rollbem::reference: the exact creep coefficient at low frequency is the steady one.
#include <cmath>
#include <complex>

#include <rollbem/closed_form/carter.hpp>
#include <rollbem/reference/bessel.hpp>

int main() {
    const std::complex<double> c11 = rollbem::reference::plane_c11({0, 1e-8}, 0.28, 100);
    return std::abs(c11 / rollbem::steady_c11(0.28) - 1.0) < 1e-6 ? 0 : 1;
}
