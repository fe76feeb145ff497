// The units of the systems of a line contact 2a x 2b, or of a patch. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../../detail/fingerprint.hpp"
#include "../contact.hpp"
#include "../patch_contact.hpp"

namespace rollbem::detail {

/// The units of a system: lengths in `length`, tractions in `shear_modulus`, areas in length * width (widths of a line
/// contact of width 2b, areas of a patch).
struct ContactUnits {
    double length;         ///< a [m]
    double width;          ///< Contact::width() [m]; a for a patch
    double half_width;     ///< b [m]
    double shear_modulus;  ///< G [Pa]
    std::uint64_t fingerprint;
    bool line;  ///< false for a patch

    /// Semi-axes in the semi-axes of the contact; on a line the half-width is 1, without a division, whose time counts
    /// in a step of a few states.
    template <class Placed>
    SemiAxes axes(const Placed& placed) const {
        if (placed.half_length == length && (line || placed.half_width == half_width)) return {1, 1};
        return {placed.half_length / length, line ? 1.0 : placed.half_width / half_width};
    }

    /// Unit of a creepage or of a force over the unit of the longitudinal one; the third components are spin and
    /// moment.
    double arm(std::ptrdiff_t input) const { return input == 2 ? length : 1.0; }

    ContactUnits(const Contact& contact)  // NOLINT: implicit on purpose
        : ContactUnits(contact, contact.width(), true) {}
    ContactUnits(const PatchContact& contact)  // NOLINT: implicit on purpose
        : ContactUnits(contact, contact.half_length(), false) {}

private:
    template <class AnyContact>
    ContactUnits(const AnyContact& contact, double unit_width, bool is_line)
        : length(contact.half_length()),
          width(unit_width),
          half_width(contact.half_width()),
          shear_modulus(contact.shear_modulus()),
          line(is_line) {
        Fingerprint all;
        all.add(length);
        all.add(half_width);
        all.add(shear_modulus);
        fingerprint = all.value();
    }
};

}  // namespace rollbem::detail
