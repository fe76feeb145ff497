// Systems of the same equations whose slip friction does not turn, for references that do not turn it either.
#pragma once

#include <utility>

#include <rollbem/system/rolling_system.hpp>

namespace support {

template <class Scalar>
rollbem::ElementSystem<Scalar> unturned(const rollbem::ElementSystem<Scalar>& system) {
    rollbem::Elements<Scalar> elements = system.elements();
    elements.half_element_ahead = false;
    return {system.has_G() ? system.G() : rollbem::MatrixX<Scalar>(), system.G_prime(), std::move(elements),
            system.element_count(), system.origin()};
}

}  // namespace support
