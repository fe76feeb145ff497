// Checks whether a system was made for a contact. Internal.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "../../detail/finite.hpp"
#include "../../detail/require.hpp"
#include "../../scene/contact.hpp"

namespace rollbem::detail {

/// Throws std::invalid_argument unless a kernel's b/a, if known, equals the contact's to 1e-12. Both may be infinite.
inline void require_same_aspect(const char* who, const Contact& contact, const std::optional<double>& aspect) {
    if (!aspect || (!is_finite(*aspect) && !is_finite(contact.aspect()))) return;
    const double ratio = *aspect / contact.aspect();
    const bool same = std::abs(ratio - 1) <= 1e-12 + 4 * std::numeric_limits<double>::epsilon();
    require(is_finite(ratio) && same, who, "b/a of the kernel over b/a of the contact", ratio, "be 1");
}

/// Throws std::invalid_argument if a system was made for another b/a than the contact's, or if the contact's is
/// infinite although the system has G.
template <class System>
void require_same_aspect(const char* who, const Contact& contact, const System& system) {
    require(is_finite(contact.half_width()) || !system.has_G(), who, "half_width", contact.half_width(),
            "be finite: an infinite one is for steady problems only");
    require_same_aspect(who, contact, std::optional<double>(system.aspect()));
}

/// Throws std::invalid_argument unless the a/b of a system, if known, equals the a/b of an elliptic patch.
template <class AnyContact, class System>
void require_same_shape(const char* who, const AnyContact& contact, const System& system) {
    if (system.a_over_b() == 0 || contact.outline()) return;
    const double ratio = contact.a_over_b() / system.a_over_b();
    const bool same = std::abs(ratio - 1) <= 1e-12 + 4 * std::numeric_limits<double>::epsilon();
    require(same, who, "a/b of the patch over a/b of its system", ratio, "be 1");
}

}  // namespace rollbem::detail
