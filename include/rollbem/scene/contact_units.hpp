// The units of the systems of a line contact 2a x 2b, or of a patch.
#pragma once

#include <cstddef>
#include <cstdint>

#include "../detail/fingerprint.hpp"
#include "contact.hpp"
#include "semi_axes.hpp"

namespace rollbem {

template <class Scalar>
class PatchContact;

}  // namespace rollbem

namespace rollbem::detail {

/// The units of a system: lengths in `length`, tractions in `shear_modulus`, areas in length * width (widths of a line
/// contact of width 2b, areas of a patch).
template <class Scalar>
struct ContactUnits {
    Scalar length;         ///< a [m]
    Scalar width;          ///< Contact::width() [m]; a for a patch
    Scalar half_width;     ///< b [m]
    Scalar shear_modulus;  ///< G [Pa]
    std::uint64_t fingerprint;
    bool line;  ///< false for a patch

    /// Semi-axes in the semi-axes of the contact; on a line the half-width is 1, without a division, whose time counts
    /// in a step of a few states.
    template <class Placed>
    SemiAxes<Scalar> axes(const Placed& placed) const {
        if (placed.half_length == length && (line || placed.half_width == half_width)) return {1, 1};
        return {placed.half_length / length, line ? Scalar(1) : placed.half_width / half_width};
    }

    /// Unit of a creepage or of a force over the unit of the longitudinal one; the third components are spin and
    /// moment.
    Scalar arm(std::ptrdiff_t input) const { return input == 2 ? length : Scalar(1); }

    ContactUnits(const Contact<Scalar>& contact)  // NOLINT: implicit on purpose
        : ContactUnits(contact, contact.width(), true) {}
    ContactUnits(const PatchContact<Scalar>& contact)  // NOLINT: implicit on purpose
        : ContactUnits(contact, contact.half_length(), false) {}

private:
    template <class AnyContact>
    ContactUnits(const AnyContact& contact, Scalar unit_width, bool is_line)
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
